"""kerf.mesh(): arrays in, arrays out."""

import json
import os
import pickle
import subprocess

import numpy as np
import pytest

import kerf
from kerf import _kerf

ASSETS = os.environ["KERF_ASSETS"]


def two_boxes(points, triangles):
    """Two unit cubes beside each other as regions, with one wall between them."""
    left = triangles[~(points[triangles][:, :, 0] == 1).all(axis=1)]
    wall = triangles[(points[triangles][:, :, 0] == 1).all(axis=1)]
    right = triangles[~(points[triangles][:, :, 0] == 0).all(axis=1)]
    shifted = points + [1, 0, 0]
    all_points, rows = np.unique(np.concatenate([points, shifted]), axis=0, return_inverse=True)
    rows = rows.reshape(-1)
    facets = np.concatenate([rows[left], rows[wall], rows[right + len(points)]])
    sides = [[0, -1]] * len(left) + [[0, 1]] * len(wall) + [[1, -1]] * len(right)
    return kerf.Surface(all_points, facets, sides=sides, regions=["left", "right"])


@pytest.fixture(params=["cube", "regions", "hollow_box", "cylinder"])
def meshed(request, cube):
    """A surface and its mesh."""
    if request.param == "cube":
        surface = kerf.Surface(*cube, patches=np.arange(12) // 2)
    elif request.param == "regions":
        surface = two_boxes(*cube)
    else:
        surface = kerf.read(os.path.join(ASSETS, request.param + ".stl"), feature_angle=40)
    diagonal = np.linalg.norm(np.ptp(surface.points, axis=0))
    return surface, kerf.mesh(surface, parts=3, size=0.15 * diagonal, workers=2)


def volumes(mesh):
    a, b, c, d = (mesh.points[mesh.tetrahedra[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def areas(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def rows_sorted(rows):
    rows = np.sort(rows, axis=1)
    return rows[np.lexsort(rows.T[::-1])]


def test_tetrahedra_fill_the_surface(meshed):
    surface, mesh = meshed
    assert np.all(volumes(mesh) > 0)
    assert np.isclose(volumes(mesh).sum(), surface.volume)
    assert len(set(mesh.part)) == max(3, len(surface.regions))
    assert set(mesh.tetrahedra.ravel()) == set(range(len(mesh.points)))


def test_triangles_lie_in_the_patches(meshed):
    surface, mesh = meshed
    for patch, name in enumerate(surface.names):
        assert mesh.patch_names[patch] == name
        here = mesh.triangles[mesh.patch == patch]
        wanted = areas(surface.points, surface.triangles[surface.patches == patch]).sum()
        assert np.isclose(areas(mesh.points, here).sum(), wanted)


def test_kept_facets_are_the_boundary(cube):
    surface = kerf.Surface(*cube)
    mesh = kerf.mesh(surface, parts=1, size=0.5, surface="keep")
    kept, given = mesh.points[mesh.triangles], surface.points[surface.triangles]
    assert sorted(sorted(map(tuple, corners)) for corners in kept) == sorted(
        sorted(map(tuple, corners)) for corners in given)


def test_neighbours_are_each_others(meshed):
    _, mesh = meshed
    neighbours = mesh.neighbours
    assert neighbours.shape == mesh.tetrahedra.shape and neighbours.dtype == np.int64
    assert mesh.neighbours is neighbours and not neighbours.flags.writeable
    cell, corner = np.nonzero(neighbours >= 0)
    other = neighbours[cell, corner]
    others_corner = np.nonzero(neighbours[other] == cell[:, None])
    assert np.array_equal(others_corner[0], np.arange(len(cell)))  # each names the other once

    def faces(cells, corners):
        return np.sort(mesh.tetrahedra[cells][np.arange(4) != corners[:, None]].reshape(-1, 3), axis=1)

    assert np.array_equal(faces(cell, corner), faces(other, others_corner[1]))
    outside = np.nonzero(neighbours < 0)
    assert np.array_equal(rows_sorted(faces(*outside)), rows_sorted(mesh.triangles[mesh.sides[:, 1] < 0]))


def test_walls_have_cells_of_both_regions(cube):
    mesh = kerf.mesh(two_boxes(*cube), parts=4, size=0.4)
    assert mesh.region_names == ["left", "right"]
    centres = mesh.points[mesh.tetrahedra].mean(axis=1)
    assert np.array_equal(mesh.region, centres[:, 0] > 1)
    walls = mesh.triangles[mesh.sides[:, 1] >= 0]
    assert np.all(mesh.points[walls][:, :, 0] == 1) and np.isclose(areas(mesh.points, walls).sum(), 1)


@pytest.mark.parametrize("options", [["--size", "0.3", "-n", "3"], ["--size", "40%", "-n", "2", "--mesher", "tetgen"],
                                     ["--size", "0.5", "-n", "1", "--radius-edge", "2"]])
def test_parts_are_those_of_the_command_line(options, tmp_path):
    path, folder = os.path.join(ASSETS, "hollow_box.stl"), tmp_path / "run"
    subprocess.run([os.environ["KERF_PROGRAM"], "mesh", path, "-o", folder, "-q", *options], check=True)
    of_run = _kerf.mesh_of_run(str(folder))
    names = {"-n": "parts"}
    mesh = kerf.mesh(path, **{names.get(name, name[2:]).replace("-", "_"): int(value) if name == "-n" else value
                              for name, value in zip(options[::2], options[1::2])})
    for name in ("points", "tetrahedra", "part", "region", "triangles", "patch", "sides"):
        mine, theirs = getattr(mesh, name), getattr(of_run, name)
        assert mine.dtype == theirs.dtype and mine.shape == theirs.shape and mine.tobytes() == theirs.tobytes(), name
    assert mesh.patch_names == of_run.patch_names


def test_quality_is_that_of_the_command_line(tmp_path):
    path, folder = os.path.join(ASSETS, "hollow_box.stl"), tmp_path / "run"
    program = os.environ["KERF_PROGRAM"]
    subprocess.run([program, "mesh", path, "-o", folder, "-q", "-n", "3", "--size", "20%"], check=True)
    told = json.loads(subprocess.run([program, "quality", folder, "--json"], check=True, capture_output=True).stdout)
    mesh = kerf.mesh(path, parts=3, size="20%")
    quality = mesh.quality()
    quality.json["path"] = told["path"]
    assert quality.json == told
    assert quality.measures["radius_edge"].p1 == told["quality"]["all"]["radius_edge"]["p1"]
    assert "smallest dihedral angle" in str(quality)


def test_measures_of_cells_have_the_ends_of_their_distributions(meshed):
    _, mesh = meshed
    quality = mesh.quality()
    for name, distribution in quality.measures.items():
        values = mesh.cell_quality(name)
        assert values.shape == (len(mesh.tetrahedra),)
        assert (values.min(), values.max()) == (distribution.min, distribution.max)
    assert np.allclose(mesh.volumes, volumes(mesh))
    with pytest.raises(kerf.UsageError, match="radius-edge"):
        mesh.cell_quality("beauty")


def test_regions_have_a_quality_each(cube):
    quality = kerf.mesh(two_boxes(*cube), size=0.4).quality()
    assert [region.name for region in quality.regions] == ["left", "right"]
    assert [region.volume for region in quality.regions] == pytest.approx([1, 1])
    worst = min(region.measures["min_dihedral_deg"].min for region in quality.regions)
    assert worst == quality.measures["min_dihedral_deg"].min


def test_report_is_of_the_run(cube):
    mesh = kerf.mesh(kerf.Surface(*cube), parts=3, size=0.4)
    assert mesh.report["totals"]["tets"] == len(mesh.tetrahedra)
    assert [part["id"] for part in mesh.report["parts"]] == list(dict.fromkeys(mesh.part.tolist()))
    assert mesh.report["verification"]["passed"] is True
    assert mesh.report["files"] == []


def test_many_meshes_leave_nothing(cube, tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    surface = kerf.Surface(*cube)

    def open_files_and_threads():
        return len(os.listdir("/proc/self/fd")), len(os.listdir("/proc/self/task"))

    kerf.mesh(surface, parts=1, size=0.5)
    before = open_files_and_threads()
    for _ in range(20):
        kerf.mesh(surface, parts=1, size=0.5)
    assert open_files_and_threads() == before
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("option", [{"format": "su2"}, {"stl": True}])
def test_files_are_not_for_meshes_in_memory(cube, option):
    with pytest.raises(kerf.UsageError, match=next(iter(option))):
        kerf.mesh(kerf.Surface(*cube), size=0.5, **option)


def test_one_line(cube):
    nodes, tets = kerf.tetrahedralize(*cube, size=0.5)
    assert nodes.shape[1] == 3 and tets.shape[1] == 4 and tets.max() < len(nodes)


def test_a_single_body_keeps_its_name(cube, tmp_path):
    points, triangles = cube
    surface = kerf.Surface(points, triangles, sides=np.tile([0, -1], (12, 1)), regions=["bone"])
    mesh = kerf.mesh(surface, parts=2, size=0.5)
    assert surface.regions == mesh.region_names == ["bone"] and set(mesh.region) == {0}
    for copied in (pickle.loads(pickle.dumps(mesh)), kerf.mesh(pickle.loads(pickle.dumps(surface)), parts=1),
                   kerf.mesh(surface.remesh(size=0.5), parts=1), kerf.mesh(surface.repair(scale=2), parts=1)):
        assert copied.region_names == ["bone"]
    plain = kerf.mesh(kerf.Surface(points, triangles), parts=2, size=0.5)
    assert plain.region_names == [] and np.array_equal(plain.tetrahedra, mesh.tetrahedra)
    assert np.array_equal(plain.cell_quality("volume"), mesh.cell_quality("volume"))
    mesh.save(tmp_path / "a.msh", msh_ascii=True)
    assert '"bone"' in (tmp_path / "a.msh").read_text()
    assert kerf.check(surface).ok and mesh.quality().text
