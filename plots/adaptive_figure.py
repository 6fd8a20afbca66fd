"""Total error against unknowns and time: adapted meshes beside the meshes as they are."""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import study_parts as parts
from direct_labels import Labels
from figure_files import Drawing
from figure_parts import WIDTH, axes_at, log_limits, log_log
from figure_table import CASE, csv_of
from figure_words import plain
from record_keys import Row
from selection import by_body, grouped, is_paper_stop, kind_of, of_scene

LEFT, TOP, BOTTOM, HEIGHT, GAP, BETWEEN = 0.62, 0.45, 0.42, 2.5, 0.15, 0.5  # inches
BODIES = 2  # that there is room for
ALL_LEVELS = "#B00020"
COLOURS = {"as they are": "0.35", "refined everywhere": "#4B6BC8", "adapted": ALL_LEVELS}  # of kinds
DASHES = {"as they are": (0, (4, 2)), "refined everywhere": (0, (1, 1)), "adapted": "-"}
HIGHEST = 1.0  # total errors above are not drawn


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    known = of_scene([row for row in rows if row.study in ("", "error") and not row.knob
                      and not is_paper_stop(row) and row.completed and row.error_total])
    bodies = {body for body, own in by_body(known).items()
              if len({row.n_phi for row in own if kind_of(row) == "adapted"}) > 1}
    shown = [row for row in known if row.body in sorted(bodies)[:BODIES]]
    if shown:
        yield Drawing("adaptive", shown, draw, table_of, vector=True)


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, ("kind_of_mesh", kind_of), "adapt_level", "error_total", "time_s",
                  "adapt_time_s")


def slope(unknowns: list[int], errors: list[float]) -> float:
    """p of error ~ N^p by least squares of logarithms."""
    return float(np.polyfit(np.log(unknowns), np.log(errors), 1)[0])


def meshes_of(rows: list[Row]) -> list[tuple[int, float, float | None]]:
    """Unknowns, smallest total error and time of the loop of every mesh, by size."""
    found = []
    for own in grouped(sorted(rows, key=lambda row: row.n_phi), lambda row: row.mesh).values():
        best = min(own, key=lambda row: row.error_total)
        found.append((best.n_phi, best.error_total, best.adapt_time_s))
    return found


def draw(rows: list[Row]) -> Figure:
    bodies = by_body([row for row in rows if row.error_total <= HIGHEST])
    panel = (WIDTH - LEFT - 0.1 - (len(bodies) - 1) * GAP) / len(bodies)
    figure = parts.sheet(WIDTH, TOP + 2 * HEIGHT + BETWEEN + BOTTOM, "Adapted meshes", [
        f"Scene {rows[0].scene}. Total error, discretisation and method together, of the meshes as "
        "they are (open, dashed), refined everywhere (open, dotted) and adapted (filled, solid). Below: "
        "the time of one solve on the mesh; red: of the whole adaptive loop, all levels and "
        "estimates of the error. "
        "N^p: power law by least squares of logarithms, of adapted meshes from 1.5 times the first "
        f"one's unknowns on. {parts.threads(rows)}."])
    every = [row for own in bodies.values() for row in own]
    errors = log_limits([row.error_total for row in every], 1.4)
    for k, (body, own) in enumerate(bodies.items()):
        left = LEFT + k * (panel + GAP)
        over = axes_at(figure, left, TOP, panel, HEIGHT)
        log_log(over, xlim=log_limits([row.n_phi for row in every], 1.3), ylim=errors,
                xlabel=r"unknowns $n_\varphi$, 1", ylabel="" if k else "total error, 1")
        over.set_title(plain(body))
        draw_unknowns(over, own)
        under = axes_at(figure, left, TOP + HEIGHT + BETWEEN, panel, HEIGHT)
        times = [t for row in every for t in (row.time_s, row.adapt_time_s) if t]
        log_log(under, xlim=log_limits(times, 1.3), ylim=errors, xlabel="time, s",
                ylabel="" if k else "total error, 1")
        draw_times(under, own)
        for axes in (over, under):
            axes.grid(which="major")
            axes.spines[["top", "right"]].set_visible(False)
            if k:
                axes.tick_params(labelleft=False)
    return figure


def style(row: Row, colour: str, marker: str) -> dict[str, object]:
    kind = kind_of(row)
    return dict(color=colour, marker=marker, markersize=4.5, linewidth=1.1, linestyle=DASHES[kind],
                markerfacecolor=colour if kind == "adapted" else "white")


def draw_unknowns(axes: Axes, rows: list[Row]) -> None:
    labels, words_of = Labels(axes), {}
    for kind, colour in COLOURS.items():
        own = [row for row in rows if kind_of(row) == kind]
        if not own:
            continue
        sizes, errors, _ = zip(*meshes_of(own))
        axes.plot(sizes, errors, **style(own[0], colour, "o"))
        labels.avoid(sizes, errors)
        late = [k for k, size in enumerate(sizes) if kind != "adapted" or size >= 1.5 * sizes[0]]
        words = kind
        if len({sizes[k] for k in late}) > 1:
            power = slope([sizes[k] for k in late], [errors[k] for k in late])
            words += f": $N^{{{power:.2f}}}$"
        words_of[words] = sizes[::-1], errors[::-1], colour
    for words, (sizes, errors, colour) in words_of.items():
        labels.add(words, sizes, errors, formula=True, color=colour, weight="bold")


def draw_times(axes: Axes, rows: list[Row]) -> None:
    labels = Labels(axes)
    named: set[str] = set()
    curves = grouped([row for row in rows if row.time_s],
                     lambda row: (row.method, kind_of(row)))
    for (method, _), own in sorted(curves.items(), key=lambda item: item[0][1] != "adapted"):
        own.sort(key=lambda row: row.n_phi)
        line = [row.time_s for row in own], [row.error_total for row in own]
        axes.plot(*line, **style(own[0], own[0].look.colour, own[0].look.marker))
        labels.avoid(*line)
        if method not in named:
            named.add(method)
            labels.add(method, line[0][::-1], line[1][::-1], color=own[0].look.colour,
                       weight="bold")
    adapted = [row for row in rows if kind_of(row) == "adapted"]
    loop = [(time, error) for _, error, time in meshes_of(adapted) if time]
    if loop:
        axes.plot(*zip(*loop), color=ALL_LEVELS, linewidth=2, zorder=6)
        labels.add("whole loop", *map(list, zip(*loop[::-1])), color=ALL_LEVELS, weight="bold")
