"""Reads the merged files of a run with meshio, and the VTU with VTK's own reader, too, and compares what they find with
the part files.

usage: python3 read_merged.py DIR STEM

DIR is the folder of the run; STEM.mesh, STEM.inp, STEM.su2, STEM.vtu and the files of merged_formats.py are merged from
it. Equal are the numbers of vertices, tetrahedra and parts, the volume, and the area of every patch. Prints them as JSON; the exit code is 1 if a
law does not hold.
"""

import contextlib
import io
import json
import pathlib
import sys

import gmsh
import merged_formats
import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

# The corners of the faces S1 to S4 of a tetrahedron in CalculiX's manual, from 0.
FACES = {"S1": (0, 1, 2), "S2": (0, 3, 1), "S3": (1, 3, 2), "S4": (2, 3, 0)}


class Broken(Exception):
    pass


def require(holds, law):
    if not holds:
        raise Broken(law)


def volume(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    volumes = np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6
    require(np.all(volumes > 0), "tetrahedra have positive volume")
    return float(volumes.sum())


def areas(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def area_by_patch(points, triangles, patch):
    return {int(p): float(areas(points, triangles[patch == p]).sum()) for p in np.unique(patch)}


def read(path):
    """meshio's mesh; it says that it has no names for SU2's markers."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return meshio.read(path)


def names_of(mesh):
    return mesh.field_data["PatchNames"].astype(np.uint8).tobytes()[:-1].decode().split("\0")


def expected(folder):
    """What the files of the parts hold together."""
    whole = {"vertices": 0, "tets": 0, "parts": [], "volume": 0.0, "areas": {}}
    paths = [path for path in (folder / "parts").glob("*.vtu") if not path.name.endswith(".surface.vtu")]
    for path in paths:
        mesh = read(path)
        whole["vertices"] = max(whole["vertices"], int(mesh.point_data["GlobalVertexId"].max()) + 1)
        whole["tets"] += len(mesh.cells_dict["tetra"])
        whole["parts"].append(len(mesh.cells_dict["tetra"]))
        whole["volume"] += volume(mesh.points, mesh.cells_dict["tetra"])
        patch = mesh.cell_data_dict["Patch"]["triangle"].ravel()
        lies = patch >= 0
        for p, area in area_by_patch(mesh.points, mesh.cells_dict["triangle"][lies], patch[lies]).items():
            whole["areas"][p] = whole["areas"].get(p, 0.0) + area
    whole["parts"].sort()
    whole["names"] = json.loads((folder / "report.json").read_text())["input"]["patches"]  # a part may have some alone
    return whole


def found_in(mesh, part, patch):
    """The same of one mesh, of which part and patch are arrays over tetrahedra and triangles; no part: None."""
    tets, triangles = mesh.cells_dict["tetra"], mesh.cells_dict["triangle"]
    sizes = None if part is None else sorted(int(n) for n in np.unique(part, return_counts=True)[1])
    return {
        "vertices": len(mesh.points),
        "tets": len(tets),
        "parts": sizes,
        "volume": volume(mesh.points, tets),
        "areas": area_by_patch(mesh.points, triangles, patch),
    }


def require_bodies(mesh, body, path):
    """Numbers of bodies, over tetrahedra."""
    tets = mesh.cells_dict["tetra"]
    require(np.array_equal(np.unique(body), np.arange(1, body.max() + 1)), f"bodies of {path} count from 1")
    vertices = [np.unique(tets[body == each]) for each in range(1, body.max() + 1)]
    require(sum(map(len, vertices)) == len(mesh.points), f"bodies of {path} have no vertex in common")


def read_medit(path):
    mesh = read(path)
    references = mesh.cell_data_dict["medit:ref"]
    require_bodies(mesh, references["tetra"], path)
    return found_in(mesh, None, references["triangle"] - 1)


def read_su2(path, patches):
    """meshio numbers markers from 1; there is one for each of the patches, ascending."""
    mesh = read(path)
    tags = mesh.cell_data_dict["su2:tag"]["triangle"]
    require(tags.max() == len(patches), f"{path} has a marker for each patch with triangles")
    return found_in(mesh, None, np.array(patches)[tags - 1])


def read_vtu_by_meshio(path, names):
    mesh = read(path)
    require(names_of(mesh) == names, f"meshio reads the names of the patches in {path}")
    cells = mesh.cell_data_dict
    return found_in(mesh, cells["Part"]["tetra"].ravel(), cells["Patch"]["triangle"].ravel())


def read_vtu_by_vtk(path, names):
    complaints = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: complaints.append(path))
    reader.SetFileName(str(path))
    reader.Update()
    require(not complaints and reader.GetErrorCode() == 0, f"VTK reads {path}")
    grid = reader.GetOutput()
    text = vtk_to_numpy(grid.GetFieldData().GetArray("PatchNames")).tobytes()[:-1].decode()
    require(text.split("\0") == names, f"VTK reads the names of the patches in {path}")
    ids = vtk_to_numpy(grid.GetPointData().GetArray("GlobalVertexId"))
    require(np.array_equal(ids, np.arange(len(ids))), f"{path} has its vertices in the order of their numbers")
    points = vtk_to_numpy(grid.GetPoints().GetData())
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    first = vtk_to_numpy(grid.GetCells().GetOffsetsArray())[:-1]
    is_tet = vtk_to_numpy(grid.GetCellTypesArray()) == vtk.VTK_TETRA
    part, patch = (vtk_to_numpy(grid.GetCellData().GetArray(name)) for name in ("Part", "Patch"))
    mesh = meshio.Mesh(
        points,
        [
            ("tetra", corners[first[is_tet][:, None] + np.arange(4)]),
            ("triangle", corners[first[~is_tet][:, None] + np.arange(3)]),
        ],
    )
    return found_in(mesh, part[is_tet], patch[~is_tet])


def read_abaqus(path, patches):
    """Parts and bodies are element sets. Patches are node sets, ascending, and element sets by the face that lies on them."""
    mesh = read(path)
    tets = np.concatenate([block.data for block in mesh.cells])
    first = np.cumsum([0] + [len(block.data) for block in mesh.cells])
    sets = {
        name: np.concatenate([np.asarray(of_block, dtype=int) + first[i] for i, of_block in enumerate(blocks)])
        for name, blocks in mesh.cell_sets.items()
        if not name.startswith("SUBDOMAIN_")
    }
    body = np.zeros(len(tets), dtype=int)
    for name in [name for name in sets if name.startswith("BODY_")]:
        body[sets.pop(name)] += int(name.removeprefix("BODY_"))
    require_bodies(mesh, body, path)
    require(len(sets.pop("EALL")) == len(tets), f"EALL of {path} has all elements")
    by_patch = {}
    require(len(mesh.point_sets) == len(patches), f"{path} has a node set for each patch with triangles")
    for patch, (name, nodes) in zip(patches, mesh.point_sets.items()):
        triangles = [tets[sets.pop(f"{name}_{face}", np.array([], dtype=int))][:, FACES[face]] for face in FACES]
        triangles = np.concatenate(triangles)
        require(np.array_equal(np.unique(triangles), np.sort(nodes)), f"the node set {name} of {path} has its corners")
        by_patch[patch] = float(areas(mesh.points, triangles).sum())
    require(not sets, f"{path} has no other element sets than those of parts and patches")
    return {
        "vertices": len(mesh.points),
        "tets": len(tets),
        "parts": sorted(len(block.data) for block in mesh.cells),
        "volume": volume(mesh.points, tets),
        "areas": by_patch,
    }


def read_by_others(path, names, patches):
    """Names are words in all formats but VTK's, and patches come in their order there. Materials are bodies."""
    mesh = merged_formats.read(path)
    areas = mesh.areas()
    require(len(areas) == len(patches), f"{path} has a name for each patch with triangles")
    bodies = sorted(mesh.cells_by_region())
    require(bodies == ["volume"] or bodies == sorted(f"body_{k + 1}" for k in range(len(bodies))), f"{path} has bodies")
    by_patch = {names.index(name): area for name, area in areas.items()} if path.endswith(".vtk") else dict(
        zip(patches, areas.values()))
    return {"vertices": mesh.nodes, "tets": len(mesh.tets), "parts": None, "volume": mesh.volume(), "areas": by_patch}


def require_surface(path, whole):
    """The surface alone, with the patches in the order of the names."""
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    surface = reader.GetOutput()
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    patch = vtk_to_numpy(surface.GetCellData().GetArray("Patch"))
    found = area_by_patch(vtk_to_numpy(surface.GetPoints().GetData()), corners, patch)
    require(found.keys() == whole["areas"].keys(), f"{path} has the patches of the parts")
    require(np.allclose([found[p] for p in found], [whole["areas"][p] for p in found], rtol=1e-9), f"{path} has areas")
    text = bytes(vtk_to_numpy(surface.GetFieldData().GetArray("PatchNames"))).decode()
    require(text.split("\0")[:-1] == whole["names"], f"VTK reads the names of the patches in {path}")


def compare(path, whole, found):
    for count in ("vertices", "tets"):
        require(found[count] == whole[count], f"{path} has as many {count} as the parts")
    require(found["parts"] is None or found["parts"] == whole["parts"], f"{path} says which part a tetrahedron is of")
    require(np.isclose(found["volume"], whole["volume"], rtol=1e-12, atol=0), f"{path} has the volume of the parts")
    require(found["areas"].keys() == whole["areas"].keys(), f"{path} has the patches of the parts")
    for patch, area in whole["areas"].items():
        require(np.isclose(found["areas"][patch], area, rtol=1e-9, atol=0), f"patch {patch} of {path} has its area")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    stem = sys.argv[2]
    try:
        whole = expected(pathlib.Path(sys.argv[1]))
        patches = sorted(whole["areas"])
        compare(f"{stem}.mesh", whole, read_medit(f"{stem}.mesh"))
        compare(f"{stem}.su2", whole, read_su2(f"{stem}.su2", patches))
        compare(f"{stem}.inp", whole, read_abaqus(f"{stem}.inp", patches))
        compare(f"{stem}.vtu", whole, read_vtu_by_meshio(f"{stem}.vtu", whole["names"]))
        compare(f"{stem}.vtu", whole, read_vtu_by_vtk(f"{stem}.vtu", whole["names"]))
        gmsh.initialize()
        for ending in merged_formats.ENDINGS:
            compare(f"{stem}.{ending}", whole, read_by_others(f"{stem}.{ending}", whole["names"], patches))
        require_surface(f"{stem}.vtp", whole)
        print(json.dumps({**whole, "parts": len(whole["parts"]), "areas": len(patches), "names": len(whole["names"])}))
    except (Broken, merged_formats.Unfit) as broken:
        print(json.dumps({"broken_law": str(broken)}))
        sys.exit(1)


if __name__ == "__main__":
    main()
