"""What the ranks of a communicator of mpi4py do together."""

from __future__ import annotations

import pickle
from typing import TYPE_CHECKING, Any, Callable, Dict, Optional, TypeVar

import numpy as np

from .errors import Cancelled, Error, UsageError

if TYPE_CHECKING:
    from mpi4py.MPI import Comm

Value = TypeVar("Value")


def check_communicator(comm: Comm) -> None:
    """Raises UsageError for what is no group of ranks of which this is one."""
    from mpi4py import MPI

    if not isinstance(comm, MPI.Comm):
        raise UsageError(f"comm is {comm!r}, but a communicator of mpi4py is wanted: MPI.COMM_WORLD.")
    if comm == MPI.COMM_NULL:
        raise UsageError("comm is MPI.COMM_NULL: this rank is none of the communicator, and must not call.")
    if comm.Is_inter():
        raise UsageError("comm is an intercommunicator: merge its two groups by Merge().")


def together(comm: Comm, work: Callable[[], Value]) -> Value:
    """The value of work() on each rank; what it raises on one of them is raised on all. Collective.

    work() itself is not collective, or ends on all ranks where it fails on one. Of several errors that of the first
    rank counts, but those that may be the consequence of another rank's only if there are no others.
    """
    value: Any = None
    error: Optional[BaseException] = None
    try:
        value = work()
    except BaseException as raised:  # KeyboardInterrupt, too: no rank waits for one that is gone
        error = raised
    errors = comm.allgather(_portable(error))
    if all(each is None for each in errors):
        return value
    rank = min((r for r, each in enumerate(errors) if each is not None), key=lambda r: (_weight(errors[r]), r))
    if rank == comm.rank and error is not None:
        raise error
    raise errors[rank] from error


def _weight(error: BaseException) -> int:
    """Where a rank has failed the others are told without elements, and where one is interrupted they are cancelled."""
    if isinstance(error, Cancelled):
        return 3
    if type(error) is Error:  # of another rank, where Python has raised
        return 2
    return 0 if getattr(error, "elements", None) or not hasattr(error, "elements") else 1


def _portable(error: Optional[BaseException]) -> Optional[BaseException]:
    """An exception that reaches other ranks."""
    try:
        pickle.loads(pickle.dumps(error))
        return error
    except Exception:
        return RuntimeError(f"{type(error).__name__}: {error}")


def swap(comm: Comm, outgoing: Dict[int, np.ndarray], like: np.ndarray) -> Dict[int, np.ndarray]:
    """Rows that other ranks have for this one, by their ranks. Collective.

    outgoing  rows for others, by their ranks; where there are none nothing arrives
    like      an array whose rows have the shape and dtype of all
    """
    shape = like.shape[1:]
    width = int(np.prod(shape, dtype=int))
    counts = np.zeros(comm.size, int)
    for rank, rows in outgoing.items():
        counts[rank] = width * len(rows)
    arriving = np.empty_like(counts)
    comm.Alltoall(counts, arriving)
    sent = [np.asarray(outgoing[rank], like.dtype).ravel() for rank in sorted(outgoing)]
    buffer = np.concatenate([*sent, np.empty(0, like.dtype)])
    received = np.empty(arriving.sum(), like.dtype)
    comm.Alltoallv([buffer, counts], [received, arriving])
    ends = np.cumsum(arriving)
    return {int(rank): received[ends[rank] - arriving[rank]:ends[rank]].reshape(-1, *shape)
            for rank in np.flatnonzero(arriving)}
