"""plots/curves.py on a square with a round hole.  /usr/bin/python3 -m unittest FILE"""
import json
from unittest import mock

import numpy as np

from running import FolderTest, run

import curves
import drawing

AROUND = [[np.cos(t), np.sin(t)] for t in -np.linspace(0, 2 * np.pi, 13)]
CORNERS = [[-2, -2], [2, -2], [2, 2], [-2, 2]]
MODEL = {"model": "a$b$", "bodies": ["steel"], "vertices_mm": CORNERS, "triangles": [[0, 1, 2], [0, 2, 3]],
         "curves": [{"number": 10 + k, "names": [], "role": role, "walks_mm": [walk]} for k, (role, walk) in
                    enumerate([("force:low", CORNERS[:2]), ("contact", CORNERS[1:3]),
                               ("displacement", CORNERS[2:]), ("force", [CORNERS[3], CORNERS[0]]),
                               ("force", AROUND)])]}


class Curves(FolderTest):
    program = curves

    def draw(self, text: str) -> tuple[int, str, str]:
        (self.results / "curves.json").write_text(text, encoding="utf-8")
        return run(curves, self.results / "curves.json", self.results / "model.png")

    def test_each_number_stands_outside_of_the_body_next_to_its_curve(self) -> None:
        numbers = {text.get_text(): text for text in curves.draw(MODEL).axes[0].texts}
        self.assertEqual(list(numbers), ["10", "11", "12", "13", "14"])
        for number, place, side in (("10", (0, -2), (0, -1)), ("11", (2, 0), (1, 0)),
                                    ("12", (0, 2), (0, 1)), ("13", (-2, 0), (-1, 0))):
            np.testing.assert_allclose(numbers[number].xy, place, atol=1e-9)
            np.testing.assert_allclose(np.sign(np.round(numbers[number].xyann, 9)), side)
        inward = numbers["14"]  # into the hole
        self.assertLess(np.dot(inward.xy, inward.xyann), 0)

    def test_a_picture_is_written_whole_or_not_at_all(self) -> None:
        with mock.patch.object(drawing, "VECTOR_DPI", 20):
            self.assertEqual(self.draw(json.dumps(MODEL)), (0, "", ""))
        self.assertTrue((self.results / "model.png").read_bytes().startswith(b"\x89PNG"))
        (self.results / "model.png").unlink()
        status, out, err = self.draw("no JSON")
        self.assertEqual((status, out, err.count("\n")), (2, "", 1))
        self.assertIn("curves.json: ", err)
        self.assertFalse((self.results / "model.png").exists())
