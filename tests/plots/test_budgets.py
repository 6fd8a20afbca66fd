"""The least error within a time, of made-up records.  /usr/bin/python3 -m unittest FILE"""
import csv
import unittest

import made_up  # finds plots

import documents
import records

# Seconds and errors of the points of a method's knob; the last of ALM is slower and worse.
POINTS = {"ALM": ((0.02, 1e-2), (0.09, 1e-4), (0.4, 1e-7), (0.8, 1e-6)), "3STEPD": ((0.3, 1e-12),)}


def lines(context: dict | None = None) -> list[dict]:
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
        self.assertEqual(self.errors(self.cases(lines())), {
            ("3STEPD", 0.1): "", ("3STEPD", 1.0): "1e-12", ("ALM", 0.1): "0.0001",
            ("ALM", 1.0): "1e-07"})

    def test_at_the_budgets_that_the_run_was_told(self) -> None:
        cases = self.cases(lines({"budgets_s": "0.02,0.3"}))
        self.assertEqual(self.errors(cases), {("3STEPD", 0.02): "", ("3STEPD", 0.3): "1e-12",
                                               ("ALM", 0.02): "0.01", ("ALM", 0.3): "0.0001"})
        table = documents.markdown(cases)
        self.assertIn("| ALM | 1e-2, uzawa iterations 10 | 1e-4, uzawa iterations 20 |", table)
        self.assertIn("| 3STEPD | – | 1e-12 |", table)

    def test_words_that_are_no_budgets_are_passed_over(self) -> None:
        for words in ("x", "nan,-1", "", "1e999"):
            self.assertIn(("ALM", 0.1), self.errors(self.cases(lines({"budgets_s": words}))))

    def test_the_worse_of_both_errors_counts(self) -> None:
        cases = lines()
        cases[-1]["error_stress"] = 1e-3
        self.assertEqual(self.errors(self.cases(cases))["3STEPD", 1.0], "0.001")

    def test_only_what_is_verified_and_timed_with_a_study(self) -> None:
        self.assertEqual(self.cases([made_up.record(made_up.case("Mesh0", "3STEPD"))]), [])
        cases = lines()
        cases[-1] |= {"status": "timeout", "outcome": "timeout", "time_s": None}
        cases[2] |= {"error_stress": None}
        self.assertEqual(self.errors(self.cases(cases)), {
            ("3STEPD", 0.1): "", ("3STEPD", 1.0): "", ("ALM", 0.1): "0.0001", ("ALM", 1.0): "1e-06"})
        joined = self.cases(lines() + [made_up.record(made_up.case("Mesh0", "BLIND"))])
        self.assertEqual({row.method for row in joined}, {*POINTS, "BLIND"})
