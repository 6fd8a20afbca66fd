"""docs/notebooks: every cell runs, and what is committed has its outputs.  /usr/bin/python3 -m unittest FILE"""
import re
import sys
import tempfile
import unittest
from pathlib import Path

import nbformat

NOTEBOOKS = Path(__file__).resolve().parents[2] / "docs" / "notebooks"
sys.path.append(str(NOTEBOOKS))

import run  # noqa: E402

FILES = sorted(NOTEBOOKS.glob("*.ipynb"))
MAX_BYTES = 1_500_000


class NotebooksTest(unittest.TestCase):
    def test_every_notebook_runs_in_an_empty_folder_and_leaves_nothing_there(self) -> None:
        self.assertGreaterEqual(len(FILES), 6)
        for file in FILES:
            with self.subTest(file.name), tempfile.TemporaryDirectory() as runtime:
                folder = Path(runtime, "folder")
                folder.mkdir()
                notebook = run.execute(file, str(folder))
                left = {entry.name for entry in folder.iterdir() if not re.match(r"kernel-|profile_|db$", entry.name)}
                self.assertEqual(left, set())
                run.strip(notebook)
                committed = nbformat.read(file, as_version=4)
                for cell, old in zip(notebook.cells, committed.cells):
                    if cell.cell_type == "code":
                        self.assertEqual([output.output_type for output in cell.outputs],
                                         [output.output_type for output in old.outputs], cell.source)

    def test_committed_outputs_are_small_and_of_no_machine(self) -> None:
        self.assertLess(sum(file.stat().st_size for file in FILES), MAX_BYTES)
        for file in FILES:
            notebook = nbformat.read(file, as_version=4)
            nbformat.validate(notebook)
            stripped = nbformat.from_dict(notebook)
            run.strip(stripped)
            self.assertEqual(stripped, notebook, f"{file.name}: docs/notebooks/run.py --write {file.stem}")
            code = [cell for cell in notebook.cells if cell.cell_type == "code"]
            self.assertEqual([cell.execution_count for cell in code], list(range(1, len(code) + 1)), file.name)
            text = "".join(output.get("text", "") for cell in code for output in cell.outputs)
            self.assertNotRegex(text, r"/(home|root|tmp|usr|work)/|\b\d+(\.\d+)? (ms|µs|s)\b", file.name)

    def test_the_index_names_every_notebook(self) -> None:
        index = (NOTEBOOKS / "README.md").read_text(encoding="utf-8")
        self.assertEqual(sorted(re.findall(r"\]\((\w+\.ipynb)\)", index)), [file.name for file in FILES])


if __name__ == "__main__":
    unittest.main()
