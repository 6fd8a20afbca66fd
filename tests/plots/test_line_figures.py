"""The figures that are lines over a size, of made-up records.  /usr/bin/python3 -m unittest FILE"""
import unittest

import made_up  # finds plots

import drawn
from figure import adaptive as adaptive_figure
from figure import degrees as degrees_figure
from figure import growth as growth_figure
from figure import load_steps as load_steps_figure
from figure import overview as overview_figure
from figure import peers_penalty as penalty_figure
from figure import scaling as scaling_figure
from records import RecordsError


def levels(mesh: str, count: int) -> list[dict]:
    """error = 100 / n_phi exactly."""
    return [made_up.case(f"{mesh}+adapt{level}", method, n_phi=1000 * 2**level, adapt_level=level,
                         adapt_time_s=0.1 * 2**level, error_total=0.1 / 2**level, time_s=0.02 * 2**level)
            for level in range(count) for method in ("HYBRID", "3STEPD")]


class AdaptiveTest(unittest.TestCase):
    def test_adapted_meshes_are_beside_those_of_their_body_with_their_rate(self) -> None:
        uniform = [made_up.case(mesh, "HYBRID", error_total=0.04 / (k + 1))
                   for k, mesh in enumerate(("Mesh0", "Mesh1"))]
        rows = made_up.read([*levels("Mesh0", 5), *uniform])
        self.assertEqual({"one tooth"}, {row.body for row in rows})
        drawing = drawn.plan(rows, "adaptive")
        self.assertEqual(len(rows), len(drawing.rows))
        words = drawn.words_of(drawing.figure())
        for expected in ("adapted: $N^{-1.00}$", "as they are", "whole loop", "one tooth"):
            self.assertIn(expected, words)

    def test_a_loop_has_the_errors_of_the_method_that_solves_its_levels(self) -> None:
        others = [made_up.case(f"Mesh0+adapt{level}", "P2", n_phi=1000 * 2**level, adapt_level=level,
                               adapt_time_s=0.1 * 2**level, error_total=0.01 / 2**level)
                  for level in range(4)]
        uniform = [made_up.case(mesh, method, error_total=error) for mesh in ("Mesh0", "Mesh1")
                   for method, error in (("HYBRID", 0.04), ("P2", 0.004))]
        figure = drawn.plan(made_up.read([*levels("Mesh0", 4), *others, *uniform]), "adaptive").figure()
        self.assertIn("errors of HYBRID, which solves the levels", drawn.words_of(figure).replace("\n", " "))
        unknowns, times = figure.axes[:2]
        errors = [line.get_ydata().tolist() for line in unknowns.lines]
        self.assertEqual(errors, [[0.04, 0.04], [0.1, 0.05, 0.025, 0.0125]])
        loop, = (line for line in times.lines if line.get_linewidth() == 2)
        self.assertEqual(loop.get_ydata().tolist(), errors[1])


def refined(method: str, power: float, levels: range, **cells: object) -> list[dict[str, object]]:
    return [made_up.case(f"Mesh3+refine{k}", method, n_phi=6000 * 4**k, time_s=1e-6 * (6000 * 4**k)**power,
                         error_stress="" if k > 3 else 1e-12, error_estimate=1e-7, **cells)
            for k in levels]


class GrowthTest(unittest.TestCase):
    def test_exponents_are_those_of_the_large_ones(self) -> None:
        rows = made_up.read(refined("HYBRID:CG", 1.1, range(6)) + refined("HYBRID", 1.4, range(4)))
        lines = growth_figure.lines_of(rows)
        time = growth_figure.PANELS[0]
        self.assertAlmostEqual(growth_figure.power(lines["HYBRID:CG"], time), 1.1)
        self.assertIsNone(growth_figure.power(lines["HYBRID"], time))  # one mesh above the limit

    def test_another_program_has_its_memory_elsewhere(self) -> None:
        ours, other = made_up.read(
            refined("HYBRID", 1, range(1)) +
            refined("EXTERNAL:x", 1, range(1), program="x 1", peak_rss_bytes=2.0**30))
        self.assertEqual(growth_figure.memory_of(ours), 2.0**22)
        self.assertEqual(growth_figure.memory_of(other), 2.0**30)

    def test_an_error_without_a_reference_is_the_methods_word(self) -> None:
        drawing, = growth_figure.drawings(made_up.read(refined("HYBRID:CG", 1, range(5))))
        table = drawn.table_of(drawing)
        self.assertEqual([(row["error"], row["error_is_estimated"]) for row in table[3:]],
                         [("1e-12", "false"), ("1e-07", "true")])
        self.assertIn("HYBRID:CG: $n^{1.00}$", drawn.words_of(drawing.figure()))


