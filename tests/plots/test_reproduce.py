"""./run reproduce measures one revision, puts complete parts into results/, and says of each what it is."""
import gzip
import json
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "results"))

import installing
import measuring
import parts


def replaced(test: unittest.TestCase, *what: object) -> None:
    """Module, name and value, for one test."""
    patch = mock.patch.object(*what)
    patch.start()
    test.addCleanup(patch.stop)


def new_folder(test: unittest.TestCase) -> Path:
    """For one test."""
    place = tempfile.TemporaryDirectory()
    test.addCleanup(place.cleanup)
    return Path(place.name)


class QuickTest(unittest.TestCase):
    def test_no_folder_of_others_is_emptied(self) -> None:
        with tempfile.TemporaryDirectory() as place:
            mine = Path(place) / "mine"
            mine.touch()
            program = Path(measuring.__file__).with_name("reproduce.py")
            ran = subprocess.run([sys.executable, program, "--quick", f"--work={place}"], capture_output=True,
                                 text=True, check=False)
            self.assertEqual(2, ran.returncode)
            self.assertIn(f"--work: {place}: is not empty (allowed with --quick:", ran.stderr)
            self.assertTrue(mine.exists())


class NoisyTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = new_folder(self)
        self.called = self.folder / "called"
        bench = self.folder / "bench"
        bench.write_text(f'#!/bin/sh\necho "$@" >> {self.called}\n', encoding="utf-8")
        bench.chmod(0o755)
        self.part = parts.Part("first", "shows", ["--mesh=Mesh0"], [])
        self.shop = measuring.Workshop(self.folder, self.folder, bench)
        self.run_folder = self.shop.folder(self.part, 1)
        self.run_folder.mkdir(parents=True)
        (self.run_folder / "complete").touch()

    def measured_again(self, *noisy: bool) -> str:
        """Methods whose records are left for bench to continue from."""
        (self.run_folder / "records.jsonl").write_text(
            "".join(f"{json.dumps({'method': name, 'noisy': is_noisy})}\n" for name, is_noisy in zip("ABC", noisy)),
            encoding="utf-8")
        with mock.patch("builtins.print"):
            measuring.forget_noisy(self.shop, self.part)
            self.assertTrue(measuring.measure(self.shop, self.part, 1, self.part.runs[0]))
        lines = (self.run_folder / "records.jsonl").read_text(encoding="utf-8").splitlines()
        return "".join(json.loads(line)["method"] for line in lines)

    def test_noisy_cases_alone_are_measured_again(self) -> None:
        self.assertEqual("AC", self.measured_again(False, True, False))
        self.assertIn("--mesh=Mesh0 --resume", self.called.read_text(encoding="utf-8"))

    def test_a_quiet_run_is_left_as_it_is(self) -> None:
        self.assertEqual("ABC", self.measured_again(False, False, False))
        self.assertFalse(self.called.exists())


class InstallTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = new_folder(self)
        self.results = self.folder / "results"
        self.results.mkdir()
        replaced(self, installing, "RESULTS", self.results)
        replaced(self, installing, "PROJECT", self.folder)
        self.shop = measuring.Workshop(self.folder / "work", self.folder / "source")
        self.parts = [parts.Part(name, f"shows {name}", ["--mesh=Mesh0"], ["growth"])
                      for name in ("first", "second")]

    def measured(self, name: str, revision: str, figures: tuple[str, ...], *later: str) -> None:
        """later: revisions of further records."""
        run, whole = (self.folder / "work" / place for place in (f"runs/{name}/1", f"results/{name}"))
        run.mkdir(parents=True)
        (run / "complete").touch()
        (whole / "figures").mkdir(parents=True)
        contexts = [{"git_revision": one.rstrip("+"), "git_dirty": "yes" if one.endswith("+") else "no",
                     "date": f"2026-11-{day}T00:00:00Z"} for day, one in enumerate((revision, *later), 23)]
        (whole / "records.jsonl").write_text(
            "".join(json.dumps({"status": "ok", "context": context}) + "\n" for context in contexts))
        for figure in figures:
            (whole / "figures" / figure).touch()

    def install(self, *chosen: int) -> str:
        with mock.patch.object(installing, "output_of"), mock.patch("builtins.print"):
            installing.install(self.shop, [self.parts[k] for k in chosen], self.parts)
        return (self.results / "reproduced.md").read_text(encoding="utf-8")

    def test_what_is_complete_replaces_what_was_there(self) -> None:
        (self.results / "first").mkdir()
        (self.results / "first/old.csv").touch()
        self.measured("first", "abc", ("growth.png",))
        self.assertIn("| [first](first) | shows first | 1 | 1 ok | 0 | 2026-11-23T00:00:00Z | abc |",
                      self.install(0))
        self.assertEqual({"records.jsonl", "figures"},
                         {file.name for file in (self.results / "first").iterdir()})

    def test_many_records_are_packed_and_counted_as_before(self) -> None:
        self.measured("first", "abc", ("growth.png",))
        replaced(self, installing, "LARGE", 50)
        self.assertIn("| 1 | 1 ok | 0 | 2026-11-23T00:00:00Z | abc |", self.install(0))
        whole = self.results / "first"
        self.assertEqual({"records.jsonl.gz", "figures"}, {file.name for file in whole.iterdir()})
        self.assertEqual((self.folder / "work/results/first/records.jsonl").read_bytes(),
                         gzip.decompress((whole / "records.jsonl.gz").read_bytes()))

    def test_published_values_of_several_runs_are_one_packed_list(self) -> None:
        runs = [self.folder / name for name in ("1", "2")]
        for run in runs:
            run.mkdir()
            (run / "validation.json").write_text(json.dumps([{"case": f"of {run.name}"}], indent=1), encoding="utf-8")
        (self.results / "results.csv").touch()
        measuring.join_published(runs, self.results)
        self.assertEqual([file.name for file in self.results.iterdir()], ["validation.json.gz"])
        self.assertEqual(json.loads(gzip.decompress((self.results / "validation.json.gz").read_bytes())),
                         [{"case": "of 1"}, {"case": "of 2"}])

    def test_a_part_without_its_figure_is_left_as_it_is(self) -> None:
        (self.results / "first").mkdir()
        (self.results / "first/old.csv").touch()
        self.measured("first", "abc", ("other.png",))
        self.assertNotIn("[first]", self.install(0))
        self.assertTrue((self.results / "first/old.csv").exists())

    def test_a_part_that_was_not_measured_is_left_as_it_is(self) -> None:
        self.assertNotIn("[second]", self.install(1))

    def test_rows_of_parts_that_were_installed_before_stay(self) -> None:
        self.measured("first", "abc", ("growth.csv",))
        self.measured("second", "def", ("growth.csv",))
        self.install(0)
        said = self.install(1)
        self.assertLess(said.index("| abc |"), said.index("| def |"))

    def test_a_part_of_several_revisions_is_left_as_it_is(self) -> None:
        self.measured("first", "abc", ("growth.png",), "def")
        self.measured("second", "abc+", ("growth.png",))
        self.assertNotIn("[", self.install(0, 1))

    def test_a_copy_of_a_figure_is_that_of_its_part(self) -> None:
        self.parts[0] = replace(self.parts[0], images=["growth"])
        self.measured("first", "abc", ("growth.png",))
        copy = self.folder / "docs/images/growth.png"
        copy.parent.mkdir(parents=True)
        copy.write_bytes(b"old")
        self.install(0)
        self.assertEqual(b"", copy.read_bytes())
        self.assertEqual([], installing.out_of_date(self.parts))
        copy.write_bytes(b"other")
        self.assertEqual(["docs/images/growth.png: not of these records (--install writes it)"],
                         installing.out_of_date(self.parts))

    def check(self, *chosen: int, others: str = "") -> tuple[int, list[str]]:
        with mock.patch.object(installing, "output_of", return_value=others), \
                mock.patch("builtins.print") as printed:
            status = installing.check([self.parts[k] for k in chosen] or self.parts, self.parts, None)
        return status, [line for call in printed.call_args_list for line in call.args]

    def test_records_of_one_revision_pass_also_when_sessions_were_several(self) -> None:
        self.measured("first", "abc", ("growth.png",), "abc")
        self.measured("second", "abc", ("growth.png",))
        self.install(0)
        self.install(1)
        status, lines = self.check(others="first/records.jsonl\nsecond/records.jsonl.gz")
        self.assertEqual((status, lines[-1]), (0, "one revision: abc"))
        self.assertEqual(lines[1].split(),
                         ["first", "2", "2026-11-23T00:00:00Z", "2026-11-24T00:00:00Z", "abc"])

    def test_records_of_several_revisions_do_not_pass(self) -> None:
        self.measured("first", "abc", ("growth.png",))
        self.measured("second", "def", ("growth.png",))
        self.install(0, 1)
        status, lines = self.check()
        self.assertEqual((status, lines[-1]), (1, "2 revisions: abc, def"))
        self.assertEqual(self.check(1)[0], 0)
        (self.results / "reproduced.md").write_text("old", encoding="utf-8")
        self.assertEqual((1, "results/reproduced.md: not of these records (--install writes it)"),
                         (self.check(1)[0], self.check(1)[1][-1]))

    def test_a_part_without_records_and_records_without_a_part_do_not_pass(self) -> None:
        self.measured("first", "abc", ("growth.png",))
        self.install(0)
        status, lines = self.check(others="first/records.jsonl\nold/nights/2026.json")
        self.assertEqual(status, 1)
        self.assertEqual(lines[-3:],
                         ["no records: second", "no records: old", "no part of reproduce.toml: old"])

    def test_every_night_is_looked_at(self) -> None:
        nights = self.results / "first/nights"
        nights.mkdir(parents=True)
        for k, revision in enumerate(("abc", "def")):
            context = {"git_revision": revision, "git_dirty": "no", "date": f"2026-11-2{k}T00:00:00Z"}
            (nights / f"{k}.json").write_text(json.dumps({"context": context}))
        self.assertIn("2 revisions: abc, def", self.check(0)[1])


