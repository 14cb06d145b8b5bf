"""What the argument `progress` of long calls may be."""

from __future__ import annotations

import sys
from typing import Any, Callable, Optional, Union

import numpy as np

#: None: nothing is told; True: a line on standard error; else called with (stage, done, total), where total is None if
#: nobody knows how many: returning False, and nothing else, ends the work with Cancelled.
Progress = Union[bool, Callable[[str, int, Optional[int]], Any], None]


def caller(progress: Progress) -> Optional[Callable[[str, int, int], bool]]:
    """What the module calls: total is 0 there if nobody knows how many, and False ends the work."""
    if not progress:
        return None
    told = _line if progress is True else progress

    def goes_on(stage: str, done: int, total: int) -> bool:
        answer = told(stage, done, total or None)
        return not (isinstance(answer, (bool, np.bool_)) and not answer)

    return goes_on


def _line(stage: str, done: int, total: Optional[int]) -> None:
    count = f" {done} of {total}" if total else ""
    is_last = done == total
    print(f"\r\033[Kkerf: {stage}{count}", end="\n" if is_last else "", file=sys.stderr, flush=True)
