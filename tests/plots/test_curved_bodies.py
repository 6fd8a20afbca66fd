"""Pictures of a body with a curved side: a slice of 40° of a disc.  /usr/bin/python3 -m unittest FILE"""
import base64
import unittest
from pathlib import Path

import matplotlib
import numpy as np

import running  # finds plots
from running import FolderTest

import field_drawing
import fields
import gallery
from lagrange_cells import along_side, steps_of

NAME, ANGLE, DEGREE, RADIUS = "slice--default--HYBRID+k=2", np.radians(40), 3, 2.0
CORNERS = RADIUS * np.array([(1, 0), (np.cos(ANGLE), np.sin(ANGLE)), (0, 0)])


def point(weights: np.ndarray, third: int) -> np.ndarray:
    """(P, 3) -> (P, 2) mm: the first third is curved."""
    a, b, centre = CORNERS[third], CORNERS[(third + 1) % 3], CORNERS.mean(0)
    if third:
        return weights @ np.array([a, b, centre])
    rho = 1 - weights[:, 2]
    angle = ANGLE * weights[:, 1] / np.where(rho > 0, rho, 1)
    arc = RADIUS * np.stack([np.cos(angle), np.sin(angle)], 1)
    return centre + rho[:, None] * (arc - centre)


def stress_at(x: np.ndarray) -> np.ndarray:
    """Quadratic; its largest shear stress is x² + y²."""
    return np.stack([0 * x[:, 0], 0 * x[:, 0], (x * x).sum(1)], 1)


def array(name: str, values: np.ndarray, components: int = 3) -> str:
    """As bench writes it: the number of bytes first."""
    data = np.ascontiguousarray(values, float).tobytes()
    text = base64.b64encode(len(data).to_bytes(8, "little") + data).decode()
    return f'<DataArray type="Float64" {name} NumberOfComponents="{components}">{text}</DataArray>'


def with_z(values: np.ndarray) -> np.ndarray:
    return np.hstack([values, 0 * values[:, :1]])


def write_slice(folder: Path) -> None:
    """Its curved side in contact, points on the curve, where the edge is as long as its arc."""
    weights = steps_of(DEGREE) / DEGREE
    points = np.vstack([point(weights, third) for third in range(3)])
    ends = [np.array([a, b, CORNERS.mean(0)]) for a, b in zip(CORNERS, np.roll(CORNERS, -1, 0))]
    rows = [(1, k + 1, c + 1, *x, *stress_at(x[None])[0]) for k, third in enumerate(ends)
            for c, x in enumerate(third)]
    boundary = [(*a, *b, 0, 0, 0, 0, 0, role) for (a, b, _), role in
                zip(ends, ("contact", "displacement", "force"))]
    on_arc = point(np.array([(1, 0, 0), (0.5, 0.5, 0), (0, 1, 0)]), 0)
    contact = [(*x, *x / RADIUS, ANGLE * RADIUS, -6, 0, 0, 0, "", 1, "slip") for x in on_arc]
    files = {"stress": (fields.STRESS, rows), "boundary": (fields.BOUNDARY, boundary),
             "contact": (fields.CONTACT, contact),
             "displacement": (fields.DISPLACEMENT, [(1, k + 1, *x, 0, 0) for k, x in enumerate(CORNERS)])}
    for part, (header, lines) in files.items():
        text = "\n".join([header, *(",".join(map(str, line)) for line in lines)])
        (folder / f"{NAME}.{part}.csv").write_text(text + "\n", encoding="utf-8")
    (folder / f"{NAME}.vtu").write_text(
        '<?xml version="1.0"?><VTKFile type="UnstructuredGrid"><UnstructuredGrid>'
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="3"><PointData>'
        + array('Name="stress_MPa"', stress_at(points)) + array('Name="displacement_mm"', with_z(0.01 * points))
        + "</PointData><Points>" + array("", with_z(points)) + "</Points></Piece></UnstructuredGrid></VTKFile>")


class CurvedBodyTest(FolderTest):
    program = gallery

    def setUp(self) -> None:
        super().setUp()
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(gallery.STYLE)
        (self.results / "fields").mkdir()
        write_slice(self.results / "fields")
        self.vtu = self.results / "fields" / f"{NAME}.vtu"

    def read(self) -> fields.Fields:
        return fields.read_fields(self.results, NAME, {})

    def test_outlines_follow_the_curve_and_its_displacements(self) -> None:
        s = self.read()
        arc, = s.edges
        np.testing.assert_allclose(np.hypot(*arc.T), RADIUS, rtol=1e-3)
        self.assertAlmostEqual(float(fields.lengths_of(s.edges)[0]), ANGLE * RADIUS, 2)
        np.testing.assert_array_equal(arc[[0, -1]], CORNERS[:2])
        np.testing.assert_allclose(s.moved, 0.01 * s.boundary, atol=1e-12)
        for third, tip in ((1, CORNERS[1]), (2, CORNERS[0])):  # straight sides stay
            np.testing.assert_allclose(np.cross(s.boundary[third], tip), 0, atol=1e-12)
        figure = gallery.compose([[s]])
        contact, _ = (line for line in figure.axes[0].lines if line.get_color() == "#D00060")  # and a dot
        np.testing.assert_allclose(contact.get_xydata(), arc)
        displaced, = (line for line in figure.axes[0].lines
                      if line.get_color() == field_drawing.OUTLINE["color"])
        farthest = np.hypot(*displaced.get_xydata().T)
        np.testing.assert_allclose(farthest[:len(arc)], (1 + 0.01 * field_drawing.enlargement([s])) * RADIUS,
                                   rtol=1e-3)

    def test_stresses_are_drawn_as_polynomials_on_curved_thirds(self) -> None:
        s = self.read()
        xy, stress = (field_drawing.cut(of[0], 4).reshape(-1, of.shape[-1]) for of in (s.points, s.stress))
        np.testing.assert_allclose(stress[:, 2], (xy * xy).sum(1), atol=2e-2)
        self.assertAlmostEqual(float(np.hypot(*xy[:48].T).max()), RADIUS, 3)
        self.assertAlmostEqual(float(np.hypot(*s.outlines[0].T).max()), RADIUS, 3)

    def test_a_curved_face_is_straightened_along_its_arc(self) -> None:
        s = self.read()
        line = fields.unrolled(s.edges)
        self.assertAlmostEqual(line.limits[1], ANGLE * RADIUS, 2)
        off = line.of(along_side(10, 12) @ s.points[0, 0])[:, 0]
        self.assertLess(np.abs(off).max(), 0.01)  # the chord is off by 0.12
        self.assertAlmostEqual(s.traction[0, 1, 0], -6 / (ANGLE * RADIUS / 3))

    def test_without_cells_of_a_higher_degree_sides_are_straight(self) -> None:
        self.vtu.unlink()
        s = self.read()
        self.assertEqual((s.points.shape[2], s.boundary.shape), (3, (3, 2, 2)))

    def test_cells_that_are_not_the_solution_s_are_refused(self) -> None:
        text = self.vtu.read_text()
        other = f"other triangles than in {NAME}.stress.csv"
        for wrong, words in ((text[:500], "not as bench --fields writes it"),
                             (text.replace('NumberOfCells="3"', 'NumberOfCells="4"'), "not as bench"),
                             (text.replace('NumberOfCells="3"', 'NumberOfCells="6"'), other)):
            self.vtu.write_text(wrong)
            self.assert_refused(str(self.vtu), words)


if __name__ == "__main__":
    unittest.main()
