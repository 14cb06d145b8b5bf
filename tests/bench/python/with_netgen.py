"""usage: with_netgen.py SURFACE SIZE ARRAYS"""
import sys

import numpy as np
from netgen.stl import LoadSTLGeometry

geometry = LoadSTLGeometry(sys.argv[1])
mesh = geometry.GenerateMesh(maxh=float(sys.argv[2]))
points = np.array([point.p for point in mesh.Points()])
tetrahedra = np.array([[vertex.nr - 1 for vertex in cell.vertices] for cell in mesh.Elements3D()])
np.savez(sys.argv[3], points=points, tetrahedra=tetrahedra)
