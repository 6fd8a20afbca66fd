"""Problems that the bench command exports, for tests of what is done with them.

    AIRYBENCH_BENCH=PATH
"""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

BENCH = os.environ["AIRYBENCH_BENCH"]


def difference(found: np.ndarray, expected: np.ndarray) -> float:
    return np.linalg.norm(found - expected) / np.linalg.norm(expected)


class ExportingTest(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def scene(self, definition: dict) -> Path:
        file = self.folder / "scene.json"
        file.write_text(json.dumps(definition), encoding="utf-8")
        return file

    def export(self, file_format: str, definition: dict, mesh: str = "Mesh0") -> Path:
        out = Path(tempfile.mkdtemp(dir=self.folder))
        ran = subprocess.run([BENCH, "export-problem", f"--mesh={mesh}", f"--format={file_format}",
                              f"--scene={self.scene(definition)}", f"--out={out}"],
                             capture_output=True, text=True, check=False)
        if "this build is without" in ran.stderr:
            self.skipTest(ran.stderr)
        self.assertEqual((0, ""), (ran.returncode, ran.stderr))
        return out
