"""docs/validation.md: its tables say what is committed.  /usr/bin/python3 -m unittest FILE"""
import tempfile
import unittest
from pathlib import Path

from running import PROJECT, run

import validation_profiles


class ValidationTest(unittest.TestCase):
    def test_the_tables_are_those_of_the_committed_values(self) -> None:
        written = (PROJECT / "docs/validation.md").read_text(encoding="utf-8")
        status, printed, _ = run(validation_profiles, "--table")
        self.assertEqual(status, 0)
        tables = printed.strip().split("\n\n")
        self.assertEqual(len(tables), 3)
        for table in tables:
            self.assertIn(f"\n\n{table}\n\n", written)

    def test_the_figure_is_drawn(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "validation.png"
            self.assertEqual(run(validation_profiles, f"--out={out}")[0], 0)
            self.assertTrue(out.read_bytes().startswith(b"\x89PNG"))
