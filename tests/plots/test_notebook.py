"""docs/notebook.py and what results/README.md says of pandas.  /usr/bin/python3 -m unittest FILE"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

from running import PROJECT

import records


class NotebookTest(unittest.TestCase):
    def run_in_folder(self, code: str) -> tuple[str, Path]:
        """stdout of the code in a folder that has only the committed results, and the folder."""
        folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        (folder / "results").symlink_to(PROJECT / "results")
        (folder / "code.py").write_text(code, encoding="utf-8")
        done = subprocess.run([sys.executable, "code.py"], cwd=folder, capture_output=True, text=True, check=False,
                              env=os.environ | {"MPLBACKEND": "Agg"})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout, folder

    def test_the_notebook_runs_and_its_numbers_are_the_records(self) -> None:
        code = (PROJECT / "docs/notebook.py").read_text(encoding="utf-8")
        self.assertLessEqual(len(code.splitlines()), 100)
        out, folder = self.run_in_folder(code)
        direct = records.read(PROJECT / "results/direct/results.csv").set_index(["mesh", "method"]).time_s
        row = re.search(r"^3STEPD +(.*)$", out.partition("Time over HYBRID's")[2], re.M)
        self.assertEqual(row[1].split(), [f"{direct[mesh, '3STEPD'] / direct[mesh, 'HYBRID']:.1f}"
                                          for mesh in sorted({mesh for mesh, _ in direct.index if "+" not in mesh})])
        paper = records.read(PROJECT / "results/paper/results.csv")
        alm, = paper[(paper.mesh == "Mesh3") & (paper.method == "ALM") & (paper.stop == "paper")].itertuples()
        self.assertRegex(out, rf"ALM +paper +{alm.status} +{alm.time_s:.4f} +{alm.error_force:.1e}")
        self.assertTrue((folder / "notebook.png").read_bytes().startswith(b"\x89PNG"))

    def test_the_three_lines_of_the_readme_run(self) -> None:
        code, = re.findall(r"```python\n(import pandas.*?)```",
                           (PROJECT / "results/README.md").read_text(encoding="utf-8"), re.S)
        self.assertEqual(3, len(code.splitlines()))
        out, _ = self.run_in_folder(code.replace("results/latest", "results/direct"))
        self.assertIn("HYBRID", out)

    def test_pandas_reads_every_committed_record(self) -> None:
        files = sorted((PROJECT / "results").glob("*/records.jsonl*"))
        self.assertGreater(len(files), 10)
        for file in files:
            lines = records.read_lines(file)
            times = [np.nan if line["time_s"] is None else line["time_s"] for line in lines]
            table = pd.read_json(file, lines=True, precise_float=True)
            np.testing.assert_array_equal(table.time_s, times, str(file))
            rounded = pd.read_json(file, lines=True).time_s
            np.testing.assert_allclose(rounded, times, rtol=5e-12, err_msg=str(file))
            self.assertEqual(table.method.tolist(), [line["method"] for line in lines], file)
