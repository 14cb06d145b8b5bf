"""The part of a distributed mesh that one rank has."""

from __future__ import annotations

import numpy as np

from . import _kerf


class LocalMesh:
    """Tetrahedra of one rank with all of their corners, the parts of a run one after the other; none where there are
    more ranks than parts. Its arrays are read-only views; nothing changes them."""

    def __init__(self, native: _kerf.RankMesh) -> None:
        self._native = native

    @property
    def points(self) -> np.ndarray:
        """(n, 3) float64."""
        return self._native.points

    @property
    def global_points(self) -> np.ndarray:
        """(n,) int64: numbers of the points in the whole mesh, the same for any number of ranks: rows of the `points`
        that kerf.mesh() gives without ranks."""
        return self._native.global_points

    @property
    def owner(self) -> np.ndarray:
        """(n,) int32: the rank that owns the point, the first of those that have it."""
        return self._native.owner

    @property
    def tetrahedra(self) -> np.ndarray:
        """(m, 4) int64: corners a, b, c, d as rows of `points`, with det[b-a, c-a, d-a] > 0."""
        return self._native.tetrahedra

    @property
    def first_cell(self) -> int:
        """The number of the first tetrahedron in the whole mesh; see `global_cells`."""
        return self._native.first_cell

    @property
    def global_cells(self) -> np.ndarray:
        """(m,) int64: numbers of the tetrahedra in the whole mesh, from `first_cell` on without gaps: rows of the
        `tetrahedra` that kerf.mesh() gives without ranks."""
        return np.arange(self.first_cell, self.first_cell + len(self.tetrahedra))

    @property
    def part(self) -> np.ndarray:
        """(m,) int32: the part of each tetrahedron, by its number in the tree of cuts."""
        return self._native.part

    @property
    def region(self) -> np.ndarray:
        """(m,) int32: rows of DistributedMesh.region_names, 0 if there is one region."""
        return self._native.region

    @property
    def triangles(self) -> np.ndarray:
        """(k, 3) int64: on patches, rows of `points`, counter-clockwise seen from outside of the tetrahedron behind.

        A wall between two regions has each triangle once, but on both ranks, each seen from its own side, where it lies
        between the parts of two; see `triangle_owner`. There are none between parts of one region.
        """
        return self._native.triangles

    @property
    def cell_behind(self) -> np.ndarray:
        """(k,) int64: rows of `tetrahedra` that have the triangles as faces."""
        return self._native.cell_behind

    @property
    def patch(self) -> np.ndarray:
        """(k,) int32: rows of DistributedMesh.patch_names."""
        return self._native.patch

    @property
    def sides(self) -> np.ndarray:
        """(k, 2) int32: the regions behind and in front of each triangle, -1: outside."""
        return self._native.sides

    @property
    def triangle_owner(self) -> np.ndarray:
        """(k,) int32: the rank that counts the triangle. Sums over those of the own rank have each triangle once."""
        return self._native.triangle_owner

    def __repr__(self) -> str:
        return f"<kerf.LocalMesh: {len(self.points)} points, {len(self.tetrahedra)} tetrahedra>"
