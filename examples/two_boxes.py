"""The body of the examples on ranks: unit cubes of two materials side by side, from x = 0 to 2.

Between patch "left" at 0 degrees and patch "right" at 4 degrees heat flows through both; nothing else is held.
"""

import numpy as np

import kerf

CONDUCTIVITY = {"steel": 3.0, "glass": 1.0}


def surface():
    """Triangles of both cubes, and of the wall at x = 1 between them once."""
    points = np.array([[x, y, z] for x in range(3) for y in range(2) for z in range(2)], float)
    quads = {"left": [(0, 1, 3, 2)], "right": [(8, 10, 11, 9)], "wall": [(4, 6, 7, 5)],
             "around": [each for x in (0, 4) for each in ((x, x + 4, x + 5, x + 1), (x + 2, x + 3, x + 7, x + 6),
                                                          (x, x + 2, x + 6, x + 4), (x + 1, x + 5, x + 7, x + 3))]}
    behind_and_in_front = {"left": [(0, -1)], "right": [(1, -1)], "wall": [(0, 1)],
                           "around": [(0, -1)] * 4 + [(1, -1)] * 4}
    triangles, patches, sides = [], [], []
    for patch, name in enumerate(quads):
        for (a, b, c, d), regions in zip(quads[name], behind_and_in_front[name]):
            triangles += [(a, b, c), (a, c, d)]
            patches += [patch] * 2
            sides += [regions] * 2
    return kerf.Surface(points, triangles, patches, list(quads), sides, list(CONDUCTIVITY))


def temperature(points):
    """The exact one: a flux of 3 everywhere, so a slope of 1 in steel and 3 in glass."""
    x = points[:, 0]
    return np.where(x < 1, x, 3 * x - 2)
