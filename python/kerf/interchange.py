"""Meshes and surfaces of other libraries: meshio, VTK, PyVista. They are imported when they are asked for."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Mapping, Optional, Union

import numpy as np

from . import _kerf
from .errors import UsageError

if TYPE_CHECKING:
    import meshio
    import pyvista
    import vtkmodules.vtkCommonDataModel as vtk

#: The arguments of Surface() up to the names, and those of regions.
SurfaceArrays = tuple[np.ndarray, np.ndarray, Optional[np.ndarray], Optional[list[str]]]
RegionArrays = tuple[Optional[np.ndarray], Optional[list[str]]]

#: Meshio's name for the numbers of Gmsh's physical groups.
_GMSH = "gmsh:physical"
#: Arrays in Kerf's own files, and those with their names.
_NAMES_IN_FILES = {"Patch": "PatchNames", "Region": "RegionNames"}


@dataclass
class Values:
    """Arrays of a solution by name: of the points of a mesh, and of its tetrahedra."""

    points: dict[str, np.ndarray] = field(default_factory=dict)
    cells: dict[str, np.ndarray] = field(default_factory=dict)


@dataclass
class _Block:
    """Cells of one region or patch."""

    dimension: int
    number: int
    physical: int  #: Gmsh's number, as `kerf merge` gives it: of patches from 1, of regions behind these
    name: Optional[str]
    rows: np.ndarray
    cells: np.ndarray

    @property
    def kind(self) -> str:
        kinds = {4: "tetra", 10: "tetra10", 3: "triangle", 6: "triangle6"}
        return kinds[self.cells.shape[1]]


def _nodes_of_cells(mesh: _kerf.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Of the tetrahedra and of the triangles: of order 2 those on edges, too."""
    return (mesh.tetra10, mesh.triangle6) if mesh.order == 2 else (mesh.tetrahedra, mesh.triangles)


def _blocks_of(mesh: _kerf.Mesh) -> list[_Block]:
    blocks = []
    tets, triangles = _nodes_of_cells(mesh)
    for region in range(max(1, len(mesh.region_names))):
        rows = np.flatnonzero(mesh.region == region)
        name = mesh.region_names[region] if mesh.region_names else None
        cells = tets if len(rows) == len(tets) else tets[rows]
        blocks.append(_Block(3, region, len(mesh.patch_names) + region + 1, name, rows, cells))
    for patch, name in enumerate(mesh.patch_names):
        if name in mesh.region_names:  # a set has one name for both
            name += "_patch"
        rows = np.flatnonzero(mesh.patch == patch)
        blocks.append(_Block(2, patch, patch + 1, name, rows, triangles[rows]))
    return [block for block in blocks if len(block.rows) > 0]


def _used(count: int, cells: np.ndarray) -> np.ndarray:
    """The points, 0 to count - 1, that are corners of cells; ascending."""
    is_used = np.zeros(count, bool)
    is_used[cells.ravel()] = True
    return np.flatnonzero(is_used)


def _entities_of_points(count: int, blocks: list[_Block]) -> np.ndarray:
    """(count, 2): dimension and tag of the entity of Gmsh that has each point, the first of its patches, or else its
    region. A writer knows no entity without a point, so each gets one that it does not lose."""
    entities = np.zeros((count, 2), np.int32)
    ids = [_used(count, block.cells) for block in blocks]
    in_order = sorted(range(len(blocks)), key=lambda b: (-blocks[b].dimension, -blocks[b].number))
    for b in in_order:
        entities[ids[b]] = blocks[b].dimension, blocks[b].number + 1
    is_kept = np.zeros(count, bool)
    for b in sorted(in_order, key=lambda b: len(ids[b])):
        free = ids[b][~is_kept[ids[b]]]
        if len(free) > 0:
            is_kept[free[0]] = True
            entities[free[0]] = blocks[b].dimension, blocks[b].number + 1
    return entities


