"""Tetrahedral meshes of closed surfaces, in parallel: arrays of numpy in, arrays out.

    nodes, tets = kerf.tetrahedralize(points, triangles, size=0.1)

    surface = kerf.read("pump.stl")
    mesh = kerf.mesh(surface, parts=8, size=0.5)
    mesh.points, mesh.tetrahedra, mesh.part, mesh.region, mesh.triangles, mesh.patch

    run = kerf.mesh("pump.stl", parts=64, size=0.05, output="pump")     # larger than memory
    for part in run.parts:
        part.points, part.tetrahedra, part.global_ids, part.shared
"""

from ._kerf import LocalMesh, Part, __version__
from .check import Check, check
from .defect import Defect
from .distributed import DistributedMesh, distributed
from .drawing import Picture
from .errors import (Cancelled, ConvergenceError, Error, FailedPart, FileError, InputError, MeshingError, OutOfMemory,
                     QualityError, UsageError, VerificationError)
from .ghost_cells import GhostCells
from .mesh import Mesh
from .meshing import Tetrahedralization, mesh, tetrahedralize
from .option_table import Option, options
from .part import Parts
from .plotting import plot
from .quality import Distribution, Quality, RegionQuality
from .records import SharedPoints
from .repairs import Repair, Wrapping
from .run import Run, open
from .sizes import SizeField, sample_sizes
from .solution import Solution
from .solve import solve
from .surface import Surface, read, repair, wrap
from .tree import Tree, decompose
from .verification import Verification

__all__ = [
    "Cancelled",
    "Check",
    "ConvergenceError",
    "Defect",
    "DistributedMesh",
    "Distribution",
    "Error",
    "FailedPart",
    "FileError",
    "GhostCells",
    "InputError",
    "LocalMesh",
    "Mesh",
    "MeshingError",
    "Option",
    "OutOfMemory",
    "Part",
    "Parts",
    "Picture",
    "Quality",
    "QualityError",
    "RegionQuality",
    "Repair",
    "Run",
    "SharedPoints",
    "SizeField",
    "Solution",
    "Surface",
    "Tetrahedralization",
    "Tree",
    "UsageError",
    "Verification",
    "VerificationError",
    "Wrapping",
    "__version__",
    "check",
    "decompose",
    "distributed",
    "mesh",
    "open",
    "options",
    "plot",
    "read",
    "repair",
    "sample_sizes",
    "solve",
    "tetrahedralize",
    "wrap",
]
