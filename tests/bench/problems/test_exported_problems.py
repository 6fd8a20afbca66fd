"""Exported problems, read by scipy and by FCLIB's library, solved by scipy: the forces are HYBRID's.

    AIRYBENCH_BENCH=PATH [AIRYBENCH_READ_FCLIB=PATH] /usr/bin/python3 -m unittest FILE
"""
import csv
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from scipy.io import mmread
from scipy.sparse import load_npz

PROJECT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(PROJECT / "peers/scipy"), str(PROJECT / "tests/support")]
import solve_problem  # noqa: E402
from exporting import BENCH, ExportingTest, difference  # noqa: E402

READ_FCLIB = os.environ.get("AIRYBENCH_READ_FCLIB")
SADDLE_SYSTEM = ("S", "C_F", "C_C", "q", "F", "F0")
FORMATS = ("matrix-market", "npz", "fclib")
SCENES = {
    "default": {},
    "without friction": {"friction": 0},
    "body force, layers": {"friction": 0.4, "body_force_N_per_mm3": [0.3, -1],
                           "layers": {"count": 2, "materials": [{"young_MPa": 2.1e5, "poisson": 0.3},
                                                              {"young_MPa": 2.1e5, "poisson": 0.45}]}},
    "pressure, rollers at root and flanks": {
        "mesh": {"keep_force_edges": 6}, "displacement_mm": [0.01, 0],
        "boundary": {"force": {"pressure_MPa": 3}, "displacement": {"support": "normal"}}},
    "no force edges": {"mesh": {"keep_force_edges": 0}},
}


