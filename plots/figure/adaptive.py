"""Total error against unknowns and time: adapted meshes next to the meshes as they are."""
import re
from collections.abc import Callable, Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import Drawing, log_limits, log_log, panel_at, sheet
from labels import Labels
from marks import CROSS, WIDTH
from records import Row
from selection import (by_body, by_mesh, exponent, grouped, is_paper_stop, kind_of, line_of,
                       of_scene, order)
from words import CASE, csv_of, left_out, plain, threads

LEFT, TOP, BOTTOM, HEIGHT, GAP, BETWEEN = 0.62, 0.45, 0.42, 2.5, 0.15, 0.5  # inches
BODIES = 2  # that there is room for
ALL_LEVELS = "#B00020"
COLOURS = {"as they are": "0.35", "refined everywhere": "#4B6BC8", "adapted": ALL_LEVELS}  # of kinds
DASHES = {"as they are": (0, (4, 2)), "refined everywhere": (0, (1, 1)), "adapted": "-"}
LOOKS = {"as they are": "open, dashed", "refined everywhere": "open, dotted", "adapted": "filled, solid"}
LEVEL_OF_DEGREE = re.compile(r"\+adapt\d+k(\d+)")  # of stresses
HIGHEST = 1.0  # total errors above are not drawn


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    run = of_scene([row for row in rows if (not row.study or row.points == "accuracy") and not row.knob
                    and not is_paper_stop(row)])
    known = [row for row in run if row.completed and row.error_total]
    bodies = {body for body, own in by_body(known).items()
              if len({row.n_phi for row in own if kind_of(row) == "adapted"}) > 1}
    shown = [row for row in known if row.body in sorted(bodies)[:BODIES]]
    if shown:
        yield Drawing("adaptive", shown, draw, table_of, vector=True, options=dict(run=run))


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, ("kind_of_mesh", kind_of), "adapt_level", "error_total", "time_s",
                  "adapt_time_s")


def best_of(rows: list[Row]) -> list[Row]:
    return [min(own, key=lambda row: row.error_total) for own in by_mesh(rows).values()]


def adapting(row: Row) -> str:
    """The method that solved the levels of its loop."""
    degree = LEVEL_OF_DEGREE.search(row.mesh)
    return (row.context or {}).get("adapt_by") or (f"HYBRID:k={degree[1]}" if degree else "HYBRID")


def solved_by(method: str, rows: list[Row]) -> list[Row]:
    """A row per mesh; of the method, or of all if it is not there."""
    return best_of([row for row in rows if method in (row.method, row.general_name)] or rows)


def loops_in(rows: list[Row]) -> dict[str, list[Row]]:
    """A loop's levels, solved by the method of the loop, by its name."""
    adapted = grouped([row for row in rows if kind_of(row) == "adapted"], adapting)
    return {method: solved_by(method, own) for method, own in adapted.items()}


def name_among(rows: list[Row], row: Row) -> str:
    """Of its line; with its degree where others of its family have a higher one."""
    highest = max((other.degree for other in rows if other.family == row.family), default=1)
    return row.label + ", degree 1" * (row.degree == 1 < highest)


def is_crossed(row: Row) -> bool:
    return row.status != "ok"


def kinds_in(rows: list[Row]) -> str:
    kinds = {kind_of(row) for row in rows}
    return ", ".join(f"{kind} ({look})" for kind, look in LOOKS.items() if kind in kinds) \
        if len(kinds) > 1 else "".join(kinds)


def words_of_crosses(rows: list[Row]) -> str:
    return "Crossed: not ok. " * any(map(is_crossed, rows))


def words_of_loops(rows: list[Row]) -> str:
    methods = {row.method for loop in loops_in(rows).values() for row in loop}
    return f"Above, and red: errors of {' and '.join(sorted(methods))}, which solves the levels. " \
        if methods <= set(loops_in(rows)) else ""


def why(row: Row) -> str:
    return "only on other bodies" if row.error_total and row.error_total <= HIGHEST \
        else f"no total error up to {HIGHEST:g}"


