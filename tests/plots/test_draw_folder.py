"""Which programs draw a folder.  /usr/bin/python3 -m unittest FILE"""
import json
import tempfile
import unittest
from pathlib import Path

import running  # noqa: F401  (finds the programs)
from draw_folder import drawing_programs
from records import RecordsError

BODY = {"scene": "default", "study": "", "n_phi": 100, "n_c": 10}
PROBLEM = {"scene": "fclib", "study": "contact", "n_phi": None, "n_c": 10}


class DrawFolderTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, *records: dict) -> None:
        lines = "".join(json.dumps(record) + "\n" for record in records)
        (self.folder / "records.jsonl").write_text(lines, encoding="utf-8")

    def test_programs_follow_what_the_folder_has(self) -> None:
        for records, programs in (([BODY], ["figures.py"]), ([PROBLEM], ["contact_profiles.py"]),
                                  ([PROBLEM | {"study": "mine", "points": "contact"}], ["contact_profiles.py"]),
                                  ([PROBLEM | {"points": None}], ["figures.py"]),
                                  ([PROBLEM, BODY], ["contact_profiles.py", "figures.py"]),
                                  ([PROBLEM | {"study": ""}], ["figures.py"]), ([], ["figures.py"])):
            self.write(*records)
            self.assertEqual(drawing_programs(self.folder, None, False), programs, records)
        (self.folder / "fields").mkdir()
        self.assertEqual(drawing_programs(self.folder, None, False), ["gallery.py", "figures.py"])
        self.assertEqual(drawing_programs(self.folder, "figure3", False), ["figures.py"])
        (self.folder / "records.jsonl").unlink()
        self.assertEqual(drawing_programs(self.folder, None, False), ["gallery.py"])

    def test_packed_records_and_tables_have_figures(self) -> None:
        for name in ("records.jsonl.gz", "results.csv"):
            (self.folder / name).touch()
            self.assertEqual(drawing_programs(self.folder, None, False), ["figures.py"])
            (self.folder / name).unlink()

    def test_nothing_to_draw_is_said(self) -> None:
        for only, animate, said in ((None, False, "has neither records nor fields/ (bench --out="),
                                    ("x", False, "has no records (bench --out="),
                                    (None, True, "has no path of load steps"),
                                    ("x", True, "--animate: not together with --only")):
            with self.assertRaisesRegex(RecordsError, said.replace("(", r"\(")):
                drawing_programs(self.folder, only, animate)
