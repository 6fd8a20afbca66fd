"""The figure of adapted meshes, of made-up records.  /usr/bin/python3 -m unittest FILE"""
import csv
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import made_up  # noqa: E402; finds plots

import adaptive_figure  # noqa: E402
import drawn  # noqa: E402
import records  # noqa: E402
from figures import drawings_of  # noqa: E402


def rows_of(cases: list[dict]) -> list:
    with tempfile.TemporaryDirectory() as folder:
        with (Path(folder) / "results.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, made_up.COLUMNS)
            writer.writeheader()
            writer.writerows(cases)
        return records.rows_of(records.read_run(Path(folder)))


def levels(mesh: str, count: int) -> list[dict]:
    """error = 100 / n_phi exactly."""
    return [made_up.case(f"{mesh}+adapt{level}", method, n_phi=1000 * 2**level, adapt_level=level,
                         adapt_time_s=0.1 * 2**level, error_total=0.1 / 2**level, time_s=0.02 * 2**level)
            for level in range(count) for method in ("HYBRID", "3STEPD")]


class AdaptiveFigure(unittest.TestCase):
    def test_adapted_meshes_are_beside_those_of_their_body_with_their_rate(self) -> None:
        uniform = [made_up.case(mesh, "HYBRID", error_total=0.04 / (k + 1))
                   for k, mesh in enumerate(("Mesh0", "Mesh1"))]
        rows = rows_of([*levels("Mesh0", 5), *uniform])
        self.assertEqual({"one tooth"}, {row.body for row in rows})
        plan = [d for d in drawings_of(rows) if d.name == "adaptive"]
        self.assertEqual([len(rows)], [len(d.rows) for d in plan])
        words = drawn.words_of(plan[0].draw(plan[0].rows))
        for expected in ("adapted: $N^{-1.00}$", "as they are", "whole loop", "one tooth"):
            self.assertIn(expected, words)

    def test_without_two_levels_there_is_none(self) -> None:
        self.assertEqual([], list(adaptive_figure.drawings(rows_of(levels("Mesh0", 1)))))
        self.assertEqual([], list(adaptive_figure.drawings(rows_of([made_up.case("Mesh0", "ALM")]))))

    def test_points_of_a_turned_knob_are_not_a_methods_own(self) -> None:
        turned = [case | {"study": "error", "knob": "contact sweeps", "knob_value": 1,
                          "error_discretisation": 0.01} for case in levels("Mesh0", 3)]
        self.assertEqual([], list(adaptive_figure.drawings(rows_of(turned))))


if __name__ == "__main__":
    unittest.main()
