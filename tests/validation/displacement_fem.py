"""A second opinion: contact with friction by displacements, from a mesh and a scene file.

    /usr/bin/python3 tests/validation/displacement_fem.py MESH.msh SCENE.json

Quadratic Lagrange triangles; Signorini's and Coulomb's law at the nodes of the contact boundary, on
the compliance condensed to them: Gauss-Seidel sweeps, then active sets. It shares nothing with
airybench but the file formats, and prints one JSON object. Scenes with "mesh", "layers" or geometry
to compare are refused.
"""
from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix
from scipy.sparse.linalg import splu

DEFAULTS = {"young_MPa": 210000, "poisson": 0.3, "plane": "strain", "friction": 0.2,
            "crown_radius_mm": 400, "clearance_mm": 0, "displacement_mm": [0.02, 0.006],
            "body_force_N_per_mm3": [0, 0], "boundary": {}, "materials": {},
            "about": "", "group": ""}
MIDDLE = np.array([[0, 1], [1, 2], [2, 0]])  # local nodes 3, 4, 5
GAUSS = np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4]]) / 6  # degree 2: weights 1/3


@dataclass
class Mesh:
    x: np.ndarray          # nodes: vertices, then middles of edges
    triangles: np.ndarray  # six nodes each
    body: list[str]        # of every triangle
    edges: np.ndarray      # on the boundary: start, end, middle; the body on the left
    label: list[str]       # of every such edge


def read_mesh(path: str) -> Mesh:
    lines = iter(Path(path).read_text(encoding="ascii").split("\n"))

    def section(name: str) -> list[list[str]]:
        while next(lines).strip() != f"${name}":
            pass
        return [next(lines).split(maxsplit=2 if name == "PhysicalNames" else -1)
                for _ in range(int(next(lines)))]

    names = {int(tag): name.strip('" ') for _, tag, name in section("PhysicalNames")}
    nodes = section("Nodes")
    number = {node[0]: i for i, node in enumerate(nodes)}
    x = [(float(node[1]), float(node[2])) for node in nodes]
    corners, body, ends, label = [], [], [], []
    for element in section("Elements"):
        own = [number[node] for node in element[3 + int(element[2]):]]
        (ends if element[1] == "1" else corners).append(own)
        (label if element[1] == "1" else body).append(names[int(element[3])])
    middles: dict[tuple[int, int], int] = {}

    def middle(a: int, b: int) -> int:
        key = (min(a, b), max(a, b))
        if key not in middles:
            middles[key] = len(x)
            x.append(tuple((np.array(x[a]) + x[b]) / 2))
        return middles[key]

    triangles = np.array([[*t, *(middle(t[i], t[j]) for i, j in MIDDLE)] for t in corners])
    edges = np.array([[a, b, middle(a, b)] for a, b in ends])
    return Mesh(np.array(x), triangles, body, edges, label)


def read_scene(path: str) -> dict:
    scene = json.loads(Path(path).read_text(encoding="utf-8"))
    if unknown := set(scene) - set(DEFAULTS):
        sys.exit(f"{path}: not known here: {', '.join(sorted(unknown))}")
    return DEFAULTS | scene


def elasticity(scene: dict, body: str) -> np.ndarray:
    own = scene["materials"].get(body, {})
    young, nu = (own.get(key, scene[key]) for key in ("young_MPa", "poisson"))
    if scene["plane"] == "strain":
        young, nu = young / (1 - nu**2), nu / (1 - nu)
    return young / (1 - nu**2) * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])


def strain_matrices(corner: np.ndarray) -> tuple[list[np.ndarray], float]:
    """B at the Gauss points (xx, yy, 2xy from the six nodes' x, y), and the area."""
    (x0, y0), (x1, y1), (x2, y2) = corner
    twice = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    grad = np.array([[y1 - y2, x2 - x1], [y2 - y0, x0 - x2], [y0 - y1, x1 - x0]]) / twice
    matrices = []
    for bary in GAUSS:
        of_node = np.vstack([(4 * bary - 1)[:, None] * grad,
                             [4 * (bary[i] * grad[j] + bary[j] * grad[i]) for i, j in MIDDLE]])
        b = np.zeros((3, 12))
        b[0, 0::2] = b[2, 1::2] = of_node[:, 0]
        b[1, 1::2] = b[2, 0::2] = of_node[:, 1]
        matrices.append(b)
    return matrices, twice / 2


