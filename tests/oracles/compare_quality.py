"""Compares kerf quality with TetGen's own statistics, and with itself on the same mesh in files of meshio and gmsh.

usage: python3 compare_quality.py KERF PART.vtu FOLDER

Writes files into FOLDER. Prints how many comparisons held; the exit code is 1 if one did not.
"""

import json
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree

import meshio
import numpy as np

# TetGen prints five digits, or seven of angles, of which it cuts some off.
TOLERANCE = 1e-4

# Smallest and largest of TetGen's statistics: the words it prints, and ours.
STATISTICS = {
    "Smallest volume": ("volume", "min"),
    "Largest volume": ("volume", "max"),
    "Shortest edge": ("min_edge", "min"),
    "Longest edge": ("max_edge", "max"),
    "Smallest dihedral": ("min_dihedral_deg", "min"),
    "Largest dihedral": ("max_dihedral_deg", "max"),
}


# Files whose writers keep fewer digits than a double has.
ROUNDED = {"text.vtu", "gmsh_msh22.msh", "gmsh_msh41.msh"}


class Broken(Exception):
    pass


def require(holds, law):
    if not holds:
        raise Broken(law)


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    require(done.returncode == 0, f"{' '.join(map(str, command))} ends well: {done.stdout[-300:]} {done.stderr[-300:]}")
    return done.stdout


def quality(kerf, path):
    return json.loads(run(kerf, "quality", path, "--json"))


def tetgen_files(mesh, stem):
    """The mesh as TetGen's files, counted from 1."""
    tets = mesh.cells_dict["tetra"]
    with open(f"{stem}.node", "w") as file:
        print(len(mesh.points), 3, 0, 0, file=file)
        for number, point in enumerate(mesh.points.tolist(), 1):
            print(number, *map(repr, point), file=file)
    with open(f"{stem}.ele", "w") as file:
        print(len(tets), 4, 0, file=file)
        for number, tet in enumerate(tets.tolist(), 1):
            print(number, *(corner + 1 for corner in tet), file=file)
    return f"{stem}.node"


def check_tetgen(kerf, path):
    """TetGen's numbers of its own files; -NEF: it writes nothing."""
    text = run("tetgen", "-rNEFV", path)
    ours = quality(kerf, path)
    tets = int(re.search(r"Mesh tetrahedra: (\d+)", text)[1])
    require(tets == ours["tets"], "TetGen has read as many tetrahedra")
    for words, (measure, end) in STATISTICS.items():
        theirs = float(re.search(rf"{words}: +([-+.\de]+)", text)[1])
        value = ours["quality"]["all"][measure][end]
        require(abs(theirs - value) <= TOLERANCE * abs(value), f"{words}: TetGen says {theirs}, Kerf {value}")
    return len(STATISTICS) + 1


def check_against_formula(mesh, ours):
    """Radius-edge and aspect ratio from their definitions, by linear algebra; TetGen 1.5 prints other ones."""
    corners = mesh.points[mesh.cells_dict["tetra"]]
    origin, rest = corners[:, :1], corners[:, 1:]
    edges = rest - origin
    centres = np.linalg.solve(2 * edges, np.einsum("tij,tij->ti", edges, edges)[..., None])[..., 0]
    radii = np.linalg.norm(centres, axis=1)
    pairs = [(i, j) for i in range(4) for j in range(i + 1, 4)]
    lengths = np.stack([np.linalg.norm(corners[:, i] - corners[:, j], axis=1) for i, j in pairs])
    faces = [(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)]
    areas = sum(
        np.linalg.norm(np.cross(corners[:, b] - corners[:, a], corners[:, c] - corners[:, a]), axis=1) / 2
        for a, b, c in faces
    )
    inradii = np.abs(np.linalg.det(edges)) / 2 / areas
    found = {"radius_edge": radii / lengths.min(axis=0), "aspect": lengths.max(axis=0) / (2 * np.sqrt(6) * inradii)}
    for measure, values in found.items():
        for end, value in (("min", values.min()), ("max", values.max())):
            kerf_value = ours["quality"]["all"][measure][end]
            require(np.isclose(value, kerf_value, rtol=1e-6), f"{end} of {measure} is {value}, Kerf says {kerf_value}")
        median = ours["quality"]["all"][measure]["median"]
        require(np.isclose(np.median(values), median, rtol=0.01), f"the median of {measure} is {median}")
    return 3 * len(found)


