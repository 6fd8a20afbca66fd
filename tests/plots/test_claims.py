"""plots/claims.py: each claim on records made up for each verdict; which records are taken, what is written, what is
refused.  /usr/bin/python3 -m unittest FILE"""
import json
import subprocess
import sys
import unittest
from math import inf

import made_up  # finds plots

import claims
import records
from evidence import LONGER, NOT_REPRODUCED, REPRODUCED, UNDECIDED, Ratio, Value, ratio_of, spread, tested
from running import PROJECT, FolderTest, run


def case(method: str, time_s: float, mesh: str = "Mesh3", **fields: object) -> dict:
    """A record with three samples."""
    return made_up.record(made_up.case(mesh, method)) | dict(
        time_s=time_s, samples_s=[time_s * 0.99, time_s, time_s * 1.01], stage_contact_s=time_s / 1000,
        peak_heap_bytes=1000, storage_bytes=1000) | fields


def failed(method: str, status: str, mesh: str = "Mesh3", **fields: object) -> dict:
    return case(method, 1, mesh) | dict(status=status, time_s=None, samples_s=[], peak_heap_bytes=None,
                                        stage_contact_s=None) | fields


def timeout(method: str, spent_s: float, whole_s: float, mesh: str = "Mesh3") -> dict:
    return failed(method, "timeout", mesh, done_fraction=spent_s / whole_s, extrapolated_time_s=whole_s)


def levels(name: str, first: int, *times_s: float, **fields: object) -> list[dict]:
    return [case(f"{name}{x}", time_s, **fields) for x, time_s in enumerate(times_s, first)]


DTIC = [*levels("SYMMLQ:DTIC", 3, 8, 6, 4, 2), *levels("3STEPCG:DTIC", 3, 7, 6, 5, 4)]
FLIC = levels("SYMMLQ:FLIC", 1, 9, 7, 5, 6, 8)
FLIC_OF_CG = levels("3STEPCG:FLIC", 1, 9, 7, 6, 5, 4)
SIZES = [case("SDTIC3", 5), *levels("SYMMLQ:FLIC", 1, 9, 9, 4, 6, 9), case("SYMMLQ:FLIC3", 4, storage_bytes=700),
         case("SYMMLQ:FLIC4", 6, storage_bytes=1400)]
OTHER_SIZES = [*SIZES, *(case(f"SYMMLQ:FLIC{x}", 9, storage_bytes=size) for x, size in ((1, 100), (2, 200), (5, 9000))),
               case("SYMMLQ:FLIC4", 6, storage_bytes=1600)]
SSOR = [case("SDTIC3", 2), case("SYMMLQ:SSOR0.5", 9), case("SYMMLQ:SSOR1.0", 6)]
SSOR_THREE = [*SSOR, case("SYMMLQ:SSOR1.5", 7)]
SAME_TIME = [case(method, time_s, mesh) for mesh in ("Mesh0", "Mesh1") for method, time_s in (
    ("SDTIC3", 1.1), ("3STEPCG:DTIC3", 1), ("SYMMLQ:DTIC6", 0.9), ("3STEPCG6", 1))]
