"""The figures that are grids of cells, of made-up records.  /usr/bin/python3 -m unittest FILE"""
from collections import Counter


import made_up  # finds plots

import drawn
from drawn import words_of
from figure import atlas as atlas_figure
from made_up import read


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
