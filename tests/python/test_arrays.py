"""Arrays of every kind, right and wrong: each makes the surface that it says, or raises a sentence."""

import array

import numpy as np
import pytest
from conftest import CUBE_POINTS, CUBE_TRIANGLES

import kerf

P = np.array(CUBE_POINTS, float)
T = np.array(CUBE_TRIANGLES)
PATCHES = np.repeat(np.arange(6), 2)
OUTSIDE = np.tile([0, -1], (12, 1))


class Frame:
    """What pandas and others are to numpy."""

    def __init__(self, values):
        self.values = values

    def __array__(self, dtype=None):
        return np.asarray(self.values, dtype)


class Failing:
    def __array__(self, dtype=None):
        raise RuntimeError("These numbers cannot be had.")


def unaligned(values):
    """The same in memory that begins at an odd address."""
    memory = np.zeros(values.nbytes + 1, np.uint8)
    view = memory[1:].view(values.dtype).reshape(values.shape)
    view[:] = values
    return view


def read_only(values):
    values = values.copy()
    values.flags.writeable = False
    return values


def every_other(values):
    return np.repeat(values, 2, axis=0)[::2]


def with_row(values, row, value):
    values = values.copy()
    values[row] = value
    return values


def of_type(values, dtype):
    return values.astype(dtype)


