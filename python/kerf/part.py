"""Parts of a mesh in a folder."""

from __future__ import annotations

from collections.abc import Sequence as AbstractSequence
from dataclasses import dataclass
from typing import Iterator, Sequence, Union, overload

import numpy as np

from . import _kerf


@dataclass(frozen=True)
class SharedPoints:
    """Points that the same parts have."""

    parts: list[int]
    """Numbers in the tree of cuts, two or more; the first one owns the points."""
    points: np.ndarray
    """(n,) int32: rows of `points`, ascending by their global numbers: the same order in every one of the parts."""


class Part:
    """The mesh of one part, and how it belongs to the whole. Its arrays are read-only views; nothing changes them.

    Triangles lie on the surface, or where another part has the same triangle, turned, over the same global numbers: on
    an interface, or on a wall between two regions.
    """

    def __init__(self, native: _kerf.Part) -> None:
        self._native = native

    @property
    def number(self) -> int:
        """In the tree of cuts: the root is 1, the children of i are 2i and 2i + 1."""
        return self._native.number

    @property
    def points(self) -> np.ndarray:
        """(n, 3) float64; those of the triangles come first, and of order 2 the nodes on edges behind all corners."""
        return self._native.points

    @property
    def order(self) -> int:
        """Of the cells: 1 or 2."""
        return self._native.order

    @property
    def tetra10(self) -> np.ndarray:
        """(m, 10) int32 of order 2, else (0, 10): rows of `points` as Mesh.tetra10 has them; made at each call."""
        return self._native.tetra10

    @property
    def triangle6(self) -> np.ndarray:
        """(k, 6) int32 of order 2, else (0, 6): as Mesh.triangle6 has them; made at each call."""
        return self._native.triangle6

    @property
    def boundary_points(self) -> int:
        """How many corners the triangles have."""
        return self._native.boundary_points

    @property
    def global_ids(self) -> np.ndarray:
        """(n,) int64: numbers of the points in the whole mesh, from 0, equal in all parts that have the point."""
        return self._native.global_ids

    @property
    def owner(self) -> np.ndarray:
        """(n,) int32: the number of the part that owns each point: the first in `run.parts` that has it."""
        return self._native.owner

    @property
    def tetrahedra(self) -> np.ndarray:
        """(m, 4) int32: corners a, b, c, d as rows of `points`, with det[b-a, c-a, d-a] > 0."""
        return self._native.tetrahedra

    @property
    def region(self) -> np.ndarray:
        """(m,) int32: rows of `region_names`, 0 if there is one region."""
        return self._native.region

    @property
    def triangles(self) -> np.ndarray:
        """(k, 3) int32: corners as rows of `points`, counter-clockwise seen from outside of the part."""
        return self._native.triangles

    @property
    def patch(self) -> np.ndarray:
        """(k,) int32: rows of `patch_names`, -1 on interfaces."""
        return self._native.patch

    @property
    def neighbour(self) -> np.ndarray:
        """(k,) int32: the number of the part behind an interface or a wall, -1 on the outer boundary."""
        return self._native.neighbour

    @property
    def facet(self) -> np.ndarray:
        """(k,) int32: the triangle of the surface that it is or lies in, -1 on interfaces."""
        return self._native.facet

    @property
    def tetrahedron(self) -> np.ndarray:
        """(k,) int32: the row of `tetrahedra` behind each triangle."""
        return self._native.behind

    @property
    def shared(self) -> list[SharedPoints]:
        """All points that other parts have, too: what ghosts and exchanges are made of."""
        return [SharedPoints(parts, points) for parts, points in self._native.shared]

    @property
    def point_data(self) -> dict[str, np.ndarray]:
        """Of a solution: (n,) or (n, components) floats by name, as "Displacement"; else empty."""
        return self._native.point_data

    @property
    def cell_data(self) -> dict[str, np.ndarray]:
        """Of a solution: (m,) or (m, components) floats by name, as "Stress"; else empty."""
        return self._native.cell_data

    @property
    def patch_names(self) -> list[str]:
        """Names of the patches, in the order of their numbers."""
        return self._native.patch_names

    @property
    def region_names(self) -> list[str]:
        """Empty if there is one region."""
        return self._native.region_names

    def __repr__(self) -> str:
        return f"<kerf.Part {self.number}: {len(self.points)} points, {len(self.tetrahedra)} tetrahedra>"


class Parts(AbstractSequence):
    """The parts of a run in the order of the tree of cuts. Each is read when it is asked for, and kept by nobody else:
    parts[i] twice reads twice. A slice reads nothing."""

    def __init__(self, native: _kerf.Run, rows: Sequence[int]) -> None:
        self._native = native
        self._rows = rows

    @property
    def numbers(self) -> np.ndarray:
        """(k,) int32: of the parts in the tree of cuts."""
        return self._native.numbers[list(self._rows)]

    @property
    def tetrahedra_counts(self) -> np.ndarray:
        """(k,) int64: of the parts, without reading them."""
        return self._native.tetrahedra[list(self._rows)]

    def numbered(self, number: int) -> Part:
        """The part with a number in the tree of cuts, as `neighbour` has them. Raises KeyError if there is none."""
        found = np.flatnonzero(self.numbers == number)
        if len(found) == 0:
            raise KeyError(f"There is no part {number}; the numbers are {', '.join(map(str, self.numbers))}.")
        return self[int(found[0])]

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, index: int) -> Part: ...

    @overload
    def __getitem__(self, index: slice) -> Parts: ...

    def __getitem__(self, index: Union[int, slice]) -> Union[Part, Parts]:
        if isinstance(index, slice):
            return Parts(self._native, self._rows[index])
        try:
            row = self._rows[index]
        except IndexError:
            raise IndexError(f"There is no part [{index}]: there are {len(self)}.") from None
        return Part(self._native.load(row))

    def __iter__(self) -> Iterator[Part]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<kerf.Parts: {len(self)}, {int(self.tetrahedra_counts.sum())} tetrahedra>"
