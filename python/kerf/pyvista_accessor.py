"""polydata.kerf, the accessor of PyVista 0.48 and later.

    import pyvista
    grid = pyvista.Sphere().kerf.mesh(size=0.1, parts=4)

Where Kerf is installed, PyVista finds it by the entry point "kerf" of the group "pyvista.accessors"; elsewhere `import
kerf.pyvista_accessor` registers it.
"""

from __future__ import annotations

from typing import Any, Optional

import pyvista

from .errors import InputError, UsageError
from .meshing import mesh
from .surface import Surface


@pyvista.register_dataset_accessor("kerf", pyvista.PolyData)
class KerfAccessor:
    """Tetrahedra for a closed surface of triangles."""

    def __init__(self, polydata: pyvista.PolyData) -> None:
        self._polydata = polydata

    def surface(self, patches: Optional[str] = None, **options: object) -> Surface:
        """Surface.from_pyvista() of the data set."""
        return Surface.from_pyvista(self._polydata, patches, **options)

    def mesh(self, patches: Optional[str] = None, **options: Any) -> pyvista.UnstructuredGrid:
        """The tetrahedra, then the triangles of the boundary, with cell data Part and Patch: Mesh.to_pyvista().

        patches    name of the cell data with the patch of each triangle, as for Surface.from_pyvista()
        options    those of kerf.mesh() but `output`: size, parts, ...

        Raises InputError for a surface that is not closed or intersects itself, and as kerf.mesh() does.
        """
        if options.get("output") is not None:
            raise UsageError("polydata.kerf.mesh() gives a grid in memory; kerf.mesh(polydata.kerf.surface(), "
                             "output=...) writes a folder.")
        return mesh(self.surface(patches), **options).to_pyvista()

    def check(self, **options: Any) -> list[dict[str, Any]]:
        """What keeps the surface from being meshed, the worst first, as InputError.elements has it; empty: nothing."""
        try:
            self.surface(**options)
        except InputError as error:
            return error.elements
        return []
