"""Displacements by FEniCSx: P2 triangles, contact with friction by Nitsche's method, Newton steps of SNES.

    displacements.py GAMMA INPUT OUTPUT

With tau = sigma(u) n - k (u - g n), k = GAMMA (2 mu + lambda) / h, h the length of the edge, the traction of a
contact edge is P(tau), where P_n = min(0, tau_n) and P_t is tau_t cut off at friction times -P_n. For all v

    (sigma(u), eps(v)) - <sigma(u) n, sigma(v) n> / k + <P(tau), sigma(v) n - k v> / k = loads(v)

Supports are eliminated, u = u0 + Z y. Newton starts from the answer without friction.
"""
import sys
from pathlib import Path
from time import perf_counter

import numpy as np
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc
from mpi4py import MPI
from petsc4py import PETSc
from scipy.sparse import csr_matrix
from scipy.spatial import cKDTree

try:
    from basix.ufl import element
    from dolfinx.fem import functionspace
except ImportError:  # 0.5
    from dolfinx.fem import FunctionSpace as functionspace

    def element(family, cell, degree, shape=()):
        return (ufl.VectorElement if shape else ufl.FiniteElement)(family, cell, degree)

sys.path.append(str(Path(__file__).resolve().parents[1]))
from answer import write_answer  # noqa: E402
from constraints import boundary_nodes, held_nodes, loads, sides_of  # noqa: E402

MOST_STEPS, SMALL = 200, 1e-11  # of the first residual
FRICTION = (1,), (0.25, 0.5, 0.75, 1)  # parts of it, one after another; the second where the first fails


class Refused(Exception):
    pass


class Elements:
    """The body in dolfinx; nodes: its nodes of u in the order of ours, vertices, then middles of edges."""

    def __init__(self, problem):
        vertices, edges = problem["vertices_mm"], problem["edges"]
        shape = ufl.Mesh(element("Lagrange", "triangle", 1, shape=(2,)))
        self.mesh = mesh.create_mesh(MPI.COMM_SELF, problem["triangles"].astype(np.int64), vertices, shape)
        self.u = fem.Function(functionspace(self.mesh, element("Lagrange", "triangle", 2, shape=(2,))))
        at = self.u.function_space.tabulate_dof_coordinates()[:, :2]
        self.nodes = cKDTree(at).query(np.vstack([vertices, vertices[edges].mean(1)]))[1]
        self.triangle_of_cell = np.array(self.mesh.topology.original_cell_index)

    def constants(self, of_triangle):
        function = fem.Function(functionspace(self.mesh, element("DG", "triangle", 0)))
        function.x.array[:] = of_triangle[self.triangle_of_cell]
        return function

    def along_edges(self, problem, rows, values):
        """Quadratic on every contact edge: values at start, middle, end; what it is elsewhere does not matter."""
        space = functionspace(self.mesh, element("DG", "triangle", 2))
        function, at = fem.Function(space), space.tabulate_dof_coordinates()[:, :2]
        cell_of = np.argsort(self.triangle_of_cell)
        triangle_of = {frozenset(pair): t for t, abc in enumerate(problem["triangles"].tolist())
                       for pair in zip(abc, abc[1:] + abc[:1])}
        for row in rows:
            a, b = problem["vertices_mm"][problem["boundary"][row]]
            own = space.dofmap.cell_dofs(cell_of[triangle_of[frozenset(problem["boundary"][row].tolist())]])
            function.x.array[own[cKDTree(at[own]).query([a, (a + b) / 2, b])[1]]] = values[row]
        return function

    def measure(self, problem, rows):
        self.mesh.topology.create_connectivity(1, 2)  # for the midpoints
        facets = np.arange(self.mesh.topology.index_map(1).size_local, dtype=np.int32)
        middles = problem["vertices_mm"][problem["boundary"][rows]].mean(1)
        at = mesh.compute_midpoints(self.mesh, 1, facets)[:, :2]
        own = np.sort(cKDTree(at).query(middles)[1]).astype(np.int32)
        tags = mesh.meshtags(self.mesh, 1, own, np.ones_like(own))
        return ufl.Measure("ds", self.mesh, subdomain_data=tags, metadata={"quadrature_degree": 6})(1)


def refuse(problem, rows):
    ends = {frozenset(pair) for pair in problem["boundary"][rows].tolist()}
    for abc in problem["triangles"].tolist():
        if sum(frozenset(pair) in ends for pair in zip(abc, abc[1:] + abc[:1])) > 1:
            raise Refused("data of a contact edge are those of its triangle: a triangle with two contact edges "
                          "(allowed: one)")


