"""Closed surfaces of triangles."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _kerf
from .notebook import html_of
from .progress import Progress, caller

if TYPE_CHECKING:
    import meshio
    import pyvista
    import vtkmodules.vtkCommonDataModel as vtk

Path = Union[str, "os.PathLike[str]"]


class Surface:
    """A closed surface of triangles, of one body or of several that share walls.

    points     (n, 3) floats: coordinates
    triangles  (m, 3) whole numbers: corners as rows of `points`, counter-clockwise seen from outside; turned, where
               they are turned against each other, if there is one region
    patches    (m,) whole numbers from 0, or None: one patch
    names      of the patches, or None: patch_0, patch_1, ...
    sides      (m, 2) whole numbers: the regions behind and in front of each triangle, as rows of `regions`, -1: outside
    regions    names of the regions; given together with `sides`
    options    those of `kerf mesh` on the surface, with underscores: weld, voids, fill_holes, ...

    Raises UsageError, TypeError or ValueError for arrays that do not fit, and InputError for a surface that is not
    closed or intersects itself. Everything is copied; its own arrays are read-only views.
    """

    def __init__(self, points: ArrayLike, triangles: ArrayLike, patches: Optional[ArrayLike] = None,
                 names: Optional[Sequence[str]] = None, sides: Optional[ArrayLike] = None,
                 regions: Optional[Sequence[str]] = None, **options: object) -> None:
        self._native = _kerf.Surface(points, triangles, patches, names, sides, regions, **options)

    @classmethod
    def _of(cls, native: _kerf.Surface) -> Surface:
        surface = cls.__new__(cls)
        surface._native = native
        return surface

    @classmethod
    def from_meshio(cls, mesh: meshio.Mesh, patches: Optional[str] = None, **options: object) -> Surface:
        """The triangles of a mesh of meshio.

        patches    name of the cell data with the patch of each triangle; None: that of Gmsh's physical groups, with
                   their names, or of Mesh.to_meshio(); else the cell sets, if each triangle is in one; else one patch
        options    as above
        """
        from . import interchange

        return interchange.surface_of_meshio(mesh, patches, options)

    @classmethod
    def from_pyvista(cls, polydata: Union[pyvista.PolyData, vtk.vtkPolyData], patches: Optional[str] = None,
                     **options: object) -> Surface:
        """The polygons of a data set of PyVista, or of VTK itself, which need not be there: triangles alone.

        patches    name of the cell data with the patch of each triangle, whole numbers; None: "Patch" with its names in
                   "PatchNames", as files of Kerf have them, if it is there; else one patch
        options    as above
        """
        from . import interchange

        return interchange.surface_of_polydata(polydata, patches, options)

    @property
    def points(self) -> np.ndarray:
        """(n, 3) float64."""
        return self._native.points

    @property
    def triangles(self) -> np.ndarray:
        """(m, 3) int32: corners, counter-clockwise seen from outside, or from in front of a wall."""
        return self._native.triangles

    @property
    def patches(self) -> np.ndarray:
        """(m,) int32: rows of `names`."""
        return self._native.patches

    @property
    def names(self) -> list[str]:
        """Of the patches."""
        return self._native.names

    @property
    def sides(self) -> np.ndarray:
        """(m, 2) int32: the regions behind and in front of each triangle, -1: outside."""
        return self._native.sides

    @property
    def regions(self) -> list[str]:
        """Names; empty if there is one region."""
        return self._native.regions

    @property
    def volume(self) -> float:
        """Enclosed, of all regions, in cubed units of the points."""
        return self._native.volume

    @property
    def area(self) -> float:
        """Each triangle once, in squared units of the points."""
        return self._native.area

    def remesh(self, size: float = 0, deviation: float = 0, progress: Progress = None) -> Surface:
        """A surface with triangles worth meshing, nowhere farther than `deviation` from this one.

        size       wanted edge length; 0: as long as the deviation allows
        deviation  in units of the points; 0: a twentieth of `size`
        """
        return Surface._of(self._native.remesh(size, deviation, caller(progress)))

    def __repr__(self) -> str:
        regions = f", {len(self.regions)} regions" if self.regions else ""
        return f"<kerf.Surface: {len(self.points)} points, {len(self.triangles)} triangles{regions}>"

    def _repr_html_(self) -> str:
        rows = {"points": len(self.points), "triangles": len(self.triangles), "patches": len(self.names),
                "regions": max(1, len(self.regions)), "volume": self.volume, "area": self.area}
        return html_of(self, "kerf.Surface", rows, len(self.triangles))


def read(path: Path, **options: object) -> Surface:
    """The surface of a file of any format that `kerf mesh` reads: STL, OBJ, PLY, OFF, MSH, MEDIT, VTU, .poly, 3MF, CAD.

    options    those of `kerf mesh` on the surface, with underscores

    Raises FileError if it cannot be read, and InputError as Surface does.
    """
    return Surface._of(_kerf.read(path, **options))
