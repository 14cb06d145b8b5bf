"""The smallest dihedral angles of a mesh, plotted with matplotlib: improved, as it is by default, and as cells are first made.

usage: quality_plot.py [PICTURE]
"""
import sys
from pathlib import Path

import kerf
import matplotlib
import numpy as np

matplotlib.use("Agg")  # a picture, no window
import matplotlib.pyplot as plt  # noqa: E402

surface = kerf.read(Path(__file__).parents[1] / "assets/cylinder.stl")
figure, axes = plt.subplots()
for label, options in (("as it is by default", {}), ("improve=False", {"improve": False})):
    mesh = kerf.mesh(surface, **options)
    angles = mesh.cell_quality("min-dihedral")
    axes.hist(angles, bins=np.arange(0, 72, 2), histtype="step", label=label)
    print(f"{label}: 1 % of the cells below {np.percentile(angles, 1):.1f} degrees")
axes.set_xlabel("smallest dihedral angle in degrees")
axes.set_ylabel("tetrahedra")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "quality.png", dpi=150)
