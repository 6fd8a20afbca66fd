"""Performance and data profiles of made-up records.  /usr/bin/python3 -m unittest FILE"""
import unittest

import numpy as np

import made_up  # finds plots

import drawn
from figure import profiles as profile_figure
import records

# By hand: seconds of each method on four cases; None: not solved.
TIMES = {"3STEPD": (1.0, 4.0, 3.0, None), "HYBRID": (2.0, 1.0, None, None),
         "BLIND": (3.0, 2.0, 3.0, 5.0)}
MESHES = ("Mesh0", "Mesh1", "Mesh2", "Mesh3")
INFINITE = np.inf


def lines(times: dict = TIMES, **cells: object) -> list[dict]:
    return [made_up.record(made_up.case(mesh, method, time_s=1 if time is None else time,
                                        status="inaccurate" if time is None else "ok",
                                        outcome="") | cells)
            for method, own in times.items() for mesh, time in zip(MESHES, own)]


class ProfilesTest(unittest.TestCase):
    def shares(self, rows: list[records.Row], kind: str, quantity: str, method: str,
               at: float) -> float:
        cases = profile_figure.cases_of(rows)
        profile = next(profile for profile in profile_figure.profiles_of(cases)
                       if (profile.kind, profile.quantity) == (kind, quantity))
        return float(profile.shares(cases.methods.index(method), np.array([at]))[0][0])

    def test_by_hand(self) -> None:
        rows = made_up.read_lines(lines())
        for method, factor, share in (("3STEPD", 1, 2 / 4), ("3STEPD", 3.9, 2 / 4),
                                      ("3STEPD", 4, 3 / 4), ("3STEPD", 1e9, 3 / 4),
                                      ("HYBRID", 1, 1 / 4), ("HYBRID", 2, 2 / 4),
                                      ("BLIND", 1, 2 / 4), ("BLIND", 2, 3 / 4), ("BLIND", 3, 1)):
            self.assertEqual(self.shares(rows, "performance", "time_s", method, factor), share,
                             (method, factor))
        for method, seconds, share in (("3STEPD", 0.9, 0), ("3STEPD", 3, 2 / 4), ("BLIND", 5, 1),
                                       ("HYBRID", 2, 2 / 4)):
            self.assertEqual(self.shares(rows, "data", "time_s", method, seconds), share)

    def test_a_case_that_nobody_solves_counts(self) -> None:
        times = {method: (*own[:3], None) for method, own in TIMES.items()}
        self.assertEqual(self.shares(made_up.read_lines(lines(times)), "performance", "time_s", "BLIND", 1e9),
                         3 / 4)
        np.testing.assert_array_equal(profile_figure.ratios(np.array([[2.0, 1.0], [INFINITE, INFINITE]])),
                                      [[2, 1], [INFINITE, INFINITE]])

    def test_only_what_is_ok_and_verified_is_solved(self) -> None:
        for status, outcome, solved in (
                ("ok", "ok", True), ("ok", "other_solution", True), ("ok", "unverified", False),
                ("inaccurate", "wrong_success", False), ("inaccurate", "inaccurate", False),
                ("timeout", "timeout", False), ("skipped", "skipped", False)):
            row, = made_up.read_lines(lines({"3STEPD": (1.0,)}, status=status, outcome=outcome))
            self.assertEqual(row.solved, solved, (status, outcome))

    def test_memory_has_the_same_cases(self) -> None:
        cases = lines()
        for case in cases:
            case["peak_heap_bytes"] = 100 if case["method"] == "HYBRID" else 300
        rows = made_up.read_lines(cases)
        self.assertEqual(self.shares(rows, "performance", "peak_heap_bytes", "HYBRID", 1), 2 / 4)
        self.assertEqual(self.shares(rows, "performance", "peak_heap_bytes", "BLIND", 1), 2 / 4)
        self.assertEqual(self.shares(rows, "performance", "peak_heap_bytes", "BLIND", 3), 1)
        cases[-1]["peak_heap_bytes"] = None  # of a case that is solved
        shown = profile_figure.profiles_of(profile_figure.cases_of(made_up.read_lines(cases)))
        self.assertEqual([profile.quantity for profile in shown], ["time_s", "time_s"])

    def test_cases_that_not_all_have(self) -> None:
        more = lines() + lines({"ALM": (1.0,)})
        cases = profile_figure.cases_of(made_up.read_lines([case for case in more if (
            case["method"], case["mesh"]) != ("HYBRID", "Mesh3")]))
        self.assertEqual((set(cases.methods), cases.dropped), (set(TIMES), 1))
        self.assertEqual([case[0] for case in cases.cases], list(MESHES[:3]))

    def test_variants_on_few_meshes_do_not_take_the_others_cases(self) -> None:
        few = {f"3STEPD:V{k}": (1.0, 1.0) for k in range(3)}
        cases = profile_figure.cases_of(made_up.read_lines(lines(few) + lines()))
        self.assertEqual((set(cases.methods), len(cases.cases)), (set(TIMES), 4))
        drawing = drawn.plan(made_up.read_lines(lines(few) + lines()), "profiles")
        self.assertIn("Not drawn: 3STEPD:V0, 3STEPD:V1, 3STEPD:V2 (records of too few of the cases).",
                      drawn.words_of(drawing.figure()))

    def test_scenes_and_targets_make_cases(self) -> None:
        rows = made_up.read_lines(lines() + lines(scene="flat"))
        self.assertEqual(len(profile_figure.cases_of(rows).cases), 8)
        self.assertEqual(len(profile_figure.cases_of(made_up.read_lines(
            lines() + lines({"3STEPD": TIMES["3STEPD"]}, scene="flat", target_error=1e-9))).cases), 4)

    def test_bands_are_of_the_repetitions(self) -> None:
        cases = lines({"3STEPD": (1.0,) * 4, "HYBRID": (1.01,) * 4})
        for case in cases:  # 3STEPD is as often slower as faster than HYBRID
            case["samples_s"] = [0.9, 1.0, 1.1] if case["method"] == "3STEPD" else [1.01] * 3
        found = profile_figure.cases_of(made_up.read_lines(cases))
        profile = profile_figure.profiles_of(found)[0]
        share, low, high = (float(ends[0]) for ends in profile.shares(0, np.array([1.0])))
        self.assertEqual(share, 1)
        self.assertLess(low, 1)
        self.assertEqual(high, 1)
        sure = profile.shares(0, np.array([2.0]))
        self.assertEqual([float(ends[0]) for ends in sure], [1, 1, 1])
        np.testing.assert_array_equal(found.resampled(), found.resampled())  # seeded
        alone = profile_figure.profiles_of(profile_figure.cases_of(made_up.read_lines(lines())))[0]
        self.assertEqual(len(alone.resampled), 1)

    def test_order_behind_the_best_depends_on_it(self) -> None:
        # The first is much better than the others where the second beats the third.
        costs = np.array([[1, 3, 9], [1, 3, 9], [9, 9, 1], [1, 3, 9], [1, 9, 9]], float)
        self.assertTrue(profile_figure.order_depends_on_best(costs, 2))
        self.assertFalse(profile_figure.order_depends_on_best(np.array([[1, 2, 3]] * 3, float), 2))
        self.assertIsNone(profile_figure.order_depends_on_best(costs[:, :2]))

    def test_too_few_are_left_out_with_the_reason(self) -> None:
        for cases, reason in ((lines({"3STEPD": TIMES["3STEPD"]}), "1 method on 4 cases"),
                              (lines({m: own[:2] for m, own in TIMES.items()}), "3 methods on 2 case"),
                              (lines({m: (None,) * 4 for m in TIMES}), "none of its 4 cases")):
            drawing, = profile_figure.drawings(made_up.read_lines(cases))
            self.assertIn(reason, drawing.figure())

    def test_studies_have_profiles_of_their_own(self) -> None:
        rows = made_up.read_lines(lines() + lines(stop="paper") + lines(
            study="stability", outcome="ok", scene_group="loads", scene="a", error_stress=1e-9))
        self.assertEqual({d.name: len(d.rows) for d in profile_figure.drawings(rows)},
                         {"profiles": 12, "profiles_paper_stop": 12, "profiles_stability": 12})

    def test_samples_that_cannot_be_are_refused(self) -> None:
        for samples in ([0.1, -1], "0.1", [None]):
            with self.assertRaisesRegex(records.RecordsError, ":1: samples_s is .*, expected a list"):
                made_up.read_lines(lines(samples_s=samples))
