"""hybrid-petsc on several ranks: one answer, few iterations, and no process left whatever ends it.

    AIRYBENCH_BENCH=PATH /usr/bin/python3 test_petsc.py    exit 77: cannot run here
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

PROJECT = Path(__file__).resolve().parents[2]
PEER = PROJECT / "peers" / "petsc"
PROGRAM = PROJECT / "build" / "peers" / "hybrid_petsc"
BENCH = os.environ["AIRYBENCH_BENCH"]


def read_forces(folder: Path) -> np.ndarray:
    return np.loadtxt(folder / "F_C.mtx", skiprows=2)


def ranks_of(folder: Path) -> list[int]:
    """Processes of the program that work on this folder."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes().decode().split("\0")
        except OSError:
            continue
        if Path(words[0]).name == "hybrid_petsc" and any(word.startswith(str(folder)) for word in words):
            found.append(int(process.name))
    return found


class PetscTest(unittest.TestCase):
    def setUp(self) -> None:
        if not PROGRAM.exists():
            self.skipTest(f"{PROGRAM} (./run peers)")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_bench(self, definition: dict, mesh: str, *words: str, peer: dict | None = None) -> list[dict]:
        """Records of HYBRID and of the peer."""
        declaration = json.loads((PEER / "hybrid-petsc.json").read_text(encoding="utf-8")) | (peer or {})
        declaration["command"] = [str((PEER / word).resolve()) if word.startswith(("./", "../")) or word.endswith(".options")
                                  else word for word in declaration["command"]]
        declaration["version"] = [str(PROGRAM), "--version"]
        (self.folder / "peer.json").write_text(json.dumps(declaration), encoding="utf-8")
        scene, out = self.folder / "scene.json", Path(tempfile.mkdtemp(dir=self.folder))
        scene.write_text(json.dumps(definition), encoding="utf-8")
        command = [BENCH, f"--mesh={mesh}", f"--scene={scene}", "--method=HYBRID,EXTERNAL:*", "--repetitions=1",
                   f"--external={self.folder / 'peer.json'}", f"--out={out}", *words]
        self.bench = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                      env=os.environ | {"TMPDIR": str(self.folder)})
        self.addCleanup(self.bench.kill)
        self.out = out
        return self.records() if peer is None else []

    def records(self) -> list[dict]:
        self.bench.wait()
        lines = (self.out / "records.jsonl").read_text(encoding="utf-8").splitlines()
        return sorted((json.loads(line) for line in lines), key=lambda r: r["method"] != "HYBRID")

    def export(self, definition: dict, mesh: str = "Mesh3") -> Path:
        """The files that the peer is handed."""
        kept = self.folder / f"input{len(list(self.folder.iterdir()))}"
        copier = self.folder / "copier.json"
        copier.write_text(json.dumps({
            "name": "copier", "reads": "body", "format": "npz", "returns": "edge_displacements",
            "command": ["cp", "-r", "{input}", str(kept)]}), encoding="utf-8")
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps(definition), encoding="utf-8")
        subprocess.run([BENCH, f"--mesh={mesh}", f"--scene={scene}", "--method=EXTERNAL:*", "--repetitions=1",
                        f"--external={copier}", f"--out={self.folder / 'copies'}"], check=False, capture_output=True)
        return kept

    def solve(self, problem: Path, ranks: int, options: str = "two-level-gamg", tolerance: str = "1e-11") -> tuple[Path, dict]:
        out = Path(tempfile.mkdtemp(dir=self.folder))
        ran = subprocess.run([PEER / "over_ranks.sh", str(ranks), out, PROGRAM, problem, out, tolerance,
                              "-options_file", PEER / f"{options}.options"],
                             capture_output=True, text=True, check=False)
        self.assertEqual(0, ran.returncode, ran.stderr)
        return out, json.loads((out / "answer.json").read_text(encoding="utf-8"))

    def test_one_two_and_four_ranks_answer_the_same(self) -> None:
        for definition in ({}, {"friction": 0}, {"friction": 0.8, "body_force_N_per_mm3": [0.1, 0]}):
            with self.subTest(definition):
                problem = self.export(definition)
                answers = []
                for ranks in (1, 2, 4):
                    folder, said = self.solve(problem, ranks)
                    self.assertEqual("ok", said["status"])
                    answers.append((np.load(folder / "edge_displacements_mm.npy"), read_forces(folder)))
                for u, F in answers[1:]:
                    self.assertLess(np.linalg.norm(u - answers[0][0]), 1e-9 * np.linalg.norm(u))
                    self.assertLess(np.linalg.norm(F - answers[0][1]), 1e-9 * np.linalg.norm(F))

    def test_it_agrees_with_hybrid(self) -> None:
        scenes = ({}, {"friction": 0}, {"friction": 1.0, "displacement_mm": [0.015, 0.02]},
                  {"mesh": {"keep_contact_edges": 0}, "boundary": {"force": {"pressure_MPa": 3}}},
                  {"mesh": {"keep_force_edges": 6}, "displacement_mm": [0.01, 0],
                   "boundary": {"force": {"pressure_MPa": 3}, "displacement": {"support": "normal"}}})
        for mesh in ("Mesh0", "Mesh3"):
            for definition in scenes:
                with self.subTest(mesh=mesh, scene=definition):
                    _, petsc = self.run_bench(definition, mesh, "--threads=2")
                    self.assertEqual("ok", petsc["status"], petsc["status_reason"])
                    self.assertLess(petsc["error_stress"], 1e-6)
                    logs = [log.read_text(encoding="utf-8") for log in (self.out / "programs").iterdir()]
                    self.assertEqual(1, len(logs))
                    self.assertIn("MatMult", logs[0])

    def test_iterations_near_incompressibility(self) -> None:
        for poisson in (0.3, 0.49, 0.4999):
            with self.subTest(poisson):  # a linear system: without contact
                problem = self.export({"poisson": poisson, "friction": 0, "mesh": {"keep_contact_edges": 0},
                                       "boundary": {"force": {"pressure_MPa": 3}}})
                _, said = self.solve(problem, 2, tolerance="1e-10")
                self.assertEqual("ok", said["status"])
                most = int(said["parameters"].split("at most ")[1].split()[0])
                self.assertLess(most, 65)

    def test_a_killed_rank_is_a_record(self) -> None:
        self.run_bench({}, "Mesh3+refine2", "--threads=2", peer={})
        self.bench_is_at_work()
        os.kill(ranks_of(self.folder)[-1], signal.SIGKILL)
        (record,) = [r for r in self.records() if r["method"] != "HYBRID"]
        self.assertEqual("crashed", record["status"])
        self.assertIn("hybrid-petsc ended with exit code 137", record["status_reason"])
        self.nothing_is_left()

    def test_when_the_bench_is_killed_so_are_the_ranks(self) -> None:
        self.run_bench({}, "Mesh3+refine2", "--threads=2", peer={})
        self.bench_is_at_work()
        self.bench.kill()
        self.bench.wait()
        self.nothing_is_left()

    def test_the_memory_of_all_ranks_has_a_limit(self) -> None:
        _, petsc = self.run_bench({}, "Mesh3", "--threads=2", "--memory-limit=50")
        self.assertEqual("out_of_memory", petsc["status"], petsc["status_reason"])
        self.nothing_is_left()

    def test_wrong_input_is_one_line(self) -> None:
        problem = self.export({}, "Mesh0")
        for words, line in (([problem, problem, "two"], "hybrid-petsc: TOLERANCE: two (allowed: a number in (0, 1))"),
                            (["/none", problem, "1e-9"], "hybrid-petsc: /none/problem.npz: cannot be read")):
            ran = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
            self.assertEqual((3, line), (ran.returncode, ran.stderr.strip().split("\n")[0]))

    def bench_is_at_work(self) -> None:
        for _ in range(6000):
            if len(ranks_of(self.folder)) == 2 or self.bench.poll() is not None:
                break
            time.sleep(0.01)
        self.assertIsNone(self.bench.poll())

    def nothing_is_left(self) -> None:
        for _ in range(1000):
            if not ranks_of(self.folder):
                break
            time.sleep(0.01)
        self.assertEqual([], ranks_of(self.folder))


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    all_skipped = len(result.skipped) == result.testsRun
    sys.exit(77 if all_skipped else not result.wasSuccessful())
