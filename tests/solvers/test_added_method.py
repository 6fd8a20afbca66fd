"""A program to whose table one line and one file were added knows the method everywhere.

    AIRYBENCH_BENCH=PATH /usr/bin/python3 -m unittest FILE
"""
import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
NAME = "3STEPD:SIMPLICIAL"


class AddedMethod(unittest.TestCase):
    def run_program(self, *command: object) -> str:
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        return done.stdout

    def test_it_is_listed_run_recorded_and_drawn(self) -> None:
        bench = os.environ["AIRYBENCH_BENCH"]
        self.assertIn(NAME, self.run_program(bench, "list"))
        with tempfile.TemporaryDirectory() as folder:
            self.run_program(bench, "--mesh=Mesh0,Mesh1", "--method=3STEPD*", "--repetitions=1", f"--out={folder}")
            with open(Path(folder, "results.csv"), encoding="utf-8") as file:
                rows = [row for row in csv.DictReader(file) if row["method"] == NAME]
            self.assertEqual([("ok", "3STEPD")] * 2, [(row["status"], row["family"]) for row in rows])
            drawn = self.run_program(sys.executable, PROJECT / "plots/figures.py", folder)
            self.assertIn("figure", drawn)
            words = "".join(file.read_text(encoding="utf-8") for file in Path(folder, "figures").glob("*.csv"))
            self.assertIn(NAME, words)
