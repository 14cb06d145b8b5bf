"""Heat through two materials by DOLFINx, on a mesh that is never on one rank: mpirun -n 4 python3 ranks_dolfinx.py"""

import kerf
import numpy as np
import two_boxes
import ufl
from dolfinx import cpp, fem, la, mesh
from mpi4py import MPI
from petsc4py import PETSc


def partitioner_of(distributed):
    """Each cell stays on the rank that has brought it; DOLFINx 0.5 finds what ranks share by cells with a face there,
    which it wants on both."""
    own = np.arange(len(distributed.local.tetrahedra))
    cells = np.concatenate([own] + [np.unique(each.cells) for each in distributed.neighbours])
    ranks = np.concatenate([np.full_like(own, distributed.comm.rank)] +
                           [np.full(len(np.unique(each.cells)), each.rank) for each in distributed.neighbours])
    order = np.argsort(cells, kind="stable")  # the own rank stays first
    ends = np.concatenate([[0], np.cumsum(np.bincount(cells, minlength=len(own)))])
    table = cpp.graph.AdjacencyList_int32(ranks[order].astype(np.int32), ends.astype(np.int32))
    return lambda comm, parts, dimension, cells, ghost_mode: table


def dolfinx_mesh(distributed):
    """The same cells on the same ranks: nodes are the rows of distributed.rows(), of which each rank gives its own."""
    local, rows = distributed.local, distributed.rows()
    is_own = local.owner == distributed.comm.rank
    return mesh.create_mesh(distributed.comm, rows.of_points[local.tetrahedra], local.points[is_own],
                            ufl.Mesh(ufl.VectorElement("Lagrange", ufl.tetrahedron, 1)), mesh.GhostMode.none,
                            partitioner_of(distributed))


def region_tags(distributed, body):
    """Rows of distributed.region_names."""
    cells = np.arange(body.topology.index_map(3).size_local, dtype=np.int32)
    given = np.array(body.topology.original_cell_index)[cells] - distributed.local.first_cell
    return mesh.meshtags(body, 3, cells, distributed.local.region[given])


def patch_tags(distributed, body):
    """Rows of distributed.patch_names."""
    local = distributed.local
    mine = local.triangle_owner == distributed.comm.rank
    corners = distributed.rows().of_points[local.triangles[mine]]
    facets, patches = cpp.io.distribute_entity_data(body.ufl_domain().ufl_cargo(), 2, corners, local.patch[mine])
    body.topology.create_connectivity(2, 0)
    body.topology.create_connectivity(2, 3)
    return mesh.meshtags_from_entities(body, 2, cpp.graph.AdjacencyList_int32(facets), patches)


def temperatures(distributed, body):
    """A function of the nodes."""
    space = fem.FunctionSpace(body, ("Lagrange", 1))
    regions, patches = region_tags(distributed, body), patch_tags(distributed, body)
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    dx = ufl.Measure("dx", body, subdomain_data=regions)
    flow = fem.form(sum(two_boxes.CONDUCTIVITY[name] * ufl.inner(ufl.grad(u), ufl.grad(v)) * dx(region)
                        for region, name in enumerate(distributed.region_names)))
    held = []
    for name, degrees in (("left", 0), ("right", 4)):
        facets = patches.find(distributed.patch_names.index(name))
        held.append(fem.dirichletbc(PETSc.ScalarType(degrees), fem.locate_dofs_topological(space, 2, facets), space))
    matrix = fem.petsc.assemble_matrix(flow, bcs=held)
    matrix.assemble()
    right = la.create_petsc_vector(space.dofmap.index_map, 1)
    fem.petsc.apply_lifting(right, [flow], [held])
    right.ghostUpdate(PETSc.InsertMode.ADD, PETSc.ScatterMode.REVERSE)
    fem.petsc.set_bc(right, held)
    solver = PETSc.KSP().create(distributed.comm)
    solver.setOperators(matrix)
    solver.setType("cg")
    solver.setTolerances(rtol=1e-12)
    result = fem.Function(space)
    solver.solve(right, result.vector)
    result.x.scatter_forward()
    return result


def largest_error(distributed, result):
    points = result.function_space.tabulate_dof_coordinates()
    return distributed.comm.allreduce(np.abs(result.x.array - two_boxes.temperature(points)).max(), MPI.MAX)


def mesh_of_example(comm):
    return kerf.mesh(two_boxes.surface(), parts=6, size=0.4, comm=comm)


if __name__ == "__main__":
    distributed = mesh_of_example(MPI.COMM_WORLD)
    error = largest_error(distributed, temperatures(distributed, dolfinx_mesh(distributed)))
    if MPI.COMM_WORLD.rank == 0:
        print(f"{distributed.cell_count} tetrahedra on {MPI.COMM_WORLD.size} ranks; largest error {error:.1e}")
