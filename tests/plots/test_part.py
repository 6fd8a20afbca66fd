"""The picture and the page of a solve, of a made-up block.  /usr/bin/python3 -m unittest FILE"""
import json
import re
from pathlib import Path

import numpy as np

from browser import CHROMIUM, Browser
from running import FolderTest, names_in, run

import draw_folder
import part
from drawing import PAGE_WIDTH

CORNERS = np.array([(0, 0), (10, 0), (10, 4), (0, 4)])
REPORT = ["largest displacement 0.1 mm", [["contact", "peak MPa", ""], ["contact:sole <1>", "7.5", ""]],
          "total error 0.9 % in energy: of the mesh"]


def write_part(results: Path, **changes: object) -> None:
    """A block of two triangles on its sole, 0 to 8 MPa from left to right, pulled at its right."""
    (results / "fields").mkdir()
    lines = ["third,x_mm,y_mm,von_mises_MPa"]
    for triangle in (CORNERS[[0, 1, 2]], CORNERS[[0, 2, 3]]):
        for k in range(3):
            a, b, c = triangle[k], triangle[(k + 1) % 3], triangle.mean(0)
            for x, y in (a, (a + b) / 2, b, (a + c) / 2, (b + c) / 2, c):
                lines.append(f"{(len(lines) - 1) // 6 + 1},{x},{y},{0.8 * x}")
    write(results, "von_mises.csv", lines)
    lines = ["edge,piece,x_mm,y_mm,ux_mm,uy_mm,tx_MPa,ty_MPa,role"]
    for edge, role in enumerate(("contact", "force", "force", "displacement")):
        start, end = CORNERS[edge], CORNERS[(edge + 1) % 4]
        for t in (0, 0.5, 1):
            x, y = (1 - t) * start + t * end
            lines.append(f"{edge + 1},1,{x},{y},{0.01 * x},0,{5 * (edge == 1)},0,{role}")
    write(results, "outline.csv", lines)
    write(results, "faces.csv", ["face,along_mm,x_mm,y_mm,pressure_MPa,shear_MPa,gap_mm,slip_mm,state"] +
          [f"contact:sole,{x},{x},0,{0.75 * x},0,0,0,stick" for x in (0, 2.5, 5, 7.5, 10)])
    face = {"labels": ["contact:sole"], "closed_mm": 10, "pressure_MPa": {"value": 7.5, "at_mm": [10, 0]}}
    answer = {"faces": [face], "supports": [], "point_supports": [], "von_mises_MPa": {"value": 8, "at_mm": [10, 4]},
              "unbounded": []}
    shown = {"name": "block", "case": "block--HYBRID", "assumptions": "block: plane strain; steel: E 210000 MPa",
             "notes": ["block.inp: not used: *PREPRINT (block.inp:3)"], "largest_pressure_is": "bounded",
             "error_total": 0.009, "report": REPORT}
    write(results, "answer.json", [json.dumps(answer | {key: value for key, value in changes.items()
                                                        if key not in shown})])
    (results / "part.json").write_text(json.dumps(shown | {key: value for key, value in changes.items()
                                                           if key in shown}), encoding="utf-8")


def write(results: Path, end: str, lines: list[str]) -> None:
    (results / "fields" / f"block--HYBRID.{end}").write_text("\n".join(lines) + "\n", encoding="utf-8")