def to_meshio(mesh: _kerf.Mesh, values: Optional[Values] = None) -> meshio.Mesh:
    """Mesh.to_meshio(), with the values of a solution."""
    import meshio

    values = values or Values()
    blocks = _blocks_of(mesh)

    def of_cells(array: np.ndarray, dimension: int) -> list[np.ndarray]:
        none = np.nan if array.dtype.kind == "f" else -1
        return [array[block.rows] if block.dimension == dimension else
                np.full((len(block.rows), *array.shape[1:]), none, array.dtype) for block in blocks]

    groups = [np.full(len(block.rows), block.physical, np.int32) for block in blocks]
    entities = [np.full(len(block.rows), block.number + 1, np.int32) for block in blocks]
    cell_data = {"part": of_cells(mesh.part, 3), "region": of_cells(mesh.region, 3), "patch": of_cells(mesh.patch, 2),
                 _GMSH: groups, "gmsh:geometrical": entities}
    cell_data.update((name, of_cells(array, 3)) for name, array in values.cells.items())
    named = [block for block in blocks if block.name is not None]
    sets = {each.name: [np.arange(len(block.rows) if block is each else 0) for block in blocks] for each in named}
    return meshio.Mesh(mesh.points, [(block.kind, block.cells) for block in blocks], cell_data=cell_data,
                       point_data={"gmsh:dim_tags": _entities_of_points(len(mesh.points), blocks), **values.points},
                       field_data={each.name: np.array([each.physical, each.dimension]) for each in named},
                       cell_sets=sets)


def to_vtk(mesh: _kerf.Mesh, values: Optional[Values] = None) -> vtk.vtkUnstructuredGrid:
    """Mesh.to_vtk(), with the values of a solution."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import (VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TRIANGLE, VTK_TETRA, VTK_TRIANGLE,
                                               vtkCellArray, vtkUnstructuredGrid)

    values = values or Values()
    tets, triangles = _nodes_of_cells(mesh)
    grid, points, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(mesh.points))
    cells.SetData(_vtk_ids(np.arange(0, tets.size, tets.shape[1]),
                           np.arange(tets.size, tets.size + triangles.size + 1, triangles.shape[1])),
                  _vtk_ids(tets.ravel(), triangles.ravel()))
    kinds = [VTK_TETRA, VTK_TRIANGLE] if mesh.order == 1 else [VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TRIANGLE]
    types = np.repeat(np.array(kinds, np.uint8), [len(tets), len(triangles)])
    grid.SetPoints(points)
    grid.SetCells(numpy_to_vtk(types, deep=True), cells)

    def add(data: Any, name: str, array: np.ndarray) -> None:
        converted = numpy_to_vtk(array, deep=True)
        converted.SetName(name)
        data.AddArray(converted)

    def of_cells(of_tets: np.ndarray, of_triangles: Optional[np.ndarray] = None) -> np.ndarray:
        if of_triangles is None:
            none = np.nan if of_tets.dtype.kind == "f" else -1
            of_triangles = np.full((len(triangles), *of_tets.shape[1:]), none, of_tets.dtype)
        return np.concatenate([of_tets, of_triangles])

    add(grid.GetCellData(), "Part", of_cells(mesh.part))
    add(grid.GetCellData(), "Patch", of_cells(np.full(len(tets), -1, np.int32), mesh.patch))
    add(grid.GetFieldData(), "PatchNames", _bytes_of_names(mesh.patch_names))
    if mesh.region_names:
        add(grid.GetCellData(), "Region", of_cells(mesh.region, mesh.sides[:, 0]))
        add(grid.GetFieldData(), "RegionNames", _bytes_of_names(mesh.region_names))
    for name, array in values.points.items():
        add(grid.GetPointData(), name, array)
    for name, array in values.cells.items():
        add(grid.GetCellData(), name, of_cells(array))
    return grid


def _vtk_ids(*pieces: np.ndarray) -> Any:
    """One array in memory of VTK's own: a vtkCellArray keeps the numbers that it is given, but not their owner."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkIdTypeArray

    ids = vtkIdTypeArray()
    ids.SetNumberOfValues(sum(len(piece) for piece in pieces))
    np.concatenate(pieces, out=vtk_to_numpy(ids))
    return ids


