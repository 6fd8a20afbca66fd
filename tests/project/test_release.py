"""The version is the same wherever it stands.  /usr/bin/python3 -m unittest FILE"""
import re
import unittest
from datetime import date
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]


def found(file: str, pattern: str) -> tuple[str, ...]:
    match = re.search(pattern, (PROJECT / file).read_text(encoding="utf-8"), re.M)
    return match.groups() if match else ()


class ReleaseTest(unittest.TestCase):
    def test_versions_and_dates_agree(self) -> None:
        version = found("CMakeLists.txt", r"^project\(airybench VERSION (\d+\.\d+\.\d+) ")
        self.assertTrue(version)
        self.assertEqual(version, found("CITATION.cff", r"^version: (\S+)$"))
        latest = found("CHANGELOG.md", r"^## \[(\d\S*)\] - (\S+)$")
        self.assertEqual(version[0], latest[0])
        self.assertEqual(latest[1:], found("CITATION.cff", r"^date-released: (\S+)$"))
        date.fromisoformat(latest[1])

    def test_every_version_of_the_changes_leads_somewhere(self) -> None:
        text = (PROJECT / "CHANGELOG.md").read_text(encoding="utf-8")
        headings = set(re.findall(r"^## \[(.+?)\]", text, re.M))
        self.assertEqual(headings, set(re.findall(r"^\[(.+?)\]: \S", text, re.M)))
