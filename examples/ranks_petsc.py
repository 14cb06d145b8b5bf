"""Heat through two materials on a DMPlex of PETSc that is never on one rank: mpirun -n 4 python3 ranks_petsc.py"""

import kerf
import numpy as np
import two_boxes
from mpi4py import MPI
from petsc4py import PETSc


def plex_of(distributed):
    """The same cells on the same ranks, with labels "region" and "patch" that hold rows of the names."""
    local, comm = distributed.local, distributed.comm
    cells, points = len(local.tetrahedra), len(local.points)
    plex = PETSc.DMPlex().create(comm)
    plex.setDimension(3)
    plex.setChart(0, cells + points)  # vertices follow the cells
    for cell in range(cells):
        plex.setConeSize(cell, 4)
    plex.setUp()
    for cell, corners in enumerate(cells + local.tetrahedra[:, [1, 0, 2, 3]].astype(PETSc.IntType)):
        plex.setCone(cell, corners)  # as PETSc orients them
    plex.symmetrize()
    plex.stratify()
    add_coordinates(plex, local.points)
    # Who does not own a vertex says which it is on the owner's side.
    there = distributed.from_owners(cells + np.arange(points))
    others = np.flatnonzero(local.owner != comm.rank)
    star_forest = PETSc.SF().create(comm)
    star_forest.setGraph(cells + points, (cells + others).astype(PETSc.IntType),
                         np.column_stack([local.owner[others], there[others]]).astype(PETSc.IntType))
    plex.setPointSF(star_forest)
    plex.interpolate()
    add_labels(plex, local)
    return plex


def add_coordinates(plex, points):
    first, last = plex.getDepthStratum(0)
    section = plex.getCoordinateSection()
    section.setNumFields(1)
    section.setFieldComponents(0, 3)
    section.setChart(first, last)
    for vertex in range(first, last):
        section.setDof(vertex, 3)
        section.setFieldDof(vertex, 0, 3)
    section.setUp()
    coordinates = PETSc.Vec().createSeq(3 * len(points), bsize=3)
    coordinates.array[:] = points.ravel()
    plex.setCoordinatesLocal(coordinates)


def add_labels(plex, local):
    first, last = plex.getDepthStratum(0)
    plex.createLabel("region")
    for cell, region in enumerate(local.region):
        plex.setLabelValue("region", cell, region)
    plex.createLabel("patch")
    for corners, cell, patch in zip(local.triangles, local.cell_behind, local.patch):
        for face in plex.getCone(cell):
            closure = plex.getTransitiveClosure(face)[0]
            if set(closure[(closure >= first) & (closure < last)] - first) == set(corners):
                plex.setLabelValue("patch", face, patch)


def owned_in(plex, first, last):
    """Points of the plex in [first, last) that this rank owns."""
    return first + np.flatnonzero(plex.createPointNumbering().indices[first:last] >= 0)


def measures(distributed, plex):
    """Sums over all ranks: volume of each region and area of each patch, by their names."""
    comm, sums = distributed.comm, {}
    for name in ("region", "patch"):
        kind = 3 if name == "region" else 2
        names = distributed.region_names if name == "region" else distributed.patch_names
        own = owned_in(plex, *plex.getDepthStratum(kind))
        for number, each in enumerate(names):
            size = sum(plex.computeCellGeometryFVM(point)[0]
                       for point in own if plex.getLabelValue(name, point) == number)
            sums[each] = comm.allreduce(size)
    return sums


def stiffness(local, conductivity):
    """(m, 4, 4) of linear tetrahedra."""
    corners = local.points[local.tetrahedra]
    edges = corners[:, 1:] - corners[:, :1]
    gradients = np.linalg.inv(edges).transpose(0, 2, 1)
    gradients = np.concatenate([-gradients.sum(axis=1, keepdims=True), gradients], axis=1)
    volumes = np.linalg.det(edges) / 6
    return np.einsum("m,mik,mjk->mij", conductivity * volumes, gradients, gradients)


def held_points(distributed, plex):
    """Local points of the patches that hold the temperature, as PETSc's label tells, and their temperatures."""
    first, last = plex.getDepthStratum(0)
    count, degrees = np.zeros(last - first), np.zeros(last - first)
    for name, value in (("left", 0), ("right", 4)):
        number = distributed.patch_names.index(name)
        for face in plex.getStratumIS("patch", number).indices if plex.getStratumSize("patch", number) else []:
            closure = plex.getTransitiveClosure(face)[0]
            points = closure[(closure >= first) & (closure < last)] - first
            count[points], degrees[points] = 1, value
    # A rank may have such a point, but no face there.
    count, degrees = distributed.sum_over_ranks(count), distributed.sum_over_ranks(degrees)
    held = np.flatnonzero(count).astype(PETSc.IntType)
    return held, degrees[held] / count[held]


def temperatures(distributed, plex):
    """Of the local points."""
    local = distributed.local
    plex.setNumFields(1)
    plex.setSection(plex.createSection([1], [1, 0, 0, 0]))
    matrix, right = plex.createMatrix(), plex.createGlobalVector()
    of_region = np.array([two_boxes.CONDUCTIVITY[name] for name in distributed.region_names])
    corners = local.tetrahedra.astype(PETSc.IntType)
    matrix.setValuesLocalRCV(corners, corners, stiffness(local, of_region[local.region]),
                             PETSc.InsertMode.ADD_VALUES)
    matrix.assemble()
    solution = right.duplicate()
    held, degrees = held_points(distributed, plex)
    prescribed = plex.createLocalVector()
    prescribed.array[held] = degrees
    plex.localToGlobal(prescribed, solution, PETSc.InsertMode.INSERT_VALUES)
    matrix.zeroRowsColumnsLocal(held, 1, solution, right)
    solver = PETSc.KSP().create(distributed.comm)
    solver.setOperators(matrix)
    solver.setType("cg")
    solver.setTolerances(rtol=1e-12)
    solver.solve(right, solution)
    local_solution = plex.createLocalVector()
    plex.globalToLocal(solution, local_solution)
    return local_solution.array.copy()


def solve(comm):
    """Points and cells of all ranks, measures by names, and the largest error of a temperature."""
    distributed = kerf.mesh(two_boxes.surface(), parts=6, size=0.4, comm=comm)
    plex = plex_of(distributed)
    counts = [comm.allreduce(len(owned_in(plex, *plex.getDepthStratum(depth)))) for depth in (0, 3)]
    assert counts == [distributed.point_count, distributed.cell_count]
    error = np.abs(temperatures(distributed, plex) - two_boxes.temperature(distributed.local.points)).max()
    return counts, measures(distributed, plex), comm.allreduce(error, MPI.MAX)


if __name__ == "__main__":
    counts, sizes, error = solve(MPI.COMM_WORLD)
    if MPI.COMM_WORLD.rank == 0:
        print(f"{counts[1]} tetrahedra on {MPI.COMM_WORLD.size} ranks; largest error {error:.1e}")
        print(", ".join(f"{name}: {size:.3f}" for name, size in sizes.items()))
