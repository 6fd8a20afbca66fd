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
     "answers": [answer("HYBRID:k=2", value(0.005, [100.5], 0.2), value(0.005, [1, 2, 4.02], 0.1)),
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
        self.assertEqual(lines[2:7], [
            "| case | quantity | published | ours | off by |", "|---|---|---|---|---|",
            "| A disc `disc` | pressure | 100 MPa | 100.5 ± 0.2 | 0.5\u00a0% |",
            "|  | profile | 3 points MPa | 3 points | 0.5\u00a0% |",
            "| A slope `slope` | shear | 5 MPa | – | – |"])
        self.assertEqual((lines[0], lines[-1]), ("a", "c"))
        self.assertIn("- `disc`, `slope`: Hertz", lines)
        for name in ("published", "published_profiles"):
            self.assertTrue((self.figures / f"{name}.png").read_bytes().startswith(b"\x89PNG"))

    def test_a_method_has_its_counts_its_cells_and_its_reasons(self) -> None:
        lines = self.make(CASES, PAGE)[2].splitlines()
        self.assertIn("| P2 | 1 | 1 | 0 | 2 |", lines)
        self.assertIn("| peer | 1 | 1 | 1 | 1e+02 |", lines)
        own = "HYBRID:k=2: 0.2\u00a0%, 0.5\u00a0%, 4\u00a0ms"
        self.assertIn(f"| `disc` | {own} | *0.2\u00a0%, 2\u00a0%, 8\u00a0ms* |", lines)
        self.assertIn(f"| `disc` | {own} | 0.2\u00a0%, 0.1\u00a0%, 0.4\u00a0s |", lines)
        self.assertIn("| `slope` | HYBRID:k=3: 0.2\u00a0%, –, 4\u00a0ms | *a* |", lines)
        self.assertIn("- *a*: bodies of … parts", lines)

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
