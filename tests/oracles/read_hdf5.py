"""Reads mesh.h5 of runs with h5py and with VTK's own reader, and compares with the surface and the report.

usage: python3 read_hdf5.py NAME...

The run is in the folder NAME, its surface is NAME.stl, the files to read are mesh.h5 and mesh.xdmf of its export. Prints a
line of JSON for each; the exit code is 1 if a law does not hold.
"""

import json
import sys
import xml.etree.ElementTree

import h5py
import numpy as np
import vtk
from hdf5_laws import Broken, Expected, areas_by_patch, require, same, tet_volumes
from vtk.util.numpy_support import vtk_to_numpy

TRIANGLE, TETRA = 5, 10


def check_whole(file, expected):
    """The arrays by global numbers."""
    points, cells, facets = file["geometry/vertices"][:], file["viz/topology/cells"][:], file["viz/topology/facets"][:]
    parts, patches, bodies = file["viz/part"][:], file["viz/patch"][:], file["viz/body"][:]
    names = [name.decode() for name in file["viz/patch_names"][:]]
    require(points.shape == (expected.vertices, 3), "there are the vertices of the report")
    require(cells.shape == (expected.tets, 4), "there are the tetrahedra of the report")
    require(np.array_equal(np.unique(cells), np.arange(len(points))), "cells name every vertex")
    require(np.isin(facets, cells).all(), "triangles name vertices of cells")
    volumes = tet_volumes(points, cells)
    require((volumes > 0).all() and same(volumes.sum(), expected.volume), "the volume is that of the surface")
    wanted = np.concatenate([np.full(tets, part, dtype=int) for part, tets, _ in expected.parts])
    require(np.array_equal(parts, wanted), "cells lie in the order of the parts")
    expected.check_areas(areas_by_patch(points, facets, patches - 1, names), "h5py")
    require(np.array_equal(np.unique(bodies), np.arange(1, bodies.max() + 1)), "bodies count from 1")
    vertices = [np.unique(cells[bodies == body]) for body in range(1, bodies.max() + 1)]
    require(sum(map(len, vertices)) == len(points), "bodies have no vertex in common")
    require(file["viz/topology/cells"].attrs["cell_dim"] == 3, "DMPlex finds the dimension of the cells")
    require(file["viz/topology/cells"].id.get_offset() is not None, "arrays are contiguous")
    return points, cells, facets, names


def check_pieces(file, expected, whole):
    """The pieces are the same mesh with the numbers of the parts."""
    points, cells, facets, _ = whole
    group = file["VTKHDF"]
    require(tuple(group.attrs["Version"]) == (1, 0), "the version is 1.0")
    require(group.attrs["Type"] == b"UnstructuredGrid", "the type is named")
    sizes = [group[name][:] for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds")]
    tets = np.array([tets for _, tets, _ in expected.parts])
    require(np.array_equal(sizes[0], [vertices for _, _, vertices in expected.parts]), "pieces have the parts' vertices")
    require(np.array_equal(sizes[2], 4 * tets + 3 * (sizes[1] - tets)), "pieces have tetrahedra and triangles")
    ids = group["PointData/GlobalVertexId"][:]
    require(np.array_equal(group["Points"][:], points[ids]), "points lie where their global numbers say")
    first = [np.concatenate([[0], np.cumsum(size)]) for size in sizes]
    found_cells, found_facets = [], []
    for piece, count in enumerate(tets):
        corners = group["Connectivity"][first[2][piece] : first[2][piece + 1]]
        own_ids = ids[first[0][piece] : first[0][piece + 1]]
        found_cells.append(own_ids[corners[: 4 * count].reshape(-1, 4)])
        found_facets.append(own_ids[corners[4 * count :].reshape(-1, 3)])
        offsets = group["Offsets"][first[1][piece] + piece : first[1][piece + 1] + piece + 1]
        steps = np.where(np.arange(sizes[1][piece]) < count, 4, 3)
        require(np.array_equal(offsets, np.concatenate([[0], np.cumsum(steps)])), "offsets are those of the cells")
    require(np.array_equal(np.concatenate(found_cells), cells), "pieces have the tetrahedra of the whole")
    require(np.array_equal(np.concatenate(found_facets), facets), "pieces have the triangles of the whole")


def check_vtk(path, expected, whole):
    complaints = []
    reader = vtk.vtkHDFReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: complaints.append(path))
    require(reader.CanReadFile(path), "VTK says that it can read the file")
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    require(not complaints and reader.GetErrorCode() == 0, "VTK reads the file")
    points = vtk_to_numpy(grid.GetPoints().GetData())
    types = vtk_to_numpy(grid.GetCellTypesArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    part, patch = (vtk_to_numpy(grid.GetCellData().GetArray(name)) for name in ("Part", "Patch"))
    tets, triangles = types == TETRA, types == TRIANGLE
    require(len(points) == sum(vertices for _, _, vertices in expected.parts), "VTK finds the points of all parts")
    require(tets.sum() == expected.tets and triangles.sum() == len(whole[2]), "VTK finds all cells")
    corners = connectivity[offsets[:-1][tets][:, None] + np.arange(4)]
    require(same(tet_volumes(points, corners).sum(), expected.volume), "VTK finds the volume")
    for number, count, _ in expected.parts:
        require((part[tets] == number).sum() == count, f"VTK finds the tetrahedra of part {number}")
    require((patch[tets] == -1).all(), "tetrahedra have no patch")
    corners = connectivity[offsets[:-1][triangles][:, None] + np.arange(3)]
    expected.check_areas(areas_by_patch(points, corners, patch[triangles], whole[3]), "VTK")


def check_names(path, names):
    found = xml.etree.ElementTree.parse(path).findall("Domain/Information")
    require([entry.get("Value") for entry in found] == names, "the XDMF file has the names")
    require([entry.get("Name") for entry in found] == [f"patch {i + 1}" for i in range(len(names))], "and their numbers")


def check_run(name):
    expected = Expected(name)
    path = name + "/export/hdf5/mesh.h5"
    with h5py.File(path, "r") as file:
        whole = check_whole(file, expected)
        check_pieces(file, expected, whole)
    check_names(name + "/export/hdf5/mesh.xdmf", whole[3])
    check_vtk(path, expected, whole)
    return {"run": name, "vertices": expected.vertices, "tets": expected.tets, "triangles": len(whole[2])}


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for name in sys.argv[1:]:
        try:
            print(json.dumps(check_run(name)))
        except Broken as broken:
            print(json.dumps({"run": name, "broken_law": str(broken)}))
            sys.exit(1)


if __name__ == "__main__":
    main()
