"""The reader of records, and what follows from their keys.  /usr/bin/python3 -m unittest FILE"""
import gzip
import json
import unittest
from unittest import mock

import made_up  # finds plots

import records
from catalogue import MEASURES, catalogue_mesh
from case_names import case_of_file
from made_up import case, read
from running import FolderTest
from selection import compared, given, has_other_solver, sharing_axes

# As in tests/bench/records/case_name_test.cpp.
SWEPT = "Mesh0/default/SYMMLQ:SSOR0.7,refine=yes/study=error/contact_sweeps=1e-12/stop=paper"


class ReaderTest(FolderTest):
    def assert_refused(self, *parts: str, file: str = "results.csv") -> None:
        with self.assertRaises(records.RecordsError) as refused:
            records.read(self.results / file)
        words = str(refused.exception)
        self.assertNotIn("\n", words)
        for part in parts:
            self.assertIn(part, words)

    def refuse_cell(self, column: str, cell: object, allowed: str, row: dict | None = None) -> None:
        row = row or case("Mesh1", "3STEPD")
        made_up.write(self.csv, [case("Mesh0", "3STEPD"), row | {column: cell}])
        self.assert_refused(f"{self.csv}:3: {column} is {records.shown(cell)}, expected {allowed}")

    def test_both_files_give_the_same(self) -> None:
        rows = [case("Mesh0", "SDTIC3", done_fraction=0.25, knob_value=1e-12), case("Mesh1", "P2"),
                made_up.error_study(["Mesh3"])[40]]
        made_up.write_lines(self.lines, [made_up.record(row) for row in rows])
        of_lines = records.rows_of(records.read(self.lines))
        self.assertEqual([vars(row) | {"line": row.line + 1} for row in of_lines],
                         [vars(row) for row in read(rows)])

    def test_lines_that_gzip_packed_are_read_alike(self) -> None:
        made_up.write_lines(self.lines, [made_up.record(case("Mesh0", "P2"))])
        before = [vars(row) for row in records.rows_of(records.read_run(self.results))]
        packed = self.results / "records.jsonl.gz"
        packed.write_bytes(gzip.compress(self.lines.read_bytes()))
        self.lines.unlink()
        self.assertEqual(before, [vars(row) for row in records.rows_of(records.read_run(self.results))])
        for damaged in (packed.read_bytes()[:-9], b"{}\n"):
            packed.write_bytes(damaged)
            self.assert_refused(f"{packed}: cannot be read: not of gzip", file=packed.name)

    def test_what_unpacks_to_too_much_is_not_read_to_its_end(self) -> None:
        for name in ("records.jsonl", "records.jsonl.gz", "results.csv"):
            pack = gzip.compress if name.endswith(".gz") else bytes
            for text, line in ((b"{}\n" + b" " * (records.LONGEST_LINE + 1), 2), (b"{}\n" * 100, 67)):
                (self.results / name).write_bytes(pack(text))
                with mock.patch.object(records, "LONGEST_FILE", 2 * records.LONGEST_LINE
                                       if line == 2 else 200):
                    self.assert_refused(f"{name}:{line}: too long; expected at most 16 MiB in a line",
                                        file=name)

    def test_line_separators_of_unicode_end_no_line(self) -> None:
        self.lines.write_text("".join(
            json.dumps(made_up.record(case(mesh, "P2", scene="a\u2028b\x85c")),
                       ensure_ascii=False) + "\n" for mesh in ("Mesh0", "Mesh1")),
            encoding="utf-8")
        self.assertEqual(list(records.read(self.lines).scene), ["a\u2028b\x85c"] * 2)

    def test_what_keeps_a_text_from_being_a_formula_is_not_the_texts(self) -> None:
        rows = read([case("Mesh0", "P2", scene="'=1"), case("Mesh0", "P2", scene="''a")])
        self.assertEqual([row.scene for row in rows], ["=1", "'a"])

    def test_a_folder_is_read_from_its_records_if_it_has_them(self) -> None:
        made_up.write(self.csv, [case("Mesh0", "3STEPD")])
        self.assertEqual(list(records.read_run(self.results).mesh), ["Mesh0"])
        made_up.write_lines(self.lines, [made_up.record(case("Mesh1", "3STEPD"))])
        self.assertEqual(list(records.read_run(self.results).mesh), ["Mesh1"])

    def test_contact_problems_without_a_body_are_passed_over(self) -> None:
        problem = case("pile", "CONDENSED") | {"scene": "fclib", "n_phi": "", "n_f": "", "n_c": 40}
        rows = read([problem, case("Mesh0", "3STEPD")])
        self.assertEqual([("Mesh0", 3)], [(row.mesh, row.line) for row in rows])
        made_up.write(self.csv, [problem])
        self.assert_refused(f"{self.csv}: only contact problems without a body")

    def test_values_that_cannot_be(self) -> None:
        self.refuse_cell("stop", "soon", "one of target, paper")
        self.refuse_cell("status", "fine", "one of ok, inaccurate, unstressed, not_converged")
        self.refuse_cell("mesh", "", "a name")
        self.refuse_cell("in_paper", "yes", "true or false")
        for number in ("76.1", "9" * 20, "9" * 5000):
            self.refuse_cell("n_phi", number, "a whole number, 0 or more")
        for word in ("abc", "nan", "-1", "0"):
            self.refuse_cell("time_s", word, "a number above 0, or empty")
        self.refuse_cell("time_s", "", "a number above 0, since status is ok")
        self.refuse_cell("error_force", "-1e-9", "a number, 0 or more, or empty")
        self.refuse_cell("done_fraction", "1.2", "a number from 0 to 1, or empty")
        self.refuse_cell("upper_bound_Nmm", "high", "a number, or empty")
        self.refuse_cell("peak_heap_bytes", "0", "a whole number, 1 or more, or empty")
        self.refuse_cell("outcome", "", "a value in the study 'error'",
                         made_up.error_study(["Mesh0"])[0])

    def test_lines_that_cannot_be(self) -> None:
        good = made_up.record(case("Mesh0", "3STEPD"))
        for wrong, part in (({"time_s": "1"}, "time_s is '1', expected a number above 0"),
                            ({"in_paper": None}, "in_paper is null, expected true or false"),
                            ({"n_phi": True}, "n_phi is true, expected a whole number"),
                            ({"mesh": 3}, "mesh is 3, expected a name"),
                            ({"time_s": "\n\u2028"}, "time_s is '??', expected a number above 0"),
                            ({"stop": "a" * 999}, f"stop is '{'a' * 199}…', expected one of")):
            made_up.write_lines(self.lines, [good, good | wrong])
            self.assert_refused(f"{self.lines}:2: {part}", file="records.jsonl")
        made_up.write_lines(self.lines, [good, good | {"n_phi": 10**30}])
        self.assert_refused(f"{self.lines}:2: n_phi is 1e+30, expected a whole number",
                            file="records.jsonl")
        for extreme in (1e308, 5e-324):
            made_up.write_lines(self.lines, [good, good | {"n_phi": 1, "time_s": extreme}])
            self.assert_refused(f"{self.lines}:2: time_s is {str(extreme)[:3]}",
                                "expected 0 or 1e-250 to 1e+250 in size", file="records.jsonl")
        text = json.dumps(good) + "\n"
        self.lines.write_text(text + text[:40], encoding="utf-8")  # of a run that was ended while it wrote
        self.assertEqual(len(records.read(self.lines)), 1)
        self.lines.write_text('[1]\n', encoding="utf-8")
        self.assert_refused(f"{self.lines}:1: [1], expected an object", file="records.jsonl")
        self.lines.write_text('{"time_s": NaN}\n', encoding="utf-8")
        self.assert_refused(f"{self.lines}:1: NaN is not JSON", file="records.jsonl")

    def test_tables_that_cannot_be(self) -> None:
        self.assert_refused(f"{self.csv}: cannot be read: No such file")
        self.csv.write_text("mesh,scene\nMesh0,default\n", encoding="utf-8")
        self.assert_refused(f"{self.csv}:1: no columns method", "mesh, scene, method, general_name")
        row = case("Mesh0", "3STEPD")
        made_up.write(self.csv, [row, row])
        self.assert_refused(f"{self.csv}:3: ", "'Mesh0/default/3STEPD' is that of line 2")
        lines = self.csv.read_text(encoding="utf-8").splitlines()
        for spoilt, count in ((lines[2].rsplit(",", 3)[0], -3), (lines[2] + ",1", 1)):
            self.csv.write_text("\n".join([*lines[:2], spoilt]), encoding="utf-8")
            n = len(made_up.COLUMNS)
            self.assert_refused(f"{self.csv}:3: {n + count} values, expected {n} as in line 1")
        self.csv.write_text(lines[0] + "\n", encoding="utf-8")
        self.assert_refused(f"{self.csv}: no rows")
        self.csv.write_text("", encoding="utf-8")
        self.assert_refused(f"{self.csv}: no rows")

    def test_a_point_of_a_study_is_there_once(self) -> None:
        rows = [row for row in made_up.error_study(["Mesh0"]) if row["knob"] == "tolerance"]
        self.assertEqual(len(read(rows[:6])), 6)  # they differ in knob_value
        made_up.write(self.csv, [rows[0], rows[0]])
        self.assert_refused(f"{self.csv}:3:", "SYMMLQ:DTIC6/study=error/tolerance=0.1' is")

    def test_columns_that_a_figure_cannot_do_without(self) -> None:
        for rows, column, part in (
                ([case("Mesh0", "3STEPD")], "family", "no columns family; expected one each of"),
                ([case("Mesh0", "3STEPD")], "in_paper", "no columns in_paper; expected"),
                (made_up.error_study(["Mesh0"])[:2], "error_total", "study of line 2 needs it"),
                (made_up.stability_study()[:2], "error_stress", "study of line 2 needs it")):
            made_up.write(self.csv, rows, [c for c in made_up.COLUMNS if c != column])
            self.assert_refused(f"{self.csv}:1: no column", column, part)

    def test_records_of_before_serve_where_names_are_enough(self) -> None:
        made_up.write_lines(self.lines, [dict(mesh="Mesh0", scene="default", method="BLIND:SKY",
                                              status="ok", time_s=1)])
        row, = records.rows_of(records.read(self.lines, ("mesh", "scene", "method", "status")))
        self.assertEqual((row.general_name, row.family, row.body, row.n_phi),
                         ("BLIND:SKY", "BLIND", "one tooth", None))


