"""Exceptions of Kerf, one for each exit code of its programs."""

from __future__ import annotations

from typing import Any, Iterable


class Error(Exception):
    """Anything that Kerf refuses. `code` is the exit code that the programs would have, `elements` what it is about:
    a list of {"kind", "ids", "points", "names"}, the worst first."""

    code = 1

    def __init__(self, message: str, elements: Iterable[dict[str, Any]] = ()) -> None:
        super().__init__(message)
        self.elements = list(elements)


class UsageError(Error, ValueError):
    """An option or an argument is wrong."""

    code = 2


class InputError(Error, ValueError):
    """The surface cannot be meshed as it is; `elements` has the facets and vertices."""

    code = 3


class MeshingError(Error, RuntimeError):
    """A part could not be meshed."""

    code = 4


class OutOfMemory(Error, MemoryError):
    """Out of memory, or over the budget."""

    code = 5


class QualityError(Error):
    """A limit of quality was missed."""

    code = 6


class FileError(Error, OSError):
    """Reading or writing failed, or a program of Kerf was not found."""

    code = 7


class VerificationError(Error):
    """A law of the result does not hold."""

    code = 8


class ConvergenceError(Error):
    """The solver did not reach its tolerance."""

    code = 9


class Cancelled(Error):
    """Stopped by `progress`."""

    code = 130


_classes = {each.code: each for each in (UsageError, InputError, MeshingError, OutOfMemory, QualityError, FileError,
                                         VerificationError, ConvergenceError, Cancelled)}


def error_of(code: int, message: str, elements: Iterable[dict[str, Any]]) -> Error:
    """The exception of an exit code."""
    return _classes.get(code, Error)(message, elements)
