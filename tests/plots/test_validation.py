"""Published values and ours: table and picture.  /usr/bin/python3 -m unittest FILE"""
import json

from running import FolderTest, run

import validation


def row(case: str, quantity: str, published: list[float], ours: list[float], **more: object) -> dict:
    off = max(((o - p) / max(map(abs, published)) for o, p in zip(ours, published)), key=abs, default=None)
    return {"case": case, "title": f"A {case}", "source": "Hertz", "method": "HYBRID:k=2", "quantity": quantity,
            "unit": "MPa", "formula": "|p|", "at_mm": [[0, k] for k in range(len(published))],
            "published": published, "ours": ours, "off": None, "deviation": off, "allowed": 0.01,
            "because": "exact"} | more


ROWS = [row("disc", "pressure", [100], [100.5], off=0.2), row("disc", "profile", [1, 2, 4], [1, 2, 4.02]),
        row("slope", "shear", [5], [])]


class ValidationTest(FolderTest):
    def make(self, rows: list[dict], page: str) -> tuple[int, str, str]:
        (self.results / "validation.json").write_text(json.dumps(rows), encoding="utf-8")
        file = self.results / "page.md"
        file.write_text(page, encoding="utf-8")
        status, _, err = run(validation, self.results, f"--page={file}")
        return status, err, file.read_text(encoding="utf-8")

    def test_the_table_replaces_what_was_there(self) -> None:
        others = row("disc", "pressure", [100], [900], method="P2")
        status, err, page = self.make([*ROWS, others], "a\n<!-- published cases -->\nold\n<!-- end of table -->\nb\n")
        self.assertEqual((status, err), (0, ""))
        lines = page.splitlines()
        self.assertEqual(lines[2:7], [
            "| case | quantity | published | ours | off by |", "|---|---|---|---|---|",
            "| A disc `disc` | pressure | 100 MPa | 100.5 ± 0.2 | 0.5\u00a0% |",
            "|  | profile | 3 points MPa | 3 points | 0.5\u00a0% |",
            "| A slope `slope` | shear | 5 MPa | – | – |"])
        self.assertEqual((lines[0], lines[-1]), ("a", "b"))
        self.assertIn("- `disc`, `slope`: Hertz", lines)
        self.assertTrue((self.figures / "published.png").read_bytes().startswith(b"\x89PNG"))

    def test_what_is_wrong_is_said_in_one_line(self) -> None:
        for rows, page in ((ROWS, "no table"), ("nothing", "<!-- published cases -->\n<!-- end of table -->\n")):
            status, err, after = self.make(rows, page)
            self.assertEqual((status, err.count("\n"), after), (2, 1, page))