class BodiesTest(unittest.TestCase):
    def bodies(self, rows: list[dict], *columns: list[str]) -> list[str]:
        return [row.body for row in read(rows, *columns)]

    def test_meshes_of_one_body_have_its_measures(self) -> None:
        meshes = ("punch1", "dovetail1", "punch2", "Mesh0", "Mesh7", "dovetail2", "Mesh3")
        self.assertEqual(self.bodies([case(mesh, "3STEPD") for mesh in meshes]),
                         ["punch", "dovetail", "punch", "one tooth", "rack of four teeth",
                          "dovetail", "one tooth"])

    def test_two_per_cent_and_what_lies_between(self) -> None:
        def wheel(mesh: str, area: float) -> dict:
            return case(mesh, "3STEPD", area_mm2=area)
        rows = [wheel("coarse", 100), wheel("fine", 103)]
        self.assertEqual(self.bodies(rows), ["coarse", "fine"])
        rows = [wheel("wheel_a", 100), wheel("wheel_b", 103), wheel("wheel_c", 101.5)]
        self.assertEqual(self.bodies(rows), ["wheel"] * 3)
        self.assertEqual(self.bodies([wheel("wheel_1", 100), wheel("wheel_2", 200)]),
                         ["wheel", "wheel_2"])  # the name is taken

    def test_a_scene_may_change_a_mesh(self) -> None:
        stretched = case("punch2", "3STEPD", scene="stretched", area_mm2=192, width_mm=24)
        self.assertEqual(self.bodies([case("punch1", "3STEPD"), stretched]), ["punch", "punch"])

    def test_without_measures_the_names_tell(self) -> None:
        meshes = ("punch1", "dovetail1", "punch12", "Mesh0", "Mesh4", "Mesh7-refined1", "Mesh7+refine2")
        columns = [column for column in made_up.COLUMNS if column not in MEASURES]
        self.assertEqual(self.bodies([case(mesh, "3STEPD") for mesh in meshes], columns),
                         ["punch", "dovetail", "punch", "one tooth", "rack of four teeth",
                          "rack of four teeth", "rack of four teeth"])

    def test_the_catalogues_meshes(self) -> None:
        for mesh, ours in (("Mesh0", "Mesh0"), ("Mesh7-refined2", "Mesh7"), ("Mesh70", None),
                           ("Mesh7_refined_twice", "Mesh7"), ("Mesh8", None), ("myMesh1", None)):
            self.assertEqual(catalogue_mesh(mesh), ours, mesh)

    def test_bodies_share_axes_where_their_sizes_do_not_overlap(self) -> None:
        rows = read([case(mesh, "3STEPD") for mesh in (*made_up.OWN, *made_up.SIZES)])
        self.assertEqual([sorted({row.body for row in own}) for own in sharing_axes(rows)],
                         [["punch", "rack of four teeth"], ["dovetail"], ["one tooth"]])
        rows = read([case(mesh, "3STEPD") for mesh in made_up.SIZES])
        self.assertEqual(len(sharing_axes(rows)), 1)


