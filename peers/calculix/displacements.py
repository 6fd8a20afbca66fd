"""Displacements by CalculiX: P2 triangles, contact with rigid walls by a penalty or by mortar.

    displacements.py penalty|mortar STIFFNESS THREADS INPUT OUTPUT [DECK]

INPUT is also what `bench export-problem --format=npz` writes. DECK: a file that keeps CalculiX's input, in its units.
Every contact edge at a wall has a wall element, which stands off by its gap; those of two bodies press on
each other where they are. Penetration is resisted by
STIFFNESS E/L, in MPa per mm, E of the stiffest body and L the longer side of all; sliding by a
tenth of it, with mortar by as much. CalculiX's tolerances suit steel of 10 mm: E and L become
these, and loads and gaps so small that they turn no normal. Mortar takes no triangles, so the body
becomes a layer of prisms with u_z = 0, and the answer is the mean through its thickness.
"""
import os
import re
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1]))
from answer import write_answer  # noqa: E402
from constraints import boundary_nodes, held_nodes, loads, opposite_of, sides_of, triangle_nodes  # noqa: E402

STEEL_MPA, LENGTH_MM, STRAIN = 2e5, 10, 1e-6
HEIGHTS = 0.0, 1.0, 0.5  # of the layers of nodes; middles of edges have none half-way


class Refused(Exception):
    pass


def card(name, rows=()):
    """A line has at most 16 words."""
    words = [[f"{x:.14g}" if isinstance(x, float) else str(x) for x in row] for row in rows]
    return "\n".join([f"*{name}", *(",\n".join(",".join(row[k:k + 15]) for k in range(0, len(row), 15))
                                    for row in words)])


def elastic(compliance):
    """E and nu whose plane strain has this compliance, be it of plane strain or stress."""
    stiffness = np.linalg.inv(compliance.reshape(3, 3))
    lame, shear = float(stiffness[0, 1]), float(stiffness[2, 2])
    return shear * (3 * lame + 2 * shear) / (lame + shear), lame / (2 * (lame + shear))


def in_its_units(problem):
    """The problem with E and L of steel and small loads; what displacements are multiplied by."""
    young = max(elastic(compliance)[0] for compliance in problem["compliance_per_MPa"])
    length = np.ptp(problem["vertices_mm"], axis=0).max()
    per_strain = {"u0_mm": length, "traction_MPa": young, "body_force_N_per_mm3": young / length}
    strain = max(-problem["gap_mm"].min() / length,
                 *(np.abs(problem[name]).max() / unit for name, unit in per_strain.items()))
    load, mm, MPa = STRAIN / strain if strain > 0 else 1, LENGTH_MM / length, STEEL_MPA / young
    units = {"vertices_mm": mm, "compliance_per_MPa": 1 / MPa, "u0_mm": load * mm, "gap_mm": load * mm,
             "traction_MPa": load * MPa, "body_force_N_per_mm3": load * MPa / mm}
    return problem | {name: problem[name] * unit for name, unit in units.items()}, load * mm


def wall(problem, side, x):
    """Eight nodes, counter-clockwise; the edge between the first two faces the contact edge."""
    normals = problem["contact_normals"][side].reshape(3, 2)
    a, m, b = x + problem["gap_mm"][side][:, None] * normals
    depth = np.hypot(*(b - a)) * normals.mean(0)
    return b, a, a + depth, b + depth, m, a + depth / 2, m + depth, b + depth / 2


def element(nodes, corners, layer):
    """Its numbers; of a solid: corners of both layers, middles of both, corners half-way."""
    ends, middles = nodes[:corners] + 1, nodes[corners:] + 1
    return [*ends, *(ends + layer), *middles, *(middles + layer), *(ends + 2 * layer)] if layer else nodes + 1


def support_cards(held, vertices, layer, layers, reference):
    """Fixed components (node, first, last, value), and equations: inclined rollers on reference nodes."""
    fixed, equations = [], []
    for node, (directions, values) in held.items():
        for n in (h * layer + node + 1 for h in range(layers) if h < 2 or node < vertices):
            if len(values) == 2:
                fixed += [(n, k + 1, k + 1, u) for k, u in enumerate(np.linalg.solve(directions, values).tolist())]
                continue
            (direction,), (value,) = np.array(directions), values
            first, second = np.argsort(-np.abs(direction)).tolist()
            if direction[second] == 0:
                fixed.append((n, first + 1, first + 1, float(value / direction[first])))
                continue
            reference += 1
            fixed.append((reference, 1, 1, float(value)))
            equations.append(card("EQUATION", [(3,), (n, first + 1, float(direction[first]), n, second + 1,
                                                      float(direction[second]), reference, 1, -1.0)]))
    return fixed, equations


