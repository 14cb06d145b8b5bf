"""DOLFINx on the mesh, supports and nodal forces of a file: solve_with_dolfinx.py MESH.npz RESULT.npz"""

import sys
import time

import numpy as np
import ufl
from dolfinx import fem, la, mesh
from mpi4py import MPI
from petsc4py import PETSc


class Stopwatch:
    def __init__(self):
        self.last = time.monotonic()

    def lap(self):
        now = time.monotonic()
        seconds, self.last = now - self.last, now
        return seconds


def rigid_motions(space):
    """Three translations and three turns, orthonormal."""
    index_map, block = space.dofmap.index_map, space.dofmap.index_map_bs
    vectors = [la.create_petsc_vector(index_map, block) for _ in range(6)]
    x = space.tabulate_dof_coordinates()
    arrays = [v.array.reshape(-1, 3) for v in vectors]
    for axis in range(3):
        arrays[axis][:, axis] = 1
        one, other = (axis + 1) % 3, (axis + 2) % 3
        arrays[3 + axis][:, other] = x[: len(arrays[0]), one]
        arrays[3 + axis][:, one] = -x[: len(arrays[0]), other]
    for i, v in enumerate(vectors):
        for w in vectors[:i]:
            v.axpy(-v.dot(w), w)
        v.normalize()
    return PETSc.NullSpace().create(vectors=vectors)


def main():
    given = np.load(sys.argv[1])
    watch = Stopwatch()
    element = ufl.VectorElement("Lagrange", ufl.tetrahedron, 1)
    body = mesh.create_mesh(MPI.COMM_WORLD, given["tets"].astype(np.int64), given["points"], ufl.Mesh(element))
    space = fem.VectorFunctionSpace(body, ("CG", 1))
    at = {"mesh": watch.lap()}

    young, poisson = given["material"]
    shear, lame = young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    strain = ufl.sym(ufl.grad(u))
    stress = 2 * shear * strain + lame * ufl.tr(strain) * ufl.Identity(3)
    form = fem.form(ufl.inner(stress, ufl.grad(v)) * ufl.dx)
    watch.lap()  # its compiler

    node = np.array(body.geometry.input_global_indices)  # of each vertex here, that of the file
    vertex_of_dof = np.empty(len(node), dtype=np.int64)
    vertex_of_dof[space.dofmap.list.array] = body.geometry.dofmap.array
    node = node[vertex_of_dof]
    is_held = np.isin(node, given["held"])
    support = fem.dirichletbc(np.zeros(3), np.flatnonzero(is_held).astype(np.int32), space)
    # As long as the others, as kerf does it: a 1 there spoils the aggregates.
    matrix = fem.petsc.assemble_matrix(form, bcs=[support], diagonal=float(young))
    matrix.assemble()
    right = la.create_petsc_vector(space.dofmap.index_map, 3)
    forces = given["forces"][node]
    forces[is_held] = 0
    right.array[:] = forces.ravel()
    at["assemble"] = watch.lap()

    matrix.setNearNullSpace(rigid_motions(space))
    matrix.setOption(PETSc.Mat.Option.SPD, True)
    solver = PETSc.KSP().create(MPI.COMM_WORLD)
    solver.setOperators(matrix)
    solver.setType("cg")
    solver.getPC().setType("gamg")
    solver.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
    solver.setTolerances(rtol=float(given["rtol"]))
    solver.setUp()
    at["setup"] = watch.lap()
    moved = right.duplicate()
    solver.solve(right, moved)
    at["solve"] = watch.lap()
    displacement = np.zeros_like(given["points"])
    displacement[node] = moved.array.reshape(-1, 3)
    np.savez(sys.argv[2], displacement=displacement, iterations=solver.getIterationNumber(), **at)


main()