SKY = [*(case(method, 4, "Mesh0") for method in claims.WITH_DTIC), case("SSKY", 1.2, "Mesh0"), case("3STEPD", 1, "Mesh0")]
ALM = [own for mesh in ("Mesh0", "Mesh1") for own in (case("ALM", 0.9, mesh, tuning_s=60), case("3STEPD", 1, mesh))]
HEAPS = [case(method, 1, "Mesh0", peak_heap_bytes=2**22) for method in claims.BUT_ALM]
LEAST = [*HEAPS, case("ALM", 1, "Mesh0", peak_heap_bytes=2**21)]
NOT_SWEPT = [case("3STEPD", 1), timeout("BLIND", 1, 2)]
BLIND = [case("3STEPD", 1), timeout("BLIND", 5, 50), case("BLIND:SKY", 0.5)]
# Number of the claim, records of which the last of a case counts, verdict, words in what is printed of it.
VERDICTS = [
    (1, DTIC, REPRODUCED, "SYMMLQ DTIC3/DTIC4 1.33 [1."),
    (1, [*DTIC, case("3STEPCG:DTIC5", 5, samples_s=[3.5, 5, 6.5])], UNDECIDED,
     "open      3STEPCG DTIC4/DTIC5: the interval straddles"),
    (1, [*DTIC, case("SYMMLQ:DTIC6", 5)], NOT_REPRODUCED, ""),
    (1, [*DTIC[:4], case("3STEPCG3", 8), failed("3STEPCG6", "breakdown")], UNDECIDED,
     "breakdown: 3STEPCG:DTIC6 (Mesh3)\n    open      no record: 3STEPCG:DTIC4 (Mesh3), 3STEPCG:DTIC5 (Mesh3)"),
    (2, FLIC, REPRODUCED, ""),
    (2, FLIC + FLIC_OF_CG, NOT_REPRODUCED, ""),  # there too, where it was measured
    (2, [*FLIC, *FLIC_OF_CG, case("3STEPCG:FLIC5", 5)], UNDECIDED, ""),
    (2, [*FLIC, *FLIC_OF_CG, failed("3STEPCG:FLIC5", "not_converged")], UNDECIDED,
     "open      not_converged: 3STEPCG:FLIC5 (Mesh3)"),
    (2, [*FLIC, timeout("SYMMLQ:FLIC1", 10, 40)], REPRODUCED, "FLIC1 ~40 s (timeout, above 10 s)"),
    (2, [*FLIC, timeout("SYMMLQ:FLIC1", 10, 40)], REPRODUCED, "FLIC1/FLIC3 ~8 above 1.9"),
    (2, [*FLIC, timeout("SYMMLQ:FLIC1", 4, 40)], UNDECIDED, ""),  # the time it spent decides
    (3, SIZES, REPRODUCED, ""),
    (3, [*SIZES, case("SYMMLQ:FLIC4", 5, storage_bytes=1400)], UNDECIDED, ""),
    (3, OTHER_SIZES, NOT_REPRODUCED, "the nearest is FLIC3's, 0.7 times as much"),  # and faster
    (3, [*OTHER_SIZES, case("SYMMLQ:FLIC3", 4, storage_bytes=100)], UNDECIDED,
     "open      SYMMLQ: no FLIC has DTIC3's memory within a factor 1.5"),
    (3, [*SIZES, case("SDTIC3", 5, storage_bytes=None)], UNDECIDED, "open      no storage_bytes: SYMMLQ:DTIC3 (Mesh3)"),
    (4, SSOR, UNDECIDED, "SYMMLQ: SSOR needs an ω below 0.75, one above 1.25 and one between"),
    (4, SSOR_THREE, REPRODUCED, ""),
    (4, [*SSOR_THREE, timeout("SYMMLQ:SSOR0.5", 8, 20)], REPRODUCED, ""),
    (4, [*SSOR_THREE, failed("SYMMLQ:SSOR1.9", "not_converged")], REPRODUCED, "ω=1.9 not_converged"),  # not the best
    (4, [*SSOR_THREE, case("SYMMLQ:SSOR1.5", 6.01)], UNDECIDED, "best ω: 1 or 1.5"),
    (4, [*SSOR_THREE, case("SYMMLQ:SSOR1.5", 5)], NOT_REPRODUCED, ""),
    (4, [*SSOR_THREE, case("SYMMLQ:SSOR1.0", 3.5)], NOT_REPRODUCED, ""),  # near 1, but not slow
    (5, [], UNDECIDED, "open      no records"),
    (5, SAME_TIME, REPRODUCED, "SDTIC3/3STEPCG3: Mesh0 1.1 s/1 s = 1.1, Mesh1 1.1 s/1 s = 1.1"),
    (5, [*SAME_TIME, case("SDTIC6", 2, "Mesh1")], UNDECIDED, "SDTIC6/3STEPCG6 on 2 meshes 1.34 [0.9, 2]"),
    (5, [*SAME_TIME, case("SDTIC6", 2, "Mesh1"), case("SDTIC6", 2, "Mesh0")], NOT_REPRODUCED, ""),
    (5, [*SAME_TIME, case("SDTIC3", 1.1, "Mesh0", status="inaccurate")], REPRODUCED, "Mesh0 1.1 s (inaccurate)/1 s"),
    (6, SKY, REPRODUCED, ""),
    (6, [*SKY, timeout("SDTIC3", 3, 100, "Mesh0")], REPRODUCED, "SDTIC3/3STEPD on 1 mesh ~100 above 2.9"),
    (6, [*SKY, timeout("SDTIC3", 1, 100, "Mesh0")], UNDECIDED, ""),
    (6, [*SKY, failed("SDTIC3", "out_of_memory", "Mesh0")], UNDECIDED, "open      out_of_memory: SDTIC3 (Mesh0)"),
    (6, [*SKY, failed("SDTIC3", "out_of_memory", "Mesh0"), case("SSKY", 1.8, "Mesh0")], NOT_REPRODUCED, ""),
    (6, [case("SSKY", 1, mesh) for mesh in ("Mesh0", "Mesh1")], UNDECIDED, "3STEPD (Mesh0, Mesh1)"),  # each once
    (7, ALM, REPRODUCED, "Mesh0 (900 ms + 60 s)/1 s = 60.9"),
    (7, [*ALM, case("ALM", 1.2, "Mesh1")], UNDECIDED, ""),
    (7, [*ALM, case("ALM", 1.2, "Mesh1"), case("ALM", 1.1, "Mesh0")], NOT_REPRODUCED, ""),
    (7, [*ALM, case("3STEPD", 1, "Mesh2")], UNDECIDED, "open      no record: ALM (Mesh2)"),
    (7, [*ALM, case("ALM", 1.2, "Mesh1"), case("ALM", 1.1, "Mesh0"), case("3STEPD", 1, "Mesh2")], UNDECIDED,
     "ALM/3STEPD on 2 meshes 1.15 [1.1, 1.2]"),  # without a mesh the others do not decide
    (7, [*ALM, *(case("3STEPD", 1, f"part{k}") for k in range(5))], UNDECIDED, "ALM (part0, part1, part2 and 2 more)"),
    (7, [case("ALM", 0.99, samples_s=[0.8, 0.99, 1.2]), case("3STEPD", 1, samples_s=[0.9, 1, 1.1])], UNDECIDED,
     "ALM/3STEPD on 1 mesh 0.99 ["),  # within the noise
    (8, HEAPS, UNDECIDED, "open      no record: ALM (Mesh0)"),
    (8, LEAST, REPRODUCED, "Mesh0: ALM 2.0 MiB, 3STEPD 4.0 MiB, least but ALM SDTIC3 4.0 MiB"),
    (8, [*LEAST, timeout("SSKY", 1, 2, "Mesh0")], UNDECIDED, "open      timeout: SSKY (Mesh0)"),
    (8, [*LEAST, case("SDTIC6", 1, "Mesh0", peak_heap_bytes=2**20)], NOT_REPRODUCED, ""),
    (9, [case(method, 1, stage_contact_s=0.5) for method in ("ALM", "HYBRID")], UNDECIDED, "open      no records"),
    (9, NOT_SWEPT, UNDECIDED, "open      no case by Gauss–Seidel, which --stop=paper takes"),
    (10, BLIND[:1], UNDECIDED, "open      no records"),
    (10, BLIND, REPRODUCED, "BLIND:SKY/3STEPD: Mesh3 500 ms/1 s = 0.5"),
    (10, [*BLIND, case("BLIND", 0.9)], NOT_REPRODUCED, ""),
    (10, [*BLIND, case("BLIND", 0.9), case("3STEPD", 1, "Mesh1"), case("BLIND", 3, "Mesh1")], UNDECIDED, ""),
]


