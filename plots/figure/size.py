"""Figs 4 and 5: time and memory of the compared methods over the meshes' sizes n_phi."""
import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from catalogue import plain_looks
from drawing import MATH, TYPE, Drawing, axes_at, log_limits, log_log
from labels import draw_leader, mark_meshes, name_places
from marks import (EDGE_AT, HEAP, TIME, WIDTH, ErrorScale, Footer, Quantity, draw_point,
                   marker_style, notes_of, of_no_study)
from records import Row
from selection import by_body, compared, exponent, grouped, sharing_axes, with_suffix
from words import CASE, EXTRAPOLATED, csv_of, left_out, plain, width_of

LEFT, BESIDE, TOP, HEIGHT, BOTTOM = 0.62, 1.04, 0.36, 3.9, 0.42  # BESIDE: and a name
NAMES = 0.66  # place for them at least
ROOM = 12  # methods
LINE_COLOR = "0.35"
LABEL_PT = 14  # between labels
BESIDE_PT = 7  # between points that would cover each other

PlainLooks = dict[str, tuple[str, object]]  # method -> marker, dashes


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    stops, scale = of_no_study(rows)
    for stop, own in stops.items():
        shown = compared(sized(own), ROOM)
        for name, quantity in (("figure4", TIME), ("figure5", HEAP)):
            yield Drawing(with_suffix(name, stop), shown, draw, partial(table_of, quantity=quantity),
                          vector=True, options=dict(run=own, quantity=quantity, scale=scale))


def table_of(rows: list[Row], quantity: Quantity) -> str:
    """exponent: of the method's line, which ends where a body's sizes overlap those of the next."""
    values = ("time_s", *EXTRAPOLATED) if quantity is TIME else ("peak_heap_bytes",)
    lines = [line for own in sharing_axes(rows) for line in lines_of(own).values()]
    powers = {row.line: fit(line, quantity) for line in lines for row in line}
    return csv_of([row for line in lines for row in line], *CASE, *values, "error_force",
                  ("exponent", lambda row: powers[row.line]))


def sized(rows: list[Row]) -> list[Row]:
    """Gives cases that ended before their unknowns were counted the size of their mesh."""
    sizes = {row.mesh: row.n_phi for row in rows if row.n_phi}
    return [row if row.n_phi else replace(row, n_phi=sizes[row.mesh]) for row in rows
            if row.mesh in sizes]


def lines_of(rows: list[Row]) -> dict[str, list[Row]]:
    """Method, by its name in the figure, -> its rows by body, then by size."""
    names = {}
    for row in rows:
        if row.general_name not in names or row.method != row.general_name:
            names[row.general_name] = row.method
    bodies = list(dict.fromkeys(row.body for row in sorted(rows, key=lambda row: row.n_phi)))
    return {name: sorted(line, key=lambda row: (bodies.index(row.body), row.n_phi))
            for name, line in grouped(rows, lambda row: names[row.general_name]).items()}


def draw(rows: list[Row], run: list[Row], quantity: Quantity, scale: ErrorScale) -> Figure | str:
    if not rows:
        return "no methods to compare"
    if not quantity.marked(rows):
        return f"none of its {len(rows)} cases has a {quantity.name}"
    lines = lines_of(rows)
    looks = plain_looks({name: (line[0].family, line[0].preconditioner)
                         for name, line in lines.items()})
    cases = ((f"{name} on {row.mesh}", row) for name, line in lines.items() for row in line)
    texts = [quantity.caption(rows, run) + " n^p: power law fitted over a method's "
             "completed cases, three or more. Points that would cover each other are moved "
             "apart.", left_out(run, rows, lambda row: "no room"),
             *notes_of(cases, quantity)]
    footer = Footer(rows, quantity, texts, scale)
    shared = sharing_axes(rows)
    top = TOP + names_pt(rows) / 72
    block = top + HEIGHT + BOTTOM
    figure = Figure(figsize=(WIDTH, len(shared) * block + footer.height))
    names = max(NAMES, *(width_of(name, TYPE) / 72 for name in lines))
    for k, own in enumerate(shared):
        axes = axes_at(figure, LEFT, k * block + top, WIDTH - LEFT - BESIDE - names, HEIGHT)
        bodies = {row.body for row in own}
        kept = {name: [row for row in line if row.body in bodies] for name, line in lines.items()}
        draw_block(axes, {name: line for name, line in kept.items() if line}, looks, quantity,
                   scale)
    footer.draw(figure)
    return figure


