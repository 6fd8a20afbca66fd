"""The numbers in README.md and docs/ against the records.  /usr/bin/python3 -m unittest FILE"""
import re
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import made_up  # finds plots

import quoted_numbers
from running import run

PROJECT = Path(__file__).resolve().parents[2]
TEXT = """# A README
HYBRID takes 0.25 of
3STEPD's time, 4.0 MiB, an error of at most 1.3e-9, on 50 483 unknowns;
no case of the two is wrong.

<!-- table run: Mesh0|Mesh7 / HYBRID -->
<!-- end of table -->
"""
QUOTES = """# a comment
[README.md]
HYBRID takes {} of 3STEPD's time, {} MiB, an error of at most {}, on {} unknowns
  run: time_s of Mesh7/HYBRID per 3STEPD
  run: peak_heap_bytes of Mesh7/HYBRID in MiB
  run: at most greatest error_force of */HYBRID
  run: n_phi of Mesh7/HYBRID

{} case of the {} is wrong
  run: count of Mesh7/*, outcome=wrong_success
  run: count of Mesh7/*
  run: time_s of Mesh7/HYBRID per 3STEPD is below 1
"""


def other(number: str) -> str:
    """A number in the same form whose last digit is another."""
    if number in quoted_numbers.WORDS:
        return quoted_numbers.WORDS[quoted_numbers.WORDS.index(number) - 1]
    mantissa, e, exponent = number.partition("e")
    return mantissa[:-1] + ("1" if mantissa[-1] == "2" else "2") + e + exponent


class CommittedNumbersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.runs = quoted_numbers.Runs(PROJECT / "results")  # read once for all tests
        cls.quotes = list(quoted_numbers.quotes_in(PROJECT / "docs" / "numbers.txt"))
        cls.texts = {quote.file: (PROJECT / quote.file).read_text(encoding="utf-8")
                     for quote in cls.quotes}

    def test_every_quoted_number_follows_from_the_records(self) -> None:
        with mock.patch.object(quoted_numbers, "Runs", return_value=self.runs) as runs:
            differences = quoted_numbers.differences(PROJECT)
        runs.assert_called_once_with(PROJECT / "results")
        self.assertIn("README.md", differences)
        self.assertEqual([], [d.sentence() for of_file in differences.values() for d in of_file])

    def test_any_planted_wrong_number_is_found(self) -> None:
        for quote in self.quotes:
            text = self.texts[quote.file]
            place = quoted_numbers.found(quote, text)
            for group in range(1, len(quote.expressions) + 1):
                start, end = place.span(group)
                wrong = other(place[group])
                planted = text[:start] + wrong + text[end:]
                with self.subTest(quote.phrase, wrong=wrong):
                    found = list(quoted_numbers.differences_of(quote, planted, self.runs))
                    self.assertEqual([(d.line, d.written, d.records) for d in found],
                                     [(text.count("\n", 0, start) + 1, wrong, place[group])])

    def test_a_planted_wrong_cell_of_the_table_is_found(self) -> None:
        text = (PROJECT / "README.md").read_text(encoding="utf-8")
        table = next(quoted_numbers.TABLE.finditer(text))
        cell = re.search(r"\d+ ms", table["body"])[0]
        at = text.index(cell, table.start("body"))
        planted = text[:at] + other(cell[:-3]) + text[at + len(cell) - 3:]
        found = list(quoted_numbers.differing_tables("README.md", planted, self.runs))
        self.assertEqual([d.line for d in found], [text.count("\n", 0, at) + 1])


