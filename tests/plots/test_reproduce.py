"""./run reproduce puts complete parts into results/, and says of each what it is."""
import gzip
import importlib.util
import json
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

PROJECT = Path(__file__).resolve().parents[2]


def program():
    spec = importlib.util.spec_from_file_location("reproduce", PROJECT / "results/reproduce.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules["reproduce"] = module
    spec.loader.exec_module(module)
    return module


class InstallTest(unittest.TestCase):
    def setUp(self) -> None:
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name)
        self.program = program()
        self.program.HERE = self.folder / "results"
        self.program.HERE.mkdir()
        self.shop = self.program.Workshop(self.folder / "work", self.folder / "source")
        self.parts = [self.program.Part(name, f"shows {name}", ["--mesh=Mesh0"], ["growth"])
                      for name in ("first", "second")]

    def measured(self, name: str, revision: str, figures: tuple[str, ...]) -> None:
        run, whole = (self.folder / "work" / place for place in (f"runs/{name}/1", f"results/{name}"))
        run.mkdir(parents=True)
        (run / "complete").touch()
        (whole / "figures").mkdir(parents=True)
        context = {"git_revision": revision, "git_dirty": "no", "date": "2026-11-23T00:00:00Z"}
        (whole / "records.jsonl").write_text(json.dumps({"status": "ok", "context": context}) + "\n")
        for figure in figures:
            (whole / "figures" / figure).touch()

    def install(self, *parts: int) -> str:
        with mock.patch.object(self.program, "output_of"), mock.patch("builtins.print"):
            self.program.install(self.shop, [self.parts[k] for k in parts], self.parts)
        return (self.program.HERE / "reproduced.md").read_text(encoding="utf-8")

    def test_what_is_complete_replaces_what_was_there(self) -> None:
        (self.program.HERE / "first").mkdir()
        (self.program.HERE / "first/old.csv").touch()
        self.measured("first", "abc", ("growth.png",))
        self.assertIn("| [first](first) | shows first | 1 | 1 ok | 0 | 2026-11-23T00:00:00Z | abc |",
                      self.install(0))
        self.assertEqual({"records.jsonl", "figures"},
                         {file.name for file in (self.program.HERE / "first").iterdir()})

    def test_many_records_are_packed_and_counted_as_before(self) -> None:
        self.measured("first", "abc", ("growth.png",))
        self.program.LARGE = 50
        self.assertIn("| 1 | 1 ok | 0 | 2026-11-23T00:00:00Z | abc |", self.install(0))
        whole = self.program.HERE / "first"
        self.assertEqual({"records.jsonl.gz", "figures"}, {file.name for file in whole.iterdir()})
        self.assertEqual((self.folder / "work/results/first/records.jsonl").read_bytes(),
                         gzip.decompress((whole / "records.jsonl.gz").read_bytes()))

    def test_a_part_without_its_figure_is_left_as_it_is(self) -> None:
        (self.program.HERE / "first").mkdir()
        (self.program.HERE / "first/old.csv").touch()
        self.measured("first", "abc", ("other.png",))
        self.assertNotIn("[first]", self.install(0))
        self.assertTrue((self.program.HERE / "first/old.csv").exists())

    def test_a_part_that_was_not_measured_is_left_as_it_is(self) -> None:
        self.assertNotIn("[second]", self.install(1))

    def test_rows_of_parts_that_were_installed_before_stay(self) -> None:
        self.measured("first", "abc", ("growth.csv",))
        self.measured("second", "def", ("growth.csv",))
        self.install(0)
        said = self.install(1)
        self.assertLess(said.index("| abc |"), said.index("| def |"))


if __name__ == "__main__":
    unittest.main()
