"""usage: with_kerf.py SURFACE SIZE ARRAYS"""
import sys

import kerf
import numpy as np

mesh = kerf.mesh(sys.argv[1], size=float(sys.argv[2]))
np.savez(sys.argv[3], points=mesh.points, tetrahedra=mesh.tetrahedra)
