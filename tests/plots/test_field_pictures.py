"""How the pictures of the fields lie, and what they say of contact.  /usr/bin/python3 -m unittest FILE"""
import csv
import unittest
from dataclasses import replace
from itertools import combinations

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

import drawn
import running  # finds plots

import field_drawing
import field_panel
import gallery
from bars import STATES, bar
from fields import Fields, unrolled
from drawing import PAGE_WIDTH, SMALLEST_PT


class UprightTest(unittest.TestCase):
    def setUp(self) -> None:
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(gallery.STYLE)

    def test_bodies_lie_as_they_were_drawn(self) -> None:
        for mesh in ("Mesh0", "Mesh4+adapt2", "bar"):
            s = bar(10, 8, 1, mesh=mesh)
            for figure in (gallery.compose([[s]]), gallery.draw_map(s, np.array([0.3, 0.7]))):
                body = figure.axes[0]
                self.assertEqual((body.get_xlabel(), body.get_ylabel()), ("x, mm", "y, mm"))
                for low, high in (body.get_xlim(), body.get_ylim()):
                    self.assertLess(low, high)
                contact = [line for line in body.lines if line.get_color() == "#D00060"]
                for line in contact:
                    np.testing.assert_allclose(line.get_xdata(), 11)
                self.assertEqual(len(contact), 1)
                size = body.get_position().size * figure.get_size_inches()
                self.assertAlmostEqual(size[1] / size[0], field_panel.slenderness(s))

    def test_type_can_be_read_and_stays_on_the_sheet(self) -> None:
        for s in (bar(10, 8, 1), bar(10, 40, 4), bar(40, 5, 3, edges=40)):
            for figure in (gallery.compose([[s]]), gallery.draw_map(s, np.array([0.3, 0.7]))):
                self.assertLessEqual(figure.get_size_inches()[0], PAGE_WIDTH)
                painted, renderer = drawn.paint(figure)
                for words in painted:
                    self.assertGreaterEqual(words.get_fontsize(), SMALLEST_PT, words)
                    box = words.get_window_extent(renderer)
                    self.assertTrue(0 <= box.x0 and box.x1 <= figure.bbox.x1, words)


class FacesTest(unittest.TestCase):
    def test_a_face_that_is_open_for_the_most_part_is_drawn_where_it_touches(self) -> None:
        s = bar(10, 8, 1, edges=20)
        state = np.full_like(s.state, "open")
        state[8:12] = "stick"
        few = replace(s, state=state)
        figure = gallery.compose([[few]])
        length = s.edges[-1, 1, 1] - s.edges[0, 0, 1]
        shown = np.ptp(figure.axes[1].get_xlim())
        self.assertLess(shown, 0.4 * length)
        words = "contact zone only"
        self.assertIn(words, gallery.caption([few]))
        always = replace(few, touched=np.full(s.state.shape, True))  # in some other step
        for whole in (gallery.compose([[s]]), gallery.compose([[always]])):
            self.assertGreater(np.ptp(whole.axes[1].get_xlim()), length)
            self.assertNotIn(words, gallery.caption([s]))

    def test_faces_do_not_cover_each_other_or_the_body(self) -> None:
        for s, width in ((bar(10, 8, 1), 2.7), (bar(10, 8, 3), 2.7), (bar(10, 8, 9), 8.3),
                         (bar(10, 60, 5), 8.3), (bar(10, 60, 1), 8.3)):
            layout = field_panel.layout_of(s, width)
            boxes = [(field_panel.LEFT, field_panel.TITLE, layout.body_width, layout.body_height)]
            boxes += [(p.left, p.top, p.width, p.strip + p.traction) for p in layout.faces]
            self.assertEqual(len(boxes), 1 + len(s.faces()))
            for left, top, across, down in boxes:
                self.assertGreater(min(across, down), 0.3)
                self.assertLessEqual(left + across, width + 1e-9)
                self.assertLessEqual(top + down, layout.height + 1e-9)
            for (l1, t1, w1, h1), (l2, t2, w2, h2) in combinations(boxes, 2):
                self.assertTrue(l1 + w1 <= l2 or l2 + w2 <= l1 or t1 + h1 <= t2 or t2 + h2 <= t1)