class ClaimsTest(FolderTest):
    program = claims

    def write(self, cases: list[dict]) -> None:
        """The last of a case."""
        named = {tuple(own[key] for key in ("mesh", "scene", "method", "stop", "study", "contact_solver")): own for own in cases}
        made_up.write_lines(self.lines, list(named.values()) or [case("HYBRID", 1, study="error")])

    def claim(self, number: int, cases: list[dict], stop: str = "target") -> tuple[str, str]:
        """Its verdict, and its lines."""
        self.write(cases)
        status, out, err = run(claims, self.results, f"--stop={stop}")
        self.assertEqual((status, err), (0, ""))
        text = out.split(f"\n{number:>2}  ")[1].split(f"\n{number + 1:>2}  ")[0]
        return text.split("  ")[0], text

    def test_verdicts(self) -> None:
        for number, cases, verdict, words in VERDICTS:
            with self.subTest(claim=number, verdict=verdict, words=words):
                found, text = self.claim(number, cases)
                self.assertEqual(found, verdict, text)
                self.assertIn(words, text)

    def test_stops_are_kept_apart_but_for_direct_methods(self) -> None:
        cases = [case("BLIND", 3), case("3STEPD", 1), case("ALM", 2), case("ALM", 0.9, stop="paper")]
        swept = [case("3STEPD", 1, stop="paper"), case("SYMMLQ:NONE", 1, stop="paper", stage_contact_s=0.02)]
        for number, own, target, paper in (
                (7, cases, NOT_REPRODUCED, REPRODUCED), (10, cases, REPRODUCED, REPRODUCED),
                (10, [*cases, case("3STEPD", 5, stop="paper")], REPRODUCED, NOT_REPRODUCED),  # its own goes before
                (9, NOT_SWEPT + swept[:1], UNDECIDED, REPRODUCED), (9, NOT_SWEPT + swept, UNDECIDED, NOT_REPRODUCED)):
            self.assertEqual(self.claim(number, own)[0], target)
            self.assertEqual(self.claim(number, own, "paper")[0], paper)

    def test_one_scene_counts_and_no_study(self) -> None:
        flat = [case("3STEPD", 1, scene="flat"), case("BLIND", 3, scene="flat")]
        self.assertEqual(self.claim(10, flat)[0], REPRODUCED)
        self.assertIn("2 cases, stop target, scene flat,", run(claims, self.results)[1])
        self.write([*flat, case("3STEPD", 1, scene="smooth")])
        self.assert_refused("records.jsonl: scene: flat and smooth (allowed: default among them")
        other = case("3STEPD", 1, contact_solver="anderson", case_name="Mesh3/default/3STEPD/contact=anderson")
        for more in ([], [other], [case("3STEPD", 1, study="error")]):
            self.assertEqual(self.claim(10, [*flat, case("BLIND", 3), case("3STEPD", 4), *more])[0], NOT_REPRODUCED)

    def test_preconditioners_are_compared_on_the_mesh_with_most_of_them(self) -> None:
        for mesh in ("Mesh3", "Mesh1"):
            self.write([case("SSKY", 1, "Mesh0"), *levels("SYMMLQ:FLIC", 1, 9, 7, 5, 6, 8, mesh=mesh)])
            self.assertIn(f"preconditioners on {mesh}\n", run(claims, self.results)[1])

    def test_no_records_decide_nothing(self) -> None:
        self.write([])
        status, out, _ = run(claims, self.results)
        self.assertEqual(status, 0)
        self.assertIn("0 cases, stop target, scene default, preconditioners on no mesh\n", out)
        self.assertEqual(out.count("  undecided  "), len(claims.CLAIMS))

    def test_writes_a_table(self) -> None:
        self.write([case("3STEPD", 1, "Mesh0"), case("BLIND", 3, "Mesh0")])
        self.assertEqual(run(claims, self.results, f"--out={self.results / 'table.md'}")[0], 0)
        table = (self.results / "table.md").read_text(encoding="utf-8")
        self.assertEqual(table.count("\n"), 2 + 2 + 10)
        self.assertTrue(table.endswith(
            " | BLIND/3STEPD: Mesh0 3 s/1 s = 3 | BLIND/3STEPD on 1 mesh 3 [2.94, 3.06] | **reproduced** |\n"))

    def test_committed_tables_are_those_of_the_committed_records(self) -> None:
        for stop, name in (("target", "claims.md"), ("paper", "claims_paper_stop.md")):
            table = self.results / name
            subprocess.run([sys.executable, claims.__file__, "results/paper", f"--stop={stop}", f"--out={table}"],
                           cwd=PROJECT, check=True, stdout=subprocess.DEVNULL)
            self.assertEqual(table.read_bytes(), (PROJECT / "results/paper" / name).read_bytes())

    def test_the_papers_names_are_the_methods(self) -> None:
        table = records.read_run(PROJECT / "results/paper")
        names = dict(zip(table.method, table.general_name))
        self.assertEqual(claims.GENERAL, {name: names[name] for name in claims.GENERAL})

    def test_wrong_usage_is_one_line(self) -> None:
        self.assert_refused(f"{self.lines}: cannot be read: No such file")
        made_up.write(self.csv, [made_up.case("Mesh0", "3STEPD")])  # which has no samples
        self.assert_refused(f"{self.lines}: cannot be read: No such file")
        good = json.dumps(case("3STEPD", 1)) + "\n"
        self.lines.write_text(good, encoding="utf-8")
        for argument, named in (("--stop=mine", "mine"), ("--wrong", "--wrong"), ("more", "more"),
                                ("--out=table.csv", "--out: table.csv (allowed: "),
                                ("--out=nowhere/table.md", "nowhere: No such file")):
            self.assert_refused(named, arguments=(argument,))
        self.lines.write_text(good + good[:40] + "\n", encoding="utf-8")
        self.assert_refused("records.jsonl:2: not JSON", arguments=(f"--out={self.results / 'table.md'}",))
        self.assertFalse((self.results / "table.md").exists())
        self.lines.write_text(good + good[:40], encoding="utf-8")  # of a run that was ended while it wrote
        self.assertIn(": 1 cases,", run(claims, self.results)[1])

    def test_closed_and_full_streams(self) -> None:
        self.write(BLIND)
        for stream, said in ((">&-", "is closed (allowed: an open one, or --out=FILE)\n"),
                             (">/dev/full", "No space left on device; expected a file to write\n")):
            ran = subprocess.run(["bash", "-c", f"'{sys.executable}' '{claims.__file__}' '{self.results}' {stream}"],
                                 text=True, capture_output=True, check=False)
            self.assertEqual((ran.returncode, ran.stderr), (2, f"claims.py: standard output: {said}"))


