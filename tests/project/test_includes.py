"""Files include what their room may use, the rooms one way only; CMake lists every file.  /usr/bin/python3 -m unittest FILE"""
import re
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)

ASSEMBLY = ["assembly", "assembly/problem", "assembly/elements"]
# What a room may use besides itself, from the top of the house down; CMake links the same.
ROOMS = {
    "support": [],
    "mesh": ["support"],
    "meshgen": ["mesh", "support"],
    "assembly/elements": ["support"],  # no mesh, no scene
    "assembly/problem": ["assembly/elements", "mesh", "support"],
    "assembly": ["assembly/problem", "assembly/elements", "mesh", "support"],
    "solvers": [*ASSEMBLY, "mesh", "support"],
    "verify": ["solvers", *ASSEMBLY, "mesh", "support"],
    # Records and reports on them: without solvers.
    "bench/records": ["support"],
    "bench/report": ["bench/records", "support"],
    # What runs cases.
    "bench/plan": ["bench/records", "solvers", *ASSEMBLY, "mesh", "support"],
    "bench/measure": ["bench/plan", "verify", "bench/records", "solvers", *ASSEMBLY, "mesh",
                      "support"],
    "bench/problems": ["bench/plan", "verify", "bench/records", "solvers", *ASSEMBLY, "mesh",
                       "support"],
    "bench/external": ["bench/problems", "bench/plan", "verify", "bench/records", "solvers",
                       *ASSEMBLY, "mesh", "support"],
    "bench/check": ["bench/external", "bench/problems", "bench/measure", "bench/plan",
                    "verify", "bench/records", "solvers", *ASSEMBLY, "mesh", "support"],
    "bench/run": ["bench/measure", "bench/plan", "verify", "bench/report", "bench/records",
                  "solvers", *ASSEMBLY, "mesh", "support"],
    "bench/commands": ["bench/run", "bench/check", "bench/measure", "bench/external", "bench/problems",
                       "bench/report", "bench/plan", "bench/records", "solvers", "mesh", "support"],
    "python": ["bench/commands", "bench/run", "bench/external", "bench/measure", "bench/problems",
               "bench/plan", "verify", "bench/records", "solvers", *ASSEMBLY, "mesh", "support"],
    "bench": ["bench/commands", "bench/run", "bench/measure", "solvers", *ASSEMBLY, "mesh",
              "support"],
}

# Inside solvers/: what a folder may use besides itself and base; "table": the files of no folder.
PIECES = ["direct", "preconditioners", "krylov", "contact", "condensation", "uzawa", "displacement",
          "active_sets", "two_level"]
FOLDERS_OF_SOLVERS = {
    "base": [],
    "direct": [],
    "preconditioners": ["direct"],
    "krylov": ["preconditioners"],
    "contact": ["direct"],
    "condensation": ["direct", "preconditioners", "krylov", "contact"],
    "uzawa": ["direct", "contact", "condensation"],
    "displacement": [],
    "active_sets": ["direct", "krylov", "contact", "condensation"],
    "two_level": ["direct", "krylov", "contact", "condensation", "active_sets"],
    "loading": ["contact"],
    "names": ["preconditioners", "condensation"],
    "methods": [*PIECES, "names"],
    "table": ["preconditioners", "names"],
}


def room(file: str) -> str:
    return Path(file).parent.as_posix() if file.startswith(("bench/", "assembly/")) else Path(file).parts[0]


def folder_of_solvers(file: str) -> str:
    """The folder of a file of solvers/; "" elsewhere."""
    parts = Path(file).parts
    if parts[0] != "solvers":
        return ""
    return parts[1] if len(parts) > 2 else "table"


def forbidden(file: str, text: str) -> list[str]:
    """What the file must not include."""
    wrong = []
    for included in INCLUDE.findall(text):
        if "/" not in included:
            continue  # of a library, in quotes
        rooms = {room(file), *ROOMS[room(file)]}
        here = folder_of_solvers(file)
        folders = {"", "base", here, *FOLDERS_OF_SOLVERS.get(here, [])}
        if room(included) not in rooms or (here and folder_of_solvers(included) not in folders):
            wrong.append(f"{file} includes {included}")
    return wrong


class IncludesTest(unittest.TestCase):
    def test_files_include_what_their_room_may_use(self) -> None:
        files = [file for top in ("support", "mesh", "meshgen", "assembly", "solvers", "verify", "bench", "python")
                 for file in sorted((PROJECT / top).rglob("*.?pp"))]
        self.assertGreater(len(files), 200)
        wrong = [line for file in files for line in
                 forbidden(file.relative_to(PROJECT).as_posix(), file.read_text(encoding="utf-8"))]
        self.assertEqual([], wrong)

    def test_planted_violations_are_seen(self) -> None:
        for file, included in (("bench/report/compare.cpp", "solvers/methods.hpp"),
                               ("solvers/methods/blind_condensation.cpp", "verify/verifier.hpp"),
                               ("mesh/mesh.cpp", "assembly/problem/problem.hpp"),
                               ("assembly/problem/scene.cpp", "assembly/contact_system.hpp"),
                               ("solvers/contact/gauss_seidel.cpp",
                                "solvers/condensation/three_step.hpp"),
                               ("bench/records/record.cpp", "bench/run/runner.hpp")):
            line = f'#include "{included}"\n'
            self.assertEqual([f"{file} includes {included}"], forbidden(file, line))

    def test_one_way_is_one_way(self) -> None:
        for table in (ROOMS, FOLDERS_OF_SOLVERS):
            order = list(table)
            for user, used in table.items():
                for below in used:
                    self.assertLess(order.index(below), order.index(user), user)

    def test_cmake_lists_every_source(self) -> None:
        listed = set()
        for file in PROJECT.rglob("CMakeLists.txt"):
            text = file.read_text(encoding="utf-8").replace("${PROJECT_SOURCE_DIR}/", f"{PROJECT}/")
            text = text.replace("${CMAKE_CURRENT_SOURCE_DIR}/", "")
            listed |= {(file.parent / name).resolve() for name in re.findall(r"[\w./-]+\.cpp", text)}
            listed |= {match for glob in re.findall(r"\w+/\*\.cpp", text) for match in file.parent.glob(glob)}
        sources = {file for folder in (*ROOMS, "tests", "peers/petsc")
                   for file in (PROJECT / folder).rglob("*.cpp")}
        self.assertGreater(len(sources), 300)
        included = {*(PROJECT / "tests/solvers/example").iterdir(),  # by example_test.cpp
                    *(PROJECT / "bench/external/templates").iterdir()}  # texts of new-external
        self.assertEqual(set(), sources - listed - included)
