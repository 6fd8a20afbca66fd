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


def of_all_kinds() -> list[dict]:
    """Lines of records of an ordinary run and of every study."""
    rows = made_up.error_study(["Mesh0", "Mesh1", "Mesh4"]) + made_up.stability_study("Mesh0")
    rows += made_up.sizes_to_the_limit()
    rows += [made_up.case("Mesh1", f"{family}:{name}") for family in ("SYMMLQ", "3STEPCG")
             for name in ("DTIC4", "FLIC2", "SSOR1.0", "NONE")]
    rows += [made_up.case("Mesh3", method, study="load-steps", scene=f"steps_{n:02d}",
                          load_steps=n, time_s=0.1 * k + 0.01 * n) for n in (1, 5, 20)
             for k, method in enumerate(("3STEPD", "ALM"))]
    rows += [made_up.case(f"Mesh{k}", method, study="scaling", threads=p, knob="threads", knob_value=p,
                          time_s=0.1 * k / (1 + 0.3 * m * (p - 1)))
             for k in (4, 5, 6, 7) for p in (1, 2, 4, 6)
             for m, method in enumerate(("3STEPD", "BLIND", "SDTIC6"))]
    rows += [made_up.case(f"Mesh{k}+adapt{level}", method, study="adapted", n_phi=900 * 2**level,
                          error_discretisation=0.1, condition_estimate=1e9)
             for k in (0, 4) for level in range(4) for method in ("HYBRID", "3STEPD:CHOLMOD")]
    rows += [made_up.case(f"Mesh0+adapt{level}", "HYBRID", n_phi=900 * 2**level, adapt_level=level,
                          adapt_time_s=0.1 * 2**level, error_total=0.1 / 2**level,
                          time_s=0.02 * 2**level, lower_bound_Nmm=27 - 0.1 / 4**level,
                          upper_bound_Nmm=27 + 0.2 / 4**level) for level in range(4)]
    rows += [made_up.case(f"L+adapt{level}" + "k2" * (degree == 2), method, scene="L", degree=degree,
                          adapt_time_s=0.1 * 2**level, error_total=0.1 / 2**(degree * level))
             for level in range(4)
             for method, degree in (("HYBRID", 1), ("HYBRID:k=2", 2), ("P2", 1))]
    rows += [made_up.case(mesh, "ALM:AUTO", stop=stop, time_s=time_s * slower, error_total=error)
             for stop, slower in (("target", 5), ("paper", 1))
             for mesh, time_s, error in (("Mesh0", 0.01, 0.04), ("Mesh1", 0.05, 0.02))]
    rows += [made_up.case(f"Mesh3+refine{k}", method, n_phi=6287 * 4**k, time_s=0.01 * 5**k * m,
                          peak_heap_bytes=int(2**23 * 4.2**k), linear_iterations=40 + k,
                          error_stress="" if k == 4 else 1e-12, error_estimate=1e-8)
             for k in range(1, 5) for m, method in enumerate(("HYBRID", "HYBRID:CG"), 1)]
    rows += [made_up.case(mesh, "3STEPD", study="contact", scene=scene, contact_solver=solver,
                          stage_contact_s=0.01, contact_iterations=20) for mesh in ("Mesh0", "Mesh1")
             for scene in ("default", "friction_10") for solver in ("newton", "admm")]
    rows += [made_up.case("Mesh0", f"EXTERNAL:x:penalty={value}", time_s=0.1 * value, error_total=0.1 / value,
                          parameters=f"penalty={value}; direct", program="x 1", family="EXTERNAL:x",
                          in_displacements="true") for value in (1, 10)]
    split = [made_up.split("Mesh0", method, factor=(3, 2)) for method in ("BLIND:LEAN", "NEWTON")]
    told = [made_up.record(made_up.case("Mesh2", method)) | {"histories": {"residual": [1, 0.1, 1e-3, None]}}
            for method in ("BLIND:SKY", "SSKY")]
    return [made_up.record(row) for row in rows] + split + told


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        cls.rows = made_up.read_lines(of_all_kinds())
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
