"""bench check and new-external from outside: ten mistakes, each planted in a program, found and
named; a right program passes.

    AIRYBENCH_BENCH=PATH /usr/bin/python3 -m unittest FILE
"""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

BENCH = os.environ["AIRYBENCH_BENCH"]
MISTAKEN = Path(__file__).resolve().parent / "mistaken.py"
# Mistake -> the case that is made for it, and what is said there.
MISTAKES = {
    "sign_of_G": ("01_sign_of_G", "the sign of G"),
    "sign_of_gap": ("02_sign_of_gap", "the sign of the gap"),
    "sign_of_tangent": ("03_sign_of_tangent", "the sign of the tangential forces"),
    "units": ("04_units", "units: the gap 1000 times too small (m, not mm)"),
    "order": ("05_order_of_components",
              "the order of the forces: all normal ones, then all tangential ones"),
    "box": ("06_friction_cone", "friction: a box, |F_t| <= mu without F_n"),
    "friction_factor": ("06_friction_cone", "friction: twice mu"),
    "sign_of_mu": ("06_friction_cone", "friction: the sign of mu"),
    "sign_of_mu_of_reactions": ("06_friction_cone", "friction: the sign of mu"),
    "sine": ("06_friction_cone", "friction: the sine of its angle for the tangent"),
    "no_cone": ("06_friction_cone", "friction: without a limit, all closed points stick"),
    "tension": ("07_opening", "points do not open: F_n > 0"),
    "always_two_components": ("08_no_friction", "F_C has one row per point, the normal force"),
    "always_ok": ("09_no_solution", "an answer where there is none"),
    "absolute_tolerance": ("10_tiny_loads", "an absolute tolerance"),
}


