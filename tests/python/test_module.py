"""The module airybench: problems, solutions, contact problems.  python3 -m unittest FILE"""
import ast
import gc
import inspect
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg

import airybench as ab

SOURCES = Path(ab.__file__).resolve().parent
HELD = {"displacement_mm": [0.01, 0.002], "crown_radius_mm": None}


def resident_bytes() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class ProblemTest(unittest.TestCase):
    def test_what_the_first_page_shows(self) -> None:
        problem = ab.Problem("Mesh0", friction=0.3)
        self.assertEqual((problem.name, problem.scene), ("Mesh0/default", {"friction": 0.3}))
        s = problem.solve("3STEPD")
        self.assertEqual(s.status, "ok")
        self.assertLess(s.error_estimate, 1e-6)
        self.assertEqual({"order", "factor", "condense", "contact", "recover", "check"}, set(s.times_s))
        a = problem.airy_system()
        self.assertEqual(a.S.shape[0], problem.n_phi - 3)
        self.assertEqual(a.C_C.shape[0], s.forces.size)
        k = problem.hybrid_system(degree=2)
        self.assertLess(abs(k.K - k.K.T).max(), 1e-9 * abs(k.K).max())
        c = problem.condensed()
        np.testing.assert_allclose(c.mu, 0.3)
        r = ab.contact.solve(c, "newton")
        self.assertTrue(r.converged)
        np.testing.assert_allclose(r.r, -s.forces, atol=1e-6 * abs(s.forces).max())
        self.assertLess(ab.contact.judge(c, r.r)["natural_map_residual"], 1e-10)
        record = problem.judge(forces=r.r)
        self.assertEqual(record["status"], "ok")
        self.assertLess(record["error_force"], 1e-6)
        self.assertGreater(problem.judge(forces=1.01 * r.r)["error_force"], 1e-3)
        levels = list(problem.adapt(error=0.01, degree="auto"))
        self.assertLessEqual(levels[-1].error, 0.01)
        self.assertEqual(levels[-1].squared_errors.size, len(levels[-1].problem.mesh.triangles))

    def test_the_airy_system_is_that_of_the_stresses(self) -> None:
        problem = ab.Problem("Mesh0", friction=0.3)
        a, s = problem.airy_system(), problem.solve("HYBRID")
        # Its energy is least under the contact forces of another method.
        rows = sparse.vstack([a.C_F, a.C_C])
        forces = np.concatenate([a.F, s.forces - a.F0])
        kkt = sparse.bmat([[a.S, rows.T], [rows, None]], format="csc")
        x = scipy.sparse.linalg.splu(kkt).solve(np.concatenate([a.q, forces]))[:a.S.shape[0]]
        energy = problem.judge(s)["strain_energy_Nmm"]
        self.assertAlmostEqual(x @ (a.S @ x) / 2 / energy, 1, 6)

    def test_arrays_are_views_that_outlive_their_owner(self) -> None:
        a = ab.Problem("Mesh0").airy_system()
        self.assertTrue(np.shares_memory(a.S.data, a.S.data))
        data, total = a.S.data, a.S.data.sum()
        w = ab.Problem("Mesh0").condensed().W
        forces = ab.Problem("Mesh0").solve().forces
        kept = [w.sum(), forces.sum()]
        del a
        gc.collect()
        self.assertEqual([data.sum(), w.sum(), forces.sum()], [total, *kept])
        for array in (data, w, forces):
            with self.assertRaises(ValueError):
                array[0] = 1

    def test_condensed_problems_are_not_copied(self) -> None:
        c = ab.Problem("Mesh0").condensed()
        self.assertTrue(np.shares_memory(c.W, c.W))

    def test_a_thousand_problems_leave_no_memory_behind(self) -> None:
        def make(count: int) -> int:
            for _ in range(count):
                ab.Problem("Mesh0").solve().stresses.sum()
            gc.collect()
            return resident_bytes()
        before = make(100)
        self.assertLess(make(900) - before, 10 << 20)

    def test_stresses_at_points(self) -> None:
        stretched = {"at_mm": [[0, 0], [10, 0]], "values": [[0, 0], [0.01, 0]]}
        problem = ab.Problem("Mesh0", {"mesh": {"keep_contact_edges": 0, "keep_force_edges": 0}, "plane": "stress",
                                       "young_MPa": 1000, "poisson": 0.25,
                                       "boundary": {"displacement": {"displacement_mm": stretched}}})
        s = problem.solve(degree=2)
        sxx, syy, sxy = s.stress(np.array([[1., 5.], [9., 10.]]), 0.5)
        np.testing.assert_allclose(sxx, np.full((2, 2), 1000 * 0.001 / (1 - 0.25**2)), rtol=1e-9)
        np.testing.assert_allclose(syy, 0.25 * sxx, rtol=1e-9)
        np.testing.assert_allclose(sxy, 0, atol=1e-9)
        y = np.linspace(-6, 6, 20001)
        sxx, _, _ = s.stress(5.0, y)
        inside = np.isfinite(sxx)
        self.assertAlmostEqual(abs(y[inside]).max(), 4, 2)  # half the height there
        self.assertTrue(np.isnan(s.stress(11.0, 0.0)[0]))

    def test_paths_have_their_steps(self) -> None:
        steps = [{"displacement_mm": [d, d / 4]} for d in (0.01, 0.02, 0.01)]
        problem = ab.Problem("Mesh0", {"load_steps": steps, "friction": 0.3})
        s = problem.solve()
        self.assertEqual(len(s.steps), 4)  # the scene itself is the first
        self.assertGreater(abs(s.steps[2].forces).max(), abs(s.steps[1].forces).max())
        np.testing.assert_array_equal(s.steps[3].forces, s.forces)
        self.assertEqual(problem.judge(s)["status"], "ok")
        with self.assertRaisesRegex(ab.InputError, "whole path"):
            problem.judge(s.steps[0])

    def test_answers_and_faces(self) -> None:
        s = ab.Problem("Mesh0").solve(degree=2)
        faces = s.pressure()
        answer = s.answer()["faces"][0]
        self.assertEqual(list(faces.columns), ["face", "along_mm", "x_mm", "y_mm", "pressure_MPa",
                                               "shear_MPa", "gap_mm", "slip_mm", "state"])
        self.assertAlmostEqual(answer["normal_N"], s.forces[::2].sum(), 6)
        self.assertEqual(s.plot().axes[0].get_xlabel()[:5], "x, mm")

    def test_modules_of_a_script_may_have_the_names_of_ours(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for name in ("command", "fields", "records"):
                Path(folder, f"{name}.py").write_text("mine = True\n", encoding="utf-8")
            script = """if 1:
                import sys, records, airybench as ab
                s = ab.Problem("Mesh0").solve()
                print(s.plot() is not s.plot())
                import fields
                print(fields.mine, records.mine, "gallery" in sys.modules)
            """
            environment = {**os.environ, "PYTHONPATH": str(Path(ab.__file__).absolute().parents[1])}
            said = subprocess.run([sys.executable, "-c", script], cwd=folder, env=environment, check=True,
                                  stdout=subprocess.PIPE, text=True).stdout
            self.assertEqual(said, "True\nTrue True False\n")

    def test_what_is_wrong_is_said_in_one_line(self) -> None:
        problem = ab.Problem("Mesh0")
        c = problem.condensed()
        other = ab.Problem("Mesh0").solve()
        for call, words in ((lambda: ab.Problem("Mesh9"), "Mesh9.*Mesh0..Mesh7"),
                            (lambda: ab.Problem("Mesh0..Mesh2"), "3 meshes"),
                            (lambda: ab.Problem("Mesh0", frict=1), "frict: unknown key"),
                            (lambda: ab.Problem("Mesh0", friction=-1), "friction"),
                            (lambda: ab.Problem("Mesh0", "absent.json"), "absent.json"),
                            (lambda: problem.solve("NONE"), "NONE"),
                            (lambda: problem.solve("3STEP*"), "methods"),
                            (lambda: problem.solve(tol=1), "tol: no such setting"),
                            (lambda: problem.solve(threads=0), "threads: 0"),
                            (lambda: problem.adapt(error=0.1, threads=-1), "threads: -1"),
                            (lambda: problem.adapt(error=0.1, marking=2), "marking: 2"),
                            (lambda: problem.solve(contact="newtn"), "newtn.*newton"),
                            (lambda: problem.judge(), "solution or forces"),
                            (lambda: problem.judge(other), "another problem"),
                            (lambda: problem.judge(forces=np.ones(3)), "forces: 3 numbers"),
                            (lambda: problem.adapt(error=2), "error"),
                            (lambda: problem.adapt(error=0.1, degree="most"), "most"),
                            (lambda: ab.contact.Problem(np.eye(4), np.ones(3), 0.1), r"W: \(4, 4\)"),
                            (lambda: ab.contact.Problem(np.eye(4), np.ones(4), -0.1), "mu"),
                            (lambda: ab.contact.solve(c, "nwton"), "nwton"),
                            (lambda: ab.contact.judge(c, np.ones(3)), "r: 3 numbers"),
                            (lambda: ab.contact.judge(c, np.full(c.q.size, np.nan)), "r: not finite"),
                            (lambda: ab.contact.Problem(np.eye(4), np.ones(4), 0.1, components=0), "components: 0"),
                            (lambda: ab.contact.Problem(np.eye(4), np.ones(4), [[0.1]]), "mu: 2 axes"),
                            (lambda: ab.contact.Problem(np.eye(4), None, 0.1), "q: None"),
                            (lambda: ab.contact.Problem(np.ones(4), np.ones(4), 0.1), "W: 1 axes"),
                            (lambda: ab.contact.solve(c, tolerance=0), "tolerance: 0"),
                            (lambda: ab.contact.read("absent.hdf5"), "absent.hdf5"),
                            (lambda: ab.read("absent"), "absent"),
                            (lambda: ab.bench(mesh="Mesh0", nonsense=1), "nonsense"),
                            (lambda: ab.method("3STEPD")(len), "3STEPD")):
            with self.subTest(words), self.assertRaisesRegex(ab.InputError, words) as raised:
                call()
            self.assertNotIn("\n", str(raised.exception))
        with self.assertRaisesRegex(AttributeError, "no array T.*vertices_mm"):
            problem.mesh.T

    def test_notes_are_warnings(self) -> None:
        block = Path(ab._airybench._data_folder("scenes/check"), "block.msh")
        with self.assertWarnsRegex(UserWarning, "no wall"):
            ab.Problem(block, displacement_mm=[0, -0.001])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaisesRegex(UserWarning, "no wall"):
                ab.Problem(block, displacement_mm=[0, -0.001])

    def test_threads_pose_problems_one_after_the_other(self) -> None:
        with ThreadPoolExecutor(4) as pool:
            names = [repr(problem) for problem in pool.map(ab.Problem, [f"Mesh{k % 4}" for k in range(16)])]
        self.assertEqual(len(set(names)), 4)

    def test_timers_of_the_caller_go_on(self) -> None:
        former = signal.signal(signal.SIGALRM, lambda *_: None)
        try:
            signal.setitimer(signal.ITIMER_REAL, 1000)
            ab.Problem("Mesh0")
            self.assertGreater(signal.setitimer(signal.ITIMER_REAL, 0)[0], 900)
            self.assertTrue(callable(signal.getsignal(signal.SIGALRM)))
        finally:
            signal.signal(signal.SIGALRM, former)

    def test_a_failed_search_for_parameters_is_a_solution(self) -> None:
        solution = ab.Problem("Mesh0").solve("ALM", timeout=1e-6)
        self.assertEqual(solution.status, "timeout")
        self.assertIn("while choosing parameters", solution.message)

    def test_ctrl_c_ends_a_solve(self) -> None:
        script = """if 1:
            import sys, airybench as ab
            problem = ab.Problem("Mesh7")
            try:
                print("solving", flush=True)
                while True:
                    problem.solve("SYMMLQ:NONE", timeout=1e6, tolerance=1e-300, max_iterations=10**9)
            except KeyboardInterrupt:
                print("interrupted")
            # All is as before.
            print(ab.Problem("Mesh0").solve().status)
        """
        with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True) as ran:
            self.assertEqual(ran.stdout.readline(), "solving\n")
            time.sleep(0.5)  # so that it is most likely in C++
            ran.send_signal(signal.SIGINT)
            self.assertEqual(ran.communicate()[0], "interrupted\nok\n")


