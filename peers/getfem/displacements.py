"""Displacements by GetFEM: P2 triangles, contact with friction by augmented Lagrangian and Newton.

    displacements.py nodes|coefficients INPUT OUTPUT

u_n <= g0 is asked of the vertices and middles of contact edges, or of the Bernstein coefficients
of u_n - g0: then it holds in between, too.
"""
import sys
from pathlib import Path
from time import perf_counter

import getfem as gf
import numpy as np
from scipy.spatial import cKDTree

sys.path.append(str(Path(__file__).resolve().parents[1]))
from answer import write_answer  # noqa: E402
from constraints import boundary_nodes, contact, held_nodes, loads, row_along, vertices_apart  # noqa: E402


def finite_elements(problem):
    """Mesh, elements of u, their nodes: of vertices, then edges; of boundary edges (start, middle, end)."""
    vertices, edges = vertices_apart(problem), problem["edges"]
    mesh = gf.Mesh("empty", 2)
    mesh.add_convex(gf.GeoTrans("GT_PK(2,1)"), vertices[problem["triangles"]].T)
    elements = gf.MeshFem(mesh, 2)
    elements.set_fem(gf.Fem("FEM_PK(2,2)"))
    nodes = cKDTree(elements.basic_dof_nodes()[:, ::2].T).query(
        np.vstack([vertices, vertices[edges].mean(1)]))[1]
    return mesh, elements, nodes, nodes[boundary_nodes(problem)]


def add_elasticity(model, mesh, elements, problem):
    """Returns the smallest shear modulus."""
    of_body = np.linalg.inv(problem["compliance_per_MPa"].reshape(-1, 3, 3))
    of_triangle = of_body[problem["triangle_body"]]
    constant = gf.MeshFem(mesh, 1)
    constant.set_fem(gf.Fem("FEM_PK(2,0)"))
    model.add_fem_variable("u", elements)
    model.add_initialized_fem_data("lambda", constant, of_triangle[:, 0, 1])
    model.add_initialized_fem_data("mu", constant, of_triangle[:, 2, 2])
    quadrature = gf.MeshIm(mesh, gf.Integ("IM_TRIANGLE(2)"))
    model.add_isotropic_linearized_elasticity_brick(quadrature, "u", "lambda", "mu")
    return of_triangle[:, 2, 2].min()


def spmat(rows, columns):
    matrix = gf.Spmat("empty", len(rows), columns)
    for i, row in enumerate(rows):
        for j, value in row.items():
            matrix.add([i], [j], value)
    return matrix


def add_contact(model, size, normal_rows, tangential_rows, gaps, friction):
    model.add_variable("normal_forces", len(gaps))
    model.add_initialized_data("gaps", gaps)
    rows = [spmat(normal_rows, size)]
    names = ["normal_forces"]
    if any(friction):
        model.add_variable("tangential_forces", len(gaps))
        model.add_initialized_data("friction", friction)
        names.append("tangential_forces")
        rows += [spmat(tangential_rows, size), "friction"]
    model.add_basic_contact_brick("u", *names, "r", *rows, "gaps")


def slid_displacements(rows, tangential_rows, slid, size):
    """The least u of contact nodes that is slid along tangential_rows and 0 along rows."""
    u = np.zeros(size)
    columns = sorted({j for row in tangential_rows for j in row})
    rows = [[row.get(j, 0) for j in columns] for row in (*tangential_rows, *rows) if not row.keys().isdisjoint(columns)]
    u[columns] = np.linalg.lstsq(rows, [*slid, *np.zeros(len(rows) - len(slid))], rcond=None)[0]
    return u


def solve(problem, of_coefficients):
    mesh, elements, nodes, sides = finite_elements(problem)
    size = elements.nbdof()
    model = gf.Model("real")
    shear_modulus = add_elasticity(model, mesh, elements, problem)
    held = held_nodes(problem, sides)
    rows = [row_along(axis, [node], [1]) for node, (axes, _) in held.items() for axis in axes]
    *law, slid = contact(problem, sides, held, of_coefficients)
    right, earlier = loads(problem, nodes, sides, size), 0
    if any(slid):  # GetFEM measures slip from u = 0, so u is what is added to this
        earlier = slid_displacements([*law[0], *rows], law[1], slid, size)
        model.assembly("build_matrix")
        right -= model.tangent_matrix().mult(earlier)
    model.add_explicit_rhs("u", right)
    values = [value for _, of_node in held.values() for value in of_node]
    if values:  # GetFEM refuses variables of no size
        model.add_variable("reactions", len(values))
        model.add_constraint_with_multipliers("u", "reactions", spmat(rows, size), values)
    model.add_initialized_data("r", [shear_modulus])
    if law[0]:
        add_contact(model, size, *law)
    model.assembly("build_rhs")
    small = 1e-8 * np.abs(model.rhs()).sum()  # of the residual's sum, which is an absolute one
    steps, converged = 0, False
    for part in (10, 100, 1000):  # too large an r, or the default line search, and it may cycle
        model.set_variable("r", [shear_modulus / part])
        model.to_variables(np.zeros(model.nbdof()))
        more, converged = model.solve("max_iter", 100, "max_res", small, "lsolver", "mumps",
                                      "lsearch", "simplest")
        steps += more
        if converged:
            break
    return (model.variable("u") + earlier).reshape(-1, 2)[nodes], steps, converged


if __name__ == "__main__":
    _, way, folder, output = sys.argv
    problem = dict(np.load(Path(folder, "problem.npz")))
    start = perf_counter()
    u, steps, converged = solve(problem, way == "coefficients")
    write_answer(output, {"displacement_mm": u}, status="ok" if converged else "not_converged",
                 message=f"{steps} Newton steps", time_s=perf_counter() - start, contact_iterations=steps,
                 parameters=f"P2, contact of {way}; MUMPS")