class QuotedNumbersTest(unittest.TestCase):
    def setUp(self) -> None:
        self.project = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.project)
        for folder in ("docs", "results/run"):
            (self.project / folder).mkdir(parents=True)
        self.readme = self.project / "README.md"
        self.quotes = self.project / "docs" / "numbers.txt"
        self.quotes.write_text(QUOTES, encoding="utf-8")
        self.readme.write_text(TEXT, encoding="utf-8")
        self.records(made_up.case("Mesh0", "HYBRID", time_mad_s=2e-4),
                     made_up.case("Mesh7", "HYBRID", error_force=1.21e-9, time_mad_s=0.0),
                     made_up.case("Mesh7", "3STEPD", time_s=2.01),
                     made_up.case("Mesh7", "ALM", stop="paper", status="inaccurate"))

    def records(self, *rows: dict[str, object]) -> None:
        made_up.write(self.project / "results" / "run" / "results.csv", list(rows))

    def check(self, option: str = "--check") -> tuple[int, str, str]:
        return run(quoted_numbers, option, "--project", self.project)

    def assert_refused(self, quotes: str, *parts: str) -> None:
        self.quotes.write_text(quotes, encoding="utf-8")
        status, out, err = self.check()
        self.assertEqual((status, out, err.count("\n")), (2, "", 1), err)
        for part in parts:
            self.assertIn(part, err)

    def test_written_numbers_and_tables_are_right_afterwards(self) -> None:
        self.assertEqual(self.check()[0], 1)  # the table is empty
        self.assertEqual(self.check("--write")[0], 0)
        self.assertEqual(self.check(), (0, "", ""))
        text = self.readme.read_text(encoding="utf-8")
        self.assertIn("Mesh0/default/HYBRID    761  500 ms  200 µs  4.0 MiB       1.0e-10", text)
        self.assertIn("\n…\nMesh7/default/HYBRID  50483", text)

    def test_a_table_by_mesh_has_values_of_the_records(self) -> None:
        self.records(made_up.case("Mesh0", "HYBRID", time_s=0.0123, error_total=0.0387),
                     made_up.case("Mesh7", "HYBRID", time_s=2.5, error_total=0.004),
                     made_up.case("Mesh7", "EXTERNAL:soft", status="inaccurate", time_s=1.0, error_total=0.25))
        head = "<!-- table run: Mesh0|Mesh7 / HYBRID|EXTERNAL:soft / time_s,error_total,peak_heap_bytes,error_force -->\n"
        self.quotes.write_text("[README.md]\nEND {}\n  run: count of */HYBRID\n", encoding="utf-8")
        self.readme.write_text(head + "<!-- end of table -->\nEND two\n", encoding="utf-8")
        self.assertEqual(self.check("--write")[0], 0)
        self.assertEqual(self.readme.read_text(encoding="utf-8"), head + (
            "|  | Mesh0 | Mesh7 |\n| --- | --- | --- |\n"
            "| HYBRID | 12.3 ms, 3.9\u00a0%, 4 MiB, 1e-9 | 2.5 s, 0.4\u00a0%, 4 MiB, 1e-9 |\n"
            "| soft | — | *1 s, 25\u00a0%, 4 MiB, 1e-9* |\n<!-- end of table -->\nEND two\n"))
        self.readme.write_text(head.replace("error", "eror") + "<!-- end of table -->\nEND two\n", encoding="utf-8")
        self.assert_refused(self.quotes.read_text(encoding="utf-8"), "README.md: <!-- table run", "no column eror_total")
        self.readme.write_text(head.replace("Mesh7", "Mesh8") + "<!-- end of table -->\nEND two\n", encoding="utf-8")
        self.assert_refused(self.quotes.read_text(encoding="utf-8"), "README.md: <!-- table run", "no case of Mesh8 in run")

    def test_a_table_of_a_page_without_quotes_is_checked(self) -> None:
        self.assertEqual(self.check("--write")[0], 0)
        page = self.quotes.with_name("page.md")
        page.write_text("<!-- table run: Mesh7 / HYBRID / time_s -->\n<!-- end of table -->\n", encoding="utf-8")
        status, out, _ = self.check()
        self.assertEqual((status, out.split(" ")[0]), (1, "docs/page.md:2:"))

    def test_a_file_is_replaced_whole(self) -> None:
        with open(self.readme, encoding="utf-8") as before:
            self.assertEqual(self.check("--write")[0], 0)
            self.assertEqual(before.read(), TEXT)
        self.assertNotEqual(self.readme.read_text(encoding="utf-8"), TEXT)

    def test_what_is_wrong_has_file_line_and_both_numbers(self) -> None:
        self.check("--write")
        self.readme.write_text(self.readme.read_text(encoding="utf-8").replace("0.25", "0.3")
                               .replace("the two", "the three"), encoding="utf-8")
        self.assertEqual(self.check(), (1, (
            "README.md:2: '0.3', but the records give '0.2' "
            "(run: time_s of Mesh7/HYBRID per 3STEPD)\n"
            "README.md:4: 'three', but the records give 'two' (run: count of Mesh7/*)\n"), ""))

    def test_words_that_no_longer_hold_are_left_to_an_author(self) -> None:
        self.check("--write")
        self.records(made_up.case("Mesh0", "HYBRID", time_mad_s=2e-4),
                     made_up.case("Mesh7", "HYBRID", time_mad_s=0, time_s=2.2),
                     made_up.case("Mesh7", "3STEPD", time_s=2))
        status, out, _ = self.check("--write")
        self.assertEqual(status, 1)
        self.assertIn("README.md:2: '0.25', but the records give '1.1'", out)
        self.assertIn("but the records give '1.1' (run: time_s of Mesh7/HYBRID per 3STEPD is "
                      "below 1)", out)
        self.assertIn("HYBRID takes 1.1 of\n", self.readme.read_text(encoding="utf-8"))

    def test_numbers_keep_their_form(self) -> None:
        even, up = quoted_numbers.ROUNDING[None], quoted_numbers.ROUNDING["at most"]
        for value, rounding, like, shown in (
                (0.0905, even, "0.08", "0.09"), (0.2007, even, "0.31", "0.20"),
                (9.96, even, "3", "10"), (12.3, even, "4", "12"), (2604.0, even, "2603", "2604"),
                (797363.0, even, "50 483", "797 363"), (999.6, even, "300", "999.6"),
                (1.8225e-12, even, "1.7e-12", "1.8e-12"), (1.8225e-12, up, "1e-12", "2e-12"),
                (9.96e-4, even, "1.2e-3", "1.0e-3"), (0.0, even, "no", "no"),
                (12.0, even, "no", "12"), (0.0996, even, "0.10", "0.10"),
                (9.78, even, "9", "9.8"), (99.7, even, "9", "99.7"), (9.96, even, "9", "10"),
                (9.96, even, "10", "10"), (0.0, even, "3", "0")):
            with self.subTest(value=value, like=like):
                self.assertEqual(quoted_numbers.shown(value, rounding, like), shown)

    def test_quotations_that_cannot_be_held_against_records(self) -> None:
        head = "[README.md]\nHYBRID takes {} of 3STEPD's time\n"
        place = f"{self.quotes}:2: "
        for line, *parts in (
                ("run: time of", "cannot be read"),
                ("run: time_s of Mesh7/*", "2 values, expected one"),
                ("run: time_s of Mesh7/P2", "no values"),
                ("run: time of Mesh7/HYBRID", "no column time"),
                ("run: count of */*, colour=red", "no column colour"),
                ("run: time_s of Mesh7/HYBRID in weeks", "unit 'weeks'", "days"),
                ("run: n_phi of Mesh7/HYBRID\n  run: n_c of Mesh7/HYBRID", "1 numbers", "2 lines")):
            with self.subTest(line):
                self.assert_refused(f"{head}  {line}\n", place, *parts)
        self.assert_refused("[README.md]\nSSKY takes {} s\n  run: count of */*\n",
                            "'SSKY takes {} s' stands 0 times in README.md")
        self.assert_refused("  run: count of */*\n", f"{self.quotes}:1: ", "without a phrase")
        self.assert_refused(head + "  other: count of */*\n", "results.csv", "cannot be read")
        self.readme.write_text(TEXT.replace("table run:", "table"), encoding="utf-8")
        self.assert_refused(QUOTES, "README.md: 1 comments begin a table, 0 of them can be read")