class ContactTest(unittest.TestCase):
    def test_plain_arrays(self) -> None:
        rng = np.random.default_rng(1)
        for components in (1, 2, 3):
            n = 4 * components
            m = rng.normal(size=(n, n))
            w = m @ m.T + n * np.eye(n)
            q = rng.normal(size=n)
            for given in (w, sparse.csr_matrix(w)):
                c = ab.contact.Problem(given, q, mu=np.full(4, 0.4))
                self.assertEqual((len(c), c.components), (4, components))
                np.testing.assert_array_equal(c.q, q)
                found = [ab.contact.solve(c, s).r for s in ("newton", "gauss-seidel", "admm", "anderson")]
                for r in found:
                    np.testing.assert_allclose(r, found[0], atol=1e-9 * abs(found[0]).max() + 1e-12)
                u = w @ found[0] + q
                self.assertTrue((found[0][::components] >= 0).all())
                np.testing.assert_allclose(ab.contact.solve(c).u, u, atol=1e-9)
                self.assertLess(ab.contact.judge(c, found[0])["natural_map_residual"], 1e-10)

    def test_an_indefinite_matrix_ends(self) -> None:
        w = np.eye(8) - 0.9 * (np.ones((8, 8)) - np.eye(8))
        c = ab.contact.Problem(w, np.array([-.4, .2, .3, .1, -.6, .5, -.2, .4]), 0.3)
        self.assertFalse(ab.contact.solve(c, "newton").converged)

    def test_a_file_is_read_again(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "bodies.hdf5")
            file.write_bytes((Path(__file__).resolve().parents[1] / "data/fuzz/fclib/good-global").read_bytes())
            first, second = ab.contact.read(file), ab.contact.read(file)
        np.testing.assert_array_equal(first.q, second.q)

    def test_a_start_is_taken(self) -> None:
        c = ab.Problem("Mesh1", friction=0.3).condensed()
        first = ab.contact.solve(c, "gauss-seidel")
        self.assertLess(ab.contact.solve(c, "gauss-seidel", start=first.r).iterations, first.iterations)


