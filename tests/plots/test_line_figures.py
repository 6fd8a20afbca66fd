"""The figures that are lines over a size, of made-up records.  /usr/bin/python3 -m unittest FILE"""
import unittest

import made_up  # finds plots

import drawn
from figure import convergence as convergence_figure
from figure import error_time as error_figure
from figure import histories as histories_figure
from figure import load_steps as load_steps_figure
from figure import scaling as scaling_figure
from figure import size as size_figure
from records import RecordsError


def levels(mesh: str, count: int) -> list[dict]:
    """error = 100 / n_phi exactly."""
    return [made_up.case(f"{mesh}+adapt{level}", method, n_phi=1000 * 2**level, adapt_level=level,
                         adapt_time_s=0.1 * 2**level, error_total=0.1 / 2**level, time_s=0.02 * 2**level)
            for level in range(count) for method in ("HYBRID", "3STEPD")]


class ConvergenceTest(unittest.TestCase):
    def test_a_loop_has_the_errors_of_the_method_that_solves_its_levels(self) -> None:
        others = [made_up.case(f"Mesh0+adapt{level}", "P2", n_phi=1000 * 2**level, adapt_level=level,
                               adapt_time_s=0.1 * 2**level, error_total=0.01 / 2**level)
                  for level in range(4)]
        uniform = [made_up.case(mesh, "HYBRID", error_total=error, error_discretisation=error)
                   for mesh, error in (("Mesh0", 0.04), ("Mesh1", 0.02))]
        drawing = drawn.plan(made_up.read([*levels("Mesh0", 4), *others, *uniform]), "convergence")
        self.assertEqual([(name, errors) for name, _, errors in convergence_figure.lines_of(drawing.rows)],
                         [("as they are", [0.04, 0.02]), ("adapted by HYBRID", [0.1, 0.05, 0.025, 0.0125])])
        self.assertIn("adapted by HYBRID: -1.00", drawn.words_of(drawing.figure()))

    def test_rate(self) -> None:
        rows = made_up.read(made_up.error_study(["Mesh0", "Mesh1", "Mesh2", "Mesh3"], sweep=False))
        line, = convergence_figure.lines_of(rows)
        self.assertEqual([row.mesh for row in line[1]], ["Mesh0", "Mesh1", "Mesh2", "Mesh3"])
        self.assertAlmostEqual(convergence_figure.rate(line), -0.45, 6)


def refined(method: str, power: float, levels: range, **cells: object) -> list[dict[str, object]]:
    return [made_up.case(f"Mesh3+refine{k}", method, n_phi=6000 * 4**k, time_s=1e-6 * (6000 * 4**k)**power, **cells)
            for k in levels]


class SizeTest(unittest.TestCase):
    def test_exponents_are_those_of_the_large_ones_where_there_are_three(self) -> None:
        lines = size_figure.lines_of(made_up.read(refined("HYBRID:CG", 1.1, range(3, 6)) + refined("HYBRID", 1.4, range(5))
                                                  + refined("HYBRID:CG", 2, range(2))))
        time = size_figure.QUANTITIES[0]
        self.assertAlmostEqual(size_figure.power(lines["HYBRID:CG"], time), 1.1)
        self.assertAlmostEqual(size_figure.power(lines["HYBRID"], time), 1.4)

    def test_another_program_has_its_memory_elsewhere(self) -> None:
        ours, other = made_up.read(
            refined("HYBRID", 1, range(1)) +
            refined("EXTERNAL:x", 1, range(1), program="x 1", peak_rss_bytes=2**30))
        self.assertEqual((size_figure.memory_of(ours), size_figure.memory_of(other)), (4, 1024))


