"""The paper's figures of made-up results.  /usr/bin/python3 -m unittest FILE"""
import subprocess
import tempfile
import unittest
from pathlib import Path

import made_up  # finds plots

import drawn
import figures
from catalogue import SIZES
from made_up import case, read
from running import PROJECT, names_in, run
from selection import exponent

UNFINISHED = dict(time_s="", peak_heap_bytes="", error_force="")
POWER = {method: 1.1 + 0.1 * k for k, method in enumerate(made_up.COMPARED)}
RUN = PROJECT / "run"
ALIASES = {general: alias for alias, general in made_up.SEVEN.items()}


def power_laws(**cells: object) -> list[dict[str, object]]:
    """The nine compared methods on all meshes; n_phi^POWER."""
    return [case(mesh, method, time_s=1e-7 * size.n_phi**POWER[method],
                 peak_heap_bytes=int(50 * size.n_phi**1.25), **cells)
            for mesh, size in SIZES.items() for method in POWER]


def preconditioners(mesh: str = "Mesh3") -> list[dict[str, object]]:
    names = [*(f"DTIC{k}" for k in range(3, 7)), *(f"FLIC{k}" for k in range(1, 6)), "SSOR0.5",
             "SSOR1.0", "SSOR1.5", "SKY", "NONE"]
    return [case(mesh, f"{krylov}:{name}", time_s=1 + k) for krylov in ("SYMMLQ", "3STEPCG")
            for k, name in enumerate(names)]


