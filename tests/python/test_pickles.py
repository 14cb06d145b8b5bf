"""What holds arrays comes back from a pickle, and from a deep copy, with the same ones."""

import copy
import os
import pickle

import numpy as np
import pytest

import kerf
from kerf import programs
from region_boxes import two_boxes

MESH = ["points", "tetrahedra", "part", "region", "triangles", "patch", "sides", "tetra10", "triangle6", "order",
        "patch_names", "region_names", "report", "neighbours"]
SURFACE = ["points", "triangles", "patches", "names", "sides", "regions", "volume", "repairs", "wrapped"]
PART = ["number", "points", "boundary_points", "global_ids", "owner", "tetrahedra", "region", "triangles", "patch",
        "neighbour", "facet", "tetrahedron", "order", "tetra10", "triangle6", "patch_names", "region_names"]
PART_SURFACE = ["points", "triangles", "patches", "names", "neighbours", "cuts", "global_ids"]
FIELDS = ["displacement", "stress", "von_mises", "cell_stress", "cell_von_mises", "error_indicator"]


def asset(name):
    return os.path.join(os.environ["KERF_ASSETS"], name)


def again(original):
    """Pickled by every protocol, and copied."""
    yield copy.deepcopy(original)
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        yield pickle.loads(pickle.dumps(original, protocol))


def assert_same(original, names):
    for made in again(original):
        assert type(made) is type(original) and made is not original
        for name in names:
            was, now = getattr(original, name), getattr(made, name)
            if isinstance(was, np.ndarray):
                assert np.array_equal(was, now) and was.dtype == now.dtype and was.shape == now.shape, name
                assert not now.flags.writeable or was.flags.writeable, name
            elif name == "repairs":
                assert list(map(repr, was)) == list(map(repr, now))
            else:
                assert was == now, name


@pytest.mark.parametrize("order", [1, 2])
def test_meshes(order):
    assert_same(kerf.mesh(two_boxes(), parts=3, size=0.4, order=order), MESH)


def test_meshes_are_saved_as_before(tmp_path):
    mesh = kerf.mesh(two_boxes(), parts=2, size=0.4, order=2)
    mesh.save(tmp_path / "before.msh")
    pickle.loads(pickle.dumps(mesh)).save(tmp_path / "after.msh")
    assert (tmp_path / "before.msh").read_bytes() == (tmp_path / "after.msh").read_bytes()


def test_surfaces():
    assert_same(two_boxes(), SURFACE)
    for name in ("hollow_box.stl", "pipe_with_holes.stl"):
        assert_same(kerf.read(asset(name)), SURFACE)


def test_surfaces_tell_what_was_done_to_them(cube):
    points, triangles = cube
    open_cube = kerf.repair(points, triangles[2:], steps="full")
    assert len(open_cube.repairs) > 0
    assert_same(open_cube, SURFACE)
    wrap = kerf.wrap(points, triangles, gap=0.3)
    assert wrap.wrapped.facets > 0
    assert_same(wrap, SURFACE)
    assert_same(pickle.loads(pickle.dumps(wrap)), SURFACE)


@pytest.mark.parametrize("order", [1, 2])
def test_parts_of_runs(tmp_path, order):
    run = kerf.mesh(two_boxes(), parts=3, size=0.5, order=order, output=tmp_path / "out")
    assert pickle.loads(pickle.dumps(run)).folder == copy.deepcopy(run).folder == run.folder
    for part in run.parts:
        assert_same(part, PART)
        for made in again(part):
            assert [(s.parts, s.points.tolist()) for s in made.shared] == \
                [(s.parts, s.points.tolist()) for s in part.shared]


def test_size_fields():
    surface = two_boxes()
    field = kerf.sample_sizes(lambda points: 0.2 + 0.1 * points[:, 2], surface)
    assert field.samples > 0
    assert_same(field, ["points", "tetrahedra", "sizes", "error", "samples"])


def test_parts_of_trees():
    for part in kerf.decompose(two_boxes(), parts=4).parts:
        assert_same(part.surface, PART_SURFACE)


def test_solutions(tmp_path):
    try:
        programs.path("kerf-solve")
    except kerf.FileError:
        pytest.skip("kerf-solve is not built")
    run = kerf.mesh(asset("l_bracket.stl"), parts=2, output=tmp_path / "run")
    solution = kerf.solve(run, asset("l_bracket_case.toml"), output=tmp_path / "solution", ranks=1)
    made = pickle.loads(pickle.dumps(solution))
    assert copy.deepcopy(solution) is solution and np.array_equal(made.points, solution.points)
    for fields in (solution.cases[0], solution.part(2)):
        assert_same(fields, FIELDS)
    with pytest.raises(TypeError, match="output"):
        pickle.dumps(kerf.solve(run, asset("l_bracket_case.toml"), ranks=1))


def test_a_pickle_of_another_version_is_refused(tmp_path):
    state = kerf.mesh(two_boxes(), parts=2, output=tmp_path / "out").parts[0].__getstate__()
    made = kerf._kerf.Part.__new__(kerf._kerf.Part)
    for wrong in (("0.0.1", state[1]), (state[0], state[1][:100])):
        with pytest.raises(ValueError, match="pickle"):
            made.__setstate__(wrong)
