"""The parts of a mesh in a folder."""

from __future__ import annotations

from collections.abc import Sequence as AbstractSequence
from typing import Iterator, Sequence, Union, overload

import numpy as np

from ._kerf import Part, Run


class Parts(AbstractSequence):
    """The parts of a run in the order of the tree of cuts. Each is read when it is asked for, and kept by nobody else:
    parts[i] twice reads twice. A slice reads nothing."""

    def __init__(self, run: Run, rows: Sequence[int]) -> None:
        self._run = run
        self._rows = rows

    @property
    def numbers(self) -> np.ndarray:
        """(k,) int32: of the parts in the tree of cuts."""
        return self._run._numbers[list(self._rows)]

    @property
    def tetrahedra_counts(self) -> np.ndarray:
        """(k,) int64: of the parts, without reading them."""
        return self._run._tetrahedra[list(self._rows)]

    def numbered(self, number: int) -> Part:
        """The part with a number in the tree of cuts, as `neighbour` has them. Raises KeyError if there is none."""
        found = np.flatnonzero(self.numbers == number)
        if len(found) == 0:
            raise KeyError(f"There is no part {number}; the numbers are {', '.join(map(str, self.numbers))}.")
        return self[int(found[0])]

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, index: int) -> Part: ...

    @overload
    def __getitem__(self, index: slice) -> Parts: ...

    def __getitem__(self, index: Union[int, slice]) -> Union[Part, Parts]:
        if isinstance(index, slice):
            return Parts(self._run, self._rows[index])
        try:
            row = self._rows[index]
        except IndexError:
            raise IndexError(f"There is no part [{index}]: there are {len(self)}.") from None
        return self._run._load(row)

    def __iter__(self) -> Iterator[Part]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<kerf.Parts: {len(self)}, {int(self.tetrahedra_counts.sum())} tetrahedra>"
