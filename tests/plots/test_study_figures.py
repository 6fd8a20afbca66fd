"""The studies' figures of made-up records.  /usr/bin/python3 -m unittest FILE"""
import functools
import shutil
import struct
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

import numpy as np
from matplotlib.figure import Figure

import made_up  # finds plots

import drawing as sheets
import drawn
import figures
from catalogue import SIZES
from drawn import words_of
from figure import convergence as convergence_figure
from figure import memory as memory_figure
from figure import pareto as pareto_figure
from figure import stop as stop_figure
from figure import work_precision as work_precision_figure
from made_up import read
from records import Row
from running import names_in, run
from selection import front
from words import percent


@dataclass(frozen=True)
class Drawn:
    folder: Path
    figures: dict[str, Figure]
    run: tuple[int, str, str]


write_small_png = sheets.write_small_png


@functools.cache
def everything() -> Drawn:
    """A results folder with all studies, drawn once for the tests that look at its figures."""
    results = Path(tempfile.mkdtemp())
    unittest.addModuleCleanup(shutil.rmtree, results)
    few = [row for row in made_up.error_study(["Mesh0"], sweep=False) if not row["knob"]]
    made_up.write(results / "results.csv", few + made_up.error_study(["Mesh1"])
                  + made_up.stability_study("Mesh0") + made_up.sizes_to_the_limit())
    kept: dict[str, Figure] = {}

    def keep(figure: Figure, dpi: int, path: Path, colours: int) -> None:
        kept[path.stem] = figure
        write_small_png(figure, dpi, path, colours)
    with mock.patch.object(sheets, "write_small_png", keep), drawn.without_minor_ticks(), \
            mock.patch.object(sheets, "write", lambda figure, path: path.touch()):
        done = run(figures, results)
    return Drawn(results / "figures", kept, done)


class StudyFiguresTest(drawn.FiguresTest):
    def test_a_folder_with_everything(self) -> None:
        folder, (status, out, err) = everything().folder, everything().run
        self.assertEqual((status, err), (0, ""))
        names = {"work_precision_Mesh0", "work_precision_Mesh1", "stop_and_error", "pareto",
                 "convergence", "stability_Mesh0", "all_methods", "profiles",
                 "profiles_stability"}
        self.assertEqual({Path(name).stem for name in names_in(folder)},
                         names | {"figure4", "figure5", "table1", "measured", "budget"})
        self.assertEqual(out.count("\n"), len(names) + 6)  # figure3 is left out
        for path in (folder / f"{name}.png" for name in names):
            data = path.read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            self.assertLess(len(data), 300_000, path.name)
            self.assertGreaterEqual(struct.unpack(">I", data[16:20])[0], 800, path.name)

    def test_what_cannot_be_drawn_is_said(self) -> None:
        rows = [row | dict(error_discretisation="", error_total="")
                for row in made_up.error_study(["Mesh0"], sweep=False)[:12]]
        self.figures.mkdir()
        (self.figures / "pareto.png").touch()
        out, _ = self.draw(rows)
        self.assertIn("pareto: left out: no row has time_s and an error_total up to 1; an earlier "
                      "pareto.png stays", out)
        self.assertIn("convergence: left out: fewer than two meshes", out)
        self.assertIn("stop_and_error: left out: no two methods NAME:r=..,rho=..", out)

    def test_the_papers_figures_pass_over_studies(self) -> None:
        planned = figures.drawings_of(read(made_up.error_study(["Mesh0"])[:5]))
        self.assertEqual([drawing.name for drawing in planned],
                         ["convergence", "pareto", "stop_and_error", "work_precision_Mesh0"])


