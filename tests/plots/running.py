"""Runs the programs of plots/, and has a folder for what they read and write."""
import contextlib
import io
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import ModuleType
from unittest import mock

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "plots"))


def run(program: ModuleType, *arguments: object) -> tuple[int, str, str]:
    """Exit status, stdout, stderr. In this process: to start another takes longer than to draw."""
    out, err, status = io.StringIO(), io.StringIO(), 0
    with mock.patch.object(sys, "argv", [program.__file__, *map(str, arguments)]), \
            contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            program.main()
        except SystemExit as end:
            status = end.code
    return status, out.getvalue(), err.getvalue()


def run_command(program: ModuleType, *arguments: object) -> tuple[int, str, str]:
    """The same in a process of its own."""
    done = subprocess.run([sys.executable, program.__file__, *map(str, arguments)],
                          capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def names_in(folder: Path) -> set[str]:
    """Of the files, without the list of what programs made."""
    return {path.name for path in folder.iterdir()} - {".airybench.made"}


class FolderTest(unittest.TestCase):
    """With a results folder that is there for one test, and a program that reads it."""

    program: ModuleType

    def setUp(self) -> None:
        self.results = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.results)
        self.csv, self.lines = self.results / "results.csv", self.results / "records.jsonl"
        self.figures = self.results / "figures"

    def assert_refused(self, *parts: str, arguments: tuple = (), start: object = run) -> None:
        """Exit 2, one line that has all the parts, and nothing written."""
        status, out, err = start(self.program, self.results, *arguments)
        self.assertEqual((status, out, err.count("\n")), (2, "", 1), err)
        for part in parts:
            self.assertIn(part, err)
        self.assertFalse(self.figures.exists())
