"""Reads files with cells of order 2 with the programs of others, and compares their counts and the volume with the
report of the run, which has straight edges: the nodes of edges lie in their middles. Of a second run, whose edges are
curved, Gmsh and the readers of merged_formats.py find the volume that its report has.

usage: python3 read_second_order.py RUN CURVED_RUN

Read are whole.msh, old.msh, whole.mesh, whole.inp, parts/mesh_1.msh ..., hdf5/mesh.h5 and hdf5/mesh.xdmf in the current
folder, CURVED_RUN/export/msh, and CURVED_RUN.vtk and so on. Prints a line of JSON; the exit code is 1 if a law does not hold.
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
from dolfinx.io import XDMFFile
from mpi4py import MPI
from petsc4py import PETSc
from vtk.util.numpy_support import vtk_to_numpy

# The edges of the nodes behind the corners.
OF_VTK = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
OF_DOLFINX = ((2, 3), (1, 3), (1, 2), (0, 3), (0, 2), (0, 1))
OF_VTK_TRIANGLE = ((0, 1), (1, 2), (0, 2))
VTK_QUADRATIC_TRIANGLE, VTK_QUADRATIC_TETRA = 22, 24


class Broken(Exception):
    pass


def require(holds, law):
    if not holds:
        raise Broken(law)


def require_middles(points, cells, edges, path):
    corners = cells.shape[1] - len(edges)
    for k, (a, b) in enumerate(edges):
        middles = (points[cells[:, a]] + points[cells[:, b]]) / 2
        require(np.allclose(points[cells[:, corners + k]], middles, rtol=0, atol=1e-12), f"{path} has node {k} there")


def volume(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return float((np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6).sum())


class Expected:
    def __init__(self, run):
        report = json.loads((pathlib.Path(run) / "report.json").read_text())
        self.tets, self.vertices = report["totals"]["tets"], report["totals"]["vertices"]
        self.volume = 1.0 * 2 * 3  # of the box
        self.facets = None
        self.nodes = None

    def check(self, path, points, tets, triangles=None):
        self.nodes = self.nodes or len(points)
        require(len(points) == self.nodes > self.vertices, f"{path} has the nodes")
        require(len(tets) == self.tets, f"{path} has the tetrahedra")
        require_middles(points, tets, OF_VTK, path)
        require(np.isclose(volume(points, tets), self.volume, rtol=1e-9), f"{path} has the volume")
        if triangles is not None:
            self.facets = self.facets or len(triangles)
            require(len(triangles) == self.facets, f"{path} has the triangles")
            require_middles(points, triangles, OF_VTK_TRIANGLE, path)


def read_by_gmsh(path):
    """Nodes, volume by integration, and the least scaled Jacobian that Gmsh finds."""
    gmsh.clear()
    gmsh.logger.start()
    gmsh.open(str(path))
    complaints = [text for text in gmsh.logger.get() if not text.startswith(("Info", "Progress"))]
    gmsh.logger.stop()
    require(not complaints, f"Gmsh reads {path} without {complaints[:1]}")
    nodes = len(gmsh.model.mesh.getNodes()[0])
    total, cells, triangles = 0.0, 0, 0
    at, weights = gmsh.model.mesh.getIntegrationPoints(11, "Gauss4")
    for dimension, tag in gmsh.model.getEntities():
        if gmsh.model.getType(dimension, tag) == "Ghost volume":
            continue
        types, elements, _ = gmsh.model.mesh.getElements(dimension, tag)
        require(set(types) <= {9, 11}, f"elements of {path} are of order 2")
        if 9 in types:
            triangles += len(elements[0])
        if 11 in types:
            cells += len(elements[0])
            determinants = gmsh.model.mesh.getJacobians(11, at, tag)[1].reshape(-1, len(weights))
            require(determinants.min() > 0, f"Gmsh finds no inverted cell in {path}")
            total += float((determinants @ weights).sum())
    for name, value in (("JacobianDeterminant", 1), ("CreateView", 1), ("DimensionOfElements", 3), ("Recompute", 1)):
        gmsh.plugin.setNumber("AnalyseMeshQuality", name, value)
    gmsh.plugin.run("AnalyseMeshQuality")
    least = min(np.concatenate(gmsh.view.getModelData(tag, 0)[2]).min() for tag in gmsh.view.getTags())
    for tag in gmsh.view.getTags():
        gmsh.view.remove(tag)
    return nodes, cells, triangles, total, float(least)


def check_curved(run):
    """The determinants of the Jacobians of curved cells are polynomials that Gmsh's rule integrates exactly."""
    report = json.loads((pathlib.Path(run) / "report.json").read_text())
    parts = [read_by_gmsh(path) for path in sorted((pathlib.Path(run) / "export/msh").glob("*.msh"))]
    require(report["curve"]["curved_edges"] > 0, f"{run} has curved edges")
    require(sum(part[1] for part in parts) == report["totals"]["tets"], f"Gmsh counts the tetrahedra of {run}")
    expected = report["totals"]["volume"] + report["curve"]["volume_gain"]
    require(np.isclose(sum(part[3] for part in parts), expected, rtol=1e-9), f"Gmsh finds the volume of {run}")
    for ending in merged_formats.ENDINGS:
        mesh = merged_formats.read(f"{run}.{ending}")
        require(mesh.nodes > report["totals"]["vertices"] and len(mesh.tets) == report["totals"]["tets"],
                f"{run}.{ending} has the nodes and the tetrahedra")
        require(np.isclose(mesh.volume(), expected, rtol=1e-12), f"{run}.{ending} has the volume, with no cell inverted")
        middles = (mesh.triangles[:, [0, 1, 2]] + mesh.triangles[:, [1, 2, 0]]) / 2
        off = np.linalg.norm(mesh.triangles[:, 3:] - middles, axis=2)
        longest = np.linalg.norm(mesh.triangles[:, [0, 1, 2]] - mesh.triangles[:, [1, 2, 0]], axis=2)
        require(np.all(off < 0.2 * longest), f"{run}.{ending} has the nodes of triangles near their edges")
    least = min(part[4] for part in parts)
    require(0 < least < 1, f"Gmsh finds curved cells in {run}, all of them valid")
    return least


