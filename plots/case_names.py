"""What a case is called wherever it is shown or filed: bench/records/case_name.hpp makes the names."""
from collections.abc import Mapping
from urllib.parse import unquote


def case_of_file(stem: str) -> str:
    """Mesh0--default--SYMMLQ+DTIC3 -> Mesh0/default/SYMMLQ:DTIC3."""
    return "/".join(unquote(part.replace("+", ":").replace("~", "+")) for part in stem.split("--"))


def case_of_older(record: Mapping) -> str:
    """Of a record that does not name its case."""
    name = "/".join(record[key] for key in ("mesh", "scene", "method"))
    if record["study"]:
        name += f"/study={record['study']}"
    if record["knob_value"] is not None:
        value = repr(float(record["knob_value"])).removesuffix(".0")
        name += f"/{record['knob'].replace(' ', '_')}={value}"
    solver = record["contact_solver"] or implied_solver(record)
    return (name + "/stop=paper" * (record["stop"] == "paper")
            + f"/contact={solver}" * (solver != implied_solver(record)))


def implied_solver(record: Mapping) -> str:
    """Of the contact law, by its stop and what is varied."""
    return "gauss-seidel" if record["stop"] == "paper" or record["knob"] == "contact sweeps" else "newton"
