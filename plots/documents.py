"""Tables and words next to the figures: the paper's Tab. 1, and the least error within a time.

The least error of every method with a solve of at most so much time, from the points of an error study,
of a method's cases on a mesh, whatever its knob (tolerance, iterations; a direct method has one case):
    e(t) = min { max(error_stress, error_force) : time_s <= t }.
The best point is known only afterwards, from the verifier; a user would have to find it.
"""
import math
from dataclasses import dataclass

from catalogue import SIZES
from measured import paragraph
from records import POSITIVE, Row
from selection import by_mesh, grouped, of_scene, order
from words import columns_of, csv_of, seconds, short

NOTE = ("*n_C of Mesh0*: 40 instead of the printed 38, which is no multiple of 4; every contact "
        "edge has 4 rows.")
DECADES = 6  # at most, of budgets where a run has none
COLUMNS = ("knob", "knob_value", "stop", "status", "time_s", "tuning_s", "error_stress", "error_force")


def documents_of(rows: list[Row]) -> dict[str, dict[str, str]]:
    sizes, cases = table1([row for row in rows if not row.study]), cases_of(rows)
    found = {"table1": {".md": sizes}} if sizes else {}
    if cases:
        found["budget"] = {".csv": csv_table(cases), ".md": markdown(cases)}
    return found | {"measured": {".md": paragraph(rows)}}


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


@dataclass(frozen=True)
class Best:
    budget_s: float
    cases: list[Row]  # of the method, all: at least one

    @property
    def row(self) -> Row | None:
        within = [row for row in self.cases if is_point(row) and row.time_s <= self.budget_s]
        return min(within, key=lambda row: (error_of(row), row.time_s), default=None)


def is_point(row: Row) -> bool:
    return bool(row.time_s) and None not in (row.error_stress, row.error_force)


def error_of(row: Row) -> float:
    return max(row.error_stress, row.error_force)


def cases_of(rows: list[Row]) -> list[Row]:
    """Of stress methods and one scene, ordinary cases, too; empty without a point of an error study."""
    own = of_scene([row for row in rows
                    if (row.points == "accuracy" or not row.study) and not row.in_displacements])
    return own if any(row.points == "accuracy" and is_point(row) for row in own) else []


def budgets_of(cases: list[Row]) -> list[float]:
    """Those of --study=error:SECONDS, else the powers of ten between the times."""
    words = {word for row in cases for word in (row.context or {}).get("budgets_s", "").split(",")}
    told = sorted(filter(POSITIVE.accepts, map(POSITIVE.of_text, words)))
    if told:
        return told
    times = [row.time_s for row in cases if is_point(row)]
    low, high = math.floor(math.log10(min(times))) + 1, math.ceil(math.log10(max(times)))
    return [10.0**k for k in range(low, max(high, low) + 1)][-DECADES:]


def best_of(cases: list[Row]) -> list[Best]:
    return [Best(budget, own) for of_mesh in by_mesh(cases).values()
            for own in grouped(sorted(of_mesh, key=order), lambda row: row.method).values()
            for budget in budgets_of(cases)]


def csv_table(cases: list[Row]) -> str:
    return csv_of(best_of(cases),
                  *columns_of(lambda best: best.cases[0], "mesh", "n_phi", "scene", "method"),
                  "budget_s", ("error", lambda best: best.row and error_of(best.row)),
                  *columns_of(lambda best: best.row, *COLUMNS))


def setting(row: Row) -> str:
    if row.knob:
        return f", {row.knob} {row.knob_value or 0:g}"
    return ", paper's stop" if row.iterative and row.stop == "paper" else ""


def cell(best: Best) -> str:
    return f"{short(error_of(best.row))}{setting(best.row)}" if best.row else "–"


def markdown(cases: list[Row]) -> str:
    lines = ["# The least error within a time", "",
             f"Scene {cases[0].scene}. The larger of the relative errors of stresses and contact "
             "forces of the solves that take at most this long (median), without the time to choose "
             "parameters; which point is best is known only afterwards. –: no solve is that fast.", ""]
    budgets = budgets_of(cases)
    for mesh, own in grouped(best_of(cases), lambda best: best.cases[0].mesh).items():
        lines += [f"| {mesh} | {' | '.join(map(seconds, budgets))} |", "|---" * (len(budgets) + 1) + "|"]
        lines += [f"| {method} | {' | '.join(map(cell, bests))} |" for method, bests in
                  grouped(own, lambda best: best.cases[0].method).items()] + [""]
    return "\n".join(lines)