class OverviewTest(unittest.TestCase):
    ADAPTED = [made_up.case(f"Mesh0+adapt{k}", "HYBRID", n_phi=800 * 2**k, error_total=0.04 / 2**k,
                            time_s=0.01 * 2**k, adapt_time_s=0.03 * 2**k) for k in range(3)]
    BOTH = [made_up.case("Mesh0", "ALM", stop=stop, error_total=0.04, time_s=0.02)
            for stop in ("target", "paper")]

    def test_a_curve_each(self) -> None:
        paper_direct = made_up.case("Mesh0", "3STEPD", stop="paper", error_total=0.04)
        drawing, = overview_figure.drawings(made_up.read(self.ADAPTED + self.BOTH + [paper_direct]))
        curves = overview_figure.curves_of(drawing.rows)
        self.assertEqual({curve.words for curve in curves},
                         {"ALM, the paper’s stop", "ALM to 1e-6", "HYBRID, adapted meshes"})
        self.assertEqual(overview_figure.loops_of(drawing.rows),
                         [[(0.03, 0.04), (0.06, 0.02), (0.12, 0.01)]])
        words = drawn.words_of(drawing.figure())
        for curve in curves:
            self.assertIn(curve.words, words)


class PeersPenaltyTest(unittest.TestCase):
    ERRORS = {"50": 0.3, "500": 0.04, "5000": 0.03}

    def rows(self, meshes: tuple[str, ...] = ("Mesh0", "Mesh1")) -> list[dict]:
        body = dict(in_displacements="true", program="x 1", family="EXTERNAL:x", error_stress="", error_force="")
        sweep = [made_up.case(mesh, f"EXTERNAL:x:penalty={value}", time_s=0.2 * k + 0.1, error_discretisation=error,
                              status="inaccurate" if value == "50" else "ok", outcome="ok",
                              error_total="" if value == "50" else error,
                              parameters=f"penalty={value}; direct", **body)
                 for mesh in meshes for k, (value, error) in enumerate(self.ERRORS.items())]
        others = [made_up.case(mesh, method, time_s=1e-3, error_total=0.02)
                  for mesh in meshes for method in ("P2", "HYBRID", "3STEPD")]
        single = made_up.case("Mesh0", "EXTERNAL:y", error_total=0.1, **body | {"family": "EXTERNAL:y"})
        return [*sweep, *others, single]

    def test_a_line_per_program_by_value(self) -> None:
        drawing, = penalty_figure.drawings(made_up.read(self.rows()))
        figure = drawing.figure()
        self.assertEqual([axes.get_title() for axes in figure.axes], ["Mesh0", "Mesh1"])
        for axes in figure.axes:
            sweep, = (line for line in axes.lines if len(line.get_xdata()) == 3)
            self.assertEqual(list(sweep.get_ydata()), list(self.ERRORS.values()))
            self.assertEqual({text.get_text() for text in axes.texts},
                             {"x", "50", "500", "5000", "P2", "HYBRID", *["y"] * (axes.get_title() == "Mesh0")})
            hollow = [line for line in axes.lines if line.get_markerfacecolor() == "white"]
            self.assertEqual([line.get_ydata()[0] for line in hollow], [0.3])  # what is not ok
        words = drawn.words_of(figure)
        self.assertIn("(x: penalty)", words)
        self.assertIn("3STEPD (not in displacements)", words)
        painted, renderer = drawn.paint(figure)
        drawn.assert_readable(self, figure, painted, renderer)


