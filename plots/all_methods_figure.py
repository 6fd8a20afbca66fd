"""Time, memory and error over n_phi for all methods of a run."""
from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import study_parts as parts
from bodies import sharing_axes
from figure_files import Drawing
from figure_parts import MATH, axes_at, log_limits, log_log
from figure_words import merged, plain
from paper_sizes import BODIES
from record_keys import Row
from selection import by_body, grouped, of_scene
from size_figure import beside, exponent, mark_meshes
from work_precision_figure import value_of

LEFT, TOP, PANEL, NAMES, HEIGHT, BOTTOM = 0.72, 1.3, 2.8, 2.0, 4.6, 0.5
BLOCK = TOP + HEIGHT + BOTTOM
PANELS = {"time_s": "time of one solve, s", "peak_heap_bytes": "peak heap, MiB",
          "error_force": "relative error of the contact forces, 1"}
WIDTH = len(PANELS) * (LEFT + PANEL + NAMES)
LABEL_PT = 11.5  # between names


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    ordinary = [row for row in rows if not row.study]
    own = of_scene([row for row in ordinary if row.stop == "target"] or ordinary)
    if own:
        yield Drawing("all_methods", own, draw)


def lines_of(rows: list[Row]) -> dict[str, list[Row]]:
    """Method -> its completed rows by size, where there are two sizes or more."""
    done = sorted((row for row in rows if row.completed),
                  key=lambda row: (parts.order(row), row.n_phi))
    return {method: line for method, line in grouped(done, lambda row: row.method).items()
            if len({row.n_phi for row in line}) > 1}


def draw(rows: list[Row]) -> Figure | str:
    """rows: of an ordinary run's scene and stop. The figure, or why there is none."""
    blocks = [lines for own in sharing_axes(rows) if (lines := lines_of(own))]
    if not blocks:
        return "no method has two sizes"
    failed = grouped([row for row in rows if not row.completed], Row.status_words)
    words = "; ".join(f"{merged([f'{row.method} on {row.mesh}' for row in own])} ({why})"
                      for why, own in failed.items())
    drawn = [row for lines in blocks for line in lines.values() for row in line]
    between = "one tooth and the rack" if {row.body for row in drawn} == set(BODIES.values()) \
        else "bodies"
    figure = parts.sheet(WIDTH, len(blocks) * BLOCK,
                         "All methods over the number of unknowns", [
        f"Scene {rows[0].scene}, {parts.threads(rows)}"
        f"{', with the paper’s stops' if rows[0].stop == 'paper' else ''}. n^p: power law by least "
        f"squares of logarithms over all sizes of a method, three or more. Lines are interrupted "
        f"between {between}. Errors of 0 are at the lower edge.",
        f"No point: {words}." if words else ""])
    height = figure.get_size_inches()[1]
    for k, lines in enumerate(blocks):
        if len(blocks) > 1:
            bodies = by_body([row for line in lines.values() for row in line])
            figure.text(parts.MARGIN / WIDTH, 1 - (k * BLOCK + 0.35) / height, va="top",
                        s=plain(", ".join(bodies)), fontsize=10, weight="bold")
        for j, column in enumerate(PANELS):
            axes = axes_at(figure, j * (LEFT + PANEL + NAMES) + LEFT, k * BLOCK + TOP, PANEL,
                           HEIGHT)
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
    log_log(axes, ylabel=PANELS[column],
            ylim=log_limits([shown(row) for row in rows]),
            xlim=(min(sizes) / 1.3, 1.3 * max(sizes)))
    axes.set_xlabel(r"degrees of freedom $n_\varphi$, 1")
    axes.grid(which="major")
    mark_meshes(axes, {row.mesh: row.n_phi for line in lines.values() for row in line}, 55, 7)
    for line in known.values():
        look = line[0].look
        for _, piece in groupby(line, key=lambda row: row.body):
            piece = list(piece)
            axes.plot([row.n_phi for row in piece], [shown(row) for row in piece],
                      color=look.colour, marker=look.marker, markersize=4.5, linewidth=1,
                      linestyle=look.dashes, markeredgecolor="white", markeredgewidth=0.3)
    draw_names(axes, {method: (line[-1].n_phi, shown(line[-1])) for method, line in known.items()},
               {method: line[0].look.colour for method, line in known.items()},
               {method: exponent([row.n_phi for row in line], [shown(row) for row in line])
                for method, line in known.items()})


def draw_names(axes: Axes, ends: dict[str, tuple[float, float]], colours: dict[str, str],
               powers: dict[str, float | None]) -> None:
    """Name and exponent beside the last points, in their order."""
    for method, at, y in beside(axes, ends, LABEL_PT):
        colour = colours[method]
        axes.plot([at[0], 1.03], [at[1], y], transform=axes.transAxes, clip_on=False,
                  color=colour, linewidth=0.4, alpha=0.6, zorder=1)
        power = "" if powers[method] is None else rf": $n^{{{powers[method]:.2f}}}$"
        axes.text(1.04, y, plain(method) + power, transform=axes.transAxes, va="center",
                  color=colour, fontsize=MATH - 2)
