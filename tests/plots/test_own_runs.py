"""Runs of one's own: methods, preconditioners and bodies that nothing here knows by name."""
import json
import tempfile
import unittest
from pathlib import Path

import matplotlib

import made_up  # finds plots

import drawn
import made_up_history
import page
from drawing import STYLE

BODIES = {"punch": ["punch1", "punch2", "punch3"],
          "dovetail": ["dovetail1", "dovetail2", "dovetail3"]}
METHODS = ("3STEPD", "NEWTON", "SYMMLQ:JACOBI")  # one's own: NEWTON, JACOBI


class OwnRunTest(unittest.TestCase):
    def test_bodies_do_not_share_a_front(self) -> None:
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        rows = made_up.error_study(list(made_up.OWN), sweep=False) + [
            made_up.point(mesh, "NEWTON", 1e-5, 1e-13) for mesh in made_up.OWN]
        drawing = drawn.plan(made_up.read(rows), "error_time")
        figure = drawing.figure()
        self.assertEqual([axes.get_title() for axes in figure.panels], list(BODIES))
        for axes, meshes in zip(figure.panels, BODIES.values()):
            own = {row.error_total for row in drawing.rows if row.mesh in meshes}
            self.assertLessEqual({y for line in axes.lines for y in line.get_ydata()}, own)
        self.assertIn("NEWTON", drawn.words_of(figure))

    def test_a_page_knows_bodies_and_methods(self) -> None:
        cases = [made_up.record(made_up.case(mesh, method)) for mesh in made_up.OWN for method in METHODS]
        with tempfile.TemporaryDirectory() as history:
            Path(history, "nights").mkdir()
            for night in range(2):
                made = made_up_history.made_up_night(night) | {"cases": cases, "verdicts": []}
                Path(history, "nights", f"{night}.json").write_text(json.dumps(made), encoding="utf-8")
            data = page.page_data(page.read_history(Path(history)), None)
        self.assertEqual(data["bodies"], list(BODIES))
        self.assertEqual([case["body"] for case in data["cases"]], ["punch"] * 9 + ["dovetail"] * 9)
        own = [case["name"] for case in data["cases"] if case["family"] == "NEWTON"]
        self.assertEqual(own, [f"{mesh}/default/NEWTON" for mesh in made_up.OWN])
        row = next(row for row in data["rows"] if row["method"] == "SYMMLQ:JACOBI")
        self.assertEqual((row["name"], row["body"]), ("punch1/default/SYMMLQ:JACOBI", "punch"))
