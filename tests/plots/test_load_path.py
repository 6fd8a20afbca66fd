"""A path of load steps: what is read of it, its picture and its animation.
/usr/bin/python3 -m unittest FILE"""
import csv
import os
from dataclasses import replace
from pathlib import Path
from unittest import mock

import matplotlib
import numpy as np
from PIL import Image

import drawn
from running import FolderTest, run
from test_gallery import LOW, write_solution

import fields
import gallery
import load_path
import load_path_drawing
from records import RecordsError

NAME = "Mesh0--default--3STEPD"
# Height and friction of a rectangle: 2 um wide, 12 N high, walked once from its first corner.
MOVED_UM, FORCE_N, DISSIPATED = (0, 0, 2, 2, 0, 0), (0, -6, -6, 6, 6, -6), (0, 0, 0.012, 0, 0.012, 0)
LOADS = (1, 2, 3, 4, 5, 2)


def said(path: load_path.LoadPath) -> str:
    """The caption in one line."""
    return " ".join(load_path_drawing.caption(path).split())


def write_path(results: Path, bodies: tuple[bool, ...] = (True,) * 6) -> None:
    """A face on x = 2 that is pushed up and down: its tangent is y; contact points get F_t / 2 each."""
    folder = results / "fields"
    steps = folder / f"{NAME}.steps"
    steps.mkdir(parents=True)
    write_solution(folder, NAME, corners=LOW)
    rows = [load_path.STEPS]
    for k, (moved, force, lost) in enumerate(zip(MOVED_UM, FORCE_N, DISSIPATED), 1):
        body = bodies[k - 1]
        write_solution(steps, f"{k:04}", corners=LOW)
        state = "stick" if k % 2 else "slip"
        points = [f"0.125,{y},1,0,2,-30,{force / 2},0,0,,1,{state}" for y in (0, 2)]
        (steps / f"{k:04}.contact.csv").write_text("\n".join([fields.CONTACT, *points]) + "\n")
        rows.append(f"{k},-60,{force},{lost},0,2,0,0,{moved / 1000},,,1,{LOADS[k - 1]},"
                    f"{'body' if body else 'contact'}")
    (folder / f"{NAME}.steps.csv").write_text("\n".join(rows) + "\n")


# Two edges of each of two bodies, from 0 to 2 on y = 0, in an order in which of two opposite points now
# one body's comes first, now the other's. Piece 1 is above.
PAIR = ((1, 0, 1, (6, 5)), (2, 2, 1, (8, 7)), (2, 1, 0, (2, 1)), (1, 1, 2, (4, 3)))


def write_pair(results: Path, moved: int, states: tuple[str, ...] = ("stick", "slip")) -> None:
    """At each point 10 N and 3 N, of the second step; the first has half of that."""
    steps = results / "fields" / f"{NAME}.steps"
    steps.mkdir(parents=True)
    rows = [load_path.STEPS]
    for k, state in enumerate(states, 1):
        points = [f"{x},0,0,{-1 if piece == 1 else 1},1,{-5 * k},{1.5 * k},0,0,{opposite},{piece},{state}"
                  for piece, start, end, others in PAIR for x, opposite in zip((start, end), others)]
        (steps / f"{k:04}.contact.csv").write_text("\n".join([fields.CONTACT, *points]) + "\n")
        rows.append(f"{k},{-20 * k},{6 * k},0,0,2,2,{0.001 * k},0,,,{moved},{k},contact")
    (results / "fields" / f"{NAME}.steps.csv").write_text("\n".join(rows) + "\n")


class PairTest(FolderTest):
    program = gallery

    def test_the_force_is_that_of_the_body_that_is_moved(self) -> None:
        for moved in (1, 2):  # a tangent turns with its body
            with self.subTest(moved):
                write_pair(self.results / str(moved), moved)
                path = load_path.read_path(self.results / str(moved), NAME)
                np.testing.assert_allclose(path.push, [-6, -12])
                np.testing.assert_allclose(path.normal, [20, 40])
                np.testing.assert_allclose(path.moved, [-0.001, -0.002] if moved == 2 else [0.001, 0.002])
                self.assertEqual((path.obstacle, path.faces), ("other body", 1))
                self.assertEqual(path.state.shape, (2, 4))
                words = said(path)
                self.assertIn("force Q of the body along the other body over the mean displacement of its "
                              "held boundary", words)


