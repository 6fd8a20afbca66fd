"""Total error against time: a method of the paper at both stops, ours, and ours on adapted meshes."""
from collections.abc import Iterator
from dataclasses import dataclass

from matplotlib.figure import Figure

from drawing import Drawing, log_limits, log_log, sheet, side_by_side
from figure.adaptive import loops_in
from labels import Labels
from records import Row
from selection import by_body, grouped, kind_of, line_of, of_scene, order
from words import CASE, axis_label, csv_of, left_out, short, threads

LEFT, TOP, BOTTOM, HEIGHT, GAP = 0.72, 0.6, 0.45, 3.7, 0.15  # inches
BODIES = 2  # that there is room for
LOOP = "whole adaptive loop"


@dataclass(frozen=True)
class Curve:
    words: str
    rows: list[Row]
    dashes: object
    filled: bool


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    run = of_scene([row for row in rows if not row.study])
    known = [row for row in run if row.completed and row.time_s and row.error_total
             and not row.in_displacements]
    shown = [row for own in list(by_body(known).values())[:BODIES] for row in own]
    if {"paper", "target"} <= {row.stop for row in shown if row.iterative} and any(
            kind_of(row) == "adapted" for row in shown):
        yield Drawing("overview", shown, draw, table_of, options=dict(run=run))


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, ("kind_of_mesh", kind_of), "time_s", "adapt_time_s", "error_total",
                  "error_discretisation", "error_force")


def curves_of(rows: list[Row]) -> list[Curve]:
    """Direct methods have no stop: those with the paper's are left out."""
    curves = []
    rows = sorted((row for row in rows if row.stop == "target" or row.iterative),
                  key=lambda row: (order(row), row.n_phi))
    for (_, stop, kind), own in grouped(
            rows, lambda row: (row.method, row.stop, kind_of(row))).items():
        target = max(row.target_error or 0 for row in own)
        words = f"{own[0].label}, the paper’s stop" if stop == "paper" else \
            f"{own[0].label} to {short(target)}" if own[0].iterative else own[0].label
        adapted = kind == "adapted"
        curves.append(Curve(words + ", adapted meshes" * adapted, own, (0, (1, 1))
                            if stop == "paper" else "-" if adapted else (0, (5, 2)), adapted))
    return curves


def loops_of(rows: list[Row]) -> list[list[tuple[float, float]]]:
    adapted = [row for row in rows if row.adapt_time_s and row.stop == "target"]
    return [[(row.adapt_time_s, row.error_total) for row in sorted(loop, key=lambda row: row.n_phi)]
            for loop in loops_in(adapted).values()]


def why(row: Row) -> str:
    return "in displacements" if row.in_displacements else "no total error" if not row.error_total \
        else "only on other bodies"


def draw(rows: list[Row], run: list[Row]) -> Figure:
    bodies = by_body(rows)
    figure = sheet(
        TOP + HEIGHT + BOTTOM, "Which mesh and method for which error",
        f"Scene {rows[0].scene}, {threads(rows)}. Total error of the stresses, mesh and method "
        "together, over the time of one solve; a point per mesh. Dotted: the paper’s own stop; dashed: "
        "the method’s own error is below its target, what remains is the mesh’s; solid, filled: meshes "
        f"adapted to the error. Thin: the {LOOP}, all levels and error estimates.",
        left_out(run, rows, why))
    curves = {body: curves_of(own) for body, own in bodies.items()}
    errors = log_limits([row.error_total for own in curves.values() for curve in own
                         for row in curve.rows], 1.4)
    panels = side_by_side(figure, bodies, LEFT, TOP, HEIGHT, GAP)
    for axes, (body, own) in zip(panels, bodies.items()):
        loops = loops_of(own)
        times = [row.time_s for row in own] + [time for loop in loops for time, _ in loop]
        log_log(axes, xlim=log_limits(times, 1.5), ylim=errors, xlabel=axis_label("time_s"),
                ylabel=axis_label("error_total") if axes is panels[0] else "")
        labels = Labels(axes)
        for curve in curves[body]:
            look = curve.rows[0].look
            labels.line(curve.words, *line_of(curve.rows, "time_s", "error_total"), look.colour,
                        linestyle=curve.dashes, linewidth=1.4, marker=look.marker, markersize=5,
                        markerfacecolor=look.colour if curve.filled else "white")
        for loop in loops:
            axes.plot(*zip(*loop), color="0.45", linewidth=0.8)
            labels.avoid(*zip(*loop))
        labels.name_lines(weight="bold")
        for loop in loops:
            labels.add(LOOP, *zip(*loop[::-1]), color="0.35")
    return figure