class DocumentationTest(unittest.TestCase):
    def members(self, file: str) -> dict[str, set[str]]:
        tree = ast.parse((SOURCES / file).read_text(encoding="utf-8"))
        found = {"": {n.name for n in tree.body if isinstance(n, (ast.FunctionDef, ast.ClassDef))}}
        for node in tree.body:
            if isinstance(node, ast.ClassDef):
                found[node.name] = {getattr(n, "name", None) or n.target.id for n in node.body
                                    if isinstance(n, (ast.FunctionDef, ast.AnnAssign))}
        return found

    def test_stubs_are_the_module(self) -> None:
        for module, file in ((ab, "__init__.pyi"), (ab.contact, "contact.pyi")):
            stub = self.members(file)
            public = {name for name in getattr(module, "__all__", dir(module)) if not name.startswith("_")}
            self.assertEqual(stub.pop(""), public - {"contact"})
            for name, members in stub.items():
                there = {m for m in vars(getattr(module, name)) if not m.startswith("_")}
                self.assertEqual({m for m in members if not m.startswith("_")}, there, name)

    def test_everything_is_documented(self) -> None:
        for module in (ab, ab.contact):
            for name in getattr(module, "__all__", dir(module)):
                if name.startswith("_"):
                    continue
                with self.subTest(name):
                    self.assertTrue(inspect.getdoc(getattr(module, name)))
                    of_class = vars(getattr(module, name)) if inspect.isclass(getattr(module, name)) else {}
                    for member, value in of_class.items():
                        if inspect.isroutine(value) and not member.startswith("_"):
                            self.assertRegex(inspect.getdoc(value), re.compile("[a-z]{4}"), member)
