"""Contact forces of an exported problem, in N:  solve_problem.py FOLDER  (of --format=npz)"""
import sys
from pathlib import Path

import numpy as np
from scipy.sparse import bmat, load_npz
from scipy.sparse.linalg import splu


def read(folder):
    sparse = {name: load_npz(Path(folder, f"{name}.npz")) for name in ("S", "C_F", "C_C")
              if Path(folder, f"{name}.npz").exists()}
    return dict(np.load(Path(folder, "problem.npz"))) | sparse


def responses(S, C_F, C_C, q, F, F0):
    """x and u_C, in rows, of unit contact forces (columns) and of the loads (last column)."""
    K = bmat([[S, C_F.T, C_C.T], [C_F, None, None], [C_C, None, None]], format="csc")
    unit_forces = np.eye(K.shape[0])[:, K.shape[0] - len(F0):]
    right = np.column_stack([unit_forces, np.concatenate([q, F, -F0])])
    factor = splu(K)
    x = factor.solve(right)
    x += factor.solve(right - K @ x)
    return x[:len(q)], -x[len(x) - len(F0):]  # u_C = -lambda'


def contact_forces(D, b, mu):
    """F that meets the contact law with r = D F + b: Newton's method on F = P(F - r / diag D)."""
    components, F = len(b) // max(len(mu), 1), np.zeros(len(b))
    for _ in range(50):
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
            return F
    raise ArithmeticError("the contact law: no convergence in 50 steps")


if __name__ == "__main__":
    problem = read(sys.argv[1])
    _, u_C = responses(*(problem[name] for name in ("S", "C_F", "C_C", "q", "F", "F0")))
    F_C = contact_forces(u_C[:, :-1], u_C[:, -1] - problem["gap"], problem["mu"])
    print(F_C.reshape(len(problem["mu"]), -1))
    print("difference:", np.linalg.norm(F_C - problem["F_C"]) / np.linalg.norm(F_C))
