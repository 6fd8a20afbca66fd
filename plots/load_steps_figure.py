"""Time along a path of loads over the number of its steps: what a body costs once and each step."""
from __future__ import annotations

from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import study_parts as parts
from direct_labels import Labels
from figure_files import PAGE_WIDTH, Drawing
from figure_parts import log_limits, log_log
from figure_table import csv_of
from record_keys import Row
from selection import by_mesh, grouped

LEFT, TOP, BOTTOM, HEIGHT, GAP = 0.62, 0.55, 0.45, 3.6, 0.15  # inches
COLUMNS = ("mesh", "method", "load_steps", "status", "time_s", "time_once_s", "time_per_load_s")
MESHES = 2  # that there is room for


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = [row for row in rows if row.study == "load-steps" and row.load_steps]
    shown = [row for own in list(by_mesh(study).values())[:MESHES] for row in own]
    if shown:
        yield Drawing("load_steps", shown, draw, table_of, vector=True)


def table_of(rows: list[Row]) -> str:
    return csv_of([row for own in by_mesh(rows).values() for row in
                   sorted(own, key=lambda row: (*parts.order(row), row.load_steps))], *COLUMNS)


def draw(rows: list[Row]) -> Figure | str:
    """The figure, or why there is none."""
    timed = [row for row in rows if row.completed and row.time_s]
    if not timed:
        return "no case of the study of load steps has a time"
    meshes = by_mesh(timed)
    lost = len(rows) - len(timed)
    figure = parts.sheet(PAGE_WIDTH, TOP + HEIGHT + BOTTOM, "Load steps", [
        "Time of all steps of a path to the same loads, over their number. Level at the left: what "
        "a body costs once, its condensation; rising in proportion to the right: what each step "
        "costs anew, contact law, recovery and check, or a whole iteration. "
        f"{parts.threads(rows)}."
        + (f" {lost} of {len(rows)} cases have no answer and are not drawn." if lost else "")])
    row = parts.side_by_side(figure, meshes, LEFT, TOP, HEIGHT, GAP)
    for k, (axes, own) in enumerate(zip(row, meshes.values())):
        log_log(axes, xlim=log_limits([row.load_steps for row in timed], 1.4),
                ylim=log_limits([row.time_s for row in timed], 1.6), xlabel="load steps, 1",
                ylabel="" if k else "time, s")
        draw_methods(axes, own)
    return figure


def draw_methods(axes: Axes, rows: list[Row]) -> None:
    labels, curves = Labels(axes), []
    for method, own in grouped(sorted(rows, key=parts.order), lambda row: row.method).items():
        own.sort(key=lambda row: row.load_steps)
        look = own[0].look
        curve = [row.load_steps for row in own], [row.time_s for row in own]
        axes.plot(*curve, color=look.colour, marker=look.marker, markersize=5, linewidth=1.2)
        labels.avoid(*curve)
        curves.append((method, curve, look.colour))
    for method, (steps, times), colour in curves:
        labels.add(method, steps[::-1], times[::-1], color=colour, weight="bold")
