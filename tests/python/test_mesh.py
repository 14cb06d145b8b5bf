"""kerf.mesh(): arrays in, arrays out."""

import numpy as np

import kerf


def volumes(mesh):
    a, b, c, d = (mesh.points[mesh.tetrahedra[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def test_tetrahedra_fill_the_cube(cube):
    mesh = kerf.mesh(kerf.Surface(*cube), parts=3, size=0.3)
    assert np.all(volumes(mesh) > 0)
    assert np.isclose(volumes(mesh).sum(), 1)
    assert len(set(mesh.part)) == 3


def test_one_line(cube):
    nodes, tets = kerf.tetrahedralize(*cube, size=0.5)
    assert nodes.shape[1] == 3 and tets.shape[1] == 4 and tets.max() < len(nodes)
