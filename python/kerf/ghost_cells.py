"""Cells of other ranks around those of one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Dict, List

import numpy as np

from ._kerf import LocalMesh
from .ranks import swap
from .records import Neighbour

if TYPE_CHECKING:
    from mpi4py.MPI import Comm


@dataclass(frozen=True)
class GhostCells:
    """The cells of other ranks that share a point with a cell of this one, ascending by their numbers."""

    #: (g, 4) int64: corners, rows of the local points and then of `points`: `np.vstack([mesh.local.points, points])`.
    tetrahedra: np.ndarray
    #: (g,) int64: numbers in the whole mesh.
    global_cells: np.ndarray
    #: (g,) int32: the rank that has the cell.
    owner: np.ndarray
    #: (g,) int32: rows of DistributedMesh.region_names, 0 if there is one region.
    region: np.ndarray
    #: (p, 3) float64: corners that this rank has not, ascending by `global_points`.
    points: np.ndarray
    #: (p,) int64: their numbers in the whole mesh.
    global_points: np.ndarray
    #: (p,) int32: the rank that owns each of them.
    point_owner: np.ndarray


def ghost_cells_of(comm: Comm, local: LocalMesh, neighbours: List[Neighbour]) -> GhostCells:
    """Collective. A cell travels once to each rank that it touches, with its corners."""
    cells = _cells_for_neighbours(local, neighbours)
    rows = {rank: np.unique(local.tetrahedra[own]) for rank, own in cells.items()}
    told = {rank: np.column_stack([local.global_cells[own], local.region[own],
                                   local.global_points[local.tetrahedra[own]]]) for rank, own in cells.items()}
    numbers = {rank: np.column_stack([local.global_points[own], local.owner[own]]) for rank, own in rows.items()}
    told = swap(comm, told, np.empty((0, 6), np.int64))
    numbers = swap(comm, numbers, np.empty((0, 2), np.int64))
    points = swap(comm, {rank: local.points[own] for rank, own in rows.items()}, np.empty((0, 3)))
    owner = np.repeat(np.array(sorted(told), np.int32), [len(told[rank]) for rank in sorted(told)])
    return _assembled(local, neighbours, _rows_of_all(told, 6, np.int64), owner, _rows_of_all(numbers, 2, np.int64),
                      _rows_of_all(points, 3, np.float64))


def _cells_for_neighbours(local: LocalMesh, neighbours: List[Neighbour]) -> Dict[int, np.ndarray]:
    """The own cells that touch each neighbour."""
    tetrahedra, cells = local.tetrahedra, {}
    is_shared = np.zeros(len(local.points), bool)
    for neighbour in neighbours:
        is_shared[neighbour.points] = True
    near = np.flatnonzero(is_shared[tetrahedra].any(axis=1))
    for neighbour in neighbours:
        is_shared[:] = False
        is_shared[neighbour.points] = True
        cells[neighbour.rank] = near[is_shared[tetrahedra[near]].any(axis=1)]
    return cells


def _rows_of_all(rows: Dict[int, np.ndarray], width: int, dtype: type) -> np.ndarray:
    none: List[np.ndarray] = [np.empty((0, width), dtype)]
    return np.concatenate(none + [rows[rank] for rank in sorted(rows)])


def _assembled(local: LocalMesh, neighbours: List[Neighbour], told: np.ndarray, owner: np.ndarray, numbers: np.ndarray,
               points: np.ndarray) -> GhostCells:
    """Of rows (cell, region, corners) and (point, owner), with coordinates, of which several ranks may tell."""
    known = np.unique(np.concatenate([np.empty(0, np.int64)] + [each.points for each in neighbours]))
    is_new = ~np.isin(numbers[:, 0], local.global_points[known])
    new, first = np.unique(numbers[is_new, 0], return_index=True)
    all_numbers = np.concatenate([local.global_points[known], new])
    all_rows = np.concatenate([known, len(local.points) + np.arange(len(new))])
    order = np.argsort(all_numbers)
    by_number = np.argsort(told[:, 0])
    told, owner = told[by_number], owner[by_number]
    corners = all_rows[order][np.searchsorted(all_numbers[order], told[:, 2:])]
    return GhostCells(corners, told[:, 0], owner, told[:, 1].astype(np.int32), points[is_new][first], new,
                      numbers[is_new, 1][first].astype(np.int32))
