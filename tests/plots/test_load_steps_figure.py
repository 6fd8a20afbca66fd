"""The figure of load steps, of made-up records.  /usr/bin/python3 -m unittest FILE"""
import csv
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import made_up  # noqa: E402; finds plots

import drawn  # noqa: E402
import load_steps_figure  # noqa: E402
import records  # noqa: E402

STEPS = (1, 5, 20)
COSTS = {"3STEPD:CHOLMOD": (0.13, 0.02), "ALM": (0, 0.1)}  # once, and each step


def rows_of(cells: dict | None = None) -> list:
    made = [made_up.case("Mesh3", method, study="load-steps", scene=f"steps_{count:02d}",
                         load_steps=count, time_s=once + count * each, time_once_s=once or 1e-3,
                         time_per_load_s=each) | (cells or {})
            for method, (once, each) in COSTS.items() for count in STEPS]
    folder = Path(tempfile.mkdtemp())
    columns = [*made_up.COLUMNS, "load_steps", "time_once_s", "time_per_load_s"]
    made_up.write(folder / "results.csv", made, list(dict.fromkeys(columns)))
    return records.rows_of(records.read_run(folder))


class LoadSteps(unittest.TestCase):
    def test_a_curve_per_method_over_its_steps(self) -> None:
        (drawing,) = load_steps_figure.drawings(rows_of())
        figure = drawing.draw(drawing.rows)
        (axes,) = [axes for axes in figure.axes if axes.get_xlabel()]
        curves = [line for line in axes.lines if len(line.get_xdata()) == len(STEPS)]
        self.assertEqual(len(curves), len(COSTS))
        for line, (once, each) in zip(sorted(curves, key=lambda line: -line.get_ydata()[0]),
                                      sorted(COSTS.values(), key=lambda cost: -sum(cost))):
            self.assertEqual(tuple(line.get_xdata()), STEPS)
            self.assertAlmostEqual(line.get_ydata()[-1], once + STEPS[-1] * each)
        for method in COSTS:
            self.assertIn(method, drawn.words_of(figure))

    def test_its_numbers_stand_beside_it(self) -> None:
        (drawing,) = load_steps_figure.drawings(rows_of())
        table = list(csv.DictReader(drawing.table(drawing.rows).splitlines()))
        self.assertEqual(len(table), len(COSTS) * len(STEPS))
        self.assertEqual(table[0].keys(), set(load_steps_figure.COLUMNS))

    def test_without_a_time_it_says_so(self) -> None:
        (drawing,) = load_steps_figure.drawings(rows_of(dict(status="timeout", time_s="")))
        self.assertIn("has a time", drawing.draw(drawing.rows))

    def test_other_runs_have_none(self) -> None:
        self.assertEqual(list(load_steps_figure.drawings(rows_of(dict(study="")))), [])


if __name__ == "__main__":
    unittest.main()
