"""Tetrahedral meshes of closed surfaces, in parallel: arrays of numpy in, arrays out.

    nodes, tets = kerf.tetrahedralize(points, triangles, size=0.1)

    surface = kerf.read("pump.stl")
    mesh = kerf.mesh(surface, parts=8, size=0.5)
    mesh.points, mesh.tetrahedra, mesh.part, mesh.region, mesh.triangles, mesh.patch
"""

from ._kerf import __version__
from .errors import (Cancelled, ConvergenceError, Error, FileError, InputError, MeshingError, OutOfMemory,
                     QualityError, UsageError, VerificationError)
from .mesh import Mesh, Tetrahedralization, mesh, tetrahedralize
from .surface import Surface, read

__all__ = [
    "Cancelled", "ConvergenceError", "Error", "FileError", "InputError", "Mesh", "MeshingError", "OutOfMemory",
    "QualityError", "Surface", "Tetrahedralization", "UsageError", "VerificationError", "__version__", "mesh",
    "read", "tetrahedralize",
]
