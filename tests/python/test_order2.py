"""Cells of second order: arrays, runs and files."""

import numpy as np
import pytest

from conftest import CUBE_POINTS, CUBE_TRIANGLES

import kerf

EDGES_OF_TET = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
EDGES_OF_TRIANGLE = [(0, 1), (1, 2), (0, 2)]


@pytest.fixture(scope="module")
def meshed():
    return kerf.mesh(kerf.Surface(CUBE_POINTS, CUBE_TRIANGLES), parts=3, size=0.3, order=2, curve="straight")


def test_nodes_are_in_the_middle_of_their_edges(meshed):
    assert meshed.order == 2
    assert np.array_equal(meshed.tetra10[:, :4], meshed.tetrahedra)
    assert np.array_equal(meshed.triangle6[:, :3], meshed.triangles)
    for cells, corners, edges in ((meshed.tetra10, 4, EDGES_OF_TET), (meshed.triangle6, 3, EDGES_OF_TRIANGLE)):
        for place, (i, j) in enumerate(edges):
            ends = meshed.points[cells[:, i]], meshed.points[cells[:, j]]
            assert np.array_equal(meshed.points[cells[:, corners + place]], 0.5 * (ends[0] + ends[1]))
    nodes = np.unique(meshed.tetra10)
    assert np.array_equal(nodes, np.arange(len(meshed.points)))
    assert np.unique(meshed.tetra10[:, 4:]).min() == np.unique(meshed.tetrahedra).max() + 1


def test_first_order_has_no_such_rows(cube):
    mesh = kerf.mesh(kerf.Surface(*cube), parts=3, size=0.3)
    assert mesh.order == 1 and mesh.tetra10.shape == (0, 10) and mesh.triangle6.shape == (0, 6)
    assert len(kerf.tetrahedralize(*cube, order=2).tets[0]) == 10


def test_a_run_has_the_same_nodes(meshed, cube, tmp_path):
    run = kerf.mesh(kerf.Surface(*cube), parts=3, size=0.3, order=2, curve="straight", output=tmp_path / "run")
    again = run.mesh()
    assert run.order == 2 and run.points_count == len(meshed.points)
    assert np.array_equal(again.points, meshed.points) and np.array_equal(again.tetra10, meshed.tetra10)
    assert np.array_equal(again.triangle6, meshed.triangle6)
    owned = 0
    for part in run.parts:
        assert part.order == 2
        assert np.array_equal(part.points, meshed.points[part.global_ids])
        assert np.array_equal(np.unique(part.tetra10), np.arange(len(part.points)))
        assert part.triangle6.max() < len(part.points)
        owned += np.count_nonzero(part.owner == part.number)
    assert owned == run.points_count
    assert run.verify(without_input=True)


def test_other_libraries_get_cells_of_second_order(meshed):
    of_meshio = meshed.to_meshio()
    assert {block.type for block in of_meshio.cells} == {"tetra10", "triangle6"}
    grid = meshed.to_vtk()
    assert grid.GetNumberOfPoints() == len(meshed.points)
    assert {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())} == {22, 24}


def test_files_of_arrays_are_of_second_order(meshed, tmp_path):
    import meshio

    meshed.save(tmp_path / "mesh.vtu")
    read = meshio.read(tmp_path / "mesh.vtu")
    cells = {block.type: block.data for block in read.cells}
    assert set(cells) == {"tetra10", "triangle6"}
    order = np.lexsort(meshed.points.T)
    assert np.array_equal(read.points[np.lexsort(read.points.T)], meshed.points[order])
