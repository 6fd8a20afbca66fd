"""./run reproduce puts complete parts into results/, and says of each what it is."""
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


class NoisyAgainTest(unittest.TestCase):
    """Cases 1 to 4: quiet; noisy; noisy; noisy. Measured again: quieter, noisier, failed."""

    def setUp(self) -> None:
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.out = Path(place.name)
        self.program = program()
        self.write(self.out / "records.jsonl",
                   [self.record(1, 0.01, 1), *(self.record(k, 0.1 * k, 1) for k in (2, 3, 4))])
        (self.out / "complete").touch()

    @staticmethod
    def record(number: int, noise: float | None, time_s: float | None) -> dict:
        return {"case_number": number, "noise_share": noise, "time_s": time_s,
                "noisy": (noise or 0) > 0.05}

    @staticmethod
    def write(file: Path, records: list[dict], mode: str = "w") -> None:
        with open(file, mode, encoding="utf-8") as lines:
            lines.writelines(json.dumps(record) + "\n" for record in records)

    def records(self) -> list[dict]:
        return [json.loads(line) for line in (self.out / "records.jsonl").read_text().splitlines()]

    def test_the_less_noisy_is_kept_whatever_its_time(self) -> None:
        self.program.set_noisy_aside(self.out)
        self.assertFalse((self.out / "complete").exists())
        self.assertEqual([1], [record["case_number"] for record in self.records()])
        self.write(self.out / "records.jsonl",
                   [self.record(2, 0.02, 9), self.record(3, 0.4, 0.1), self.record(4, None, None)], "a")
        self.program.keep_less_noisy(self.out)
        self.assertEqual([(1, 1), (2, 9), (3, 1), (4, None)],
                         [(record["case_number"], record["time_s"]) for record in self.records()])
        self.assertFalse((self.out / "noisy.jsonl").exists())

    def test_a_quiet_run_is_left_as_it_is(self) -> None:
        self.write(self.out / "records.jsonl", [self.record(1, 0.01, 1)])
        self.program.set_noisy_aside(self.out)
        self.assertTrue((self.out / "complete").exists())
        self.assertFalse((self.out / "noisy.jsonl").exists())

    def test_ended_before_the_records_were_cut_nothing_is_lost(self) -> None:
        noisy = self.records()[1:]
        self.write(self.out / "noisy.jsonl", noisy)
        before = self.records()
        self.program.keep_less_noisy(self.out)
        self.assertEqual(before, self.records())


if __name__ == "__main__":
    unittest.main()
