"""The folders of solvers/ include one way only.  /usr/bin/python3 -m unittest FILE"""
import re
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
SOLVERS = PROJECT / "solvers"
INCLUDE = re.compile(r'^#include "(solvers/[^"]+)"', re.M)

# What a folder of solvers/ may use besides itself and the base: the files that all may use.
BASE = {"solution", "stage_times", "method", "lanes", "parallel"}
PIECES = ["direct", "preconditioners", "krylov", "contact", "condensation", "uzawa", "displacement"]
MAY_USE = {
    "direct": [],
    "preconditioners": ["direct"],
    "krylov": ["preconditioners"],
    "contact": [],
    "condensation": ["direct", "preconditioners", "krylov", "contact"],
    "uzawa": ["direct", "contact", "condensation"],
    "displacement": [],
    "general_names": ["preconditioners", "condensation"],
    "methods": [*PIECES, "general_names"],
    "the table": ["preconditioners", "general_names"],
}


def place(path: str) -> str:
    """The folder of a file; of those in solvers/ itself the level."""
    parts = Path(path).parts
    if len(parts) > 2:
        return parts[1]
    stem = Path(path).stem
    return "base" if stem in BASE else "the table" if stem == "methods" else stem


class IncludesTest(unittest.TestCase):
    def test_the_folders_of_solvers_include_one_way(self) -> None:
        wrong = []
        for file in sorted(SOLVERS.rglob("*.?pp")):
            name = file.relative_to(PROJECT).as_posix()
            here = place(name)
            allowed = {"base", here, *MAY_USE.get(here, [])}
            for included in INCLUDE.findall(file.read_text(encoding="utf-8")):
                if place(included) not in allowed:
                    wrong.append(f"{name} includes {included}")
        self.assertEqual([], wrong)

    def test_one_way_is_one_way(self) -> None:
        order = list(MAY_USE)
        for user, used in MAY_USE.items():
            for place_used in used:
                self.assertLess(order.index(place_used), order.index(user), user)


if __name__ == "__main__":
    unittest.main()
