"""Figs 4 and 5: time and memory of the compared methods over the meshes' sizes n_phi."""
from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import figure_parts as parts
from figure_parts import EDGE_AT, ErrorScale, Footer, Quantity, axes_at, draw_point
from figure_words import Notes
from method_names import COMPARED, compared
from paper_sizes import BODIES, SIZES
from results_table import Row

# Marker and dashes; black and white will do.
STYLES = {
    "SDTIC3": ("^", (0, (3, 1.5))), "3STEPCG3": ("s", (0, (3, 1.5))),
    "SDTIC6": ("v", (0, (5, 1.5, 1, 1.5))), "3STEPCG6": ("D", (0, (5, 1.5, 1, 1.5))),
    "SSKY": (">", (0, (1, 1.2))), "3STEPD": ("o", "-"), "ALM": ("*", "-"),
    "BLIND": ("<", (0, (8, 2))), "HYBRID": ("P", "-"),
}
LEFT, RIGHT, TOP, HEIGHT, BOTTOM = 0.62, 1.7, 0.66, 3.9, 0.42
LINE_COLOR = "0.35"
LABEL_PT = 14  # between labels
BESIDE_PT = 7  # between points that would cover each other


def n_of(row: Row) -> int:
    """n_phi; that of Tab. 1 for a case that ended before it was counted."""
    return row.n_phi or SIZES[row.mesh].n_phi


def exponent(n_phi: list[int], values: list[float]) -> float | None:
    """p of the power law value ~ n_phi^p by least squares of logarithms; needs three points."""
    if len(values) < 3 or len(set(n_phi)) < 2:
        return None
    return float(np.polyfit(np.log(n_phi), np.log(values), 1)[0])


def spread(wanted: list[float], spacing: float, low: float, high: float) -> list[float]:
    """Ascending positions at least `spacing` apart, closest to the ascending `wanted` ones."""
    blocks: list[list[float]] = []  # [sum, count] of positions less the spacing below them
    for k, position in enumerate(wanted):
        blocks.append([position - k * spacing, 1])
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] > blocks[-1][0] / blocks[-1][1]:
            total, n = blocks.pop()
            blocks[-1] = [blocks[-1][0] + total, blocks[-1][1] + n]
    highest = high - (len(wanted) - 1) * spacing
    base = [min(max(total / n, low), highest) for total, n in blocks for _ in range(n)]
    return [position + k * spacing for k, position in enumerate(base)]


def lines_of(rows: list[Row]) -> dict[str, list[Row]]:
    """Method -> its rows by size. A method asked for by two names is there once."""
    lines: dict[str, dict[str, Row]] = {}
    for method in COMPARED:
        for row in rows:
            known = lines.setdefault(method, {})
            if compared(row.method) == method and (row.mesh not in known or row.method == method):
                known[row.mesh] = row
    return {method: sorted(known.values(), key=n_of)
            for method, known in lines.items() if known}


def draw(rows: list[Row], quantity: Quantity, scale: ErrorScale) -> tuple[Figure, list[Row]] | str:
    """The figure and its rows, or why there is none. rows: of one scene, one stop."""
    lines = lines_of([row for row in rows if row.mesh in SIZES])
    used = [row for line in lines.values() for row in line]
    if not used:
        return "no rows of its methods on Mesh0..Mesh7"
    if all(quantity.of(row)[1] == "none" for row in used):
        return f"none of its {len(used)} rows has a {quantity.name}"
    notes = Notes()
    for method, line in lines.items():
        for row in line:
            value, mark = quantity.of(row)
            notes.add(row, f"{method} on {row.mesh}", mark, value)
    missing = [method for method in COMPARED if method not in lines]
    texts = [quantity.caption(used, rows) + " n^p: power law fitted over a method's "
             "completed cases, three or more. Points that would cover each other stand side by "
             "side.", *notes.lines()]
    if missing:
        texts.append("no rows: " + ", ".join(missing))
    footer = Footer(used, quantity, texts, scale)
    figure = Figure(figsize=(parts.WIDTH, TOP + HEIGHT + BOTTOM + footer.height))
    axes = axes_at(figure, LEFT, TOP, parts.WIDTH - LEFT - RIGHT, HEIGHT)
    set_scales(axes, used, quantity)
    mark_meshes(axes, used)
    places = side_by_side(axes, used, quantity)
    ends = {method: draw_line(axes, method, line, quantity, scale, places)
            for method, line in lines.items()}
    fits = {method: fit(line, quantity) for method, line in lines.items()}
    draw_labels(axes, ends, fits)
    footer.draw(figure)
    return figure, used


def fit(line: list[Row], quantity: Quantity) -> float | None:
    done = [(row.n_phi, value) for row in line for value, mark in [quantity.of(row)]
            if mark == "done"]
    return exponent([n for n, _ in done], [value for _, value in done])


