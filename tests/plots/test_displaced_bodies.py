"""Outlines, walls and loads in pictures of fields.  /usr/bin/python3 -m unittest FILE"""
import unittest
from dataclasses import replace

import matplotlib
import numpy as np

import drawn
import running  # finds plots

import field_drawing
import gallery
from bars import bar
from fields import by_edge, parts


class DisplacedTest(unittest.TestCase):
    def setUp(self) -> None:
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(gallery.STYLE)
        s = bar(10, 8, 1)
        load = np.zeros_like(s.boundary)
        load[0, :, 1] = -3  # below: pulls; above it would push
        load[-2, :, 1] = -1.5
        self.s = replace(s, moved=np.full_like(s.boundary, 0.004), load=load,
                         normal=np.tile([[[1.0, 0.0]]], (len(s.edges), 2, 1)),
                         gap=np.full((len(s.edges), 2), 0.001))

    def test_displacements_are_enlarged_by_a_round_number(self) -> None:
        self.assertIsNone(field_drawing.enlargement([bar(10, 8, 1)]))
        for moved, times in ((0.004, 50), (0.001, 200), (0.0001, 2000), (1, 0.2)):
            s = replace(self.s, moved=np.full_like(self.s.boundary, moved))
            self.assertAlmostEqual(field_drawing.enlargement([s]), times, 9)
            self.assertAlmostEqual(field_drawing.enlargement([replace(s, moved=s.moved / 9), s]), times, 9)
        self.assertIsNone(field_drawing.enlargement([replace(s, moved=0 * s.moved)]))

    def test_edges_have_as_many_points_as_stresses_of_their_degree(self) -> None:
        ends = np.array([[[0, 0], [3, 0]], [[3, 0], [3, 1]], [[7, 7], [4, 3]]])
        for m in (2, 3, 5):
            on = np.linspace(ends[:, 0], ends[:, 1], m, axis=1)
            lengths = np.repeat([3, 1, 5], m)[:, None]
            points = np.hstack([on.reshape(-1, 2), np.zeros((3 * m, 2)), lengths])
            np.testing.assert_array_equal(by_edge(points)[:, [0, -1], :2], ends)
            self.assertIsNone(by_edge(points[1:]))
        self.assertEqual(by_edge(np.empty((0, 9))).shape, (0, 2, 9))
        np.testing.assert_allclose(parts(np.array([[0, 3], [3, 4.5]]), 3),
                                   [[0, 1], [1, 2], [2, 3], [3, 3.5], [3.5, 4], [4, 4.5]])

    def test_control_values_make_a_polynomial(self) -> None:
        places = np.linspace(0, 1, 7)
        np.testing.assert_allclose(field_drawing.sampled(np.array([[1, 4.]]), places)[0], 1 + 3 * places)
        # (1 - s)^2 + 2 s (1 - s) 5 + 3 s^2
        np.testing.assert_allclose(field_drawing.sampled(np.array([[1, 5, 3.]]), places)[0],
                                   1 + 8 * places - 6 * places**2)

    def test_a_wall_keeps_its_shape_under_a_curved_face(self) -> None:
        """A body pressed by 0.004 mm against the flat wall x = 11, from which its face bends away."""
        s = self.s
        bent = s.edges.copy()
        bent[..., 0] -= 0.01 * (bent[..., 1] - 6)**2
        s = replace(s, edges=bent, boundary=np.where((s.role == "contact")[:, None, None], 0, s.boundary))
        s.boundary[s.role == "contact"] = bent
        thirds = np.array([[2, 1], [1, 2]]) / 3
        distance = 11 - np.einsum("kc,ec->ek", thirds, bent[..., 0])
        s = replace(s, gap=distance - 0.004)
        for state in (np.full_like(s.state, "open"), s.state):
            wall, = field_drawing.walls_of(replace(s, state=state), 50)
            np.testing.assert_allclose(wall[:, 0], wall[0, 0], atol=1e-12)  # as before it is enlarged
        # An open edge is a chord of the face from which its gap is measured.
        chord = replace(s, gap=s.gap - 0.05 * (s.state == "open"))
        np.testing.assert_allclose(field_drawing.walls_of(chord, 50)[0], wall, atol=1e-12)
        # No point touches it: the enlarged gap where it is least.
        wall, = field_drawing.walls_of(replace(s, state=np.full_like(s.state, "open")), 50)
        self.assertAlmostEqual(wall[0, 0], 11 + 49 * distance.min())
        np.testing.assert_allclose(field_drawing.walls_of(s, 1)[0][:, 0], 11)

    def test_a_face_that_presses_on_a_body_has_no_wall(self) -> None:
        paired = replace(self.s, paired=np.ones(len(self.s.edges), bool))
        self.assertEqual(field_drawing.walls_of(paired, 50), [])
        for s, words in ((self.s, "A wall keeps its shape"), (paired, "may cross each other")):
            self.assertIn(words, gallery.caption([s]))
        labels = [text.get_text() for text in gallery.compose([[paired]]).legends[0].get_texts()]
        self.assertNotIn("wall", labels)

    def test_outline_wall_and_loads_are_drawn_and_named(self) -> None:
        figure = gallery.compose([[self.s]])
        body = figure.axes[0]
        self.assertEqual(body.get_xlabel(), "x, mm; displacements × 50; loads to 3 MPa")
        outline, = (line for line in body.lines if line.get_linestyle() == "--"
                    and line.get_color() == field_drawing.OUTLINE["color"])
        np.testing.assert_allclose(outline.get_xydata()[0], self.s.boundary[0, 0] + 0.2)
        wall, = (line for line in body.lines if line.get_color() == field_drawing.WALL["color"])
        np.testing.assert_allclose(wall.get_xdata(), 11 + 50 * (0.004 + 0.001))
        arrows = [text for text in body.texts if text.arrow_patch]
        self.assertGreater(len(arrows), 5)
        pulls = [text for text in arrows if text.xy[1] < 0.5 * figure.get_size_inches()[1] * 72]
        lengths = {round(float(np.hypot(*np.subtract(text.xyann, text.xy)))) for text in arrows}
        self.assertEqual(lengths, {field_drawing.ARROW_PT, field_drawing.ARROW_PT // 2})
        for text in arrows:
            self.assertLess(text.xy[1], text.xyann[1])  # all downwards
        self.assertTrue(pulls)
        words = drawn.words_of(figure) + gallery.caption([self.s])
        for word in ("outline, displaced", "wall", "held", "stick", "keeps its shape"):
            self.assertIn(word, words)