def stiffness_and_load(mesh: Mesh, scene: dict) -> tuple[csc_matrix, np.ndarray]:
    rows, columns, values = [], [], []
    load = np.zeros(2 * len(mesh.x))
    for nodes, body in zip(mesh.triangles, mesh.body):
        matrices, area = strain_matrices(mesh.x[nodes[:3]])
        k = sum(b.T @ elasticity(scene, body) @ b for b in matrices) * area / 3
        dofs = np.stack([2 * nodes, 2 * nodes + 1], axis=1).ravel()
        rows.append(np.repeat(dofs, 12))
        columns.append(np.tile(dofs, 12))
        values.append(k.ravel())
        for i, force in enumerate(scene["body_force_N_per_mm3"]):
            load[2 * nodes[3:] + i] += force * area / 3
    shape = (len(load), len(load))
    k = coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape)
    return k.tocsc(), load


def normal_of(mesh: Mesh, edge: np.ndarray) -> tuple[np.ndarray, float]:
    s = mesh.x[edge[1]] - mesh.x[edge[0]]
    length = float(np.hypot(*s))
    return np.array([s[1], -s[0]]) / length, length


def value_at(given: object, x: np.ndarray) -> np.ndarray:
    if not isinstance(given, dict):
        return np.asarray(given, float)
    (p, q), (v, w) = np.array(given["at_mm"], float), np.array(given["values"], float)
    return v + (x - p) @ (q - p) / ((q - p) @ (q - p)) * (w - v)


def add_tractions(mesh: Mesh, scene: dict, load: np.ndarray) -> None:
    points, weights = np.polynomial.legendre.leggauss(3)
    for edge, label in zip(mesh.edges, mesh.label):
        given = scene["boundary"].get(label, {})
        n, length = normal_of(mesh, edge)
        for s, weight in zip((1 + points) / 2, weights / 2 * length):
            x = (1 - s) * mesh.x[edge[0]] + s * mesh.x[edge[1]]
            t = (value_at(given["traction_MPa"], x) if "traction_MPa" in given
                 else -value_at(given.get("pressure_MPa", 0), x) * n)
            shape = [(1 - s) * (1 - 2 * s), s * (2 * s - 1), 4 * s * (1 - s)]
            for node, own in zip(edge, shape):
                load[2 * node:2 * node + 2] += weight * own * t


def supports(mesh: Mesh, scene: dict) -> dict[int, list[tuple[np.ndarray, float]]]:
    """Of every node: directions along which, and the value that, its displacement is prescribed."""
    held: dict[int, list[tuple[np.ndarray, float]]] = {}
    for edge, label in zip(mesh.edges, mesh.label):
        if not label.startswith("displacement"):
            continue
        given = {"displacement_mm": scene["displacement_mm"]} | scene["boundary"].get(label, {})
        rolls = given.get("support") == "normal"
        for node in edge:
            u = value_at(given["displacement_mm"], mesh.x[node])
            for axis in [normal_of(mesh, edge)[0]] if rolls else np.eye(2):
                own = held.setdefault(node, [])
                if all(abs(axis[0] * e[1] - axis[1] * e[0]) > 1e-6 for e, _ in own):
                    own.append((axis, axis @ u))
    return held


def contact_nodes(mesh: Mesh, scene: dict) -> dict[int, tuple[np.ndarray, float]]:
    """Normal and gap of every node; the gap is measured from the middle of its face."""
    edges = [edge for edge, label in zip(mesh.edges, mesh.label) if label.startswith("contact")]
    after = {edge[0]: edge for edge in edges}
    found: dict[int, tuple[np.ndarray, float]] = {}
    for first in set(after) - {edge[1] for edge in edges}:
        face = [after[first]]
        while face[-1][1] in after:
            face.append(after[face[-1][1]])
        axis = (mesh.x[first] + mesh.x[face[-1][1]]) / 2
        for edge in face:
            for node in edge:
                n, radius = normal_of(mesh, edge)[0], scene["crown_radius_mm"]
                if node in found:
                    n = (n + found[node][0]) / np.hypot(*(n + found[node][0]))
                curved = np.sum((mesh.x[node] - axis)**2) / (2 * radius) if radius else 0
                found[node] = n, scene["clearance_mm"] + curved
    return found


