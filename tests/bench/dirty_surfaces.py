#!/usr/bin/env python3
"""Dirty surfaces of the kinds that people bring, made of the assets: for the benchmark of repairs.

usage: dirty_surfaces.py ASSETS FOLDER      makes them, and prints their paths
       dirty_surfaces.py FILE RESULT.stl    the same facets as binary STL
"""

import pathlib
import struct
import sys

import numpy

SEED = 37


def read_triangles(path):
    """#F x 3 x 3 corners of the facets of a binary STL, or of any file that meshio reads; polygons as fans."""
    path = pathlib.Path(path)
    if path.suffix == ".stl":
        data = path.read_bytes()
        if not data.startswith(b"solid") or len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
            return binary_facets(data)["corners"].astype(float)
    import meshio  # only for files that are not ours

    mesh = meshio.read(path)
    facets = [(face[0], face[i], face[i + 1]) for block in mesh.cells for face in block.data
              for i in range(1, len(face) - 1)]
    return mesh.points[numpy.array(facets)]


LAYOUT = numpy.dtype([("normal", "<3f4"), ("corners", "<3f4", 3), ("attribute", "<u2")])


def binary_facets(data):
    return numpy.frombuffer(data, dtype=LAYOUT, offset=84, count=struct.unpack_from("<I", data, 80)[0])


def write_stl(path, triangles):
    facets = numpy.zeros(len(triangles), dtype=LAYOUT)
    facets["corners"] = triangles
    pathlib.Path(path).write_bytes(b"dirty".ljust(80) + struct.pack("<I", len(facets)) + facets.tobytes())


def welded(triangles):
    """Vertices and facets."""
    vertices, corners = numpy.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    return vertices, corners.reshape(-1, 3)


def extent(triangles):
    return numpy.linalg.norm(numpy.ptp(triangles.reshape(-1, 3), axis=0))


def edge(triangles):
    return numpy.linalg.norm(triangles[:, 0] - triangles[:, 1], axis=1).mean()


def turned_about(triangles, axis, angle):
    axis = numpy.array(axis) / numpy.linalg.norm(axis)
    cross = numpy.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return triangles @ (numpy.eye(3) + numpy.sin(angle) * cross + (1 - numpy.cos(angle)) * cross @ cross).T


def box(low, high):
    unit = numpy.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    facets = numpy.array([t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))])
    return (numpy.array(low) + unit * (numpy.array(high) - numpy.array(low)))[facets]


def scan(whole, random, noise, holes, islands):
    """Noise along normals, holes, loose facets, copies, and facets turned over."""
    vertices, facets = welded(whole)
    size = edge(whole)
    normals = numpy.zeros_like(vertices)
    across = numpy.cross(whole[:, 1] - whole[:, 0], whole[:, 2] - whole[:, 0])
    for k in range(3):
        numpy.add.at(normals, facets[:, k], across)
    normals /= numpy.linalg.norm(normals, axis=1, keepdims=True) + 1e-300
    vertices = vertices + noise * size * random.normal(size=(len(vertices), 1)) * normals
    centres = vertices[facets].mean(1)
    keep = numpy.ones(len(facets), bool)
    for middle in vertices[random.integers(len(vertices), size=holes)]:
        keep &= numpy.linalg.norm(centres - middle, axis=1) > size * random.uniform(0.8, 5)
    facets = facets[keep]
    turned = random.integers(len(facets), size=len(facets) // 200)
    facets[turned] = facets[turned][:, ::-1]
    copies = facets[random.integers(len(facets), size=20)]
    loose = vertices[random.integers(len(vertices), size=islands)][:, None] + size * random.normal(
        size=(islands, 3, 3)) + 0.02 * extent(whole) * random.normal(size=(islands, 1, 3))
    return numpy.concatenate([vertices[facets], vertices[copies], loose])


def jittered(whole, random, share):
    """Each facet with corners of its own."""
    return whole + share * extent(whole) * random.uniform(-1, 1, size=whole.shape)


def assembly(parts, random, count, spread):
    """Bodies pushed into each other, in one file."""
    pieces = []
    for i in range(count):
        part = parts[i % len(parts)]
        part = (part - part.reshape(-1, 3).mean(0)) / extent(part)
        pieces.append(turned_about(part, random.normal(size=3), random.uniform(0, 6)) + random.uniform(
            -spread, spread, size=3))
    return numpy.concatenate(pieces)


def city(random, rows):
    """Houses that share walls of unlike heights, wall to wall."""
    return numpy.concatenate([box((i, j, 0), (i + 1, j + 1, random.uniform(1, 6)))
                              for i in range(rows) for j in range(rows)])


def house_of_sheets():
    """Floors and walls without thickness, through each other."""
    pieces = []

    def sheet(corner, along, up, parts):
        steps = numpy.arange(parts + 1) / parts
        p = numpy.array(corner) + steps[:, None, None] * numpy.array(along) + steps[None, :, None] * numpy.array(up)
        a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
        for t in ((a, b, c), (a, c, d)):
            pieces.append(numpy.stack(t, axis=2).reshape(-1, 3, 3))

    for level in range(6):
        sheet((0, 0, 3. * level), (20, 0, 0), (0, 12, 0), 16)
    for x in (0, 5, 10, 15, 20):
        sheet((x, 0, 0), (0, 12, 0), (0, 0, 15), 12)
    for y in (0, 4, 8, 12):
        sheet((0, y, 0), (20, 0, 0), (0, 0, 15), 14)
    return numpy.concatenate(pieces)


def double_wall(whole):
    """The same body twice, a little beside itself."""
    return numpy.concatenate([whole, whole + extent(whole) * numpy.array([1e-5, 2e-5, -1e-5])])


def write_all(assets, folder):
    """Writes them as binary STL: a dictionary of names and paths."""
    random = numpy.random.default_rng(SEED)

    def asset(name):
        return read_triangles(pathlib.Path(assets) / f"{name}.stl")

    made = {
        "scan of a knee": scan(asset("knee_femoral"), random, 0.05, 60, 40),
        "noisy scan of a bearing": scan(asset("bearing_cap_52k"), random, 0.2, 150, 100),
        "facets of their own": jittered(asset("cylinder"), random, 1e-7),
        "cracks": jittered(asset("knee_tibial"), random, 1e-5),
        "two parts": assembly([asset("knee_tibial"), asset("bearing_cap_14k")], random, 2, 0.1),
        "assembly of 12": assembly([asset(name) for name in ("cube", "cylinder", "pipe_with_holes", "knee_femoral")],
                                   random, 12, 0.5),
        "wall to wall": city(random, 20),
        "house of sheets": house_of_sheets(),
        "double wall": double_wall(asset("pipe_with_holes")),
    }
    paths = {}
    for name, triangles in made.items():
        paths[name] = pathlib.Path(folder) / f"{name.replace(' ', '_')}.stl"
        write_stl(paths[name], triangles)
    return paths


def main():
    source, target = map(pathlib.Path, sys.argv[1:3])
    if source.is_dir():
        print("\n".join(map(str, write_all(source, target).values())))
    else:
        write_stl(target, read_triangles(source))


if __name__ == "__main__":
    main()
