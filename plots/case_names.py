"""What a case is called wherever it is shown or filed, as bench/records/case_name.hpp has it."""
import re
from collections.abc import Mapping
from urllib.parse import unquote


def other_contact_solver(case: Mapping) -> str:
    """The solver of the contact law, where it is not the one that the case implies."""
    sweeps = case.get("stop") == "paper" or case.get("knob") == "contact sweeps"
    solver = case.get("contact_solver") or ""
    return solver if solver != ("gauss-seidel" if sweeps else "newton") else ""


def case_name(case: Mapping) -> str:
    """MESH/SCENE/METHOD[/study=STUDY][/KNOB=VALUE][/stop=paper][/contact=SOLVER] of a record."""
    name = "/".join(case[key] for key in ("mesh", "scene", "method"))
    if case.get("study"):
        name += f"/study={case['study']}"
    if case.get("knob_value") not in (None, ""):
        value = repr(float(case["knob_value"])).removesuffix(".0")
        name += f"/{case['knob'].replace(' ', '_')}={value}"
    name += "/stop=paper" if case.get("stop") == "paper" else ""
    solver = other_contact_solver(case)
    return name + (f"/contact={solver}" if solver else "")


def words_of_file(stem: str) -> str:
    return ", ".join(unquote(part.replace("+", ":").replace("~", "+")) for part in stem.split("--"))


def file_of(name: str) -> str:
    name = re.sub(r"[%~]|^\+|(?<![^-/])-|-(?![^-/])", lambda found: f"%{ord(found[0]):02X}", name)
    return name.replace("/", "--").replace("+", "~").replace(":", "+")
