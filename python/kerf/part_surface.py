"""Closed surfaces of the parts of a tree of cuts."""

from __future__ import annotations

import numpy as np

from . import _kerf
from .surface import Surface


class PartSurface:
    """The closed surface of a part: what is left of the surface that was cut, and its sides of interfaces.

    Arrays are read-only views.
    """

    def __init__(self, native: _kerf.PartSurface) -> None:
        self._native = native

    @property
    def points(self) -> np.ndarray:
        """(n, 3) float64."""
        return self._native.points

    @property
    def triangles(self) -> np.ndarray:
        """(m, 3) int32: corners, counter-clockwise seen from outside of the part."""
        return self._native.triangles

    @property
    def patches(self) -> np.ndarray:
        """(m,) int32: rows of `names`, -1 on interfaces."""
        return self._native.patches

    @property
    def names(self) -> list[str]:
        """Of the patches of the surface that was cut."""
        return self._native.names

    @property
    def neighbours(self) -> np.ndarray:
        """(m,) int32: the part on the other side of each triangle, -1: outside. Walls of regions have one, too."""
        return self._native.neighbours

    @property
    def cuts(self) -> np.ndarray:
        """(m,) int64: the node of the tree whose cut made the triangle, 0: it is one of the surface that was cut."""
        cuts: np.ndarray = self._native.facet_keys >> 32
        return cuts

    @property
    def is_interface(self) -> np.ndarray:
        """(m,) bool: whether a cut made the triangle."""
        is_interface: np.ndarray = self.cuts != 0
        return is_interface

    @property
    def global_ids(self) -> np.ndarray:
        """(n,) int64: of each point among those of all parts; the same in every part that has it."""
        return self._native.global_ids

    def to_surface(self) -> Surface:
        """As a Surface, to be meshed or saved by itself: checked, with a patch interface_P towards each part P."""
        neighbours, towards = np.unique(self.neighbours[self.is_interface], return_inverse=True)
        patches = self.patches.copy()
        patches[self.is_interface] = len(self.names) + towards
        return Surface(self.points, self.triangles, patches, self.names + [f"interface_{part}" for part in neighbours])

    def __repr__(self) -> str:
        return (f"<kerf.PartSurface: {len(self.points)} points, {len(self.triangles)} triangles, "
                f"{np.count_nonzero(self.is_interface)} on interfaces>")
