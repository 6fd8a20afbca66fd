"""Time, memory and error over n_phi for all methods of a run."""
from __future__ import annotations

from itertools import groupby

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import study_parts as parts
from figure_parts import MATH, axes_at, log_axis, log_limits
from figure_words import merged, plain
from paper_sizes import body_of
from results_table import Row
from size_figure import exponent, spread
from work_precision_figure import value_of

LEFT, TOP, PANEL, NAMES, HEIGHT, BOTTOM = 0.72, 1.3, 2.8, 2.0, 4.6, 0.5
PANELS = {"time_s": "time of one solve, s", "peak_heap_bytes": "peak heap, MiB",
          "error_force": "relative error of the contact forces, 1"}
WIDTH = len(PANELS) * (LEFT + PANEL + NAMES)
LABEL_PT = 11.5  # between names


def lines_of(rows: list[Row]) -> dict[str, list[Row]]:
    """Method -> its completed rows by size, where there are two sizes or more."""
    lines: dict[str, list[Row]] = {}
    for row in sorted(rows, key=lambda row: (parts.order(row.method), row.n_phi)):
        if row.completed:
            lines.setdefault(row.method, []).append(row)
    return {method: line for method, line in lines.items()
            if len({row.n_phi for row in line}) > 1}


def draw(rows: list[Row]) -> Figure | str:
    """rows: of an ordinary run's scene and stop. The figure, or why there is none."""
    lines = lines_of(rows)
    if not lines:
        return "no method has two sizes"
    failed: dict[str, list[str]] = {}
    for row in rows:
        if not row.completed:
            failed.setdefault(row.status_words(), []).append(f"{row.method} on {row.mesh}")
    words = "; ".join(f"{merged(cases)} ({why})" for why, cases in failed.items())
    some = next(iter(lines.values()))
    figure = parts.sheet(WIDTH, TOP + HEIGHT + BOTTOM, [
        f"Scene {some[0].scene}, {parts.threads(rows)}"
        f"{', with the paper’s stops' if some[0].stop == 'paper' else ''}. n^p: power law by least "
        "squares of logarithms over all sizes of a method, three or more. Lines are interrupted "
        "between one tooth and the rack. Errors of 0 are at the lower edge.",
        f"No point: {words}." if words else ""])
    figure.text(parts.MARGIN / WIDTH, 1 - 0.08 / figure.get_size_inches()[1], va="top",
                s="All methods over the number of unknowns", fontsize=11, weight="bold")
    for k, column in enumerate(PANELS):
        axes = axes_at(figure, k * (LEFT + PANEL + NAMES) + LEFT, TOP, PANEL, HEIGHT)
        draw_panel(axes, column, lines)
    return figure


def draw_panel(axes: Axes, column: str, lines: dict[str, list[Row]]) -> None:
    known = {method: [row for row in line if value_of(row, column) is not None]
             for method, line in lines.items()}
    known = {method: line for method, line in known.items() if line}
    rows = [row for line in known.values() for row in line]
    floor = parts.error_floor(row.error_force for row in rows) if column == "error_force" else 0

    def shown(row: Row) -> float:
        return max(value_of(row, column), floor)

    sizes = [row.n_phi for line in lines.values() for row in line]
    axes.set(xscale="log", yscale="log", ylabel=PANELS[column],
             ylim=log_limits([shown(row) for row in rows]),
             xlim=(min(sizes) / 1.3, 1.3 * max(sizes)))
    log_axis(axes.xaxis)
    log_axis(axes.yaxis)
    axes.set_xlabel(r"degrees of freedom $n_\varphi$, 1")
    axes.grid(which="major")
    axes.spines[["right"]].set_visible(False)
    mark_meshes(axes, {row.mesh: row.n_phi for line in lines.values() for row in line})
    for method, line in known.items():
        colour, marker = parts.style(method)
        for _, piece in groupby(line, key=lambda row: body_of(row.mesh)):
            piece = list(piece)
            axes.plot([row.n_phi for row in piece], [shown(row) for row in piece], color=colour,
                      marker=marker, markersize=4.5, linewidth=1, linestyle=parts.dashes(method),
                      markeredgecolor="white", markeredgewidth=0.3)
    draw_names(axes, {method: (line[-1].n_phi, shown(line[-1])) for method, line in known.items()},
               {method: exponent([row.n_phi for row in line], [shown(row) for row in line])
                for method, line in known.items()})


def mark_meshes(axes: Axes, sizes: dict[str, int]) -> None:
    """Names on the upper edge, apart."""
    names = sorted(sizes, key=sizes.get)
    at = [axes.transAxes.inverted().transform(axes.transData.transform((sizes[name], 1)))[0]
          for name in names]
    for name, x, place in zip(names, at, spread(at, LABEL_PT / (72 * PANEL), 0, 1.05)):
        axes.plot([x, x, place], [1, 1.01, 1.03], transform=axes.transAxes, clip_on=False,
                  color="0.3", linewidth=0.6)
        axes.text(place, 1.035, plain(name), transform=axes.transAxes, rotation=55, ha="left",
                  va="bottom", rotation_mode="anchor", fontsize=7)


def draw_names(axes: Axes, ends: dict[str, tuple[float, float]],
               powers: dict[str, float | None]) -> None:
    """Name and exponent beside the last points, in their order."""
    at = {method: axes.transAxes.inverted().transform(axes.transData.transform(end))
          for method, end in ends.items()}
    order = sorted(at, key=lambda method: at[method][1])
    places = spread([at[method][1] for method in order], LABEL_PT / (72 * HEIGHT), 0.01, 0.99)
    for method, y in zip(order, places):
        colour, _ = parts.style(method)
        axes.plot([at[method][0], 1.03], [at[method][1], y], transform=axes.transAxes,
                  clip_on=False, color=colour, linewidth=0.4, alpha=0.6, zorder=1)
        power = "" if powers[method] is None else rf": $n^{{{powers[method]:.2f}}}$"
        axes.text(1.04, y, method + power, transform=axes.transAxes, va="center", color=colour,
                  fontsize=MATH - 2)
