"""A study in a loop: how cells and their quality change with the size.

usage: study.py [SURFACE]
"""
import sys
import time
from pathlib import Path

import kerf
import numpy as np

path = sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1] / "assets/l_bracket.stl"
surface = kerf.read(path)
diagonal = np.linalg.norm(np.ptp(surface.points, axis=0))
print(f"{'size':>8} {'cells':>9} {'edge':>8} {'least':>6} {'1 %':>6} {'seconds':>8}")
for share in (0.1, 0.07, 0.05, 0.035):
    start = time.perf_counter()
    mesh = kerf.mesh(surface, size=share * diagonal)
    seconds = time.perf_counter() - start
    corners = mesh.points[mesh.tetrahedra]
    edge = np.linalg.norm(corners[:, 0] - corners[:, 1], axis=1).mean()
    angles = mesh.cell_quality("min-dihedral")
    print(f"{share * diagonal:8.3g} {len(mesh.tetrahedra):9} {edge:8.3g} {angles.min():6.1f} "
          f"{np.percentile(angles, 1):6.1f} {seconds:8.2f}")
