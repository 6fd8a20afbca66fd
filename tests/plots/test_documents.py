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
    def said(self, lines: list[dict]) -> str:
        return paragraph(made_up.read_lines(lines))

    def says(self, lines: list[dict], *parts: str) -> None:
        said = self.said(lines)
        for part in parts:
            self.assertIn(part, said)

    def test_one_run_in_plain_sentences(self) -> None:
        self.says([line(), line("HYBRID"), line("SDTIC6", status="timeout", outcome="timeout")],
                  "3 cases: 3 methods, 1 mesh, 1 scene. 2 of them ended ok and verified; the others "
                  "ended timeout (1).",
                  "on Abacus 9, 8 processors, Linux 6.1, frequency governor performance, 2026-11-21.",
                  "airybench 0.1.0, git revision 0123456789ab, compiled by GNU 12.2.0 with `-O3`.",
                  "Libraries: OpenBLAS 0.3.21, MUMPS 5.5.1.", "had 1 thread.",
                  "HYBRID assembles its own matrices in its time", "the median of 5 repetitions.",
                  "load in the minute before a run began was 0.10.", "at most 1.0e-17.",
                  "at most 1e-6.", "tightened towards that")

    def test_what_differs_is_listed_with_its_cases(self) -> None:
        self.says([line(), line("HYBRID"),
                   line("BLIND", {"git_revision": "fedcba9876543210", "git_dirty": "yes",
                                  "cpu": "Abacus 10", "date": "2026-11-23T09:51:32Z"}, threads=2)],
                  "performance (2 cases); Abacus 10, ", "performance (1 case), 2026-11-21 to "
                  "2026-11-23.", "of 2 revisions", "fedcba987654, with changes that are in no revision",
                  "had 1 thread (2 cases); 2 threads (1 case).")

    def test_times_are_told_as_they_were_taken(self) -> None:
        self.assertIn("Every case was timed once", self.said([line(repetitions=1)]))
        self.says([line(), line("HYBRID", repetitions=1)], "5 repetitions; 1 case had one.")
        self.assertIn("No case has a time.", self.said(
            [line(status="skipped", outcome="skipped", time_s="", repetitions=0)]))
        self.says([line(context={"interleaved": "yes"})],
                  "The repetitions of all cases came in random turn")
        precise = dict(repetitions=20, precision=0.02)
        self.says([line(**precise, precision_reached="true"), line("BLIND", **precise), line("HYBRID")],
                  "2 of 3 such cases have at least 6 samples", "2 of 3 such cases were repeated until",
                  "within 2\u00a0% of the median, or a limit was reached; 1 of 2 became so precise.")
        self.assertNotIn("order statistics", self.said([line()]))

    def test_noise_is_of_all_times_of_the_loop(self) -> None:
        self.says([line() | {"noise_kernel_samples_s": [1.0, 1.0, 1.1]},
                   line("HYBRID") | {"noise_kernel_samples_s": [1.0, 0.9, 1.1]}],
                  "scattered by 5\u00a0% (median absolute deviation over median of 6 times)")

    def test_what_was_noisy_was_measured_again(self) -> None:
        asked = dict(retry_noisy=0.05)
        self.says([line(**asked, noise_attempts=1, noise_share=0.01),
                   line("HYBRID", **asked, noise_attempts=4, noise_share=0.2, noisy="true"),
                   line("P2", **asked, status="timeout", outcome="timeout")],
                  "by more than 5\u00a0% was measured again, up to three times: 1 of 2 were, and 1 never")
        self.assertNotIn("measured again", self.said([line()]))

    def test_other_programs_have_clocks_of_their_own(self) -> None:
        self.says([line(), line("EXTERNAL:abacus", program="abacus 2.1")],
                  "In 1 case another program solved (abacus 2.1): its own clock")

    def test_the_search_has_a_budget(self) -> None:
        self.says([line("ALM", tuning_budget_s=2.5, tuning_cut="true"), line()],
                  "In 1 case that choice had 2.5 s; in 1 of them it ended there")

    def test_a_load_that_is_no_number_is_not_told(self) -> None:
        for load in ("-1.00", "unknown", "\u00b2", "nan"):
            self.assertNotIn("machine's load", self.said([line(context={"load_1min_at_start": load})]))

    def test_both_stops(self) -> None:
        self.says([line("ALM"), line("ALM", stop="paper")], "(1 case) or ended by the paper's stops (1).")
        self.says([line("ALM", stop="paper")], "ended by the paper's own stops, whatever error")
        self.assertNotIn("Iterative methods", self.said([line()]))
        self.says([made_up.record(case) for case in made_up.error_study(["Mesh0"])],
                  "accuracy was set on purpose, by contact sweeps or tolerance or uzawa iterations.")

    def test_records_without_a_context_say_so(self) -> None:
        said = paragraph(made_up.read([made_up.case("Mesh0", "3STEPD")]))
        for part in ("a machine that the record does not name", "a program that the record does not",
                     "libraries that the record does not name"):
            self.assertIn(part, said)
