"""Time, memory, iterations and error over many decades of size, of meshes refined in memory."""
from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import study_parts as parts
from direct_labels import Labels
from figure_files import PAGE_WIDTH, Drawing
from figure_parts import axes_at, log_limits, log_log
from figure_table import CASE, csv_of
from figure_words import merged
from record_keys import Row
from selection import by_body, grouped, kind_of, of_scene
from size_figure import exponent

LEFT, TOP, BOTTOM, HEIGHT, GAP, BETWEEN = 0.68, 0.4, 0.42, 2.6, 0.62, 0.5  # inches
ASYMPTOTIC = 200_000  # unknowns, from which on exponents are fitted


def memory_of(row: Row) -> float | None:
    """Another's program has its memory outside our heap."""
    return row.peak_rss_bytes if row.program else row.peak_heap_bytes


def error_of(row: Row) -> float | None:
    """Against the reference where there is one; else by the method's own word."""
    return row.error_estimate if row.error_stress is None else row.error_stress


@dataclass(frozen=True)
class Panel:
    name: str
    axis: str
    of: Callable[[Row], float | None]
    grows: bool = True  # an exponent says how


PANELS = (Panel("time_s", "time of one solve, s", lambda row: row.time_s),
          Panel("memory_bytes", "memory, GiB", memory_of),
          Panel("linear_iterations", "iterations of linear solves, 1",
                lambda row: row.linear_iterations, grows=False),
          Panel("error", "error of the stresses, 1", error_of, grows=False))


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    own = of_scene([row for row in rows if not row.study and row.stop == "target"
                    and kind_of(row) != "adapted"])
    bodies = [shown for shown in by_body(own).values()
              if any(kind_of(row) == "refined everywhere" for row in shown)]
    if bodies:
        yield Drawing("growth", max(bodies, key=lambda shown: max(row.n_phi for row in shown)),
                      draw, table_of)


def lines_of(rows: list[Row]) -> dict[str, list[Row]]:
    """Method -> its completed rows by size."""
    done = sorted((row for row in rows if row.completed),
                  key=lambda row: (parts.order(row), row.n_phi))
    return grouped(done, lambda row: row.method)


def power(line: list[Row], panel: Panel) -> float | None:
    """Over n_phi, from ASYMPTOTIC on."""
    late = [(row.n_phi, value) for row in line if row.n_phi >= ASYMPTOTIC and (value := panel.of(row))]
    return None if not panel.grows else exponent([n for n, _ in late], [value for _, value in late], least=2)


def table_of(rows: list[Row]) -> str:
    lines = lines_of(rows)
    powers = {(row.line, panel.name): power(line, panel)
              for line in lines.values() for row in line for panel in PANELS}
    return csv_of([row for line in lines.values() for row in line], *CASE, "threads",
                  *((panel.name, panel.of) for panel in PANELS),
                  ("error_is_estimated", lambda row: row.error_stress is None),
                  *((f"exponent_of_{panel.name}", lambda row, panel=panel: powers[row.line, panel.name])
                    for panel in PANELS if panel.grows))


def draw(rows: list[Row]) -> Figure | str:
    """The figure, or why there is none."""
    lines = {method: line for method, line in lines_of(rows).items() if len(line) > 1}
    if not lines:
        return "no method has two sizes"
    failed = grouped([row for row in rows if not row.completed], Row.status_words)
    words = "; ".join(f"{merged([f'{row.method} on {row.mesh}' for row in own])} ({why})"
                      for why, own in failed.items())
    panel = (PAGE_WIDTH - LEFT - 0.12 - GAP) / 2
    figure = parts.sheet(PAGE_WIDTH, TOP + 2 * HEIGHT + BETWEEN + BOTTOM,
                         "From a thousand unknowns to millions", [
        f"Scene {rows[0].scene}, {parts.threads(rows)}; one body, its mesh refined in memory. "
        "Memory: peak heap of one solve; of other programs the resident memory of all their "
        "processes. Errors: against the reference (filled), beyond its limit of size by the method’s "
        "own estimate (open), displacements’ at every size. Iterations: of the linear solves of all active sets together; direct "
        f"methods have none. n^p: least squares of logarithms from n = {ASYMPTOTIC} on.",
        f"No point: {words}." if words else ""])
    sizes = [row.n_phi for line in lines.values() for row in line]
    for k, what in enumerate(PANELS):
        axes = axes_at(figure, LEFT + k % 2 * (panel + GAP), TOP + k // 2 * (HEIGHT + BETWEEN), panel,
                       HEIGHT)
        draw_panel(axes, what, lines, (min(sizes) / 1.3, 1.5 * max(sizes)))
    return figure


def draw_panel(axes: Axes, panel: Panel, lines: dict[str, list[Row]],
               xlim: tuple[float, float]) -> None:
    scale = 2**30 if panel.name == "memory_bytes" else 1
    known = {method: [(row, panel.of(row) / scale) for row in line if panel.of(row)]
             for method, line in lines.items()}
    known = {method: line for method, line in known.items() if line}
    log_log(axes, xlim=xlim, ylabel=panel.axis, xlabel=r"degrees of freedom $n_\varphi$, 1",
            ylim=log_limits([value for line in known.values() for _, value in line]))
    axes.grid(which="major")
    axes.spines[["top", "right"]].set_visible(False)
    labels, curves = Labels(axes), []
    for method, line in known.items():
        curve = [row.n_phi for row, _ in line], [value for _, value in line]
        look = line[0][0].look
        axes.plot(*curve, color=look.colour, linewidth=1.2, linestyle=look.dashes)
        for row, value in line:
            open_one = panel.name == "error" and row.error_stress is None
            axes.plot(row.n_phi, value, color=look.colour, marker=look.marker, markersize=5,
                      markerfacecolor="white" if open_one else look.colour)
        labels.avoid(*curve)
        curves.append((method, curve, look.colour))
    for method, (n, values), colour in curves:
        p = power(lines[method], panel)
        words = method + (f": $n^{{{p:.2f}}}$" if p is not None else "")
        labels.add(words, n[::-1], values[::-1], formula=p is not None, color=colour, weight="bold")
