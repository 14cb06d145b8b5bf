"""Surfaces of as many facets as one likes: each facet of an STL divided into four, again and again."""

import numpy


def read_corners(path):
    """Corners of a binary STL, facets x 3 x 3."""
    raw = numpy.fromfile(path, dtype=numpy.uint8)
    count = int(raw[80:84].view("<u4")[0])
    return raw[84 : 84 + 50 * count].reshape(count, 50)[:, 12:48].copy().view("<f4").reshape(count, 3, 3)


def write_corners(path, corners):
    facets = numpy.zeros((len(corners), 50), numpy.uint8)
    flat = numpy.ascontiguousarray(corners, dtype="<f4").reshape(len(corners), 9)
    facets[:, 12:48] = flat.view(numpy.uint8).reshape(len(corners), 36)
    with open(path, "wb") as out:
        out.write(b"\0" * 80 + numpy.uint32(len(corners)).tobytes())
        facets.tofile(out)


def divided(corners):
    """At the middles of edges, which facets that share one compute alike."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, bc, ca = ((p + q) * numpy.float32(0.5) for p, q in ((a, b), (b, c), (c, a)))
    four = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return numpy.stack([numpy.stack(facet, axis=1) for facet in four], axis=1).reshape(-1, 3, 3)


def write_divided(source, levels, path):
    """The number of facets."""
    corners = read_corners(source)
    for _ in range(levels):
        corners = divided(corners)
    write_corners(path, corners)
    return len(corners)
