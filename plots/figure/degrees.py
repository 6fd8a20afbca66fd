"""Total error against time, a line per method and degree, on several bodies."""
import math
from collections.abc import Iterator

from matplotlib.figure import Figure

from drawing import PAGE_WIDTH, Drawing, log_limits, log_log, panel_at, sheet
from figure.adaptive import adapting, draw_over_time, kinds_in, words_of_crosses
from records import Row
from selection import grouped, kind_of
from words import CASE, axis_label, csv_of, left_out, plain, threads

LEFT, TOP, HEIGHT, BETWEEN, GAP = 0.72, 0.62, 2.9, 0.78, 0.6  # inches
PANELS, IN_ROW = 4, 2

Panel = tuple[str, str]  # body and scene


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    run = [row for row in rows if not row.study and row.stop == "target"]
    known = [row for row in run if row.completed and row.error_total and time_of(row) and has_own_mesh(row)]
    degrees = grouped(known, panel_of)
    shown = [panel for panel, own in degrees.items() if len({row.degree for row in own}) > 1][:PANELS]
    if shown:
        yield Drawing("degrees", [row for row in known if panel_of(row) in shown], draw, table_of,
                      options=dict(run=run))


def why(row: Row) -> str:
    return "no total error" if not row.error_total else \
        "only on other bodies" if has_own_mesh(row) else "on meshes adapted by another degree"


def panel_of(row: Row) -> Panel:
    return row.body, row.scene


def has_own_mesh(row: Row) -> bool:
    """An adapted mesh is of the degree that solved its levels: their time is not another's."""
    of_other_degree = row.method.startswith("HYBRID:k=") or row.method == "HYBRID"
    return kind_of(row) != "adapted" or adapting(row) == row.method or not of_other_degree


def time_of(row: Row) -> float | None:
    """Of an adapted mesh: of the whole loop up to it, and of the method's own solve on another's mesh."""
    if not row.adapt_time_s or not row.time_s:
        return row.time_s
    return row.adapt_time_s + (0 if adapting(row) == row.method else row.time_s)


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, "degree", ("kind_of_mesh", kind_of), ("time_s", time_of), "error_total")


def draw(rows: list[Row], run: list[Row]) -> Figure:
    panels = grouped(rows, panel_of)
    others = [panel for panel in grouped(run, panel_of) if panel not in panels]
    rows_of_panels = math.ceil(len(panels) / IN_ROW)
    figure = sheet(
        TOP + rows_of_panels * (HEIGHT + BETWEEN) - BETWEEN + 0.45, "Total error against time, by degree",
        f"Total error of the stresses, mesh and method together; {threads(rows)}. Meshes: {kinds_in(rows)}. "
        f"{words_of_crosses(rows)}"
        "Time: one solve; on adapted meshes the whole loop, all levels and error estimates. A method that did not "
        "adapt its mesh: that loop plus its own solve.",
        f"Bodies not drawn: {', '.join(map(title_of, others))}." if others else "",
        left_out(run, rows, why))
    errors = log_limits([row.error_total for row in rows], 1.5)
    width = (PAGE_WIDTH - LEFT - 0.15 - GAP) / IN_ROW
    for k, (panel, own) in enumerate(panels.items()):
        axes = panel_at(figure, LEFT + k % IN_ROW * (width + GAP), TOP + k // IN_ROW * (HEIGHT + BETWEEN),
                        width, HEIGHT)
        axes.set_title(plain(title_of(panel)), pad=4)
        log_log(axes, xlim=log_limits(map(time_of, own), 1.5), ylim=errors, xlabel="time, s",
                ylabel="" if k % IN_ROW else axis_label("error_total"))
        draw_over_time(axes, own, time_of).name_lines(weight="bold")
    return figure


def title_of(panel: Panel) -> str:
    body, scene = panel
    return body if scene in ("default", body) else f"{body}, scene {scene}"
