"""Solvers of the condensed contact problem: their time and iterations over its size."""
import math
from collections.abc import Callable, Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import (Drawing, axes_at, file_name, log_limits, log_log, sheet, side_by_side,
                     text_at)
from records import CONTACT_SOLVERS, Row
from selection import grouped
from words import CASE, axis_label, csv_of, lacking, plain, threads

LEFT, TOP, GAP, HEIGHT, BOTTOM, KEY = 0.72, 0.62, 0.12, 2.3, 0.45, 0.3  # inches
LOOKS = (("#000000", "o"), ("#D55E00", "s"), ("#0072B2", "^"), ("#00805C", "D"), ("#CC79A7", "v"),
         ("#E69F00", "P"), ("#56B4E9", "X"), ("#7F7F7F", "*"))
A_LINE = 4  # solvers in a line of the key
AT_EDGE = 0.95  # of an axes' height: where a solver that found nothing is marked


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    """One for each method; other programs, which replace HYBRID's contact law, are in its."""
    run = [row for row in rows if row.points == "contact" and row.status != "skipped"]
    study = [row for row in run if row.contact_solver]
    programs = [row for row in run if row.program]
    methods = grouped(study, lambda row: row.method) or {"": []}
    with_programs = "HYBRID" if "HYBRID" in methods else next(iter(methods))
    for method, own in methods.items():
        name = "contact" if len(methods) == 1 else file_name("contact", method)
        shown = own + programs if method == with_programs else own
        if shown:
            yield Drawing(name, shown, draw, table_of)


def solver_of(row: Row) -> str:
    return row.contact_solver or row.method


def looks_of(rows: list[Row]) -> dict[str, tuple[str, str]]:
    """Solver -> colour and marker: ours always the same ones."""
    others = dict.fromkeys(row.method for row in rows if not row.contact_solver)
    looks = [LOOKS[k % len(LOOKS)] for k in range(len(CONTACT_SOLVERS) + len(others))]
    return dict(zip((*CONTACT_SOLVERS, *others), looks))


def iterations(row: Row) -> float | None:
    if not row.solved or row.contact_iterations is None:
        return None
    return row.contact_iterations + (row.newton_steps or 0)


def seconds(row: Row) -> float | None:
    return row.stage_contact_s if row.solved else None


QUANTITIES = ((seconds, axis_label("stage_contact_s")), (iterations, "iterations"))


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, "n_c", ("contact_solver", solver_of), "stage_contact_s",
                  ("iterations", iterations))


def draw(rows: list[Row]) -> Figure | str:
    if not any(seconds(row) and row.n_c for row in rows):
        return "no case of the contact study has a time"
    scenes = grouped(rows, lambda row: row.scene)
    failed = [row for row in rows if not row.solved]
    looks = looks_of(rows)
    programs = list(looks)[len(CONTACT_SOLVERS):]
    key_lines = math.ceil(len(looks) / A_LINE)
    figure = sheet(
        TOP + 2 * HEIGHT + GAP + BOTTOM + KEY * key_lines,
        ("Solvers" if programs else "Four solvers") + " of the condensed contact problem",
        f"{rows[0].method}, {threads(rows)}. A column is a scene, a point a mesh; all "
        "solvers get the same D and G. Above: median time of the contact law. Below: Gauss–Seidel "
        "sweeps, plain (gauss-seidel) or accelerated (anderson); sweeps and active-set steps together "
        "(newton); iterations (admm). " +
        (f"Other programs: {', '.join(programs)}; their time is that of the contact law by their own "
         "clock, their iterations as they report them. " if programs else "") +
        (f"Crosses on the upper edge: {len(failed)} of {len(rows)} cases are not ok." if failed else
         "All cases were solved."),
        lacking([row for row in rows if row.solved], {"time": seconds, "iterations": iterations}, solver_of))
    xlim = log_limits([row.n_c for row in rows if row.n_c], 1.3)
    for k, (of, words) in enumerate(QUANTITIES):
        ylim = log_limits([value for row in rows if (value := of(row))], 1.6)
        panels = side_by_side(figure, ["" if k else scene for scene in scenes], LEFT,
                              TOP + KEY * (key_lines - 1) + k * (HEIGHT + GAP), HEIGHT, GAP)
        for axes, own in zip(panels, scenes.values()):
            log_log(axes, xlim=xlim, ylim=ylim, xlabel="contact forces $n_C$" if k else "")
            axes.tick_params(labelbottom=k == 1)
            draw_solvers(axes, own, of, looks)
        panels[0].set_ylabel(words)
    for k, (solver, (colour, marker)) in enumerate(looks.items()):
        line, place = divmod(k, A_LINE)
        text_at(figure, LEFT + 0.2 + 1.5 * place, 0.36 + KEY * line, plain(solver), color=colour,
                va="center", fontsize=9)
        axes = axes_at(figure, LEFT + 1.5 * place, 0.31 + KEY * line, 0.12, 0.1)
        axes.plot(0, 0, marker=marker, color=colour, markersize=5, clip_on=False)
        axes.set_axis_off()
    return figure


def draw_solvers(axes: Axes, rows: list[Row], of: Callable[[Row], float | None],
                 looks: dict[str, tuple[str, str]]) -> None:
    for solver, own in grouped(rows, solver_of).items():
        colour, marker = looks[solver]
        known = sorted((row.n_c, of(row)) for row in own if of(row) and row.n_c)
        axes.plot([n for n, _ in known], [value for _, value in known], color=colour,
                  marker=marker, markersize=4, linewidth=1)
        lost = [row.n_c for row in own if not row.solved and row.n_c]
        shift = AT_EDGE - 0.06 * list(looks).index(solver)
        axes.plot(lost, [shift] * len(lost), transform=axes.get_xaxis_transform(), color=colour,
                  marker="x", markersize=6, linestyle="none")
