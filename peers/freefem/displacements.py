"""Displacements by FreeFEM, contact of Bernstein coefficients:  displacements.py INPUT OUTPUT

For contact.edp it writes body.msh and problem.txt, numbers: of every triangle Lame's constants and its
nodes in FreeFEM's order, nodal loads, rows of supports and their values, rows of contact points (normal,
then tangential), their gaps and friction. A matrix is a list of row, degree of freedom, value.
"""
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1]))
from answer import write_answer  # noqa: E402
from constraints import (boundary_nodes, contact, held_nodes, loads, row_along, sides_of,  # noqa: E402
                         triangle_nodes, vertices_apart)


def mesh_lines(problem):
    counts = [len(problem[name]) for name in ("vertices_mm", "triangles", "boundary")]
    return [counts, *((*x, 0) for x in vertices_apart(problem).tolist()),
            *((*abc, 0) for abc in (problem["triangles"] + 1).tolist()),
            *((*ends, 1) for ends in (problem["boundary"] + 1).tolist())]


def problem_lines(problem):
    stiffness = np.linalg.inv(problem["compliance_per_MPa"].reshape(-1, 3, 3))[problem["triangle_body"]]
    nodes, sides = triangle_nodes(problem), boundary_nodes(problem)
    size = len(problem["vertices_mm"]) + len(problem["edges"])
    held = held_nodes(problem, sides)
    supports = [row_along(axis, [node], [1]) for node, (axes, _) in held.items() for axis in axes]
    normal, tangential, gaps, friction, slid = contact(problem, sides, held, True)
    components = 2 if any(friction) else 1
    law = [row for pair in zip(normal, tangential) for row in pair[:components]]
    entries = [[(i, *entry) for i, row in enumerate(rows) for entry in row.items()] for rows in (supports, law)]
    return [*((of[0, 1], of[2, 2], *six) for of, six in zip(stiffness, nodes[:, [0, 1, 2, 4, 5, 3]])),
            loads(problem, np.arange(size), sides, 2 * size),
            (len(supports), len(entries[0])), *entries[0], [u for _, of_node in held.values() for u in of_node],
            (len(gaps), components, len(entries[1])), *entries[1], *zip(gaps, friction, slid)]


def write(file, lines):
    file.write_text("".join(" ".join(f"{x:.17g}" for x in line) + "\n" for line in lines), encoding="ascii")


if __name__ == "__main__":
    _, given, output = sys.argv
    problem = dict(np.load(Path(given, "problem.npz")))
    with TemporaryDirectory() as folder:
        write(Path(folder, "body.msh"), mesh_lines(problem))
        write(Path(folder, "problem.txt"), problem_lines(problem))
        ran = subprocess.run(["FreeFem++", "-nw", "-v", "0", Path(__file__).with_name("contact.edp"), folder],
                             capture_output=True, text=True, check=False)
        answer = Path(folder, "answer.txt")
        if ran.returncode or not answer.exists():
            said = (ran.stdout + ran.stderr).strip().split("\n")
            write_answer(output, {}, status="breakdown", message=f"FreeFem++: {said[-1]}", time_s=0)
            sys.exit()
        (time_s, sweeps, change), u = np.split(np.fromstring(answer.read_text("ascii"), sep=" "), [3])
    u = u.reshape(-1, 2)
    converged = change <= 1e-12 and np.isfinite(u).all()
    write_answer(output, {"displacement_mm": u}, status="ok" if converged else "not_converged", time_s=time_s,
                 message=f"{sweeps:.0f} sweeps, the last one changed forces by {change:.1e}",
                 contact_iterations=int(sweeps), parameters="P2, contact of coefficients; Uzawa by points to 1e-12")
