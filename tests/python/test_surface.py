"""kerf.Surface, kerf.read() and kerf.check(): laws over many surfaces, whole and broken."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest
from conftest import CUBE_POINTS, CUBE_TRIANGLES

import kerf
from region_boxes import two_boxes

P = np.array(CUBE_POINTS, float)
T = np.array(CUBE_TRIANGLES)
ASSETS = pathlib.Path(os.environ["KERF_ASSETS"])


def two_cubes():
    """Steel beside copper, with a wall of two triangles between them."""
    points = np.vstack([P, P[[1, 2, 5, 6]] + [1, 0, 0]])
    more = [[1, 9, 8], [1, 2, 9], [5, 10, 11], [5, 11, 6], [1, 8, 10], [1, 10, 5], [8, 9, 11], [8, 11, 10], [9, 2, 6],
            [9, 6, 11]]
    sides = [[0, -1]] * 12 + [[1, -1]] * 10
    sides[6] = sides[7] = [0, 1]
    return dict(points=points, triangles=np.vstack([T, more]), sides=sides, regions=["steel", "copper"])


def cube_in_cube(turned):
    inner = P * 0.5 + 0.25
    triangles = T[:, ::-1] if turned else T
    return np.vstack([P, inner]), np.vstack([T, triangles + 8])


def test_of_a_list_of_files_each_is_a_region(tmp_path):
    paths = [tmp_path / "steel.stl", str(tmp_path / "copper.stl"), tmp_path / "tin.stl"]
    for i, path in enumerate(paths):
        kerf.Surface(P + [2 * i, 0, 0], T).save(path)
    assert list(kerf.read(paths).regions) == ["steel", "copper", "tin"]
    assert list(kerf.read(tuple(paths[:2]), with_=[str(paths[2])]).regions) == ["steel", "copper", "tin"]
    assert kerf.read(paths[:1]).regions == kerf.read(paths[0]).regions
    mesh = kerf.mesh(paths[:2], parts=2, workers=1)
    assert list(mesh.region_names) == ["steel", "copper"]
    with pytest.raises(ValueError):
        kerf.mesh([])


# --- what it measures

def moments_of_cells(mesh):
    """Volume, centroid and inertia of tetrahedra, summed by numpy."""
    corners = mesh.points[mesh.tetrahedra]
    volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    centroid = np.einsum("t,tik->k", volumes, corners) / 4 / volumes.sum()
    at = corners - centroid
    sums = at.sum(axis=1)
    second = (np.einsum("t,tij,tik->jk", volumes, at, at) + np.einsum("t,tj,tk->jk", volumes, sums, sums)) / 20
    return volumes.sum(), centroid, np.trace(second) * np.eye(3) - second


@pytest.mark.parametrize("seed", range(20))
def test_moments_of_skewed_boxes(seed):
    random = np.random.default_rng(seed)
    skew, shift = random.normal(size=(3, 3)) + np.eye(3), 10 * random.normal(size=3)
    surface = kerf.Surface(P @ skew.T + shift, T if np.linalg.det(skew) > 0 else T[:, ::-1])
    volume = abs(np.linalg.det(skew))
    second = volume / 12 * skew @ skew.T
    assert surface.volume == pytest.approx(volume)
    assert np.allclose(surface.centroid, skew @ [0.5, 0.5, 0.5] + shift)
    assert np.allclose(surface.inertia, np.trace(second) * np.eye(3) - second)
    axes, moments = surface.principal_axes, surface.principal_moments
    assert np.allclose(axes @ axes.T, np.eye(3))
    assert np.allclose(axes @ surface.inertia @ axes.T, np.diag(moments), atol=1e-3 * moments[2])
    assert np.all(np.diff(moments) >= 0) and np.all(axes[range(3), np.abs(axes).argmax(axis=1)] > 0)
    assert np.array_equal(surface.bounds, [surface.points.min(axis=0), surface.points.max(axis=0)])


def test_moments_are_those_of_the_cells():
    surface = kerf.read(ASSETS / "hollow_box.stl")
    for of in (surface, kerf.Surface(**two_cubes())):
        volume, centroid, inertia = moments_of_cells(kerf.mesh(of, parts=2, surface="split"))
        assert of.volume == pytest.approx(volume)
        assert np.allclose(of.centroid, centroid)
        assert np.allclose(of.inertia, inertia, rtol=1e-9, atol=1e-9 * np.abs(inertia).max())


def test_two_regions_are_one_body_in_its_moments():
    surface = kerf.Surface(**two_cubes())
    assert (surface.volume, surface.area) == pytest.approx((2, 11))
    assert surface.regions == ["steel", "copper"]
    assert np.allclose(surface.centroid, [1, 0.5, 0.5])
    assert np.allclose(surface.inertia, np.diag([2, 5, 5]) / 6)
    assert np.array_equal(surface.principal_axes, np.eye(3))


# --- files

@pytest.mark.parametrize("path", [str, pathlib.Path])
def test_saved_surfaces_are_read_again(tmp_path, path):
    patches = np.repeat([2, 0, 1], 4)
    surface = kerf.Surface(P / 3, T, patches, ["top side", "left", "caf\u00e9"])
    surface.save(path(tmp_path / "cube.obj"))
    again = kerf.read(path(tmp_path / "cube.obj"))
    assert again.volume == surface.volume and sorted(again.names) == ["caf\u00e9", "left", "top_side"]
    assert np.array_equal(again.points[again.triangles].mean(axis=(0, 1)),
                          surface.points[surface.triangles].mean(axis=(0, 1)))
    surface.save(path(tmp_path / "cube.stl"))
    assert kerf.read(path(tmp_path / "cube.stl")).volume == pytest.approx(1 / 27)


def test_regions_are_saved_as_bodies(tmp_path):
    surface = kerf.Surface(**two_cubes())
    surface.save(tmp_path / "two.obj")
    again = kerf.read(tmp_path / "two.obj")
    assert again.regions == surface.regions and len(again.triangles) == 22 and again.volume == surface.volume
    with pytest.raises(kerf.UsageError, match="2 regions, which an .stl cannot tell apart"):
        surface.save(tmp_path / "two.stl")


def test_files_that_cannot_be_written_or_read(tmp_path):
    surface = kerf.Surface(P, T)
    with pytest.raises(kerf.UsageError, match="are written as .obj, .stl"):
        surface.save(tmp_path / "cube.step")
    with pytest.raises(kerf.FileError, match="nowhere"):
        surface.save(tmp_path / "nowhere" / "cube.obj")
    for call in (kerf.read, kerf.check):
        with pytest.raises(kerf.FileError, match="nothing.stl"):
            call(tmp_path / "nothing.stl")
        with pytest.raises(ValueError, match="NUL"):
            call("a\0b")
        with pytest.raises(TypeError):
            call(3)


def test_names_that_are_no_utf8(tmp_path):
    path = os.fsdecode(os.fsencode(tmp_path) + b"/caf\xe9.obj")
    kerf.Surface(P, T, names=["caf\udce9"]).save(path)
    assert kerf.read(path).names == ["caf\udce9"]
    assert kerf.check(path).ok and "caf\udce9" in kerf.check(path).text
    with pytest.raises(kerf.FileError, match="caf\udce9"):
        kerf.read(path + ".stl")


# --- defects

def broken():
    """Name: what Surface() takes, and the kinds of errors that are to be found."""
    cases = {
        "whole": (P, T, []),
        "a hole": (P, T[1:], ["open edge loop"]),
        "two holes": (P, T[[1, 2, 4, 5, 6, 7, 8, 9, 10, 11]], ["open edge loop"] * 2),
        "a fin": (np.vstack([P, [[2, 2, 2]]]), np.vstack([T, [[1, 6, 8]]]), None),
        "a corner pulled through": (P * [1, 1, 1] + np.eye(8)[:, [0]] * 3, T, None),
        "two cubes that overlap": (np.vstack([P, P + 0.5]), np.vstack([T, T + 8]), None),
        "a cube in a cube": (*cube_in_cube(False), ["ambiguous shell"]),
        "a void": (*cube_in_cube(True), []),
        "a copy": (P, np.vstack([T, T[:1]]), None),
        "cubes that share an edge": (np.vstack([P, P + [1, 1, 0]]), np.vstack([T, T + 8]), None),
        "a corner out of range": (P, T + 1, ["wrong row"]),
        "not finite": (P * np.nan, T, ["wrong row"]),
        "flat": (P * [1, 1, 0], T, None),
    }
    for i in range(12):
        cases[f"without triangle {i}"] = (P, np.delete(T, i, axis=0), ["open edge loop"])
        cases[f"triangle {i} turned"] = (P, np.where(np.arange(12)[:, None] == i, T[:, ::-1], T), [])
    return cases


@pytest.mark.parametrize("name", broken())
def test_check_says_what_surface_says(name):
    points, triangles, kinds = broken()[name]
    check = kerf.check(points, triangles)
    try:
        kerf.Surface(points, triangles)
        defects = None
    except kerf.InputError as error:
        defects = error.defects
    assert check.ok == (defects is None)
    assert check.ok == (not check.errors)
    assert kinds is None or [each.kind for each in check.errors] == kinds
    if defects is not None:
        assert [str(each) for each in defects] == [str(each) for each in check.defects]
    for each in check.defects:
        assert each.severity in ("error", "repaired", "warning") and each.text.endswith(".")
        assert each.points.shape[1:] == (3,) and each.facets.dtype == each.vertices.dtype == np.int64
        if len(each.vertices) and each.kind != "wrong row":
            assert np.array_equal(each.points, points[each.vertices])


def test_a_hole_has_its_loop_and_what_to_do():
    with pytest.raises(kerf.InputError) as caught:
        kerf.Surface(P, T[1:])
    hole, = caught.value.defects
    assert set(hole.vertices) == set(T[0]) and hole.measure == pytest.approx(2 + 2**0.5)
    assert "weld" in hole.advice and "--" not in hole.advice + hole.text + str(caught.value)
    assert caught.value.code == 3 and caught.value.elements


def test_check_of_a_file_is_that_of_the_command(tmp_path):
    kerf.Surface(P, T).save(tmp_path / "open.obj")
    lines = (tmp_path / "open.obj").read_text().splitlines()
    (tmp_path / "open.obj").write_text("\n".join(lines[:-1]) + "\n")
    told = subprocess.run([os.environ["KERF_PROGRAM"], "check", "--json", tmp_path / "open.obj"], capture_output=True,
                          text=True).stdout
    check = kerf.check(tmp_path / "open.obj")
    told = json.loads(told)
    assert told.pop("remedy")["repair"] == "near"  # which the command looks for, too
    assert check.report == told
    for defect, row in zip(check.defects, check.report["defects"]):
        assert (defect.kind, defect.severity) == (row["kind"], row["severity"])
        assert (defect.facets.tolist(), defect.vertices.tolist()) == (row["facets"], row["vertices"])
    with pytest.raises(kerf.InputError) as caught:
        kerf.read(tmp_path / "open.obj")
    assert [str(each) for each in caught.value.defects] == [str(each) for each in check.defects]
    (tmp_path / "open.obj").write_text("v 1 2\n")
    refused, = kerf.check(tmp_path / "open.obj").defects
    assert refused.kind == "unreadable" and "line 1" in refused.text


def test_check_of_a_surface_has_no_errors():
    for surface in (kerf.Surface(P, T), kerf.Surface(**two_cubes()), kerf.Surface(*cube_in_cube(True)),
                    kerf.Surface(*cube_in_cube(False), voids="parity"),
                    kerf.Surface(P * [1, 1, 1e-3], T, names=["caf\udce9"])):
        assert surface.check().ok and kerf.check(surface).ok and not surface.check().errors
    needles = kerf.Surface(P * [1, 1, 1e-3], T).check(needle_angle=10).defects
    assert {each.kind for each in needles} == {"needle"} and len(needles) == 8
    assert kerf.Surface(**two_cubes()).check().report["regions"][1]["volume"] == pytest.approx(1)


def test_check_refuses_what_makes_no_sense():
    with pytest.raises(TypeError, match="give triangles"):
        kerf.check(P, patches=[0])
    with pytest.raises(TypeError, match="a Surface, or points with triangles"):
        kerf.check(P)
    with pytest.raises(kerf.UsageError, match="^needle_angle is 90"):
        kerf.check(P, T, needle_angle=90)


# --- what is done to it

def test_options_repair():
    assert kerf.Surface(P, T[1:], fill_holes=3).volume == pytest.approx(1)
    assert kerf.check(P, T[1:], fill_holes=3).ok and not kerf.check(P, T[1:], fill_holes=2).ok
    assert kerf.Surface(*cube_in_cube(False), voids="parity").volume == pytest.approx(7 / 8)
    apart = np.vstack([P, P * 0.5 + 5]), np.vstack([T, T + 8])
    assert kerf.Surface(*apart).repair(keep_largest=True).volume == pytest.approx(1)
    assert kerf.Surface(*apart).repair(scale=2).volume == pytest.approx(9)
    assert kerf.Surface(P[T.ravel()] + 1e-6 * np.arange(108).reshape(36, 3) / 108, np.arange(36).reshape(12, 3),
                        weld=1e-5).volume == pytest.approx(1, abs=1e-4)
    regions = kerf.Surface(**two_cubes()).repair(scale=2)
    assert regions.regions == ["steel", "copper"] and regions.volume == pytest.approx(16)


def test_repair_says_what_it_has_done():
    torn = P[T.ravel()] + 1e-8 * np.arange(108).reshape(36, 3) / 108, np.arange(36).reshape(12, 3)
    with pytest.raises(kerf.InputError, match="--repair|repair"):
        kerf.Surface(*torn)
    surface = kerf.repair(*torn, steps="weld")
    assert surface.volume == pytest.approx(1, abs=1e-6)
    assert [str(repair) for repair in surface.repairs] == ["weld: 28 vertices merged"]
    only, = surface.repairs
    assert only.done and only.count == 28 and only.points.shape[1] == 3 and only.refused_because == ""
    assert kerf.Surface(*torn, repair="weld").volume == surface.volume


def test_repair_leaves_what_is_clean():
    for surface in (kerf.repair(P, T), kerf.repair(kerf.Surface(P, T)), kerf.repair(P, T, steps="none")):
        assert surface.repairs == [] and np.array_equal(surface.points, P) and np.array_equal(surface.triangles, T)


def test_repair_of_a_file(tmp_path):
    kerf.Surface(P, T).save(tmp_path / "cube.obj")
    surface = kerf.repair(tmp_path / "cube.obj", steps="exact")
    assert surface.repairs == [] and surface.volume == pytest.approx(1)
    with pytest.raises(kerf.FileError):
        kerf.repair(tmp_path / "none.obj")


@pytest.mark.parametrize("call, error, words", [
    (lambda: kerf.repair(P, T, steps="holse"), kerf.UsageError, "holse.*weld=TOL"),
    (lambda: kerf.repair(P, T[:5], steps="weld"), kerf.InputError, "open edge loop"),
    (lambda: kerf.repair(P), TypeError, "path"),
    (lambda: kerf.repair("cube.stl", names=["a"]), TypeError, "triangles, too"),
])
def test_repair_refuses_with_words(call, error, words):
    with pytest.raises(error, match=words):
        call()


def test_a_wrap_says_how_far_it_is(tmp_path):
    # A hole that the gap closes, or does not.
    closed, shell = (kerf.wrap(P, T[1:], gap=gap) for gap in (0.8, 0.3))
    for surface in (closed, shell):
        wrapped = surface.wrapped
        assert wrapped.facets_before == 11 and wrapped.facets == len(surface.triangles) and surface.check().ok
        assert 0 <= wrapped.distance_to_input <= wrapped.gap and 0 <= wrapped.distance_from_visible_input <= wrapped.gap
    assert closed.volume > 0.7 > 0.5 > shell.volume > 0
    assert kerf.Surface(P, T).wrapped is None and closed.remesh().wrapped is None
    kerf.Surface(P, T).save(tmp_path / "cube.obj")
    for around in (kerf.wrap(tmp_path / "cube.obj", gap="20%"), kerf.wrap(kerf.Surface(P, T), gap="20%")):
        assert around.volume == pytest.approx(1, abs=0.05) and around.wrapped.gap == pytest.approx(0.2 * 3**0.5)


@pytest.mark.parametrize("call, error, words", [
    (lambda: kerf.wrap(P, T, gap="90%"), kerf.UsageError, "gap"),
    (lambda: kerf.wrap(P, T, gap=1e-9), kerf.UsageError, "gap"),
    (lambda: kerf.wrap(P), TypeError, "path"),
    (lambda: kerf.Surface(P, T, surface="remesh"), kerf.UsageError, "no option of a surface"),
])
def test_wrap_refuses_with_words(call, error, words):
    with pytest.raises(error, match=words):
        call()


@pytest.mark.parametrize("options", [dict(size=0.3), dict(size="20%"), dict(size=0.5, deviation="0.1%"),
                                     dict(deviation=0.01), dict(cells=2000), dict(size=0.5, size_on={"top": 0.2})])
def test_remeshed_surfaces_keep_volume_and_patches(options):
    surface = kerf.Surface(P, T, np.repeat([0, 1, 2], [2, 2, 8]), ["bottom", "top", "sides"])
    fine = surface.remesh(**options)
    assert fine.volume == pytest.approx(1) and fine.names == surface.names and fine.check().ok
    assert np.all(fine.points[np.unique(fine.triangles[fine.patches == 1]), 2] == 1)
    assert len(fine.triangles) > 12 or "size" not in options
    again = surface.remesh(**options)
    assert np.array_equal(again.points, fine.points) and np.array_equal(again.triangles, fine.triangles)


def test_remeshing_can_be_ended():
    surface = kerf.Surface(P, T)
    with pytest.raises(kerf.Cancelled):
        surface.remesh(size=0.01, progress=lambda *step: False)
    with pytest.raises(kerf.UsageError, match="^deviation is"):
        surface.remesh(deviation=-1)


def test_a_region_that_is_inside_out_is_refused(cube):
    """All columns the wrong way close every region, but around nothing."""
    points, triangles = cube
    sides = np.tile([-1, 0], (12, 1))
    boxes = two_boxes()
    for given, name in (((points, triangles, None, None, sides, ["body"]), "body"),
                        ((boxes.points, boxes.triangles, boxes.patches, boxes.names, boxes.sides[:, ::-1],
                          boxes.regions), "steel")):
        with pytest.raises(kerf.InputError, match=f"'{name}' is inside out.*columns of sides") as raised:
            kerf.Surface(*given)
        assert [defect.kind for defect in raised.value.defects] == ["inverted region"]
        check = kerf.check(*given)
        assert not check.ok and [defect.kind for defect in check.errors] == ["inverted region"]
    assert np.isclose(kerf.Surface(points, triangles, sides=sides[:, ::-1], regions=["body"]).volume, 1)
