"""The paper's Tab. 1 next to the records' sizes."""
from catalogue import SIZES
from records import Row
from selection import of_scene

NOTE = ("*n_C of Mesh0*: 40 instead of the printed 38, which is no multiple of 4; every contact "
        "edge has 4 rows.")


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