class WorkPrecisionTest(drawn.FiguresTest):
    def test_curves_and_the_papers_stop(self) -> None:
        rows = read(made_up.error_study(["Mesh1"]))
        curves = work_precision_figure.curves_of(rows)
        self.assertEqual(len(curves[("ALM", "uzawa iterations")]), 10)  # without its paper stop
        self.assertEqual(len(curves[("HYBRID", "contact sweeps")]), 6)
        self.assertEqual(len(curves[("HYBRID", "")]), 1)
        self.assertNotIn(("P2", ""), curves)  # it has no error of its own
        for curve in curves.values():
            values = [row.knob_value or 0 for row in curve]
            self.assertEqual(values, sorted(values))
        words = words_of(everything().figures["work_precision_Mesh1"])
        self.assertIn("ALM with the paper's stop:\nerror 7 %", words)
        for method, _ in curves:
            self.assertIn(method, words)

    def test_many_parameters_are_behind_the_best_of_them(self) -> None:
        cases = made_up.error_study(["Mesh1"], sweep=False)
        for r, factor in ((1, 3.0), (20, 1.0), (300, 0.5)):
            cases += [made_up.point("Mesh1", f"ALM:r={r},rho={r}", factor * 0.01 * 2**k, 1e-3 * 4.0**-k
                                    * (1 if k < 4 or r == 1 else 1e2), knob="uzawa iterations",
                                    knob_value=2**k) for k in range(8)]
        rows = read(cases)
        own, = work_precision_figure.families_of(work_precision_figure.curves_of(rows)).values()
        self.assertEqual(len(own), 24)
        best = front(own, "time_s", "error_force")
        self.assertGreater(len({row.method for row in best}), 1)
        for row in own:
            self.assertLessEqual(min(other.error_force for other in best
                                     if other.time_s <= row.time_s), row.error_force)
        figure = work_precision_figure.draw(rows)
        words = words_of(figure)
        self.assertIn("ALM, best of given r, ρ", words)
        self.assertIn("the best of its 3 given r and ρ, known only afterwards", words)
        self.assertNotIn("ALM:r=", words)
        lines = {line.get_color(): line for line in figure.axes[0].lines
                 if len(line.get_xdata()) == len(best) and line.get_linewidth() == 2}
        line, = lines.values()
        np.testing.assert_array_equal(line.get_xdata(), [row.time_s for row in best])
        grey = [line for line in figure.axes[0].lines
                if line.get_color() == work_precision_figure.GREY]
        self.assertEqual([len(line.get_xdata()) for line in grey], [8] * 3)
        self.assertTrue(all(line.get_zorder() < 2 for line in grey))


class ParetoTest(drawn.FiguresTest):
    def test_nothing_beats_the_front(self) -> None:
        rows = read(made_up.error_study(["Mesh0", "Mesh1", "Mesh2", "Mesh3"]))
        for column in ("time_s", "peak_heap_bytes"):
            cheapest = front(rows, column, "error_total", pareto_figure.GAIN)
            self.assertGreater(len(cheapest), 3)
            for row in rows:
                cheaper = [other for other in cheapest
                           if getattr(other, column) <= getattr(row, column)]
                if cheaper:  # at equal cost or less it is at most 1 % better than all on the front
                    best = min(other.error_total for other in cheaper)
                    self.assertGreaterEqual(row.error_total * (1 + 1e-12), 0.99 * best)
                else:
                    self.fail(f"{row} is cheaper than all on the front")

    def test_table_names_the_cheapest(self) -> None:
        rows = read(made_up.error_study(["Mesh0", "Mesh3"]))
        stress = [row for row in rows if row.method != "P2"]
        for level in (0.25, 0.1):
            best = pareto_figure.cheapest(stress, level)
            self.assertLessEqual(best.error_total, level)
            self.assertFalse([row for row in stress if row.error_total <= level
                              and row.time_s < best.time_s])
        self.assertIsNone(pareto_figure.cheapest(rows, 1e-3))
        table = pareto_figure.levels_table(rows)
        self.assertEqual({len(line) for line in table}, {8})
        self.assertEqual(table[-1][0], percent(0.1))
        self.assertEqual((table[-1][2], table[-1][5]), ("Mesh3", "Mesh3"))


