"""Profiles of contact problems from made-up records.  /usr/bin/python3 -m unittest FILE"""
import json
import tempfile
import unittest
from pathlib import Path

import made_up  # finds plots

import contact_profiles
from running import run

# By hand: (seconds, error) of each solver on three problems.
SOLVED = {"newton": ((1.0, 1e-12), (2.0, 1e-12), (None, None)),
          "admm": ((2.0, 1e-6), (1.0, 1e-9), (4.0, 1e-10)),
          "EXTERNAL:nsgs": ((0.5, 1e-3), (9.0, 1e-5), (1.0, 1e-5))}


def records() -> list[dict]:
    return [{"mesh": f"problem{k}", "scene": "fclib", "n_phi": None, "n_c": 30,
             "method": solver if ":" in solver else "CONDENSED",
             "contact_solver": None if ":" in solver else solver, "time_s": seconds,
             "siconos_error": error}
            for solver, own in SOLVED.items() for k, (seconds, error) in enumerate(own)]


class ContactProfilesTest(unittest.TestCase):
    def shares(self, precision: float) -> dict[str, list[tuple[float, float]]]:
        steps = contact_profiles.profile_of(contact_profiles.costs_of(records(), precision))
        return {solver: list(zip(at.tolist(), (3 * share).round(9).tolist()))
                for solver, (at, share) in steps.items()}

    def test_by_hand(self) -> None:
        self.assertEqual(self.shares(1e-4), {"newton": [(1, 1), (2, 2)],
                                             "admm": [(1, 1), (2, 2), (4, 3)],
                                             "nsgs": [(1, 1), (9, 2)]})
        self.assertEqual(self.shares(1e-8), {"newton": [(1, 1), (2, 2)], "admm": [(1, 2)],
                                             "nsgs": []})

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

    def test_what_it_cannot_draw_is_one_line(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for lines, words in (([{"mesh": "Mesh0", "scene": "default"}], "no contact problems"),
                                 (records()[:1], "1 solvers on 1 contact problems")):
                Path(folder, "records.jsonl").write_text(
                    "".join(json.dumps(record) + "\n" for record in lines))
                status, _, complaint = run(contact_profiles, folder)
                self.assertEqual((status, complaint.count("\n")), (2, 1))
                self.assertIn(words, complaint)


if __name__ == "__main__":
    unittest.main()
