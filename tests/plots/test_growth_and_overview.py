"""The figures of growth and of the overview, of made-up records.  /usr/bin/python3 -m unittest FILE"""
import csv
import io
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import made_up  # noqa: E402; finds plots

import drawn  # noqa: E402
import growth_figure  # noqa: E402
import overview_figure  # noqa: E402
import records  # noqa: E402


class FiguresTest(unittest.TestCase):
    def read(self, rows: list[dict[str, object]]) -> list[records.Row]:
        folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        made_up.write(folder / "results.csv", rows)
        return records.rows_of(records.read(folder / "results.csv"))


def refined(method: str, power: float, levels: range, **cells: object) -> list[dict[str, object]]:
    return [made_up.case(f"Mesh3+refine{k}", method, n_phi=6000 * 4**k, time_s=1e-6 * (6000 * 4**k)**power,
                         error_stress="" if k > 3 else 1e-12, error_estimate=1e-7, **cells)
            for k in levels]


class GrowthTest(FiguresTest):
    def test_exponents_are_those_of_the_large_ones(self) -> None:
        rows = self.read(refined("HYBRID:CG", 1.1, range(6)) + refined("HYBRID", 1.4, range(4)))
        lines = growth_figure.lines_of(rows)
        time = growth_figure.PANELS[0]
        self.assertAlmostEqual(growth_figure.power(lines["HYBRID:CG"], time), 1.1)
        self.assertIsNone(growth_figure.power(lines["HYBRID"], time))  # one mesh above the limit

    def test_another_program_has_its_memory_elsewhere(self) -> None:
        ours, other = self.read(
            refined("HYBRID", 1, range(1)) +
            refined("EXTERNAL:x", 1, range(1), program="x 1", peak_rss_bytes=2.0**30))
        self.assertEqual(growth_figure.memory_of(ours), 2.0**22)
        self.assertEqual(growth_figure.memory_of(other), 2.0**30)

    def test_an_error_without_a_reference_is_the_methods_word(self) -> None:
        drawing, = growth_figure.drawings(self.read(refined("HYBRID:CG", 1, range(5))))
        table = list(csv.DictReader(io.StringIO(drawing.table(drawing.rows))))
        self.assertEqual([(row["error"], row["error_is_estimated"]) for row in table[3:]],
                         [("1e-12", "false"), ("1e-07", "true")])
        self.assertIn("HYBRID:CG: $n^{1.00}$", drawn.words_of(drawing.draw(drawing.rows)))

    def test_without_refined_meshes_there_is_none(self) -> None:
        self.assertEqual(list(growth_figure.drawings(self.read(made_up.sizes_to_the_limit()))), [])


class OverviewTest(FiguresTest):
    ADAPTED = [made_up.case(f"Mesh0+adapt{k}", "HYBRID", n_phi=800 * 2**k, error_total=0.04 / 2**k,
                            time_s=0.01 * 2**k, adapt_time_s=0.03 * 2**k) for k in range(3)]
    BOTH = [made_up.case("Mesh0", "ALM", stop=stop, error_total=0.04, time_s=0.02)
            for stop in ("target", "paper")]

    def test_a_curve_each(self) -> None:
        paper_direct = made_up.case("Mesh0", "3STEPD", stop="paper", error_total=0.04)
        drawing, = overview_figure.drawings(self.read(self.ADAPTED + self.BOTH + [paper_direct]))
        curves = overview_figure.curves_of(drawing.rows)
        self.assertEqual({curve.words for curve in curves},
                         {"ALM, the paper’s stop", "ALM to 1e-6", "HYBRID, adapted meshes"})
        self.assertEqual(overview_figure.loop_of(drawing.rows),
                         [(0.03, 0.04), (0.06, 0.02), (0.12, 0.01)])
        words = drawn.words_of(drawing.draw(drawing.rows))
        for curve in curves:
            self.assertIn(curve.words, words)

    def test_it_needs_both_stops_and_adapted_meshes(self) -> None:
        for rows in (self.ADAPTED, self.BOTH, self.ADAPTED + self.BOTH[:1]):
            self.assertEqual(list(overview_figure.drawings(self.read(rows))), [])


if __name__ == "__main__":
    unittest.main()
