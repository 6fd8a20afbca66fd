"""The decisions of ./run.  /usr/bin/python3 -m unittest FILE"""
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

RUN = Path(__file__).resolve().parents[2] / "run"


class RunScriptTest(unittest.TestCase):
    def names_a_model(self, *arguments: str, folder: str = ".") -> bool:
        function = re.search(r"^names_a_model\(\) \(.*?^\)$", RUN.read_text(encoding="utf-8"), re.M | re.S)
        script = f"set -euo pipefail\n{function[0]}\nnames_a_model \"$@\""
        status = subprocess.run(["bash", "-c", script, "run", *arguments], cwd=folder).returncode
        self.assertIn(status, (0, 1))
        return status == 0

    def test_meshgen_is_needed_where_an_argument_names_a_model(self) -> None:
        for arguments in (["--mesh=part.geo"], ["--mesh", "part.geo"], ["--mesh=Mesh0,a/PART.STEP"],
                          ["advise", "--mesh=part.brep", "--error=1%"], ["--mesh=part.igs,Mesh1"]):
            self.assertTrue(self.names_a_model(*arguments), arguments)
        for arguments in ([], ["--mesh=Mesh0..Mesh3"], ["--mesh=there_is_none.msh"],
                          ["--scene=part.geo.json"], ["--out=geo"]):
            self.assertFalse(self.names_a_model(*arguments), arguments)

    def test_a_mesh_file_of_another_form_is_a_model(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for version, is_model in (("2.2 0 8", False), ("4.1 0 8", True), ("2.2 1 8", True)):
                Path(folder, "part.msh").write_text(f"$MeshFormat\n{version}\n", encoding="utf-8")
                self.assertEqual(self.names_a_model("--mesh=Mesh0,part.msh", folder=folder), is_model)
            Path(folder, "empty.msh").write_bytes(b"")
            self.assertTrue(self.names_a_model("--mesh=empty.msh", folder=folder))


if __name__ == "__main__":
    unittest.main()
