"""Runs in folders: meshes that are larger than memory, and solutions on them."""

from __future__ import annotations

import json
import os
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, Union

import numpy as np

from . import _kerf, interchange
from .errors import Error
from .mesh import Mesh
from .notebook import html_of
from .notes import notes_of, notes_text
from .part import Parts
from .paths import Path, mesh_file
from .progress import Progress, caller
from .quality import Quality
from .surface import Surface
from .verification import Verification

if TYPE_CHECKING:
    import meshio
    import pyvista
    import vtkmodules.vtkCommonDataModel as vtk


class Run(_kerf.Run):
    """A finished run in a folder, as kerf.mesh(output=...), `kerf mesh -o` and kerf.open() give it, or a solution.

        run = kerf.mesh("pump.stl", parts=64, size=0.2, output="pump")
        for part in run.parts:                  # one at a time in memory
            work_on(part.points, part.tetrahedra, part.global_ids)
        run.export("openfoam", "case")

    Opening reads the surfaces of the parts; memory is that of the points on interfaces. Of a solution, parts have its
    values, and what asks for cells alone asks its mesh.
    """

    def __init__(self, folder: Path) -> None:
        """Raises FileError for what is no finished run, VerificationError for one that is not as it was left; both name
        the way out."""
        super().__init__(os.path.abspath(os.fspath(folder)))

    def __reduce__(self) -> tuple[Any, ...]:
        return Run, (self.folder,)

    @property
    def parts(self) -> Parts:
        """A sequence that reads a part when it is asked for: run.parts[0].points."""
        return Parts(self, range(len(self)))

    @property
    def report(self) -> dict[str, Any]:
        """report.json as it is in the folder now: options, tree of cuts, parts, totals, quality, verification."""
        return _report_in(self._solution or self.mesh_folder)

    @property
    def notes(self) -> list[str]:
        """As those of kerf.Mesh; of a solution those of its mesh. Empty for a run of an older version."""
        return notes_of(_report_in(self.mesh_folder))

    def __len__(self) -> int:
        """How many parts there are."""
        return len(self._numbers)

    def mesh(self) -> Mesh:
        """All parts as one mesh in memory, of a solution with the nodes that its values have."""
        return Mesh(_kerf.mesh_of_run(self._solution or self.mesh_folder))

    def verify(self, input: Union[Surface, Path, None] = None, without_input: bool = False) -> Verification:
        """Reads everything again and checks every law of the mesh, one part at a time, as `kerf verify`.

        input          the surface, or where its file is now; None: where the run has read it. Of a run on arrays, the
                       Surface is needed for the comparison with it
        without_input  the laws of the mesh are enough

        A law that does not hold is told by the result. Raises FileError for a part that cannot be read.
        """
        if input is not None and not isinstance(input, Surface):
            input = os.fspath(input)
        found = _kerf.verify(self.mesh_folder, input, without_input)
        return Verification._of(json.loads(found["json"]), found["text"])

    def quality(self) -> Quality:
        """How good the cells are, as `kerf quality`, one part at a time."""
        found = _kerf.quality(self.mesh_folder)
        return Quality(json.loads(found["json"]), found["text"])

    def export(self, format: Union[str, Sequence[str]], path: Optional[Path] = None, *, into: int = 0,
               fields: Union[str, Sequence[str]] = "", msh_ascii: bool = False,
               patch_type: Union[Mapping[str, str], Sequence[str], str] = (), split_regions: bool = False,
               order: int = 0, workers: int = 0, progress: Progress = None) -> list[str]:
        """Writes the parts in the formats of solvers, as `kerf export`, and returns the paths of the files.

        format         one of vtu, msh, openfoam, mfem, hdf5, medit, tetgen, abaqus, su2, vtk, unv, med, cgns,
                       feb, vtp, or several
        path           a folder: one format goes into it, several into sub-folders; None: they become part of the run,
                       in export/FORMAT
        into           pieces into which the parts are joined; 0: as they are
        fields         qualities of the cells in vtu files: "all", "none", or names
        msh_ascii      msh as text
        patch_type     OpenFOAM's types of patches: {"inlet": "patch", "hull": "wall"}
        split_regions  OpenFOAM: one mesh for each region
        order          of the cells: 2 with a node on each edge, 1 without; 0: as in the run
        workers        parts that are written at once; 0: one for each processor

        Raises UsageError for what a format cannot hold, FileError for a file of somebody else in the way.
        """
        if isinstance(patch_type, Mapping):
            patch_type = [f"{name}={kind}" for name, kind in patch_type.items()]
        types = [patch_type] if isinstance(patch_type, str) else list(patch_type)
        return _kerf.export(self.folder, _list(format), "" if path is None else os.fspath(path), into, _list(fields),
                            msh_ascii, types, split_regions, order, workers, caller(progress))

    def merge(self, path: Path, msh_version: str = "4.1", msh_ascii: bool = False, *, order: int = 0) -> None:
        """Writes one mesh into a file, whose ending chooses the format, without ever holding it in memory.

        msh_version    of Gmsh's files: "4.1" or "2.2"
        msh_ascii      Gmsh's files as text
        order          of the cells: 2 with a node on each edge, 1 without; 0: as in the run

        Raises UsageError for another ending, naming those that there are.
        """
        _kerf.merge(self.folder, mesh_file(path), msh_version, msh_ascii, order)

    def to_meshio(self) -> meshio.Mesh:
        """Mesh.to_meshio() of all parts, with the values of a solution."""
        return interchange.to_meshio(self.mesh(), self._values())

    def to_vtk(self) -> vtk.vtkUnstructuredGrid:
        """Mesh.to_vtk() of all parts, with the values of a solution."""
        return interchange.to_vtk(self.mesh(), self._values())

    def to_pyvista(self) -> pyvista.UnstructuredGrid:
        """Mesh.to_pyvista() of all parts, with the values of a solution."""
        return interchange.to_pyvista(self.mesh(), self._values())

    def _values(self) -> interchange.Values:
        """Of a solution, in the order of mesh(): of a point in several parts those of the first. Of a run none."""
        values = interchange.Values()
        if not self._solution:
            return values
        first = 0
        is_set = np.zeros(self.points_count, bool)
        for part in self.parts:
            new = ~is_set[part.global_ids]
            for name, own in part.point_data.items():
                whole = values.points.setdefault(name, np.empty((self.points_count, *own.shape[1:]), own.dtype))
                whole[part.global_ids[new]] = own[new]
            for name, own in part.cell_data.items():
                whole = values.cells.setdefault(name, np.empty((self.tetrahedra_count, *own.shape[1:]), own.dtype))
                whole[first:first + len(own)] = own
            is_set[part.global_ids] = True
            first += len(part.tetrahedra)
        return values

    def _known_notes(self) -> list[str]:
        """The notes; none where the folder is gone by now."""
        try:
            return self.notes
        except (OSError, ValueError, Error):
            return []

    def __repr__(self) -> str:
        kind = "solution" if self._solution else "run"
        return (f"<kerf.Run: {kind} in {self.folder}, {len(self)} parts, {self.points_count} points, "
                f"{self.tetrahedra_count} tetrahedra{notes_text(self._known_notes())}>")

    def _repr_html_(self) -> str:
        rows = {"points": self.points_count, "tetrahedra": self.tetrahedra_count, "parts": len(self),
                "regions": max(1, len(self.region_names)), "patches": len(self.patch_names),
                "notes": len(self._known_notes())}
        return html_of(self.folder, f"kerf.Run {self.folder}", rows, self.tetrahedra_count)


def open(folder: Path) -> Run:
    """The run, or the solution of `kerf solve`, in a folder. Raises FileError for what is none, naming the way out."""
    return Run(folder)


def _report_in(folder: str) -> dict[str, Any]:
    return json.loads(FilePath(folder, "report.json").read_text(encoding="utf-8"))


def _list(names: Union[str, Sequence[str]]) -> str:
    return names if isinstance(names, str) else ",".join(names)
