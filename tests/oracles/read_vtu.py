"""Reads a run folder with VTK's own reader and with meshio, and compares what they find with the laws of part files, with
each other and with the report.

usage: python3 read_vtu.py DIR

Reads DIR/mesh.pvtu, every file of DIR/parts, and DIR/report.json. Prints counts and the total volume as JSON; the exit
code is 1 if a law does not hold. ParaView and pyvista read VTU by VTK. gmsh reads none, so it is not asked.
"""

import json
import pathlib
import sys

import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

TRIANGLE, TETRA = 5, 10
TAGS = ("Part", "Patch", "Neighbour")
MEASURES = ("MinDihedralAngle", "MaxDihedralAngle", "RadiusEdgeRatio", "AspectRatio", "Shape")  # --fields chooses


class Broken(Exception):
    pass


def require(holds, law):
    if not holds:
        raise Broken(law)


def read(reader, path):
    """The grid in the file; a complaint of VTK is a broken law."""
    complaints = []
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: complaints.append(path))
    reader.SetFileName(str(path))
    reader.Update()
    require(not complaints and reader.GetErrorCode() == 0, f"VTK reads {path}")
    return reader.GetOutput()


def array(data, name, path):
    require(data.GetArray(name) is not None, f"{path} has the array {name} of numbers")
    return vtk_to_numpy(data.GetArray(name))


def volumes(points, corners):
    a, b, c, d = (points[corners[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6


def patch_names(values, path):
    """The names in the bytes of PatchNames: each ends with a zero byte."""
    require(values.dtype == np.uint8, f"PatchNames of {path} are bytes")
    text = values.tobytes()
    require(text.endswith(b"\0"), f"the last of PatchNames of {path} is complete")
    return text[:-1].decode().split("\0")


def check_grid(grid, path, measures):
    """Laws of a part, of a surface and of the whole; returns the numbers that the report shows."""
    points = vtk_to_numpy(grid.GetPoints().GetData())
    types = vtk_to_numpy(grid.GetCellTypesArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    cells = grid.GetCellData()
    ids = array(grid.GetPointData(), "GlobalVertexId", path)
    part, patch, neighbour = (array(cells, name, path) for name in TAGS)
    tets, facets = types == TETRA, types == TRIANGLE

    require(np.all(tets | facets), f"{path} has only tetrahedra and triangles")
    require(np.array_equal(np.diff(offsets), np.where(tets, 4, 3)), f"cells of {path} have the sizes of their types")
    require(np.all(patch[tets] == -1) and np.all(neighbour[tets] == -1), f"only triangles of {path} have tags")
    require(ids.dtype == np.int64 and np.all(ids >= 0), f"{path} has 64-bit vertex numbers")
    for name in measures:
        values = array(cells, name, path)
        require(values.dtype == np.float32 and np.all(np.isfinite(values)), f"{name} of {path} is finite")
    corners = connectivity[offsets[:-1][tets][:, None] + np.arange(4)]
    volume = volumes(points, corners)
    require(np.all(volume > 0), f"tetrahedra of {path} have positive volume")
    return {
        "points": len(points),
        "vertices": len(np.unique(ids)),
        "tets": int(tets.sum()),
        "triangles": int(facets.sum()),
        "parts": len(np.unique(part)),
        "volume": float(volume.sum()),
    }


def measures_of(folder):
    """Those that mesh.pvtu promises of every part."""
    text = (folder / "mesh.pvtu").read_text()
    return tuple(name for name in MEASURES if f'Name="{name}"' in text)


def check_part(path):
    grid = read(vtk.vtkXMLUnstructuredGridReader(), path)
    is_surface = path.name.endswith(".surface.vtu")
    numbers = check_grid(grid, path, () if is_surface else measures_of(path.parent.parent))
    fields = grid.GetFieldData()
    numbers["patches"] = patch_names(array(fields, "PatchNames", path), path)
    patches = array(grid.GetCellData(), "Patch", path)
    require(patches.max(initial=-1) < len(numbers["patches"]), f"every patch of {path} has a name")
    boundary = array(fields, "BoundaryVertexCount", path)
    require(0 <= boundary[0] <= numbers["points"], f"BoundaryVertexCount of {path} is a number of its vertices")
    require(numbers["parts"] == 1, f"{path} is one part")
    require(is_surface == (numbers["tets"] == 0), f"{path} has tetrahedra unless it is a surface")
    check_as_meshio_reads_it(path, numbers)
    return numbers


def check_as_meshio_reads_it(path, numbers):
    """meshio finds what VTK has found."""
    mesh = meshio.read(path)
    cells = mesh.cells_dict
    tets = cells.get("tetra", np.empty((0, 4), dtype=int))
    counts = {"points": len(mesh.points), "tets": len(tets), "triangles": len(cells["triangle"])}
    for count, value in counts.items():
        require(value == numbers[count], f"meshio and VTK find as many {count} in {path}")
    volume = float(volumes(mesh.points, tets).sum())
    require(np.isclose(volume, numbers["volume"], rtol=1e-12, atol=0), f"meshio and VTK find one volume in {path}")
    require(patch_names(mesh.field_data["PatchNames"], path) == numbers["patches"], f"meshio reads the names in {path}")


def check_report(folder, whole):
    report = json.loads((folder / "report.json").read_text())
    parts = report["parts"]
    require(whole["parts"] == len(parts), "the report has the parts of mesh.pvtu")
    require(whole["tets"] == sum(part["tets"] for part in parts), "the report has the tetrahedra of mesh.pvtu")
    volume = report["input"]["volume"]
    require(np.isclose(whole["volume"], volume, rtol=1e-9, atol=0), "mesh.pvtu has the volume of the input")


def check_run(folder):
    paths = sorted((folder / "parts").glob("*.vtu"))
    require(paths, f"{folder} has parts")
    parts = {path.name: check_part(path) for path in paths}
    whole = check_grid(read(vtk.vtkXMLPUnstructuredGridReader(), folder / "mesh.pvtu"), folder / "mesh.pvtu", measures_of(folder))
    volumetric = [numbers for name, numbers in parts.items() if not name.endswith(".surface.vtu")]
    for count in ("points", "tets", "triangles", "parts"):
        require(whole[count] == sum(part[count] for part in volumetric), f"mesh.pvtu has the {count} of its parts")
    check_report(folder, whole)
    return whole


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        print(json.dumps(check_run(pathlib.Path(sys.argv[1]))))
    except Broken as broken:
        print(json.dumps({"broken_law": str(broken)}))
        sys.exit(1)


if __name__ == "__main__":
    main()
