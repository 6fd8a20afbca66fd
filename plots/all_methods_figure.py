"""Time, memory and error over n_phi for all methods of a run."""
from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import study_parts as parts
from bodies import sharing_axes
from figure_files import PAGE_WIDTH, Drawing
from figure_parts import MATH, axes_at, log_limits, log_log
from figure_table import CASE, csv_of
from figure_words import merged, plain, width_of
from paper_sizes import BODIES
from record_keys import Row
from selection import by_body, grouped, of_scene
from size_figure import beside, draw_leader, exponent, mark_meshes
from work_precision_figure import value_of

LEFT, TOP, BETWEEN, LOWEST, BOTTOM = 0.72, 1.15, 0.12, 2.5, 0.5  # inches; LOWEST: a panel
PANELS = {"time_s": "time of one solve, s", "peak_heap_bytes": "peak heap, MiB",
          "error_force": "error of the contact forces, 1"}
LABEL_PT = 13  # between names
POWER, DASHED = 0.6, 0.36  # inches, for an exponent and a piece of line


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    ordinary = [row for row in rows if not row.study]
    own = of_scene([row for row in ordinary if row.stop == "target"] or ordinary)
    if own:
        yield Drawing("all_methods", own, draw, table_of)


def table_of(rows: list[Row]) -> str:
    """Of the methods that have a line, and the exponents of their lines."""
    lines = [line for own in sharing_axes(rows) for line in lines_of(own).values()]
    powers = {(row.line, column): power(line, column)
              for line in lines for row in line for column in PANELS}
    return csv_of([row for line in lines for row in line], *CASE, *PANELS,
                  *((f"exponent_of_{column}", lambda row, column=column: powers[row.line, column])
                    for column in PANELS))


def power(line: list[Row], column: str) -> float | None:
    """Over n_phi, of a line's positive values."""
    known = [(row.n_phi, value) for row in line if (value := value_of(row, column))]
    return exponent([n for n, _ in known], [value for _, value in known])


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
    panel = max(LOWEST, max(map(len, blocks)) * LABEL_PT / 72 + 0.2)
    block = TOP + len(PANELS) * (panel + BETWEEN) + BOTTOM
    figure = parts.sheet(PAGE_WIDTH, len(blocks) * block,
                         "All methods over the number of unknowns", [
        f"Scene {rows[0].scene}, {parts.threads(rows)}"
        f"{', with the paper’s stops' if rows[0].stop == 'paper' else ''}. n^p: power law by least "
        f"squares of logarithms over all sizes of a method, three or more. Lines are interrupted "
        f"between {between}. Errors of 0 are at the lower edge.",
        f"No point: {words}." if words else ""])
    height = figure.get_size_inches()[1]
    names = max(width_of(method, parts.TYPE) / 72 for lines in blocks for method in lines)
    width = PAGE_WIDTH - LEFT - 0.35 - names - POWER
    for k, lines in enumerate(blocks):
        if len(blocks) > 1:
            bodies = by_body([row for line in lines.values() for row in line])
            figure.text(parts.MARGIN / PAGE_WIDTH, 1 - (k * block + 0.35) / height, va="top",
                        s=plain(", ".join(bodies)), fontsize=10, weight="bold")
        for j, column in enumerate(PANELS):
            axes = axes_at(figure, LEFT, k * block + TOP + j * (panel + BETWEEN), width, panel)
            draw_panel(axes, column, lines)
            if j == 0:
                mark_meshes(axes, {row.mesh: row.n_phi for line in lines.values() for row in line},
                            55, 7.5)
            if j < len(PANELS) - 1:
                axes.tick_params(labelbottom=False)
            else:
                axes.set_xlabel(r"degrees of freedom $n_\varphi$, 1", fontsize=MATH)
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
    axes.grid(which="major")
    for line in known.values():
        look = line[0].look
        for _, piece in groupby(line, key=lambda row: row.body):
            piece = list(piece)
            axes.plot([row.n_phi for row in piece], [shown(row) for row in piece],
                      color=look.colour, marker=look.marker, markersize=5, linewidth=1.2,
                      linestyle=look.dashes, markeredgecolor="white", markeredgewidth=0.3)
    draw_names(axes, {method: (line[-1].n_phi, shown(line[-1])) for method, line in known.items()},
               {method: line[0].look.colour for method, line in known.items()},
               {method: power(line, column) for method, line in known.items()})


def draw_names(axes: Axes, ends: dict[str, tuple[float, float]], colours: dict[str, str],
               powers: dict[str, float | None], dashes: dict[str, object] | None = None) -> None:
    """Name and exponent beside the last points, in their order; with dashes also a piece of line."""
    inch = 1 / (axes.get_position().width * PAGE_WIDTH)
    for method, at, y in beside(axes, ends, LABEL_PT):
        style = dict(transform=axes.transAxes, va="center", color=colours[method])
        draw_leader(axes, at, 1 + 0.22 * inch, y, color=colours[method], alpha=0.6)
        name_at = 1 + 0.26 * inch
        if dashes:
            axes.plot([name_at, name_at + DASHED * inch], [y, y], transform=axes.transAxes,
                      clip_on=False, color=colours[method], linestyle=dashes[method], linewidth=1.4)
            name_at += (DASHED + 0.06) * inch
        axes.text(name_at, y, plain(method), fontsize=parts.TYPE, **style)
        if powers[method] is not None:
            axes.text((PAGE_WIDTH - LEFT - 0.05) * inch, y, f"$n^{{{powers[method]:.2f}}}$",
                      ha="right", fontsize=MATH, **style)