GOOD = {
    "lists": (CUBE_POINTS, CUBE_TRIANGLES),
    "tuples": (tuple(map(tuple, CUBE_POINTS)), tuple(map(tuple, CUBE_TRIANGLES))),
    "rows of arrays": (list(P), list(T)),
    **{f"triangles of {dtype}": (P, of_type(T, dtype)) for dtype in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8")},
    **{f"points of {dtype}": (of_type(P, dtype), T) for dtype in ("f2", "f4", "f8", "longdouble", "i4", "u8")},
    "swapped bytes": (of_type(P, ">f8"), of_type(T, ">i4")),
    "order of Fortran": (np.asfortranarray(P), np.asfortranarray(T)),
    "not in one piece": (every_other(P), every_other(T)),
    "columns of wider rows": (np.hstack([P, P])[:, :3], np.hstack([T, T])[:, 3:]),
    "backwards": (P[::-1], 7 - T),
    "read-only": (read_only(P), read_only(T)),
    "unaligned": (unaligned(P), unaligned(T)),
    "objects with __array__": (Frame(P), Frame(T)),
    "matrices": (np.asmatrix(P), np.asmatrix(T)),
    "masked arrays without a mask": (np.ma.array(P), np.ma.array(T)),
    "memoryviews": (memoryview(P), memoryview(T)),
    "points that nobody uses": (np.vstack([P, [[9, 9, 9]]]), T),
    "a point for each corner": (P[T.ravel()], np.arange(36).reshape(-1, 3)),
    "a triangle that is turned": (P, with_row(T, 3, T[3, ::-1])),
    "all triangles turned": (P, T[:, ::-1]),
    "far from the origin": (P + 1e6, T),
    "array.array": (P, T, {"patches": array.array("i", PATCHES)}),
    "patches": (P, T, {"patches": PATCHES}),
    "patches of one byte": (P, T, {"patches": PATCHES.astype("u1"), "names": tuple("abcdef")}),
    "patches that are repeated": (P, T, {"patches": np.broadcast_to(0, 12), "names": np.array(["all"])}),
    "more names than patches": (P, T, {"patches": PATCHES, "names": list("abcdefgh")}),
    "a region": (P, T, {"sides": OUTSIDE, "regions": ["steel"]}),
}


@pytest.mark.parametrize("name", GOOD)
def test_good_arrays_are_the_cube(name):
    points, triangles, *more = GOOD[name]
    arguments = more[0] if more else {}
    surface = kerf.Surface(points, triangles, **arguments)
    assert surface.volume == pytest.approx(1, abs=1e-9)
    assert surface.points.dtype == np.float64 and surface.triangles.dtype == np.int32
    assert surface.points.shape == (8, 3) and surface.triangles.shape == (12, 3)
    assert kerf.check(points, triangles, **arguments).ok


E, V, I = TypeError, ValueError, kerf.InputError
MASKED = np.ma.array(P, mask=np.eye(8, 3))
BAD = {
    "no points": (None, T, E, "points"),
    "no triangles": (P, None, E, "triangles"),
    "texts": (P.astype(str), T, E, "points has the dtype"),
    "a text": ("cube", T, E, "points"),
    "bytes": (b"cube", T, E, "points"),
    "objects": (P.astype(object), T, E, "dtype object"),
    "a dict": ({"x": 1}, T, E, "points"),
    "a set": (P, {1, 2}, E, "triangles"),
    "a generator": ((row for row in P), T, E, "points"),
    "truth values": (P, T.astype(bool), E, "triangles has the dtype bool"),
    "points that are truth values": (P.astype(bool), T, E, "points has the dtype bool"),
    "complex numbers": (P.astype(complex), T, E, "complex128"),
    "dates": (P.astype("M8[s]"), T, E, "datetime64"),
    "records": (np.zeros(8, "f8,f8,f8"), T, E, "points"),
    "corners that are no whole numbers": (P, T.astype(float), E, "triangles has the dtype float64"),
    "rows of different lengths": ([[0, 0, 0], [1, 0]], T, E, "rows have different lengths"),
    "whole numbers beyond 64 bits": (P, [[0, 1, 2**70]], E, "dtype object"),
    "plane points": (P[:, :2], T, V, "(8, 2), but (n, 3)"),
    "points as columns": (P.T, T, V, "(3, 8), but (n, 3)"),
    "four corners": (P, np.hstack([T, T[:, :1]]), V, "(12, 4), but (n, 3)"),
    "a flat list": (P.ravel(), T, V, "(24,)"),
    "three dimensions": (P[None], T, V, "(1, 8, 3)"),
    "a number": (1.0, T, V, "()"),
    "a number of no dimension": (P, np.array(3), V, "()"),
    "nothing of no dimension": (P, np.empty((0, 0, 0), int), V, "(0, 0, 0)"),
    "more rows than 32 bits count": (P, np.broadcast_to(0, (2**31, 3)), V, "2147483648 rows"),
    "masked points": (MASKED, T, V, "points has values that are masked"),
    "corners beyond 32 bits": (P, with_row(T, (3, 1), 2**40), V, "1099511627776 in row 3"),
    "corners beyond 63 bits": (P, with_row(T.astype("u8"), (5, 0), 2**64 - 1), V, "18446744073709551615 in row 5"),
    "corners far below 0": (P, with_row(T, (2, 0), -2**33), V, "-8589934592 in row 2"),
    "a corner that is no point": (P, with_row(T, (4, 2), 8), I, "triangles[4] is (0, 1, 8)"),
    "a corner below 0": (P, with_row(T, (4, 2), -1), I, "triangles[4] is (0, 1, -1)"),
    "a corner twice": (P, with_row(T, 4, [0, 1, 1]), I, "triangles[4]"),
    "a point that is NaN": (with_row(P, (6, 1), np.nan), T, I, "points[6] is (1, nan, 1)"),
    "a point that is infinite": (with_row(P, (6, 1), -np.inf), T, I, "points[6]"),
    "a point beyond doubles": (with_row(P.astype("longdouble"), 6, np.longdouble("1e400")), T, I, "points[6]"),
    "huge points": (P * 1e300, T, I, "absurd"),
    "tiny points": (P * 1e-300, T, I, "absurd"),
    "no rows at all": (np.empty((0, 3)), np.empty((0, 3), int), I, "no facets"),
    "empty lists": ([], [], I, "no facets"),
    "triangles of no points": ([], T, I, "triangles[0]"),
    "points of no triangles": (P, np.empty((0, 3), int), I, "no facets"),
    "a hole": (P, T[1:], I, "open edge loop"),
    "a sheet": (P, T[:2], I, "one plane"),
    "points in one place": (P * 0, T, I, ""),
    "points in a row": (P * [1, 0, 0], T, I, ""),
}
WRONG = {
    "too few patches": ({"patches": PATCHES[1:]}, V, "patches has 11 rows, but there are 12 triangles"),
    "no patches": ({"patches": []}, V, "patches has 0 rows"),
    "patches in two columns": ({"patches": PATCHES.reshape(6, 2)}, V, "(6, 2), but (n,)"),
    "patches that are no numbers": ({"patches": ["a"] * 12}, E, "patches has the dtype"),
    "a patch below 0": ({"patches": PATCHES - 1}, I, "patches[0] is -1"),
    "a patch without a name": ({"patches": PATCHES, "names": ["a"]}, I, "patches[2] is 1"),
    "one text as names": ({"names": "abc"}, E, "names"),
    "names that are numbers": ({"names": [1, 2]}, E, "names has 1"),
    "sides without regions": ({"sides": OUTSIDE}, V, "sides and regions"),
    "regions without sides": ({"regions": ["a"]}, V, "sides and regions"),
    "sides in three columns": ({"sides": T, "regions": ["a"]}, V, "(12, 3), but (n, 2)"),
    "too few sides": ({"sides": OUTSIDE[1:], "regions": ["a"]}, V, "sides has 11 rows"),
    "sides beyond the regions": ({"sides": OUTSIDE + 1, "regions": ["a"]}, I, "sides[0]"),
    "the same on both sides": ({"sides": OUTSIDE * 0, "regions": ["a"]}, I, ""),
    "no names of regions": ({"sides": OUTSIDE, "regions": []}, V, "0 names of regions"),
    "regions that are no texts": ({"sides": OUTSIDE, "regions": [None]}, E, "regions has None"),
}
BAD = {**{name: (p, t, {}, *wanted) for name, (p, t, *wanted) in BAD.items()},
       **{name: (P, T, *wanted) for name, wanted in WRONG.items()}}


@pytest.mark.parametrize("name", BAD)
def test_bad_arrays_raise_a_sentence(name):
    points, triangles, arguments, kind, words = BAD[name]
    with pytest.raises(kind) as caught:
        kerf.Surface(points, triangles, **arguments)
    text = str(caught.value)
    assert words in text and text.endswith((".", "?")) and "--" not in text and "pybind" not in text
    if kind is I:
        assert caught.value.defects and all(defect.text for defect in caught.value.defects)
        check = kerf.check(points, triangles, **arguments)
        assert not check.ok
        assert [each.kind for each in check.defects] == [each.kind for each in caught.value.defects]
    elif triangles is not None:
        with pytest.raises(kind):
            kerf.check(points, triangles, **arguments)


def test_what_an_array_raises_is_raised():
    with pytest.raises(RuntimeError, match="cannot be had"):
        kerf.Surface(Failing(), T)


def test_arrays_given_are_copied():
    points = P.copy()
    surface = kerf.Surface(points, T)
    points[:] = 7
    assert surface.volume == 1 and np.array_equal(surface.points, P)


def test_arrays_are_read_only_views():
    surface = kerf.Surface(P, T, PATCHES)
    for name in ("points", "triangles", "patches", "sides"):
        view = getattr(surface, name)
        assert np.shares_memory(view, getattr(surface, name))
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 0
    views = surface.points, surface.triangles
    del surface
    assert np.array_equal(views[0], P) and np.array_equal(views[1], T)


def test_all_that_is_refused_is_an_error_of_kerf(cube):
    """`except kerf.Error` is enough, and so are the exceptions that Python's own functions raise."""
    points, triangles = cube
    wrong = [lambda: kerf.Surface(points.astype(complex), triangles),
             lambda: kerf.Surface(points[:, :2], triangles),
             lambda: kerf.Surface([[0, 0, 0], [1, 0]], triangles),
             lambda: kerf.Surface(points, triangles.astype(float)),
             lambda: kerf.Surface(points, triangles, [0]),
             lambda: kerf.Surface(points, triangles, sides=np.zeros((12, 2), int)),
             lambda: kerf.Surface(points, triangles, names="lid"),
             lambda: kerf.Surface(np.ma.masked_less(points, 0.5), triangles),
             lambda: kerf.check(points),
             lambda: kerf.check(points, triangles + 0.5),
             lambda: kerf.repair(points, names=["lid"]),
             lambda: kerf.read(7),
             lambda: kerf.read([]),
             lambda: kerf.read("a\0b"),
             lambda: kerf.SizeField(points, triangles, np.ones(8)),
             lambda: kerf.mesh(kerf.Surface(points, triangles), max_volume=object()),
             lambda: kerf.mesh(kerf.Surface(points, triangles), size=lambda p: p),
             lambda: kerf.plot(3)]
    for call in wrong:
        with pytest.raises(kerf.UsageError) as raised:
            call()
        assert isinstance(raised.value, ValueError) and isinstance(raised.value, TypeError) and raised.value.code == 2
