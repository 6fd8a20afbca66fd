"""Total error against time, a line per method and degree, on several bodies."""
import math
from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import PAGE_WIDTH, Drawing, log_limits, log_log, panel_at, sheet
from figure.adaptive import DASHES, kinds_in
from labels import Labels
from records import Row
from selection import grouped, kind_of, order
from words import CASE, csv_of, left_out, plain, threads

LEFT, TOP, HEIGHT, BETWEEN, GAP = 0.72, 0.62, 2.9, 0.78, 0.6  # inches
PANELS, IN_ROW = 4, 2

Panel = tuple[str, str]  # body and scene


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    run = [row for row in rows if not row.study and row.stop == "target"]
    known = [row for row in run if row.completed and row.error_total and time_of(row)]
    degrees = grouped(known, panel_of)
    shown = [panel for panel, own in degrees.items() if len({row.degree for row in own}) > 1][:PANELS]
    if shown:
        yield Drawing("degrees", [row for row in known if panel_of(row) in shown], draw, table_of,
                      options=dict(run=run))


def panel_of(row: Row) -> Panel:
    return row.body, row.scene


def time_of(row: Row) -> float | None:
    """Of an adapted mesh: of the whole loop up to it."""
    return row.adapt_time_s or row.time_s


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, "degree", ("kind_of_mesh", kind_of), ("time_s", time_of), "error_total")


def lines_of(rows: list[Row]) -> dict[tuple[str, str], list[Row]]:
    """Method and kind of mesh -> its cases by time."""
    lines = grouped(sorted(rows, key=order), lambda row: (row.method, kind_of(row)))
    return {name: sorted(line, key=time_of) for name, line in lines.items()}


def draw(rows: list[Row], run: list[Row]) -> Figure:
    panels = grouped(rows, panel_of)
    others = [panel for panel in grouped(run, panel_of) if panel not in panels]
    lines = math.ceil(len(panels) / IN_ROW)
    figure = sheet(
        TOP + lines * HEIGHT + (lines - 1) * BETWEEN + 0.45, "Total error over time, by degree",
        f"Total error of the stresses, mesh and method together, of meshes {kinds_in(rows)}; "
        f"{threads(rows)}. Time of one solve; of adapted meshes the time of the whole loop, all levels and "
        "error estimates.",
        f"Bodies not drawn: {', '.join(map(title_of, others))}." if others else "",
        left_out(run, rows, lambda row: "no total error" if not row.error_total else "only on other bodies"))
    errors = log_limits([row.error_total for row in rows], 1.5)
    width = (PAGE_WIDTH - LEFT - 0.15 - GAP) / IN_ROW
    for k, (panel, own) in enumerate(panels.items()):
        axes = panel_at(figure, LEFT + k % IN_ROW * (width + GAP), TOP + k // IN_ROW * (HEIGHT + BETWEEN),
                        width, HEIGHT)
        axes.set_title(plain(title_of(panel)), pad=4)
        log_log(axes, xlim=log_limits(map(time_of, own), 1.5), ylim=errors, xlabel="time, s",
                ylabel="" if k % IN_ROW else "total error of the stresses")
        draw_lines(axes, own)
    return figure


def title_of(panel: Panel) -> str:
    body, scene = panel
    return body if scene in ("default", body) else f"{body}, scene {scene}"


def draw_lines(axes: Axes, rows: list[Row]) -> None:
    labels = Labels(axes)
    higher = {row.family for row in rows if row.degree > 1}
    named: set[str] = set()
    for (method, kind), line in sorted(lines_of(rows).items(), key=lambda item: item[0][1] != "adapted"):
        look, filled = line[0].look, kind == "adapted"
        words = line[0].label + ", degree 1" * (line[0].degree == 1 and line[0].family in higher)
        labels.line("" if method in named else words, list(map(time_of, line)),
                    [row.error_total for row in line], look.colour, linestyle=DASHES[kind], linewidth=1.4,
                    marker=look.marker, markersize=4.5,
                    markerfacecolor=look.colour if filled else "white")
        named.add(method)
    labels.name_lines(weight="bold")
