"""Contact forces of a condensed problem:  NAME.py INPUT OUTPUT  (docs/your-program.md)

    r = D F - G - gap      per contact point a normal row, then (with friction) a tangential one
    F_n <= 0, r_n <= 0, F_n r_n = 0;  |F_t| <= mu |F_n|, F_t r_t <= 0, r_t = 0 unless it slips

It takes problems in the plane, with one or two components per point; in space there are three.
F in N per mm of thickness, r, G and gap in mm, D in mm/N. Replace contact_forces() by your method.
"""
import json
import sys
from pathlib import Path
from time import perf_counter

import numpy as np


class NotConverged(Exception):
    pass


class Refused(Exception):
    pass


def contact_forces(D, b, mu):
    """F with r = D F + b, and the number of steps: Newton's method on F = P(F - r / diag D)."""
    components, F = len(b) // max(len(mu), 1), np.zeros(len(b))
    if components > 2:
        raise Refused(f"{components} components per contact point (allowed: 1 or 2, in the plane)")
    for step in range(1, 51):
        trial = F - (D @ F + b) / np.diag(D)
        A, right = D.copy(), -b  # r = 0, closed and sticking
        for point in range(len(mu)):
            i = components * point
            if trial[i] >= 0:  # open: F = 0
                rows = slice(i, i + components)
                A[rows], right[rows] = np.eye(len(b))[rows], 0
            elif components == 2 and abs(trial[i + 1]) >= -mu[point] * trial[i]:  # slip
                A[i + 1], right[i + 1] = np.eye(len(b))[i + 1], 0
                A[i + 1, i] = mu[point] * np.sign(trial[i + 1])
        before, F = F, np.linalg.solve(A, right)
        if np.linalg.norm(F - before) <= 1e-13 * np.linalg.norm(F):
            if ((D @ F + b)[::components] > 1e-9 * np.abs(b).max()).any():
                raise NotConverged("points are inside the wall")
            return F, step
    raise NotConverged("no convergence in 50 steps")


def main(folder, output):
    problem = np.load(Path(folder, "problem.npz"))
    D, G, gap, mu = (problem[name] for name in ("D", "G", "gap", "mu"))
    start = perf_counter()
    try:
        F, steps = contact_forces(D, -G - gap, mu)
        answer = {"status": "ok", "contact_iterations": steps}
        np.save(Path(output, "F_C.npy"), F.reshape(-1, 1))
    except (NotConverged, np.linalg.LinAlgError) as why:
        answer = {"status": "not_converged", "message": str(why)}
    except Refused as why:
        answer = {"status": "breakdown", "message": str(why)}
    answer["time_s"] = perf_counter() - start  # of the solve, without reading and writing
    Path(output, "answer.json").write_text(json.dumps(answer))


if __name__ == "__main__":
    main(*sys.argv[1:])