class PartTest(FolderTest):
    program = part

    def words(self, **changes: object) -> str:
        write_part(self.results, **changes)
        figure = part.draw(part.read_part(self.results))
        self.assertLessEqual(figure.get_size_inches()[0], PAGE_WIDTH)
        texts = [*figure.texts, *figure.axes[0].texts, *figure.legends[0].get_texts(), figure.axes[1].xaxis.label]
        return "\n".join(text.get_text() for text in texts)

    def test_the_picture_says_what_it_shows(self) -> None:
        words = self.words()
        for text in ("von Mises stress of block: total error 0.9 % in energy", "steel: E 210000 MPa",
                     "7.5 MPa", "largest 8 MPa", "outline, displacement × 5", "load, up to 5 MPa", "held",
                     "von Mises stress, MPa"):
            self.assertIn(text, words)
        for text in ("this or more", "held in a point", "unbounded"):
            self.assertNotIn(text, words)

    def test_a_pair_has_the_pressure_of_either_label(self) -> None:
        pair = {"labels": ["contact:sole", "contact:ground against its will"], "closed_mm": 10,
                "pressure_MPa": {"value": 7.5, "at_mm": [10, 0]}}
        self.assertIn("7.5 MPa", self.words(faces=[pair]))

    def test_points_that_are_held_have_a_triangle_per_component(self) -> None:
        write_part(self.results, point_supports=[{"at_mm": [0, 0], "displacement_mm": [0, 0.1]},
                                                 {"at_mm": [10, 4], "displacement_mm": [None, 0]}])
        figure = part.draw(part.read_part(self.results))
        markers = [(line.get_xydata()[0], line.get_marker()) for line in figure.axes[0].lines
                   if isinstance(line.get_marker(), np.ndarray)]
        self.assertEqual([[*at, *np.sign(shape.sum(0))] for at, shape in markers],
                         [[0, 0, -1, 0], [0, 0, 0, -1], [10, 4, 0, 1]])
        self.assertIn("held in a point", [text.get_text() for text in figure.legends[0].get_texts()])

    def test_places_where_stress_is_unbounded_are_marked_next_to_the_largest(self) -> None:
        place = {"what": "a re-entrant corner", "at_mm": [0, 4], "within_mm": 0.3}
        words = self.words(unbounded=[place], largest_pressure_is="unbounded")
        for text in ("stress unbounded", "brightest: this or more", "\nunbounded\n", "largest 8 MPa"):
            self.assertIn(text, words)
        marks = [line.get_xydata().tolist() for line in part.draw(part.read_part(self.results)).axes[0].lines
                 if line.get_marker() == "x"]
        self.assertEqual(marks, [[[0, 4]]])

    def test_lattices_are_divided_into_cells(self) -> None:
        for parts in range(1, 9):
            rows = [(j, row) for row in range(parts, -1, -1) for j in range(row + 1)]
            points = np.array([(j + (parts - row) / 2, parts - row) for j, row in rows])
            a, b, c = np.moveaxis(points[part.cells_of(len(points))], 1, 0)
            areas = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
            np.testing.assert_allclose(areas, np.full(parts**2, 0.5))

    def test_a_folder_of_a_solve_has_one_picture(self) -> None:
        write_part(self.results)
        (self.results / "records.jsonl").write_text("{}\n", encoding="utf-8")
        (self.results / "part.json").touch()
        status, out, err = run(draw_folder, self.results, "--quiet")
        self.assertEqual((status, err), (0, ""))
        self.assertEqual(out, f"picture: {self.figures / 'part.png'}\n")
        self.assertEqual(names_in(self.figures), {"part.png"})
        self.assertFalse((self.results / "part.html").exists())

    def test_files_that_are_not_a_solve_s_are_refused(self) -> None:
        write_part(self.results)
        write(self.results, "outline.csv", ["edge,x_mm", "1,0", "2,0", "2,0"])
        self.assert_refused("block--HYBRID.outline.csv: not as bench solve writes it")
        write(self.results, "answer.json", ['{"faces": []}'])
        self.assert_refused("block--HYBRID.answer.json: of an earlier bench")

    def test_the_page_stands_alone(self) -> None:
        if not CHROMIUM:
            raise AssertionError("no chromium: the page cannot be tested (Debian: chromium)")
        write_part(self.results)
        self.assertEqual(run(part, self.results, "--html")[0], 0)
        text = (self.results / "part.html").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"<script|http:|https:", text), [])
        browser = Browser()
        self.addCleanup(browser.close)
        view = browser.browse(self.results / "part.html")
        self.assertEqual((view.console, view.requests), ([], []))
        self.assertEqual(view.document.one("h1").words, "block: total error 0.9 % in energy")
        self.assertEqual([cell.words for cell in view.document.all("td")], ["7.5"])
        self.assertEqual(view.document.one("th", scope="row").words, "contact:sole <1>")
        for words in ("total error 0.9 % in energy: of the mesh", "not used: *PREPRINT", "plane strain"):
            self.assertIn(words, view.document.words)
        self.assertTrue(view.document.one("img").get("src").startswith("data:image/png;base64,"))
