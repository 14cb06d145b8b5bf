"""Meshes of tetrahedra."""

from __future__ import annotations

from typing import Any, NamedTuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _kerf, programs
from .progress import Progress, caller
from .surface import Path, Surface, read


class Mesh:
    """A mesh in memory. Its arrays are read-only views; nothing changes them."""

    def __init__(self, native: _kerf.Mesh) -> None:
        self._native = native

    @property
    def points(self) -> np.ndarray:
        """(n, 3) float64."""
        return self._native.points

    @property
    def tetrahedra(self) -> np.ndarray:
        """(m, 4) int64: corners a, b, c, d as rows of `points`, with det[b-a, c-a, d-a] > 0."""
        return self._native.tetrahedra

    @property
    def part(self) -> np.ndarray:
        """(m,) int32: the part of each tetrahedron, by its number in the tree of cuts."""
        return self._native.part

    @property
    def region(self) -> np.ndarray:
        """(m,) int32: rows of `region_names`, 0 if there is one region."""
        return self._native.region

    @property
    def triangles(self) -> np.ndarray:
        """(k, 3) int64: the boundary, counter-clockwise seen from outside, and walls between regions, each once."""
        return self._native.triangles

    @property
    def patch(self) -> np.ndarray:
        """(k,) int32: rows of `patch_names`."""
        return self._native.patch

    @property
    def sides(self) -> np.ndarray:
        """(k, 2) int32: the regions behind and in front of each triangle, -1: outside."""
        return self._native.sides

    @property
    def patch_names(self) -> list[str]:
        """Names of the patches, in the order of their numbers."""
        return self._native.patch_names

    @property
    def region_names(self) -> list[str]:
        """Empty if there is one region."""
        return self._native.region_names

    def __repr__(self) -> str:
        return f"<kerf.Mesh: {len(self.points)} points, {len(self.tetrahedra)} tetrahedra>"


def mesh(surface: Union[Surface, Path], parts: int = 0, size: float = 0, progress: Progress = None, workers: int = 0,
         **options: object) -> Mesh:
    """The mesh of a surface, or of a file.

    surface    a Surface, or the path of a file
    parts      into which the surface is cut; 0: as many as are of use here
    size       wanted edge length, in units of the surface; 0: none
    progress   True: a line on standard error; or called with (stage, done, total): returning False ends the work
    workers    processes that mesh parts; 0: one for each processor
    options    those of `kerf mesh`, with underscores

    The result depends on the surface and the options alone. Raises UsageError, InputError, MeshingError, OutOfMemory,
    FileError, Cancelled; KeyboardInterrupt ends the workers.
    """
    if not isinstance(surface, Surface):
        surface = read(surface)
    return Mesh(_kerf.mesh(surface._native, parts, size, workers, caller(progress), programs.folder(), **options))


class Tetrahedralization(NamedTuple):
    """What tetrahedralize() returns; it will not grow."""

    nodes: np.ndarray
    tets: np.ndarray


def tetrahedralize(vertices: ArrayLike, faces: ArrayLike, size: float = 0, **options: Any) -> Tetrahedralization:
    """nodes (n, 3) float64 and tets (m, 4) int64 of a closed surface of triangles; mesh() tells of the options."""
    result = mesh(Surface(vertices, faces), size=size, **options)
    return Tetrahedralization(result.points, result.tetrahedra)