def set_scales(axes: Axes, rows: list[Row], quantity: Quantity) -> None:
    values = [value for row in rows for value, mark in [quantity.of(row)] if mark != "none"]
    axes.set(xscale="log", yscale="log", xlim=parts.log_limits(list(map(n_of, rows)), 1.25),
             ylim=parts.log_limits(values))
    parts.log_axis(axes.xaxis)
    parts.log_axis(axes.yaxis)
    axes.set_ylabel(quantity.axis)
    axes.yaxis.set_label_coords(-0.44 / (parts.WIDTH - LEFT - RIGHT), 0.5)
    axes.set_xlabel(r"$n_\varphi$", fontsize=parts.MATH, labelpad=2)
    axes.grid(axis="y")
    axes.spines[["right"]].set_visible(False)


def mark_meshes(axes: Axes, rows: list[Row]) -> None:
    """Names on the upper edge, and a gap between tooth and rack."""
    sizes = {row.mesh: n_of(row) for row in sorted(rows, key=n_of)}
    for mesh, n_phi in sizes.items():
        axes.axvline(n_phi, color="0.88", linewidth=0.4, zorder=0)
    top = axes.secondary_xaxis("top")
    top.set_ticks(list(sizes.values()), list(sizes), rotation=45, ha="left",
                  rotation_mode="anchor", minor=False)
    top.minorticks_off()
    top.tick_params(length=2.5, pad=1)
    ends = [[n for mesh, n in sizes.items() if SIZES[mesh].teeth == teeth] for teeth in BODIES]
    if all(ends):
        border = math.sqrt(max(ends[0]) * min(ends[1]))
        axes.axvline(border, color="0.45", linewidth=0.6, linestyle=(0, (1, 2)), zorder=0)
    for words, sizes_there in zip(BODIES.values(), ends):
        if sizes_there:
            centre = math.sqrt(min(sizes_there) * max(sizes_there))
            axes.annotate(words, (centre, 1), xycoords=axes.get_xaxis_transform(),
                          xytext=(0, 33), textcoords="offset points", ha="center", color="0.25")


def side_by_side(axes: Axes, rows: list[Row], quantity: Quantity) -> dict[int, float]:
    """Row's line -> x of its point, moved off n_phi where points would cover each other."""
    size_pt = 72 * np.array([parts.WIDTH - LEFT - RIGHT, HEIGHT])
    to_pt = axes.transData + axes.transAxes.inverted()
    taken: list[np.ndarray] = []
    places = {}
    for row in sorted(rows, key=lambda row: COMPARED.index(compared(row.method))):
        value, mark = quantity.of(row)
        if mark == "none":
            continue
        x, y = to_pt.transform((n_of(row), value or 1))
        point = np.array([x, EDGE_AT if value is None else y]) * size_pt
        tried = (point + [shift * BESIDE_PT, 0] for k in range(99) for shift in (k, -k))
        point = next(p for p in tried if all(max(abs(p - q)) > 0.99 * BESIDE_PT for q in taken))
        taken.append(point)
        places[row.line] = to_pt.inverted().transform(point / size_pt)[0]
    return places


def draw_line(axes: Axes, method: str, line: list[Row], quantity: Quantity, scale: ErrorScale,
              places: dict[int, float]) -> tuple[float, float] | None:
    """Its last point that has a value."""
    marker, dashes = STYLES[method]
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
        if end is not None and SIZES[row.mesh].teeth == SIZES[following.mesh].teeth:
            axes.plot([x, places[following.line]], [value, end], color=LINE_COLOR,
                      linestyle=dashes, linewidth=0.8, zorder=2)
    return last


def draw_labels(axes: Axes, ends: dict[str, tuple[float, float] | None],
                fits: dict[str, float | None]) -> None:
    """Name and exponent beside the last points, in their order."""
    def fraction(point: tuple[float, float] | None) -> tuple[float, float]:
        return tuple(axes.transAxes.inverted().transform(axes.transData.transform(point))) \
            if point else (1, 1.0)

    height_pt = HEIGHT * 72
    at = {method: fraction(end) for method, end in ends.items()}
    order = sorted(at, key=lambda method: at[method][1])
    places = spread([at[method][1] for method in order], LABEL_PT / height_pt, 0.01, 0.99)
    inch = 1 / (parts.WIDTH - LEFT - RIGHT)  # of the axes' width
    for method, y in zip(order, places):
        marker, dashes = STYLES[method]
        style = dict(transform=axes.transAxes, clip_on=False)
        if ends[method]:
            axes.plot([at[method][0], 1 + 0.12 * inch], [at[method][1], y], **style,
                      color="0.6", linewidth=0.4, zorder=1)
        axes.plot([1 + 0.14 * inch, 1 + 0.46 * inch], [y, y], **style, color=LINE_COLOR,
                  linestyle=dashes, linewidth=0.8)
        axes.plot(1 + 0.3 * inch, y, **style, **parts.marker_style(marker, "white"))
        axes.text(1 + 0.52 * inch, y, method, va="center", **style)
        if fits[method] is not None:
            axes.text(1 + 1.21 * inch, y, rf"$n^{{{fits[method]:.2f}}}$", va="center",
                      fontsize=parts.MATH, **style)
