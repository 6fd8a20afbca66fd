"""Methods written in Python, and runs of bench from it.  python3 -m unittest FILE"""
import ctypes
import os
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg

import airybench as ab

DATA = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "data")


@ab.method("MINE")
def mine(c):
    """Our own Gauss-Seidel."""
    return ab.contact.solve(c, "gauss-seidel").r


@ab.method("WRONG")
def wrong(c):
    return 1.001 * ab.contact.solve(c).r


@ab.method("RAISES")
def raises(c):
    raise KeyError("no such contact")


@ab.method("SHORT")
def short(c):
    return np.zeros(2)


@ab.method("ENDS")
def ends(c):
    os._exit(7)


@ab.method("SEGFAULT")
def segfault(c):
    ctypes.string_at(0)


@ab.method("AIRY", reads="airy")
def airy(a):
    kkt = sparse.bmat([[a.S, a.C_F.T], [a.C_F, None]], format="csc")
    return scipy.sparse.linalg.splu(kkt).solve(np.concatenate([a.q, a.F]))[:a.S.shape[0]]


@ab.method("LINEAR", reads="body")
def linear(body):
    """Of a body held everywhere: the displacement of its boundary, which is linear in x and y."""
    start = body.vertices_mm[body.boundary[:, 0]]
    given = body.u0_mm[:, :2]
    plane = np.linalg.lstsq(np.column_stack([np.ones(len(start)), start]), given, rcond=None)[0]
    middles = body.vertices_mm[body.edges].mean(axis=1)
    points = np.concatenate([body.vertices_mm, middles])
    return np.column_stack([np.ones(len(points)), points]) @ plane


def linear_elements(body):
    """Of a body with a body force and held edges, linear triangles; at middles the mean of the ends."""
    x, count = body.vertices_mm, len(body.vertices_mm)
    stiffness, load = sparse.lil_matrix((2 * count, 2 * count)), np.zeros(2 * count)
    for nodes, which in zip(body.triangles, body.triangle_body):
        d = np.linalg.inv(np.column_stack([np.ones(3), x[nodes]]))[1:]
        area = abs(np.linalg.det(np.column_stack([np.ones(3), x[nodes]]))) / 2
        b = np.zeros((3, 6))
        b[0, ::2], b[1, 1::2], b[2, ::2], b[2, 1::2] = d[0], d[1], d[1], d[0]
        rows = np.stack([2 * nodes, 2 * nodes + 1], axis=1).ravel()
        stiffness[np.ix_(rows, rows)] += area * b.T @ np.linalg.inv(
            body.compliance_per_MPa[which].reshape(3, 3)) @ b
        load[rows] += np.tile(body.body_force_N_per_mm3, 3) * area / 3
    held = np.unique(body.boundary[body.boundary_roles == 0])
    free = np.setdiff1d(np.arange(2 * count), np.concatenate([2 * held, 2 * held + 1]))
    u = np.zeros(2 * count)
    u[free] = scipy.sparse.linalg.spsolve(stiffness.tocsc()[np.ix_(free, free)], load[free])
    u = u.reshape(-1, 2)
    return np.concatenate([u, u[body.edges].mean(axis=1)])


class MethodTest(unittest.TestCase):
    def test_a_contact_law(self) -> None:
        problem = ab.Problem("Mesh1", friction=0.3)
        s = problem.solve(mine)
        self.assertEqual((mine.name, mine.summary, s.method), ("MINE", "Our own Gauss-Seidel.", "MINE"))
        np.testing.assert_allclose(s.forces, problem.solve().forces, atol=1e-6 * abs(s.forces).max())
        self.assertEqual(problem.judge(s)["status"], "ok")
        self.assertEqual(problem.judge(problem.solve(wrong))["status"], "inaccurate")

    def test_on_a_path_each_step_is_its(self) -> None:
        steps = [{"displacement_mm": [d, d / 4]} for d in (0.01, 0.02, 0.01)]
        problem = ab.Problem("Mesh0", {"load_steps": steps, "friction": 0.3})
        self.assertEqual(problem.judge(problem.solve(mine))["status"], "ok")
        self.assertEqual(problem.judge(problem.solve(wrong))["status"], "inaccurate")

    def test_the_airy_system(self) -> None:
        problem = ab.Problem("Mesh0", {"mesh": {"keep_contact_edges": 0}, "body_force_N_per_mm3": [0, -0.01]})
        record = problem.judge(problem.solve(airy))
        self.assertEqual(record["status"], "ok")
        self.assertLess(record["error_stress"], 1e-6)

    def test_a_displacement(self) -> None:
        stretched = {"at_mm": [[0, 0], [10, 0]], "values": [[0, 0], [0.01, 0.002]]}
        problem = ab.Problem("Mesh0", {"mesh": {"keep_contact_edges": 0, "keep_force_edges": 0},
                                       "boundary": {"displacement": {"displacement_mm": stretched}}})
        record = problem.judge(problem.solve(linear))
        self.assertEqual(record["status"], "ok")
        self.assertLess(record["error_total"], 1e-9)

    def test_other_elements_are_judged_by_their_total_error_alone(self) -> None:
        problem = ab.Problem("Mesh1", {"mesh": {"keep_contact_edges": 0}, "body_force_N_per_mm3": [0, -0.01],
                                       "displacement_mm": [0, 0]})
        found = [problem.judge(problem.solve(ab.method("P1", reads="body", elements=elements)(linear_elements)))
                 for elements in ("P2", "other")]
        self.assertEqual([record["status"] for record in found], ["inaccurate", "ok"])
        self.assertIn("total error alone", found[1]["status_reason"])
        quadratic = problem.judge(problem.solve("P2"))["error_total"]
        self.assertGreater(found[1]["error_total"], 2 * quadratic)
        self.assertLess(found[1]["error_total"], 0.5)

    def test_what_a_callable_raises_is_raised(self) -> None:
        problem = ab.Problem("Mesh0")
        with self.assertRaisesRegex(KeyError, "no such contact"):
            problem.solve(raises)
        with self.assertRaisesRegex(ab.InputError, "r: 2 numbers"):
            problem.solve(short)
        for returned, words in ((None, "r: None"), ([[1.0]], "r: 2 axes"), ("text", "r: could not convert")):
            with self.subTest(words), self.assertRaisesRegex(ab.InputError, words):
                problem.solve(ab.method("ODD")(lambda c, value=returned: value))
        with self.assertRaisesRegex(ab.InputError, r"u: \(3, 2\)"):
            problem.solve(ab.method("FEW", reads="body")(lambda body: np.zeros((3, 2))))
        self.assertEqual(problem.solve().status, "ok")

    def test_a_degree_is_honoured_or_refused(self) -> None:
        problem = ab.Problem("Mesh0")
        self.assertEqual(problem.solve(ab.method("TWO", degree=2)(lambda c: ab.contact.solve(c).r)).degree, 2)
        for method in (mine, "3STEPD", "P3"):
            with self.assertRaisesRegex(ab.InputError, "degree: 4"):
                problem.solve(method, degree=4)
        with self.assertRaisesRegex(ab.InputError, "degree"):
            ab.method("AIRY2", reads="airy", degree=2)(len)