class ErrorTimeTest(unittest.TestCase):
    def lines(self, rows: list[dict]) -> dict:
        return error_figure.lines_of(drawn.plan(made_up.read(rows), "error_time").rows, error_figure.total_error)

    def test_an_adapted_mesh_costs_its_whole_loop(self) -> None:
        lines = self.lines(levels("Mesh0", 3))
        self.assertEqual([list(map(error_figure.time_of, line)) for line in lines.values()],
                         [[0.1 + 0.02, 0.2 + 0.04, 0.4 + 0.08], [0.1, 0.2, 0.4]])  # 3STEPD did not adapt it

    def test_a_line_is_the_front_of_a_parameters_values(self) -> None:
        rows = made_up.error_study(["Mesh1"])
        drawing = drawn.plan(made_up.read(rows), "error_time_forces")
        lines = error_figure.lines_of(drawing.rows, error_figure.own_error)
        for line in lines.values():
            for row in drawing.rows:
                if error_figure.name_of(row) == error_figure.name_of(line[0]):
                    self.assertLessEqual(min(other.error_force for other in line if other.time_s <= max(
                        row.time_s, line[0].time_s)), row.error_force)
        words = drawn.words_of(drawing.figure())
        self.assertIn("Stars: the paper's own stop", words)
        self.assertIn("P2 (in displacements, which have other contact forces)", words)

    def test_given_parameters_share_a_line(self) -> None:
        rows = [made_up.point("Mesh1", f"ALM:r={r},rho={r}", 0.1 * k, 0.1**k / r, knob="uzawa iterations", knob_value=k)
                for r in (1, 20, 300) for k in range(1, 5)]
        self.assertEqual([key[0] for key in self.lines(rows)], ["ALM, best of given r, ρ"])

    def test_values_of_a_programs_parameter_are_joined_on_each_mesh(self) -> None:
        rows = [made_up.case(mesh, f"EXTERNAL:x:penalty={value}", time_s=0.1 * value, error_total=0.1 / value,
                             parameters=f"penalty={value}; direct", program="x 1", family="EXTERNAL:x",
                             in_displacements="true") for value in (10, 1) for mesh in ("Mesh0", "Mesh1")]
        figure = drawn.plan(made_up.read(rows), "error_time").figure()
        self.assertEqual([axes.get_title() for axes in figure.panels], ["Mesh0", "Mesh1"])
        self.assertEqual(figure.panels[0].lines[0].get_xdata().tolist(), [0.1, 1])
        self.assertIn("x: penalty 1, 10", drawn.words_of(figure))


class HistoriesTest(unittest.TestCase):
    def test_residuals_of_the_largest_mesh(self) -> None:
        rows = made_up.read_lines([made_up.record(made_up.case(mesh, "ALM")) | {"histories": {
            "residual": [None, 1, 0.1], "once": [1]}} for mesh in ("Mesh0", "Mesh1")])
        drawing, = histories_figure.drawings(rows)
        self.assertEqual([(row["mesh"], row["history"], row["residual"]) for row in drawn.table_of(drawing)],
                         [("Mesh1", "residual", value) for value in ("", "1", "0.1")])
        axes, = drawing.figure().panels
        self.assertEqual(axes.get_title(), "residual")

    def test_what_is_no_history_is_refused(self) -> None:
        with self.assertRaisesRegex(RecordsError, "histories is .*, expected an object of lists of numbers"):
            made_up.read_lines([made_up.record(made_up.case("Mesh0", "ALM")) | {"histories": {"residual": 1}}])


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
        steps = [made_up.case("Mesh3", "ALM", load_steps=5, time_s=1)]
        alone = [made_up.case("Mesh0", "HYBRID", error_total=0.04)]
        for module, *rows in ((convergence_figure, levels("Mesh0", 1), alone), (error_figure, alone),
                              (size_figure, alone, levels("Mesh0", 3)), (load_steps_figure, steps),
                              (histories_figure, alone)):
            for own in rows:
                self.assertEqual(list(module.drawings(made_up.read(own))), [], module.__name__)

    def test_a_degree_that_cannot_be_is_refused(self) -> None:
        for degree in (0, 1.5, "two"):
            with self.assertRaisesRegex(RecordsError, "degree is .*, expected a whole number, 1 or more"):
                made_up.read([made_up.case("Mesh0", "HYBRID", degree=degree)])
