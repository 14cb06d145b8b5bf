"""Sizes of cells: numbers, texts, functions, fields."""

import numpy as np
import pytest

import kerf


def edges_of(mesh):
    """Midpoints and lengths of the edges."""
    pairs = np.concatenate([mesh.tetrahedra[:, [i, j]] for i in range(4) for j in range(i)])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    a, b = mesh.points[pairs[:, 0]], mesh.points[pairs[:, 1]]
    return (a + b) / 2, np.linalg.norm(a - b, axis=1)


def equal(one, other):
    return one.points.tobytes() == other.points.tobytes() and one.tetrahedra.tobytes() == other.tetrahedra.tobytes()


def interpolated(field, points):
    """The field at each of the points, by whatever tetrahedron holds it."""
    a, b, c, d = (field.points[field.tetrahedra[:, i]] for i in range(4))
    inverse = np.linalg.inv(np.stack([b - a, c - a, d - a], 2))
    values = []
    for p in points:
        t = np.einsum("nij,nj->ni", inverse, p - a)
        shares = np.concatenate([1 - t.sum(axis=1, keepdims=True), t], 1)
        cell = shares.min(axis=1).argmax()
        values.append(shares[cell] @ field.sizes[field.tetrahedra[cell]])
    return np.array(values)


def random_function(random):
    """Smooth, positive, with two hollows."""
    centres, widths, depths = random.random((2, 3)), random.uniform(0.3, 0.6, 2), random.uniform(0.2, 0.4, 2)
    slope = random.uniform(0, 0.3, 3)

    def function(points):
        hollows = sum(depth * np.exp(-((points - centre) ** 2).sum(axis=1) / width ** 2)
                      for centre, width, depth in zip(centres, widths, depths))
        return 0.02 * (1 + points @ slope - hollows)

    return function


class Recorded:
    """A function that keeps what it was asked."""

    def __init__(self, function):
        self.function, self.asked = function, []

    def __call__(self, points):
        assert points.dtype == np.float64 and points.flags.c_contiguous and points.shape[1:] == (3,)
        self.asked.append(points.copy())
        return self.function(points)


def test_a_text_is_a_share_of_the_diagonal(cube):
    surface = kerf.Surface(*cube)
    assert equal(kerf.mesh(surface, parts=2, size="20%"), kerf.mesh(surface, parts=2, size=0.2 * np.sqrt(3)))


@pytest.mark.parametrize("seed", range(6))
def test_fields_are_near_their_functions(cube, seed):
    random = np.random.default_rng(seed)
    surface = kerf.Surface(cube[0] * random.uniform(0.1, 1, 3), cube[1])
    function = Recorded(random_function(random))
    field = kerf.sample_sizes(function, surface, tolerance=0.02)
    points = random.random((100, 3)) * surface.points.max(axis=0)
    assert field.error <= 0.02
    assert np.all(np.abs(interpolated(field, points) / function.function(points) - 1) < 2 * 0.02)
    assert len(function.asked) <= 8 and sum(map(len, function.asked)) == field.samples
    everything = np.concatenate(function.asked)
    assert len(np.unique(everything, axis=0)) == len(everything)
    assert np.all(everything >= 0) and np.all(everything <= surface.points.max(axis=0))
    a, b, c, d = (field.points[field.tetrahedra[:, i]] for i in range(4))
    box = np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)).sum() / 6
    assert np.isclose(box, surface.volume)


def test_what_is_linear_needs_one_cell(cube):
    field = kerf.sample_sizes(lambda points: 0.1 + points[:, 0], kerf.Surface(*cube))
    assert len(field.tetrahedra) == 6 and field.error < 1e-12


def test_points_have_a_bound(cube):
    def jump(points):
        return np.where(points[:, 0] + points[:, 1] < 0.7, 0.002, 0.2)

    field = kerf.sample_sizes(jump, kerf.Surface(*cube), lattice=8, most_points=5000)
    assert field.samples <= 9 ** 3 + 5000
    assert field.error > 0.05  # which it says


