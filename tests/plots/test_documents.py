"""Tables and words next to the figures: the least error within a time, how records were measured.
/usr/bin/python3 -m unittest FILE"""
import csv
import unittest

import made_up  # finds plots

import documents
import records
from measured import paragraph

# Seconds and errors of the points of a method's knob; the last of ALM is slower and worse.
POINTS = {"ALM": ((0.02, 1e-2), (0.09, 1e-4), (0.4, 1e-7), (0.8, 1e-6)), "3STEPD": ((0.3, 1e-12),)}


def points(context: dict | None = None) -> list[dict]:
    return [made_up.record(made_up.point("Mesh0", method, time_s, error, knob="uzawa iterations"
                                         if method == "ALM" else "", knob_value=10 * k + 10
                                         if method == "ALM" else "")) | {"context": context}
            for method, own in POINTS.items() for k, (time_s, error) in enumerate(own)]


class BudgetsTest(unittest.TestCase):
    def cases(self, cases: list[dict]) -> list[records.Row]:
        return documents.cases_of(made_up.read_lines(cases))

    def errors(self, cases: list[records.Row]) -> dict[tuple[str, float], str]:
        return {(line["method"], float(line["budget_s"])): line["error"]
                for line in csv.DictReader(documents.csv_table(cases).splitlines())}

    def test_by_hand_at_the_powers_of_ten_among_the_times(self) -> None:
        self.assertEqual(self.errors(self.cases(points())), {
            ("3STEPD", 0.1): "", ("3STEPD", 1.0): "1e-12", ("ALM", 0.1): "0.0001",
            ("ALM", 1.0): "1e-07"})

    def test_at_the_budgets_that_the_run_was_told(self) -> None:
        cases = self.cases(points({"budgets_s": "0.02,0.3"}))
        self.assertEqual(self.errors(cases), {("3STEPD", 0.02): "", ("3STEPD", 0.3): "1e-12",
                                               ("ALM", 0.02): "0.01", ("ALM", 0.3): "0.0001"})
        table = documents.markdown(cases)
        self.assertIn("| ALM | 1e-2, uzawa iterations 10 | 1e-4, uzawa iterations 20 |", table)
        self.assertIn("| 3STEPD | – | 1e-12 |", table)

    def test_words_that_are_no_budgets_are_passed_over(self) -> None:
        for words in ("x", "nan,-1", "", "1e999"):
            self.assertIn(("ALM", 0.1), self.errors(self.cases(points({"budgets_s": words}))))

    def test_the_worse_of_both_errors_counts(self) -> None:
        cases = points()
        cases[-1]["error_stress"] = 1e-3
        self.assertEqual(self.errors(self.cases(cases))["3STEPD", 1.0], "0.001")

    def test_only_what_is_verified_and_timed_with_a_study(self) -> None:
        self.assertEqual(self.cases([made_up.record(made_up.case("Mesh0", "3STEPD"))]), [])
        cases = points()
        cases[-1] |= {"status": "timeout", "outcome": "timeout", "time_s": None}
        cases[2] |= {"error_stress": None}
        self.assertEqual(self.errors(self.cases(cases)), {
            ("3STEPD", 0.1): "", ("3STEPD", 1.0): "", ("ALM", 0.1): "0.0001", ("ALM", 1.0): "1e-06"})
        joined = self.cases(points() + [made_up.record(made_up.case("Mesh0", "BLIND"))])
        self.assertEqual({row.method for row in joined}, {*POINTS, "BLIND"})


CONTEXT = {"cpu": "Abacus 9", "cpus": "8", "kernel": "6.1", "cpu_governor": "performance",
           "airybench_version": "0.1.0", "git_revision": "0123456789abcdef", "git_dirty": "no",
           "compiler": "GNU 12.2.0", "compiler_flags": " -O3", "blas": "OpenBLAS 0.3.21",
           "mumps": "5.5.1", "date": "2026-11-21T09:51:32Z", "load_1min_at_start": "0.10",
           "interleaved": "no"}


