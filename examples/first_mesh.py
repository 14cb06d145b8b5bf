"""A surface from a file, tetrahedra as arrays.

usage: first_mesh.py [SURFACE]
"""
import sys
from pathlib import Path

import kerf
import numpy as np

path = sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1] / "assets/bearing_cap_14k.stl"
surface = kerf.read(path)
print(surface)

mesh = kerf.mesh(surface, parts=4)
corners = mesh.points[mesh.tetrahedra]
volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
print(mesh)
print(f"volume {volumes.sum():g}, of the surface {surface.volume:g}")
for part in np.unique(mesh.part):
    print(f"part {part}: {np.count_nonzero(mesh.part == part)} cells")
