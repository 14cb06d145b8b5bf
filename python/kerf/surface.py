"""Closed surfaces of triangles."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Optional, Sequence, Union, cast

import numpy as np
from numpy.typing import ArrayLike

from . import _kerf, interchange
from .check import Check, check
from .errors import UsageError
from .notebook import html_of
from .notes import in_words_of_python, notes_text
from .options import require_of_surface, split
from .paths import Path, encoded, encoded_names, with_others
from .progress import Progress, caller
from .repairs import Repair, Wrapping, repairs_of

if TYPE_CHECKING:
    import meshio
    import pyvista
    import vtkmodules.vtkCommonDataModel as vtk


class Surface(_kerf.Surface):
    """A closed surface of triangles, of one body or of several that share walls.

    points     (n, 3) floats: coordinates
    triangles  (m, 3) whole numbers: corners as rows of `points`, counter-clockwise seen from outside; turned, where
               they are turned against each other, if there is one region
    patches    (m,) whole numbers from 0, or None: one patch
    names      of the patches, or None: patch_0, patch_1, ...
    sides      (m, 2) whole numbers: the regions behind and in front of each triangle, as rows of `regions`, -1: outside
    regions    names of the regions; given together with `sides`. That of a single one stays with meshes in memory, but
               is not in the files of runs
    options    those of the surface: scale, weld, fill_holes, keep_largest, voids, ... (kerf.options() lists them)

    Everything is copied and checked; points of equal coordinates become one. Its own arrays are read-only views: they
    may have fewer rows than what was given. It can be pickled and copied; that checks the arrays again.

    Raises UsageError, naming the argument, for arrays with wrong dtypes, shapes or lengths, and for options;
    InputError, naming the row, for corners out of range, points that are not finite, and triangles that have a corner twice; and
    InputError for a surface that is not closed, intersects itself or bounds no body: its `defects` has all of them, as
    check() does. Cost: O(m log m), 0.4 M triangles in 4 s.
    """

    _body: Optional[str] = None
    _made: Optional[tuple[str, Optional[dict[str, Any]], list[str]]] = None

    def __init__(self, points: ArrayLike, triangles: ArrayLike, patches: Optional[ArrayLike] = None,
                 names: Optional[Sequence[str]] = None, sides: Optional[ArrayLike] = None,
                 regions: Optional[Sequence[str]] = None, **options: object) -> None:
        """Copies and checks the arrays."""
        require_of_surface(options)
        super().__init__(_kerf.surface_of_arrays(points, triangles, patches, encoded_names("names", names), sides,
                                                 encoded_names("regions", regions), **options))
        if regions is not None and len(regions) == 1:
            self._body = regions[0]

    @property
    def regions(self) -> list[str]:
        """Names; empty if there is one region without a name."""
        return super().regions or ([] if self._body is None else [self._body])

    def __reduce__(self) -> tuple[Any, ...]:
        of_regions = self.regions or None
        return _unpickled, (self.points, self.triangles, self.patches, self.names, self.sides if of_regions else None,
                            of_regions, *self._told())

    def _told(self) -> tuple[str, Optional[dict[str, Any]], list[str]]:
        """What was repaired, of a wrap its distances, and the notes: no arrays tell that."""
        return self._made if self._made is not None else (self._repairs, self._wrapped, self._notes)

    @classmethod
    def _of(cls, native: _kerf.Surface) -> Surface:
        surface = cls.__new__(cls)
        _kerf.Surface.__init__(surface, native)
        return surface

    @classmethod
    def from_meshio(cls, mesh: meshio.Mesh, patches: Optional[str] = None, **options: Any) -> Surface:
        """The triangles of a mesh of meshio, and the regions of the tetrahedra beside them, if these are of several.

        patches    name of the cell data with the patch of each triangle; None: that of Gmsh's physical groups, or of
                   Mesh.to_meshio(), or "Patch" of a .vtu of Kerf, with the names there; else the cell sets, if each
                   triangle is in one; else one patch
        options    as above
        """
        return Surface(*interchange.surface_of_meshio(mesh, patches), **options)

    @classmethod
    def from_pyvista(cls, polydata: Union[pyvista.PolyData, vtk.vtkPolyData], patches: Optional[str] = None,
                     **options: Any) -> Surface:
        """The polygons of a data set of PyVista, or of VTK itself, which need not be there: triangles alone.

        patches    name of the cell data with the patch of each triangle, whole numbers; None: "Patch" with its names in
                   "PatchNames", as files of Kerf have them, if it is there; else one patch
        options    as above
        """
        return Surface(*interchange.surface_of_polydata(polydata, patches), **options)

    @property
    def bounds(self) -> np.ndarray:
        """(2, 3) float64: the smallest coordinates, and the largest."""
        return np.stack([self.points.min(axis=0), self.points.max(axis=0)])

    @property
    def repairs(self) -> list[Repair]:
        """What the option `repair`, or kerf.repair(), has done when this surface was made; empty: nothing was wrong."""
        return repairs_of(self._told()[0])

    @property
    def wrapped(self) -> Optional[Wrapping]:
        """How far from the input it is, if kerf.wrap() has made this surface; None: it is no wrap, or was remeshed."""
        report = self._told()[1]
        return None if report is None else Wrapping(**report)

    @property
    def notes(self) -> list[str]:
        """What was changed when this surface was read, repaired, wrapped or remeshed, in the sentences that Kerf's
        programs print. Empty: nothing."""
        return in_words_of_python(self._told()[2])

    def check(self, needle_angle: float = 1) -> Check:
        """What may give bad cells: needles, short edges. There are no errors, or there would be no Surface: for arrays
        and files that may be broken there is kerf.check()."""
        return check(self, needle_angle=needle_angle)

    def repair(self, **options: object) -> Surface:
        """A surface of this one's arrays with options of the surface: keep_largest=True, weld=1e-3, scale=0.001, ...

        What is broken cannot be a Surface: give the options where it is made, as Surface(points, triangles,
        fill_holes=10) or read(path, weld="0.01%"), or use kerf.repair(). Raises as Surface() does.
        """
        of_regions = self.regions if len(self.regions) > 1 else None
        repaired = Surface(self.points, self.triangles, self.patches, self.names, self.sides if of_regions else None,
                           of_regions, **options)
        repaired._body = self._body
        return repaired

    def remesh(self, size: Union[float, str] = 0, deviation: Union[float, str] = 0, progress: Progress = None,
               **options: object) -> Surface:
        """A surface with triangles worth meshing, nowhere farther than `deviation` from this one. Patches stay.

        size       wanted edge length; 0: as long as the deviation allows
        deviation  in units of the points; 0: a twentieth of `size`, or 0.05 % of the diagonal
        progress   as of kerf.mesh()
        options    the others on sizes: cells, fineness, size_on, size_in, size_region, chord_error, growth, ...

        Lengths may be texts such as "2%", of the diagonal of the bounds. Raises UsageError for options, InputError
        where the bound cannot be kept, OutOfMemory, Cancelled.
        """
        remeshed = Surface._of(self._remesh(caller(progress), size=size, deviation=deviation, **options))
        remeshed._body = self._body
        return remeshed

    def save(self, path: Path) -> None:
        """Writes an .obj: all digits and the patches, or of several regions a closed group for each; a .vtp or .vtk:
        patches and regions; a .ply or .off: one region, no patches; or an .stl: the same with 7 digits. Raises
        UsageError for another ending, FileError."""
        self._save(encoded(path))

    def __repr__(self) -> str:
        regions = f", {len(self.regions)} regions" if len(self.regions) > 1 else ""
        return (f"<kerf.Surface: {len(self.points)} points, {len(self.triangles)} triangles{regions}"
                f"{notes_text(self.notes)}>")

    def _repr_html_(self) -> str:
        rows = {"points": len(self.points), "triangles": len(self.triangles), "patches": len(self.names),
                "regions": max(1, len(self.regions)), "volume": self.volume, "area": self.area,
                "notes": len(self.notes)}
        return html_of(self, "kerf.Surface", rows, len(self.triangles))


def _unpickled(points: np.ndarray, triangles: np.ndarray, patches: np.ndarray, names: list[str],
               sides: Optional[np.ndarray], regions: Optional[list[str]], *told: Any) -> Surface:
    surface = Surface(points, triangles, patches, names, sides, regions)
    # A pickle of an older version has no notes.
    surface._made = cast("tuple[str, Optional[dict[str, Any]], list[str]]", told if len(told) == 3 else (*told, []))
    return surface


def read(path: Union[Path, Sequence[Path]], **options: object) -> Surface:
    """The surface of a file of any format that `kerf mesh` reads: STL, OBJ, PLY, OFF, MSH, MEDIT, VTK, .poly, 3MF, CAD.

    path       of the file; of several, as a list, each is a region
    options    those of the surface: scale, weld, fill_holes, keep_largest, voids, unit, ...: kerf.options() lists them;
               with_=["other.stl"] reads other files, too

    Raises FileError if it cannot be opened, UsageError for options, and InputError as Surface() does.
    """
    require_of_surface(options)
    first, options = with_others(path, options)
    return Surface._of(_kerf.read(encoded(first), **options))


def repair(surface: Union[Surface, Path, ArrayLike], triangles: Optional[ArrayLike] = None,
           patches: Optional[ArrayLike] = None, names: Optional[Sequence[str]] = None,
           steps: str = "full", **options: object) -> Surface:
    """A surface of a file, or of arrays, that need not be closed and may cross itself; its `repairs` say what was done.

    surface    the path of a file, a Surface, or points (n, 3) with `triangles`, and their `patches` and `names`
    steps      "exact": points move only to part what touches; "near": points move within a bound, holes are filled;
               "full": what crosses is divided, too; or steps by name, as "weld,stitch,holes=200,bound=0.1%"
               (docs/options.md)
    options    others of the surface: cap=True, thicken=0.2, scale, voids, ...

    What is clean stays as it is. Raises UsageError for steps, and InputError where something is left that keeps the
    surface from being meshed: its `defects` has all of that.

        surface = kerf.repair("scan.stl", steps="near")
        for repair in surface.repairs:
            print(repair)
    """
    return _surface_of(surface, triangles, patches, names, dict(options, repair=steps))


def wrap(surface: Union[Surface, Path, ArrayLike], triangles: Optional[ArrayLike] = None,
         patches: Optional[ArrayLike] = None, names: Optional[Sequence[str]] = None,
         gap: Union[float, str] = 0, offset: Union[float, str] = 0, **options: object) -> Surface:
    """A closed surface without crossings around that of a file, or of arrays, whatever it is; its `wrapped` says how far
    from it. Its triangles are small and uniform: remesh() makes those of kerf wrap, with long ones where it is flat.

    surface    the path of a file, a Surface, or points (n, 3) with `triangles`, and their `patches` and `names`
    gap        openings narrower than this are closed, and what lies behind them is lost; 0: 2 % of the diagonal, or more
               where that would make some 100,000 triangles or more
    offset     sheets become walls of up to twice this thickness; 0: an eighth of the gap
    options    others of the surface: scale, repair (before it is wrapped), ...

    Lengths may be texts such as "2%", of the diagonal of the bounds. Raises UsageError for lengths out of range, and
    InputError where there is nothing to wrap. Cost: some 3000 triangles of the result a second.

        surface = kerf.wrap("scan.stl", gap="5%")
        surface.wrapped.distance_to_input
    """
    return _surface_of(surface, triangles, patches, names, dict(options, surface="wrap", gap=gap, offset=offset))


def _surface_of(surface: Union[Surface, Path, ArrayLike], triangles: Optional[ArrayLike],
                patches: Optional[ArrayLike], names: Optional[Sequence[str]], options: dict[str, object]) -> Surface:
    """Of what repair() and wrap() take. An option may be called surface, as the first argument is."""
    if triangles is not None:
        return Surface(surface, triangles, patches, names, **options)  # type: ignore[arg-type]
    if patches is not None or names is not None:
        raise UsageError("patches and names belong to points and triangles: give triangles, too.")
    if isinstance(surface, Surface):
        return surface.repair(**options)
    if not isinstance(surface, (str, os.PathLike)):
        raise UsageError("A path, a Surface, or points with triangles is wanted.")
    return read(surface, **options)


def surface_and_options(surface: Union[Surface, Path], options: dict[str, Any]) -> tuple[Surface, dict[str, Any]]:
    """The surface, if it is a file read with those of the options that are of it, and the others."""
    of_surface, of_mesh = split(options)
    if not isinstance(surface, Surface):
        return read(surface, **of_surface), of_mesh
    if of_surface:
        raise UsageError(f"{next(iter(of_surface))} is an option of the surface: give it to kerf.Surface(), "
                         "kerf.read() or Surface.repair().")
    return surface, of_mesh
