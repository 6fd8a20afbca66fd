"""plots/gallery.py on a made-up square of two triangles.  /usr/bin/python3 -m unittest FILE"""
import shutil
import struct
import tempfile
import unittest
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from unittest import mock

import numpy as np
from matplotlib import colormaps
from PIL import Image

import drawn
from running import FolderTest, names_in, run, run_command

import field_drawing
import fields
import gallery
from drawing import STEPS

CORNERS = [(0, 0), (2, 0), (2, 2), (0, 2)]  # mm; contact on x = 2, displacement on x = 0
LOW = [(0, 0), (0.125, 0), (0.125, 2), (0, 2)]  # of a lower body, for smaller pictures
TRIANGLES = [(0, 1, 2), (0, 2, 3)]
SMALL = mock.patch.object(gallery, "DPI", 20)  # where nobody looks at the picture
NAMES = [f"{mesh}--default--3STEPD" for mesh in ("Mesh0", "Mesh1", "Mesh3", "Mesh4")]


def stress_at(x: float, y: float) -> tuple[float, float, float]:
    """Linear: sxx, syy, sxy in MPa."""
    return -100 + 10 * x, 5 * y, 20 - x


def write_shares(folder: Path, name: str, shares: list[object]) -> Path:
    path = folder / f"{name}.error.csv"
    rows = [f"{t},{share}" for t, share in enumerate(shares, 1)]
    path.write_text("\n".join([fields.ERROR, *rows]) + "\n", encoding="utf-8")
    return path


