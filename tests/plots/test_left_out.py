"""Every figure draws every method of its records, or names it.  /usr/bin/python3 -m unittest FILE"""
import re
import unittest

import made_up  # finds plots

import drawn
import figures
from records import CONTACT_SOLVERS, Row
from words import lacking, left_out

METHODS = ("3STEPD", "ALM", "HYBRID", "P2", "EXTERNAL:mine", "SYMMLQ:DTIC3", "ALM:r=1,rho=1", "ALM:r=2,rho=2")
# What there is none of: of a program its heap, of displacements an error of the contact forces.
WITHOUT = {"EXTERNAL:mine": dict(peak_heap_bytes="", program="mine 1"), "P2": dict(error_force="", error_stress="")}


def study(name: str, meshes: tuple[str, ...] = ("Mesh0", "Mesh1", "Mesh2"), **cells: object) -> list[dict]:
    return [made_up.case(mesh, method, study=name) | cells | WITHOUT.get(method, {})
            for method in METHODS for mesh in meshes]


class EveryMethodTest(unittest.TestCase):
    def words(self, rows: list[dict] | list[Row]) -> dict[str, str]:
        rows = made_up.read(rows) if isinstance(rows[0], dict) else rows
        return {drawing.name: drawn.words_of(figure) for drawing in figures.drawings_of(rows)
                if not isinstance(figure := drawing.figure(), str)}

    def assert_named(self, words: dict[str, str], figures: str, methods: tuple[str, ...] = METHODS) -> None:
        for name in figures.split():
            for method in methods:
                label = method.removeprefix("EXTERNAL:")
                self.assertRegex(words[name], rf"(?<!\w){re.escape(label)}(?!\w)", name)

    def test_ordinary_runs(self) -> None:
        adapted = [made_up.case(f"Mesh0+adapt{k}", "HYBRID", n_phi=800 * 2**k, error_total=0.04 / 2**k,
                                adapt_time_s=0.03) for k in range(3)]
        paper = [made_up.case(mesh, "ALM", stop="paper", error_total=0.05) for mesh in ("Mesh0", "Mesh1")]
        refined = [made_up.case("Mesh0+refine1", "HYBRID", n_phi=4000)]
        degrees = [made_up.case("Mesh0", "HYBRID:k=2", degree=2, error_total=0.01)]
        ours = study("", error_total=0.05, memory_by_owner="") + adapted + paper + refined
        words = self.words(ours)
        self.assert_named(words, "size")
        self.assert_named(self.words(study("")), "profiles")
        self.assert_named(words, "preconditioners", (*METHODS[:5], "SYMMLQ"))  # its preconditioners have columns
        # Without a total error, with one size, on one body.
        bare = [case | dict(error_total="") for case in study("", ("Mesh0",))] + [
            made_up.case("Mesh1", "HYBRID", error_total=0.02)] + adapted + paper + refined + degrees
        self.assert_named(self.words(bare), "size")

    def test_memory(self) -> None:
        split = [made_up.split("Mesh0", method) for method in ("3STEPD", "ALM")]
        rows = made_up.read_lines(split + [made_up.record(case) for case in study("", ("Mesh0",))
                                           if case["method"] not in ("3STEPD", "ALM")])
        self.assert_named(self.words(rows), "memory_by_owner")

    def test_studies(self) -> None:
        error = study("error", error_discretisation=0.03, error_total=0.05)
        stops = [made_up.case("Mesh0", f"ALM:r={r},rho={r}", study="error", stop="paper", error_force=0.1 / r,
                              error_discretisation=0.03, error_total=0.05) for r in (1, 2)]
        words = self.words(error + stops)
        self.assert_named(words, "error_time error_time_forces", (*METHODS[:6], "ALM, best of given r, ρ"))
        unsolved = [case | dict(status="timeout", time_s="", error_total="") if case["method"] == "3STEPD"
                    else case for case in error]
        self.assert_named(self.words(unsolved), "error_time error_time_forces", METHODS[:5])
        steps = [case | dict(load_steps=n, scene=f"steps_{n:02d}") for n in (1, 5) for case in
                 study("load-steps", ("Mesh0",))] + [made_up.case("Mesh3", "BLIND", study="load-steps", load_steps=1,
                                                                  scene="steps_01")]
        self.assert_named(self.words(steps), "load_steps")
        threads = [case | dict(threads=p, knob="threads", knob_value=p) for p in (1, 2)
                   for case in study("scaling")]
        once = [case | dict(repetitions=1) if case["method"] == "ALM" else case for case in threads]
        self.assert_named(self.words(once), "scaling")
        self.assert_named(self.words(study("adapted", ("Mesh0+adapt2", "Mesh4+adapt2"), condition_estimate=1e9)), "outcomes_adapted")
        self.assert_named(self.words(study("stability", scene_group="loads")), "outcomes_Mesh0")

    def test_a_figure_for_each_stop(self) -> None:
        for own, figure in ((study("stability", ("Mesh0",), scene_group="loads"), "outcomes_Mesh0"),
                            (study("adapted", ("Mesh0+adapt2",)), "outcomes_adapted")):
            paper = [case | dict(stop="paper") for case in own if case["method"] == "ALM"]
            drawn = {drawing.name: drawing.rows for drawing in figures.drawings_of(made_up.read(own + paper))}
            self.assertEqual((len(drawn[figure]), len(drawn[f"{figure}_paper_stop"])), (len(own), 1))

    def test_only_the_figure_of_contact_mixes_solvers_of_the_contact_law(self) -> None:
        other = [case | dict(contact_solver="admm") for case in study("")]
        own = [case | dict(contact_solver="newton") for case in study("")]
        for rows, count in ((own + other, len(own)), (other, len(other))):
            drawn = figures.drawings_of(made_up.read(rows))
            self.assertEqual({len(drawing.rows) for drawing in drawn if drawing.name == "profiles"}, {count})
            self.assertLessEqual(max(len(drawing.rows) for drawing in drawn), count)
        self.assertEqual(figures.why_undrawn(*made_up.read([other[0]]), made_up.read(own)), "contact law by admm")

    def test_contact_solvers_and_programs(self) -> None:
        own = dict(study="contact", stage_contact_s=1e-3)
        rows = [made_up.case("Mesh0", "HYBRID", contact_solver=solver, contact_iterations=5, **own)
                for solver in CONTACT_SOLVERS]
        rows.append(made_up.case("Mesh0", "EXTERNAL:mine", program="mine 1", **own))
        words = self.words(rows)
        self.assert_named(words, "contact", (*CONTACT_SOLVERS, "EXTERNAL:mine"))
        self.assertIn("No iterations: mine.", words["contact"])


class WordsTest(unittest.TestCase):
    def test_reasons_are_those_of_the_records_or_of_the_figure(self) -> None:
        run = made_up.read([made_up.case("Mesh0", method) for method in ("ALM", "BLIND", "HYBRID")]
                           + [made_up.case("Mesh0", "P2", status="timeout", time_s="")])
        self.assertEqual(left_out(run, run, str), "")
        self.assertEqual(left_out(run, run[2:3], lambda row: "no room"),
                         "Not drawn: ALM, BLIND (no room); P2 (timeout).")

    def test_panels_without_a_method_name_it(self) -> None:
        rows = made_up.read([made_up.case("Mesh0", "P2", error_force=""), made_up.case("Mesh0", "ALM")])
        panels = {"heap": lambda row: row.peak_heap_bytes, "error": lambda row: row.error_force}
        self.assertEqual(lacking(rows, panels), "No error: P2.")