class ConvergenceTest(drawn.FiguresTest):
    def test_rate(self) -> None:
        rows = read(made_up.error_study(list(SIZES), sweep=False))
        bodies = convergence_figure.points_of(rows, "default")
        self.assertEqual([p.mesh for p in bodies["one tooth"]], list(SIZES)[:4])
        for points in bodies.values():  # made as n_phi^-0.45
            self.assertAlmostEqual(convergence_figure.rate(points), 0.9, 6)
        words = words_of(convergence_figure.draw(rows))
        self.assertIn("one tooth: $h^{0.90}$", words)
        self.assertIn("bounds of the energy, rack", words)


class MemoryFigureTest(drawn.FiguresTest):
    def bars(self, *lines: dict) -> list[Row]:
        drawings = list(memory_figure.drawings(made_up.read_lines(list(lines))))
        return drawings[0].rows if drawings else []

    def test_bars_of_the_largest_mesh_by_their_peaks(self) -> None:
        bars = self.bars(made_up.split("Mesh0", "3STEPD"), made_up.split("Mesh0", "HYBRID"),
                         made_up.split("Mesh1", "SSKY", preconditioner=(9, 9)),
                         made_up.split("Mesh1", "BLIND", factor=(30, 10), other=(1, None)),
                         *(made_up.split("Mesh1", f"SYMMLQ:SSOR{k}") for k in range(30)),
                         made_up.split("Mesh2", "3STEPD"))        # alone
        figure = memory_figure.draw(bars, bars)
        axes, = figure.axes
        self.assertEqual([label.get_text() for label in axes.get_yticklabels()], ["SSKY", "BLIND"])
        ends = [max(bar.get_x() + bar.get_width() for bar in axes.patches
                    if abs(bar.get_y() + bar.get_height() / 2 - place) < 0.1) for place in (0, 1)]
        np.testing.assert_allclose(ends, [11, 33])  # MiB, with 2 of the blocks
        count, = (line for line in axes.lines if line.get_label() == "the method's own count")
        np.testing.assert_allclose(count.get_xdata(), [11, 12])
        words = words_of(figure)
        self.assertIn("Mesh1", words)
        self.assertIn("33 MiB, counted 12 MiB", words)
        self.assertIn("preconditioner", words)
        self.assertNotIn("answer", words)
        self.assertNotIn("differs", words)

    def test_other_records_are_passed_over(self) -> None:
        other = made_up.split("Mesh0", "3STEPD")
        self.assertEqual(self.bars(
            other | {"stop": "paper"}, other | {"method": "a", "memory_by_owner": None},
            other | {"method": "b", "status": "timeout"},
            other | {"study": "error"}), [])

    def test_is_drawn_from_the_folder_and_bad_lines_are_refused(self) -> None:
        good = [made_up.split("Mesh0", "3STEPD"), made_up.split("Mesh0", "HYBRID")]
        made_up.write_lines(self.lines, good)
        out, _ = self.draw()
        self.assertIn("memory_by_owner.png, .csv: 2 cases", out)
        shutil.rmtree(self.figures)
        made_up.write_lines(self.lines, [*good, made_up.split("Mesh0", "P2", wings=(1, 1))])
        self.assert_refused("records.jsonl:3", "memory_by_owner", "wings", "blocks")
        self.lines.write_text("no JSON\n", encoding="utf-8")
        self.assert_refused("records.jsonl:1", "not JSON")


class OtherFiguresTest(drawn.FiguresTest):

    def test_stop_and_error(self) -> None:
        rows = read(made_up.error_study(["Mesh1"]))
        curve, = stop_figure.curves_of(rows).values()
        self.assertEqual([stop_figure.parameters_of(row)[0] for row in curve], [5, 20, 80, 320, 1280])
        self.assertIn("errors from 0.039 % to 10 %", words_of(stop_figure.draw(rows, rows)))