def with_entities(mesh):
    """The mesh with one volume and one surface, which Gmsh's formats ask for."""
    of_cells = [np.ones(len(block.data), dtype=int) for block in mesh.cells]
    return meshio.Mesh(
        mesh.points,
        mesh.cells,
        point_data={"gmsh:dim_tags": np.tile([3, 1], (len(mesh.points), 1))},
        cell_data={"gmsh:physical": of_cells, "gmsh:geometrical": of_cells},
    )


def check_ends(found, expected, name):
    """Smallest and largest values agree to what is left of the coordinates."""
    for measure, values in expected["quality"]["all"].items():
        for end in ("min", "max"):
            value = found["quality"]["all"][measure][end]
            require(np.isclose(value, values[end], rtol=1e-6), f"{end} of {measure} of {name} is {value}")


def check_formats(kerf, mesh, expected, folder):
    """The same mesh, written by meshio and by gmsh, has the same numbers in every bin."""
    files = {
        "m.mesh": {"file_format": "medit", "float_fmt": ".17g"},
        "m22.msh": {"file_format": "gmsh22", "binary": False, "float_fmt": ".17g"},
        "m22b.msh": {"file_format": "gmsh22", "binary": True},
        "m41.msh": {"file_format": "gmsh", "binary": False, "float_fmt": ".17g"},
        "m41b.msh": {"file_format": "gmsh", "binary": True},
        "text.vtu": {"binary": False},
        "zlib.vtu": {"compression": "zlib"},
        "plain.vtu": {"compression": None},
    }
    for name, options in files.items():
        (with_entities(mesh) if name.endswith(".msh") else mesh).write(folder / name, **options)
    for version, extra in (("msh22", []), ("msh22", ["-bin"]), ("msh41", []), ("msh41", ["-bin"])):
        name = f"gmsh_{version}{''.join(extra)}.msh"
        run("gmsh", str(folder / "m22b.msh"), "-save", "-v", "1", "-format", version, *extra, "-o", str(folder / name))
        files[name] = {}
    boundary = quality(kerf, folder / "m.mesh")["boundary"]  # TetGen's files list no triangles
    for name in files:
        found = quality(kerf, folder / name)
        require(found["tets"] == expected["tets"], f"{name} has as many tetrahedra")
        if name in ROUNDED:
            check_ends(found, expected, name)
            continue
        require(found["quality"] == expected["quality"], f"{name} has the quality of TetGen's files")
        require(found["boundary"] == boundary, f"{name} has the boundary of the others")
    return len(files)


def check_comparison(kerf, folder):
    """The sheet of two meshes is XML."""
    picture = folder / "sheet.svg"
    run(kerf, "quality", folder / "m41.msh", "--compare", folder / "m.mesh", "--picture", picture)
    xml.etree.ElementTree.parse(picture)
    return 1


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    kerf, part, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    read = meshio.read(part)
    mesh = meshio.Mesh(read.points, {kind: read.cells_dict[kind] for kind in ("tetra", "triangle")})
    try:
        of_tetgen = tetgen_files(mesh, folder / "tetgen")
        held = check_tetgen(kerf, of_tetgen)
        expected = quality(kerf, of_tetgen)
        held += check_against_formula(mesh, expected)
        held += check_formats(kerf, mesh, expected, folder)
        held += check_comparison(kerf, folder)
        print(json.dumps({"comparisons": held}))
    except Broken as broken:
        print(json.dumps({"broken_law": str(broken)}))
        sys.exit(1)


if __name__ == "__main__":
    main()
