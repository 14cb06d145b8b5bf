"""Meshes on the ranks of an MPI job: each rank has the arrays of its own parts, and no rank ever has all of them.

    from mpi4py import MPI

    mesh = kerf.mesh("pump.stl", parts=64, size=0.5, comm=MPI.COMM_WORLD)   # under mpirun -n P python3 script.py
    mesh.local.points, mesh.local.tetrahedra, mesh.local.global_points, mesh.local.owner
    mesh.neighbours[0].rank, mesh.neighbours[0].points
"""

from __future__ import annotations

import os
import shutil
import tempfile
from dataclasses import dataclass
from types import ModuleType
from typing import TYPE_CHECKING, Any, List, Optional, Sequence, Union

import numpy as np

from . import _kerf, programs
from .errors import FileError, UsageError
from .ghost_cells import GhostCells, ghost_cells_of
from .paths import Path, with_others
from .progress import Progress, caller
from .ranks import check_communicator, swap, together
from .records import Neighbour
from .sizes import Size, split_size
from .surface import Surface, surface_and_options

if TYPE_CHECKING:
    from mpi4py.MPI import Comm


@dataclass(frozen=True)
class Rows:
    """Numbers of the points in which each rank's own ones follow each other: rows of vectors and matrices."""

    #: Those of this rank: [first, last).
    first: int
    last: int
    #: (n,) int64: of each local point; those that this rank owns ascend.
    of_points: np.ndarray


class DistributedMesh(_kerf.DistributedMesh):
    """A mesh of which each rank has some of the parts, joined, and no rank has all of them.

        mesh = kerf.mesh("pump.stl", parts=64, size=0.5, comm=MPI.COMM_WORLD)   # under mpirun -n P python3 script.py
        mesh = kerf.distributed("out", MPI.COMM_WORLD)                          # of a finished run

    Both are collective: all ranks of the communicator, which may be any, call with the same arguments. With `parts`
    given the mesh is the same for any number of ranks, and without them. Beside the arguments of kerf.mesh() there is

    output   run folder, where all ranks reach it; None: a temporary one in TMPDIR of the first rank, which all of them
             must reach, too; it is gone when the call ends
    workers  processes of each rank; 0: one for each processor, shared with the other ranks of the host

    and `progress=True` has the first rank tell. Each rank reads and checks the surface, and has neighbouring parts in
    the tree of cuts; with more ranks than parts some have none.

    What is raised on one rank is raised on all of them, with the `elements` of the rank that has found them, or without
    where it had to end the others. Methods that are called collective are so in the same way.
    """

    def __init__(self, comm: Comm, native: _kerf.DistributedMesh) -> None:
        """Of what kerf.mesh() or distributed() has made on this rank."""
        super().__init__(native)
        self._comm = comm
        self._neighbours = [Neighbour(*each) for each in self._neighbour_rows]

    @property
    def comm(self) -> Comm:
        """The communicator that was given."""
        return self._comm

    @property
    def neighbours(self) -> List[Neighbour]:
        """The ranks that share points with this one, ascending."""
        return self._neighbours

    def rows(self) -> Rows:
        """Rows of the points in vectors and matrices that are distributed as the points are owned. Collective."""
        is_own = self.local.owner == self.comm.rank
        counts = self.comm.allgather(int(is_own.sum()))
        first = sum(counts[:self.comm.rank])
        last = first + counts[self.comm.rank]
        of_points = np.full(len(is_own), -1, np.int64)
        of_points[is_own] = np.arange(first, last)
        return Rows(first, last, self.from_owners(of_points))

    def from_owners(self, values: np.ndarray) -> np.ndarray:
        """A copy in which each point has the value that its owner has given. Collective.

        values  (n, ...) of any dtype of numbers, the same on all ranks: of the local points
        """
        result, owner = self._of_points(values), self.local.owner
        own = {each.rank: result[each.points[owner[each.points] == self.comm.rank]] for each in self.neighbours}
        for rank, rows in swap(self.comm, own, result[:0]).items():
            shared = self._shared_with(rank)
            result[shared[owner[shared] == rank]] = rows
        return result

    def sum_over_ranks(self, values: np.ndarray) -> np.ndarray:
        """A copy in which each point has the sum of what all ranks have given it, added in the order of the ranks: the
        same bits on each. Collective. `values` are as those of from_owners()."""
        own = self._of_points(values)
        shares = swap(self.comm, {each.rank: own[each.points] for each in self.neighbours}, own[:0])
        shares[self.comm.rank] = own
        result = np.zeros_like(own)
        for rank in sorted(shares):
            rows: Any = slice(None) if rank == self.comm.rank else self._shared_with(rank)
            result[rows] += shares[rank]
        return result

    def ghost_cells(self, layers: int = 1) -> GhostCells:
        """The cells of other ranks around those of this one: with one layer those that share a point. Collective.

        layers  1; more are not there

        Raises UsageError for others. Cost: messages to the neighbours with the cells that touch them.
        """
        together(self.comm, lambda: _require_one(layers))
        return ghost_cells_of(self.comm, self.local, self.neighbours)

    def _of_points(self, values: np.ndarray) -> np.ndarray:
        values = together(self.comm, lambda: self._checked(values))
        kinds = self.comm.allgather(f"{values.dtype} of the shape (n, {str(values.shape[1:])[1:]}")
        if len(set(kinds)) > 1:
            raise UsageError(f"values differ between ranks: {', '.join(sorted(set(kinds)))}.")
        return values

    def _checked(self, values: np.ndarray) -> np.ndarray:
        values = np.array(values, order="C")
        if values.dtype.kind not in "biufc":
            raise UsageError(f"values has the dtype {values.dtype}, but numbers are wanted.")
        if values.ndim == 0 or len(values) != len(self.local.points):
            raise UsageError(f"values has the shape {values.shape}, but a row for each of the "
                             f"{len(self.local.points)} local points is wanted.")
        return values

    def _shared_with(self, rank: int) -> np.ndarray:
        return next(each.points for each in self.neighbours if each.rank == rank)

    def __repr__(self) -> str:
        return (f"<kerf.DistributedMesh: {self.point_count} points, {self.cell_count} tetrahedra, "
                f"{len(self.local.tetrahedra)} of them on rank {self.comm.rank} of {self.comm.size}>")