class UnrolledTest(unittest.TestCase):
    def arc(self, count: int, whole: float = np.pi) -> np.ndarray:
        """Edges of an arc of radius 5 from (5, 0) on, the centre on their left."""
        angle = np.linspace(0, whole, count + 1)
        points = 5 * np.stack([np.cos(angle), np.sin(angle)], 1)
        if whole == 2 * np.pi:
            points[-1] = points[0]
        return np.stack([points[:-1], points[1:]], 1)

    def test_a_straight_face_keeps_its_coordinate(self) -> None:
        line = unrolled(np.array([[[3, -1], [3, 0.5]], [[3, 0.5], [3, 2]]], float))
        self.assertEqual(line.axis, "y, mm")
        points = np.random.default_rng(1).uniform(-5, 8, (40, 2, 2))  # also beyond its ends
        np.testing.assert_allclose(line.of(points), points - [3, 0], atol=1e-12)

    def test_an_arc_goes_by_its_length(self) -> None:
        line = unrolled(self.arc(400))
        self.assertEqual(line.axis, "distance along the face from its dot, mm")
        for radius, angle in ((5, 0.3), (4, 1.0), (4.5, 3.0), (5.2, 2.0)):
            outward, along = line.of(radius * np.array([np.cos(angle), np.sin(angle)]))
            self.assertAlmostEqual(outward, radius - 5, 3)
            self.assertAlmostEqual(along, 5 * angle, 2)
        below = line.of(np.array([[4.5, -0.7], [-4.2, -0.4]]))  # the lines that go on from the ends
        np.testing.assert_allclose(below, [[-0.5, -0.7], [-0.8, 5 * np.pi + 0.4]], atol=0.02)

    def test_the_body_around_a_hole_is_behind_its_face(self) -> None:
        hole = unrolled(self.arc(8, 2 * np.pi)[::-1, ::-1])  # coarse: corners are nearest to many
        for k in range(8):
            outward, _ = hole.of(6 * np.array([np.cos(k * np.pi / 4), np.sin(k * np.pi / 4)]))
            self.assertAlmostEqual(outward, -1)
        self.assertGreater(hole.of(np.array([0.0, 0.0]))[0], 4)

    def test_a_face_sees_all_triangles_next_to_it(self) -> None:
        s = bar(10, 8, 1)
        seen = unrolled(s.edges).seen(s, np.arange(4), 0.5)
        self.assertEqual((len(seen.points), seen.of_face), (2, True))
        np.testing.assert_allclose(seen.points, s.points - [11, 0], atol=1e-12)

    def test_a_ring_has_no_triangle_across_its_beginning(self) -> None:
        edges = self.arc(40, 2 * np.pi)
        self.assertTrue(unrolled(edges).closed)
        inner = 0.9 * edges
        corners = np.array([[edges[k, 0], edges[k, 1], inner[k, 0]] for k in range(40)])
        thirds = np.stack([np.roll(corners, -k, axis=1) for k in range(3)], 1)
        s = Fields("n", thirds, np.ones((40, 3, 3, 3)), edges, np.array(["contact"] * 40), edges,
                   np.zeros((40, 2, 2)), np.full((40, 2), "open"), "ring", None)
        line = unrolled(edges)
        seen = line.seen(s, np.arange(40), 1.0)
        self.assertGreaterEqual(len(seen.points), 38)
        width = np.ptp(seen.triangles[..., 1], axis=1)
        self.assertLess(width.max(), 2)
        np.testing.assert_allclose(seen.edges[:, 1, 1], np.cumsum(np.hypot(
            *(edges[:, 1] - edges[:, 0]).T)))


class ScalesTest(unittest.TestCase):
    def test_a_singular_corner_does_not_darken_the_body(self) -> None:
        values, weights = np.r_[np.linspace(1, 10, 999), 1000], np.ones(1000)
        self.assertAlmostEqual(field_drawing.highest_but(values, weights, 0.995, 1.6), 16, 0)
        self.assertEqual(field_drawing.highest_but(values[:-1], weights[:-1], 0.995, 1.6), 10)
        weights[-1] = 500  # now it is no corner
        self.assertEqual(field_drawing.highest_but(values, weights, 0.995, 1.6), 1000)

    def test_a_pressure_beyond_the_axis_is_said(self) -> None:
        s = bar(10, 8, 1, edges=40)
        self.assertFalse(gallery.compose([[s]]).axes[2].texts)
        s.traction[0, 0, 0] = -3456.7
        axes = gallery.compose([[s]]).axes[2]
        self.assertLess(max(axes.get_ylim()), 30)
        self.assertEqual([text.get_text() for text in axes.texts], ["up to 3460 MPa"])


class MeshLinesTest(unittest.TestCase):
    def brightness(self, count: int) -> float:
        """Of a square of so many triangles along a side, under one stress, over that of its colour."""
        at = np.linspace(0, 10, count + 1)
        a, b, c, d = (np.stack(np.meshgrid(x, y), -1).reshape(-1, 2) for x, y in
                      ((at[:-1], at[:-1]), (at[1:], at[:-1]), (at[1:], at[1:]), (at[:-1], at[1:])))
        triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
        thirds = np.stack([np.stack([triangles[:, k], triangles[:, (k + 1) % 3],
                                     triangles.mean(1)], 1) for k in range(3)], 1)
        stress = np.zeros((len(triangles), 3, 3, 3))
        stress[..., 2] = 1
        nothing = np.zeros((0, 2, 2))
        s = Fields("square", thirds, stress, nothing, np.array([]), nothing, nothing,
                   np.zeros((0, 2)), "square", None)
        figure = Figure(figsize=(3, 3))
        axes = figure.add_axes([0, 0, 1, 1], xlim=(0, 10), ylim=(0, 10))
        field_drawing.draw_stress(axes, s, np.full(len(triangles), True),
                                  field_drawing.Scales(Normalize(0, 1), 1))
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        inner = np.asarray(canvas.buffer_rgba())[20:-20, 20:-20, :3] / 255
        return float(inner.mean() / np.mean(matplotlib.colormaps[field_drawing.COLORMAP](1.0)[:3]))

    def test_lines_of_a_dense_mesh_do_not_darken_its_stress(self) -> None:
        for count in (5, 10, 20, 40, 80):
            self.assertGreater(self.brightness(count), 0.94, count)
        self.assertLess(self.brightness(5), 0.995)  # there are lines


class TablesTest(unittest.TestCase):
    def test_contact_points(self) -> None:
        table = list(csv.DictReader(field_panel.contact_points([bar(10, 60, 2)]).splitlines()))
        self.assertEqual(len(table), 2 * 4 * 2)
        self.assertEqual([line["face"] for line in table], ["A"] * 8 + ["B"] * 8)
        self.assertGreater(float(table[0]["y_mm"]), float(table[8]["y_mm"]))
        for k, line in enumerate(table[:8]):
            self.assertAlmostEqual(float(line["pressure_MPa"]), 8 * (1 - (k + 1) // 2 / 4))
            self.assertEqual(line["state"], STATES[k // 2])
            self.assertEqual((float(line["x_mm"]), line["along_mm"]), (11, line["y_mm"]))