def to_pyvista(mesh: _kerf.Mesh, values: Optional[Values] = None) -> pyvista.UnstructuredGrid:
    """Mesh.to_pyvista(), with the values of a solution."""
    try:
        import pyvista
    except ImportError as error:
        raise ImportError("PyVista is not installed: pip install pyvista. to_vtk() gives the same grid without "
                          "it.") from error
    return pyvista.wrap(to_vtk(mesh, values))


def _bytes_of_names(names: list[str]) -> np.ndarray:
    """As files of Kerf have them: a zero byte behind each."""
    return np.frombuffer("".join(name + "\0" for name in names).encode(), np.uint8)


def _names_of_bytes(array: np.ndarray) -> list[str]:
    return array.tobytes().decode().split("\0")[:-1]


def _surface(points: np.ndarray, triangles: np.ndarray, patches: Optional[np.ndarray],
             names: Union[Mapping[int, str], list[str], None]) -> SurfaceArrays:
    """Without points that no triangle has; patches numbered from 0 in the order of their numbers."""
    used, corners = np.unique(triangles, return_inverse=True)
    points, triangles = np.asarray(points)[used], corners.reshape(-1, 3)
    if patches is None or isinstance(names, list):
        return points, triangles, patches, names if isinstance(names, list) else None
    numbers, patches = np.unique(patches, return_inverse=True)
    of_number = dict(names or {})
    return points, triangles, patches, [of_number.get(int(n), f"patch_{n}") for n in numbers]


def surface_of_meshio(mesh: meshio.Mesh, patches: Optional[str]) -> tuple[Any, ...]:
    """For Surface.from_meshio()."""
    rows = [i for i, block in enumerate(mesh.cells) if block.type == "triangle"]
    others = sorted({block.type for block in mesh.cells if block.type.startswith(("quad", "polygon", "triangle"))})
    if others not in ([], ["triangle"]):
        raise UsageError(f"The mesh has cells of the types {', '.join(others)}, but a surface is made of plain "
                         "triangles.")
    if not rows:
        raise UsageError("The mesh has no triangles.")
    triangles = np.concatenate([mesh.cells[i].data for i in rows])
    if patches is not None and patches not in mesh.cell_data:
        raise UsageError(f"The mesh has no cell data {patches!r}; there are {', '.join(mesh.cell_data) or 'none'}.")
    regions = _regions_of_meshio(mesh, triangles)
    key = patches or next((name for name in (_GMSH, "Patch") if name in mesh.cell_data), None)
    if key is None:
        return (*_surface(mesh.points, triangles, *_patches_of_sets(mesh, rows, len(triangles))), *regions)
    return (*_surface(mesh.points, triangles, _cell_data(mesh, key, rows), _names_of_meshio(mesh, key, 2)), *regions)


def _cell_data(mesh: meshio.Mesh, key: str, rows: list[int]) -> np.ndarray:
    return np.concatenate([mesh.cell_data[key][i] for i in rows]).astype(np.int64)


def _names_of_meshio(mesh: meshio.Mesh, key: str, dimension: int) -> dict[int, str]:
    """Names by the numbers of a cell data."""
    if key == _GMSH:
        return {int(value[0]): name for name, value in mesh.field_data.items()
                if np.size(value) == 2 and value[1] == dimension}
    names = mesh.field_data.get(_NAMES_IN_FILES.get(key, ""))
    return {} if names is None else dict(enumerate(_names_of_bytes(np.asarray(names, np.uint8))))


def _regions_of_meshio(mesh: meshio.Mesh, triangles: np.ndarray) -> RegionArrays:
    """The regions beside the triangles, and their names: those of the tetrahedra there. None where these are of one
    region, or the triangles are not all that bounds regions."""
    key = next((name for name in (_GMSH, "Region") if name in mesh.cell_data), None)
    rows = [i for i, block in enumerate(mesh.cells) if block.dim == 3]
    if key is None or not rows or any(mesh.cells[i].type != "tetra" for i in rows):
        return None, None
    numbers, regions = np.unique(_cell_data(mesh, key, rows), return_inverse=True)
    if len(numbers) < 2:
        return None, None
    sides = _sides_of(mesh.points, triangles, np.concatenate([mesh.cells[i].data for i in rows]), regions.ravel())
    names = _names_of_meshio(mesh, key, 3)
    return (None, None) if sides is None else (sides, [names.get(int(n), f"region_{n}") for n in numbers])


