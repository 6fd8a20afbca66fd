"""bench against an independent program.  AIRYBENCH_BENCH=PATH /usr/bin/python3 -m unittest FILE"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
DATA = PROJECT / "tests/data/validation"
MESHES = PROJECT / "meshgen/meshes"
CASES = {"default tooth": (MESHES / "Mesh1.msh", {}),
         "every kind of load": (MESHES / "Mesh1.msh", DATA / "loaded_tooth.json"),
         "friction block": (DATA / "friction_block.msh", DATA / "friction_block.json"),
         "Cattaneo-Mindlin": (DATA / "half_plane.msh", DATA / "cattaneo_mindlin.json")}


class SecondOpinion(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_both(self, mesh: Path, scene: object) -> tuple[dict, dict, dict]:
        """HYBRID's and P2's records, and the other program's answer."""
        if isinstance(scene, dict):
            (self.folder / "scene.json").write_text(json.dumps(scene), encoding="utf-8")
            scene = self.folder / "scene.json"
        out = self.folder / "out"
        subprocess.run([os.environ["AIRYBENCH_BENCH"], f"--mesh={mesh}", f"--scene={scene}",
                        "--method=HYBRID,P2", "--repetitions=1", f"--out={out}"],
                       check=True, capture_output=True)
        lines = (out / "records.jsonl").read_text(encoding="utf-8").splitlines()
        records = {record["method"]: record for record in map(json.loads, lines)}
        other = subprocess.run([sys.executable, Path(__file__).with_name("displacement_fem.py"),
                                mesh, scene], check=True, capture_output=True, text=True)
        return records["HYBRID"], records["P2"], json.loads(other.stdout)

    def test_agrees_within_the_discretisation_error(self) -> None:
        for name, (mesh, scene) in CASES.items():
            hybrid, p2, other = self.run_both(mesh, scene)
            # e, the estimated distance of HYBRID's and P2's fields; energies differ by its square,
            # and by where the contact law is asked for.
            error = p2["error_total"]
            allowed = {"strain_energy_Nmm": 2 * max(error**2, 2e-5),
                       "normal_resultant_N": error, "tangential_resultant_N": error}
            if name == "friction block":  # its clamped foot takes a part of the floor's force
                del allowed["normal_resultant_N"]
            for method, record in (("HYBRID", hybrid), ("P2", p2)):
                for key, difference in allowed.items():
                    with self.subTest(name, method=method, key=key):
                        self.assertLess(abs(record[key] / other[key] - 1), difference)

    def test_where_all_points_stick_quadratic_displacements_are_the_same(self) -> None:
        _, p2, other = self.run_both(*CASES["every kind of load"])
        self.assertEqual((p2["n_open"], p2["n_slip"]), (0, 0))
        for key in ("strain_energy_Nmm", "normal_resultant_N", "tangential_resultant_N"):
            self.assertLess(abs(p2[key] / other[key] - 1), 1e-9, key)


class Refusals(unittest.TestCase):
    def test_a_scene_that_it_cannot_read_is_refused(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            scene = Path(folder) / "scene.json"
            scene.write_text('{"mesh": {"refine": 1}, "friction": 0}', encoding="utf-8")
            run = subprocess.run([sys.executable, Path(__file__).with_name("displacement_fem.py"),
                                  MESHES / "Mesh0.msh", scene], capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertEqual(run.stderr, f"{scene}: not known here: mesh\n")
