"""Solvers of the condensed contact problem: their time and iterations over its size."""
from collections.abc import Callable, Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import (Drawing, axes_at, file_name, log_limits, log_log, sheet, side_by_side,
                     text_at)
from records import CONTACT_SOLVERS, Row
from selection import grouped
from words import CASE, csv_of, plain, threads

LEFT, TOP, GAP, HEIGHT, BOTTOM, KEY = 0.72, 0.62, 0.12, 2.3, 0.45, 0.3  # inches
LOOKS = dict(zip(CONTACT_SOLVERS, (("#000000", "o"), ("#D55E00", "s"), ("#0072B2", "^"),
                                   ("#00805C", "D"))))
AT_EDGE = 0.95  # of an axes' height: where a solver that found nothing is marked


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = [row for row in rows if row.study == "contact" and row.contact_solver]
    methods = grouped(study, lambda row: row.method)
    for method, own in methods.items():
        name = "contact" if len(methods) == 1 else file_name("contact", method)
        yield Drawing(name, own, draw, table_of)


def iterations(row: Row) -> float | None:
    if not row.completed or row.contact_iterations is None:
        return None
    return row.contact_iterations + (row.newton_steps or 0)


def seconds(row: Row) -> float | None:
    return row.stage_contact_s if row.completed else None


QUANTITIES = ((seconds, "time of the contact law, s"), (iterations, "iterations"))


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, "n_c", "contact_solver", "stage_contact_s",
                  ("iterations", iterations))


def draw(rows: list[Row]) -> Figure | str:
    if not any(seconds(row) and row.n_c for row in rows):
        return "no case of the contact study has a time"
    scenes = grouped(rows, lambda row: row.scene)
    failed = [row for row in rows if not row.completed]
    figure = sheet(
        TOP + 2 * HEIGHT + GAP + BOTTOM + KEY, "Four solvers of the condensed contact problem",
        f"{rows[0].method}, {threads(rows)}. One column is a scene, one point a mesh: all "
        "solvers get the same D and G there. Above: the median time of the stage; below: "
        "Gauss–Seidel sweeps, plain (gauss-seidel), accelerated (anderson) or before active sets "
        "(newton, whose steps are added), or iterations of ADMM. " +
        (f"Crosses on the upper edge: {len(failed)} of {len(rows)} cases were not solved within "
         "the iterations or the time allowed." if failed else "All cases were solved."))
    xlim = log_limits([row.n_c for row in rows if row.n_c], 1.3)
    for k, (of, words) in enumerate(QUANTITIES):
        ylim = log_limits([value for row in rows if (value := of(row))], 1.6)
        panels = side_by_side(figure, ["" if k else scene for scene in scenes], LEFT,
                              TOP + k * (HEIGHT + GAP), HEIGHT, GAP)
        for axes, own in zip(panels, scenes.values()):
            log_log(axes, xlim=xlim, ylim=ylim, xlabel="contact forces $n_C$" if k else "")
            axes.tick_params(labelbottom=k == 1)
            draw_solvers(axes, own, of)
        panels[0].set_ylabel(words)
    for k, (solver, (colour, marker)) in enumerate(LOOKS.items()):
        text_at(figure, LEFT + 0.2 + 1.5 * k, 0.36, plain(solver), color=colour, va="center",
                fontsize=9)
        axes = axes_at(figure, LEFT + 1.5 * k, 0.31, 0.12, 0.1)
        axes.plot(0, 0, marker=marker, color=colour, markersize=5, clip_on=False)
        axes.set_axis_off()
    return figure


def draw_solvers(axes: Axes, rows: list[Row], of: Callable[[Row], float | None]) -> None:
    for solver, own in grouped(rows, lambda row: row.contact_solver).items():
        colour, marker = LOOKS[solver]
        known = sorted((row.n_c, of(row)) for row in own if of(row) and row.n_c)
        axes.plot([n for n, _ in known], [value for _, value in known], color=colour,
                  marker=marker, markersize=4, linewidth=1)
        lost = [row.n_c for row in own if not row.completed and row.n_c]
        shift = AT_EDGE - 0.06 * CONTACT_SOLVERS.index(solver)
        axes.plot(lost, [shift] * len(lost), transform=axes.get_xaxis_transform(), color=colour,
                  marker="x", markersize=6, linestyle="none")