def _sides_of(points: np.ndarray, triangles: np.ndarray, tets: np.ndarray,
              regions: np.ndarray) -> Optional[np.ndarray]:
    """(m, 2): the regions behind and in front of the triangles, -1: none. None if another face bounds a region."""
    faces = np.sort(tets[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3), axis=1)
    _, numbers = np.unique(np.concatenate([np.sort(triangles, axis=1), faces]), axis=0, return_inverse=True)
    of_triangles, of_faces = np.split(numbers.ravel(), [len(triangles)])
    row = np.full(numbers.max() + 1, -1)
    row[of_triangles] = np.arange(len(triangles))
    corner, region, row = tets.ravel(), np.repeat(regions, 4), row[of_faces]

    a, b, c = (points[triangles[row, i]] for i in range(3))
    is_behind = np.einsum("ij,ij->i", np.cross(b - a, c - a), points[corner] - a) < 0
    sides = np.full((len(triangles), 2), -1)
    sides[row[(row >= 0) & is_behind], 0] = region[(row >= 0) & is_behind]
    sides[row[(row >= 0) & ~is_behind], 1] = region[(row >= 0) & ~is_behind]

    least, largest = (np.full(numbers.max() + 1, value) for value in (len(regions), -1))
    np.minimum.at(least, of_faces, region)
    np.maximum.at(largest, of_faces, region)
    is_bounding = (least < largest) | (np.bincount(of_faces, minlength=len(least)) == 1)
    is_complete = np.count_nonzero(is_bounding) == len(triangles) and (sides[:, 0] != sides[:, 1]).all()
    return sides if is_complete else None


def _patches_of_sets(mesh: meshio.Mesh, rows: list[int],
                     count: int) -> tuple[Optional[np.ndarray], Optional[list[str]]]:
    """The sets as patches, with their names, if each triangle is in one."""
    patches = np.full(count, -1)
    names: list[str] = []
    first = np.cumsum([0] + [len(mesh.cells[i].data) for i in rows])
    for name, members in mesh.cell_sets.items():
        inside = [first[k] + np.asarray(members[i], int) for k, i in enumerate(rows) if members[i] is not None]
        inside = np.concatenate(inside) if inside else np.empty(0, int)
        if len(inside) > 0:
            patches[inside] = len(names)
            names.append(name)
    return (patches, names) if names and patches.min() >= 0 else (None, None)


def surface_of_polydata(polydata: Union[pyvista.PolyData, vtk.vtkPolyData], patches: Optional[str]) -> SurfaceArrays:
    """For Surface.from_pyvista()."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if not hasattr(polydata, "GetPolys"):
        raise UsageError(f"A data set of polygons is wanted, but this is of type {type(polydata).__name__}: "
                         "extract_surface() of PyVista, or vtkGeometryFilter, makes one of a grid.")
    if polydata.GetNumberOfPolys() == 0:
        raise UsageError("The data set has no polygons.")
    polygons = polydata.GetPolys()
    if polygons.GetMaxCellSize() != 3 or polydata.GetNumberOfStrips() > 0:
        raise UsageError("The data set has polygons that are no triangles. triangulate() of PyVista, or "
                         "vtkTriangleFilter, makes triangles of them.")
    triangles = vtk_to_numpy(polygons.GetConnectivityArray()).reshape(-1, 3)
    points = vtk_to_numpy(polydata.GetPoints().GetData())
    found = polydata.GetCellData().GetArray(patches or "Patch")
    if found is None and patches is not None:
        raise UsageError(f"The data set has no cell data {patches!r}.")
    if found is None:
        return _surface(points, triangles, None, None)
    first = polydata.GetNumberOfVerts() + polydata.GetNumberOfLines()
    names = polydata.GetFieldData().GetArray("PatchNames") if patches is None else None
    return _surface(points, triangles, vtk_to_numpy(found)[first:first + len(triangles)],
                    _names_of_bytes(vtk_to_numpy(names)) if names is not None else None)
