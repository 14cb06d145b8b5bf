"""Pictures without a display."""

from __future__ import annotations

import os
from typing import Optional, Sequence, Union

import numpy as np

from .drawing import Picture, draw
from .errors import UsageError
from .mesh import Mesh
from .paths import Path
from .records import Plane
from .solution import Solution
from .surface import Surface
from .tree import PartSurface, TreePart


def plot(what: Union[Path, Surface, Mesh, Solution, PartSurface, TreePart, object], file: Optional[Path] = None,
         clip: Union[str, Plane, Sequence, None] = None, color: Optional[str] = None,
         size: tuple[int, int] = (1200, 900), view: Optional[str] = None, timeout: float = 600,
         **options: object) -> Picture:
    """A picture, drawn without a display by the program kerf-view.

    what       a Surface, Mesh, Solution, Run or part of a Tree; or the path of a surface, of a folder of `kerf mesh`,
               `kerf decompose` or `kerf solve`, or of a file of `trace`
    file       PNG file that is written, too
    clip       plane at which it is cut open: "x=0.3" (at 30 % of the bounding box), "-y=0.5" (the other side),
               "1,1,0=0.4" (normal), "node=5" (of the tree); of what is in memory a Plane, too: (point, normal)
    color      part, region, patch, min-dihedral, radius-edge, aspect, shape, volume, edge-length, ...; of a solution
               von-mises, displacement, stress-xx, ..., error
    size       pixels: (width, height)
    view       front, back, right, left, top, bottom; None: from a corner
    timeout    seconds after which Cancelled is raised
    options    those of `kerf screenshot`, with underscores: explode, shrink, stage, node, theme, range, deform, ...

        kerf.plot(mesh, "cells.png", clip="x=0.5", color="min-dihedral")

    Raises FileError where kerf-view or the input is missing, UsageError for an option that does not fit.
    """
    result = draw(_drawable(what), {"color": color, "clip": _clip_text(what, clip), "view": view, **options}, size,
                  timeout)
    if file is not None:
        with open(file, "wb") as written:
            written.write(result)
    return result


def _drawable(what: object) -> Union[Surface, Mesh, str]:
    what = what.surface if isinstance(what, TreePart) else what
    what = what.to_surface() if isinstance(what, PartSurface) else what
    if isinstance(what, (Surface, Mesh)):
        return what
    path = getattr(what, "folder", what)
    if not isinstance(path, (str, os.PathLike)):
        raise UsageError(f"plot() draws surfaces, meshes, runs, solutions, parts of trees and files, but no "
                         f"{type(what).__name__}.")
    return os.fspath(path)


def _clip_text(what: object, clip: Union[str, Plane, Sequence, None]) -> Optional[str]:
    """As kerf-view has it: the place is a share of the extent of the bounding box along the normal."""
    if clip is None or isinstance(clip, str):
        return clip
    points = getattr(what.surface if isinstance(what, TreePart) else what, "points", None)
    if points is None:
        raise UsageError("A Plane clips what is in memory. Of files give a share of the bounding box: clip=\"x=0.5\".")
    point, normal = (np.asarray(each, float) for each in clip)
    low, high = points.min(axis=0), points.max(axis=0)
    half = np.abs(normal) @ (high - low) / 2
    share = 0.5 + normal @ (point - (low + high) / 2) / (2 * half)
    return f"{','.join(repr(float(x)) for x in normal)}={min(max(float(share), 0.0), 1.0)!r}"