def line(method: str = "3STEPD", context: dict | None = None, **cells: object) -> dict:
    return made_up.record(made_up.case("Mesh0", method) | {"reference_error": 1e-17} | cells) | {
        "context": CONTEXT | (context or {})}


class MeasuredTest(unittest.TestCase):
    def test_it_says_what_the_records_have_and_nothing_else(self) -> None:
        other = line("BLIND", {"git_revision": "fedcba9876543210", "git_dirty": "yes", "cpu": "Abacus 10",
                               "date": "2026-11-23T09:51:32Z"}, threads=2)
        precise = dict(repetitions=20, context={"precision": "0.02"}, time_ci_high_s=0.505)
        asked = dict(retry_noisy=0.05)
        skipped = dict(status="skipped", outcome="skipped", time_s="", repetitions=0)
        timeout = dict(status="timeout", outcome="timeout")
        noisy = [line(noise_attempts=1, noise_share=0.01, **asked), line("P2", **asked, **timeout),
                 line("HYBRID", noise_attempts=4, noise_share=0.2, noisy="true", **asked)]
        kernels = [line() | {"noise_kernel_samples_s": [1.0, 1.0, 1.1]},
                   line("HYBRID") | {"noise_kernel_samples_s": [1.0, 0.9, 1.1]}]
        study = [made_up.record(case) for case in made_up.error_study(["Mesh0"])]
        for lines, said, unsaid in (
                ([line(), line("HYBRID"), line("SDTIC6", **timeout)],
                 ("3 cases: 3 methods, 1 mesh, 1 scene.", "ended timeout (1)", "Abacus 9, 8 processors, Linux 6.1",
                  "governor performance, 2026-11-21.", "git revision 0123456789ab, compiled by GNU 12.2.0 with `-O3`",
                  "OpenBLAS 0.3.21, MUMPS 5.5.1", "1 thread.", "5 repetitions.", "was 0.10.", "1.0e-17", "1e-6"),
                 ("order statistics", "measured again")),
                ([line(), line("HYBRID"), other],
                 ("(2 cases); Abacus 10, ", "(1 case), 2026-11-21 to 2026-11-23.", "of 2 revisions",
                  "fedcba987654, with changes", "1 thread (2 cases); 2 threads (1 case)."), ()),
                ([line(repetitions=1)], ("timed once",), ()),
                ([line(), line("HYBRID", repetitions=1)], ("5 repetitions; 1 case had one.",), ()),
                ([line(**skipped)], ("No case has a time.",), ()),
                ([line(context={"interleaved": "yes"})], ("in random turn",), ()),
                ([line(**precise, time_ci_low_s=0.495), line("BLIND", **precise, time_ci_low_s=0.4), line("HYBRID")],
                 ("2 of 3 such cases have at least 6 samples", "2 of 3 such cases were repeated until",
                  "2\u00a0% of the median", "1 of 2 became so precise."), ()),
                (kernels, ("scattered by 5\u00a0%", "of 6 times)"), ()),
                (noisy, ("5\u00a0% was measured again", "1 of 2 were, and 1 never"), ()),
                ([line(), line("EXTERNAL:abacus", program="abacus 2.1")], ("1 case", "(abacus 2.1)"), ()),
                ([line("ALM", tuning_budget_s=2.5, tuning_cut="true"), line()],
                 ("In 1 case that choice had 2.5 s; in 1 of them it ended there",), ()),
                *(([line(context={"load_1min_at_start": load})], (), ("machine's load",))
                  for load in ("-1.00", "unknown", "\u00b2", "nan")),
                ([line()], (), ("Iterative methods",)),
                ([line("ALM"), line("ALM", stop="paper")], ("(1 case) or ended by the paper's stops (1).",), ()),
                ([line("ALM", stop="paper")], ("the paper's own stops",), ()),
                (study, ("by contact sweeps or tolerance or uzawa iterations.",), ()),
                ([made_up.record(made_up.case("Mesh0", "3STEPD"))],
                 ("a machine that the record does not name", "libraries that the record does not name"), ())):
            words = paragraph(made_up.read_lines(lines))
            for part in said:
                self.assertIn(part, words)
            for part in unsaid:
                self.assertNotIn(part, words)
