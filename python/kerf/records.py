"""Records that several modules make, and the native one, too. Nothing of the package is imported here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np


class Plane(NamedTuple):
    """A plane; `normal` has the length 1 and points to the half above."""

    point: np.ndarray
    normal: np.ndarray


@dataclass(frozen=True)
class SharedPoints:
    """Points that the same parts have."""

    parts: list[int]
    """Numbers in the tree of cuts, two or more; the first one owns the points."""
    points: np.ndarray
    """(n,) int32: rows of `points`, ascending by their global numbers: the same order in every one of the parts."""


@dataclass(frozen=True)
class Neighbour:
    """Another rank that has some of the same points. Everything is in the same order on both sides."""

    rank: int
    #: (s,) int64: rows of the local points, ascending by their global numbers.
    points: np.ndarray
    #: (t, 3) int64: faces between cells of both, rows of the local points, counter-clockwise seen from the other side.
    triangles: np.ndarray
    #: (t,) int64: rows of the local tetrahedra that have these faces.
    cells: np.ndarray
