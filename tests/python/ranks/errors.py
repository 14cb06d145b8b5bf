"""What fails on one rank is raised on all of them, and they go on: errors.py"""

import os
import tempfile
from decimal import Decimal

import numpy as np
import two_boxes
from compared import OPTIONS
from mpi4py import MPI

import kerf

comm = MPI.COMM_WORLD
is_last = comm.rank == comm.size - 1


def raised(work):
    """The exceptions of all ranks, as class and message."""
    try:
        work()
    except BaseException as error:
        return comm.allgather((type(error), str(error)))
    return comm.allgather(None)


def require_everywhere(work, kind, text):
    errors = raised(work)
    assert len(set(errors)) == 1 and errors[0], errors
    assert issubclass(errors[0][0], kind) and text in errors[0][1], errors


def refuse(stage, done, total):
    raise ZeroDivisionError("of the last rank")


def press(stage, done, total):
    raise KeyboardInterrupt


def mesh(**options):
    return kerf.mesh(two_boxes.surface(), comm=comm, **{**OPTIONS, **options})


temporary = set(os.listdir(tempfile.gettempdir()))
require_everywhere(lambda: kerf.mesh("/nowhere/a.stl" if is_last else two_boxes.surface(), comm=comm),
                   kerf.FileError, "a.stl")
require_everywhere(lambda: mesh(parts="two" if is_last else 2), kerf.UsageError,
                   "parts is 2 on rank 0, but two on rank")
require_everywhere(lambda: mesh(radius_edge=-1), kerf.UsageError, "radius_edge")
require_everywhere(lambda: mesh(size=0.4 if is_last else 0.5), kerf.UsageError, "size is 0.5 on rank 0, but 0.4")
require_everywhere(lambda: mesh(radius_edge=object() if is_last else Decimal("1.5")), TypeError, "must be a number")
require_everywhere(lambda: mesh(progress=refuse if is_last else None), ZeroDivisionError, "of the last rank")
require_everywhere(lambda: mesh(progress=press if is_last else None), KeyboardInterrupt, "")
require_everywhere(lambda: mesh(output=5 if is_last else "out"), TypeError, "int")
require_everywhere(lambda: kerf.distributed("/nowhere/run", comm), kerf.FileError, "/nowhere/run")
require_everywhere(lambda: kerf.distributed("/nowhere/run", "world"), TypeError, "communicator")
require_everywhere(lambda: kerf.distributed("/nowhere/run", MPI.COMM_NULL), kerf.UsageError, "COMM_NULL")
good = mesh()
assert np.all(good.local.part > 0), "they go on"
values = np.zeros((len(good.local.points), 2))
require_everywhere(lambda: good.from_owners(values[1:] if is_last else values), kerf.UsageError, "local points")
require_everywhere(lambda: good.sum_over_ranks(values.astype(int) if is_last else values), kerf.UsageError, "float64")
require_everywhere(lambda: good.from_owners([{}] if is_last else values), TypeError, "object")
require_everywhere(lambda: good.ghost_cells(2 if is_last else 1), kerf.UsageError, "layer")
assert np.array_equal(good.from_owners(values), values)
comm.Barrier()
left = {name for name in os.listdir(tempfile.gettempdir()) if name.startswith("kerf.")} - temporary
assert not left, left
