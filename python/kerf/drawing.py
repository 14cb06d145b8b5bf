"""Pictures of what kerf-view can read, or of what is in memory."""

from __future__ import annotations

import os
from contextlib import contextmanager
from tempfile import TemporaryDirectory
from typing import Iterator, Mapping, Union

from . import _kerf, programs


class Picture(bytes):
    """A PNG file. Notebooks show it."""

    def _repr_png_(self) -> bytes:
        return bytes(self)

    def __repr__(self) -> str:
        return f"<kerf.Picture: {len(self)} bytes of PNG>"

    __str__ = __repr__


def draw(what: Union[_kerf.Surface, _kerf.Mesh, str], options: Mapping[str, object], size: tuple[int, int],
         timeout: float) -> Picture:
    """What kerf-view draws of a surface or a mesh, or of a path. `options`: its own; plot() tells of the others."""
    if isinstance(what, _kerf.Mesh) and "state" not in options:
        options = {"stage": "tetrahedra", **options}
    width, height = size
    with TemporaryDirectory(prefix="kerf-plot-") as beside, _path_of(what) as path:
        picture = os.path.join(beside, "picture.png")
        flags = programs.flags({"resolution": f"{width}x{height}", "timeout": f"{timeout:g}", **options})
        programs.run("kerf-view", ["screenshot", path, "--output", picture, *flags], timeout=timeout)
        with open(picture, "rb") as drawn:
            return Picture(drawn.read())


@contextmanager
def _path_of(what: Union[_kerf.Surface, _kerf.Mesh, str]) -> Iterator[str]:
    """Something in memory is written into a folder that goes with the picture."""
    if isinstance(what, str):
        yield what
        return
    with TemporaryDirectory(prefix="kerf-plot-") as folder:
        if isinstance(what, _kerf.Surface):
            path = os.path.join(folder, "surface.obj")
            _kerf.write_surface_to_view(what, path)
        else:
            path = os.path.join(folder, "mesh")
            _kerf.write_mesh_to_view(what, path)
        yield path
