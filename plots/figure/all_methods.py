"""Time, memory and error over n_phi for all methods of a run."""
from collections.abc import Iterator
from functools import partial
from itertools import groupby

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from catalogue import BODIES
from drawing import (MARGIN, MATH, PAGE_WIDTH, TYPE, Drawing, axes_at, error_floor, log_limits,
                     log_log, sheet, text_at)
from labels import LEFT, NAMES_APART, draw_names, mark_meshes
from records import Row
from selection import by_body, by_method, exponent, of_scene, sharing_axes, value_of
from words import CASE, axis_label, csv_of, lacking, plain, threads, unseen, width_of

TOP, BETWEEN, LOWEST, BOTTOM = 1.15, 0.12, 2.5, 0.5  # inches; LOWEST: a panel
PANELS = {"time_s": "time", "peak_heap_bytes": "peak heap", "error_force": axis_label("error_force")}
POWER = 0.6  # inches, for an exponent


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    ordinary = [row for row in rows if not row.study]
    own = of_scene([row for row in ordinary if row.stop == "target"] or ordinary)
    if own:
        yield Drawing("all_methods", own, draw, table_of)


def table_of(rows: list[Row]) -> str:
    lines = [line for own in sharing_axes(rows) for line in lines_of(own).values()]
    powers = {(row.line, column): power(line, column)
              for line in lines for row in line for column in PANELS}
    return csv_of([row for line in lines for row in line], *CASE, *PANELS,
                  *((f"exponent_of_{column}", lambda row, column=column: powers[row.line, column])
                    for column in PANELS))


def power(line: list[Row], column: str) -> float | None:
    known = [row for row in line if value_of(row, column)]
    return exponent([row.n_phi for row in known], [value_of(row, column) for row in known])


def lines_of(rows: list[Row]) -> dict[str, list[Row]]:
    """Method -> its completed rows by size, where there are two sizes or more."""
    lines = by_method([row for row in rows if row.completed], "n_phi")
    return {method: line for method, line in lines.items()
            if len({row.n_phi for row in line}) > 1}


def draw(rows: list[Row]) -> Figure | str:
    blocks = [lines for own in sharing_axes(rows) if (lines := lines_of(own))]
    if not blocks:
        return "no method has two sizes"
    drawn = [[row for line in lines.values() for row in line] for lines in blocks]
    between = "one tooth and the rack" if {row.body for own in drawn for row in own} == set(
        BODIES.values()) else "bodies"
    panel = max(LOWEST, max(map(len, blocks)) * NAMES_APART / 72 + 0.2)
    block = TOP + len(PANELS) * (panel + BETWEEN) + BOTTOM
    figure = sheet(
        len(blocks) * block, "All methods over the number of unknowns",
        f"Scene {rows[0].scene}, {threads(rows)}"
        f"{', with the paper’s stops' if rows[0].stop == 'paper' else ''}. n^p: power law by least "
        f"squares of logarithms over all sizes of a method, three or more. Lines are interrupted "
        f"between {between}. Errors of 0 are at the lower edge.",
        *unseen(rows, [row for own in drawn for row in own], lambda row: "one size"),
        lacking([row for own in drawn for row in own],
                {name: partial(value_of, key=column) for column, name in PANELS.items()}))
    names = max(width_of(method, TYPE) / 72 for lines in blocks for method in lines)
    for k, (lines, own) in enumerate(zip(blocks, drawn)):
        if len(blocks) > 1:
            text_at(figure, MARGIN, k * block + 0.35, plain(", ".join(by_body(own))), fontsize=10,
                    weight="bold")
        for j, column in enumerate(PANELS):
            axes = axes_at(figure, LEFT, k * block + TOP + j * (panel + BETWEEN),
                           PAGE_WIDTH - LEFT - 0.35 - names - POWER, panel)
            draw_panel(axes, column, lines)
            if j == 0:
                mark_meshes(axes, {row.mesh: row.n_phi for row in own}, 55, 7.5)
            axes.tick_params(labelbottom=j == len(PANELS) - 1)
        axes.set_xlabel(r"degrees of freedom $n_\varphi$", fontsize=MATH)
    return figure


def draw_panel(axes: Axes, column: str, lines: dict[str, list[Row]]) -> None:
    known = {method: own for method, line in lines.items()
             if (own := [row for row in line if value_of(row, column) is not None])}
    rows = [row for line in known.values() for row in line]
    floor = error_floor(row.error_force for row in rows) if column == "error_force" else 0

    def shown(row: Row) -> float:
        return max(value_of(row, column), floor)

    sizes = [row.n_phi for line in lines.values() for row in line]
    log_log(axes, ylabel=axis_label(column), ylim=log_limits(map(shown, rows)),
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
