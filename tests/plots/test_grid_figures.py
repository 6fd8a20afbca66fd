"""The figures that are grids of cells, of made-up records.  /usr/bin/python3 -m unittest FILE"""
from collections import Counter

from matplotlib.patches import Rectangle

import made_up  # finds plots

import drawn
from drawn import words_of
from drawing import PAGE_WIDTH
from figure import outcomes as outcomes_figure
from made_up import read


class OutcomesTest(drawn.FiguresTest):
    def test_a_cell_per_case(self) -> None:
        rows = read(made_up.stability_study())
        figure = outcomes_figure.draw(rows, PAGE_WIDTH)
        cells = {tuple(patch.get_xy()) for patch in figure.axes[0].findobj(Rectangle) if patch.get_width() == 1} - {(0, 0)}  # the axes
        columns = outcomes_figure.columns_of(rows)
        self.assertEqual(len(cells), len({(row.scene, head) for row in rows for head, methods in columns.items()
                                          if row.method in methods}))
        words = words_of(figure)
        wrong = sum(row.outcome == "wrong_success" for row in rows)
        self.assertIn(f"wrong success: reported ok, but is not: {wrong}", words)
        for row in rows:
            self.assertIn(row.scene, words)
            self.assertIn(row.scene_group, words)

    def test_digits(self) -> None:
        for stress, force, digits in ((1e-9, 2e-7, "6"), (0, 0, "16"), (1e-12, "", "12"),
                                      ("", "", "+"), (5, "", "0")):
            row = made_up.stability_study()[0] | dict(error_stress=stress, error_force=force)
            self.assertEqual(outcomes_figure.digits(read([row])[0]), digits)

    def test_scenes_go_by_group_then_by_number(self) -> None:
        row = made_up.stability_study()[0]
        names = [("b", f"friction_{mu}") for mu in ("10", "1e-8", "1", "10_sheared", "0")]
        names.append(("a", "z"))
        rows = read([row | dict(scene_group=g, scene=s) for g, s in names])
        self.assertEqual(outcomes_figure.lines_of(rows),
                         [names[5], names[4], names[1], names[2], names[0], names[3]])

    def test_methods_without_room_share_a_column_of_their_family(self) -> None:
        some = [row for row in made_up.stability_study() if row["method"] == "3STEPD"]
        rows = read(some + [row | made_up.of_method(f"SYMMLQ:V{k}") | dict(outcome="timeout" if k < 5 else "ok")
                            for k in range(30) for row in some])
        self.assertEqual(list(outcomes_figure.columns_of(rows)), ["3STEPD", "SYMMLQ: 30 more"])
        line = [row for row in rows if row.scene == rows[0].scene and row.family == "SYMMLQ"]
        self.assertEqual(outcomes_figure.cell_of(line, False)[:2], ("25/30", outcomes_figure.MARKS["timeout"][1]))

    def test_a_wrong_success_is_the_worst(self) -> None:
        row = made_up.stability_study()[0]
        rows = read([row | made_up.of_method(f"ALM:V{k}") | dict(outcome=outcome, status="inaccurate") for k, outcome in
                     enumerate(("inaccurate", "wrong_success", "timeout"))])
        self.assertEqual(outcomes_figure.cell_of(rows, False)[1], outcomes_figure.MARKS["wrong_success"][1])

    def test_kappa_is_the_largest_of_a_line(self) -> None:
        rows = read([row | dict(condition_estimate=10.0**k) for k, row in enumerate(made_up.stability_study()[:3])])
        self.assertEqual(outcomes_figure.kappa_of(rows), 100)
        self.assertIn("κ", words_of(outcomes_figure.draw(rows, PAGE_WIDTH)))
        self.assertNotIn("κ", words_of(outcomes_figure.draw(read(made_up.stability_study()[:3]), PAGE_WIDTH)))

    def test_its_table_has_the_digits(self) -> None:
        rows = read(made_up.stability_study())
        table = drawn.table_of(drawn.plan(rows, "outcomes_Mesh0"))
        self.assertEqual(len(table), len(rows))
        self.assertEqual(Counter(line["digits"] for line in table if line["outcome"] == "ok"),
                         Counter(outcomes_figure.digits(row) for row in rows if row.outcome == "ok"))
        self.assertEqual({line["digits"] for line in table if line["outcome"] != "ok"}, {""})