class RevisionTest(unittest.TestCase):
    def setUp(self) -> None:
        place = new_folder(self)
        self.work = place / "work"
        self.project = place / "project"
        self.project.mkdir()
        for module in (parts, measuring):
            replaced(self, module, "PROJECT", self.project)
        self.git("init", "--quiet")
        self.first, self.second = self.commit("one"), self.commit("two")

    def git(self, *arguments: str) -> str:
        return subprocess.run(["git", *arguments], cwd=self.project, capture_output=True, text=True,
                              check=True).stdout.strip()

    def commit(self, text: str) -> str:
        (self.project / "file").write_text(text)
        self.git("add", "file")
        self.git("-c", "user.name=test", "-c", "user.email=test@localhost", "commit", "--quiet", "-m", text)
        return self.git("rev-parse", "HEAD")

    def pinned(self, revision: str | None) -> str:
        return (measuring.pinned(self.work, revision) / "file").read_text()

    def refused(self, revision: str | None) -> str:
        with self.assertRaises(parts.Refused) as refused:
            self.pinned(revision)
        self.assertNotIn("\n", str(refused.exception))
        return str(refused.exception)

    def test_a_revision_is_measured_whatever_came_after_it(self) -> None:
        self.assertEqual(self.pinned(self.first[:8]), "one")

    def test_by_default_it_is_head_and_stays_that_one(self) -> None:
        self.assertEqual(self.pinned(None), "two")
        third = self.commit("three")
        self.assertEqual(self.pinned(None), "two")
        self.assertEqual(self.pinned("HEAD~1"), "two")
        there = self.second[:10]
        self.assertIn(f"has {there}, not {third} (allowed: --revision={there}, or another --work)",
                      self.refused(third))

    def test_changes_that_are_not_committed_are_refused_unless_a_revision_is_named(self) -> None:
        (self.project / "file").write_text("changed")
        self.assertIn("allowed: a clean tree, or --revision", self.refused(None))
        self.assertEqual(self.pinned("HEAD"), "two")

    def test_what_is_no_revision_is_refused_and_leaves_nothing(self) -> None:
        for wrong in ("nowhere", "-x"):
            self.assertIn(f"--revision: '{wrong}' is none of this repository", self.refused(wrong))
        self.assertFalse(self.work.exists())

    def test_an_interrupted_clone_is_made_again(self) -> None:
        (self.work / "source.new").mkdir(parents=True)
        (self.work / "source.new/file").touch()
        self.assertEqual(self.pinned(None), "two")
