"""Two regions, from their surfaces to stresses: cement in bone, pressed from above.

usage: bone_and_cement.py [FOLDER]

Needs kerf-solve, which is built where PETSc is.
"""
import sys
from pathlib import Path

import kerf
import numpy as np

assets = Path(__file__).parents[1] / "assets"
folder = Path(sys.argv[1] if len(sys.argv) > 1 else "bone_and_cement")

run = kerf.mesh(assets / "bone.stl", with_=assets / "cement.stl", parts=4, output=folder / "mesh")
print(run, run.region_names)

points = np.concatenate([part.points for part in run.parts])
bottom, top = points[:, 2].min(), points[:, 2].max()
case = {
    "material": {"bone": {"young": 17e3, "poisson": 0.3}, "cement": {"young": 2.2e3, "poisson": 0.3}},
    "support": [{"plane": [0, 0, 1, float(bottom)], "fixed": True}],
    "load": [{"plane": [0, 0, 1, float(top)], "force": [0, 0, -1000]}],
}
solution = kerf.solve(run, case, output=folder / "stress")
print(f"largest displacement {np.linalg.norm(solution.displacement, axis=1).max():.3g}")
for name, reaction in solution.reactions.items():
    print(f"reaction of {name}: {np.round(reaction, 1)}")
