"""From surfaces to meshes: in memory, into a folder, or on the ranks of an MPI job."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _kerf, programs
from .distributed import DistributedMesh, mesh_on_ranks
from .errors import UsageError
from .mesh import Mesh
from .options import refuse_in_memory, split
from .paths import Path, with_others
from .progress import Progress, caller
from .run import Run
from .sizes import Size, split_size
from .surface import Surface, surface_and_options

if TYPE_CHECKING:
    from mpi4py.MPI import Comm


@overload
def mesh(surface: Union[Surface, Path, Sequence[Path]], /, parts: int = 0, size: Size = None, progress: Progress = None,
         workers: int = 0, output: None = None, comm: None = None, **options: object) -> Mesh: ...


@overload
def mesh(surface: Union[Surface, Path, Sequence[Path]], /, parts: int = 0, size: Size = None, progress: Progress = None,
         workers: int = 0, *, output: Path, comm: None = None, **options: object) -> Run: ...


@overload
def mesh(surface: Union[Surface, Path, Sequence[Path]], /, parts: int = 0, size: Size = None, progress: Progress = None,
         workers: int = 0, output: Optional[Path] = None, *, comm: Comm, **options: object) -> DistributedMesh: ...


def mesh(surface: Union[Surface, Path, Sequence[Path]], /, parts: int = 0, size: Size = None, progress: Progress = None,
         workers: int = 0, output: Optional[Path] = None, comm: Optional[Comm] = None,
         **options: object) -> Union[Mesh, Run, DistributedMesh]:
    """The mesh of a surface, or of a file.

    surface    a Surface, or the path of a file, or a list of several, a region each, as on the command line
    parts      into which the surface is cut; 0: 4 for each worker, or fewer where the surface is small
    size       wanted edge length, in units of the surface; a text with a share of the diagonal, as "2%"; a function
               of points (n, 3) that returns lengths (n,), see sample_sizes(); a SizeField; None: as the surface
    progress   True: a line on standard error; or called with (stage, done, total): returning False ends the work, and
               nothing else does. total is at least 1, or None if nobody knows it. Stages, where there is something to
               do: "read", "repair", "remesh", "decompose", "prepare", "volume", "reference", "write", "hash"
    workers    processes that mesh parts; 0: one for each processor
    output     None: a Mesh in memory; else a folder, for what is larger than memory: a Run, whose parts are the same
               files that `kerf mesh -o` writes. An older run there is replaced; one that was interrupted, or has failed
               parts, goes on where it was
    comm       a communicator of mpi4py, all ranks of which call: each gets its own parts (help(kerf.DistributedMesh))
    options    all others of `kerf mesh`, with underscores: kerf.options() lists them. Those of the surface, as
               fill_holes, belong to where that is made, so here only to a file

    The result depends on the surface and the options alone. The number of parts is one of them, and by default that of
    this computer: give parts=N for the same mesh elsewhere. Raises UsageError, InputError, MeshingError, OutOfMemory,
    FileError, Cancelled; KeyboardInterrupt ends the workers.
    """
    if comm is not None:
        return mesh_on_ranks(surface, comm, parts, size, progress, workers, output, **options)
    if not isinstance(surface, Surface):
        surface, options = with_others(surface, options)
    if output is not None:
        return _run(surface, os.fspath(output), parts, size, workers, progress, options)
    refuse_in_memory(options)
    surface, options = surface_and_options(surface, options)
    sizes, length = split_size(size, surface)
    body = (surface._body or "").encode("utf-8", "surrogateescape")
    return Mesh(_kerf.mesh(surface, sizes, caller(progress), programs.folder(), body, parts=parts, size=length,
                           workers=workers, **options))


def _run(surface: Union[Surface, Path], folder: str, parts: int, size: Size, workers: int, progress: Progress,
         options: dict[str, object]) -> Run:
    if _kerf.has_merged_format(folder):
        raise UsageError(f"output is {folder}, a file of one mesh, but kerf.mesh() writes a folder. Name one, and give "
                         "the file to the merge() of the result; or leave output out, and give it to save().")
    if callable(size):  # of the place, so that it has to be known
        surface, options = surface_and_options(surface, options)
    sizes, length = split_size(size, surface)
    given: Union[Surface, str] = surface if isinstance(surface, Surface) else os.fspath(surface)
    _kerf.mesh_into(given, folder, sizes, caller(progress), programs.folder(), parts=parts, size=length,
                    workers=workers, **options)
    return Run(folder)


class Tetrahedralization(NamedTuple):
    """What tetrahedralize() returns; it will not grow."""

    nodes: np.ndarray
    tets: np.ndarray


def tetrahedralize(vertices: ArrayLike, faces: ArrayLike, size: Size = None, progress: Progress = None,
                   **options: Any) -> Tetrahedralization:
    """nodes (n, 3) float64 and tets (m, 4) int64, with order=2 (m, 10), of a closed surface of triangles.

    options    those of Surface() and of mesh(), which tell what is raised
    """
    of_surface, of_mesh = split(options)
    result = mesh(Surface(vertices, faces, **of_surface), size=size, progress=progress, **of_mesh)
    return Tetrahedralization(result.points, result.tetra10 if result.order == 2 else result.tetrahedra)
