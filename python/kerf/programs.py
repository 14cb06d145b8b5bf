"""Where the programs beside the module are: kerf-worker, which meshes parts, and those that read CAD, solve and draw."""

from __future__ import annotations

import os
from pathlib import Path


def folder() -> str:
    """Their folder; empty: where the kernel looks for them by itself.

    Those that the environment variable KERF_PROGRAMS names come first, then those of a wheel, of a build, and of an
    installed tree.
    """
    if os.environ.get("KERF_PROGRAMS"):
        return ""
    package = Path(__file__).resolve().parent
    for place in ("bin", "../..", "../../../../bin"):
        candidate = (package / place).resolve()
        if (candidate / "kerf-worker").is_file():
            return str(candidate)
    return ""


def path(name: str) -> str:
    """Of one of them. Raises FileError, naming the places where it was looked for, if there is none."""
    from . import _kerf

    return _kerf.find_program(name, folder())