class SelectionTest(unittest.TestCase):
    def names(self, methods: list[str], room: int, **cells: object) -> list[str]:
        rows = read([case("Mesh0", method, **cells) for method in methods])
        return [row.method for row in compared(rows, room)]

    def test_variants_where_there_is_room(self) -> None:
        methods = ["NEWTON", "3STEPD", "3STEPD:LEAN", "SYMMLQ:JACOBI", "SDTIC3"]
        self.assertEqual(self.names(methods, 5), methods)
        self.assertEqual(self.names(methods, 4), ["NEWTON", "3STEPD", "3STEPD:LEAN", "SDTIC3"])
        self.assertEqual(self.names(methods, 3), ["NEWTON", "3STEPD", "SDTIC3"])
        self.assertEqual(self.names(methods, 1), ["NEWTON", "3STEPD", "SDTIC3"])

    def test_a_method_under_two_names_is_there_once(self) -> None:
        self.assertEqual(self.names(["SYMMLQ:DTIC3", "SDTIC3", "3STEPD"], 9), ["SDTIC3", "3STEPD"])

    def test_given_parameters(self) -> None:
        rows = read([case("Mesh0", name) for name in (
            "ALM:r=20,rho=40", "ALM", "MINE:r=1e-6,rho=2", "ALM:r=a,rho=b")])
        self.assertEqual([given(row) for row in rows], [(20, 40), None, (1e-6, 2), None])


