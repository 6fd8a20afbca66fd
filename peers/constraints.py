"""Loads, supports and contact of an exported body as rows on the degrees of freedom of P2 nodes.

A row is {degree of freedom: value}; node k has 2k (along x) and 2k + 1 (along y).
"""
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

ROLE = {"displacement": 0, "force": 1, "contact": 2}


def sides_of(problem, role):
    return np.flatnonzero(problem["boundary_roles"] == ROLE[role])


def middle_nodes(problem):
    """{edge: node}: nodes of vertices come first, then those of the middles of edges."""
    first = len(problem["vertices_mm"])
    return {edge: first + i for i, edge in enumerate(map(frozenset, problem["edges"].tolist()))}


def triangle_nodes(problem):
    """Three vertices, then the middles of the edges from the first to the second, ..."""
    middle = middle_nodes(problem)
    return np.array([(a, b, c, *(middle[frozenset(ends)] for ends in ((a, b), (b, c), (c, a))))
                     for a, b, c in problem["triangles"].tolist()])


def boundary_nodes(problem):
    """Start, middle, end."""
    middle = middle_nodes(problem)
    return np.array([(a, middle[frozenset((a, b))], b) for a, b in problem["boundary"].tolist()])


def length_and_normal(problem, side):
    s = np.diff(problem["vertices_mm"][problem["boundary"][side]], axis=0)[0]
    length = np.hypot(*s)
    return length, np.array([s[1], -s[0]]) / length


def row_along(direction, nodes, weights):
    return {2 * node + axis: weight * direction[axis]
            for node, weight in zip(nodes, weights) for axis in (0, 1) if weight * direction[axis]}


def loads(problem, nodes, sides, size):
    """Of the tractions, linear on an edge, by Simpson's rule; of the body force, at the middles of edges."""
    load = np.zeros((size // 2, 2))
    for side in sides_of(problem, "force"):
        start, end = problem["traction_MPa"][side].reshape(2, 2)
        length, _ = length_and_normal(problem, side)
        load[sides[side]] += length / 6 * np.array([start, 2 * (start + end), end])
    corners = problem["vertices_mm"][problem["triangles"]]
    areas = np.abs(np.linalg.det(np.diff(corners, axis=1))) / 2
    number = {edge: i for i, edge in enumerate(map(frozenset, problem["edges"].tolist()))}
    for triangle, area in zip(problem["triangles"].tolist(), areas):
        for a, b in zip(triangle, triangle[1:] + triangle[:1]):
            middle = nodes[len(problem["vertices_mm"]) + number[frozenset((a, b))]]
            load[middle] += area / 3 * problem["body_force_N_per_mm3"]
    return load.ravel()


def held_nodes(problem, sides):
    """Of what is prescribed, {node: (directions, displacements along them)}."""
    held = {}
    for side in sides_of(problem, "displacement"):
        axes = [length_and_normal(problem, side)[1]] if problem["rollers"][side] else np.eye(2)
        for node, u0 in zip(sides[side].tolist(), problem["u0_mm"][side].reshape(3, 2)):
            directions, values = held.setdefault(node, ([], []))
            for axis in axes:
                if is_free(axis, directions):
                    directions.append(axis)
                    values.append(axis @ u0)
    return held


def is_free(axis, held):
    return len(held) < 2 and all(abs(axis[0] * d[1] - axis[1] * d[0]) > 1e-6 for d in held)


def opposite_of(problem, side):
    """The side of another body that it presses on; -1: a wall."""
    return problem["contact_opposite"][side].item() if "contact_opposite" in problem else -1


def vertices_apart(problem):
    """Vertices of a mesh in which no two bodies touch, for programs that join vertices of one place.

    Moving a body changes neither its stiffness nor the rows here, which are those of where it is.
    """
    x, (a, b, c) = problem["vertices_mm"], problem["triangles"].T
    joins = coo_array((np.ones(2 * len(a)), (np.hstack([a, b]), np.hstack([b, c]))), shape=(len(x), len(x)))
    _, body = connected_components(joins, directed=False)
    return x + np.outer(2 * np.ptp(x[:, 0]) * body, [1, 0])


def contact(problem, sides, held, of_coefficients):
    """Rows (normal, tangential), gaps, friction, slid of every node or Bernstein coefficient of contact edges.

    Slip is tangential row times u, less slid: where earlier load steps have left it. A vertex between two edges
    has their mean normal, the smaller gap and the smaller friction. Of two bodies the rows are those of the
    difference of their displacements, gaps and slid those of both. A roller takes friction.
    """
    weights = np.eye(3)
    if of_coefficients:
        weights[1] = -1 / 2, 2, -1 / 2
    points, free, across = {}, set(), {}
    for side in sides_of(problem, "contact"):
        normals = problem["contact_normals"][side].reshape(3, 2)
        gaps = weights @ problem["gap_mm"][side]
        slid = weights @ problem["slid_mm"][side] if "slid_mm" in problem else np.zeros(3)
        other = opposite_of(problem, side)
        for k, node in enumerate(sides[side]):
            point = points.setdefault(node, [sides[side], weights[k], 0, np.inf, np.inf, slid[k]])
            point[2] = point[2] + normals[k]
            point[3] = min(point[3], gaps[k])
            point[4] = min(point[4], problem["friction"][side])
            if is_free(normals[k], held.get(node, [[]])[0]):
                free.add(node)
            if other >= 0:
                across[node] = sides[other][2 - k]
    law, done = ([], [], [], [], []), set()
    for node, (nodes, own, n, gap, friction, slid) in points.items():
        if node not in free or node in done:
            continue
        n = n / np.hypot(*n)
        rows = [row_along(axis, nodes, own) for axis in (n, (-n[1], n[0]))]
        pair = {node}
        if node in across:
            nodes, own, _, gap_beyond, _, slid_beyond = points[across[node]]
            rows = [row | row_along(axis, nodes, -own) for row, axis in zip(rows, (n, (-n[1], n[0])))]
            gap += gap_beyond
            slid += slid_beyond
            pair.add(across[node])
        if any(of_pair in held for of_pair in pair & free):
            friction = 0
        done |= pair
        for column, value in zip(law, (*rows, gap, friction, slid)):
            column.append(value)
    return law
