"""What is wrong with a surface, before it is meshed."""

from __future__ import annotations

import json
import os
from typing import Any, Optional, Sequence, Union

from numpy.typing import ArrayLike

from . import _kerf
from ._kerf import Surface
from .defect import Defect
from .errors import UsageError
from .option_table import in_python
from .options import require_of_surface
from .paths import Path, encoded, encoded_names


class Check(_kerf.Check):
    """What check() has found. str() of it is what `kerf check` prints."""

    _found: Optional[list[Defect]] = None

    def __init__(self, native: _kerf.Check) -> None:
        """Of one that check() has made."""
        super().__init__(native)

    @property
    def text(self) -> str:
        """Lines for people: counts, regions, the worst defects of each kind, what to do, the verdict."""
        return in_python(self._text)

    @property
    def defects(self) -> list[Defect]:
        """In the order of their kinds, the most fundamental first. Where no surface could be made of what was given,
        the only one says why. At most 10,000 self-intersections, and the 1000 worst needles and shortest edges."""
        if self._found is None:
            self._found = self._defects
        return self._found

    @property
    def errors(self) -> list[Defect]:
        """Those for which it cannot be meshed."""
        return [defect for defect in self.defects if defect.severity == "error"]

    @property
    def report(self) -> dict[str, Any]:
        """What `kerf check --json` prints: counts, repairs, regions with volumes and walls, notes, and all defects."""
        return json.loads(self._json)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<kerf.Check: {'ok' if self.ok else 'cannot be meshed'}, {len(self.defects)} defects>"


def check(surface: Union[Surface, Path, ArrayLike], triangles: Optional[ArrayLike] = None,
          patches: Optional[ArrayLike] = None, names: Optional[Sequence[str]] = None,
          sides: Optional[ArrayLike] = None, regions: Optional[Sequence[str]] = None, needle_angle: float = 1,
          **options: Any) -> Check:
    """Everything that keeps a surface from being meshed, or will give bad cells. A surface that is broken is no error.

    surface        the path of a file, a Surface, or points (n, 3) with `triangles` and what else Surface() takes
    needle_angle   degrees below which a triangle is a needle, 0 to 60
    options        of the surface: weld, fill_holes, voids, ...: what is found is what is left after these repairs

    Rows that are wrong, as corners out of range, are one defect, "wrong row". Raises FileError for a file that cannot
    be opened, and UsageError for options and for arrays with wrong dtypes or shapes. Cost: O(m log m), 0.4 M triangles
    in 4 s.

        check = kerf.check("part.stl")
        for defect in check.errors:
            print(defect, defect.facets, defect.points)
    """
    require_of_surface(options)
    if triangles is None:
        if any(each is not None for each in (patches, names, sides, regions)):
            raise UsageError("patches, names, sides and regions belong to points and triangles: give triangles, too.")
        if isinstance(surface, (str, os.PathLike)):
            return Check(_kerf.check_path(encoded(surface), float(needle_angle), **options))
        if not isinstance(surface, Surface):
            raise UsageError("A path, a Surface, or points with triangles is wanted.")
        of_regions = surface.regions if len(surface.regions) > 1 else None
        arrays: tuple[Any, ...] = (surface.points, surface.triangles, surface.patches,
                                   encoded_names("names", surface.names), surface.sides if of_regions else None,
                                   encoded_names("regions", of_regions))
    else:
        arrays = (surface, triangles, patches, encoded_names("names", names), sides, encoded_names("regions", regions))
    return Check(_kerf.check_arrays(*arrays, needle_angle=float(needle_angle), **options))
