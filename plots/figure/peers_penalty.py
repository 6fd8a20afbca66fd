"""Total error against time along another program's own parameter: what the wrong value costs."""
import math
import re
from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import PAGE_WIDTH, Drawing, log_limits, log_log, panel_at, sheet
from labels import Labels
from records import Row
from selection import by_mesh, grouped, of_scene
from words import CASE, axis_label, csv_of, left_out, plain, threads

LEFT, TOP, HEIGHT, BETWEEN, GAP = 0.72, 0.62, 3.4, 0.78, 0.2  # inches
PANELS, IN_ROW = 4, 2
COMPARED = ("P2", "HYBRID")
CHOSEN = re.compile(r"(\w+)=([-+.\de]+)(?:;|$)")


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    run = of_scene([row for row in rows if row.stop == "target" and not row.knob
                    and (not row.study or row.points == "accuracy")])
    known = [row for row in run if row.completed and row.time_s and error_of(row)
             and (is_compared(row) or value_of(row) is not None)]
    meshes = [drawn_of(own) for own in by_mesh(known).values() if sweeps_of(own)][:PANELS]
    if meshes:
        yield Drawing("peers_penalty", [row for own in meshes for row in own], draw, table_of,
                      options=dict(run=run))


def drawn_of(rows: list[Row]) -> list[Row]:
    """Not the only value of a program's parameter."""
    swept = {row.line for own in sweeps_of(rows).values() for row in own}
    return [row for row in rows if row.line in swept or is_compared(row)]


def is_compared(row: Row) -> bool:
    """Without a parameter: one point."""
    return row.method in COMPARED or bool(row.program and row.in_displacements and value_of(row) is None)


def value_of(row: Row) -> float | None:
    """Of a program's own parameter."""
    chosen = CHOSEN.match(row.parameters) if row.program else None
    return float(chosen[2]) if chosen else None


def name_of(row: Row) -> str:
    return CHOSEN.match(row.parameters)[1]


def error_of(row: Row) -> float | None:
    """An inaccurate answer in displacements has no error_total."""
    return row.error_total or (row.error_discretisation if row.in_displacements else None)


def sweeps_of(rows: list[Row]) -> dict[str, list[Row]]:
    """Program -> its rows by value, where there are two or more."""
    sweeps = grouped(sorted((row for row in rows if value_of(row) is not None), key=value_of),
                     lambda row: row.family)
    return {program: own for program, own in sweeps.items() if len(own) > 1}


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, ("parameter", lambda row: name_of(row) if value_of(row) else None),
                  ("value", value_of), "time_s", ("error", error_of), "penetration_share")


def why(row: Row) -> str:
    return "no total error" if not error_of(row) else \
        "not in displacements" if value_of(row) is None else "one value only"


def draw(rows: list[Row], run: list[Row]) -> Figure:
    meshes = by_mesh(rows)
    names = sorted({f"{own[0].family.removeprefix('EXTERNAL:')}: {name_of(own[0])}"
                    for of_mesh in meshes.values() for own in sweeps_of(of_mesh).values()})
    in_row = min(IN_ROW, len(meshes))
    lines = math.ceil(len(meshes) / in_row)
    figure = sheet(
        TOP + lines * (HEIGHT + BETWEEN) - BETWEEN + 0.45, "What a program's own parameter costs",
        f"Total error over the time of one solve by the program's own clock; scene {rows[0].scene}, "
        f"{threads(rows)}. Joined: a program at several values of its parameter, written at the points "
        f"({'; '.join(names)}); others have one point. Open: not ok, such as through the wall by more than it is allowed.",
        left_out(run, rows, why))
    times, errors = (log_limits(values, 1.7) for values in ([row.time_s for row in rows], map(error_of, rows)))
    width = (PAGE_WIDTH - LEFT - 0.15 - GAP * (in_row - 1)) / in_row
    for k, (mesh, own) in enumerate(meshes.items()):
        axes = panel_at(figure, LEFT + k % in_row * (width + GAP), TOP + k // in_row * (HEIGHT + BETWEEN),
                        width, HEIGHT)
        log_log(axes, xlim=times, ylim=errors, xlabel="time, s", title=plain(mesh),
                ylabel="" if k % in_row else axis_label("error_total"))
        axes.tick_params(labelleft=k % in_row == 0)
        draw_panel(axes, own)
    return figure


def draw_panel(axes: Axes, rows: list[Row]) -> None:
    labels = Labels(axes)
    lines = sweeps_of(rows) | {row.method: [row] for row in rows if is_compared(row)}
    for name, own in lines.items():
        colour, marker, *_ = own[0].look
        labels.line(name.removeprefix("EXTERNAL:"), [row.time_s for row in own], [error_of(row) for row in own],
                    colour, linewidth=1.2)
        for row in own:
            axes.plot(row.time_s, error_of(row), color=colour, marker=marker, markersize=5,
                      markerfacecolor=colour if row.status == "ok" else "white", zorder=4)
    for own in sweeps_of(rows).values():
        for row in own:
            labels.add(f"{value_of(row):g}", row.time_s, error_of(row), fontsize=7, color=row.look.colour)
    labels.name_lines(weight="bold")
