"""The paper's Tab. 1 beside the records' sizes."""
from __future__ import annotations

import re
from dataclasses import dataclass

from record_keys import Row
from selection import of_scene


@dataclass(frozen=True)
class Sizes:
    teeth: int
    n_phi: int
    n_f: int
    n_c: int


# As printed.
SIZES = {
    "Mesh0": Sizes(1, 761, 96, 38), "Mesh1": Sizes(1, 1973, 144, 80),
    "Mesh2": Sizes(1, 3105, 176, 120), "Mesh3": Sizes(1, 6287, 232, 160),
    "Mesh4": Sizes(4, 8360, 392, 200), "Mesh5": Sizes(4, 19128, 588, 480),
    "Mesh6": Sizes(4, 26538, 708, 576), "Mesh7": Sizes(4, 50483, 920, 640),
}
NOTE = ("*n_C of Mesh0*: 40 instead of the printed 38, which is no multiple of 4; every contact "
        "edge has 4 rows.")


BODIES = {1: "one tooth", 4: "rack of four teeth"}


def catalogue_mesh(mesh: str) -> str | None:
    """Mesh7 of Mesh7, Mesh7-refined2, Mesh7_refined_twice; None: not of the catalogue."""
    found = re.fullmatch(r"(Mesh\d+)([-_.].*)?", mesh)
    return found[1] if found and found[1] in SIZES else None


def table1(rows: list[Row]) -> str:
    """Markdown, of one scene; empty without meshes of the catalogue. Bold: not as in the paper."""
    rows = of_scene(rows)
    if not any(row.mesh in SIZES for row in rows):
        return ""
    lines = ["# The paper's Tab. 1 and the sizes of the records", "",
             f"Scene {rows[0].scene}. Bold: not as printed. –: no records.", "",
             "| mesh | teeth | n_φ, paper | records | n_f, paper | records | n_C, paper "
             "| records |",
             "|---|---|---|---|---|---|---|---|"]
    for mesh, printed in SIZES.items():
        cells = [mesh, str(printed.teeth)]
        for column in ("n_phi", "n_f", "n_c"):
            paper = getattr(printed, column)
            ours = sorted({getattr(row, column) for row in rows if row.mesh == mesh and row.n_phi})
            words = ", ".join(map(str, ours)) or "–"
            cells += [str(paper), words if ours in ([], [paper]) else f"**{words}**"]
        lines.append(f"| {' | '.join(cells)} |")
    if any(row.mesh == "Mesh0" and row.n_c == 40 for row in rows):
        lines += ["", NOTE]
    return "\n".join(lines) + "\n"
