"""Strong and weak scaling of made-up records.  /usr/bin/python3 -m unittest FILE"""
import csv
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import made_up  # noqa: E402; finds plots

import drawn  # noqa: E402
import records  # noqa: E402
import scaling_figure  # noqa: E402
from scaling import points_of  # noqa: E402

# Mesh2 has 3105 unknowns, Mesh3 6287: 1.012 times the double.
TIMES = {("Mesh2", 1): 1.0, ("Mesh2", 2): 0.6, ("Mesh3", 1): 3.0, ("Mesh3", 2): 1.6}
GROWTH = 6287 / 3105


def lines(times: dict = TIMES, **cells: object) -> list[dict]:
    return [made_up.record(made_up.case(mesh, "3STEPD", study="scaling", knob="threads",
                                        knob_value=threads, threads=threads, time_s=time,
                                        noise_kernel_s=0.001, busy_kernel_s=0.0011) | cells)
            | {"samples_s": [time] * 5} for (mesh, threads), time in times.items()]


class ScalingTest(unittest.TestCase):
    def rows(self, cases: list[dict]) -> list[records.Row]:
        folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        made_up.write_lines(folder / "records.jsonl", cases)
        return records.rows_of(records.read_run(folder))

    def points(self, cases: list[dict]) -> dict:
        return {(point.row.mesh, point.row.threads): point for point in points_of(self.rows(cases))}

    def test_by_hand(self) -> None:
        points = self.points(lines())
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
        self.assertEqual([case for case, point in self.points(lines(times)).items()
                          if point.weak_from], [("Mesh0", 1)])

    def test_one_sample_has_no_efficiency(self) -> None:
        cases = lines()
        cases[-1] |= {"repetitions": 1, "samples_s": [1.6]}
        point = self.points(cases)["Mesh3", 2]
        self.assertEqual((point.speed_up, point.efficiency, point.weak_efficiency), (None,) * 3)
        (drawing,) = scaling_figure.drawings(self.rows(lines(repetitions=1)))
        self.assertIn("one sample gives no efficiency", drawing.draw(drawing.rows))

    def test_nothing_is_said_without_one_thread_or_a_solution(self) -> None:
        for cases in (lines({("Mesh3", 2): 1.0}), lines(status="inaccurate", outcome="inaccurate")):
            self.assertEqual({point.speed_up for point in self.points(cases).values()}, {None})

    def test_the_figure_says_what_it_shows(self) -> None:
        (drawing,) = scaling_figure.drawings(self.rows(lines() + lines(scene="other")))
        words = drawn.words_of(drawing.draw(drawing.rows))
        for part in ("Mesh2: speed-up", "Mesh3: speed-up", "growing meshes", "1.01 times",
                     "takes 1.1 times its time alone", "3STEPD"):
            self.assertIn(part, words)
        table = list(csv.DictReader(drawing.table(drawing.rows).splitlines()))
        self.assertEqual([(line["mesh"], line["threads"]) for line in table],
                         [(mesh, str(threads)) for mesh, threads in TIMES])
        self.assertEqual(list(scaling_figure.drawings(self.rows(lines(study="", knob="",
                                                                      knob_value=None)[:1]))), [])


if __name__ == "__main__":
    unittest.main()
