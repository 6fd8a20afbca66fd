"""What the nightly workflow runs is named by its content.  /usr/bin/python3 -m unittest FILE"""
import re
import subprocess
import unittest
from pathlib import Path

FILE = Path(__file__).resolve().parents[2] / ".github" / "workflows" / "nightly.yml"


class WorkflowTest(unittest.TestCase):
    def setUp(self) -> None:
        self.text = FILE.read_text(encoding="utf-8")

    def test_actions_and_containers_have_a_digest(self) -> None:
        actions = re.findall(r"uses: (.*)", self.text)
        self.assertGreater(len(actions), 4)
        for action in actions:
            self.assertRegex(action, r"^actions/[a-z-]+@[0-9a-f]{40}  # v\d+\.\d+\.\d+$")
        for container in re.findall(r"container: (.*)", self.text):
            self.assertRegex(container, r"^debian:12@sha256:[0-9a-f]{64}  # ")

    def test_no_credentials_stay(self) -> None:
        self.assertEqual(self.text.count("actions/checkout@"),
                         self.text.count("          persist-credentials: false\n"))

    def test_the_night_is_kept_whatever_comes_before(self) -> None:
        keep = self.text[self.text.index("Keep all that was measured"):]
        self.assertIn("if: ${{ !cancelled() }}", keep[:keep.index("with:")])

    def test_steps_are_bash(self) -> None:
        for step in re.findall(r"run: \|\n((?: {10}.*\n|\n)+)", self.text):
            checked = subprocess.run(["bash", "-n"], input=step, text=True, capture_output=True,
                                     check=False)
            self.assertEqual((checked.returncode, checked.stderr), (0, ""), step)


if __name__ == "__main__":
    unittest.main()
