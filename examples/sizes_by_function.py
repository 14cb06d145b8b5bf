"""Edge lengths by a function of the place: fine around a point, coarse away from it.

usage: sizes_by_function.py [SURFACE]
"""
import sys
from pathlib import Path

import kerf
import numpy as np

path = sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1] / "assets/l_bracket.stl"
surface = kerf.read(path)
low, high = surface.points.min(axis=0), surface.points.max(axis=0)
diagonal = np.linalg.norm(high - low)


def size(points):
    distance = np.linalg.norm(points - low, axis=1)
    return np.clip(0.15 * distance, 0.01 * diagonal, 0.08 * diagonal)


mesh = kerf.mesh(surface, size=size)
corners = mesh.points[mesh.tetrahedra]
edges = np.linalg.norm(corners[:, 0] - corners[:, 1], axis=1)
near = np.linalg.norm(corners.mean(axis=1) - low, axis=1) < 0.15 * diagonal
print(mesh)
print(f"edges near the corner {edges[near].mean():.3g}, elsewhere {edges[~near].mean():.3g}")