def write_solution(folder: Path, name: str, contact: bool = True,
                   corners: list[tuple[float, float]] = CORNERS) -> None:
    rows = [fields.STRESS]
    for t, vertices in enumerate(TRIANGLES):
        v = [np.array(corners[i], float) for i in vertices]
        for c in range(9):
            third, corner = divmod(c, 3)
            x, y = sum(v) / 3 if corner == 2 else v[(third + corner) % 3]
            rows.append(",".join(map(str, (t + 1, third + 1, corner + 1, x, y, *stress_at(x, y)))))
    roles = ["force", "contact" if contact else "force", "force", "displacement"]
    edges = [(*corners[k], *corners[(k + 1) % 4], 0, *(0, -3) * 2, role) if role == "force" else
             (*corners[k], *corners[(k + 1) % 4], 0, *[0] * 4, role) for k, role in enumerate(roles)]
    (x, y), (_, end) = corners[1:3]
    points = [f"{x},{y},1,0,{end - y},-30,-6,0,0.01,,1,slip",
              f"{x},{end},1,0,{end - y},0,0,0.02,,,1,open"] if contact else []
    for part, lines in (("stress", rows), ("contact", [fields.CONTACT, *points]),
                        ("boundary", [fields.BOUNDARY, *(",".join(map(str, e)) for e in edges)])):
        (folder / f"{name}.{part}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


def solution(table: str = "") -> fields.Fields:
    """The square, read from its files, with a results.csv where one is given."""
    with tempfile.TemporaryDirectory() as folder:
        results = Path(folder)
        (results / "fields").mkdir()
        write_solution(results / "fields", NAMES[0])
        if table:
            (results / "results.csv").write_text(table)
        return fields.read_fields(results, NAMES[0], fields.recorded(results))


class GalleryTest(FolderTest):
    program = gallery

    @classmethod
    def setUpClass(cls) -> None:
        """The four meshes, drawn by a process of its own, and again with --each and --out."""
        cls.four = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.four)
        (cls.four / "fields").mkdir()
        for name in NAMES:
            write_solution(cls.four / "fields", name, contact=name == NAMES[3], corners=LOW)
        cls.out = cls.four / "some" / "where"
        cls.command = run_command(gallery, cls.four)
        cls.each = run(gallery, cls.four, "--each", "--out", cls.out)

    def setUp(self) -> None:
        super().setUp()
        self.fields = self.results / "fields"
        self.fields.mkdir()

    def assert_png(self, path: Path, width: int, most_bytes: int = 1_000_000) -> None:
        data = path.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">I", data[16:20])[0], width)
        self.assertLess(len(data), most_bytes)

    def edit(self, part: str, change) -> str:
        """Passes the lines of Mesh1's file, else whole, through change; its path."""
        for name in NAMES:
            write_solution(self.fields, name)
        path = self.fields / f"{NAMES[1]}.{part}.csv"
        path.write_text("\n".join(change(path.read_text().splitlines())) + "\n")
        return str(path)

    def test_the_four_meshes_make_one_picture(self) -> None:
        self.assertEqual((self.command[0], self.command[2]), (0, ""))
        figures = self.four / "figures"
        self.assertEqual(names_in(figures), {"gallery.png", "gallery.svg", "gallery.csv", "gallery.txt"})
        self.assert_png(figures / "gallery.png", 996)
        svg = (figures / "gallery.svg").read_text()
        self.assertTrue(svg.startswith("<?xml"))
        self.assertLess(len(svg), 2_000_000)

    def test_each_and_out(self) -> None:
        self.assertEqual(self.each[0], 0)
        self.assertEqual(names_in(self.out),
                         {"gallery.svg", *(f"{name}.{kind}" for kind in ("png", "csv", "txt") for name in
                                           ("gallery", *(f"fields_{name}" for name in NAMES)))})

    def test_the_same_input_gives_the_same_picture(self) -> None:
        for name in ("gallery.png", "gallery.svg"):
            self.assertEqual((self.four / "figures" / name).read_bytes(),
                             (self.out / name).read_bytes(), name)

    def test_element_map_of_the_error(self) -> None:
        write_solution(self.fields, NAMES[1], contact=False)
        write_shares(self.fields, NAMES[1], [0.25, 0.75])
        self.assertEqual(run(gallery, self.results)[0], 0)
        picture = self.figures / f"error_map_{NAMES[1]}.png"
        self.assert_png(picture, 691, most_bytes=300_000)
        lines = picture.with_suffix(".csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines[0], "triangle,x_mm,y_mm,area_mm2,error_share")
        self.assertEqual([line.split(",")[0::3] for line in lines[1:]], [["1", "2.0"], ["2", "2.0"]])
        self.assertEqual([line.split(",")[4] for line in lines[1:]], ["0.25", "0.75"])

    def test_no_error_no_map(self) -> None:
        write_solution(self.fields, NAMES[1], contact=False)
        write_shares(self.fields, NAMES[1], [0, 0])
        with SMALL:
            status, out, err = run(gallery, self.results)
        self.assertEqual((status, err), (0, ""))
        self.assertIn(f"error_map_{NAMES[1]}: left out: the solution has no", out)

    def test_three_levels_of_an_adaptive_loop_are_side_by_side(self) -> None:
        names = [f"Mesh0~adapt{level}--default--HYBRID" for level in (0, 2, 10, 11)]
        for name in names:
            write_solution(self.fields, name, corners=LOW)
            write_shares(self.fields, name, [0.25, 0.75])
        self.assertEqual([names[0], names[2], names[3]],
                         gallery.levels_in([*sorted(names), NAMES[0]]))
        self.assertEqual([], gallery.levels_in(names[:2]))
        with SMALL:
            status, out, err = run(gallery, self.results)
        self.assertEqual((status, err), (0, ""))
        self.assertIn("adapted_meshes.png", out)
        self.assert_png(self.figures / "adapted_meshes.png", 913)
        lines = (self.figures / "adapted_meshes.csv").read_text().splitlines()
        self.assertEqual([line.split(",")[:3] for line in lines],
                         [["mesh", "n_phi", "triangles"], *([f"Mesh0+adapt{k}", "", "2"]
                                                            for k in (0, 10, 11))])

    def test_the_last_levels_of_all_degrees_are_side_by_side(self) -> None:
        names = ["Mesh0~adapt9--default--HYBRID", "Mesh0~adapt10--default--HYBRID",
                 "Mesh0~adapt2k3--default--HYBRID+k=3", "Mesh0~adapt2k3--default--P2", "L~adapt1--L--HYBRID"]
        degrees = {1: names[1], 3: names[2]}
        self.assertEqual(degrees, gallery.degrees_in(names))
        self.assertEqual({}, gallery.degrees_in(names[:2] + names[3:]))
        for name in degrees.values():
            write_solution(self.fields, name, corners=LOW)
            write_shares(self.fields, name, [0.25, 0.75])
        with SMALL:
            self.assertEqual(run(gallery, self.results)[::2], (0, ""))
        with Image.open(self.figures / "adapted_degrees.png") as picture:  # the ends of its scales are kept
            colours = {colour for _, colour in picture.convert("RGB").getcolors(2**16)}
        for scale in ("viridis", "cividis"):
            for end in (0.0, 1.0):
                self.assertIn(tuple(STEPS[round(255 * part)] for part in colormaps[scale](end)[:3]), colours)
        maps = [(fields.read_fields(self.results, name, {}), np.r_[0.25, 0.75], 0.01) for name in names[1:3]]
        words = drawn.words_of(gallery.draw_levels(maps, ("degree 1", "degree 3")))
        self.assertIn("degree 3 2 triangles, total error 1 %", words)

    def test_only_draws_what_is_asked_for_and_removes_nothing(self) -> None:
        names = ["Mesh0~adapt1--default--HYBRID", "Mesh0~adapt1k2--default--HYBRID+k=2"]
        for name in names:
            write_solution(self.fields, name)
            write_shares(self.fields, name, [0.25, 0.75])
        with SMALL:
            self.assertEqual(run(gallery, self.results, f"--only=error_map_{names[0]}")[::2], (0, ""))
            self.assertEqual(run(gallery, self.results, "--only=adapted_d*")[::2], (0, ""))
        self.assertEqual(names_in(self.figures), {f"{picture}.{kind}" for kind in ("png", "csv", "txt")
                                                  for picture in ("adapted_degrees", f"error_map_{names[0]}")})
        status, out, err = run(gallery, self.results, "--only=adapted_meshes")
        self.assertEqual((status, out, err.count("\n")), (2, "", 1))
        self.assertIn("'adapted_meshes' is no picture of these fields (there are: fields_", err)

    def test_pictures_of_what_is_no_longer_there_are_removed(self) -> None:
        write_solution(self.fields, NAMES[0], contact=False)
        write_shares(self.fields, NAMES[0], [0.25, 0.75])
        with SMALL:
            run(gallery, self.results)
            self.assertEqual({f"{what}_{NAMES[0]}.{kind}" for what in ("fields", "error_map")
                              for kind in ("png", "csv", "txt")}, names_in(self.figures))
            (self.figures / "mine.png").touch()
            write_solution(self.fields, NAMES[1], contact=False)
            (self.results / "results.csv").write_text(
                "mesh,scene,method,n_phi\nMesh1,default,3STEPD,761\n")
            status, out, _ = run(gallery, self.results)
        self.assertEqual(status, 0)
        self.assertIn(f"left out, fields of no recorded case: {NAMES[0]}\n", out)
        self.assertIn(f"removed, of other fields: error_map_{NAMES[0]}.csv, error_map", out)
        self.assertEqual({"mine.png", *(f"fields_{NAMES[1]}.{kind}" for kind in ("png", "csv", "txt"))},
                         names_in(self.figures))

    def test_boundaries_of_an_earlier_bench_are_read(self) -> None:
        write_solution(self.fields, NAMES[0])
        path = self.fields / f"{NAMES[0]}.boundary.csv"
        new = fields.read_fields(self.results, NAMES[0], {})
        rows = [line.split(",") for line in path.read_text().splitlines()]
        path.write_text("".join(",".join(row[:4] + row[-1:]) + "\n" for row in rows))
        old = fields.read_fields(self.results, NAMES[0], {})
        self.assertIsNone(old.load)
        np.testing.assert_array_equal(new.load[0], [[0, -3], [0, -3]])
        np.testing.assert_array_equal(old.boundary, new.boundary)

    def test_element_map_that_cannot_be(self) -> None:
        write_solution(self.fields, NAMES[1])
        for shares, words in (([1], ": 1 rows; expected one for each of the 2 triangles"),
                              ([0.1, -0.1], ":3: error_share is '-0.1', expected a number from"),
                              ([0.5, "much"], ":3: error_share is 'much', expected a finite")):
            path = write_shares(self.fields, NAMES[1], shares)
            self.assert_refused(f"{path}{words}")
        path.write_text("triangle,share\n1,1\n")
        self.assert_refused(f"{path}:1: expected the header {fields.ERROR}")

    def test_missing_folders_and_files(self) -> None:
        path = self.edit("contact", lambda lines: lines)
        Path(path).unlink()
        for start in (run, run_command):
            self.assert_refused(path, "No such file", start=start)
        shutil.rmtree(self.fields)
        self.assert_refused(f"{self.fields}: no fields", "bench --fields")
        self.results.rmdir()
        self.assert_refused(f"{self.results}: no such folder", "bench --fields")
        self.results.mkdir()

    def test_files_that_cannot_be(self) -> None:
        def replaced(word: str) -> Callable[[list[str]], list[str]]:
            return lambda lines: [*lines[:3], f"1,1,3,1.3,{word},0,0,0", *lines[4:]]

        for part, change, *words in (
                ("stress", lambda lines: lines[:-1] + [lines[-1].rsplit(",", 2)[0]],
                 ":19: 6 values, expected 8"),
                *(("stress", replaced(word), f":4: y_mm is '{word}', expected a finite number")
                  for word in ("abc", "nan", "")),
                ("contact", lambda lines: [lines[0], lines[1].replace("-6", ""), lines[2]],
                 ":2: F_t_N is '', expected a finite number"),
                ("contact", lambda lines: [lines[0], lines[1].replace("slip", "glue"), lines[2]],
                 ":2: state is 'glue'", "open, stick, slip"),
                ("boundary", lambda lines: lines[1:], ":1: expected the header x0_mm"),
                ("stress", lambda lines: lines[:-1], ": 17 rows; expected nine per triangle"),
                ("boundary", lambda lines: lines[:-2], "", "expected the 4 mm^2"),
                ("contact", lambda lines: lines[:-1],
                 ": 1 points; expected start and end of each of the 1 contact")):
            with self.subTest(part, words=words):
                self.assert_refused(self.edit(part, change) + words[0], *words[1:])
        self.edit("stress", lambda lines: lines[:-9])
        self.assert_refused("encloses 4 mm^2; expected the 2 mm^2")

    def test_damaged_table_of_results(self) -> None:
        self.edit("stress", lambda lines: lines)
        (self.results / "results.csv").write_text("mesh,scene\nMesh1,default\n")
        self.assert_refused(str(self.results / "results.csv"),
                            "no columns method; expected one each of mesh")

    def test_wrong_option_and_unusable_out(self) -> None:
        write_solution(self.fields, NAMES[0])
        self.assert_refused("--nonsense", arguments=("--nonsense",))
        self.assert_refused("expected a folder to write to",
                            arguments=("--out", self.fields / f"{NAMES[0]}.stress.csv"))


class ErrorMapTest(unittest.TestCase):
    def test_share_of_the_worst_tenth(self) -> None:
        share = np.r_[np.full(90, 1.0), np.full(10, 9.0)]
        self.assertAlmostEqual(gallery.share_of_worst(share), 0.5)
        self.assertAlmostEqual(gallery.share_of_worst(np.array([3.0, 1.0])), 0.75)
        self.assertEqual([gallery.most_of(part) for part in (0.75, 0.994, 0.997, 1)],
                         ["75 %", "99 %", "more than 99 %", "100 %"])


class FieldsTest(unittest.TestCase):
    def test_read_back(self) -> None:
        s = solution("mesh,scene,method,n_phi\nMesh0,other,3STEPD,1\nMesh0,default,3STEPD,761\n")
        self.assertEqual((s.points.shape, s.mesh, s.n_phi), ((2, 3, 3, 2), "Mesh0", 761))
        np.testing.assert_array_equal(s.triangles[1], [CORNERS[0], CORNERS[2], CORNERS[3]])
        np.testing.assert_allclose(s.traction, [[[-30, -6], [0, 0]]])  # F = (L/2) t, L = 2
        self.assertEqual(s.state.tolist(), [["slip", "open"]])

    def test_chains(self) -> None:
        def edge(a: float, b: float) -> list:
            return [[0, a], [0, b]]
        edges = np.array([edge(1, 2), edge(5, 6), edge(0, 1), edge(2, 3)])
        self.assertEqual([c.tolist() for c in fields.chains(edges)], [[1], [2, 0, 3]])
        corners = np.array([[0, 0], [1, 0], [0, 1]], float)
        ring = np.stack([corners, np.roll(corners, -1, 0)], 1)
        self.assertEqual([c.tolist() for c in fields.chains(ring)], [[0, 1, 2]])
        line = np.array([[0, 0], [1, 0], [2, 0.1], [3, 0]], float)  # of one body, and of another on it
        back = line[::-1] + [[0, 0], [0, 1e-13], [0.3, 0], [0, 0]]
        both = np.array([side[k:k + 2] for side in (line, back) for k in range(3)])
        self.assertEqual([c.tolist() for c in fields.chains(both)], [[0, 1, 2], [3, 4, 5]])

    def test_a_face_around_a_hole_begins_where_its_y_is_least(self) -> None:
        s = solution()
        self.assertEqual([face.tolist() for face in s.faces()], [[0]])
        hole = np.array([(1, 1), (1, 2), (2, 2), (2, 0.5)], float)
        ring = np.stack([hole, np.roll(hole, -1, axis=0)], 1)[[2, 0, 3, 1]]
        self.assertEqual([face.tolist() for face in replace(s, edges=ring).faces()], [[2, 1, 3, 0]])

    def test_largest_shear_is_that_of_mohrs_circle(self) -> None:
        stress = np.random.default_rng(1).normal(size=(20, 3))
        tensors = stress[:, [[0, 2], [2, 1]]]
        principal = np.linalg.eigvalsh(tensors)
        np.testing.assert_allclose(fields.largest_shear(stress), np.ptp(principal, axis=1) / 2)

    def test_cutting_keeps_linear_functions_and_area(self) -> None:
        corners = np.array([[(0, 0), (3, 0), (1, 2)], [(1, 1), (2, 5), (0, 4)]], float)
        for parts in (1, 2, 5):
            pieces = field_drawing.cut(corners, parts)
            self.assertEqual(pieces.shape, (2 * parts**2, 3, 2))
            a, b = (pieces[:, k] - pieces[:, 0] for k in (1, 2))
            areas = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
            np.testing.assert_allclose(areas[:parts**2], 3 / parts**2)
            values = field_drawing.cut(corners @ [[2.0], [-1.0]], parts)
            np.testing.assert_allclose(values, pieces @ [[2.0], [-1.0]])
