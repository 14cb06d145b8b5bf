"""The example with DOLFINx on all ranks, and on each of them alone: check_dolfinx.py"""

import numpy as np
import ranks_dolfinx
from mpi4py import MPI

comm = MPI.COMM_WORLD


def counts_by_tag(tags, dimension, mesh):
    """Entities of each tag, each on the rank that owns it."""
    own = tags.indices < mesh.topology.index_map(dimension).size_local
    return np.bincount(tags.values[own], minlength=4)


def solution(comm):
    """What does not depend on the ranks, and the largest error."""
    distributed = ranks_dolfinx.mesh_of_example(comm)
    body = ranks_dolfinx.dolfinx_mesh(distributed)
    counts = [body.topology.index_map(dimension).size_global for dimension in (0, 3)]
    assert counts == [distributed.point_count, distributed.cell_count]
    local = distributed.local
    assert body.topology.index_map(3).size_local == len(local.tetrahedra), "cells stay where they are"
    regions = counts_by_tag(ranks_dolfinx.region_tags(distributed, body), 3, body)
    assert np.array_equal(regions, np.bincount(local.region, minlength=4))
    patches = comm.allreduce(counts_by_tag(ranks_dolfinx.patch_tags(distributed, body), 2, body))
    mine = local.patch[local.triangle_owner == comm.rank]
    assert np.array_equal(patches, comm.allreduce(np.bincount(mine, minlength=4)))
    error = ranks_dolfinx.largest_error(distributed, ranks_dolfinx.temperatures(distributed, body))
    return [counts, patches.tolist(), comm.allreduce(regions).tolist()], error


together, error = solution(comm)
alone, error_alone = solution(MPI.COMM_SELF)
assert together == alone, (together, alone)
assert max(error, error_alone) < 1e-9, (error, error_alone)
