"""Meshes of tetrahedra in memory."""

from __future__ import annotations

import json
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _kerf, interchange
from .notebook import html_of
from .notes import notes_of, notes_text
from .paths import Path, mesh_file
from .quality import Quality

if TYPE_CHECKING:
    import meshio
    import pyvista
    import vtkmodules.vtkCommonDataModel as vtk


class Mesh(_kerf.Mesh):
    """A mesh in memory. Its arrays are read-only views; nothing changes them. It can be pickled and copied."""

    def __init__(self, native: _kerf.Mesh) -> None:
        """Of one that kerf.mesh(), Run.mesh() or another mesh has."""
        super().__init__(native)

    def __copy__(self) -> Mesh:
        return Mesh(self)  # what is found when it is first asked for is found again

    def save(self, path: Path, msh_version: str = "4.1", msh_ascii: bool = False) -> None:
        """Writes a file, whose ending chooses the format: .msh, .vtu, .mesh, .inp, .su2, .node, ... as `kerf merge`.

        msh_version    of Gmsh's files: "4.1" or "2.2"
        msh_ascii      Gmsh's files as text

        Patches and regions have their names there. Raises UsageError for another ending, naming those that there are.
        """
        self._save(mesh_file(path), msh_version, msh_ascii)

    def to_meshio(self) -> meshio.Mesh:
        """A mesh of meshio: a block of tetrahedra for each region, one of triangles for each patch; of order 2
        "tetra10" and "triangle6".

        Cell data `part`, `region` and `patch` (-1 where a cell has none). Names are those of cell sets and, with the
        numbers that `kerf merge` gives them, of field data, so that they survive a write to .msh. A write to .vtu has
        one array, named by all sets, whose values are their numbers: meshio has no other place for them there.
        """
        return interchange.to_meshio(self)

    def to_vtk(self) -> vtk.vtkUnstructuredGrid:
        """A grid of VTK: the tetrahedra, then the triangles of the boundary and of walls; of order 2 quadratic ones.

        Cell data "Part", "Patch" (-1 of tetrahedra) and, of several regions, "Region" (of triangles the one behind);
        field data "PatchNames" and "RegionNames": bytes, a zero behind each name. These are the arrays of Kerf's files.
        The points are not copied: the grid shares them. Raises ImportError without VTK.
        """
        return interchange.to_vtk(self)

    def to_pyvista(self) -> pyvista.UnstructuredGrid:
        """to_vtk(), wrapped by PyVista. Raises ImportError without PyVista."""
        return interchange.to_pyvista(self)

    @cached_property
    def neighbours(self) -> np.ndarray:
        """(m, 4) int64: the tetrahedra on the other sides of the faces opposite to the corners, -1 outside; found when
        they are first asked for."""
        return self._neighbours()

    @cached_property
    def volumes(self) -> np.ndarray:
        """(m,) float64: of the tetrahedra, all positive, in cubed units of the points."""
        return self.cell_quality("volume")

    def cell_quality(self, measure: str) -> np.ndarray:
        """(m,) float64: a measure of each tetrahedron.

        measure    min-dihedral or max-dihedral (degrees), radius-edge, aspect, shape, volume, min-edge or max-edge;
                   Quality tells of them. Raises UsageError for anything else
        """
        return self._cell_quality(measure.replace("_", "-").removesuffix("-deg"))

    def quality(self) -> Quality:
        """Distributions of all measures, with the numbers of `kerf quality --json`; measured at each call."""
        told, text = self._quality()
        return Quality(json.loads(told), text)

    @cached_property
    def report(self) -> dict[str, Any]:
        """What the run tells of itself, as report.json of a folder: input, options, tree, parts, totals with the
        seconds of stages, verification. Empty if there is none."""
        return json.loads(self._report or "{}")

    @property
    def notes(self) -> list[str]:
        """What was changed on the way, and what is not as it was asked for: the sentences that `kerf mesh` prints of
        repairs, remeshing, lengths of edges, sharp cells and bounds that were missed. Empty: there is nothing to say.
        """
        return notes_of(self.report)

    def __repr__(self) -> str:
        return f"<kerf.Mesh: {len(self.points)} points, {len(self.tetrahedra)} tetrahedra{notes_text(self.notes)}>"

    def _repr_html_(self) -> str:
        rows = {"points": len(self.points), "tetrahedra": len(self.tetrahedra), "parts": len(np.unique(self.part)),
                "regions": max(1, len(self.region_names)), "triangles": len(self.triangles),
                "patches": len(self.patch_names), "notes": len(self.notes)}
        return html_of(self, "kerf.Mesh", rows, len(self.tetrahedra))
