#!/usr/bin/env python3
"""Random calls of the module of Python: each ends with a result, or with an exception that it may have.

python_calls.py [COUNT] [--seed SEED] [--first CALL] [--verbose]

A call depends on the seed and its number alone, so that what is found can be called again: --seed S --first N 1.
Anything but a result or a kerf.Error, TypeError, ValueError, or MemoryError is a finding, as is a call that takes
longer than PATIENCE, and of course a crash. Under the address sanitizer:

    cmake --preset asan -DKERF_PYTHON=ON
    cmake --build build-asan --target kerf_python kerf-worker
    export LD_PRELOAD="$(gcc -print-file-name=libasan.so) $(gcc -print-file-name=libstdc++.so)"
    ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 PYTHONPATH=build-asan/python \\
        /usr/bin/python3 tests/fuzz/python_calls.py 10000
"""

import argparse
import collections
import os
import pathlib
import signal
import sys
import tempfile
import traceback

import numpy as np

import kerf

# Of workers; the sanitizer, which they are started with, too, reserves more than there is.
MEMORY = "0" if "LD_PRELOAD" in os.environ else "1G"
PATIENCE = 60  # seconds; of all that is asked for here, a second is enough on an idle machine

CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
SIDES = np.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6],
                  [0, 6, 2], [1, 3, 7], [1, 7, 5]])
GARBAGE = [None, 0, -1, 1.5, float("nan"), float("inf"), 2**40, 2**70, True, "", "cube", "a\0b", "\udcff\ud800", b"x",
           (), [], [[]], [[1, 2, 3], [4]], {}, {"a": 1}, {1, 2}, object(), object, len, 1j, np.float32(3), np.array(5),
           np.empty((0, 3)), np.empty((0, 0, 0)), np.zeros((3, 3)), np.array(["a"]), np.array([None, 1]),
           np.zeros(2, "f8,i4"), np.ma.masked, range(3), iter([1]), memoryview(b"abc"), Ellipsis, slice(1)]
DTYPES = ["f2", "f4", "f8", "longdouble", "c16", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", ">f8", ">i4", ">u8",
          "?", "O", "U8", "S8", "M8[s]"]
SPOILT = [np.nan, np.inf, -np.inf, 1e308, -1e308, 1e-320, 1e51, -1, 2**31 - 1, 2**31, -2**31 - 1, 2**62, 12, 0, 1]


class TooLong(BaseException):
    """A call took longer than PATIENCE."""


def grid_surface(random):
    """A box with n x n squares on each side: points and triangles, in a random place and of a random shape."""
    n = int(random.integers(1, 4))
    points, triangles = [], []
    for axis in range(3):
        for side in (0, 1):
            first = len(points)
            for i in range(n + 1):
                for j in range(n + 1):
                    points.append(np.roll([side, i / n, j / n], axis))
            for i in range(n):
                for j in range(n):
                    a, b, c, d = (first + (i + di) * (n + 1) + j + dj for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)))
                    triangles += [[a, b, c], [a, c, d]] if side else [[a, c, b], [a, d, c]]
    return np.array(points) * random.uniform(0.2, 3, 3), np.array(triangles)


def bodies(random):
    """What Surface() takes, and makes something of, in most cases."""
    kind = random.integers(6)
    if kind == 0:
        return dict(points=CORNERS[[0, 1, 2, 4]], triangles=np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]))
    points, triangles = grid_surface(random) if kind < 3 else (CORNERS, SIDES)
    if kind == 4:  # a second one, that overlaps, touches or is inside
        points = np.vstack([points, points * random.choice([0.5, 1, 2]) + random.choice([0, 0.25, 1, 5], 3)])
        triangles = np.vstack([triangles, random.choice([1, -1]) * (triangles[:, ::random.choice([1, -1])] + 8)])
        triangles = np.abs(triangles)
    body = dict(points=points, triangles=triangles)
    if random.random() < 0.4:
        body["patches"] = random.integers(0, 3, len(triangles))
        body["names"] = ["a", "b b", "\udce9\u00e9"]
    if kind == 5:
        body["sides"] = np.tile([0, -1], (len(triangles), 1))
        body["regions"] = ["steel"]
    return body


