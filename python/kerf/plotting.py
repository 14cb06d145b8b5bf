"""Pictures without a display."""

from __future__ import annotations

import os
from contextlib import contextmanager
from tempfile import TemporaryDirectory
from typing import Iterator, Optional, Sequence, Union

import numpy as np

from . import _kerf, programs
from .errors import UsageError
from .mesh import Mesh
from .part_surface import PartSurface
from .solution import Solution
from .surface import Path, Surface
from .tree import TreePart
from .tree_node import Plane


class Picture(bytes):
    """A PNG file. Notebooks show it."""

    def _repr_png_(self) -> bytes:
        return bytes(self)

    def __repr__(self) -> str:
        return f"<kerf.Picture: {len(self)} bytes of PNG>"

    __str__ = __repr__


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
    if isinstance(what, Mesh) and "state" not in options:
        options.setdefault("stage", "tetrahedra")
    width, height = size
    with TemporaryDirectory(prefix="kerf-plot-") as beside, _path_of(what) as path:
        picture = os.path.join(beside, "picture.png")
        flags = programs.flags({"resolution": f"{width}x{height}", "timeout": f"{timeout:g}", "color": color,
                                "clip": _clip_text(what, clip), "view": view, **options})
        programs.run("kerf-view", ["screenshot", path, "--output", picture, *flags], timeout=timeout)
        with open(picture, "rb") as drawn:
            result = Picture(drawn.read())
    if file is not None:
        with open(file, "wb") as written:
            written.write(result)
    return result


@contextmanager
def _path_of(what: object) -> Iterator[str]:
    """Of what kerf-view can read: something in memory is written into a folder that goes with the picture."""
    what = what.surface if isinstance(what, TreePart) else what
    what = what.to_surface() if isinstance(what, PartSurface) else what
    if not isinstance(what, (Surface, Mesh)):
        path = getattr(what, "folder", what)
        if not isinstance(path, (str, os.PathLike)):
            raise TypeError(f"plot() draws surfaces, meshes, runs, solutions, parts of trees and files, but no "
                            f"{type(what).__name__}.")
        yield os.fspath(path)
        return
    with TemporaryDirectory(prefix="kerf-plot-") as folder:
        if isinstance(what, Surface):
            path = os.path.join(folder, "surface.obj")
            _kerf.write_surface_to_view(what._native, path)
        else:
            path = os.path.join(folder, "mesh")
            _kerf.write_mesh_to_view(what._native, path)
        yield path


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
