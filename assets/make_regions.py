#!/usr/bin/python3
"""Make the STL surfaces of two bodies that touch: bone.stl and cement.stl.

    make_regions.py [DIR]

A block of bone, a cylinder of radius 2 and height 6, has a hole of radius 1
from its top down to height 2, which cement fills.  Where they touch both
files have the same triangles, turned round.  Needs Python alone; the results
are committed.
"""

import math
import os
import struct
import sys

STEP = 0.25  # of rings, layers and edges
INNER, OUTER = 4, 8  # rings of the hole and of the block
BOTTOM, FLOOR, TOP = 0.0, 2.0, 6.0


def point(ring, i, z):
    """Vertex i of the 6 * ring ones on a ring; ring 0 is the axis."""
    if ring == 0:
        return (0.0, 0.0, z)
    turn = 2 * math.pi * (i % (6 * ring)) / (6 * ring)
    radius = STEP * ring
    return tuple(float(struct.unpack("<f", struct.pack("<f", x))[0])
                 for x in (radius * math.cos(turn), radius * math.sin(turn), z))


def disc(first, last, z):
    """The triangles between two rings, their normals upwards."""
    triangles = []
    for ring in range(first, last):
        for sector in range(6):
            inner, outer = sector * ring, sector * (ring + 1)
            for i in range(ring + 1):
                triangles.append((point(ring, inner + i, z), point(ring + 1, outer + i, z),
                                  point(ring + 1, outer + i + 1, z)))
                if i < ring:
                    triangles.append((point(ring, inner + i, z), point(ring + 1, outer + i + 1, z),
                                      point(ring, inner + i + 1, z)))
    return triangles


def tube(ring, low, high):
    """The triangles of a tube, their normals away from the axis."""
    triangles = []
    layers = round((high - low) / STEP)
    for k in range(layers):
        z, above = low + k * STEP, low + (k + 1) * STEP
        for i in range(6 * ring):
            a, b = point(ring, i, z), point(ring, i + 1, z)
            c, d = point(ring, i + 1, above), point(ring, i, above)
            triangles += [(a, b, c), (a, c, d)] if (i + k) % 2 == 0 else [(a, b, d), (b, c, d)]
    return triangles


def turned(triangles):
    return [(a, c, b) for a, b, c in triangles]


def write_stl(path, triangles):
    with open(path, "wb") as stream:
        stream.write(os.path.basename(path).encode().ljust(80, b" "))
        stream.write(struct.pack("<I", len(triangles)))
        for triangle in triangles:
            stream.write(struct.pack("<12fH", 0, 0, 0, *(x for p in triangle for x in p), 0))


def main():
    directory = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    wall = tube(INNER, FLOOR, TOP)
    floor = disc(0, INNER, FLOOR)
    bone = (turned(disc(0, OUTER, BOTTOM)) + tube(OUTER, BOTTOM, TOP) + disc(INNER, OUTER, TOP)
            + turned(wall) + floor)
    cement = turned(floor) + wall + disc(0, INNER, TOP)
    write_stl(os.path.join(directory, "bone.stl"), bone)
    write_stl(os.path.join(directory, "cement.stl"), cement)


if __name__ == "__main__":
    main()
