"""usage: with_gmsh.py SURFACE SIZE ARRAYS"""
import sys

import gmsh
import numpy as np

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.option.setNumber("Mesh.MeshSizeMin", float(sys.argv[2]))
gmsh.option.setNumber("Mesh.MeshSizeMax", float(sys.argv[2]))
gmsh.merge(sys.argv[1])
if sys.argv[1].endswith(".stl"):
    gmsh.model.mesh.classifySurfaces(0.7, True, True, 3.14)
    gmsh.model.mesh.createGeometry()
surfaces = [tag for dimension, tag in gmsh.model.getEntities(2)]
gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop(surfaces)])
gmsh.model.geo.synchronize()
gmsh.model.mesh.generate(3)
tags, coordinates, _ = gmsh.model.mesh.getNodes()
corners = gmsh.model.mesh.getElementsByType(4)[1].reshape(-1, 4)
row = np.zeros(int(tags.max()) + 1, int)
row[tags.astype(int)] = np.arange(len(tags))
np.savez(sys.argv[3], points=coordinates.reshape(-1, 3), tetrahedra=row[corners.astype(int)])
gmsh.finalize()
