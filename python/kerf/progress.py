"""What the argument `progress` of long calls may be."""

from __future__ import annotations

import sys
from typing import Callable, Optional, Union

#: None: nothing is told; True: a line on standard error; else called with (stage, done, total), where total is 0 if
#: nobody knows how many: returning False ends the work with Cancelled.
Progress = Union[bool, Callable[[str, int, int], Optional[bool]], None]


def caller(progress: Progress) -> Optional[Callable[[str, int, int], Optional[bool]]]:
    """What the module calls."""
    if progress is True:
        return _line
    return progress or None


def _line(stage: str, done: int, total: int) -> None:
    count = f" {done} of {total}" if total else ""
    is_last = total and done == total
    print(f"\r\033[Kkerf: {stage}{count}", end="\n" if is_last else "", file=sys.stderr, flush=True)