class EvidenceTest(unittest.TestCase):
    def test_an_interval_that_straddles_the_threshold_decides_nothing(self) -> None:
        factor = (1 / 1.5, 1.5)
        for low, high, limits, verdict in (
                (1.1, 1.3, LONGER, REPRODUCED), (0.9, 1.3, LONGER, UNDECIDED), (0.9, 1, LONGER, NOT_REPRODUCED),
                (3, inf, LONGER, REPRODUCED), (0.7, 1.4, factor, REPRODUCED), (0.7, 1.6, factor, UNDECIDED),
                (0.3, 0.5, factor, NOT_REPRODUCED), (1.6, inf, factor, NOT_REPRODUCED), (0, 1.5, (-inf, 1.5), REPRODUCED)):
            self.assertEqual(tested("", Ratio(1, low, high), limits).verdict, verdict, (low, high))

    def test_bootstrap_of_the_ratio_of_medians(self) -> None:
        ratio = ratio_of(Value(2, "", [2, 2.13, 1.87, 2.29, 1.71, 2.4]), Value(1, "", [1, 1.07, 0.94, 0.89]))
        # What bootstrap_ratio_of_medians() of bench/records gives.
        self.assertEqual(ratio, Ratio(2, 1.8067632850241544, 2.4831460674157304))
        self.assertEqual(ratio_of(Value(3, "", [3]), Value(2, "", [2])), Ratio(1.5, 1.5, 1.5))

    def test_timeouts_enter_with_the_time_they_spent(self) -> None:
        stopped, measured = Value(100, "", [10], True), Value(2, "", [2])
        for above, below, ratio, shown in (
                (stopped, measured, (50, 5, inf), "~50 above 5"), (measured, stopped, (0.02, 0, 0.2), "~0.02 below 0.2"),
                (stopped, stopped, (1, 0, inf), "~1 (no bound)"),
                (stopped._replace(samples=[0]), stopped._replace(samples=[0]), (1, 0, inf), "~1 (no bound)")):
            self.assertEqual(ratio_of(above, below), Ratio(*ratio, True))
            self.assertEqual(ratio_of(above, below).with_interval(), shown)

    def test_spread_is_geometric_mean_and_range(self) -> None:
        whole = spread([Ratio(2, 1.9, 2.1), Ratio(8, 7, 9)])
        self.assertAlmostEqual(whole.figure, 4)
        self.assertEqual(whole[1:], (2, 8, False))
        self.assertEqual(spread([Ratio(2, 1.9, 2.1), Ratio(8, 1, inf, True)])[1:], (1, inf, True))
