"""Exceptions of Kerf, one for each exit code of its programs."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Iterable, Optional

import numpy as np

from .defect import Defect
from .option_table import in_python


@dataclass(frozen=True)
class FailedPart:
    """A part that could not be meshed."""

    number: int
    """In the tree of cuts."""
    place: tuple[float, float, float]
    """Its centre of mass."""
    message: str
    """Why."""
    reproducer: Optional[str] = None
    """File in the folder of the run with the command that repeats it; None if the run had no folder of its own."""

    @classmethod
    def _of(cls, number: int, place: list[float], message: str, reproducer: str) -> FailedPart:
        return cls(number, (place[0], place[1], place[2]), message, reproducer if os.path.exists(reproducer) else None)


class Error(Exception):
    """Anything that Kerf refuses. `code` is the exit code that the programs would have, `elements` what it is about:
    a list of {"kind", "ids", "points", "names"}, the worst first."""

    code = 1

    def __init__(self, message: str, elements: Iterable[dict[str, Any]] = ()) -> None:
        super().__init__(message)
        self.elements = list(elements)


class UsageError(Error, ValueError, TypeError):
    """An option or an argument is wrong: its name, its type, its shape or its value."""

    code = 2


class InputError(Error, ValueError):
    """The surface cannot be meshed as it is. `defects` has all that is wrong with it, as kerf.check() tells them: never
    empty; `elements` the facets and vertices of those that the message is about."""

    code = 3

    def __init__(self, message: str, elements: Iterable[dict[str, Any]] = (), defects: Iterable[Defect] = ()) -> None:
        super().__init__(message, elements)
        self.defects = list(defects) or [_defect_of(message, self.elements)]


class MeshingError(Error, RuntimeError):
    """Parts could not be meshed: `failed_parts` has them. With output= the others are in the folder, and the same call
    tries those that failed again."""

    code = 4
    failed_parts: list[FailedPart] = []


class OutOfMemory(Error, MemoryError):
    """Out of memory, or over the budget; `failed_parts` has the parts that were too large, if it was theirs."""

    code = 5
    failed_parts: list[FailedPart] = []


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
    """Stopped by `progress`, which returned False."""

    code = 130


_kinds: tuple[type[Error], ...] = (UsageError, InputError, MeshingError, OutOfMemory, QualityError, FileError,
                                   VerificationError, ConvergenceError, Cancelled)
_classes = {each.code: each for each in _kinds}


def _defect_of(message: str, elements: list[dict[str, Any]]) -> Defect:
    """The only one of an error that is not about the defects of a surface."""
    def ids(*kinds: str) -> np.ndarray:
        return np.array([i for each in elements if each["kind"] in kinds for i in each["ids"]], np.int64)

    points = np.array([point for each in elements for point in each["points"]], float).reshape(-1, 3)
    return Defect("refused surface", "error", message, ids("facet"), ids("vertex", "edge"), points)


def error_of(code: int, message: str, elements: Iterable[dict[str, Any]],
             failed_parts: Iterable[tuple[int, list[float], str, str]] = (), defects: Iterable[Defect] = ()) -> Error:
    """The exception of an exit code; its message has the names of Python for options and arrays."""
    kind = _classes.get(code, Error)
    message = in_python(message)
    if kind is Cancelled:  # KeyboardInterrupt, and what `progress` raises, come in its place
        message = message.replace("was cancelled.", "was cancelled by progress, which returned False.")
    error = InputError(message, elements, defects) if kind is InputError else kind(message, elements)
    if failed_parts and isinstance(error, (MeshingError, OutOfMemory)):
        error.failed_parts = [FailedPart._of(*each) for each in failed_parts]
    return error