class DegreesTest(unittest.TestCase):
    METHODS = {"HYBRID": 1, "HYBRID:k=2": 2, "HYBRID:k=3": 3, "HYBRID:k=4": 4}
    BODIES = (("Mesh0", "default"), ("Mesh4", "default"), ("L", "L"), ("cylinder", "pressed"),
              ("ring", "ring"))

    def levels(self, mesh: str, scene: str, methods: dict[str, int], **cells: object) -> list[dict]:
        return [made_up.case(f"{mesh}+adapt{level}" + f"k{degree}" * method.startswith("HYBRID:k="),
                             method, scene=scene, degree=degree,
                             n_phi=800 * 2**level, adapt_time_s=0.1 * degree * 2**level,
                             error_total=0.3 / 2**(degree * level)) | cells
                for method, degree in methods.items() for level in range(3)]

    def test_a_panel_for_each_of_four_bodies_and_a_line_for_each_degree(self) -> None:
        rows = [case for body in self.BODIES for case in self.levels(*body, self.METHODS)]
        drawing = drawn.plan(made_up.read(rows), "degrees")
        figure = drawing.figure()
        self.assertEqual([axes.get_title() for axes in figure.axes],
                         ["one tooth", "rack of four teeth", "L", "cylinder, scene pressed"])
        self.assertIn("Bodies not drawn: ring.", drawn.words_of(figure))
        for axes in figure.axes:
            words = {text.get_text() for text in axes.texts}
            self.assertEqual(words, {f"HYBRID, degree {k}" for k in range(1, 5)})
            curves = [line for line in axes.lines if len(line.get_xdata()) == 3]
            self.assertEqual(len({line.get_color() for line in curves}), 4)
            self.assertEqual(len({line.get_marker() for line in curves}), 4)
            self.assertEqual({round(line.get_xdata()[0], 9) for line in curves}, {0.1, 0.2, 0.3, 0.4})  # whole loops
        painted, renderer = drawn.paint(figure)
        drawn.assert_readable(self, figure, painted, renderer)
        self.assertEqual({line["degree"] for line in drawn.table_of(drawing)}, set("1234"))

    def test_a_degree_that_cannot_be_is_refused(self) -> None:
        for degree in (0, 1.5, "two"):
            with self.assertRaisesRegex(RecordsError, "degree is .*, expected a whole number from 1 on"):
                made_up.read(self.levels("Mesh0", "default", {"HYBRID": 1}, degree=degree))


STEPS = (1, 5, 20)
COSTS = {"3STEPD:CHOLMOD": (0.13, 0.02), "ALM": (0, 0.1)}  # once, and each step


def paths(cells: dict | None = None) -> list:
    made = [made_up.case("Mesh3", method, study="load-steps", scene=f"steps_{count:02d}",
                         load_steps=count, time_s=once + count * each, time_once_s=once or 1e-3,
                         time_per_load_s=each) | (cells or {})
            for method, (once, each) in COSTS.items() for count in STEPS]
    return made_up.read(made)


class LoadStepsTest(unittest.TestCase):
    def test_a_curve_per_method_over_its_steps(self) -> None:
        (drawing,) = load_steps_figure.drawings(paths())
        figure = drawing.figure()
        (axes,) = [axes for axes in figure.axes if axes.get_xlabel()]
        curves = [line for line in axes.lines if len(line.get_xdata()) == len(STEPS)]
        self.assertEqual(len(curves), len(COSTS))
        for line, (once, each) in zip(sorted(curves, key=lambda line: -line.get_ydata()[0]),
                                      sorted(COSTS.values(), key=lambda cost: -sum(cost))):
            self.assertEqual(tuple(line.get_xdata()), STEPS)
            self.assertAlmostEqual(line.get_ydata()[-1], once + STEPS[-1] * each)
        for method in COSTS:
            self.assertIn(method, drawn.words_of(figure))

# Mesh2 has 3105 unknowns, Mesh3 6287: 1.012 times the double.
THREADED = {("Mesh2", 1): 1.0, ("Mesh2", 2): 0.6, ("Mesh3", 1): 3.0, ("Mesh3", 2): 1.6}
GROWTH = 6287 / 3105


def threaded(times: dict = THREADED, **cells: object) -> list[dict]:
    return [made_up.record(made_up.case(mesh, "3STEPD", study="scaling", knob="threads",
                                        knob_value=threads, threads=threads, time_s=time,
                                        noise_kernel_s=0.001, busy_kernel_s=0.0011) | cells)
            | {"samples_s": [time] * 5} for (mesh, threads), time in times.items()]


