"""Words that all figures share, and looks of methods.  /usr/bin/python3 -m unittest FILE"""
import unittest

import running  # finds plots

from catalogue import looks_of
from drawing import COLUMN_WIDTH, PAGE_WIDTH, Sheet, caption_of
from words import csv_of, percent, seconds


class LooksTest(unittest.TestCase):
    def test_a_method_looks_the_same_in_every_run(self) -> None:
        known = {"HYBRID": "HYBRID", "EXTERNAL:getfem-nodes": "EXTERNAL:getfem-nodes", "NEWTON": "NEWTON"}
        for others in ({}, {"ALM": "ALM", "MINE:a": "MINE", "SYMMLQ:FLIC3": "SYMMLQ"}):
            looks = looks_of(others | known)
            self.assertEqual({name: looks[name][:3] for name in known}, {name: look[:3] for name, look in
                                                                       looks_of(known).items()})

    def test_no_two_of_a_run_look_alike(self) -> None:
        families = {f"{family}:{k}": family for family in ("SYMMLQ", "ALM", "MINE") for k in range(12)}
        looks = looks_of(families)
        self.assertEqual(len({look[:2] for look in looks.values()}), len(families))

    def test_values_of_a_programs_parameter_look_as_the_program(self) -> None:
        name = "EXTERNAL:calculix-penalty"
        looks = looks_of({name: name, f"{name}:penalty=50": name})
        self.assertEqual(*looks.values())


class SheetTest(unittest.TestCase):
    def test_panels_stand_one_above_the_other_in_a_column(self) -> None:
        for width, rows in ((PAGE_WIDTH, 1), (COLUMN_WIDTH, 2)):
            sheet = Sheet(width, "title", panels=2, key=[(f"method {k}", {}) for k in range(9)])
            self.assertEqual(len({panel.get_subplotspec().rowspan.start for panel in sheet.panels}), rows)

    def test_a_caption_has_a_title_and_paragraphs(self) -> None:
        text = caption_of("title", "word " * 60, "", "12\u00a0% done")
        self.assertEqual(text.split("\n\n")[0], "title")
        self.assertEqual(text.count("\n\n"), 2)
        self.assertLessEqual(max(map(len, text.splitlines())), 100)


class WordsTest(unittest.TestCase):
    def test_words_for_numbers(self) -> None:
        for value, words in ((0.0712, "7.1 %"), (0.2, "20 %"), (7e-4, "0.07 %"), (6e-6, "6e-6"),
                             (1.5, "1.5")):
            self.assertEqual(percent(value).replace("\u00a0", " "), words)
        for value, words in ((0.0031, "3.1 ms"), (0.25, "0.25 s"), (150, "150 s")):
            self.assertEqual(seconds(value).replace("\u00a0", " "), words)

    def test_cells(self) -> None:
        values = [(None, ""), (True, "true"), (0.1 + 0.2, "0.30000000000000004"), ("=1+1", "'=1+1"),
                  ("a,b", '"a,b"'), (-1.5, "-1.5")]
        text = csv_of([value for value, _ in values], ("value", lambda value: value))
        self.assertEqual(text.split("\n"),
                         ["value", *('""' if not cell else cell for _, cell in values), ""])