class Check(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def bench(self, *arguments: str) -> subprocess.CompletedProcess:
        return subprocess.run([BENCH, *arguments], capture_output=True, text=True, check=False, cwd=self.folder)

    def declare(self, mistake: str) -> None:
        (self.folder / "mine.json").write_text(json.dumps({
            "name": "mine", "reads": "condensed", "format": "npz", "returns": "contact_forces",
            "command": [sys.executable, str(MISTAKEN), mistake, "{input}", "{output}"]}))

    checked: dict[str, subprocess.CompletedProcess] = {}  # mistake -> its run, which several tests read

    def check(self, mistake: str) -> tuple[int, dict[str, str], str]:
        """Exit code, case -> its line, and the whole output."""
        if mistake not in self.checked:
            self.declare(mistake)
            self.checked[mistake] = self.bench("check", "mine.json")
        ran = self.checked[mistake]
        if "this build is without" in ran.stderr:
            self.skipTest(ran.stderr)
        lines = {line.split()[0]: line for line in ran.stdout.splitlines() if line[:1].isdigit()}
        self.assertEqual(len(lines), 10, ran.stdout + ran.stderr)
        return ran.returncode, lines, ran.stdout

    def test_a_right_program_passes(self) -> None:
        code, lines, out = self.check("RIGHT")
        self.assertEqual(code, 0, out)
        for line in lines.values():
            self.assertRegex(line, r"ok +-$")
        self.assertIn("EXTERNAL:mine: 10 of 10 cases passed", out)

    def test_each_mistake_is_found_and_named(self) -> None:
        for mistake, (case, name) in MISTAKES.items():
            with self.subTest(mistake):
                code, lines, out = self.check(mistake)
                self.assertEqual(code, 1, out)
                self.assertIn(name, lines[case], out)
                self.assertNotRegex(lines[case], r" ok +-$")

    def test_mistakes_of_the_equations_are_the_conclusion_too(self) -> None:
        for mistake in ("sign_of_G", "sign_of_gap", "units", "order", "box", "tension", "sign_of_mu",
                        "sign_of_mu_of_reactions"):
            with self.subTest(mistake):
                _, _, out = self.check(mistake)
                self.assertIn(f"all its answers look like: {MISTAKES[mistake][1]}\n", out)

    def test_points_that_never_open_are_the_conclusion_whatever_holds_what_pulls(self) -> None:
        for mistake in ("tension", "tension_slips", "tension_sticks"):
            with self.subTest(mistake):
                _, lines, out = self.check(mistake)
                self.assertIn("points do not open: F_n > 0", lines["07_opening"])
                self.assertIn("all its answers look like: points do not open: F_n > 0\n", out)

    def test_what_ends_early_is_not_said_to_have_another_law(self) -> None:
        _, lines, out = self.check("sweeps=2000")  # right to rounding, also where nothing is
        self.assertEqual([case for case, line in lines.items() if not re.search(r" ok +-$", line)],
                         ["09_no_solution"], out)
        self.assertNotIn("all its answers", out)
        _, lines, out = self.check("sweeps=30")
        self.assertNotIn("something in", out)
        self.assertIn("all its answers look like: an iteration that ends too early", out)

    def test_no_answer_is_no_pass(self) -> None:
        for mistake, said in {"SILENT": "answer.json: there is none in {output}",
                              "LINK": "answer.json: there is none in {output}",
                              "FIFO": "answer.json: there is none in {output}",
                              "LARGE": r"answer.json: 20971\d+ bytes \(allowed: up to 1048576\)",
                              "DEEP": "answer.json"}.items():
            with self.subTest(mistake):
                code, lines, out = self.check(mistake)
                self.assertEqual(code, 1)
                self.assertIn("EXTERNAL:mine: 0 of 10 cases passed\n", out)
                for line in lines.values():
                    self.assertRegex(line, f"breakdown +its answer: {said}")
                self.assertRegex(out, f"all its answers look like: no answer: its answer: {said}")

    def test_the_programs_in_c_plus_plus_are_right(self) -> None:
        for reads in ("condensed", "body"):
            with self.subTest(reads):
                name = f"my-{reads}"
                made = self.bench("new-external", name, "--language=c++", f"--reads={reads}")
                self.assertEqual(made.returncode, 0, made.stderr)
                line = next(line for line in made.stdout.splitlines() if "g++" in line).partition("    (")[0]
                built = subprocess.run(shlex.split(line) + ["-Wall", "-Wextra", "-Werror"], capture_output=True,
                                       text=True, check=False, cwd=self.folder)
                self.assertEqual(built.returncode, 0, built.stderr)
                ran = self.bench("check", f"{name}.json")
                self.assertIn(f"EXTERNAL:{name}: 10 of 10 cases passed", ran.stdout)
        self.assertEqual(self.bench("new-external", "other", "--reads=body").returncode, 2)

    def test_a_mistake_of_friction_that_is_none_of_the_known_is_said_to_be_one(self) -> None:
        _, lines, out = self.check("unlike_any")
        self.assertRegex(lines["08_no_friction"], r" ok +-$")
        self.assertIn("all its answers look like: something in the friction law", out)

    def test_a_new_program_runs_and_passes(self) -> None:
        made = self.bench("new-external", "mine")
        if "this build is without" in made.stderr:
            self.skipTest(made.stderr)
        self.assertEqual(made.returncode, 0, made.stderr)
        checked = self.bench("check", "mine.json")
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        ran = self.bench("--mesh=Mesh0", "--external=mine.json", "--method=EXTERNAL:*",
                         "--repetitions=1", "--out=o")
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)

    def test_a_new_program_refuses_problems_in_space_by_name(self) -> None:
        made = self.bench("new-external", "mine")
        if "this build is without" in made.stderr:
            self.skipTest(made.stderr)
        np.savez(self.folder / "problem.npz", D=np.eye(6), G=np.zeros(6), gap=-np.ones(6), mu=np.ones(2))
        subprocess.run([sys.executable, "mine.py", ".", "."], cwd=self.folder, check=True)
        answer = json.loads((self.folder / "answer.json").read_text(encoding="utf-8"))
        self.assertEqual((answer["status"], answer["message"]),
                         ("breakdown", "3 components per contact point (allowed: 1 or 2, in the plane)"))
        self.assertFalse((self.folder / "F_C.npy").exists())

    def test_what_a_new_program_is_printed_with_finds_its_mistakes(self) -> None:
        made = subprocess.run([BENCH, "new-external", "mine"], capture_output=True, text=True,
                              check=False, cwd=self.folder,
                              env=os.environ | {"AIRYBENCH_CALLED_AS": "./run"})
        if "this build is without" in made.stderr:
            self.skipTest(made.stderr)
        commands = re.findall(r"^  (\./run bench .*?)(?:    .*)?$", made.stdout, re.M)
        self.assertEqual(len(commands), 2, made.stdout)
        program = self.folder / "mine.py"
        right = program.read_text(encoding="utf-8")
        program.write_text(right.replace("-G - gap", "G - gap"), encoding="utf-8")
        for command in commands:
            ran = self.bench(*shlex.split(command)[2:], *([] if " check " in command else ["--out=o"]))
            self.assertEqual(ran.returncode, 1, command + ran.stdout + ran.stderr)

    def test_an_ok_that_does_not_depend_on_the_sign_of_G_says_so(self) -> None:
        said = "G is zero but for rounding: a wrong sign of it would pass here, and fail bench check"
        for mistake in ("RIGHT", "sign_of_G"):
            self.declare(mistake)
            ran = self.bench("--mesh=Mesh0", "--external=mine.json", "--method=EXTERNAL:*",
                             "--repetitions=1", "--out=o")
            if "this build is without" in ran.stderr:
                self.skipTest(ran.stderr)
            self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
            self.assertIn(said, ran.stdout)
        self.declare("RIGHT")
        ran = self.bench("--study=check", "--external=mine.json", "--method=EXTERNAL:*", "--out=o")
        self.assertEqual(ran.returncode, 0)
        self.assertNotIn(said, ran.stdout)

    def test_the_error_is_named_before_what_its_case_is_made_for(self) -> None:
        _, lines, out = self.check("CRASH")
        self.assertRegex(lines["08_no_friction"], r"crashed +mine ended with exit code 3$", out)
        _, lines, out = self.check("always_two_components")
        self.assertRegex(lines["08_no_friction"],
                         r"breakdown +its answer: .* \(F_C has one row per point, the normal force.\)$")

    def test_a_new_program_overwrites_nothing(self) -> None:
        for there in ("mine.py", "mine.json"):
            (self.folder / there).write_text("kept")
            ran = self.bench("new-external", "mine")
            self.assertEqual(ran.returncode, 2, ran.stdout)
            self.assertEqual(ran.stderr, f"bench: {there}: is there already (allowed: a name that "
                                         "is free)\n")
            self.assertEqual([file.name for file in self.folder.iterdir()], [there])
            (self.folder / there).unlink()
        for name in ("a b", "a,b", "x/"):
            ran = self.bench("new-external", name)
            self.assertEqual(ran.returncode, 2, ran.stdout)
            self.assertIn("allowed: letters, digits, '-', '_' and '.'", ran.stderr)
        ran = self.bench("new-external", "none/mine")
        self.assertEqual(ran.returncode, 2)
        self.assertEqual(ran.stderr.count("\n"), 1)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_the_study_runs_our_method_and_the_program(self) -> None:
        self.declare("sign_of_G")
        ran = self.bench("--study=check", "--external=mine.json", "--method=HYBRID,EXTERNAL:*",
                         "--out=o")
        self.assertEqual(ran.returncode, 1)
        lines = (self.folder / "o/records.jsonl").read_text(encoding="utf-8").splitlines()
        records = [json.loads(line) for line in lines]
        ours = [r["status"] for r in records if r["method"] == "HYBRID"]
        self.assertEqual(ours, ["ok"] * 9)
        theirs = {r["scene"]: r["status"] for r in records if r["method"] != "HYBRID"}
        self.assertEqual(theirs["01_sign_of_G"], "inaccurate")

    def test_wrong_use_is_refused(self) -> None:
        self.declare("RIGHT")
        for arguments, said in {("check", "none.json"): "none.json: cannot be opened",
                                ("check", "mine.json", "--mesh=Mesh0"): "not expected: --mesh=Mesh0",
                                }.items():
            ran = self.bench(*arguments)
            self.assertEqual(ran.returncode, 2, ran.stdout)
            self.assertIn(said, ran.stderr)
            self.assertEqual(ran.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
