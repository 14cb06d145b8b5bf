"""Prepares surfaces for tests/bench/python_modules.py, and measures what was made of them.

usage: measure.py prepare SURFACE TEXT      a copy as a STL of text; tells of its size
       measure.py measure ARRAYS VOLUME     tells of a mesh, beside the volume that it should have
"""
import json
import sys

import numpy as np


def dihedral_angles(corners):
    """(m, 6) in degrees, of tetrahedra (m, 4, 3)."""
    faces = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))
    normals = [np.cross(corners[:, b] - corners[:, a], corners[:, c] - corners[:, a]) for a, b, c in faces]
    normals = [normal / np.linalg.norm(normal, axis=1)[:, None] for normal in normals]
    cosines = [-np.einsum("ij,ij->i", normals[i], normals[j]) for i in range(4) for j in range(i)]
    return np.degrees(np.arccos(np.clip(np.stack(cosines, axis=1), -1, 1)))


def measure(arrays, volume):
    volume = float(volume)
    mesh = np.load(arrays)
    corners = mesh["points"][mesh["tetrahedra"]]
    if len(corners) == 0:
        raise SystemExit("no cells")
    edges = corners[:, 1:] - corners[:, :1]
    found = np.abs(np.linalg.det(edges)).sum() / 6
    smallest = np.nanmin(dihedral_angles(corners), axis=1)
    return {"tets": len(corners), "least_dihedral": float(smallest.min()),
            "dihedral_1": float(np.percentile(smallest, 1)), "volume_error": abs(float(found) / volume - 1)}


def prepare(given, path):
    import kerf

    surface = kerf.read(given)
    write_text_stl(surface, path)
    return {"triangles": len(surface.triangles), "volume": surface.volume,
            "diagonal": float(np.linalg.norm(np.ptp(surface.points, axis=0)))}


def write_text_stl(surface, path):
    corners = surface.points[surface.triangles]
    with open(path, "w") as file:
        file.write("solid surface\n")
        for triangle in corners.tolist():
            vertices = "".join("      vertex {!r} {!r} {!r}\n".format(*corner) for corner in triangle)
            file.write(f"  facet normal 0 0 0\n    outer loop\n{vertices}    endloop\n  endfacet\n")
        file.write("endsolid surface\n")


print(json.dumps({"prepare": prepare, "measure": measure}[sys.argv[1]](*sys.argv[2:])))
