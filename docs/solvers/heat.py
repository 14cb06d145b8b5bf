"""Heat from face_7 to face_3 of the bearing cap in DOLFINx 0.5, on any number of processes: ../solvers.md"""

from xml.etree import ElementTree

from dolfinx import fem, io
from mpi4py import MPI
from petsc4py.PETSc import ScalarType
import ufl

with io.XDMFFile(MPI.COMM_WORLD, "mesh/mesh.xdmf", "r") as file:
    mesh = file.read_mesh()
    mesh.topology.create_entities(2)
    patches = file.read_meshtags(mesh, "facets")  # numbers of patches, from 1
    bodies = file.read_meshtags(mesh, "mesh")     # of regions, or else bodies, from 1
entries = ElementTree.parse("mesh/mesh.xdmf").findall("Domain/Information")
named = [(entry.get("Name").split(), entry.get("Value")) for entry in entries]  # "patch 4", "region 1"
number_of = {name: int(number) for (kind, number), name in named if kind == "patch"}

space = fem.FunctionSpace(mesh, ("CG", 1))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)


def held(patch, value):
    facets = patches.indices[patches.values == number_of[patch]]
    return fem.dirichletbc(ScalarType(value), fem.locate_dofs_topological(space, 2, facets), space)


zero = fem.Constant(mesh, ScalarType(0))
problem = fem.petsc.LinearProblem(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, zero * v * ufl.dx,
                                  bcs=[held("face_3", 0), held("face_7", 1)],
                                  petsc_options={"ksp_type": "cg", "pc_type": "gamg", "ksp_rtol": 1e-9})
heat = problem.solve()
largest = mesh.comm.allreduce(heat.x.array.max(), MPI.MAX)
assert abs(largest - 1) < 1e-6, largest
if mesh.comm.rank == 0:
    print(f"u up to {largest:.3f}")
