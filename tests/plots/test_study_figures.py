"""The studies' figures of made-up records.  /usr/bin/python3 -m unittest FILE"""
import shutil
import struct

import numpy as np

import made_up  # finds plots

import drawn
import figures
from documents import documents_of
from drawing import PAGE_WIDTH
from drawn import words_of
from figure import memory_by_owner as memory_figure
from records import Row
from running import names_in, run


class StudyFiguresTest(drawn.FiguresTest):
    def test_a_folder_with_everything(self) -> None:
        few = [row for row in made_up.error_study(["Mesh0"], sweep=False) if not row["knob"]]
        made_up.write(self.csv, few + made_up.error_study(["Mesh1"]) + made_up.stability_study("Mesh0")
                      + made_up.sizes_to_the_limit())
        with drawn.without_minor_ticks():
            status, out, err = run(figures, self.results)
        self.assertEqual((status, err), (0, ""))
        names = {"error_time", "error_time_forces", "convergence", "outcomes_Mesh0", "size", "profiles",
                 "profiles_stability"}
        self.assertEqual(names_in(self.figures), {f"{name}.{kind}" for name in names for kind in ("png", "csv", "txt")}
                         | {"table1.md", "measured.md", "budget.csv", "budget.md"})
        self.assertEqual(out.count("\n"), len(names) + 3)
        for path in self.figures.glob("*.png"):
            data = path.read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            self.assertLess(len(data), 300_000, path.name)
            self.assertGreaterEqual(struct.unpack(">I", data[16:20])[0], 600, path.name)

    def test_no_figure_asks_for_the_name_of_a_study(self) -> None:
        """A copy of a study under another name has the same figures of the same cases, with the same numbers."""
        def drawn_of(names: dict[str, str]) -> list[tuple[str, str, str]]:
            rows = made_up.read_lines([line | {"study": names.get(line["study"], line["study"])} for line in lines])
            return [(drawing.name, drawing.table(drawing.rows), documents_of(rows).keys())
                    for drawing in figures.drawings_of(rows)]
        lines = made_up.of_all_kinds()
        studies = [study for study in {line["study"] for line in lines} if study]
        self.assertEqual(drawn_of({}), drawn_of({study: f"{study} again" for study in studies}))
        self.assertEqual(drawn_of({}), drawn_of(dict(zip(studies, studies[1:] + studies[:1]))))  # names of others

    def test_what_cannot_be_drawn_is_said(self) -> None:
        self.figures.mkdir()
        (self.figures / "profiles.png").touch()
        out, _ = self.draw([made_up.case("Mesh0", "3STEPD")])
        self.assertIn("profiles: left out: 1 method on 1 case that all of them have; needs 2 and 3; an earlier "
                      "profiles.png stays", out)

    def test_figures_of_ordinary_runs_pass_over_studies(self) -> None:
        planned = figures.drawings_of(made_up.read(made_up.error_study(["Mesh0"])[:5]))
        self.assertEqual([drawing.name for drawing in planned], ["error_time", "error_time_forces"])


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
        figure = memory_figure.draw(bars, PAGE_WIDTH, bars)
        axes, = figure.axes
        self.assertEqual([label.get_text() for label in axes.get_yticklabels()], ["SSKY", "BLIND"])
        ends = [max(bar.get_x() + bar.get_width() for bar in axes.patches
                    if abs(bar.get_y() + bar.get_height() / 2 - place) < 0.1) for place in (0, 1)]
        np.testing.assert_allclose(ends, [11, 33])  # MiB, with 2 of the blocks
        count, = axes.lines
        np.testing.assert_allclose(count.get_xdata(), [11, 12])
        words = words_of(figure)
        self.assertIn("Mesh1", words)
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
        self.assertIn("memory_by_owner.png, .csv, .txt: 2 cases", out)
        shutil.rmtree(self.figures)
        made_up.write_lines(self.lines, [*good, made_up.split("Mesh0", "P2", wings=(1, 1))])
        self.assert_refused("records.jsonl:3", "memory_by_owner", "wings", "blocks")
        self.lines.write_text("no JSON\n", encoding="utf-8")
        self.assert_refused("records.jsonl:1", "not JSON")
