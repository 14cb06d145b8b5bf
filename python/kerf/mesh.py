"""Meshes of tetrahedra."""

from __future__ import annotations

import json
import os
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _kerf, programs
from .errors import UsageError
from .notebook import html_of
from .options import refuse_in_memory, split
from .progress import Progress, caller
from .quality import Quality
from .sizes import Size, split_size
from .surface import Path, Surface, read, with_others

if TYPE_CHECKING:
    import meshio
    import pyvista
    import vtkmodules.vtkCommonDataModel as vtk
    from mpi4py.MPI import Comm

    from .distributed import DistributedMesh
    from .run import Run


class Mesh:
    """A mesh in memory. Its arrays are read-only views; nothing changes them. It can be pickled and copied."""

    def __init__(self, native: _kerf.Mesh) -> None:
        self._native = native

    def __reduce__(self) -> tuple[Any, ...]:
        return Mesh, (self._native,)  # what is found when it is first asked for is found again

    @property
    def points(self) -> np.ndarray:
        """(n, 3) float64; of order 2 the corners of cells first, then the nodes on edges."""
        return self._native.points

    @property
    def order(self) -> int:
        """Of the cells: 1, or 2 with a node on each edge (order=2 of kerf.mesh())."""
        return self._native.order

    @property
    def tetra10(self) -> np.ndarray:
        """(m, 10) int64 of order 2, else (0, 10): rows of `points`, the corners as in `tetrahedra`, then the nodes on
        the edges 01 12 02 03 13 23, as meshio and VTK have them."""
        return self._native.tetra10

    @property
    def triangle6(self) -> np.ndarray:
        """(k, 6) int64 of order 2, else (0, 6): the corners as in `triangles`, then the nodes on the edges 01 12 02."""
        return self._native.triangle6

    @property
    def tetrahedra(self) -> np.ndarray:
        """(m, 4) int64: corners a, b, c, d as rows of `points`, with det[b-a, c-a, d-a] > 0."""
        return self._native.tetrahedra

    @property
    def part(self) -> np.ndarray:
        """(m,) int32: the part of each tetrahedron, by its number in the tree of cuts."""
        return self._native.part

    @property
    def region(self) -> np.ndarray:
        """(m,) int32: rows of `region_names`, 0 if there is one region."""
        return self._native.region

    @property
    def triangles(self) -> np.ndarray:
        """(k, 3) int64: the boundary, counter-clockwise seen from outside, and walls between regions, each once."""
        return self._native.triangles

    @property
    def patch(self) -> np.ndarray:
        """(k,) int32: rows of `patch_names`."""
        return self._native.patch

    @property
    def sides(self) -> np.ndarray:
        """(k, 2) int32: the regions behind and in front of each triangle, -1: outside."""
        return self._native.sides

    @property
    def patch_names(self) -> list[str]:
        """Names of the patches, in the order of their numbers."""
        return self._native.patch_names

    @property
    def region_names(self) -> list[str]:
        """Empty if there is one region."""
        return self._native.region_names

    def save(self, path: Path, msh_version: str = "4.1", msh_ascii: bool = False) -> None:
        """Writes a file, whose ending chooses the format: .msh, .vtu, .mesh, .inp, .su2, .node, ... as `kerf merge`.

        msh_version    of Gmsh's files: "4.1" or "2.2"
        msh_ascii      Gmsh's files as text

        Patches and regions have their names there. Raises UsageError for another ending, naming those that there are.
        """
        self._native.save(os.fspath(path), msh_version, msh_ascii)

    def to_meshio(self) -> meshio.Mesh:
        """A mesh of meshio: a block of tetrahedra for each region, one of triangles for each patch; of order 2
        "tetra10" and "triangle6".

        Cell data `part`, `region` and `patch` (-1 where a cell has none). Names are those of cell sets and, with the
        numbers that `kerf merge` gives them, of field data, so that they survive a write to .msh. A write to .vtu has
        one array, named by all sets, whose values are their numbers: meshio has no other place for them there.
        """
        from . import interchange

        return interchange.to_meshio(self)

    def to_vtk(self) -> vtk.vtkUnstructuredGrid:
        """A grid of VTK: the tetrahedra, then the triangles, with the arrays that the files of Kerf have
        (docs/output.md): Part, Region, Patch of cells; RegionNames, PatchNames of the field.

        The points are not copied: the grid shares them.
        """
        from . import interchange

        return interchange.to_vtk(self)

    def to_pyvista(self) -> pyvista.UnstructuredGrid:
        """to_vtk(), wrapped by PyVista. Raises ImportError without PyVista."""
        from . import interchange

        return interchange.to_pyvista(self)

    @cached_property
    def neighbours(self) -> np.ndarray:
        """(m, 4) int64: the tetrahedra on the other sides of the faces opposite to the corners, -1 outside; found when
        they are first asked for."""
        return self._native.neighbours()

    @cached_property
    def volumes(self) -> np.ndarray:
        """(m,) float64: of the tetrahedra, all positive, in cubed units of the points."""
        return self.cell_quality("volume")

    def cell_quality(self, measure: str) -> np.ndarray:
        """(m,) float64: a measure of each tetrahedron.

        measure    min-dihedral or max-dihedral (degrees), radius-edge, aspect, shape, volume, min-edge or max-edge;
                   Quality tells of them. Raises UsageError for anything else
        """
        return self._native.cell_quality(measure.replace("_", "-").removesuffix("-deg"))

    def quality(self) -> Quality:
        """Distributions of all measures, with the numbers of `kerf quality --json`; measured at each call."""
        told, text = self._native.quality()
        return Quality(json.loads(told), text)

    @cached_property
    def report(self) -> dict[str, Any]:
        """What the run tells of itself, as report.json of a folder: input, options, tree, parts, totals with the
        seconds of stages, verification. Empty if there is none."""
        return json.loads(self._native.report or "{}")

    def __repr__(self) -> str:
        return f"<kerf.Mesh: {len(self.points)} points, {len(self.tetrahedra)} tetrahedra>"

    def _repr_html_(self) -> str:
        rows = {"points": len(self.points), "tetrahedra": len(self.tetrahedra), "parts": len(np.unique(self.part)),
                "regions": max(1, len(self.region_names)), "triangles": len(self.triangles),
                "patches": len(self.patch_names)}
        return html_of(self, "kerf.Mesh", rows, len(self.tetrahedra))


