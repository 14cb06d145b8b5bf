# The native module that knows MPI, where there is one.
from __future__ import annotations

from typing import Callable, TypeVar

from ._kerf import Communicator

_Value = TypeVar("_Value")

class Ranks(Communicator): ...

def library_version() -> str: ...
def with_ranks(address: int, work: Callable[[Ranks, int], _Value]) -> _Value: ...