def draw_block(axes: Axes, lines: dict[str, list[Row]], looks: PlainLooks, quantity: Quantity,
               scale: ErrorScale) -> None:
    rows = [row for line in lines.values() for row in line]
    log_log(axes, xlim=log_limits([row.n_phi for row in rows], 1.25),
            ylim=log_limits(value for _, value, _ in quantity.marked(rows)))
    axes.set_ylabel(quantity.axis)
    axes.yaxis.set_label_coords(-0.49 / width_in(axes), 0.5)
    axes.set_xlabel(r"$n_\varphi$", fontsize=MATH, labelpad=2)
    axes.grid(axis="y")
    mark_meshes(axes, {row.mesh: row.n_phi for row in rows}, 45, TYPE)
    name_bodies(axes, rows, 8 + names_pt(rows))
    places = side_by_side(axes, rows, quantity)
    ends = {name: draw_line(axes, line, looks[name], quantity, scale, places)
            for name, line in lines.items()}
    draw_labels(axes, ends, {name: fit(line, quantity) for name, line in lines.items()}, looks)


def fit(line: list[Row], quantity: Quantity) -> float | None:
    done = quantity.done(line)
    return exponent([row.n_phi for row, _ in done], [value for _, value in done])


def names_pt(rows: list[Row]) -> float:
    """Height of the meshes' names, at 45 degrees."""
    return 0.71 * max(width_of(row.mesh, TYPE) for row in rows) + TYPE


def width_in(axes: Axes) -> float:
    return axes.get_position().width * WIDTH


def name_bodies(axes: Axes, rows: list[Row], above_pt: float) -> None:
    by_size = sorted(rows, key=lambda row: row.n_phi)
    bodies = {body: [row.n_phi for row in own] for body, own in by_body(by_size).items()}
    for n_phi in {row.n_phi for row in rows}:
        axes.axvline(n_phi, color="0.88", linewidth=0.4, zorder=0)
    ends = list(bodies.values())
    for before, after in zip(ends, ends[1:]):
        axes.axvline(math.sqrt(before[-1] * after[0]), color="0.45", linewidth=0.6,
                     linestyle=(0, (1, 2)), zorder=0)
    for body, of_body in bodies.items():
        axes.annotate(plain(body), (math.sqrt(of_body[0] * of_body[-1]), 1), ha="center",
                      xycoords=axes.get_xaxis_transform(), xytext=(0, above_pt),
                      textcoords="offset points", color="0.25")


def side_by_side(axes: Axes, rows: list[Row], quantity: Quantity) -> dict[int, float]:
    """Row's line -> x of its point, moved off n_phi where points would cover each other."""
    size_pt = 72 * np.array([width_in(axes), HEIGHT])
    to_pt = axes.transData + axes.transAxes.inverted()
    taken: list[np.ndarray] = []
    places = {}
    for row, value, _ in quantity.marked(rows):
        x, y = to_pt.transform((row.n_phi, value or 1))
        point = np.array([x, EDGE_AT if value is None else y]) * size_pt
        tried = (point + [shift * BESIDE_PT, 0] for k in range(99) for shift in (k, -k))
        point = next(p for p in tried if all(max(abs(p - q)) > 0.99 * BESIDE_PT for q in taken))
        taken.append(point)
        places[row.line] = to_pt.inverted().transform(point / size_pt)[0]
    return places


def draw_line(axes: Axes, line: list[Row], look: tuple[str, object], quantity: Quantity,
              scale: ErrorScale, places: dict[int, float]) -> tuple[float, float] | None:
    """Returns its last point with a value."""
    marker, dashes = look
    last = None
    for row, following in zip(line, [*line[1:], None]):
        value, mark = quantity.of(row)
        if mark == "none":
            continue
        x = places[row.line]
        draw_point(axes, x, value, row, mark, scale, marker)
        if value is None:
            continue
        last = (x, value)
        end = quantity.of(following)[0] if following else None
        if end is not None and row.body == following.body:
            axes.plot([x, places[following.line]], [value, end], color=LINE_COLOR,
                      linestyle=dashes, linewidth=0.8, zorder=2)
    return last


def draw_labels(axes: Axes, ends: dict[str, tuple[float, float] | None],
                fits: dict[str, float | None], looks: PlainLooks) -> None:
    inch = 1 / width_in(axes)
    exponents = (WIDTH - LEFT - 0.49) * inch
    for method, at, y in name_places(axes, ends, LABEL_PT):
        marker, dashes = looks[method]
        style = dict(transform=axes.transAxes, clip_on=False)
        if ends[method]:
            draw_leader(axes, at, 1 + 0.12 * inch, y, color="0.6")
        axes.plot([1 + 0.14 * inch, 1 + 0.46 * inch], [y, y], **style, color=LINE_COLOR,
                  linestyle=dashes, linewidth=0.8)
        axes.plot(1 + 0.3 * inch, y, **style, **marker_style(marker, "white"))
        axes.text(1 + 0.52 * inch, y, plain(method), va="center", **style)
        if fits[method] is not None:
            axes.text(exponents, y, rf"$n^{{{fits[method]:.2f}}}$", va="center",
                      fontsize=MATH, **style)
