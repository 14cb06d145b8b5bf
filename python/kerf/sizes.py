"""How fine a mesh is, and where: sizes as arrays, and functions made into them."""

from __future__ import annotations

import numbers
from itertools import permutations
from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike

from . import _kerf
from ._kerf import Surface
from .errors import UsageError
from .options import short

#: Called with points (n, 3); returns the edge lengths (n,) that are wanted there.
SizeFunction = Callable[[np.ndarray], ArrayLike]


class SizeField(_kerf.SizeField):
    """Wanted edge lengths on a background mesh.

    points      (n, 3) floats
    tetrahedra  (m, 4) whole numbers: rows of `points`; of any orientation, conforming or not
    sizes       (n,) floats: positive edge lengths at the points, in units of the surface

    Inside of a tetrahedron sizes are linear; where several lie above each other the smaller one counts. Outside of all
    of them sizes grow from their border. What grows faster than the option `growth` (0.3 if it is not given) from one
    point to another is lowered. Raises InputError, which is a ValueError, naming the row that is wrong.
    """

    #: Largest relative difference from the function that the field was made of, where it was compared; 0 if of none.
    error: float = 0
    #: Points at which that function was asked.
    samples: int = 0

    def __init__(self, points: ArrayLike, tetrahedra: ArrayLike, sizes: ArrayLike) -> None:
        """Copies and checks the arrays."""
        super().__init__(points, tetrahedra, sizes)

    @classmethod
    def from_points(cls, points: ArrayLike, lengths: ArrayLike, lattice: int = 32) -> SizeField:
        """The field of edge lengths that are wanted at points without cells, as those of a cloud.

        points   (n, 3) floats
        lengths  (n,) floats, positive
        lattice  intervals along the longest side of the box around the points, on whose points the field stands

        At a point of the lattice it is the smallest length in the cells around it, or where these have no points that
        of the nearest cells that have some. Raises UsageError for shapes, InputError for lengths that are not positive.
        """
        places, values = (_floats(name, each) for name, each in (("points", points), ("lengths", lengths)))
        if places.ndim != 2 or places.shape[1] != 3 or values.shape != places.shape[:1] or not len(places):
            raise UsageError(f"points has the shape {places.shape}, and lengths {values.shape}, but (n, 3) and (n,) "
                             "are wanted.")
        if lattice < 1:
            raise UsageError(f"lattice is {lattice}, but a positive number is wanted.")
        return cls(*_field_on_lattice(places, values, lattice))

    def __reduce__(self) -> tuple[Any, ...]:
        told = {"error": self.error, "samples": self.samples}
        return SizeField, (self.points, self.tetrahedra, self.sizes), told

    def __repr__(self) -> str:
        return (f"<kerf.SizeField: {len(self.points)} points, {len(self.tetrahedra)} tetrahedra, sizes "
                f"{self.sizes.min():.4g} to {self.sizes.max():.4g}>")


#: What the argument `size` of meshes may be: an edge length; a text with a share of the diagonal, as "2%"; a function
#: of points; or a field. None: none is wanted.
Size = Union[float, str, SizeFunction, SizeField, None]


def sample_sizes(function: SizeFunction, surface: Surface, tolerance: float = 0.05, lattice: int = 32,
                 most_points: int = 250_000) -> SizeField:
    """The field of a function over the bounding box of a surface: what kerf.mesh(size=function) makes of it.

    function     called with points (n, 3) float64 of the box; returns edge lengths (n,) or (n, 1), or one for all:
                 finite and positive, else UsageError names the point. It must depend on the point alone
    tolerance    relative difference between function and field that is sought
    lattice      intervals along the longest side of the box, on whose points the function is asked first: a power of 2
    most_points  at which the function is asked at most, but for the lattice

    The box is divided into cells, and cells into eight, until linear interpolation is within the tolerance at all
    points of the lattice, of finer cells at their midpoints and those of their sides and edges, or until a cell is
    shorter than the sizes in it. `error` of the result is the largest difference that was left. Between these points
    nothing is known: what is narrower than an interval of the lattice may be missed. The function is called once for
    the lattice and once for each finer step, at most seven times more, in an order of points that depends on the box
    alone.
    """
    if lattice < 1 or lattice & (lattice - 1):
        raise UsageError(f"lattice is {lattice}, but a power of 2 is wanted.")
    if not tolerance > 0:
        raise UsageError(f"tolerance is {tolerance}, but a positive share is wanted.")
    sampler = _Sampler(function, surface.points.min(axis=0), surface.points.max(axis=0), lattice, most_points)
    return sampler.field(tolerance)


def split_size(size: Size, surface: Any) -> tuple[Optional[_kerf.SizeField], Union[float, str, None]]:
    """What the argument `size` says as a field, and as the option of the command line: one of them is None.
    `surface` must be one where `size` is a function."""
    if callable(size):
        size = sample_sizes(size, surface)
    if isinstance(size, SizeField):
        return size, None
    if isinstance(size, (tuple, list)) or getattr(size, "ndim", 0) > 0:
        raise UsageError(f"size takes one value, but {short(size)} has several. For lengths at points there is "
                         "kerf.SizeField.from_points(points, lengths).")
    if isinstance(size, numbers.Number) and size == 0:
        raise UsageError("size is 0, but edge lengths are positive: leave it out, or give None, for those of the "
                         "surface.")
    return None, size


