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
            refined("EXTERNAL:x", 1, range(1), program="x 1", peak_rss_bytes=2**30))
        self.assertEqual(growth_figure.memory_of(ours), 2**22)
        self.assertEqual(growth_figure.memory_of(other), 2**30)

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
    def degrees(self, mesh: str = "Mesh0", **methods: int) -> list[dict]:
        """Levels on which each method has its degree."""
        return [made_up.case(f"{mesh}+adapt{level}", method, degree=degree, n_phi=800 * 2**level,
                             adapt_time_s=0.1 * 2**level, error_total=0.3 / 2**(degree * level))
                for method, degree in methods.items() for level in range(3)]

    def test_without_what_it_compares_a_figure_is_not_drawn(self) -> None:
        turned = [case | {"study": "error", "knob": "contact sweeps", "knob_value": 1, "error_discretisation": 0.01}
                  for case in levels("Mesh0", 3)]
        adapted, both = OverviewTest.ADAPTED, OverviewTest.BOTH
        penalty = [made_up.case(mesh, "EXTERNAL:x:penalty=5000", parameters="penalty=5000; direct", program="x 1",
                                in_displacements="true", error_total=0.03) for mesh in ("Mesh0", "Mesh1")]
        borrowed = self.degrees(HYBRID=1) + self.degrees(**{"HYBRID:k=2": 2})  # on the meshes of degree 1
        steps = [made_up.case("Mesh3", "ALM", load_steps=5, time_s=1)]
        for module, *rows in ((adaptive_figure, levels("Mesh0", 1), [made_up.case("Mesh0", "ALM")], turned),
                              (growth_figure, made_up.sizes_to_the_limit()),
                              (overview_figure, adapted, both, adapted + both[:1]),
                              (penalty_figure, penalty), (load_steps_figure, steps),
                              (degrees_figure, self.degrees(HYBRID=1, P2=1), borrowed)):
            for own in rows:
                self.assertEqual(list(module.drawings(made_up.read(own))), [], module.__name__)

    def test_a_degree_that_cannot_be_is_refused(self) -> None:
        for degree in (0, 1.5, "two"):
            with self.assertRaisesRegex(RecordsError, "degree is .*, expected a whole number, 1 or more"):
                made_up.read([made_up.case("Mesh0", "HYBRID", degree=degree)])