def contact_cards(problem, sides, face, wall_face, mortar, stiffness):
    """face: of the body at a side, as (element, face); a pair for every friction and two bodies, or a wall."""
    groups, lines = {}, []
    for side in sides:
        other = opposite_of(problem, side)
        if other < 0:
            groups.setdefault((problem["friction"][side], -1, -1), []).append((face(side), wall_face[side]))
        elif side < other:
            bodies = (problem["triangle_body"][face(s)[0] - 1] for s in (side, other))
            groups.setdefault((problem["friction"][side], *bodies), []).append((face(side), face(other)))
    for k, ((mu, *_), faces) in enumerate(groups.items()):
        first, second = zip(*faces)
        lines += [card(f"SURFACE, NAME=edges{k}", first), card(f"SURFACE, NAME=walls{k}", second),
                  card(f"SURFACE INTERACTION, NAME=law{k}"),
                  card("SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", [(stiffness,)])]
        if mu > 0:
            lines.append(card("FRICTION", [(float(mu), stiffness if mortar else stiffness / 10)]))
        lines.append(card(f"CONTACT PAIR, INTERACTION=law{k}, TYPE={'MORTAR' if mortar else 'SURFACE TO SURFACE'}",
                          [(f"edges{k}", f"walls{k}")]))
    return lines


def refuse_bodies_apart(problem):
    """CalculiX measures gaps of bodies in the mesh, and loads are made small here: none must be left."""
    x, ends = problem["vertices_mm"], problem["boundary"]
    for side in sides_of(problem, "contact"):
        other = opposite_of(problem, side)
        if other <= side:
            continue
        off = max(np.abs(x[ends[other][::-1]] - x[ends[side]]).max(), np.abs(problem["gap_mm"][[side, other]]).max())
        if off > 1e-9 * np.ptp(x, axis=0).max():
            raise Refused(f"faces of bodies that are {off:.1e} mm apart, or stand for a curve (allowed: that touch in "
                          "the mesh)")


def refuse_for_mortar(problem, contact, sides, load):
    nodes = np.unique(sides[contact])
    if load[nodes].any():
        raise Refused("mortar of CalculiX does not converge with loads at nodes of contact edges: a body force, "
                      "or a traction next to contact (allowed: none)")
    for node in nodes:
        if len(set(problem["friction"][[side for side in contact if node in sides[side]]])) > 1:
            raise Refused("mortar of CalculiX drops a vertex of two contact pairs: faces of different friction "
                          "that meet (allowed: faces apart, or of one friction)")


