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
sys.path.append(str(PROJECT / "tests/support"))
from exporting import BENCH, ExportingTest, difference  # noqa: E402

PEER = PROJECT / "peers" / "petsc"
PROGRAM = PROJECT / "build" / "peers" / "hybrid_petsc"


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


class PetscTest(ExportingTest):
    def setUp(self) -> None:
        if not PROGRAM.exists():
            self.skipTest(f"{PROGRAM} (./run peers)")
        super().setUp()

    def start_bench(self, definition: dict, mesh: str, *words: str) -> None:
        self.out = Path(tempfile.mkdtemp(dir=self.folder))
        command = [BENCH, f"--mesh={mesh}", f"--scene={self.scene(definition)}", "--method=HYBRID,EXTERNAL:*", "--threads=2",
                   "--repetitions=1", f"--external={PEER / 'hybrid-petsc.json'}", f"--out={self.out}", *words]
        self.bench = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                      env=os.environ | {"TMPDIR": str(self.folder)})
        self.addCleanup(self.bench.kill)

    def record(self) -> dict:
        """The peer's, when bench has ended."""
        self.bench.wait()
        lines = (self.out / "records.jsonl").read_text(encoding="utf-8").splitlines()
        (record,) = (r for r in map(json.loads, lines) if r["method"] != "HYBRID")
        return record

    def solve(self, problem: Path, ranks: int, tolerance: str = "1e-11") -> tuple[Path, dict]:
        out = Path(tempfile.mkdtemp(dir=self.folder))
        ran = subprocess.run([PEER / "over_ranks.sh", str(ranks), out, PROGRAM, problem, out, tolerance,
                              "-options_file", PEER / "two-level-gamg.options"],
                             capture_output=True, text=True, check=False)
        self.assertEqual(0, ran.returncode, ran.stderr)
        return out, json.loads((out / "answer.json").read_text(encoding="utf-8"))

    def test_one_two_and_four_ranks_answer_the_same(self) -> None:
        for definition in ({}, {"friction": 0}, {"friction": 0.8, "body_force_N_per_mm3": [0.1, 0]}):
            with self.subTest(definition):
                problem = self.export("npz", definition, "Mesh3")
                answers = []
                for ranks in (1, 2, 4):
                    folder, said = self.solve(problem, ranks)
                    self.assertEqual("ok", said["status"])
                    answers.append((np.load(folder / "edge_displacements_mm.npy"),
                                    np.loadtxt(folder / "F_C.mtx", skiprows=2)))
                for answer in answers[1:]:
                    for found, expected in zip(answer, answers[0]):
                        self.assertLess(difference(found, expected), 1e-9)

    def test_it_agrees_with_hybrid(self) -> None:
        scenes = ({}, {"friction": 0}, {"friction": 1.0, "displacement_mm": [0.015, 0.02]},
                  {"mesh": {"keep_contact_edges": 0}, "boundary": {"force": {"pressure_MPa": 3}}},
                  {"mesh": {"keep_force_edges": 6}, "displacement_mm": [0.01, 0],
                   "boundary": {"force": {"pressure_MPa": 3}, "displacement": {"support": "normal"}}})
        for mesh in ("Mesh0", "Mesh3"):
            for definition in scenes:
                with self.subTest(mesh=mesh, scene=definition):
                    self.start_bench(definition, mesh)
                    petsc = self.record()
                    self.assertEqual("ok", petsc["status"], petsc["status_reason"])
                    self.assertLess(petsc["error_stress"], 1e-6)
                    logs = [log.read_text(encoding="utf-8") for log in (self.out / "programs").iterdir()]
                    self.assertEqual(1, len(logs))
                    self.assertIn("MatMult", logs[0])

    def test_iterations_near_incompressibility(self) -> None:
        for poisson in (0.3, 0.49, 0.4999):
            with self.subTest(poisson):  # a linear system: without contact
                problem = self.export("npz", {"poisson": poisson, "friction": 0, "mesh": {"keep_contact_edges": 0},
                                              "boundary": {"force": {"pressure_MPa": 3}}}, "Mesh3")
                _, said = self.solve(problem, 2, tolerance="1e-10")
                self.assertEqual("ok", said["status"])
                most = int(said["parameters"].split("at most ")[1].split()[0])
                self.assertLess(most, 65)

    def test_a_killed_rank_is_a_record(self) -> None:
        self.start_bench({}, "Mesh3+refine2")
        self.bench_is_at_work()
        os.kill(ranks_of(self.folder)[-1], signal.SIGKILL)
        record = self.record()
        self.assertEqual("crashed", record["status"])
        self.assertIn("hybrid-petsc ended with exit code 137", record["status_reason"])
        self.nothing_is_left()

    def test_when_the_bench_is_killed_so_are_the_ranks(self) -> None:
        self.start_bench({}, "Mesh3+refine2")
        self.bench_is_at_work()
        self.bench.kill()
        self.bench.wait()
        self.nothing_is_left()

    def test_the_memory_of_all_ranks_has_a_limit(self) -> None:
        self.start_bench({}, "Mesh3", "--memory-limit=50")
        petsc = self.record()
        self.assertEqual("out_of_memory", petsc["status"], petsc["status_reason"])
        self.nothing_is_left()

    def test_wrong_input_is_one_line(self) -> None:
        problem = self.export("npz", {})
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