class CaseNamesTest(unittest.TestCase):
    def test_of_a_record_that_names_its_case(self) -> None:
        row, = read([case("Mesh0", "P2", case_name="Mesh0/default/P2/contact=admm")])
        self.assertEqual(row.case_name, "Mesh0/default/P2/contact=admm")
        self.assertTrue(has_other_solver(row))

    def test_of_older_records(self) -> None:
        def name(method: str, **cells: object) -> str:
            return read([case("Mesh0", method, case_name="", **cells)])[0].case_name
        self.assertEqual(name("HYBRID"), "Mesh0/default/HYBRID")
        self.assertEqual(name("HYBRID", contact_solver="newton"), "Mesh0/default/HYBRID")
        self.assertEqual(name("HYBRID", contact_solver="admm"), "Mesh0/default/HYBRID/contact=admm")
        swept = dict(study="error", knob="contact sweeps", stop="paper", contact_solver="gauss-seidel",
                     error_discretisation=0.1, error_total=0.1)
        self.assertEqual(name("SYMMLQ:SSOR0.7,refine=yes", knob_value=1e-12, **swept), SWEPT)
        self.assertTrue(name("HYBRID", knob_value=30.0, **swept).endswith("_sweeps=30/stop=paper"))

    def test_of_files(self) -> None:
        self.assertEqual(case_of_file("Mesh0--default--SYMMLQ+SSOR0.7,refine=yes--study=error--"
                                      "contact_sweeps=1e-12--stop=paper"), SWEPT)
        self.assertEqual(case_of_file("%2Da%2D--b~%2D%2Dc%25--d-e"), "-a-/b+--c%/d-e")
