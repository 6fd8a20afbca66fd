"""Solvers of the condensed contact problem: their time and iterations over its size."""
from collections.abc import Callable, Iterator

from matplotlib.axes import Axes

from catalogue import Look
from drawing import CROSS, Drawing, Sheet, file_name, log_limits, log_log
from records import CONTACT_SOLVERS, Row
from selection import grouped
from words import CASE, axis_label, csv_of, lacking, plain, threads

LOOKS = dict(zip(CONTACT_SOLVERS, (Look("#000000", "o"), Look("#D55E00", "s"), Look("#0072B2", "^"),
                                   Look("#00805C", "D"))))


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    """One for each method; other programs, which replace HYBRID's contact law, are in its."""
    run = [row for row in rows if row.points == "contact" and row.status != "skipped"]
    programs = [row for row in run if row.program]
    methods = grouped([row for row in run if row.contact_solver], lambda row: row.method) or {"": []}
    with_programs = "HYBRID" if "HYBRID" in methods else next(iter(methods))
    for method, own in methods.items():
        name = "contact" if len(methods) == 1 else file_name("contact", method)
        shown = own + programs if method == with_programs else own
        if len(shown) > 1:
            yield Drawing(name, shown, draw, table_of)


def solver_of(row: Row) -> str:
    return row.contact_solver or row.label


def look_of(row: Row) -> Look:
    return LOOKS.get(row.contact_solver, row.look)


def iterations(row: Row) -> float | None:
    if not row.solved or row.contact_iterations is None:
        return None
    return row.contact_iterations + (row.newton_steps or 0)


def seconds(row: Row) -> float | None:
    return row.stage_contact_s if row.solved else None


QUANTITIES = ((seconds, axis_label("stage_contact_s")), (iterations, "iterations"))


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, "n_c", ("contact_solver", solver_of), "stage_contact_s", ("iterations", iterations))


def scene_words(scene: str) -> str:
    """mu_0.2 -> μ = 0.2."""
    return scene.replace("mu_", "μ = ") if scene.startswith("mu_") else scene


def draw(rows: list[Row], width: float) -> Sheet | str:
    if not any(seconds(row) and row.n_c for row in rows):
        return "no case of the contact study has a time"
    scenes = grouped(rows, lambda row: row.scene)
    failed = [row for row in rows if not row.solved]
    solvers = list({solver_of(row): look_of(row) for row in rows}.items())
    sheet = Sheet(
        width, "Solvers of the condensed contact problem",
        f"{rows[0].method}, {threads(rows)}. A point is a mesh; all solvers get the same D and G. Time: median of the "
        "contact law. Iterations: Gauss–Seidel sweeps, plain (gauss-seidel) or accelerated (anderson); sweeps and "
        "active-set steps together (newton); iterations (admm). Other programs: by their own clock and count.",
        f"Crosses above an axes, a line for each solver: {len(failed)} of {len(rows)} cases are not ok." if failed else
        "All cases were solved.",
        lacking([row for row in rows if row.solved], {"time": seconds, "iterations": iterations}, solver_of),
        panels=2 * len(scenes), in_row=len(scenes), height=2.5, narrowest=1.5,
        key=[(plain(solver), look.line()) for solver, look in solvers])
    xlim = log_limits([row.n_c for row in rows if row.n_c], 1.3)
    panels = iter(sheet.panels)
    for of, words in QUANTITIES:
        ylim = log_limits([value for row in rows if (value := of(row))], 1.6)
        for k, (scene, own) in enumerate(scenes.items()):
            axes = next(panels)
            log_log(axes, xlim=xlim, ylim=ylim, xlabel="contact forces $n_C$", ylabel="" if k else words)
            draw_solvers(axes, own, of, dict(solvers))
            axes.set_title(plain(scene_words(scene)), pad=4 + 8 * len({*map(solver_of, failed)}))
    return sheet


def draw_solvers(axes: Axes, rows: list[Row], of: Callable[[Row], float | None], looks: dict[str, Look]) -> None:
    lost = 0
    for solver, own in grouped(rows, solver_of).items():
        known = sorted((row.n_c, of(row)) for row in own if of(row) and row.n_c)
        axes.plot([n for n, _ in known], [value for _, value in known], **looks[solver].line(markersize=4, linewidth=1))
        unsolved = [row.n_c for row in own if not row.solved and row.n_c]
        if unsolved:
            height = 72 * axes.get_position().height * axes.figure.get_size_inches()[1]
            axes.plot(unsolved, [1 + (7 + 8 * lost) / height] * len(unsolved), clip_on=False,
                      transform=axes.get_xaxis_transform(), **CROSS | dict(markersize=5, markeredgecolor=looks[solver].colour))
            lost += 1
