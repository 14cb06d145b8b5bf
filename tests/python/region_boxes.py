"""A surface of two regions."""

import itertools

import kerf


def two_boxes():
    """A box of steel below one of copper, which share a wall; six patches and the wall."""
    heights = (0, 1, 2)
    points = [[x, y, z] for z in heights for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    triangles, patches, sides = [], [], []

    def add(quad, patch, behind, in_front):
        for corners in ((quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])):
            triangles.append(corners)
            patches.append(patch)
            sides.append((behind, in_front))

    add((3, 2, 1, 0), 0, 0, -1)
    add((4, 5, 6, 7), 1, 0, 1)
    add((8, 9, 10, 11), 2, 1, -1)
    for region, i in itertools.product(range(2), range(4)):
        j, low = (i + 1) % 4, 4 * region
        add((low + i, low + j, low + j + 4, low + i + 4), 3 + i, region, -1)
    return kerf.Surface(points, triangles, patches, ["bottom", "wall", "top", "front", "right", "back", "left"], sides,
                        ["steel", "copper"])
