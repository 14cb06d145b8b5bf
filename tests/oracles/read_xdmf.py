"""Reads mesh.xdmf of runs with DOLFINx, mesh and tags of triangles and cells, and mesh.h5 with PETSc's DMPlex, and
compares with the surface and the report. May run as several processes.

usage: [mpirun -n P] python3 read_xdmf.py NAME...

The run is in the folder NAME, its surface is NAME.stl, the files to read are mesh.xdmf and mesh.h5 of its export. Prints
a line of JSON for each; the exit code is 1 if a law does not hold.
"""

import json
import sys

import h5py
import numpy as np
from dolfinx.io import XDMFFile
from hdf5_laws import Broken, Expected, require, same, tet_volumes, triangle_areas
from mpi4py import MPI
from petsc4py import PETSc

comm = MPI.COMM_WORLD


def owned_tags(mesh, tags, dim):
    """Entities of this process with their values."""
    own = tags.indices < mesh.topology.index_map(dim).size_local
    return tags.indices[own], tags.values[own]


def corners_of(mesh, dim, count):
    """Rows of mesh.geometry.x at the corners of the first entities, ghosts included."""
    nodes = mesh.geometry.dofmap.array.reshape(-1, 4)
    node_of = np.empty(nodes.max() + 1, dtype=int)
    node_of[mesh.topology.connectivity(3, 0).array.reshape(-1, 4)] = nodes
    return node_of[mesh.topology.connectivity(dim, 0).array.reshape(-1, dim + 1)[:count]]


def check_plex(name, expected):
    viewer = PETSc.Viewer().createHDF5(name + "/export/hdf5/mesh.h5", "r", comm=comm)
    viewer.pushFormat(PETSc.Viewer.Format.HDF5_XDMF)
    plex = PETSc.DMPlex().create(comm)
    plex.load(viewer)
    plex.interpolate()
    first, end = plex.getHeightStratum(0)
    require(plex.getDimension() == 3, "DMPlex finds the dimension")
    require(comm.allreduce(end - first) == expected.tets, "DMPlex finds the tetrahedra")
    volume = sum(plex.computeCellGeometryFVM(cell)[0] for cell in range(first, end))
    require(same(comm.allreduce(volume), expected.volume), "DMPlex finds the volume")


def check_run(name):
    expected = Expected(name)
    with h5py.File(name + "/export/hdf5/mesh.h5", "r") as file:
        names = [each.decode() for each in file["viz/patch_names"][:]]
        triangles = len(file["viz/patch"])
        bodies = np.bincount(file["viz/body"][:])
    with XDMFFile(comm, name + "/export/hdf5/mesh.xdmf", "r") as file:
        mesh = file.read_mesh(name="mesh")
        mesh.topology.create_connectivity(2, 3)
        facet_tags = file.read_meshtags(mesh, name="facets")
        cell_tags = file.read_meshtags(mesh, name="mesh")
    cells = mesh.topology.index_map(3)
    require(cells.size_global == expected.tets, "DOLFINx finds the tetrahedra")
    require(mesh.topology.index_map(0).size_global == expected.vertices, "DOLFINx finds the vertices")
    points = mesh.geometry.x
    corners = corners_of(mesh, 3, cells.size_local)
    volume = comm.allreduce(np.abs(tet_volumes(points, corners)).sum())
    require(same(volume, expected.volume), "DOLFINx finds the volume")

    entities, values = owned_tags(mesh, facet_tags, 2)
    require(comm.allreduce(len(entities)) == triangles, "DOLFINx finds every triangle")
    corners = corners_of(mesh, 2, mesh.topology.index_map(2).size_local)[entities]
    areas = np.bincount(values - 1, weights=triangle_areas(points, corners), minlength=len(names))
    areas = comm.allreduce(areas)
    expected.check_areas({n: area for n, area in zip(names, areas) if area > 0}, "DOLFINx")

    entities, values = owned_tags(mesh, cell_tags, 3)
    for number, count in enumerate(bodies):
        require(comm.allreduce(int((values == number).sum())) == count, f"DOLFINx finds body {number}")
    check_plex(name, expected)
    return {"run": name, "processes": comm.size, "tets": expected.tets, "volume": volume}


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for name in sys.argv[1:]:
        try:
            result = check_run(name)
        except Broken as broken:
            print(json.dumps({"run": name, "broken_law": str(broken)}), flush=True)
            comm.Abort(1)
        if comm.rank == 0:
            print(json.dumps(result), flush=True)


if __name__ == "__main__":
    main()