class ScalingTest(unittest.TestCase):
    def points(self, cases: list[dict]) -> dict:
        return {(point.row.mesh, point.row.threads): point for point in scaling_figure.points_of(made_up.read_lines(cases))}

    def test_by_hand(self) -> None:
        points = self.points(threaded())
        for case, speed_up, efficiency in ((("Mesh2", 1), 1, 1), (("Mesh2", 2), 1 / 0.6, 1 / 1.2),
                                           (("Mesh3", 2), 3 / 1.6, 3 / 3.2)):
            self.assertAlmostEqual(points[case].speed_up, speed_up)
            self.assertAlmostEqual(points[case].speed_up_low, speed_up)  # samples without scatter
            self.assertAlmostEqual(points[case].efficiency, efficiency)
        weak = points["Mesh3", 2]
        self.assertEqual(weak.weak_from, "Mesh2")
        self.assertAlmostEqual(weak.weak_growth, GROWTH / 2)
        self.assertAlmostEqual(weak.weak_one_thread, GROWTH / 3)
        # Unknowns per second and thread over those of one thread on the small mesh.
        self.assertAlmostEqual(weak.weak_efficiency, (6287 / (2 * 1.6)) / (3105 / 1.0))
        self.assertEqual(points["Mesh2", 1].weak_efficiency, 1)
        self.assertIsNone(points["Mesh2", 2].weak_efficiency)
        self.assertAlmostEqual(weak.busy_kernel_ratio, 1.1)

    def test_a_mesh_that_did_not_grow_with_the_threads_is_no_point(self) -> None:
        times = {(mesh, threads): 1.0 for mesh in ("Mesh0", "Mesh3") for threads in (1, 2, 4)}
        self.assertEqual([case for case, point in self.points(threaded(times)).items()
                          if point.weak_from], [("Mesh0", 1)])

    def test_one_sample_has_no_efficiency(self) -> None:
        cases = threaded()
        cases[-1] |= {"repetitions": 1, "samples_s": [1.6]}
        point = self.points(cases)["Mesh3", 2]
        self.assertEqual((point.speed_up, point.efficiency, point.weak_efficiency), (None,) * 3)
        (drawing,) = scaling_figure.drawings(made_up.read_lines(threaded(repetitions=1)))
        self.assertIn("one sample gives no efficiency", drawing.figure())

    def test_nothing_is_said_without_one_thread_or_a_solution(self) -> None:
        for cases in (threaded({("Mesh3", 2): 1.0}), threaded(status="inaccurate", outcome="inaccurate")):
            self.assertEqual({point.speed_up for point in self.points(cases).values()}, {None})


class NoneTest(unittest.TestCase):
    def test_without_what_it_compares_a_figure_is_not_drawn(self) -> None:
        turned = [case | {"study": "error", "knob": "contact sweeps", "knob_value": 1, "error_discretisation": 0.01}
                  for case in levels("Mesh0", 3)]
        adapted, both = OverviewTest.ADAPTED, OverviewTest.BOTH
        penalty = [row for row in PeersPenaltyTest().rows() if not row["method"].endswith(("=50", "=500"))]
        of_degrees = DegreesTest().levels
        borrowed = [case | {"mesh": case["mesh"].removesuffix("k2")}
                    for case in of_degrees("Mesh0", "default", {"HYBRID:k=2": 2})]
        steps = [made_up.case("Mesh3", "ALM", load_steps=5, time_s=1)]
        for module, *rows in ((adaptive_figure, levels("Mesh0", 1), [made_up.case("Mesh0", "ALM")], turned),
                              (growth_figure, made_up.sizes_to_the_limit()),
                              (overview_figure, adapted, both, adapted + both[:1]),
                              (penalty_figure, penalty), (load_steps_figure, steps),
                              (degrees_figure, of_degrees("Mesh0", "default", {"HYBRID": 1, "P2": 1}),
                               of_degrees("Mesh0", "default", {"HYBRID": 1}) + borrowed)):
            for own in rows:
                self.assertEqual(list(module.drawings(made_up.read(own))), [], module.__name__)
