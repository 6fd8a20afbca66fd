"""What the workflows run is named by its content.  /usr/bin/python3 -m unittest FILE"""
import re
import subprocess
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
FOLDER = PROJECT / ".github" / "workflows"
NIGHTLY = (FOLDER / "nightly.yml").read_text(encoding="utf-8")
CI = (FOLDER / "ci.yml").read_text(encoding="utf-8")
CONTAINER = (FOLDER / "container.yml").read_text(encoding="utf-8")


class WorkflowTest(unittest.TestCase):
    def test_actions_and_containers_have_a_digest(self) -> None:
        self.assertEqual(sorted(file.name for file in FOLDER.iterdir()), ["ci.yml", "container.yml", "nightly.yml"])
        actions = re.findall(r"uses: (.*)", NIGHTLY + CI + CONTAINER)
        self.assertGreater(len(actions), 5)
        for action in actions:
            self.assertRegex(action, r"^actions/[a-z-]+@[0-9a-f]{40}  # v\d+\.\d+\.\d+$")
        images = re.findall(r"(?:container|image): (debian.*)", NIGHTLY + CI)
        self.assertEqual(len(images), 5)
        for image in images:
            self.assertRegex(image, r"^debian:1[23]@sha256:[0-9a-f]{64}  # ")
        image = re.search(r"^ARG DEBIAN=(.*)", (PROJECT / "Dockerfile").read_text(encoding="utf-8"), re.M)[1]
        self.assertIn(f"image: {image} ", CI)

    def test_every_push_runs_the_commands_of_the_readme(self) -> None:
        readme = (PROJECT / "README.md").read_text(encoding="utf-8")
        commands = re.search(r"\n\n((?:    \./run .*\n)+)\n", readme)[1].split("\n")[:-1]
        self.assertEqual(len(commands), 2)
        for command in commands:
            self.assertIn(f"{command.strip()}\n", CI)

    def test_no_credentials_stay(self) -> None:
        for text in (NIGHTLY, CI, CONTAINER):
            self.assertEqual(text.count("actions/checkout@"),
                             text.count("          persist-credentials: false\n"))

    def test_the_night_is_kept_whatever_comes_before(self) -> None:
        keep = NIGHTLY[NIGHTLY.index("Keep all that was measured"):]
        self.assertIn("if: ${{ !cancelled() }}", keep[:keep.index("with:")])

    def test_steps_are_bash(self) -> None:
        for step in re.findall(r"run: \|\n((?: {10}.*\n|\n)+)", NIGHTLY + CI + CONTAINER):
            checked = subprocess.run(["bash", "-n"], input=step, text=True, capture_output=True,
                                     check=False)
            self.assertEqual((checked.returncode, checked.stderr), (0, ""), step)