_finest_steps = 6  # beyond the lattice
_corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
#: Six tetrahedra of a cube around the diagonal from its first corner to its last; they fit those of cubes beside it.
_tetrahedra_of_cube = np.array([[0, 1 << (2 - a), (1 << (2 - a)) + (1 << (2 - b)), 7]
                                for a, b, _ in permutations(range(3))])


def _weights(steps: int) -> tuple[np.ndarray, np.ndarray]:
    """The points of a cube with so many steps along each side, (n, 3) from 0 to steps, and the shares (n, 8) that its
    corners have in the values there, which are linear in the tetrahedra."""
    axis = np.arange(steps + 1)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    order = np.argsort(-points, axis=1, kind="stable")
    shares = np.take_along_axis(points, order, 1) / steps
    bounded = np.concatenate([np.ones((len(points), 1)), shares, np.zeros((len(points), 1))], 1)
    corner = np.zeros(len(points), int)
    weights = np.zeros((len(points), 8))
    rows = np.arange(len(points))
    for i in range(4):
        np.add.at(weights, (rows, corner), bounded[:, i] - bounded[:, i + 1])
        if i < 3:
            corner = corner + (1 << (2 - order[:, i]))
    return points, weights


class _Sampler:
    """Divides a box; points are numbers of the finest lattice along each side, and values are kept by them."""

    def __init__(self, function: SizeFunction, low: np.ndarray, high: np.ndarray, lattice: int,
                 most_points: int) -> None:
        self._function = function
        self._low, self._high = low, high
        extent = high - low
        steps = np.exp2(np.ceil(np.log2(np.maximum(lattice * extent / extent.max(), 1)))).astype(np.int64)
        self._levels = int(np.log2(steps.min()))  # of cells that the lattice divides
        self._finest = steps << _finest_steps
        self._edge = 1 << (self._levels + _finest_steps)  # of the first cells, in steps of the finest lattice
        self._root = _lattice_points(self._finest // self._edge) * self._edge
        self._keys = np.empty(0, np.int64)
        self._values = np.empty(0)
        self._ask(_lattice_points(steps + 1) << _finest_steps)
        self._left = most_points
        self._error = 0.0

    def field(self, tolerance: float) -> SizeField:
        cells = self._root
        leaves: list[tuple[np.ndarray, int]] = []
        doubts = np.zeros(len(cells))  # differences in the cells that they come from
        for level in range(self._levels + _finest_steps + 1):
            edge = self._edge >> level
            testable = self._known(cells, edge, level, doubts)
            self._leave(leaves, cells[testable:], edge, doubts[testable:])
            differences, least = self._compare(cells[:testable], edge, level)
            sides = ((self._high - self._low) * edge / self._finest).max()
            splits = (differences > tolerance) & (sides > least)
            self._leave(leaves, cells[:testable][~splits], edge, differences[~splits])
            worst = np.argsort(-differences[splits], kind="stable")
            parents = cells[:testable][splits][worst]
            doubts = np.repeat(differences[splits][worst], 8)
            cells = (parents[:, None] + _corners * (edge >> 1)).reshape(-1, 3)
            if not len(cells):
                break
        return self._result(leaves)

    def _known(self, cells: np.ndarray, edge: int, level: int, doubts: np.ndarray) -> int:
        """How many of the cells, the worst of which come first, can be compared with the function."""
        if level < self._levels:
            return len(cells)
        if edge < 2:
            return 0
        offsets, _ = _weights(2)
        testable = min(len(cells), self._left // len(offsets))
        points = (cells[:testable, None] + offsets * (edge >> 1)).reshape(-1, 3)
        self._left -= self._ask(points)
        return testable

    def _compare(self, cells: np.ndarray, edge: int, level: int) -> tuple[np.ndarray, np.ndarray]:
        """Of each cell the largest relative difference from the function, and the least value."""
        steps = 1 << max(1, self._levels - level)
        offsets, weights = _weights(steps)
        differences, least = np.empty(len(cells)), np.empty(len(cells))
        at_once = max(1, 2_000_000 // len(offsets))
        for first in range(0, len(cells), at_once):
            some = slice(first, first + at_once)
            values = self._look_up((cells[some, None] + offsets * (edge // steps)).reshape(-1, 3))
            values = values.reshape(-1, len(offsets))
            corners = self._look_up((cells[some, None] + _corners * edge).reshape(-1, 3)).reshape(-1, 8)
            interpolated = corners @ weights.T
            differences[some] = (np.abs(values - interpolated) / np.minimum(values, interpolated)).max(axis=1)
            least[some] = values.min(axis=1)
        return differences, least

    def _leave(self, leaves: list[tuple[np.ndarray, int]], cells: np.ndarray, edge: int,
               differences: np.ndarray) -> None:
        if len(cells):
            leaves.append((cells, edge))
            self._error = max(self._error, float(differences.max()))

    def _result(self, leaves: list[tuple[np.ndarray, int]]) -> SizeField:
        corners = np.concatenate([(cells[:, None] + _corners * edge) for cells, edge in leaves])
        keys, rows = np.unique(self._key(corners.reshape(-1, 3)), return_inverse=True)
        cubes = rows.reshape(-1, 8)
        field = SizeField(self._places(self._unkey(keys)), cubes[:, _tetrahedra_of_cube].reshape(-1, 4),
                          self._values[np.searchsorted(self._keys, keys)])
        field.error = self._error
        field.samples = len(self._keys)
        return field

    def _key(self, points: np.ndarray) -> np.ndarray:
        count = self._finest + 1
        return (points[:, 0] * count[1] + points[:, 1]) * count[2] + points[:, 2]

    def _unkey(self, keys: np.ndarray) -> np.ndarray:
        count = self._finest + 1
        return np.stack([keys // (count[1] * count[2]), keys // count[2] % count[1], keys % count[2]], 1)

    def _places(self, points: np.ndarray) -> np.ndarray:
        places = self._low + points / self._finest * (self._high - self._low)
        return np.where(points == self._finest, self._high, places)

    def _look_up(self, points: np.ndarray) -> np.ndarray:
        return self._values[np.searchsorted(self._keys, self._key(points))]

    def _ask(self, points: np.ndarray) -> int:
        """Keeps the values at points where they are not known yet, and returns how many these were."""
        keys = np.unique(self._key(points))
        keys = keys[~np.isin(keys, self._keys, assume_unique=True)]
        if not len(keys):
            return 0
        values = _checked(self._function, self._places(self._unkey(keys)))
        order = np.argsort(np.concatenate([self._keys, keys]), kind="stable")
        self._values = np.concatenate([self._values, values])[order]
        self._keys = np.concatenate([self._keys, keys])[order]
        return len(keys)


def _lattice_points(counts: np.ndarray) -> np.ndarray:
    """(n, 3): all whole numbers below the counts."""
    return np.stack(np.meshgrid(*(np.arange(count) for count in counts), indexing="ij"), -1).reshape(-1, 3)


def _floats(name: str, array: ArrayLike) -> np.ndarray:
    try:
        numbers_ = np.asarray(array, float)
    except (TypeError, ValueError) as error:
        raise UsageError(f"{name} is no array of numbers.") from error
    if not np.isfinite(numbers_).all():
        raise UsageError(f"{name} has values that are not finite.")
    return numbers_


def _field_on_lattice(points: np.ndarray, lengths: np.ndarray,
                      intervals: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For SizeField.from_points()."""
    low, extent = points.min(axis=0), np.ptp(points, axis=0)
    edge = extent.max() / intervals or 1.0
    counts = np.maximum(np.ceil(extent / edge), 1).astype(int)
    places = low + (_lattice_points(counts + 1) - 0.5 * (counts - extent / edge)) * edge  # around the middle of the box

    def rows(lattice_points: np.ndarray) -> np.ndarray:
        return np.ravel_multi_index(tuple(np.moveaxis(lattice_points, -1, 0)), tuple(counts + 1))

    cells = np.clip(((points - places[0]) / edge).astype(int), 0, counts - 1)
    sizes = np.full(len(places), np.inf)
    np.minimum.at(sizes, rows(cells[:, None] + _corners), lengths[:, None])
    sizes = sizes.reshape(counts + 1)
    while np.isinf(sizes).any():
        around = sliding_window_view(np.pad(sizes, 1, constant_values=np.inf), (3, 3, 3)).min(axis=(3, 4, 5))
        sizes = np.where(np.isinf(sizes), around, sizes)
    corners = rows(_lattice_points(counts)[:, None] + _corners)
    return places, corners[:, _tetrahedra_of_cube].reshape(-1, 4), sizes.ravel()


def _checked(function: SizeFunction, points: np.ndarray) -> np.ndarray:
    count = len(points)
    try:
        sizes = np.asarray(function(points.copy()))
    except ValueError as error:
        raise UsageError(f"The function of sizes has failed: {error} It is called once for all points, with an array "
                         f"of the shape ({count}, 3), and returns a length for each.") from error
    if sizes.shape in ((), (1,), (count, 1)):
        sizes = np.broadcast_to(sizes.ravel(), (count,))
    if sizes.shape != (count,):
        raise UsageError(f"The function of sizes returned the shape {sizes.shape} for {count} points, but ({count},) is"
                         " wanted.")
    if sizes.dtype.kind not in "fiu":
        raise UsageError(f"The function of sizes returned the dtype {sizes.dtype}, but numbers are wanted.")
    sizes = sizes.astype(float)
    wrong = np.flatnonzero(~((sizes > 0) & np.isfinite(sizes)))
    if len(wrong):
        point = ", ".join(f"{x:.6g}" for x in points[wrong[0]])
        raise UsageError(f"The function of sizes returned {sizes[wrong[0]]} at ({point}), but edge lengths are positive"
                         " and finite.")
    return sizes