def draw(rows: list[Row], run: list[Row]) -> Figure:
    every = [row for row in rows if row.error_total <= HIGHEST]
    bodies = by_body(every)
    figure = sheet(
        TOP + 2 * HEIGHT + BETWEEN + BOTTOM, "Adapted meshes",
        f"Scene {rows[0].scene}. Total error, discretisation and method together. Meshes: "
        f"{kinds_in(every)}. Below: the time of one solve on the mesh; red: of the whole adaptive loop, "
        f"all levels and estimates of the error. {words_of_loops(every)}{words_of_crosses(every)}"
        "N^p: power law by least squares of logarithms, of adapted meshes with at least 1.5 times "
        f"the first one's unknowns. {threads(rows)}.", left_out(run, every, why), width=WIDTH)
    times = [t for row in every for t in (row.time_s, row.adapt_time_s) if t]
    width = (WIDTH - LEFT - 0.1 - (len(bodies) - 1) * GAP) / len(bodies)
    panels = ((TOP, draw_unknowns, r"unknowns $n_\varphi$", [row.n_phi for row in every]),
              (TOP + HEIGHT + BETWEEN, draw_times, "time, s", times))
    for k, (body, own) in enumerate(bodies.items()):
        for top, draw_panel, xlabel, x in panels:
            axes = panel_at(figure, LEFT + k * (width + GAP), top, width, HEIGHT)
            log_log(axes, xlim=log_limits(x, 1.3), xlabel=xlabel,
                    ylim=log_limits([row.error_total for row in every], 1.4),
                    ylabel="" if k else "total error", title=plain(body) if top == TOP else "")
            axes.tick_params(labelleft=k == 0)
            draw_panel(axes, own)
    return figure


def style(row: Row, marker: str, colour: str) -> dict[str, object]:
    kind = kind_of(row)
    return dict(marker=marker, markersize=4.5, linewidth=1.1, linestyle=DASHES[kind],
                markerfacecolor=colour if kind == "adapted" else "white")


def draw_unknowns(axes: Axes, rows: list[Row]) -> None:
    labels = Labels(axes)
    loops = loops_in(rows)
    first = next(iter(loops))
    lines = [(kind, solved_by(first, [row for row in rows if kind_of(row) == kind]))
             for kind in COLOURS if kind != "adapted"]
    lines += [("adapted" + f" by {by}" * (len(loops) > 1), own) for by, own in loops.items()]
    for name, own in filter(lambda line: line[1], lines):
        kind = kind_of(own[0])
        late = [row for row in own if kind != "adapted" or row.n_phi >= 1.5 * own[0].n_phi]
        power = exponent(*line_of(late, "n_phi", "error_total"), least=2)
        labels.line(name if power is None else f"{name}: $N^{{{power:.2f}}}$",
                    *line_of(own, "n_phi", "error_total"), COLOURS[kind], formula=True,
                    **style(own[0], own[0].look.marker if len(loops) > 1 else "o", COLOURS[kind]))
    labels.name_lines(weight="bold")


def draw_times(axes: Axes, rows: list[Row]) -> None:
    labels = draw_over_time(axes, rows, lambda row: row.time_s)
    loops = loops_in(rows)
    for by, own in loops.items():
        if loop := [(row.adapt_time_s, row.error_total) for row in own if row.adapt_time_s]:
            labels.line("whole loop" + f" of {by}" * (len(loops) > 1), *zip(*loop), ALL_LEVELS,
                        linewidth=2, zorder=6)
    labels.name_lines(weight="bold")


def draw_over_time(axes: Axes, rows: list[Row], time: Callable[[Row], float | None]) -> Labels:
    """Total errors, a line per method and kind of mesh; a method is named once. Names are still to be drawn."""
    labels, named = Labels(axes), set()
    lines = grouped(sorted(filter(time, rows), key=lambda row: (kind_of(row) != "adapted", order(row), row.n_phi)),
                    lambda row: (row.method, kind_of(row), kind_of(row) == "adapted" and adapting(row)))
    for own in lines.values():
        first, look = own[0], own[0].look
        words = name_among(rows, first)
        labels.line("" if words in named else words, list(map(time, own)),
                    [row.error_total for row in own], look.colour, **style(first, look.marker, look.colour))
        for row in filter(is_crossed, own):
            axes.plot(time(row), row.error_total, **CROSS, zorder=6)
        named.add(words)
    return labels