def spoil(array, random):
    """The array with something wrong with it, or nothing but odd."""
    array = np.asarray(array)
    trick = random.integers(16)
    if trick == 0 or array.size == 0:
        return GARBAGE[random.integers(len(GARBAGE))]
    if trick == 1:
        with np.errstate(all="ignore"):
            return array.astype(DTYPES[random.integers(len(DTYPES))])
    if trick == 2:
        return array[random.random(len(array)) < random.choice([0.5, 0.95])]
    if trick in (3, 4, 5):
        wide = array.astype("f8" if array.dtype.kind == "f" else "O")
        wide.reshape(-1)[random.integers(array.size)] = SPOILT[random.integers(len(SPOILT))]
        return wide if array.dtype.kind == "f" else np.array(wide.tolist())
    if trick == 6:
        return random.permutation(array)
    if trick == 7:
        return [array.T, array.ravel(), array[None], array[..., None], array[:, :2] if array.ndim > 1 else array[:1],
                np.hstack([array, array])][random.integers(6)]
    if trick == 8:
        return np.asfortranarray(array)
    if trick == 9:
        return np.repeat(array, 3, axis=0)[::3]
    if trick == 10:
        memory = np.zeros(array.nbytes + 1, np.uint8)
        view = memory[1:].view(array.dtype).reshape(array.shape)
        view[:] = array
        return view
    if trick == 11:
        return np.ma.array(array, mask=random.random(array.shape) < 0.05)
    if trick == 12:
        return array * random.choice([0, -1, 1e-60, 1e-6, 1e3, 1e30, 1e200])
    if trick == 13:
        return array.tolist() if random.random() < 0.5 else tuple(map(tuple, np.atleast_2d(array)))
    if trick == 14:
        return np.concatenate([array, array[random.integers(0, len(array), 3)]])
    return random.normal(size=array.shape) if array.dtype.kind == "f" else random.integers(-1, 9, array.shape)


def value_of(option, random):
    """Of an option, good or bad; sizes are such that not too many cells come of them."""
    if random.random() < 0.25:
        return GARBAGE[random.integers(len(GARBAGE))]
    pools = {"flag": [True, False, "true", 1], "choice": [*option.choices, "none"],
             "whole number": [0, 1, 2, 3, -1, 2**31, "3", 2.0], "number": [0, 0.5, 1.4, 2, 30, -1, "1,5"],
             "length": ["30%", "50%", "100%", "-1%", "1e9%", 1e9, 0], "count": [0, 20, "100", "0.2k", -5],
             "memory": ["300M", "1G", 0, "x", 500], "text": ["", "all", "q1.5", "nothing/there.msh", "a=b"],
             "list": [[], {"a": "50%"}, {"a": ("50%", "10%")}, {"steel": (0.3, 0.3, 0.3)}, "a=1",
                      ["sphere:0,0,0,1=50%"]]}
    pool = pools[option.kind]
    return pool[random.integers(len(pool))]


def options_for(random, of_surface):
    """Keyword arguments, mostly of the right place."""
    table = [each for each in kerf.options() if each.is_of_surface == of_surface or random.random() < 0.02]
    given = {}
    for _ in range(random.poisson(0.8)):
        option = table[random.integers(len(table))]
        name = option.name if random.random() < 0.95 else option.name[:-1] + "x"
        # Values of these are files to be written, or such as take long.
        if name not in ("report", "trace", "events", "attempts", "optimise_surface", "scale", "segments_per_turn",
                        "cells_across", "growth", "max_volume"):
            given[name] = value_of(option, random)
    return given


def make_surface(random):
    body = bodies(random)
    for name in body:
        if random.random() < 0.15:
            body[name] = spoil(body[name], random)
    return body


