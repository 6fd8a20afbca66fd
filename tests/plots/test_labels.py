"""Words, names and axes that all figures share.  /usr/bin/python3 -m unittest FILE"""
import unittest
from itertools import combinations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import running  # finds plots

from drawing import TYPE
from labels import Labels, crossing, spread
from words import csv_of, percent, seconds, wrapped


def labelled(places: np.ndarray) -> Labels:
    """A label at each of the places (n, 2) of a unit square."""
    axes = Figure(figsize=(6, 4)).add_axes([0.1, 0.1, 0.8, 0.8], xlim=(0, 1), ylim=(0, 1))
    labels = Labels(axes)
    for k, (x, y) in enumerate(places):
        labels.add(f"method {k}", x, y)
    return labels


class LabelsTest(unittest.TestCase):
    def test_they_keep_apart_and_inside(self) -> None:
        labels = labelled(np.random.default_rng(2).uniform(0, 1, (25, 2)))
        ends = labels.axes.get_window_extent().get_points() * 72 / labels.axes.figure.dpi
        for k, a in enumerate(labels.boxes):
            self.assertTrue((a[:2] >= ends[0] - 1e-9).all() and (a[2:] <= ends[1] + 1e-9).all())
            for b in labels.boxes[:k]:
                self.assertTrue((a[:2] >= b[2:]).any() or (b[:2] >= a[2:]).any())

    def test_leaders_of_crowded_ones_do_not_cross(self) -> None:
        seen = 0
        for seed in range(8):
            leaders = labelled(np.random.default_rng(seed).normal(0.5, 0.05, (14, 2))).leaders
            seen += len(leaders)
            for (a, b), (c, d) in combinations(leaders, 2):
                self.assertFalse(crossing(a, b, c, d), seed)
        self.assertGreater(seen, 20)

    def test_crossing(self) -> None:
        a, b, c, d = np.array([[0, 0], [2, 2], [0, 2], [2, 0]], float)
        self.assertTrue(crossing(a, b, c, d))
        self.assertFalse(crossing(a, c, b, d))
        self.assertFalse(crossing(a, b, a, d))  # a common end

    def test_a_column_is_spread_and_stays_inside(self) -> None:
        wanted = sorted(np.random.default_rng(1).uniform(0, 1, 9).tolist() + [0.5, 0.5])
        places = spread(wanted, 0.08, 0, 1)
        self.assertGreaterEqual(min(np.diff(places)), 0.08 - 1e-12)
        self.assertTrue(0 <= places[0] and places[-1] <= 1)
        self.assertEqual(spread([0.1, 0.9], 0.1, 0, 1), [0.1, 0.9])
        np.testing.assert_allclose(spread([0.5, 0.5], 0.1, 0, 1), [0.45, 0.55])


class WordsTest(unittest.TestCase):
    def test_wrapping_keeps_the_words_and_the_width(self) -> None:
        text = " ".join(["the quick brown fox, 12\u00a0% done,"] * 6)
        lines = wrapped([text], 2, TYPE)
        self.assertEqual(" ".join(lines), text)
        figure = Figure(figsize=(9, 9))
        renderer = FigureCanvasAgg(figure).get_renderer()
        for line in lines:
            words = figure.text(0, 0, line, fontsize=TYPE)
            self.assertLess(words.get_window_extent(renderer).width / figure.dpi, 2.1, line)
        self.assertLess(len(lines), 7)

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