def forms(problem, elements, gamma):
    """Residual without loads, its derivative; friction, a function that is set later."""
    stiffness = np.linalg.inv(problem["compliance_per_MPa"].reshape(-1, 3, 3))[problem["triangle_body"]]
    lame, shear = elements.constants(stiffness[:, 0, 1]), elements.constants(stiffness[:, 2, 2])
    u, v = elements.u, ufl.TestFunction(elements.u.function_space)

    def stress(w):
        return lame * ufl.div(w) * ufl.Identity(2) + 2 * shear * ufl.sym(ufl.grad(w))

    residual = ufl.inner(stress(u), ufl.sym(ufl.grad(v))) * ufl.dx
    rows = sides_of(problem, "contact")
    refuse(problem, rows)
    friction = elements.along_edges(problem, [], None)
    if len(rows):
        normals = problem["contact_normals"].reshape(-1, 3, 2)
        nx, ny = (elements.along_edges(problem, rows, normals[:, :, axis]) for axis in (0, 1))
        n, t = ufl.as_vector((nx, ny)), ufl.as_vector((-ny, nx))
        gap = elements.along_edges(problem, rows, problem["gap_mm"])
        k = fem.Constant(elements.mesh, gamma) * (2 * shear + lame) / ufl.FacetArea(elements.mesh)
        outward = ufl.FacetNormal(elements.mesh)
        traction, tested = ufl.dot(stress(u), outward), ufl.dot(stress(v), outward)
        tau_n = ufl.dot(traction, n) - k * (ufl.dot(u, n) - gap)
        tau_t = ufl.dot(traction, t) - k * ufl.dot(u, t)
        pressure = ufl.conditional(ufl.lt(tau_n, 0), tau_n, 0)
        most = -friction * pressure
        shear_of_wall = ufl.conditional(ufl.lt(abs(tau_t), most), tau_t,
                                        ufl.conditional(ufl.lt(tau_t, 0), -most, most))
        residual += (-ufl.dot(traction, tested) + ufl.dot(pressure * n + shear_of_wall * t, tested - k * v)) \
            / k * elements.measure(problem, rows)
    return fem.form(residual), fem.form(ufl.derivative(residual, u)), friction


def supports(problem, elements, size):
    """u0 and Z: columns for what is free."""
    u0, free = np.zeros(size), []
    sides = elements.nodes[boundary_nodes(problem)]
    held = held_nodes(problem, sides)
    for node in range(size // 2):
        directions, values = held.get(node, ([], []))
        if len(directions) == 2:
            u0[2 * node:2 * node + 2] = np.linalg.solve(directions, values)
        elif len(directions) == 1:
            (x, y), (value,) = directions[0], values
            u0[2 * node:2 * node + 2] = value * directions[0]
            free.append({2 * node: -y, 2 * node + 1: x})
        else:
            free += [{2 * node: 1.0}, {2 * node + 1: 1.0}]
    entries = [(i, j, value) for j, column in enumerate(free) for i, value in column.items()]
    i, j, value = zip(*entries)
    return u0, csr_matrix((value, (i, j)), (size, len(free))), loads(problem, elements.nodes, sides, size)


def newton(elements, residual, derivative, u0, Z, load, y, small):
    """SNES from y; y then is the answer. Its steps, and whether it converged."""
    vector, matrix = petsc.create_vector(residual), petsc.assemble_matrix(derivative)
    basis = PETSc.Mat().createAIJ(Z.shape, csr=(Z.indptr, Z.indices, Z.data), comm=MPI.COMM_SELF)

    def set_u(at):
        elements.u.x.array[:] = u0 + Z @ at.array_r

    def function(_, at, out):
        set_u(at)
        vector.set(0)
        petsc.assemble_vector(vector, residual)
        out.array[:] = Z.T @ (vector.array_r - load)

    def jacobian(_, at, into, __):
        set_u(at)
        matrix.zeroEntries()
        petsc.assemble_matrix(matrix, derivative)
        matrix.assemble()
        matrix.PtAP(basis, result=into)

    matrix.assemble()  # its pattern
    into = matrix.PtAP(basis)
    out = y.duplicate()
    snes = PETSc.SNES().create(MPI.COMM_SELF)
    snes.setFunction(function, out)
    snes.setJacobian(jacobian, into)
    if small is None:
        function(snes, y, out)
        small = SMALL * out.norm()
    PETSc.Options()["snes_linesearch_type"] = "bt"
    snes.setFromOptions()
    snes.getKSP().setType("preonly")
    snes.getKSP().getPC().setType("lu")
    snes.getKSP().getPC().setFactorSolverType("mumps")
    snes.setTolerances(rtol=0, atol=small, stol=0, max_it=MOST_STEPS)
    snes.solve(None, y)
    set_u(y)
    return snes.getIterationNumber(), snes.getConvergedReason() > 0, small


if __name__ == "__main__":
    _, gamma, folder, output = sys.argv
    problem = dict(np.load(Path(folder, "problem.npz")))
    elements = Elements(problem)
    try:
        residual, derivative, friction = forms(problem, elements, float(gamma))  # compiles, so no part of the solve
    except Refused as why:
        write_answer(output, {}, status="skipped", message=str(why), time_s=0)
        sys.exit()
    start = perf_counter()
    u0, Z, load = supports(problem, elements, len(elements.u.x.array))
    y = PETSc.Vec().createSeq(Z.shape[1])
    steps, converged, small = newton(elements, residual, derivative, u0, Z, load, y, None)
    rows = sides_of(problem, "contact")
    if converged and problem["friction"][rows].any():
        full, without = elements.along_edges(problem, rows, problem["friction"][:, None]), y.copy()
        for path in FRICTION:
            without.copy(y)
            for part in path:
                friction.x.array[:] = part * full.x.array
                more, converged, _ = newton(elements, residual, derivative, u0, Z, load, y, small)
                steps += more
            if converged:
                break
    u = elements.u.x.array.reshape(-1, 2)[elements.nodes]
    write_answer(output, {"displacement_mm": u}, status="ok" if converged else "not_converged",
                 message=f"{steps} Newton steps", time_s=perf_counter() - start, contact_iterations=steps,
                 parameters=f"P2, Nitsche with gamma = {gamma}; MUMPS")