def use(surface, random, folder):
    """Something that a surface can do."""
    what = random.integers(8)
    if what < 2:
        timed = dict(timeout=20, workers=1, memory=MEMORY)
        mesh = kerf.mesh(surface, **{**timed, "parts": int(random.integers(1, 4)), **options_for(random, False)})
        assert len(mesh.tetrahedra) and mesh.tetrahedra.max() < len(mesh.points)
    elif what == 2:
        surface.remesh(**{"size": random.choice(["20%", "50%"]), **options_for(random, False)})
    elif what == 3:
        surface.repair(**options_for(random, True))
    elif what == 4:
        path = folder / random.choice(["s.obj", "s.stl", "s.vtk", "no/s.obj"])
        surface.save(path)
        kerf.read(path, **options_for(random, True))
    elif what == 5:
        assert all(str(defect) for defect in surface.check(needle_angle=random.choice([0, 1, 30, 61])).defects)
    else:
        found = surface.bounds, surface.centroid, surface.inertia, surface.principal_axes, surface.principal_moments
        assert all(np.isfinite(each).all() for each in found)
        repr((surface, surface.names, surface.regions, surface.volume, surface.area, surface.sides))


def read_bytes(random, folder):
    """A file that is none, or nearly one."""
    kerf.Surface(CORNERS, SIDES).save(folder / "r.obj")
    content = bytearray((folder / "r.obj").read_bytes())
    for _ in range(random.integers(0, 4)):
        content[random.integers(len(content))] = random.integers(256)
    path = folder / "r.obj"
    path.write_bytes(bytes(content))
    if random.random() < 0.5:
        return str(kerf.check(path, **options_for(random, True)))
    return kerf.read(path, **options_for(random, True))


def call(random, folder):
    """One random call, or what follows it."""
    what = random.integers(10)
    if what == 0:
        return read_bytes(random, folder)
    body = make_surface(random)
    if what == 1:
        points, triangles = body.pop("points"), body.pop("triangles")
        return str(kerf.check(points, triangles, **body, **options_for(random, True)))
    if what == 2:
        return kerf.tetrahedralize(body["points"], body["triangles"], timeout=20, workers=1, memory=MEMORY,
                                   **{key: value for key, value in options_for(random, random.random() < 0.5).items()
                                      if key not in ("timeout", "workers", "memory")})
    if what == 3:
        odd = GARBAGE[random.integers(len(GARBAGE))]
        return [kerf.Surface, kerf.check, kerf.read, kerf.mesh, kerf.tetrahedralize][random.integers(4)](odd)
    return use(kerf.Surface(**body, **options_for(random, True)), random, folder)


def outcome_of(number, seed, folder):
    """What became of the call with this number: "result", or the name of the exception. Raises what is a finding."""
    random = np.random.default_rng([seed, number])
    signal.alarm(PATIENCE)
    try:
        call(random, folder)
        return "result"
    except (kerf.Error, TypeError, ValueError, MemoryError) as error:
        if type(error) is kerf.Error or not str(error):
            raise
        return type(error).__name__
    finally:
        signal.alarm(0)


def too_long(signum, frame):
    raise TooLong(f"The call takes longer than {PATIENCE} seconds.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", nargs="?", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--verbose", action="store_true", help="tell the number of each call before it")
    arguments = parser.parse_args()
    signal.signal(signal.SIGALRM, too_long)
    outcomes = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for number in range(arguments.first, arguments.first + arguments.count):
            if arguments.verbose:
                print(number, flush=True)
            try:
                outcomes[outcome_of(number, arguments.seed, pathlib.Path(folder))] += 1
            except BaseException as finding:
                traceback.print_exc()
                print(f"Call {number} of seed {arguments.seed} is a finding.", file=sys.stderr)
                if isinstance(finding, KeyboardInterrupt):
                    return 130
                outcomes["FINDING"] += 1
        os.chdir("/")
    print(", ".join(f"{count} {name}" for name, count in outcomes.most_common()))
    return 1 if outcomes["FINDING"] else 0


if __name__ == "__main__":
    sys.exit(main())