def solve_contact(w: np.ndarray, free: np.ndarray, mu: np.ndarray) -> np.ndarray:
    """Forces F (normal, tangential of each node), u − gap = w F + free, by the contact law."""
    count = len(mu)
    force = np.zeros(2 * count)
    scale = 1 / np.diag(w)

    def project(trial: np.ndarray) -> np.ndarray:
        normal = np.minimum(trial[0::2], 0)
        return np.stack([normal, np.clip(trial[1::2], mu * normal, -mu * normal)], 1).ravel()

    for _ in range(300):  # Gauss-Seidel, a projected step at a time
        for i in range(2 * count):
            force[i] -= scale[i] * (w[i] @ force + free[i])
            normal = force[i - i % 2] = min(force[i - i % 2], 0)
            if i % 2:
                force[i] = np.clip(force[i], mu[i // 2] * normal, -mu[i // 2] * normal)
    for _ in range(100):  # active sets: the states of the projection, then a linear system
        trial = force - scale * (w @ force + free)
        if np.linalg.norm(force - project(trial)) <= 1e-11 * np.linalg.norm(force):
            return force
        normal, tangential = trial[0::2], trial[1::2]
        closed, slips = normal < 0, np.abs(tangential) >= -mu * normal
        a, b = w.copy(), -free
        for p in range(count):
            prescribed = [2 * p, 2 * p + 1] if not closed[p] else [2 * p + 1] if slips[p] else []
            for row in prescribed:
                a[row], b[row] = 0, 0
                a[row, row] = 1
            if closed[p] and slips[p]:
                a[2 * p + 1, 2 * p] = np.sign(tangential[p]) * mu[p]
        force = np.linalg.solve(a, b)
    sys.exit("the contact law is not met")


def solve(mesh: Mesh, scene: dict) -> dict[str, float]:
    stiffness, load = stiffness_and_load(mesh, scene)
    add_tractions(mesh, scene, load)
    held, contact = supports(mesh, scene), contact_nodes(mesh, scene)
    # u = T v + given, v along the directions that are free at each node
    given, columns = np.zeros(len(load)), []
    for node in range(len(mesh.x)):
        own = held.get(node, [])
        if own:
            axes = np.array([axis for axis, _ in own])
            given[2 * node:2 * node + 2] = np.linalg.lstsq(axes, [d for _, d in own], None)[0]
        left = (np.eye(2) if not own else [(-own[0][0][1], own[0][0][0])] if len(own) == 1 else [])
        columns += [(2 * node, axis) for axis in left]
    index = np.array([[row, row + 1] for row, _ in columns]).ravel()
    t = coo_matrix((np.array([axis for _, axis in columns]).ravel(),
                    (index, np.repeat(np.arange(len(columns)), 2))),
                   (len(load), len(columns))).tocsc()
    factor = splu((t.T @ stiffness @ t).tocsc())
    points = [node for node in contact if len(held.get(node, [])) < 2]
    rows = np.zeros((2 * len(points), len(load)))
    for p, node in enumerate(points):
        n = contact[node][0]
        rows[2 * p, 2 * node:2 * node + 2] = n
        rows[2 * p + 1, 2 * node:2 * node + 2] = -n[1], n[0]
    without = t @ factor.solve(t.T @ (load - stiffness @ given)) + given
    to_contact = rows @ t
    w = to_contact @ factor.solve(to_contact.T) if points else np.zeros((0, 0))
    free = rows @ without
    free[0::2] -= [contact[node][1] for node in points]
    mu = np.full(len(points), float(scene["friction"]))
    for p, node in enumerate(points):
        if node in held:  # on a roller: its tangential displacement is given
            mu[p], free[2 * p + 1] = 0, 0
            w[2 * p + 1], w[:, 2 * p + 1] = 0, 0
            w[2 * p + 1, 2 * p + 1] = w[2 * p, 2 * p]
    force = solve_contact(w, free, mu)
    u = without + t @ factor.solve(to_contact.T @ force)
    return {"strain_energy_Nmm": float(u @ (stiffness @ u)) / 2,
            "normal_resultant_N": float(force[0::2].sum()),
            "tangential_resultant_N": float(force[1::2].sum()),
            "displacements": len(load)}


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(json.dumps(solve(read_mesh(sys.argv[1]), read_scene(sys.argv[2]))))
