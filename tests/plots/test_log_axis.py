"""A logarithmic axis has labels, and they do not touch, however narrow it is."""
import sys
import unittest
from itertools import pairwise
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "plots"))
import figure_parts  # noqa: E402


class LogAxisTest(unittest.TestCase):
    def test_labels_do_not_touch(self) -> None:
        for inches in (0.9, 1.2, 1.8, 3, 6):
            for low, high in ((15, 1700), (2, 150), (300, 2000), (1e3, 6e6)):
                with self.subTest(inches=inches, low=low, high=high):
                    figure = Figure((inches + 1, 3))
                    axes = figure_parts.axes_at(figure, 0.5, 0.3, inches, 2)
                    figure_parts.log_log(axes, xlim=(low, high), ylim=(1, 10))
                    FigureCanvasAgg(figure).draw()
                    boxes = [label.get_window_extent() for place, label in
                             zip(axes.get_xticks(), axes.get_xticklabels()) if low <= place <= high]
                    self.assertGreaterEqual(len(boxes), 1)
                    for left, right in pairwise(boxes):
                        self.assertLess(left.x1, right.x0)


if __name__ == "__main__":
    unittest.main()
