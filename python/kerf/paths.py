"""Paths and names as the native module takes them: bytes, as the file system has them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any, Optional, Sequence, Union

from .errors import UsageError

Path = Union[str, "os.PathLike[str]"]


def encoded(path: Path) -> bytes:
    """As the file system has it. Raises UsageError for what is no path, and for a NUL in it."""
    try:
        name = os.fsencode(path)
    except TypeError:
        raise UsageError(f"{path!r:.60} is no path.") from None
    if b"\0" in name:
        raise UsageError("The path has a character NUL in it.")
    return name


def mesh_file(path: Path) -> str:
    """The path of a file of one mesh. Raises UsageError for one that is written beside another."""
    name = os.fspath(path)
    if name.endswith(".xdmf"):
        raise UsageError(f"The path is {name}, but an .xdmf is written beside its .h5: give {name[:-5]}.h5.")
    return name


def with_others(path: Union[Path, Sequence[Path]], options: dict[str, Any]) -> tuple[Path, dict[str, Any]]:
    """The first of several files, and the options with the others in `with_`, as the command line has them."""
    if isinstance(path, (str, os.PathLike)):
        return path, options
    if not isinstance(path, (list, tuple)) or not all(isinstance(each, (str, os.PathLike)) for each in path):
        raise UsageError(f"A Surface, a path or a list of paths is wanted, but this is of type {type(path).__name__}. "
                         "Points and triangles make a surface: kerf.mesh(kerf.Surface(points, triangles), ...).")
    if not path:
        raise UsageError("The list of files is empty.")
    others = [os.fspath(other) for other in path[1:]]
    given = options.get("with_", [])
    return path[0], {**options, "with_": others + ([given] if isinstance(given, (str, os.PathLike)) else list(given))}


def encoded_names(what: str, names: Optional[Sequence[str]]) -> Optional[list[bytes]]:
    """Names of patches or regions for the module. Raises UsageError for what is no sequence of str."""
    if names is None:
        return None
    if isinstance(names, (str, bytes)) or not isinstance(names, Iterable):
        raise UsageError(f"{what} is {names!r:.60}, but a list of str is wanted.")
    names = list(names)
    for name in names:
        if not isinstance(name, str):
            raise UsageError(f"{what} has {name!r:.60}, but a list of str is wanted.")
    return [name.encode("utf-8", "surrogateescape") for name in names]