def distributed(folder: Path, comm: Comm) -> DistributedMesh:
    """The mesh of a finished run, shared out among the ranks of a communicator. Collective.

    folder  where all ranks reach it: that `output` or `kerf mesh -o` was given
    comm    any communicator of mpi4py, of which all ranks call

    Each rank gets neighbouring parts of the tree of cuts, about as many as the others; with more ranks than parts some
    have none. It reads these, and the surfaces of all parts. Raises FileError, on all ranks.
    """
    check_communicator(comm)
    path = comm.bcast(together(comm, lambda: os.fsdecode(folder)))
    return DistributedMesh(comm, together(comm, lambda: _kerf.mesh_of_rank(path, comm.rank, comm.size)))


def mesh_on_ranks(surface: Union[Surface, Path, Sequence[Path]], comm: Comm, /, parts: int = 0, size: Size = None,
                  progress: Progress = None, workers: int = 0, output: Optional[Path] = None,
                  **options: object) -> DistributedMesh:
    """kerf.mesh() with a communicator; DistributedMesh tells of it."""
    check_communicator(comm)
    given, others = together(comm, lambda: surface_and_options(
        *((surface, options) if isinstance(surface, Surface) else with_others(surface, options))))
    sizes, length = together(comm, lambda: split_size(size, given))
    _require_same(comm, {"parts": parts, "size": length, **others},
                  {"surface.points": len(given.points), "surface.volume": given.volume})
    others = {"parts": parts, "size": length, "workers": workers, **others}
    temporary = together(comm, lambda: tempfile.mkdtemp(prefix="kerf.") if output is None and comm.rank == 0 else None)
    try:
        folder = comm.bcast(together(comm, lambda: _run_folder(output, temporary)))
        shown = comm.bcast(temporary)
        together(comm, lambda: _require_seen(shown))
        together(comm, lambda: _mesh_into(given, comm, folder, sizes, progress, others))
        return distributed(folder, comm)
    finally:
        if temporary:
            shutil.rmtree(temporary, ignore_errors=True)


def _require_one(layers: int) -> None:
    if layers != 1:
        raise UsageError(f"layers is {layers!r}, but there is one layer of ghost cells: take 1.")


def _require_same(comm: Comm, options: dict, surface: dict) -> None:
    """Raises UsageError on all ranks for the first number or text that is not the same on one."""
    told_by = comm.allgather({name: value for name, value in {**options, **surface}.items()
                              if isinstance(value, (int, float, str))})
    for name in sorted(set().union(*told_by)):
        values = [each.get(name) for each in told_by]
        other = next((rank for rank, value in enumerate(values) if value != values[0]), None)
        if other is not None:
            raise UsageError(f"{name} is {values[0]} on rank 0, but {values[other]} on rank {other}: all ranks of a "
                             "communicator give the same.")


def _run_folder(output: Optional[Path], temporary: Optional[str]) -> Optional[str]:
    if output is None:
        return temporary and os.path.join(temporary, "run")
    return os.fsdecode(output)


def _require_seen(temporary: Optional[str]) -> None:
    if temporary and not os.path.isdir(temporary):
        raise FileError(f"The temporary folder {temporary} of the first rank is not there for all ranks. Give `output` "
                        "on a file system that the hosts share, or set TMPDIR to one.")


def _mesh_into(surface: Surface, comm: Comm, folder: str, sizes: Optional[_kerf.SizeField], progress: Progress,
               options: dict[str, Any]) -> None:
    """Ends on all ranks where it fails on one."""
    from mpi4py import MPI

    told = caller(progress) if progress is not True or comm.rank == 0 else None
    _mpi().with_ranks(MPI._addressof(comm), lambda ranks, processors: _kerf.mesh_on_ranks(
        ranks, processors, surface, folder, sizes, told, programs.folder(), **options))


def _mpi() -> ModuleType:
    """The module that knows MPI, by the same library as mpi4py."""
    from mpi4py import MPI

    try:
        from . import _mpi as module
    except ImportError as error:
        raise UsageError(f"This Kerf cannot mesh on ranks: {error}. Build it where Open MPI is, or leave comm out.")
    own, other = module.library_version().rstrip("\0"), MPI.Get_library_version().rstrip("\0")
    if own != other:
        raise UsageError(f"mpi4py uses {other}, but Kerf was built with {own}. Use an mpi4py of the same MPI.")
    return module
