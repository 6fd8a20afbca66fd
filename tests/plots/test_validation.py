"""Published values and ours: tables and pictures.  /usr/bin/python3 -m unittest FILE"""
import json

import numpy as np
from running import FolderTest, run

import validation

METHODS = "<!-- published by method -->\n<!-- end of table -->\n"
PAGE = f"a\n<!-- published cases -->\nold\n<!-- end of table -->\nb\n{METHODS}c\n"


def quantity(name: str, published: list[float]) -> dict:
    return {"name": name, "unit": "MPa", "formula": "|p|", "at_mm": [[0, k] for k in range(len(published))],
            "published": published, "allowed": 0.01, "because": "exact"}


def value(deviation: float | None, ours: list[float], off: float | None = None) -> dict:
    verdict = "not known" if deviation is None else "agrees" if abs(deviation) <= 0.01 else "differs"
    return {"ours": ours, "off": off, "deviation": deviation, "verdict": verdict}


def answer(method: str, *values: dict, **more: object) -> dict:
    return {"method": method, "case_name": f"x/{method}", "status": "ok", "reason": "", "error_total": 0.002,
            "time_s": 0.004, "loop_time_s": 0.1, "values": list(values)} | more


CASES = [
    {"case": "disc", "title": "A disc", "source": "Hertz", "quantities": [quantity("pressure", [100]),
                                                                          quantity("profile", [1, 2, 4])],
     "answers": [answer("HYBRID:k=2", value(0.005, [100.5], 0.2), value(0.006, [1, 2, 4.024], 0.1)),
                 answer("P2", value(None, []), value(0.02, [1, 2, 4.08]), time_s=0.008),
                 answer("EXTERNAL:peer", value(None, []), value(-0.001, [1, 2, 3.996]), time_s=0.4)]},
    {"case": "slope", "title": "A slope", "source": "Hertz", "quantities": [quantity("shear", [5])],
     "answers": [answer("HYBRID:k=3", value(None, [])),
                 answer("P2", value(None, []), status="skipped", reason="bodies of 3 parts", time_s=None)]}]


class ValidationTest(FolderTest):
    def make(self, cases: object, page: str) -> tuple[int, str, str]:
        (self.results / "validation.json").write_text(json.dumps(cases), encoding="utf-8")
        file = self.results / "page.md"
        file.write_text(page, encoding="utf-8")
        status, _, err = run(validation, self.results, f"--page={file}")
        return status, err, file.read_text(encoding="utf-8")

    def test_the_tables_replace_what_was_there(self) -> None:
        status, err, page = self.make(CASES, PAGE)
        self.assertEqual((status, err), (0, ""))
        lines = page.splitlines()
        self.assertEqual(lines[2:6], [
            "| case | values | largest deviation | of | allowed, because |", "|---|---|---|---|---|",
            "| A disc `disc` | 2 | 0.6\u00a0% | profile: 3 points | 1\u00a0%: exact |",
            "| A slope `slope` | 1 | – | – | – |"])
        self.assertEqual((lines[0], lines[-1]), ("a", "c"))
        self.assertIn("- `disc`, `slope`: Hertz", lines)
        for name in ("published", "published_profiles"):
            self.assertTrue((self.figures / f"{name}.png").read_bytes().startswith(b"\x89PNG"))

    def test_a_method_has_counts_medians_and_reasons(self) -> None:
        lines = self.make(CASES, PAGE)[2].splitlines()
        self.assertIn("| P2 | 1 | 0 of 1 | 2 | 0.2 | 2 | 1 *a* |", lines)
        self.assertIn("| peer | 1 | 1 of 1 | 0.1 | 0.2 | 1e+02 |  |", lines)
        self.assertIn("- *a*: bodies of … parts", lines)

    def test_a_case_shows_its_largest_deviation(self) -> None:
        def cases(first: float, second: float) -> list[dict]:
            quantities = [quantity("pressure", [100]), quantity("|shear|", [5])]
            return [CASES[0] | {"quantities": quantities,
                                "answers": [answer("P2", value(first, [100]), value(second, [5.02]))]}]

        for (first, second), shown in (((0.002, -0.004), "0.4\u00a0% | \\|shear\\|: 5 MPa, ours 5.02"),
                                       ((0.005, -0.004), "0.5\u00a0% | pressure: 100 MPa, ours 100"),
                                       ((1e-9, 2e-9), "below 0.0001\u00a0% | all")):
            self.assertIn(f"| A disc `disc` | 2 | {shown} | 1\u00a0%: exact |",
                          self.make(cases(first, second), PAGE)[2].splitlines())

    def test_a_profile_is_drawn_over_the_coordinate_that_changes(self) -> None:
        for points, where, name in (([[1, 0], [3, 0]], [1, 3], "x, mm"), ([[0, 2], [0, -1]], [2, -1], "y, mm"),
                                    ([[0, 0], [3, 4]], [0, 5], "from the first point, mm")):
            values, label = validation.along(points)
            np.testing.assert_array_equal(values, where)
            self.assertEqual(label, name)

    def test_what_is_wrong_is_said_in_one_line(self) -> None:
        short = [CASES[0] | {"answers": [answer("P2")]}]
        tables = f"<!-- published cases -->\n<!-- end of table -->\n{METHODS}"
        for cases, page in ((CASES, "no table"), ("nothing", tables), (short, tables)):
            status, err, after = self.make(cases, page)
            self.assertEqual((status, err.count("\n"), after), (2, 1, page))
