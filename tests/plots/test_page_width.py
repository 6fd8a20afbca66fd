"""Figures at the width of a page, and the numbers next to them.  /usr/bin/python3 -m unittest FILE"""
import csv
import unittest
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

import made_up  # finds plots

import drawn
import figures
from drawing import COLUMN_WIDTH, PAGE_WIDTH, STYLE

PAGE_PIXELS = 830
LEGIBLE = 9  # pixels


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        cls.rows = made_up.read_lines(made_up.of_all_kinds())
        cls.drawings = {drawing.name: drawing for drawing in figures.drawings_of(cls.rows)}
        cls.figures = {name: figure for name, drawing in cls.drawings.items()
                       if isinstance(figure := drawing.figure(), Figure)}
        with drawn.without_minor_ticks():
            cls.painted = {name: drawn.paint(figure) for name, figure in cls.figures.items()}

    def test_all_kinds_of_figures_are_here(self) -> None:
        modules = {path.stem for path in Path(figures.__file__).parent.glob("figure/*.py")}
        used = {drawing.draw.__module__.removeprefix("figure.") for name, drawing in self.drawings.items()
                if name in self.figures}
        self.assertEqual(used, modules)

    def test_for_a_paper_all_but_tables_are_as_wide_as_a_column(self) -> None:
        with drawn.without_minor_ticks():
            for name in ("size", "error_time", "scaling"):
                figure = self.drawings[name].figure(COLUMN_WIDTH)
                self.assertEqual(figure.get_size_inches()[0], COLUMN_WIDTH)
                drawn.assert_readable(self, figure, *drawn.paint(figure))

    def test_a_caption_stands_beside_every_figure(self) -> None:
        for name, figure in self.figures.items():
            self.assertIn(".txt", self.drawings[name].writers(figure, False), name)
            self.assertGreater(len(figure.caption.splitlines()), 2, name)

    def test_type_can_be_read_at_the_width_of_a_page(self) -> None:
        for name, figure in self.figures.items():
            width = figure.get_size_inches()[0]
            self.assertLessEqual(width, PAGE_WIDTH, name)
            for words in self.painted[name][0]:
                pixels = words.get_fontsize() / 72 / width * PAGE_PIXELS
                self.assertGreaterEqual(pixels, LEGIBLE, f"{name}: {words}")

    def test_words_are_on_the_sheet_and_apart(self) -> None:
        for name, figure in self.figures.items():
            with self.subTest(name):
                drawn.assert_readable(self, figure, *self.painted[name])

    def test_the_numbers_of_every_figure_stand_beside_it(self) -> None:
        for name, figure in self.figures.items():
            drawing = self.drawings[name]
            lines = list(csv.reader(drawing.table(drawing.rows).splitlines()))
            self.assertEqual(len(lines[0]), len(set(lines[0])), name)
            self.assertEqual({len(line) for line in lines}, {len(lines[0])}, name)
            self.assertGreater(len(lines), 1, name)
            self.assertTrue({"mesh", "method"} & set(lines[0]), name)

    def points(self, name: str, axes: int) -> set[tuple[float, float]]:
        return {tuple(point) for line in self.figures[name].axes[axes].lines
                for point in line.get_xydata()}

    def test_what_is_drawn_is_what_is_written(self) -> None:
        for name, x, y, scale in (("size", "n_phi", "memory_MiB", 1),
                                  ("bounds", "n_phi", "lower_bound_Nmm", 1),
                                  ("bounds", "n_phi", "upper_bound_Nmm", 1),
                                  ("bounds", "n_phi", "relative_gap", 1),
                                  ("size", "n_phi", "time_s", 1),
                                  ("load_steps", "load_steps", "time_s", 1)):
            points = np.array([point for k in range(len(self.figures[name].axes))
                              for point in self.points(name, k)])
            for line in drawn.table_of(self.drawings[name]):
                if float(line[y]):
                    wanted = float(line[x]) * scale, float(line[y])
                    self.assertTrue(np.isclose(points, wanted, rtol=1e-12, atol=0).all(1).any(),
                                    f"{name}: {line}")
