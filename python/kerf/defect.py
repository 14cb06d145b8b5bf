"""What is wrong with a surface, one thing at a time."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .option_table import in_python


@dataclass(frozen=True, eq=False)
class Defect:
    """One thing that is wrong with a surface, or will give bad cells. str() of it is a sentence.

    kind       "open edge loop", "self-intersection", "needle", ...; kerf check names them
    severity   "error": it cannot be meshed; "repaired": mended before meshing, without a change of the geometry;
               "warning": cells may be bad there
    text       what it is, where, and what to do about it
    facets     (f,) int64: rows of the triangles; of a file, numbers of its faces, counted from 0
    vertices   (k,) int64: rows of the points, or numbers of the file's; of a loop in the order of going around
    points     (k, 3) float64: coordinates of the vertices; places at the defect where there are none, or no surface
    measure    length of an open loop or a short edge, angle of a needle in degrees, distance between two bodies, else 0
    regions    names of the regions that have it, or between which it is; empty if there is only one
    advice     what to do about it; empty where the text is all that is known
    """

    kind: str
    severity: str
    text: str
    facets: np.ndarray = field(default_factory=lambda: np.empty(0, np.int64))
    vertices: np.ndarray = field(default_factory=lambda: np.empty(0, np.int64))
    points: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    measure: float = 0
    regions: list[str] = field(default_factory=list)
    advice: str = ""

    def __post_init__(self) -> None:
        for name in ("text", "advice"):
            object.__setattr__(self, name, in_python(getattr(self, name)))

    def __str__(self) -> str:
        return self.text