class BenchTest(unittest.TestCase):
    def test_each_case_is_a_record(self) -> None:
        with tempfile.TemporaryDirectory() as out:
            table = ab.bench(mesh=["Mesh0", "Mesh1"], methods=["HYBRID", mine, wrong, raises, ends, segfault],
                             out=out, repetitions=2)
            again = ab.read(out)
        self.assertEqual(len(table), 12)
        self.assertEqual(table.case_name.tolist(), again.case_name.tolist())
        status = dict(zip(table.case_name, table.status))
        reason = dict(zip(table.case_name, table.status_reason))
        expected = {"HYBRID": "ok", "MINE": "ok", "WRONG": "inaccurate", "RAISES": "crashed", "ENDS": "crashed",
                    "SEGFAULT": "crashed"}
        self.assertEqual(status, {f"{mesh}/default/{method}": end for mesh in ("Mesh0", "Mesh1")
                                  for method, end in expected.items()})
        self.assertIn("KeyError: 'no such contact'", reason["Mesh0/default/RAISES"])
        self.assertIn("SIGSEGV", reason["Mesh0/default/SEGFAULT"])
        ok = table[table.status == "ok"]
        self.assertTrue((ok.time_s > 0).all() and (ok.peak_rss_bytes > 0).all())
        self.assertTrue((ok.error_force < 1e-6).all())

    def test_options_are_those_of_bench(self) -> None:
        with tempfile.TemporaryDirectory() as out:
            table = ab.bench("Mesh0", "HYBRID", out=out, adapt="5%", degree=2, repetitions=1, fields=True)
            self.assertLessEqual(table.error_total.min(), 0.05)
            with self.assertRaisesRegex(ab.InputError, "memory_limit"):
                ab.bench("Mesh0", "HYBRID", out=out, memory_limit=100)
            with self.assertRaisesRegex(ab.InputError, "dry_run"):
                ab.bench("Mesh0", "HYBRID", out=out, dry_run=True)
            with self.assertRaisesRegex(ab.InputError, "every name once"):
                ab.bench("Mesh0", [mine, "MINE"], out=out)

    def test_ctrl_c_ends_a_run(self) -> None:
        with tempfile.TemporaryDirectory() as out:
            script = f"""if 1:
                import airybench as ab
                try:
                    ab.bench(["Mesh0", "Mesh4"], ["HYBRID", "SYMMLQ:NONE"], out={out!r}, timeout=1000)
                except KeyboardInterrupt:
                    print("interrupted")
            """
            with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  text=True) as ran:
                for line in ran.stderr:
                    if "HYBRID" in line:
                        break
                ran.send_signal(signal.SIGINT)
                out_text, err_text = ran.communicate()
                self.assertEqual(out_text, "interrupted\n", err_text)
            self.assertEqual(set(ab.read(out).status), {"ok"})

    def test_contact_problems_of_files(self) -> None:
        with tempfile.TemporaryDirectory() as out:
            file = os.path.join(DATA, "fuzz/fclib/good-global")
            problem = os.path.join(out, "bodies.hdf5")
            with open(file, "rb") as given, open(problem, "wb") as copy:
                copy.write(given.read())
            table = ab.bench(problem=problem, methods=[mine], out=os.path.join(out, "out"), repetitions=1)
            self.assertEqual(table.method.tolist(), ["MINE"])
            self.assertEqual(table.status.tolist(), ["ok"])