def check_gmsh(expected):
    least = 1.0
    for path in ("whole.msh", "old.msh", "whole.mesh"):
        nodes, cells, triangles, total, of_file = read_by_gmsh(path)
        require((nodes, cells, triangles) == (expected.nodes, expected.tets, expected.facets), f"Gmsh counts {path}")
        require(np.isclose(total, expected.volume, rtol=1e-9), f"Gmsh finds the volume of {path}")
        least = min(least, of_file)
    parts = [read_by_gmsh(path) for path in sorted(pathlib.Path("parts").glob("mesh_*.msh"))]
    require(sum(part[1] for part in parts) == expected.tets, "Gmsh counts the tetrahedra of the parts")
    require(sum(part[2] for part in parts) == expected.facets, "Gmsh counts the triangles of the parts")
    total = sum(part[3] for part in parts)
    require(np.isclose(total, expected.volume, rtol=1e-9), "Gmsh finds the volume of the parts")
    least = min([least] + [part[4] for part in parts])
    require(least > 0, "Gmsh finds positive scaled Jacobians")
    return least


def check_meshio(expected):
    for path in ("whole.msh", "old.msh", "whole.inp"):
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            mesh = meshio.read(path)
        tets = np.concatenate([block.data for block in mesh.cells if block.type == "tetra10"])
        triangles = [block.data for block in mesh.cells if block.type == "triangle6"]
        expected.check(path, mesh.points, tets, np.concatenate(triangles) if triangles else None)
        if path.endswith(".inp"):
            on_patches = np.unique(np.concatenate(list(mesh.point_sets.values())))
            require(len(on_patches) == 2 * expected.facets + 2, "node sets have the nodes of edges")


def check_vtk(expected):
    reader = vtk.vtkHDFReader()
    reader.SetFileName("hdf5/mesh.h5")
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    first = vtk_to_numpy(grid.GetCells().GetOffsetsArray())[:-1]
    types = vtk_to_numpy(grid.GetCellTypesArray())
    ids = vtk_to_numpy(grid.GetPointData().GetArray("GlobalVertexId"))
    require(np.array_equal(np.unique(ids), np.arange(expected.nodes)), "VTK finds the nodes of mesh.h5")
    tets = corners[first[types == VTK_QUADRATIC_TETRA][:, None] + np.arange(10)]
    triangles = corners[first[types == VTK_QUADRATIC_TRIANGLE][:, None] + np.arange(6)]
    require((len(tets), len(triangles)) == (expected.tets, expected.facets), "VTK finds the cells of mesh.h5")
    require_middles(points, tets, OF_VTK, "mesh.h5")
    require_middles(points, triangles, OF_VTK_TRIANGLE, "mesh.h5")


def check_dolfinx(expected):
    with XDMFFile(MPI.COMM_WORLD, "hdf5/mesh.xdmf", "r") as file:
        mesh = file.read_mesh(name="mesh")
        mesh.topology.create_connectivity(2, 3)
        facets = file.read_meshtags(mesh, name="facets")
        bodies = file.read_meshtags(mesh, name="mesh")
    require(mesh.geometry.cmap.degree == 2, "DOLFINx finds cells of order 2")
    require(mesh.topology.index_map(0).size_global == expected.vertices, "DOLFINx finds the vertices")
    require(mesh.geometry.index_map().size_global == expected.nodes, "DOLFINx finds the nodes")
    require(len(facets.indices) == expected.facets, "DOLFINx finds the triangles")
    require(len(bodies.indices) == expected.tets, "DOLFINx finds the tetrahedra")
    require_middles(mesh.geometry.x, mesh.geometry.dofmap.array.reshape(-1, 10), OF_DOLFINX, "mesh.xdmf")


def check_petsc(expected):
    viewer = PETSc.Viewer().createHDF5("hdf5/mesh.h5", "r", comm=MPI.COMM_WORLD)
    viewer.pushFormat(PETSc.Viewer.Format.HDF5_XDMF)
    plex = PETSc.DMPlex().create(MPI.COMM_WORLD)
    plex.load(viewer)
    plex.interpolate()
    first, end = plex.getHeightStratum(0)
    require(end - first == expected.tets, "DMPlex finds the tetrahedra")
    total = sum(plex.computeCellGeometryFVM(cell)[0] for cell in range(first, end))
    require(np.isclose(total, expected.volume, rtol=1e-9), "DMPlex finds the volume of the corners")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    expected = Expected(sys.argv[1])
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    try:
        check_meshio(expected)
        least = check_gmsh(expected)
        check_vtk(expected)
        check_dolfinx(expected)
        check_petsc(expected)
        of_curved = check_curved(sys.argv[2])
    except (Broken, merged_formats.Unfit) as broken:
        print(json.dumps({"broken_law": str(broken)}))
        sys.exit(1)
    print(json.dumps({"nodes": expected.nodes, "tets": expected.tets, "least_jacobians": [least, of_curved]}))


if __name__ == "__main__":
    main()
