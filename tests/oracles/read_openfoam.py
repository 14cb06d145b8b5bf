"""Compares a case of OpenFOAM, as others read it, with the run that it was exported from.

usage: python3 read_openfoam.py RUN --case CASE [--linear FIELD] [--check-mesh LOG] [--check-joined LOG]

The case is read by VTK's own reader: counts, volume and the area of every patch, in their order, are those of the
parts in RUN. FIELD goes from 0 to 1 along x at its last time. LOG is what checkMesh says of the parts, and of the mesh
that reconstructParMesh has joined: that it is OK, the counts and the volume. The exit code is 1 if a law does not hold.
"""

import argparse
import json
import pathlib
import re
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

TRIANGLE, TETRA = 5, 10


def require(holds, law):
    if not holds:
        sys.exit(f"broken: {law}")


def points_of(grid):
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(np.float64)


def corners_of(grid, kind):
    types = vtk_to_numpy(grid.GetCellTypesArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    size = {TRIANGLE: 3, TETRA: 4}[kind]
    return connectivity[offsets[:-1][types == kind][:, None] + np.arange(size)], types == kind


def volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6


def areas(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


class Run:
    """What the parts of a run say, read by VTK, too."""

    def __init__(self, folder):
        report = json.loads((folder / "report.json").read_text())
        self.vertices = report["totals"]["vertices"]
        self.volume = report["input"]["volume"]
        self.names = report["input"]["patches"]
        self.areas = np.zeros(len(self.names))
        self.tets = self.points = self.inner_faces = self.patch_faces = 0
        for path in sorted((folder / "parts").glob("*.vtu")):
            if not path.name.endswith(".surface.vtu"):
                self.add(path)
        require(self.tets == report["totals"]["tets"], "the parts have the tetrahedra of the report")

    def add(self, path):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        fields = grid.GetFieldData()
        names = fields.GetArray("PatchNames")
        names = vtk_to_numpy(names).tobytes().decode().split("\0")[:-1] if names else []
        numbers = fields.GetArray("PatchNumbers")  # of many patches a part has names of its own alone
        numbers = vtk_to_numpy(numbers) if numbers else range(len(self.names))
        require(names == [self.names[number] for number in numbers], f"{path} names patches as the report does")
        triangles, are_triangles = corners_of(grid, TRIANGLE)
        patches = vtk_to_numpy(grid.GetCellData().GetArray("Patch"))[are_triangles]
        for patch, area in zip(patches, areas(points_of(grid), triangles)):
            if patch >= 0:
                self.areas[patch] += area
        self.points += grid.GetNumberOfPoints()
        self.tets += len(corners_of(grid, TETRA)[0])
        self.patch_faces += np.count_nonzero(patches >= 0)


def read_case(folder):
    """The blocks of a case by VTK: the mesh, and the patches by name."""
    complaints = []
    reader = vtk.vtkPOpenFOAMReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: complaints.append(event))
    reader.SetController(vtk.vtkDummyController())
    reader.SetFileName(str(folder / "system" / "controlDict"))
    reader.SetCaseType(0 if (folder / "processor0").exists() else 1)
    reader.UpdateInformation()
    for i in range(reader.GetNumberOfPatchArrays()):
        reader.SetPatchArrayStatus(reader.GetPatchArrayName(i), 1)
    times = reader.GetTimeValues()
    if times and times.GetNumberOfTuples():
        last = times.GetValue(times.GetNumberOfTuples() - 1)
        reader.UpdateTimeStep(last)
    reader.Update()
    require(not complaints, f"VTK reads {folder}")
    blocks = named_blocks(reader.GetOutput())
    return blocks["internalMesh"], named_blocks(blocks["boundary"])


def named_blocks(blocks):
    key = vtk.vtkCompositeDataSet.NAME()
    return {blocks.GetMetaData(i).Get(key): blocks.GetBlock(i) for i in range(blocks.GetNumberOfBlocks())}


def area_of_patch(patch):
    triangles = vtk_to_numpy(patch.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return areas(points_of(patch), triangles).sum()


def check_case(run, folder, field):
    mesh, patches = read_case(folder)
    tets, are_tets = corners_of(mesh, TETRA)
    require(np.all(are_tets) and len(tets) == run.tets, f"{folder} has the tetrahedra of the run")
    # VTK keeps points as floats.
    volume = volumes(points_of(mesh), tets).sum()
    require(np.isclose(volume, run.volume, rtol=1e-5), f"{folder} has the volume {run.volume}, not {volume}")
    require(len(patches) == len(run.names), f"{folder} has the patches {run.names}, not {list(patches)}")
    for name, patch, area in zip(patches, patches.values(), run.areas):
        require(re.fullmatch(r"[A-Za-z_][-\w.]*", name, re.ASCII), f"{name} is a word")
        require(np.isclose(area_of_patch(patch), area, rtol=1e-5), f"the patch {name} of {folder} has the area {area}")
    if field:
        check_linear(mesh, tets, field)


def check_linear(mesh, tets, field):
    points = points_of(mesh)
    x = points[tets].mean(axis=1)[:, 0]
    low, high = points[:, 0].min(), points[:, 0].max()
    found = vtk_to_numpy(mesh.GetCellData().GetArray(field))
    error = np.abs(found - (x - low) / (high - low)).max()
    require(error < 1e-5, f"{field} is linear, to {error}")


def number(log, pattern):
    found = re.search(pattern + r"\s*([-+.\de]+?)\.?\s", log)
    require(found, f"checkMesh says {pattern}")
    return float(found.group(1))


def check_log(run, log, is_joined):
    require("Mesh OK." in log, "checkMesh says that the mesh is OK:\n" + "\n".join(re.findall(r" \*\*.*", log)))
    require(number(log, r"cells:") == run.tets, "checkMesh counts the tetrahedra of the run")
    require(number(log, r"tetrahedra:") == run.tets, "all of them are tetrahedra")
    points = run.vertices if is_joined else run.points
    require(number(log, r"points:") == points, f"checkMesh counts {points} points")
    inner = number(log, r"internal faces:")
    require(number(log, r"\bfaces:") + inner == 4 * run.tets, "every tetrahedron has four faces")
    if is_joined:
        require(4 * run.tets - 2 * inner == run.patch_faces, "all other faces are on patches")
    volume = number(log, r"Total volume =")
    require(np.isclose(volume, run.volume, rtol=1e-5), f"checkMesh finds the volume {run.volume}, not {volume}")


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("--case", type=pathlib.Path, required=True)
    parser.add_argument("--linear")
    parser.add_argument("--check-mesh", type=pathlib.Path)
    parser.add_argument("--check-joined", type=pathlib.Path)
    arguments = parser.parse_args()
    run = Run(arguments.run)
    check_case(run, arguments.case, arguments.linear)
    if arguments.check_mesh:
        check_log(run, arguments.check_mesh.read_text(), is_joined=False)
    if arguments.check_joined:
        check_log(run, arguments.check_joined.read_text(), is_joined=True)


if __name__ == "__main__":
    main()