class LoadPathTest(FolderTest):
    program = gallery

    def setUp(self) -> None:
        super().setUp()
        write_path(self.results)
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(gallery.STYLE)

    def test_forces_displacements_and_the_loop(self) -> None:
        path = load_path.read_path(self.results, NAME)
        np.testing.assert_allclose(path.push, np.negative(FORCE_N))  # on the wall
        np.testing.assert_allclose(path.normal, 60)
        np.testing.assert_allclose(path.moved, np.array(MOVED_UM) / 1000)
        self.assertEqual((path.moved_what, path.faces, path.axis), ("held", 1, "y, mm"))
        np.testing.assert_allclose(path.traction[1], [[30, -3], [30, -3]])  # F = (L/2) t, L = 2
        self.assertEqual(path.state[:2].tolist(), [["stick"] * 2, ["slip"] * 2])
        # The rectangle of 2 um and 12 N is walked clockwise from step 2 to its end.
        self.assertEqual((path.cycle, path.is_normal), (slice(1, 6), False))
        self.assertAlmostEqual(path.area(), 0.024)
        self.assertAlmostEqual(path.dissipated_in_cycle(), 0.024)

    def test_a_path_that_does_not_return_has_no_loop(self) -> None:
        table = self.results / "fields" / f"{NAME}.steps.csv"
        table.write_text("\n".join(table.read_text().splitlines()[:5]) + "\n")
        path = load_path.read_path(self.results, NAME)
        self.assertIsNone(path.cycle)
        words = said(path)
        self.assertNotIn("shaded", words)

    def test_a_cycle_is_that_of_the_loads(self) -> None:
        path = load_path.read_path(self.results, NAME)
        for what, loads, cycle in (
                ("loaded, unloaded", "abcba", (1, 5)),
                ("pressed, then to and fro", "pabcbadeda", (2, 10)),  # not 6 to 10, half of it
                ("to and fro, once more", "pabcbadedabcb", (5, 13)),
                ("from turn to turn", "pabcbadedabc", (4, 12)),
                ("a larger cycle after a smaller one", "abacdca", (1, 7)),  # from another side: the longest
                ("a larger cycle after a smaller one, in steps", "abababcba", (5, 9)),
                ("and goes on", "abcbax", (1, 5)),
                ("held where it turns", "abbba", (1, 5)),
                ("held alone", "abbb", None)):
            with self.subTest(what):
                numbers = np.array([loads.index(load) + 1 for load in loads])
                found = replace(path, loads=numbers).cycle
                self.assertEqual(found and (found.start + 1, found.stop), cycle)

    def test_of_a_normal_motion_the_loop_is_the_normal_one(self) -> None:
        table = self.results / "fields" / f"{NAME}.steps.csv"
        numbered = [line.split(",") for line in table.read_text().splitlines()]
        for line, moved in zip(numbered[1:], (0, 3, 6, 6, 3, 0)):
            line[7], line[8] = str(moved / 1000), "0"
        table.write_text("\n".join(map(",".join, numbered)) + "\n")
        path = load_path.read_path(self.results, NAME)
        self.assertTrue(path.is_normal)
        np.testing.assert_allclose(path.push, 60)
        np.testing.assert_allclose(path.moved, [0, 0.003, 0.006, 0.006, 0.003, 0])
        self.assertEqual(path.turns, [2])
        words = said(path)
        self.assertIn("on the wall, normal to it", words.replace("\n", " "))

    def test_a_table_of_an_earlier_bench_has_no_loop(self) -> None:
        table = self.results / "fields" / f"{NAME}.steps.csv"
        lines = [line.split(",") for line in table.read_text().splitlines()]
        for left_out, cycle in ((1, slice(1, 6)), (2, None)):  # without the piece; without returns, too
            table.write_text("\n".join(",".join(line[:11] + line[11 + left_out:]) for line in lines) + "\n")
            for points in (self.results / "fields" / f"{NAME}.steps").glob("*.contact.csv"):
                points.write_text(points.read_text().replace("piece,", "").replace(",,1,", ",,"))
            path = load_path.read_path(self.results, NAME)
            self.assertEqual(path.cycle, cycle)
            np.testing.assert_allclose(path.push, np.negative(FORCE_N))

    def test_a_path_that_ends_unloaded_is_stood_for_by_its_most_loaded_step(self) -> None:
        points = self.results / "fields" / f"{NAME}.steps"
        for step, pressed in ((3, 40), (6, 0)):
            file = points / f"{step:04}.contact.csv"
            file.write_text(file.read_text().replace(",-30,", f",-{pressed},").replace(",-3.0,", ",0,"))
        path = load_path.read_path(self.results, NAME)
        self.assertEqual(path.telling_step, 2)
        self.assertEqual(replace(path, has_body=path.step != 3).telling_step, 1)
        s = gallery.read_telling(self.results, NAME, {}, path)
        self.assertEqual((s.name, s.traction[0, 0, 0]), (NAME, -40))
        words = gallery.caption([s])
        self.assertIn("Load step 3 of 6, the most loaded one: the last one is unloaded.", words)
        loaded = replace(path, pressed=np.ones(6))
        self.assertEqual(loaded.telling_step, 5)
        self.assertEqual(gallery.read_telling(self.results, NAME, {}, loaded).of_step, "")

    def test_the_picture_and_its_table(self) -> None:
        status, out, err = run(gallery, self.results)
        self.assertEqual((status, err), (0, ""))
        self.assertIn(f"load_path_{NAME}.png", out)
        self.assertNotIn(".gif", out)
        with (self.figures / f"load_path_{NAME}.csv").open() as file:
            lines = list(csv.DictReader(file))
        self.assertEqual([line["step"] for line in lines], list("123456"))
        self.assertEqual([(line["stick_mm"], line["slip_mm"]) for line in lines[:2]],
                         [("2.0", "0.0"), ("0.0", "2.0")])
        self.assertEqual(float(lines[3]["push_N"]), -6)
        figure = load_path_drawing.draw_path(load_path.read_path(self.results, NAME))
        words = said(load_path.read_path(self.results, NAME))
        for part in ("6 load steps", "From step 2 to step 6", "dissipates 0.024 N", "dU = 0.024 N",
                     "Force and displacement return"):
            self.assertIn(part, words)
        self.assertNotIn("not closed", words)
        painted, renderer = drawn.paint(figure)
        drawn.assert_readable(self, figure, painted, renderer)

    def test_work_and_dissipation_of_an_open_cycle_are_told_apart(self) -> None:
        table = self.results / "fields" / f"{NAME}.steps.csv"
        points = self.results / "fields" / f"{NAME}.steps" / "0006.contact.csv"
        points.write_text(points.read_text().replace(",-3.0,", ",-2.0,"))  # the last force is 4 N, not 6 N
        table.write_text(table.read_text().replace(",0.012,", ",0.005,"))
        words = said(load_path.read_path(self.results, NAME))
        for part in ("dissipates 0.01 N", "not the shaded area", "dU = 0.024 N", "(6 and 4 N/mm)",
                     "not closed", "difference of 0.014 N", "stored in the body"):
            self.assertIn(part, words)

    def test_frames_have_one_factor_one_scale_and_one_legend(self) -> None:
        path = load_path.read_path(self.results, NAME)
        s = fields.read_fields(self.results, f"{NAME}.steps/0001", {})
        count = len(s.boundary)
        steps = {k: replace(s, moved=np.full((count, 2, 2), moved), stress=(k + 1) * s.stress,
                            traction=(k + 1) * s.traction, state=np.full_like(s.state, state),
                            load=np.full((count, 2, 2), load))
                 for k, (moved, load, state) in enumerate(((1e-4, 3, "stick"), (7e-3, 1, "slip")))}
        first, second = load_path_drawing.frames(path, steps)
        for one, other in zip(first.axes, second.axes, strict=True):
            self.assertEqual((one.get_xlim(), one.get_ylim()), (other.get_xlim(), other.get_ylim()))
        factors = [figure.axes[0].get_xlabel().split("; ")[1] for figure in (first, second)]
        self.assertEqual(factors[0], factors[1])
        self.assertRegex(factors[0], r"displacements × \d+$")
        arrows = [{round(float(np.hypot(*np.subtract(text.xyann, text.xy)))) for text in
                   figure.axes[0].texts if text.arrow_patch} for figure in (first, second)]
        self.assertEqual(arrows, [{20}, {7}])  # of 3 MPa and of 1 MPa
        legends = [[text.get_text() for text in figure.legends[0].get_texts()] for figure in (first, second)]
        self.assertEqual(legends[0], legends[1])
        self.assertTrue({"stick", "slip"} <= set(legends[0]))

    def test_the_animation_has_a_frame_per_step_with_a_body_and_a_size_that_is_bounded(self) -> None:
        status, out, err = run(gallery, self.results, "--animate")
        self.assertEqual((status, err), (0, ""))
        moving = self.figures / f"load_path_{NAME}.gif"
        self.assertIn(str(moving), out)
        with Image.open(moving) as image:
            self.assertEqual((image.n_frames, image.info["loop"]), (6, 0))
            width = image.width
        self.assertLess(moving.stat().st_size, load_path_drawing.MOST_BYTES)
        small = self.results / "small.gif"
        path = load_path.read_path(self.results, NAME)
        steps = [fields.read_fields(self.results, f"{NAME}.steps/{k:04}", {}) for k in range(1, 4)]
        with mock.patch.object(load_path_drawing, "FRAME_MS", 100):
            def write(most: int) -> int:
                load_path_drawing.write_gif(load_path_drawing.frames(path, dict(enumerate(steps))), small, most)
                return small.stat().st_size
            whole = write(load_path_drawing.MOST_BYTES)
            self.assertLessEqual(write(whole * 2 // 3), whole * 2 // 3)
        with Image.open(small) as image:
            self.assertLess(image.width, width)

    def test_an_animation_stays_as_long_as_its_fields(self) -> None:
        with mock.patch.object(gallery, "write_gif", lambda frames, path: path.touch()):
            run(gallery, self.results, "--animate")
        moving = self.figures / f"load_path_{NAME}.gif"
        run(gallery, self.results)
        self.assertTrue(moving.exists())
        table = self.results / "fields" / f"{NAME}.steps.csv"
        later = moving.stat().st_mtime + 5
        os.utime(table, (later, later))
        out = run(gallery, self.results)[1]
        self.assertIn(f"removed, of other fields: {moving.name}", out)
        self.assertFalse(moving.exists())

    def test_frames_are_of_steps_with_a_body_the_last_one_included(self) -> None:
        path = load_path.read_path(self.results, NAME)
        self.assertEqual(load_path_drawing.frames_of(path), list(range(6)))
        many = mock.Mock(has_body=np.arange(1000) % 10 == 9)
        frames = load_path_drawing.frames_of(many)
        self.assertEqual((len(frames), frames[0], frames[-1]), (60, 9, 999))
        self.assertTrue(all(k % 10 == 9 for k in frames))

    def test_tables_that_cannot_be(self) -> None:
        table = self.results / "fields" / f"{NAME}.steps.csv"
        whole = table.read_text()
        for change, *words in ((lambda text: text.replace("\n3,", "\n4,", 1), "steps 1, 2, 3"),
                               (lambda text: text.replace(",body", ",bodies", 1), ":2: fields is"),
                               (lambda text: text.replace(",0.012,", ",,", 1), "dissipation_Nmm is ''"),
                               (lambda text: text.replace("step,", "steps,", 1), ":1: expected the header step,")):
            table.write_text(change(whole))
            with self.assertRaises(RecordsError) as raised:
                load_path.read_path(self.results, NAME)
            for word in words:
                self.assertIn(word, str(raised.exception))
        table.write_text(whole)
        points = self.results / "fields" / f"{NAME}.steps" / "0002.contact.csv"
        points.write_text(points.read_text().replace("0.125,0,", "0.125,0.5,"))
        with self.assertRaisesRegex(RecordsError, "0002.contact.csv: other contact points"):
            load_path.read_path(self.results, NAME)
        points.unlink()
        self.assertEqual(run(gallery, self.results)[0], 2)
