"""README.md and docs/: every relative link leads somewhere, quoted files are quoted as they are.  /usr/bin/python3 -m unittest FILE"""
import re
import subprocess
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
LINK = re.compile(r"\]\(([^()\s]+)\)")


def without_code(text: str) -> str:
    text = re.sub(r"^(?:    |\t).*$", "", re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S),
                  flags=re.M)
    return re.sub(r"`[^`\n]*`", lambda code: code[0].replace("](", "] ("), text)


def anchors(text: str) -> set[str]:
    """As GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(file: Path) -> list[str]:
    broken = []
    for link in LINK.findall(without_code(file.read_text(encoding="utf-8"))):
        if re.match(r"[a-z]+:|\.\./\.\./actions/", link):  # outside, and the badge's workflow
            continue
        path, _, anchor = link.partition("#")
        target = (file.parent / path).resolve() if path else file
        if not target.exists():
            broken.append(f"{file.relative_to(PROJECT)}: {link}: no such file")
        elif anchor and anchor not in anchors(target.read_text(encoding="utf-8")):
            broken.append(f"{file.relative_to(PROJECT)}: {link}: no such heading")
    return broken


QUOTED_FILE = re.compile(r"^<!-- file: (\S+) -->\n```\w*\n(.*?)^```$", re.M | re.S)

READS_VARIABLES = re.compile(r"(^run|CMakeLists\.txt|\.(cpp|hpp|py|sh))$")
# In a shell, C++, Python and CMake.
VARIABLE = re.compile(r'\$\{(AIRYBENCH_\w+):-|(?:getenv|envname|folder_of_variable)\("(AIRYBENCH_\w+)"'
                      r'|environ(?:\.get)?[\[(]"(AIRYBENCH_\w+)"|option\((AIRYBENCH_\w+)')


class DocumentationTest(unittest.TestCase):
    def test_links_lead_somewhere(self) -> None:
        files = [PROJECT / "README.md", *(PROJECT / "docs").glob("*.md"),
                 *(PROJECT / folder / "README.md" for folder in ("plots", "results"))]
        self.assertEqual([], [link for file in files for link in broken_links(file)])

    def test_a_quoted_file_is_quoted_as_it_is(self) -> None:
        quoted = [(name, code) for file in (PROJECT / "docs").glob("*.md")
                  for name, code in QUOTED_FILE.findall(file.read_text(encoding="utf-8"))]
        self.assertEqual(5, len(quoted))
        for name, code in quoted:
            self.assertEqual((PROJECT / name).read_text(encoding="utf-8"), code, name)

    def test_the_example_of_a_method_is_short(self) -> None:
        example = PROJECT / "tests/solvers/example/three_step_simplicial.cpp"
        self.assertLessEqual(len(example.read_text(encoding="utf-8").splitlines()), 40)

    @unittest.skipUnless((PROJECT / ".git").exists(), "only a clone knows which files are the project's")
    def test_every_variable_is_in_the_table(self) -> None:
        text = (PROJECT / "docs/building.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| (`AIRYBENCH_\w+`(?:, `AIRYBENCH_\w+`)*) \|", text, re.M)
        documented = {name for row in rows for name in re.findall(r"AIRYBENCH_\w+", row)}
        tracked = subprocess.run(["git", "ls-files", "-z"], cwd=PROJECT, capture_output=True, text=True,
                                 check=True).stdout.split("\0")
        read = {name for file in tracked if READS_VARIABLES.search(file)
                for names in VARIABLE.findall((PROJECT / file).read_text(encoding="utf-8"))
                for name in names if name}
        self.assertGreater(len(read), 10)
        self.assertEqual(documented, read)