@overload
def mesh(surface: Union[Surface, Path, Sequence[Path]], /, parts: int = 0, size: Size = 0, progress: Progress = None,
         workers: int = 0, output: None = None, comm: None = None, **options: object) -> Mesh: ...


@overload
def mesh(surface: Union[Surface, Path, Sequence[Path]], /, parts: int = 0, size: Size = 0, progress: Progress = None,
         workers: int = 0, *, output: Path, comm: None = None, **options: object) -> Run: ...


@overload
def mesh(surface: Union[Surface, Path, Sequence[Path]], /, parts: int = 0, size: Size = 0, progress: Progress = None,
         workers: int = 0, output: Optional[Path] = None, *, comm: Comm, **options: object) -> DistributedMesh: ...


def mesh(surface: Union[Surface, Path, Sequence[Path]], /, parts: int = 0, size: Size = 0, progress: Progress = None,
         workers: int = 0, output: Optional[Path] = None, comm: Optional[Comm] = None,
         **options: object) -> Union[Mesh, Run, DistributedMesh]:
    """The mesh of a surface, or of a file.

    surface    a Surface, or the path of a file, or a list of several, a region each, as on the command line
    parts      into which the surface is cut; 0: as many as are of use here
    size       wanted edge length, in units of the surface; a text with a share of the diagonal, as "2%"; a function
               of points (n, 3) that returns lengths (n,), see sample_sizes(); a SizeField; 0: none
    progress   True: a line on standard error; or called with (stage, done, total): returning False ends the work
    workers    processes that mesh parts; 0: one for each processor
    output     None: a Mesh in memory; else a folder, for what is larger than memory: a Run, whose parts are the same
               files that `kerf mesh -o` writes. An older run there is replaced; one that was interrupted, or has failed
               parts, goes on where it was
    comm       a communicator of mpi4py, all ranks of which call: each gets its own parts (help(kerf.DistributedMesh))
    options    all others of `kerf mesh`, with underscores: kerf.options() lists them. Those of the surface, as
               fill_holes, belong to where that is made, so here only to a file

    The result depends on the surface and the options alone. Raises UsageError, InputError, MeshingError, OutOfMemory,
    FileError, Cancelled; KeyboardInterrupt ends the workers.
    """
    if not isinstance(surface, Surface):
        surface, options = with_others(surface, options)
    if comm is not None:
        from .distributed import mesh_on_ranks

        return mesh_on_ranks(surface, comm, parts, size, progress, workers, output, **options)
    if output is not None:
        return _run(surface, os.fspath(output), parts, size, workers, progress, options)
    refuse_in_memory(options)
    surface, options = surface_and_options(surface, options)
    sizes, length = split_size(size, surface)
    return Mesh(_kerf.mesh(surface._native, sizes, caller(progress), programs.folder(), parts=parts, size=length,
                           workers=workers, **options))


def surface_and_options(surface: Union[Surface, Path], options: dict[str, Any]) -> tuple[Surface, dict[str, Any]]:
    """The surface, if it is a file read with those of the options that are of it, and the others."""
    of_surface, of_mesh = split(options)
    if not isinstance(surface, Surface):
        return read(surface, **of_surface), of_mesh
    if of_surface:
        raise UsageError(f"{next(iter(of_surface))} is an option of the surface: give it to kerf.Surface(), "
                         "kerf.read() or Surface.repair().")
    return surface, of_mesh


def _run(surface: Union[Surface, Path], folder: str, parts: int, size: Size, workers: int, progress: Progress,
         options: dict[str, object]) -> Run:
    from .run import Run

    if _kerf.has_merged_format(folder):
        raise UsageError(f"output is {folder}, a file of one mesh, but kerf.mesh() writes a folder. Name one, and give "
                         "the file to the merge() of the result; or leave output out, and give it to save().")
    if callable(size):  # of the place, so that it has to be known
        surface, options = surface_and_options(surface, options)
    sizes, length = split_size(size, surface)
    given: Union[_kerf.Surface, str] = surface._native if isinstance(surface, Surface) else os.fspath(surface)
    _kerf.mesh_into(given, folder, sizes, caller(progress), programs.folder(), parts=parts, size=length,
                    workers=workers, **options)
    return Run(folder)


class Tetrahedralization(NamedTuple):
    """What tetrahedralize() returns; it will not grow."""

    nodes: np.ndarray
    tets: np.ndarray


def tetrahedralize(vertices: ArrayLike, faces: ArrayLike, size: Size = 0, progress: Progress = None,
                   **options: Any) -> Tetrahedralization:
    """nodes (n, 3) float64 and tets (m, 4) int64, with order=2 (m, 10), of a closed surface of triangles.

    options    those of Surface() and of mesh(), which tell what is raised
    """
    of_surface, of_mesh = split(options)
    result = mesh(Surface(vertices, faces, **of_surface), size=size, progress=progress, **of_mesh)
    return Tetrahedralization(result.points, result.tetra10 if result.order == 2 else result.tetrahedra)
