"""Other programs read what kerf has exported and merged of a solution: the same values at the same places.

usage: python3 compare_exports.py KERF SOLUTION
"""

import pathlib
import subprocess
import sys

import gmsh
import h5py
import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from compare_with_calculix import Solution


def expect_same(found, expected, what):
    found = np.asarray(found, dtype=float).reshape(expected.shape)
    off = np.abs(found - expected).max() / np.abs(expected).max()
    print(f"{what}: {off:.1e}")
    assert off < 1e-6, what


def expect_gmsh_has(file, solution):
    gmsh.clear()
    gmsh.merge(str(file))
    seen = set()
    for tag in gmsh.view.getTags():
        name = gmsh.option.getString(f"View[{gmsh.view.getIndex(tag)}].Name")
        kind, tags, data, _, width = gmsh.view.getHomogeneousModelData(tag, 0)
        numbers, rows = np.array(tags, dtype=int) - 1, np.array(data).reshape(-1, width)
        if name == "Displacement":
            expect_same(rows, solution.displacement[numbers], f"{file.name}, displacements in Gmsh")
        elif name == "Stress" and kind == "ElementData":
            expect_same(rows[:, [0, 4, 8, 1, 5, 2]], solution.stress[numbers], f"{file.name}, stresses of cells in Gmsh")
        else:
            continue
        seen.add(name)
    assert seen == {"Displacement", "Stress"}, seen


def expect_vtk_has(reader, file, solution):
    reader.SetFileName(str(file))
    reader.Update()
    points = reader.GetOutput().GetPointData()
    found = np.full_like(solution.displacement, np.nan)
    found[vtk_to_numpy(points.GetArray("GlobalVertexId"))] = vtk_to_numpy(points.GetArray("Displacement"))
    expect_same(found, solution.displacement, f"{file.name} in VTK")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    kerf, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    solution = Solution(folder)
    for into, out in (([], "parts"), (["--into", "2"], "pieces")):
        subprocess.run([kerf, "export", folder, "--format", "vtu,msh,hdf5", "-o", out, "-q", *into], check=True)
        expect_vtk_has(vtk.vtkXMLPUnstructuredGridReader(), pathlib.Path(out) / "vtu/mesh.pvtu", solution)
        expect_vtk_has(vtk.vtkHDFReader(), pathlib.Path(out) / "hdf5/mesh.h5", solution)
        expect_gmsh_has(pathlib.Path(out) / "msh/mesh_2.msh", solution)
    for name, options in (("whole.vtu", []), ("whole.msh", []), ("old.msh", ["--msh-version", "2.2"]), ("whole.h5", [])):
        subprocess.run([kerf, "merge", folder, "-o", name, *options], check=True)
    for name in ("whole.msh", "old.msh"):
        expect_gmsh_has(pathlib.Path(name), solution)
    merged = meshio.read("whole.vtu")
    expect_same(merged.point_data["Displacement"], solution.displacement, "whole.vtu, displacements in meshio")
    expect_same(merged.cell_data_dict["Stress"]["tetra"], solution.stress, "whole.vtu, stresses of cells in meshio")
    with h5py.File("whole.h5") as file:
        expect_same(file["fields/vertices/Displacement"][()], solution.displacement, "whole.h5, displacements in h5py")
        expect_same(file["fields/cells/Stress"][()], solution.stress, "whole.h5, stresses of cells in h5py")


if __name__ == "__main__":
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    main()