def deck(problem, mortar, stiffness):
    """What CalculiX reads."""
    vertices, contact = problem["vertices_mm"], sides_of(problem, "contact")
    x = np.vstack([vertices, vertices[problem["edges"]].mean(1)])
    triangles, sides = triangle_nodes(problem), boundary_nodes(problem)
    load = loads(problem, np.arange(len(x)), sides, 2 * len(x)).reshape(-1, 2)
    if mortar:
        refuse_for_mortar(problem, contact, sides, load)
    at_walls = [side for side in contact if opposite_of(problem, side) < 0]
    every = np.vstack([x, *(wall(problem, side, x[sides[side]]) for side in at_walls)])
    layer, heights = (len(every), HEIGHTS) if mortar else (0, HEIGHTS[:1])
    of_body, of_wall, section = ("C3D15", "C3D20", []) if mortar else ("CPE6", "CPE8", [(1.0,)])
    first_face = 3 if mortar else 1

    lines = [card("NODE, NSET=all", [(h * layer + i + 1, *at, z) for h, z in enumerate(heights)
                                     for i, at in enumerate(every.tolist())])]
    for body, compliance in enumerate(problem["compliance_per_MPa"]):
        lines += [card(f"ELEMENT, TYPE={of_body}, ELSET=body{body}",
                       [(t + 1, *element(triangles[t], 3, layer))
                        for t in np.flatnonzero(problem["triangle_body"] == body)]),
                  card(f"MATERIAL, NAME=body{body}"), card("ELASTIC", [elastic(compliance)]),
                  card(f"SOLID SECTION, ELSET=body{body}, MATERIAL=body{body}", section)]
    fixed = [("all", 3, 3)] if mortar else []
    elements = len(triangles) + 1 + np.arange(len(at_walls))
    if at_walls:
        nodes = len(x) + np.arange(8 * len(at_walls)).reshape(-1, 8)
        lines += [card(f"ELEMENT, TYPE={of_wall}, ELSET=walls", [(k, *element(of_k, 4, layer))
                                                                 for k, of_k in zip(elements, nodes)]),
                  card("SOLID SECTION, ELSET=walls, MATERIAL=body0", section)]
        fixed += [(n, 1, 2) for of_k in nodes for n in element(of_k, 4, layer)]
    face = {frozenset(ends): (t + 1, f"S{first_face + k}") for t, abc in enumerate(problem["triangles"].tolist())
            for k, ends in enumerate(zip(abc, abc[1:] + abc[:1]))}
    lines += contact_cards(problem, contact, lambda side: face[frozenset(problem["boundary"][side].tolist())],
                           {side: (k, f"S{first_face}") for side, k in zip(at_walls, elements)}, mortar, stiffness)
    last = len(heights) * len(every)
    held, equations = support_cards(held_nodes(problem, sides), len(vertices), layer, len(heights), last)
    lines += [card("NODE", [(n, 0.0, 0.0, 0.0) for n, *_ in held if n > last]), *equations,
              card("STEP, INC=1000"), card("STATIC", [(1, 1, 1e-6, 1)]), card("BOUNDARY", fixed + held),
              card("CLOAD", [(h * layer + n + 1, axis + 1, float(load[n, axis]) / len(heights[:2]))
                             for h in range(len(heights[:2])) for n, axis in zip(*np.nonzero(load))]),
              card("NODE PRINT, NSET=all", [("U",)]), card("END STEP")]
    return "\n".join(lines) + "\n", layer


def solve(problem, mortar, stiffness, threads, kept):
    """Displacements of nodes, none if it did not converge; what CalculiX printed."""
    text, layer = deck(problem, mortar, stiffness)
    for file in kept:
        Path(file).write_text(text, encoding="ascii")
    with TemporaryDirectory() as folder:
        Path(folder, "job.inp").write_text(text, encoding="ascii")
        ran = subprocess.run(["ccx", "job"], cwd=folder, capture_output=True, text=True, check=False,
                             env=os.environ | {"OMP_NUM_THREADS": threads})
        file = Path(folder, "job.dat")
        values = re.findall(r"^ +([0-9]+) +(\S+) +(\S+) +\S+$", file.read_text("ascii") if file.exists() else "", re.M)
    vertices, edges = len(problem["vertices_mm"]), problem["edges"]
    u = np.full((1 + max([0, *(int(n) for n, *_ in values)]), 2), np.nan)
    for n, *of_node in values:
        u[int(n) - 1] = of_node
    if ran.returncode or not values:
        return None, ran.stdout + ran.stderr
    nodes = np.arange(vertices + len(edges))
    if not mortar:
        return u[nodes], ran.stdout
    mean = (u[nodes] + u[nodes + layer]) / 2  # bottom, top; corners have a bubble of P1 half-way
    bubble = 2 / 3 * (u[nodes[:vertices] + 2 * layer] - mean[:vertices])
    return mean + np.vstack([bubble, bubble[edges].mean(1)]), ran.stdout


if __name__ == "__main__":
    _, way, stiffness, threads, folder, output, *kept = sys.argv
    problem = dict(np.load(Path(folder, "problem.npz")))
    try:
        refuse_bodies_apart(problem)
        problem, unit = in_its_units(problem)
        u, printed = solve(problem, way == "mortar", float(stiffness) * STEEL_MPA / LENGTH_MM, threads, kept)
    except Refused as why:
        write_answer(output, {}, status="skipped", message=str(why), time_s=0)
        sys.exit()
    error = "; ".join(re.findall(r"\*ERROR.*", printed)) or "it ended without displacements"
    clock = re.findall(r"Total CalculiX Time: *(\S+)", printed)
    write_answer(output, {} if u is None else {"displacement_mm": u / unit}, time_s=float(clock[-1]) if clock else 0,
                 status="not_converged" if u is None else "ok", message=error if u is None else "",
                 contact_iterations=len(re.findall(r"^ iteration ", printed, re.M)),
                 parameters=f"{way}, stiffness {stiffness} E/L, {len(re.findall('^ convergence', printed, re.M))} increments")
