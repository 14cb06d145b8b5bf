"""usage: with_pygalmesh.py SURFACE SIZE ARRAYS"""
import sys

import numpy as np
import pygalmesh

size = float(sys.argv[2])
mesh = pygalmesh.generate_volume_mesh_from_surface_mesh(
    sys.argv[1], max_edge_size_at_feature_edges=size, min_facet_angle=25, max_radius_surface_delaunay_ball=0.6 * size,
    max_facet_distance=0.05 * size, max_circumradius_edge_ratio=2, max_cell_circumradius=0.6 * size, verbose=False)
np.savez(sys.argv[3], points=mesh.points, tetrahedra=mesh.get_cells_type("tetra"))
