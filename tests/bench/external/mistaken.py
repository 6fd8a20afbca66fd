"""A contact program with a mistake:  mistaken.py MISTAKE INPUT OUTPUT  (RIGHT: none)

MISTAKE sweeps=N: it ends after N sweeps, whatever is left, and says ok.

Projected Gauss-Seidel on the condensed problem, in the format npz.
"""
import json
import os
import sys
from pathlib import Path
from time import perf_counter

import numpy as np

mistake, folder, output = sys.argv[1:]
if mistake == "CRASH":
    sys.exit(3)


def sweeps(D, b, mu, tolerance, absolute, opens=True, box=False, sticks=False, pulled=None):
    """F with r = D F + b; None: no convergence. pulled: limit of |F_t| where F_n > 0."""
    components, F = len(b) // len(mu), np.zeros(len(b))
    fixed = int(mistake.removeprefix("sweeps=")) if mistake.startswith("sweeps=") else 0
    for _ in range(fixed or 5000):  # 2000 are right to rounding where there is a solution
        before = F.copy()
        for p, friction in enumerate(mu):
            n = components * p
            F[n] -= (D[n] @ F + b[n]) / D[n, n]
            if opens:
                F[n] = min(F[n], 0)
            if components == 2:
                most = friction if box else friction * abs(F[n])
                if sticks and F[n] < 0:
                    most = np.inf
                if pulled is not None and F[n] > 0:
                    most = pulled
                free = F[n + 1] - (D[n + 1] @ F + b[n + 1]) / D[n + 1, n + 1]
                F[n + 1] = -np.clip(-free, -most, most) if mistake == "sign_of_mu_of_reactions" else \
                    np.clip(free, -most, most)
        change = np.linalg.norm(F - before)
        if not fixed and change <= (tolerance if absolute else tolerance * np.linalg.norm(F)):
            return F
    return F if fixed else None


def forces(D, G, gap, mu):
    components = len(G) // len(mu)
    if mistake == "always_two_components" and components == 1:
        return np.zeros(2 * len(mu))
    G = -G if mistake == "sign_of_G" else G
    gap = -gap if mistake == "sign_of_gap" else gap / 1000 if mistake == "units" else gap
    b = -G - gap
    if mistake == "friction_factor":
        mu = 2 * mu
    if mistake.startswith("sign_of_mu"):
        mu = -mu
    if mistake == "sine":
        mu = mu / np.sqrt(1 + mu**2)
    if mistake == "unlike_any":
        mu = 0.9 * mu
    F = sweeps(D, b, mu, 1e-7 if mistake == "absolute_tolerance" else 1e-12,
               mistake == "absolute_tolerance", not mistake.startswith("tension"),
               mistake == "box", mistake == "no_cone",
               {"tension_slips": 0, "tension_sticks": np.inf}.get(mistake))
    if F is None:
        return np.zeros(len(b)) if mistake == "always_ok" else None
    if mistake == "sign_of_tangent" and components == 2:
        F[1::2] *= -1
    if mistake == "order" and components == 2:
        F = np.concatenate([F[::2], F[1::2]])
    return F


problem = np.load(Path(folder, "problem.npz"))
start = perf_counter()
found = forces(*(problem[name] for name in ("D", "G", "gap", "mu")))
report = {"status": "not_converged" if found is None else "ok", "time_s": perf_counter() - start}
if found is not None:
    np.save(Path(output, "F_C.npy"), found.reshape(-1, 1))
answer = Path(output, "answer.json")
text = json.dumps(report)
if mistake == "FIFO":
    os.mkfifo(answer)
elif mistake == "LINK":
    Path(output, "elsewhere.json").write_text(text)
    answer.symlink_to("elsewhere.json")
elif mistake == "LARGE":
    answer.write_text(text + " " * (20 << 20))
elif mistake == "DEEP":
    answer.write_text("[" * 100000)
elif mistake != "SILENT":
    answer.write_text(text)
