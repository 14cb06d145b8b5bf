"""The example with PETSc on ranks, which compares counts with those of the mesh: check_petsc.py"""

import numpy as np
import ranks_petsc
from mpi4py import MPI

counts, sizes, error = ranks_petsc.solve(MPI.COMM_WORLD)
expected = {"steel": 1, "glass": 1, "left": 1, "right": 1, "wall": 1, "around": 8}
assert sizes.keys() == expected.keys()
assert all(np.isclose(sizes[name], size) for name, size in expected.items()), sizes
assert error < 1e-9, error
