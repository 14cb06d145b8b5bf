"""What a mesh on ranks must be, told by the whole mesh: laws.py WHOLE.npz FOLDER, on 3"""

import sys

import numpy as np
import two_boxes
from compared import OPTIONS
from mpi4py import MPI

import kerf

comm = MPI.COMM_WORLD
whole = np.load(sys.argv[1])
FACES = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]


def sorted_rows(rows):
    return rows[np.lexsort(rows.T[::-1])]


def rows_of_triangles(corners, patch, sides):
    """With patch and sides, turned so that the smallest corner is first, as seen from the smaller of two regions."""
    corners, sides = corners.copy(), sides.copy()
    is_turned = (sides[:, 1] >= 0) & (sides[:, 1] < sides[:, 0])
    corners[is_turned] = corners[is_turned][:, ::-1]
    sides[is_turned] = sides[is_turned][:, ::-1]
    first = corners.argmin(axis=1)
    corners = np.take_along_axis(corners, (first[:, None] + np.arange(3)) % 3, axis=1)
    return sorted_rows(np.column_stack([corners, patch, sides]))


def check_local_arrays(mesh):
    local = mesh.local
    assert np.array_equal(local.points, whole["points"][local.global_points])
    assert np.array_equal(local.global_points[local.tetrahedra], whole["tetrahedra"][local.global_cells])
    assert np.array_equal(local.part, whole["part"][local.global_cells])
    assert np.array_equal(local.region, whole["region"][local.global_cells])
    assert len(np.unique(local.global_points)) == len(local.points)
    assert (mesh.point_count, mesh.cell_count) == (len(whole["points"]), len(whole["tetrahedra"]))
    assert mesh.comm.allreduce(len(local.tetrahedra)) == mesh.cell_count
    assert mesh.patch_names == ["left", "right", "wall", "around"] and mesh.region_names == ["steel", "glass"]


def check_triangles(mesh):
    local = mesh.local
    corners, mine = local.global_points[local.triangles], local.triangle_owner == mesh.comm.rank
    all_rows = rows_of_triangles(whole["triangles"], whole["patch"], whole["sides"])
    counted = rows_of_triangles(corners[mine], local.patch[mine], local.sides[mine])
    assert np.array_equal(sorted_rows(np.concatenate(mesh.comm.allgather(counted))), all_rows)
    faces = np.sort(local.global_points[local.tetrahedra][:, FACES].reshape(-1, 3), axis=1)
    is_here = {tuple(face) for face in faces}
    here = [row for row in all_rows if tuple(sorted(row[:3])) in is_here]
    assert np.array_equal(rows_of_triangles(corners, local.patch, local.sides), here or np.empty((0, 6)))
    cells = local.tetrahedra[local.cell_behind]
    assert (cells[:, :, None] == local.triangles[:, None, :]).any(axis=1).all(), "they are faces of the cells behind"
    assert np.array_equal(local.region[local.cell_behind], local.sides[:, 0])


def check_neighbours(mesh):
    local, comm = mesh.local, mesh.comm
    held = comm.allgather(local.global_points)
    for rank in range(comm.size):
        shared = np.intersect1d(held[rank], local.global_points)
        told = [each.points for each in mesh.neighbours if each.rank == rank]
        assert len(told) == (rank != comm.rank and len(shared) > 0)
        assert not told or np.array_equal(local.global_points[told[0]], shared), "ascending, on both sides"
    holders = np.array([np.isin(local.global_points, each) for each in held])
    assert np.array_equal(local.owner, holders.argmax(axis=0)), "the first that has it"
    assert np.array_equal(mesh.sum_over_ranks(np.ones(len(local.points))), holders.sum(axis=0))
    owners = mesh.from_owners(np.full((len(local.points), 2), comm.rank))
    assert np.array_equal(owners, np.column_stack([local.owner] * 2))


def check_interfaces(mesh):
    local = mesh.local
    told = mesh.comm.allgather({each.rank: local.global_points[each.triangles] for each in mesh.neighbours})
    rank_of = np.zeros(mesh.cell_count, int)
    for rank, cells in enumerate(mesh.comm.allgather(local.global_cells)):
        rank_of[cells] = rank
    own, other = faces_between(rank_of, mesh.comm.rank)
    assert sum(len(each.triangles) for each in mesh.neighbours) == len(own)
    for each in mesh.neighbours:
        ours, theirs = told[mesh.comm.rank][each.rank], told[each.rank][mesh.comm.rank]
        assert np.array_equal(np.sort(ours), np.sort(theirs)), "the same order on both sides"
        assert np.array_equal(np.sort(local.global_cells[each.cells]), np.sort(own[rank_of[other] == each.rank]))
        cells = local.tetrahedra[each.cells]
        assert (cells[:, :, None] == each.triangles[:, None, :]).any(axis=1).all()


def faces_between(rank_of, rank):
    """Cells of this rank and those of others at faces that they have in common."""
    faces = np.sort(np.concatenate([whole["tetrahedra"][:, face] for face in FACES]), axis=1)
    cells = np.tile(np.arange(len(rank_of)), 4)
    order = np.lexsort(faces.T)
    faces, cells = faces[order], cells[order]
    first = np.flatnonzero((faces[1:] == faces[:-1]).all(axis=1))
    pairs = np.column_stack([cells[first], cells[first + 1]])
    pairs = np.concatenate([pairs, pairs[:, ::-1]])
    return pairs[(rank_of[pairs[:, 0]] == rank) & (rank_of[pairs[:, 1]] != rank)].T


def check_rows(mesh):
    rows, comm = mesh.rows(), mesh.comm
    own = rows.of_points[mesh.local.owner == comm.rank]
    assert np.array_equal(own, np.arange(rows.first, rows.last))
    pairs = np.concatenate(comm.allgather(np.column_stack([mesh.local.global_points, rows.of_points])))
    assert len(np.unique(pairs, axis=0)) == len(np.unique(pairs[:, 1])) == mesh.point_count


def check_ghosts(mesh):
    local, ghosts = mesh.local, mesh.ghost_cells()
    near = np.isin(whole["tetrahedra"], local.global_points).any(axis=1)
    near[local.global_cells] = False
    assert np.array_equal(ghosts.global_cells, np.flatnonzero(near))
    numbers = np.concatenate([local.global_points, ghosts.global_points])
    assert np.array_equal(numbers[ghosts.tetrahedra], whole["tetrahedra"][near])
    assert np.array_equal(ghosts.region, whole["region"][near])
    assert np.array_equal(ghosts.points, whole["points"][ghosts.global_points])
    cells = mesh.comm.allgather(local.global_cells)
    assert all(np.isin(number, cells[rank]) for number, rank in zip(ghosts.global_cells, ghosts.owner))


def check(mesh):
    for law in (check_local_arrays, check_triangles, check_neighbours, check_interfaces, check_rows, check_ghosts):
        law(mesh)


check(kerf.mesh(two_boxes.surface(), comm=comm, output=sys.argv[2] + "/all", **OPTIONS))
# Two communicators at once, in another order: of three ranks one is alone.
half = comm.Split(comm.rank % 2, -comm.rank)
check(kerf.mesh(two_boxes.surface(), comm=half, output=f"{sys.argv[2]}/{half.size}", **OPTIONS))
check(kerf.distributed(sys.argv[2] + "/all", half))
half.Free()
