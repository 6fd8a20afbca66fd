"""Profiles of contact problems from made-up records.  /usr/bin/python3 -m unittest FILE"""
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np

import made_up  # finds plots

import contact_profiles
from running import run

# By hand: (seconds, error) of each solver on three problems, of the runs to 1e-4 and to 1e-8.
SOLVED = {
    1e-4: {"newton": ((1.0, 1e-5), (2.0, 1e-5), (None, None)),
           "admm": ((2.0, 1e-6), (1.0, 1e-5), (4.0, 1e-5)),
           "EXTERNAL:nsgs": ((0.5, 1e-3), (9.0, 1e-5), (16.0, 1e-5))},
    1e-8: {"newton": ((3.0, 1e-9), (2.0, 1e-9), (None, None)),
           "admm": ((6.0, 1e-9), (8.0, 1e-9), (40.0, 1e-10)),
           "EXTERNAL:nsgs": ((0.5, 1e-7), (9.0, 1e-5), (None, None))}}


def records() -> list[dict]:
    return [{"mesh": f"problem{k}", "scene": "fclib", "n_phi": None, "n_c": 30, "study": "contact",
             "method": solver if ":" in solver else "CONDENSED", "knob": "tolerance",
             "knob_value": precision, "contact_solver": None if ":" in solver else solver,
             "time_s": seconds, "siconos_error": error, "natural_map_residual": error,
             "contact_matrix": "sparse", "status": "ok" if error else "timeout"}
            for precision, solvers in SOLVED.items()
            for solver, own in solvers.items() for k, (seconds, error) in enumerate(own)]


class ContactProfilesTest(unittest.TestCase):
    def shares(self, precision: float) -> dict[str, list[tuple[float, float]]]:
        steps = contact_profiles.profile_of(contact_profiles.costs_of(records(), precision))
        return {solver: list(zip(at.tolist(), (3 * share).round(9).tolist()))
                for solver, (at, share) in steps.items()}

    def test_by_hand(self) -> None:
        self.assertEqual(self.shares(1e-4), {"newton": [(1, 1), (2, 2)],
                                             "admm": [(1, 2), (2, 3)],
                                             "nsgs": [(4, 1), (9, 2)]})
        self.assertEqual(self.shares(1e-8), {"newton": [(1, 2)], "admm": [(1, 1), (2, 2), (4, 3)],
                                             "nsgs": []})

    def test_a_precise_answer_to_the_looser_precision_is_no_run_to_the_other(self) -> None:
        loose = [record | {"siconos_error": 1e-12} for record in records()
                 if record["knob_value"] == 1e-4]
        costs = contact_profiles.costs_of(loose, 1e-8)
        self.assertFalse(np.isfinite(costs.to_numpy()).any())

    def test_the_program_draws_and_writes_the_shares(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            lines = Path(folder, "records.jsonl")
            lines.write_text("".join(json.dumps(record) + "\n" for record in records()))
            status, _, complaint = run(contact_profiles, folder)
            self.assertEqual((status, complaint), (0, ""))
            self.assertGreater(Path(folder, "figures/contact_profiles.png").stat().st_size, 1000)
            table = Path(folder, "figures/contact_profiles.csv").read_text().splitlines()
            self.assertEqual(table[0], "precision,solver,factor_of_best,share_solved")
            self.assertIn("0.0001,nsgs,9.0,0.6666666666666666", table)

    def test_few_problems_have_a_table_and_no_earlier_profiles(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            lines, figures = Path(folder, "records.jsonl"), Path(folder, "figures")
            for chosen in (records(), [r for r in records() if r["mesh"] != "problem2"]):
                lines.write_text("".join(json.dumps(record) + "\n" for record in chosen))
                status, said, complaint = run(contact_profiles, folder)
                self.assertEqual((status, complaint), (0, ""))
            self.assertIn("left out: 3 solvers on 2 contact problems; expected at least 2 on 3", said)
            self.assertEqual([path.name for path in figures.glob("contact_*")], ["contact_table.md"])
            self.assertEqual(figures.joinpath("contact_table.md").read_text().count("problem"), 3)

    def test_the_table_has_times_where_the_precision_is_reached_and_else_how_far(self) -> None:
        head, _, first, _, last = contact_profiles.markdown_of(records()).splitlines()
        self.assertEqual(head.split(" | ")[1:7], ["W", "rows", "newton", "admm", "nsgs", "theirs / ours"])
        self.assertEqual(first, "| problem0 | sparse | 30 | 3 s | 6 s | ok, 1e-07 |  | 1e-09, 1e-09 |  |")
        self.assertEqual(last, "| problem2 | sparse | 30 | timeout | 40 s | timeout |  | 1e-10, 1e-10 |  |")
        for seconds, cells in ((0.5, "500 ms | 0.17"), (570.0, "570 s | 190")):
            solved = dict.fromkeys(("siconos_error", "natural_map_residual"), 1e-9)
            nsgs = [record | solved | {"time_s": seconds} if ":" in record["method"] else record
                    for record in records()]
            self.assertIn(f"| 3 s | 6 s | {cells} |", contact_profiles.markdown_of(nsgs).splitlines()[2])

    def test_what_it_cannot_draw_is_one_line(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for lines, words in (([{"mesh": "Mesh0", "scene": "default"}], "no runs to 0.0001 or 1e-08"),
                                 ([records()[0] | {"knob_value": None}], "--study=contact")):
                Path(folder, "records.jsonl").write_text(
                    "".join(json.dumps(record) + "\n" for record in lines))
                status, _, complaint = run(contact_profiles, folder)
                self.assertEqual((status, complaint.count("\n")), (2, 1))
                self.assertIn(words, complaint)
