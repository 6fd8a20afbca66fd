"""Time, memory, iterations and error over many decades of size, of meshes refined in memory."""
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import PAGE_WIDTH, Drawing, log_limits, log_log, panel_at, sheet
from labels import Labels
from records import Row
from selection import by_body, by_method, exponent, kind_of, of_scene
from words import CASE, axis_label, csv_of, lacking, threads, unseen

LEFT, TOP, BOTTOM, HEIGHT, GAP, BETWEEN = 0.68, 0.4, 0.42, 2.6, 0.62, 0.5  # inches
ASYMPTOTIC = 200_000  # unknowns, from which on exponents are fitted


def memory_of(row: Row) -> float | None:
    """The memory of an external program is not in our heap."""
    return row.peak_rss_bytes if row.program else row.peak_heap_bytes


def error_of(row: Row) -> float | None:
    """Against the reference, else the method's own estimate."""
    return row.error_estimate if row.error_stress is None else row.error_stress


@dataclass(frozen=True)
class Panel:
    name: str
    axis: str
    of: Callable[[Row], float | None]
    grows: bool = True  # an exponent says how
    unit: float = 1


PANELS = (Panel("time_s", axis_label("time_s"), lambda row: row.time_s),
          Panel("memory_bytes", "memory, GiB", memory_of, unit=2**30),
          Panel("linear_iterations", "iterations of linear solves",
                lambda row: row.linear_iterations, grows=False),
          Panel("error", axis_label("error_stress"), error_of, grows=False))


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    own = of_scene([row for row in rows if not row.study and row.stop == "target"
                    and kind_of(row) != "adapted"])
    bodies = [shown for shown in by_body(own).values()
              if any(kind_of(row) == "refined everywhere" for row in shown)]
    if bodies:
        yield Drawing("growth", max(bodies, key=lambda shown: max(row.n_phi for row in shown)),
                      draw, table_of)


def lines_of(rows: list[Row]) -> dict[str, list[Row]]:
    return by_method([row for row in rows if row.completed], "n_phi")


def power(line: list[Row], panel: Panel) -> float | None:
    late = [row for row in line if row.n_phi >= ASYMPTOTIC and panel.of(row)]
    return exponent([row.n_phi for row in late], [panel.of(row) for row in late], least=2) \
        if panel.grows else None


def table_of(rows: list[Row]) -> str:
    lines = lines_of(rows)
    return csv_of([row for line in lines.values() for row in line], *CASE, "threads",
                  *((panel.name, panel.of) for panel in PANELS),
                  ("error_is_estimated", lambda row: row.error_stress is None),
                  *((f"exponent_of_{panel.name}",
                     lambda row, panel=panel: power(lines[row.method], panel))
                    for panel in PANELS if panel.grows))


def draw(rows: list[Row]) -> Figure | str:
    lines = {method: line for method, line in lines_of(rows).items() if len(line) > 1}
    if not lines:
        return "no method has two sizes"
    drawn = [row for line in lines.values() for row in line]
    figure = sheet(
        TOP + 2 * HEIGHT + BETWEEN + BOTTOM, "From a thousand unknowns to millions",
        f"Scene {rows[0].scene}, {threads(rows)}; one body, its mesh refined in memory. "
        "Memory: peak heap of one solve; of other programs the resident memory of all their "
        "processes. Errors: against the reference (filled); by the method’s own estimate (open) beyond "
        "the reference’s size limit and for displacements. Iterations: of the linear solves of all "
        "active sets together; direct methods have none. n^p: least squares of logarithms from "
        f"n = {ASYMPTOTIC} on.", *unseen(rows, drawn, lambda row: "one size"),
        lacking(drawn, {"memory": memory_of, "error": error_of}))
    width = (PAGE_WIDTH - LEFT - 0.12 - GAP) / 2
    for k, panel in enumerate(PANELS):
        draw_panel(panel_at(figure, LEFT + k % 2 * (width + GAP),
                            TOP + k // 2 * (HEIGHT + BETWEEN), width, HEIGHT), panel, lines)
    return figure


def draw_panel(axes: Axes, panel: Panel, lines: dict[str, list[Row]]) -> None:
    sizes = [row.n_phi for line in lines.values() for row in line]
    known = {method: own for method, line in lines.items()
             if (own := [row for row in line if panel.of(row)])}
    log_log(axes, xlim=(min(sizes) / 1.3, 1.5 * max(sizes)), ylabel=panel.axis,
            xlabel=r"degrees of freedom $n_\varphi$",
            ylim=log_limits(panel.of(row) / panel.unit for line in known.values() for row in line))
    labels = Labels(axes)
    for method, line in known.items():
        look, p = line[0].look, power(lines[method], panel)
        values = [panel.of(row) / panel.unit for row in line]
        labels.line(method + (f": $n^{{{p:.2f}}}$" if p is not None else ""),
                    [row.n_phi for row in line], values, look.colour, formula=p is not None,
                    linewidth=1.2, linestyle=look.dashes)
        for row, value in zip(line, values):
            estimated = panel.name == "error" and row.error_stress is None
            axes.plot(row.n_phi, value, color=look.colour, marker=look.marker, markersize=5,
                      markerfacecolor="white" if estimated else look.colour)
    labels.name_lines(weight="bold")
