"""A peer answers the exported Mesh0 as the reference does; its own word is well-formed.

    AIRYBENCH_BENCH=PATH /usr/bin/python3 test_peers.py FOLDER/NAME.json    exit 77: cannot run here
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scipy.io import mmread
from scipy.sparse import load_npz

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "peers"), str(PROJECT / "tests/support")]
import list as peers  # noqa: E402
from exporting import BENCH, ExportingTest, difference  # noqa: E402

SCENES = {
    "default": {},
    "without friction": {"friction": 0},
    "much friction, body force": {"friction": 0.8, "plane": "stress",
                                  "body_force_N_per_mm3": [0.1, 0]},
    "pressure, rollers": {"mesh": {"keep_force_edges": 6},
                          "displacement_mm": [0.01, 0],
                          "boundary": {"force": {"pressure_MPa": 3},
                                       "displacement": {"support": "normal"}}},
}
# Of docs/bodies, with changes to their scenes: friction and a vertex that only one body is held at, three bodies,
# the same where a roller meets a prescribed vertex, round faces without friction, a wall next to a pair.
# Round bodies as polygons: that is what a program in displacements gets, while P2 follows curves.
JOINED = {
    "two": ("blocks", {}),
    "three": ("stack", {}),
    "at a roller": ("stack", {"roles": {"4": "displacement:side"},
                              "boundary": {"displacement:side": {"support": "normal", "displacement_mm": [0, 0]}}}),
    "round": ("cylinders", {"mesh": {"polygon": True}}),
    "at a wall": ("indenter", {"mesh": {"polygon": True}, "roles": {"11": "contact:floor"},
                               "boundary": {"contact:floor": {"friction": 0.1, "wall": {
                                   "flat": {"point_mm": [0, -20], "normal": [0, 1]}}}}}),
}
FILES = {"airy_function": {"x.mtx", "F_C.mtx"}, "contact_forces": {"r.mtx"}, "displacement": {"displacement_mm.mtx"},
         "edge_displacements": {"edge_displacements_mm.npy", "F_C.mtx", "log.txt"}}
# Which of these scenes its pivots fail in depends on the processor's last digits.
PIVOTS = {"siconos-lemke"}
HARD_FOR_PIVOTS = {"nearly incompressible": {"poisson": 0.49}, "more so": {"poisson": 0.499999}}
# The scenes that it does not take, and the words for it; the harness' own small ones are of the same kind.
SKIPS = {"calculix-mortar": ({"much friction, body force", "pressure, rollers"}, "loads at nodes of contact edges")}
STAGES = {"order", "precondition", "factor", "condense", "contact", "recover", "check"}


class PeerTest(ExportingTest):
    declaration: Path

    def setUp(self) -> None:
        self.peer = json.loads(self.declaration.read_text(encoding="utf-8"))
        program = self.declaration.parent / self.peer["command"][0]
        _, reason = peers.version(self.declaration.parent, self.peer["version"])
        if reason or not program.exists():
            self.skipTest(f"{self.peer['name']}: {reason or program} (./run peers)")
        super().setUp()

    def answer(self, definition: dict) -> tuple[Path, dict]:
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        places = {"{input}": str(self.export(self.peer["format"], definition)),
                  "{output}": str(folder), "{tolerance}": "1e-13", "{threads}": "2"}
        places |= {f"{{{name}}}": str(values[0]) for name, values in self.peer.get("parameter", {}).items()}
        command = [places.get(word, word) for word in self.peer["command"]]
        ran = subprocess.run(command, cwd=self.declaration.parent, capture_output=True, text=True,
                             check=False)
        self.assertEqual(0, ran.returncode, ran.stderr)
        return folder, json.loads((folder / "answer.json").read_text(encoding="utf-8"))

    def gave_up(self, status: str) -> bool:
        return self.peer["name"] in PIVOTS and status == "not_converged"

    def test_pivots_that_went_wrong_are_no_ok(self) -> None:
        if self.peer["name"] not in PIVOTS:
            self.skipTest("it does not pivot")
        for name, definition in (SCENES | HARD_FOR_PIVOTS).items():
            with self.subTest(name):
                folder, said = self.answer(definition)
                self.assertEqual(said["status"], "ok" if said["error_estimate"] <= 1e-8 else "not_converged")
                if said["status"] == "ok":
                    self.assertLess(self.error_of_forces(folder, definition), 1e-6)

    def skips(self, name: str, said: dict) -> bool:
        scenes, words = SKIPS.get(self.peer["name"], (set(), ""))
        if name in scenes:
            self.assertEqual("skipped", said["status"])
            self.assertIn(words, said["message"])
        return name in scenes

    def test_the_harness_finds_no_mistake_in_it(self) -> None:
        if self.peer["name"] in SKIPS:
            self.skipTest("it takes none of the cases")
        ran = subprocess.run([BENCH, "check", self.declaration], capture_output=True, text=True,
                             check=False)
        verdicts = {re.split(" {2,}", line)[2] for line in ran.stdout.splitlines() if re.match(r"\d\d_", line)}
        failures = verdicts - {"ok"}
        if failures and all(map(self.gave_up, failures)):
            return
        self.assertEqual(0, ran.returncode, ran.stdout + ran.stderr)

    def error_of_forces(self, folder: Path, definition: dict) -> float:
        problem = np.load(self.export("npz", definition) / "problem.npz")
        fclib = self.peer["format"] == "fclib"
        forces = -mmread(folder / "r.mtx") if fclib else mmread(folder / "F_C.mtx")
        without_friction = fclib and len(problem["F_C"]) == len(problem["mu"])
        return difference(forces.ravel()[::2 if without_friction else 1], problem["F_C"])

    def test_its_word_is_well_formed(self) -> None:
        for name, definition in SCENES.items():
            with self.subTest(name):
                folder, said = self.answer(definition)
                if self.skips(name, said):
                    continue
                if not self.gave_up(said["status"]):
                    self.assertEqual("ok", said["status"], said)
                self.assertGreater(said["time_s"], 0)
                self.assertLessEqual(set(said.get("stages", {})), STAGES)
                self.assertLessEqual(sum(said.get("stages", {}).values()), 1.001 * said["time_s"])
                for key in ("message", "parameters"):
                    self.assertIsInstance(said[key], str)
                if "{tolerance}" in self.peer["command"] and not self.gave_up(said["status"]):
                    self.assertLess(said["error_estimate"], 1e-11)  # rounding: up to 1.5e-12
                self.assertEqual({"answer.json"} | FILES[self.peer["returns"]],
                                 {file.name for file in folder.iterdir()})

    def test_its_forces_are_those_of_the_reference(self) -> None:
        if self.peer["returns"] == "displacement":
            self.skipTest("it returns displacements")
        for name, definition in SCENES.items():
            with self.subTest(name):
                folder, said = self.answer(definition)
                if not self.gave_up(said["status"]):
                    self.assertLess(self.error_of_forces(folder, definition), 1e-9)

    def test_its_airy_function_is_compatible_and_in_equilibrium(self) -> None:
        if self.peer["reads"] != "airy":
            self.skipTest("it returns no Airy function")
        for name, definition in SCENES.items():
            with self.subTest(name):
                folder, _ = self.answer(definition)
                out = self.export("npz", definition)
                S, C_F, C_C = (load_npz(out / f"{m}.npz").toarray() for m in ("S", "C_F", "C_C"))
                p = np.load(out / "problem.npz")
                x, F_C = (mmread(folder / f"{v}.mtx").ravel() for v in ("x", "F_C"))
                size = np.linalg.norm(F_C)
                self.assertLess(np.linalg.norm(C_F @ x - p["F"]), 1e-9 * size)
                self.assertLess(np.linalg.norm(C_C @ x + p["F0"] - F_C), 1e-9 * size)
                C, strains = np.vstack([C_F, C_C]), S @ x - p["q"]
                edges = C.T @ np.linalg.lstsq(C.T, strains, rcond=None)[0]
                self.assertLess(difference(edges, strains), 1e-9)

    def test_its_displacements_are_those_of_p2(self) -> None:
        if self.peer["returns"] != "displacement":
            self.skipTest("it returns no displacements of P2")
        allowed = self.difference_from_p2()
        for name, definition in SCENES.items():
            with self.subTest(name):
                folder, said = self.answer(definition)
                if said["status"] == "skipped":
                    continue
                found = mmread(folder / "displacement_mm.mtx")
                nodes, expected = self.displacements_of_p2(definition)
                self.assertEqual(len(found), nodes.max() + 1)
                self.assertLess(difference(found[nodes], expected), allowed)

    def difference_from_p2(self) -> float:
        """Contact of coefficients is P2's discretisation, that of nodes another."""
        return 1e-9 if self.peer["name"] in ("getfem-coefficients", "freefem-uzawa") else 1e-2

    def test_bodies_that_press_on_each_other_are_joined_as_by_p2(self) -> None:
        if not self.peer.get("joins_bodies"):
            self.skipTest("it takes one body")
        taken = 0
        for name, (body, changes) in JOINED.items():
            with self.subTest(name):
                p2, own = self.records_of_joined(body, changes)
                self.assertEqual(("P2", "ok"), (p2["method"], p2["status"]), p2["status_reason"])
                if own["status"] == "skipped":
                    self.assertEqual("calculix-penalty", self.peer["name"])
                    self.assertIn("faces of bodies that are", own["status_reason"])
                    continue
                taken += 1
                self.assertEqual("ok", own["status"], own["status_reason"])
                for quantity in ("strain_energy_Nmm", "normal_resultant_N"):
                    self.assertLess(abs(own[quantity] / p2[quantity] - 1), self.difference_from_p2(), quantity)
                self.assertLess(abs((own["tangential_resultant_N"] or 0) - (p2["tangential_resultant_N"] or 0)),
                                -self.difference_from_p2() * p2["normal_resultant_N"])
        self.assertGreater(taken, 0)

    def test_friction_remembers_earlier_load_steps_as_in_p2(self) -> None:
        if not self.peer.get("load_steps"):
            self.skipTest("it takes one load step")
        back = {"load_steps": [{"displacement_mm": [0.02, -0.006]}, {"displacement_mm": [0.015, 0]}]}
        two = json.loads((PROJECT / "docs/bodies/blocks.json").read_text(encoding="utf-8"))
        two["load_steps"] = [{"boundary": {"displacement:top": {"displacement_mm": [x, -0.006]}}} for x in (-0.006, 0.002)]
        for mesh, definition in (("Mesh0", back), (PROJECT / "docs/bodies/blocks.geo", two)):
            with self.subTest(mesh):
                p2, own = self.records_of(mesh, definition)
                self.assertEqual(("ok", "ok"), (p2["status"], own["status"]), own["status_reason"])
                self.assertEqual(3, len(own["steps"]))
                self.assertGreater(p2["steps"][2]["dissipation_Nmm"], 1e-5)
                for mine, of_p2 in zip(own["steps"], p2["steps"]):
                    for quantity in ("normal_resultant_N", "tangential_resultant_N"):
                        self.assertLess(abs(mine[quantity] - of_p2[quantity]),
                                        -self.difference_from_p2() * of_p2["normal_resultant_N"])
                    self.assertLess(abs(mine["dissipation_Nmm"] - of_p2["dissipation_Nmm"]),
                                    20 * self.difference_from_p2() * p2["strain_energy_Nmm"])

    def records_of_joined(self, body: str, changes: dict) -> tuple[dict, dict]:
        model = PROJECT / f"docs/bodies/{body}"
        definition = json.loads(model.with_suffix(".json").read_text(encoding="utf-8"))
        for key, value in changes.items():
            definition[key] = definition.get(key, {}) | value
        return self.records_of(f"{model}.geo", definition)

    def records_of(self, mesh: str | Path, definition: dict) -> tuple[dict, dict]:
        """Of P2, and of the peer's values the last, the stiffest."""
        out = tempfile.mkdtemp(dir=self.folder)
        ran = subprocess.run([BENCH, f"--mesh={mesh}", f"--scene={self.scene(definition)}", "--method=P2,EXTERNAL:*",
                              f"--external={self.declaration}", "--repetitions=1", f"--out={out}"],
                             check=False, capture_output=True, text=True)
        records = Path(out, "records.jsonl")
        self.assertTrue(records.exists(), ran.stderr)
        p2, *_, own = map(json.loads, records.read_text(encoding="utf-8").splitlines())
        return p2, own

    def displacements_of_p2(self, definition: dict) -> tuple[np.ndarray, np.ndarray]:
        """Nodes, of every triangle three vertices and the middles of its edges, and their displacements."""
        p = np.load(self.export("npz", definition) / "problem.npz")
        edge = {frozenset(ends): len(p["vertices_mm"]) + i for i, ends in enumerate(p["edges"].tolist())}
        nodes = [(a, b, c, edge[frozenset((a, b))], edge[frozenset((b, c))], edge[frozenset((c, a))])
                 for a, b, c in p["triangles"].tolist()]
        out = Path(tempfile.mkdtemp(dir=self.folder))
        subprocess.run([BENCH, "--mesh=Mesh0", f"--scene={self.folder / 'scene.json'}", "--method=P2",
                        "--repetitions=1", "--fields", f"--out={out}"], check=True, capture_output=True)
        field = np.genfromtxt(next((out / "fields").glob("*.displacement.csv")), delimiter=",", names=True)
        return np.ravel(nodes), np.column_stack([field["ux_mm"], field["uy_mm"]])


if __name__ == "__main__":
    PeerTest.declaration = PROJECT / "peers" / sys.argv.pop()
    result = unittest.main(exit=False).result
    all_skipped = len(result.skipped) == result.testsRun
    sys.exit(77 if all_skipped else not result.wasSuccessful())
