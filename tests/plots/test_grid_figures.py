"""The figures that are grids of cells, of made-up records.  /usr/bin/python3 -m unittest FILE"""
from collections import Counter


import made_up  # finds plots

import drawn
from drawn import words_of
from figure import atlas as atlas_figure
from made_up import read


class AdaptedMethodsTest(drawn.FiguresTest):
    CASES = [made_up.case(mesh, method, study="adapted", n_phi=n_phi, time_s=time_s,
                          error_discretisation=0.005, error_total=0.005, condition_estimate=3e9)
             for mesh, n_phi in (("Mesh0+adapt2", 1500), ("Mesh4+adapt1", 15000))
             for method, time_s in (("HYBRID", 0.01), ("3STEPD", 0.2))]

    def test_a_cell_per_case_and_a_table_beside_it(self) -> None:
        lost = dict(status="timeout", outcome="timeout", time_s="", error_force="", error_stress="")
        rows = read([*self.CASES[:3], self.CASES[3] | lost])
        drawing = drawn.plan(rows, "adapted_methods")
        self.assertEqual((".png", ".csv"), drawing.suffixes)
        figure = drawing.figure()
        self.assertEqual(4, len(figure.axes[0].patches))
        words = words_of(figure)
        for expected in ("HYBRID", "10 ms", "κ 3e9", "timeout", "0.5 %"):
            self.assertIn(expected, words)
        self.assertEqual([line["outcome"] for line in drawn.table_of(drawing)].count("timeout"), 1)
        self.assertEqual(len(drawn.table_of(drawing)), 4)


class AtlasTest(drawn.FiguresTest):
    def test_a_cell_per_case(self) -> None:
        rows = read(made_up.stability_study())
        figure = atlas_figure.draw(rows)
        places = [patch.get_xy() for patch in figure.axes[0].patches]
        self.assertEqual((len(places), len(set(places))), (len(rows), len(rows)))
        words = words_of(figure)
        wrong = sum(row.outcome == "wrong_success" for row in rows)
        self.assertIn(f"wrong success: reported ok, but is not: {wrong}", words)
        self.assertEqual(words.split().count("W!"), wrong + 1)
        for row in rows:
            self.assertIn(row.scene, words)
            self.assertIn(row.scene_group, words)

    def test_digits(self) -> None:
        for stress, force, digits in ((1e-9, 2e-7, "6"), (0, 0, "16"), (1e-12, "", "12"),
                                      ("", "", "+"), (5, "", "0")):
            row = made_up.stability_study()[0] | dict(error_stress=stress, error_force=force)
            self.assertEqual(atlas_figure.digits(read([row])[0]), digits)

    def test_scenes_go_by_group_then_by_number(self) -> None:
        row = made_up.stability_study()[0]
        names = [("b", f"friction_{mu}") for mu in ("10", "1e-8", "1", "10_sheared", "0")]
        names.append(("a", "z"))
        rows = read([row | dict(scene_group=g, scene=s) for g, s in names])
        self.assertEqual(atlas_figure.scenes_of(rows),
                         [names[5], names[4], names[1], names[2], names[0], names[3]])

    def many(self, methods: int) -> list[dict]:
        some = [row for row in made_up.stability_study() if row["method"] == "3STEPD"]
        return [row | made_up.of_method(f"SYMMLQ:V{k}") for k in range(methods) for row in some]

    def test_more_methods_than_there_is_room_for_go_on_below(self) -> None:
        for methods, blocks in ((50, 1), (100, 2)):
            rows = read(self.many(methods))
            figure = atlas_figure.draw(rows)
            self.assertEqual(len(figure.axes), blocks)
            self.assertEqual(sum(len(axes.patches) for axes in figure.axes), len(rows))
            for axes in figure.axes:
                inches = axes.get_position().width * figure.get_size_inches()[0]
                self.assertGreaterEqual(inches / axes.get_xlim()[1], atlas_figure.NARROWEST - 1e-9)

    def test_its_table_has_the_digits(self) -> None:
        rows = read(made_up.stability_study())
        table = drawn.table_of(drawn.plan(rows, "stability_Mesh0"))
        self.assertEqual(len(table), len(rows))
        self.assertEqual(Counter(line["digits"] for line in table if line["outcome"] == "ok"),
                         Counter(atlas_figure.digits(row) for row in rows if row.outcome == "ok"))
        self.assertEqual({line["digits"] for line in table if line["outcome"] != "ok"}, {""})
