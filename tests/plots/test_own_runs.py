"""Runs of one's own: methods, preconditioners and bodies that nothing here knows by name."""
import json
import shutil
import tempfile
import unittest
from pathlib import Path

import matplotlib
from matplotlib.figure import Figure

import made_up  # finds plots

import drawn
import figures
import made_up_history
import page
from drawing import STYLE, Drawing

BODIES = {"punch": ["punch1", "punch2", "punch3"],
          "dovetail": ["dovetail1", "dovetail2", "dovetail3"]}
METHODS = ("3STEPD", "ALM", "SDTIC3", "NEWTON", "HYBRID")  # NEWTON is one's own
PRECONDITIONERS = ("DTIC3", "DTIC4", "DTIC5", "SKY", "JACOBI")  # and JACOBI
HEAP = 50


def ordinary_run() -> list[dict[str, object]]:
    """Both bodies next to each other, and the preconditioners on the largest mesh of each."""
    rows = []
    for mesh in made_up.OWN:
        for k, method in enumerate(METHODS):
            size = made_up.OWN[mesh].n_phi
            rows.append(made_up.split(mesh, method, factor=(k + 1, k + 1))
                        | dict(time_s=1e-7 * (k + 1) * size**1.2, peak_heap_bytes=HEAP * size))
    for mesh in ("punch3", "dovetail3"):
        for family in ("SYMMLQ", "3STEPCG"):
            rows += [made_up.split(mesh, f"{family}:{name}") | dict(time_s=1.0 + k)
                     for k, name in enumerate(PRECONDITIONERS)]
    return [made_up.record(row) for row in rows]


def points_of(figure: Figure) -> set[tuple[float, float]]:
    return {tuple(point) for axes in figure.axes for line in axes.lines
            for point in line.get_xydata()}


class OwnRunTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        cls.run_ = cls.drawings(ordinary_run())
        cls.study = cls.drawings([made_up.record(row) for row in made_up.error_study(
            list(made_up.OWN), sweep=False)] + [made_up.record(made_up.point(
                mesh, "NEWTON", 1e-5, 1e-13)) for mesh in made_up.OWN])

    @classmethod
    def drawings(cls, lines: list[dict]) -> dict[str, Drawing]:
        return {drawing.name: drawing
                for drawing in figures.drawings_of(made_up.read_lines(lines))}

    def test_preconditioners(self) -> None:
        figure = self.run_["figure3"].figure()
        self.assertEqual([axes.get_title() for axes in figure.axes[::2]][:4],
                         ["SYMMLQ", "3STEPCG"] * 2)  # of both bodies
        for lower in figure.axes[1:8:2]:
            self.assertEqual([label.get_text() for label in lower.get_xticklabels()],
                             ["3", "4", "5", "SKY", "JACOBI"])
        words = drawn.words_of(figure)
        self.assertIn("punch3, 2500; dovetail3, 2700 degrees of freedom", words)
        self.assertEqual(sum(row.preconditioner == "JACOBI"
                             for row in self.run_["figure3"].rows), 4)
        self.assertIn((4 + 0.5 * 2, 5.0), points_of(figure))  # its place and its time

    def test_time_and_memory(self) -> None:
        for name, value in (("figure4", lambda row: row.time_s),
                            ("figure5", lambda row: row.peak_heap_bytes / 2**20)):
            drawing = self.run_[name]
            self.assertEqual({row.method for row in drawing.rows}, set(METHODS))
            figure = drawing.figure()
            blocks = [axes for axes in figure.axes if axes.get_xlabel() == r"$n_\varphi$"]
            self.assertEqual(len(blocks), 2)  # the sizes of the bodies overlap
            for axes, (body, meshes) in zip(blocks, BODIES.items()):
                words = [text.get_text() for text in axes.texts]
                for word in (body, *meshes, *METHODS):
                    self.assertIn(word, words)
                values = {round(point[1], 9) for line in axes.lines for point in line.get_xydata()}
                for row in drawing.rows:
                    self.assertEqual(round(value(row), 9) in values, row.body == body)
            self.assertEqual(len({text.get_text() for axes in blocks for text in axes.texts
                                  if text.get_text().startswith("$n^")}), 1)  # one power each

    def test_all_methods(self) -> None:
        figure = self.run_["all_methods"].figure()
        self.assertEqual(len(figure.axes), 6)
        words = drawn.words_of(figure)
        self.assertIn("Lines are interrupted between bodies", words)
        self.assertEqual(words.count("NEWTON $n"), 6)
        for k, meshes in enumerate(BODIES.values()):
            time = figure.axes[3 * k]
            self.assertEqual([text.get_text() for text in time.texts][-3:], meshes)
        colours = {line.get_color() for line in figure.axes[0].lines if len(line.get_xdata()) == 3
                   and line.get_marker() != "None"}
        self.assertEqual(len(colours), len(METHODS))

    def test_memory_by_owner(self) -> None:
        figure = self.run_["memory_by_owner"].figure()
        self.assertEqual([axes.get_title(loc="left") for axes in figure.axes],
                         ["punch3", "dovetail3"])
        for axes in figure.axes:
            names = [label.get_text() for label in axes.get_yticklabels()]
            self.assertTrue({"NEWTON", "SYMMLQ:JACOBI", "3STEPCG:JACOBI"} < set(names), names)

    def test_bodies_do_not_share_a_front(self) -> None:
        drawing = self.study["pareto"]
        figure = drawing.figure()
        self.assertEqual(len(figure.axes), 4)  # time and memory of each
        for k, (body, meshes) in enumerate(BODIES.items()):
            own = [row for row in drawing.rows if row.body == body]
            self.assertEqual({row.mesh for row in own}, set(meshes))
            front = next(line for line in figure.axes[2 * k].lines if line.get_linewidth() == 2.2)
            self.assertLessEqual(set(front.get_ydata()), {row.error_total for row in own})
            words = " ".join(text.get_text() for text in figure.axes[2 * k].texts)
            self.assertIn(f"NEWTON, {meshes[-1]}", words)
        self.assertIn("P2: mesh", drawn.words_of(figure))

    def test_convergence_of_each_body(self) -> None:
        words = drawn.words_of(self.study["convergence"].figure())
        for body in BODIES:
            self.assertIn(f"{body}: $h^{{0.90}}$", words)
            self.assertIn(f"bounds of the energy, {body}", words)

    def test_work_precision(self) -> None:
        self.assertEqual({name for name in self.study if name.startswith("work_")},
                         {f"work_precision_{mesh}" for mesh in made_up.OWN})
        figure = self.study["work_precision_punch2"].figure()
        self.assertIn("NEWTON", drawn.words_of(figure))
        self.assertIn((1e-5, 1e-13), points_of(figure))

    def test_page(self) -> None:
        history = self.folder / "history"
        (history / "nights").mkdir(parents=True)
        for night in range(2):
            made = made_up_history.made_up_night(night) | {"cases": ordinary_run(), "verdicts": []}
            (history / "nights" / f"{night}.json").write_text(json.dumps(made), encoding="utf-8")
        data = page.page_data(page.read_history(history), None)
        self.assertEqual(data["bodies"], list(BODIES))
        self.assertEqual([case["body"] for case in data["cases"]], ["punch"] * 25 + ["dovetail"] * 25)
        own = [case for case in data["cases"] if case["family"] == "NEWTON"]
        self.assertEqual(len(own), 6)
        self.assertEqual(own[0]["name"], "punch1/default/NEWTON")
        row = next(row for row in data["rows"] if row["method"] == "3STEPCG:JACOBI")
        self.assertEqual((row["name"], row["body"]), ("punch3/default/3STEPCG:JACOBI", "punch"))