class ExportedProblems(ExportingTest):
    def hybrid_forces(self, definition: dict, mesh: str = "Mesh0") -> np.ndarray:
        """F_n, F_t of every contact point, as a run of the method gives them."""
        out = self.folder / "run"
        subprocess.run([BENCH, f"--mesh={mesh}", f"--scene={self.scene(definition)}",
                        "--method=HYBRID", "--repetitions=1", "--fields", f"--out={out}"],
                       check=True, capture_output=True)
        with next((out / "fields").glob(f"{mesh}-*.contact.csv")).open(encoding="utf-8") as file:
            return np.array([[float(row["F_n_N"]), float(row["F_t_N"])]
                             for row in csv.DictReader(file)])

    def test_scipy_solves_the_saddle_system_and_the_contact_law(self) -> None:
        for name, definition in SCENES.items():
            with self.subTest(name):
                out = self.export("npz", definition)
                problem = solve_problem.read(out)
                _, u_C = solve_problem.responses(*(problem[name] for name in SADDLE_SYSTEM))
                D, b = u_C[:, :-1], u_C[:, -1] - problem["gap"]
                self.assertLess(difference(D, problem["D"]), 1e-9)
                self.assertLess(difference(b, -problem["G"] - problem["gap"]), 1e-9)
                F_C = solve_problem.contact_forces(D, b, problem["mu"])
                self.assertLess(difference(F_C, problem["F_C"]), 1e-9)
                forces = self.hybrid_forces(definition)
                components = len(F_C) // len(forces)
                self.assertEqual(1 if definition.get("friction") == 0 else 2, components)
                self.assertGreater(np.abs(forces[:, 0]).max(), 1)
                self.assertLess(difference(F_C, forces[:, :components].ravel()), 1e-9)

    def test_formats_hold_the_same_numbers(self) -> None:
        for name, definition in SCENES.items():
            with self.subTest(name):
                market, numpy = (self.export(form, definition) for form in FORMATS[:2])
                described = json.loads((market / "problem.json").read_text(encoding="utf-8"))
                self.assertEqual(definition, described["scene_definition"])
                files = {"problem.json"}
                dense = np.load(numpy / "problem.npz")
                for array in described["arrays"]:
                    sparse = array["name"] in ("S", "C_F", "C_C")
                    expected = load_npz(numpy / f"{array['name']}.npz").toarray() if sparse \
                        else dense[array["name"]]
                    self.assertEqual(array["shape"], list(expected.shape), array["name"])
                    if array["file"] is None:
                        self.assertEqual(0, array["shape"][0])
                        continue
                    files.add(array["file"])
                    found = mmread(market / array["file"])
                    found = found.toarray() if sparse else found.reshape(expected.shape)
                    self.assertEqual(expected.dtype.kind, found.dtype.kind, array["name"])
                    np.testing.assert_array_equal(expected, found, array["name"])
                    if array["symmetric"]:
                        np.testing.assert_array_equal(expected, expected.T)
                self.assertEqual(files, {file.name for file in market.iterdir()})

    def test_the_tables_say_what_unknowns_and_rows_are(self) -> None:
        """A linear stress, from the tables alone: its forces and its energy."""
        for name in ("default", "without friction", "pressure, rollers at root and flanks"):
            with self.subTest(name):
                self.check_tables(self.export("npz", SCENES[name]))

    def check_tables(self, out: Path) -> None:
        p = np.load(out / "problem.npz")
        S, C_F, C_C = (load_npz(out / f"{name}.npz") for name in ("S", "C_F", "C_C"))
        vertices, edges, triangles = p["vertices_mm"], p["edges"], p["triangles"]
        kind, which = p["unknowns"].T
        gauge = set(range(len(vertices))) - set(which[kind < 3])
        self.assertEqual(1, len(gauge))
        origin = vertices[gauge.pop()]
        # phi = X:H:X / 2 + (a x^3 + 3 b x^2 y + 3 c x y^2 + d y^3) / 6 with X = (x, y) from there
        H, (a, b, c, d) = np.array([[5.0, 2.0], [2.0, 3.0]]), (0.3, -0.2, 0.5, 0.4)

        def hessian(X: np.ndarray) -> np.ndarray:
            x, y = X[..., 0], X[..., 1]
            cubic = np.array([[a * x + b * y, b * x + c * y], [b * x + c * y, c * x + d * y]])
            return H + np.moveaxis(cubic, (0, 1), (-2, -1))

        def gradient(X: np.ndarray) -> np.ndarray:
            return np.einsum("...ij,...j", (hessian(X) + H) / 2, X)

        def stress(X: np.ndarray) -> np.ndarray:
            rotation = np.array([[0, 1], [-1, 0]])  # sxx = phi,yy, syy = phi,xx, sxy = -phi,xy
            return rotation @ hessian(X) @ rotation.T

        X = vertices - origin
        along = np.diff(X[edges], axis=1)[:, 0]
        normal = np.column_stack([along[:, 1], -along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
        phi = np.einsum("vi,vij,vj->v", X, (hessian(X) + 2 * H) / 6, X)
        values = [phi, *gradient(X).T, (gradient(X[edges].mean(1)) * normal).sum(1)]
        x = np.array([values[k][w] for k, w in zip(kind, which)]) / p["scale"]

        for matrix, rows, directions in ((C_F, p["force_rows"], p["force_directions"]),
                                         (C_C, p["contact_rows"], p["contact_directions"])):
            ends = X[p["boundary"][rows[:, 0]]]
            s = ends[:, 1] - ends[:, 0]
            at_end = stress(ends[np.arange(len(ends)), rows[:, 1]])
            half_normal = np.column_stack([s[:, 1], -s[:, 0]]) / 2
            forces = np.einsum("ri,rij,rj->r", directions, at_end, half_normal)
            self.assertLess(difference(matrix @ x, forces), 1e-11)
        components = len(p["contact_rows"]) // len(p["mu"])
        row, end = p["contact_rows"][::components].T
        np.testing.assert_array_equal(vertices[p["boundary"][row, end]], p["contact_points_mm"])
        np.testing.assert_array_equal(2, p["boundary_roles"][row])

        young, poisson = 210000, 0.3
        corners = X[triangles]
        middles = stress((corners + np.roll(corners, 1, axis=1)) / 2)  # of edges: exact quadrature
        trace = np.einsum("teii->te", middles)[..., None, None] * np.eye(2)
        strain = (1 + poisson) / young * (middles - poisson * trace)
        area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        energy = (area * (middles * strain).sum((2, 3)).mean(1)).sum()
        self.assertLess(abs(x @ (S @ x) / energy - 1), 1e-9)

    def test_fclib_reads_its_files(self) -> None:
        if not READ_FCLIB:
            self.skipTest("no libfclib")
        for name in ("default", "without friction"):
            with self.subTest(name):
                definition = SCENES[name]
                out = self.export("fclib", definition)
                read = subprocess.run([READ_FCLIB, out / "problem.hdf5"], check=True,
                                      capture_output=True, text=True)
                numbers = np.array(read.stdout.split(), float)
                spacedim, m = numbers[:2].astype(int)
                self.assertEqual(2, spacedim)
                W, q, mu, u, r = np.split(numbers[2:], np.cumsum([m * m, m, m // 2, m]))
                W = W.reshape(m, m)
                np.testing.assert_array_equal(W, W.T)
                self.assertLess(abs(np.diag(W).mean() - 1), 1e-14)
                forces = self.hybrid_forces(definition)
                np.testing.assert_array_equal(definition.get("friction", 0.2), mu)
                # With F = -r and r' = -u the law is that of solve_problem.
                found = solve_problem.contact_forces(W, -q, mu).reshape(-1, 2)
                self.assertLess(difference(found, forces), 1e-9)
                self.assertLess(difference(-r.reshape(-1, 2), forces), 1e-9)
                self.assertLess(difference(u, W @ r + q), 1e-14)
                rounding = 1e-12 * np.abs(r).max()
                (r_n, r_t), (u_n, u_t) = r.reshape(-1, 2).T, u.reshape(-1, 2).T
                self.assertGreaterEqual(min(r_n.min(), u_n.min()), -rounding)
                self.assertLessEqual((np.abs(r_t) - mu * r_n).max(), rounding)
                self.assertLessEqual((r_t * u_t).max(), rounding)


if __name__ == "__main__":
    unittest.main()