class PaperFiguresTest(drawn.FiguresTest):
    def write(self, rows: list[dict[str, object]]) -> None:
        made_up.write(self.csv, rows)

    def test_all_figures_of_both_stops(self) -> None:
        rows = power_laws()[:18] + [row for row in preconditioners() if "DTIC4" in row["method"]]
        self.write(rows + [row | {"stop": "paper"} for row in rows])
        with drawn.without_minor_ticks():
            status, out, err = run(figures, self.results)
        self.assertEqual((status, err), (0, ""))
        names = {f"{name}{twin}.{kind}" for name in ("preconditioners", "size") for twin in ("", "_paper_stop")
                 for kind in ("png", "csv", "txt")} | {"table1.md", "measured.md"}
        self.assertEqual(names_in(self.figures), names)
        self.assertEqual(out.count("that all of them have; needs 2 and 3"), 2)

    def test_the_same_input_gives_the_same_files(self) -> None:
        self.write(power_laws()[:18])
        for out in ("a", "b"):
            self.assertEqual(run(figures, self.results, "--vector", "--only=size", "--out", self.results / out)[0], 0)
        for name in names_in(self.results / "a"):
            self.assertEqual((self.results / "a" / name).read_bytes(), (self.results / "b" / name).read_bytes(), name)

    def test_a_run_of_one_case_or_one_mesh_compares_nothing(self) -> None:
        for rows in ([case("Mesh0", "HYBRID", error_total=0.04)], power_laws()[:9]):
            self.assertEqual(self.draw(rows)[1], {})

    def test_exponents_of_power_laws(self) -> None:
        words = self.draw(power_laws()[:27])[1]  # three meshes
        for power in POWER.values():
            self.assertIn(f"$n^{{{power:.2f}, 1.25}}$", words["size"])

    def test_exponents_need_three_completed_points(self) -> None:
        self.assertIsNone(exponent([10, 100], [1, 10]))
        self.assertAlmostEqual(exponent([10, 100, 1000], [1, 10, 100]), 1)
        rows = [row for row in power_laws() if row["method"] == "3STEPD"]
        for row in rows:
            row["peak_heap_bytes"] = ""
        for row in rows[2:]:
            row |= UNFINISHED | dict(status="timeout", done_fraction=0.5, extrapolated_time_s=9e9)
        self.assertNotIn("$n^{", self.draw(rows)[1]["size"])
        rows[2] |= dict(status="inaccurate", time_s=1e-7 * SIZES["Mesh2"].n_phi**POWER["3STEPD"],
                        error_force=1e-3)
        self.assertIn(f"$n^{{{POWER['3STEPD']:.2f}}}$", self.draw(rows)[1]["size"])

    def test_no_case_is_dropped_silently(self) -> None:
        rows = power_laws()[-18:]  # Mesh6, Mesh7
        outcomes = [dict(status="timeout", done_fraction=0.12, extrapolated_time_s=5e3),
                    dict(status="timeout", done_fraction=0.001),
                    dict(status="not_converged"), dict(status="breakdown"),
                    dict(status="out_of_memory"), dict(status="crashed"), dict(status="skipped")]
        for row, outcome in zip(rows[-9:], outcomes):
            row |= UNFINISHED | outcome
        out, words = self.draw([*rows, case("Mesh3", "3STEPD", scene="flat"),
                                case("Mesh3", "3STEPCG:DTIC3"), case("Mesh3", "3STEPCG3")])
        self.assertIn("No point: 3STEPCG3 on Mesh7 (timeout, 0.1 % done); SDTIC6 on Mesh7 (not converged); 3STEPCG6 on "
                      "Mesh7 (breakdown); SSKY on Mesh7 (out of memory); 3STEPD on Mesh7 (crashed); ALM on Mesh7 "
                      "(skipped)", words["size"])
        self.assertNotIn("SDTIC3 on Mesh7", words["size"])  # an open symbol
        self.assertIn("in no figure: 3STEPD on Mesh3 (scene flat); 3STEPCG:DTIC3 on Mesh3 (the same method as 3STEPCG3)\n", out)

    def test_every_case_has_its_point(self) -> None:
        rows = power_laws()
        figure = drawn.plan(read(rows), "size").figure()
        points = {tuple(point) for line in figure.panels[0].lines for point in line.get_xydata()}
        self.assertEqual(points, {(row["n_phi"], row["time_s"]) for row in rows})

    def test_preconditioners_under_either_name(self) -> None:
        rows = preconditioners()
        for row in rows:
            row |= made_up.of_method(ALIASES.get(row["method"], row["method"]))
        rows[-1] |= UNFINISHED | dict(status="timeout", done_fraction=0.03)
        out, words = self.draw([*rows, case("Mesh1", "SYMMLQ:NONE"),
                                case("Mesh3", "SYMMLQ:DTIC3,refine=yes"),
                                case("Mesh3", "SYMMLQ:DTIC3")])
        words = words["preconditioners"]
        self.assertIn("preconditioners.png, .csv, .txt: 28 cases", out)
        self.assertIn("Mesh3: 6287 unknowns", words)
        self.assertIn("No point: 3STEPCG:NONE on Mesh3 (timeout, 3 % done).", words)
        self.assertIn("Not drawn: SYMMLQ:DTIC3,refine=yes (its preconditioner with other options is).", words)

    def test_table(self) -> None:
        self.draw([case("Mesh0", "3STEPD"), case("Mesh1", "3STEPD", n_f=145)])
        table = (self.figures / "table1.md").read_text(encoding="utf-8")
        self.assertIn("| Mesh0 | 1 | 761 | 761 | 96 | 96 | 38 | **40** |", table)
        self.assertIn("| Mesh1 | 1 | 1973 | 1973 | 144 | **145** | 80 | 80 |", table)
        self.assertIn("| Mesh7 | 4 | 50483 | – | 920 | – | 640 | – |", table)
        self.assertIn("*n_C of Mesh0*: 40 instead of the printed 38", table)

    def test_only_what_is_asked_for_is_drawn_under_an_earlier_name_too(self) -> None:
        self.write(power_laws()[:18])
        self.figures.mkdir()
        (self.figures / "figure5.csv").write_text("earlier")
        status, out, err = run(figures, self.results, "--only=figure4,t*")
        self.assertEqual((status, err), (0, ""))
        names = {f"size.{kind}" for kind in ("png", "csv", "txt")}
        self.assertEqual(names_in(self.figures), names | {"table1.md", "measured.md", "figure5.csv"})
        self.assertEqual([Path(line.split(":")[0].split(",")[0]).stem for line in out.splitlines()], ["size", "table1"])
        for earlier, today in (("figure4_paper_stop", "size_paper_stop"), ("work_precision_*", "error_time_forces"),
                               ("stability_Mesh*", "outcomes_Mesh*"), ("profiles", "profiles"), ("growth2", "growth2"),
                               ("adapted_methods,pareto", "outcomes_adapted,error_time")):
            self.assertEqual(figures.under_today(earlier), today)

    def test_vector_figures_have_their_fonts(self) -> None:
        self.write(power_laws()[:27])
        with drawn.without_minor_ticks():
            status, out, err = run(figures, self.results, "--vector", "--only=size")
        self.assertEqual((status, err), (0, ""))
        self.assertRegex(out, r"size\..*\.pdf: \d+ cases")
        drawn.assert_fonts_inside(self, self.figures / "size")

    def test_wrong_options_and_an_unusable_out(self) -> None:
        self.write([case("Mesh0", "3STEPD")])
        for option, *parts in (
                ("--nonsense", "--nonsense"),
                (f"--out={self.csv}", "expected a folder to write to"),
                ("--only=figure9", "--only: 'figure9' is no figure of these records (there are: ")):
            self.assert_refused(*parts, arguments=[option])


class RunTest(unittest.TestCase):
    def test_a_folder_with_nothing_to_draw(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([RUN, "figures", folder], capture_output=True,
                                  text=True, check=False)
            wrong = subprocess.run([RUN, "figures", folder, "another"], capture_output=True,
                                   text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1))
        self.assertIn(f"{folder} has neither records nor fields/", done.stderr)
        self.assertEqual((wrong.returncode, wrong.stdout, wrong.stderr.count("\n")), (2, "", 1))
        self.assertIn("another' (valid: a results folder, --only=GLOB,..., --animate, --html, "
                      "--vector)", wrong.stderr)