def test_edges_follow_a_function(cube):
    def function(points):
        return 0.1 + 0.2 * points[:, 0]

    surface = kerf.Surface(*cube)
    mesh = kerf.mesh(surface, parts=2, size=function, workers=1)
    middles, lengths = edges_of(mesh)
    ratios = lengths / function(middles)
    for low in np.arange(0, 1, 0.25):
        here = (middles[:, 0] >= low) & (middles[:, 0] < low + 0.25)
        assert 0.7 < ratios[here].mean() < 1.3, low
    assert equal(mesh, kerf.mesh(surface, parts=2, size=function, workers=2))
    assert equal(mesh, kerf.mesh(surface, parts=2, size=kerf.sample_sizes(function, surface)))


def test_a_field_of_arrays(cube):
    points = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])
    field = kerf.SizeField(points, [[0, 1, 2, 3]], 0.1 + 0.1 * points[:, 2])
    assert field.sizes.tolist() == pytest.approx([0.1, 0.1, 0.1, 0.5]) and not field.sizes.flags.writeable
    middles, lengths = edges_of(kerf.mesh(kerf.Surface(*cube), parts=1, size=field))
    low, high = middles[:, 2] < 0.3, middles[:, 2] > 0.7
    assert 0.7 < np.mean(lengths[low] / (0.1 + 0.1 * middles[low, 2])) < 1.3
    assert lengths[high].mean() > 1.2 * lengths[low].mean()


@pytest.mark.parametrize("answer, said", [
    (lambda points: points, r"shape \(\d+, 3\)"), (lambda points: [0.1, 0.2], r"shape \(2,\)"),
    (lambda points: np.where(points[:, 0] > 0.5, np.nan, 1), r"nan at \("),
    (lambda points: points[:, 0], r"0.0 at \(0, 0, 0\)"), (lambda points: np.full(len(points), np.inf), "inf at"),
    (lambda points: -np.ones(len(points), int), r"-1.0 at \(0, 0, 0\)")])
def test_wrong_answers_name_their_point(cube, answer, said):
    with pytest.raises(ValueError, match=said):
        kerf.mesh(kerf.Surface(*cube), size=answer)


@pytest.mark.parametrize("points, tetrahedra, sizes, said", [
    ([[0, 0, 0]] * 4, [[0, 1, 2, 4]], [1] * 4, "tetrahedron 0 .* corner 4"),
    ([[0, 0, 0]] * 4, [[0, 1, 2, -1]], [1] * 4, "corner -1"), ([[0, 0, 0]] * 4, [[0, 1, 2, 3]], [1] * 3, "3 for 4"),
    ([[0, 0, 0]] * 4, [[0, 1, 2, 3]], [1, 1, 0, 1], "point 2 .* is 0"), ([[0, 0, 0]] * 4, [], [1] * 4, "no tetrahedra"),
    ([[0, 0, np.inf]] * 4, [[0, 1, 2, 3]], [1] * 4, "point 0"), ([[0, 0]] * 4, [[0, 1, 2, 3]], [1] * 4, r"\(4, 2\)"),
    ([[0, 0, 0]] * 4, [[0, 1, 2]], [1] * 4, "tetrahedra has the shape"),
    ([[0, 0, 0]] * 4, [[0, 1, 2, 3]], [[1]] * 4, "sizes has the shape")])
def test_wrong_fields_name_their_row(points, tetrahedra, sizes, said):
    with pytest.raises(ValueError, match=said):
        kerf.SizeField(points, tetrahedra, sizes)


def test_what_a_function_raises_is_raised(cube):
    def fail(points):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        kerf.mesh(kerf.Surface(*cube), size=fail)
    with pytest.raises(TypeError, match="size takes one value"):
        kerf.mesh(kerf.Surface(*cube), size=[1, 2])


def test_two_fields_are_one_too_many(cube):
    field = kerf.sample_sizes(lambda points: np.full(len(points), 0.5), kerf.Surface(*cube))
    with pytest.raises(kerf.UsageError, match="size_field"):
        kerf.mesh(kerf.Surface(*cube), size=field, size_field="sizes.vtu")
