"""Time along a path of loads over the number of its steps: what a body costs once and each step."""
from collections.abc import Iterator

from matplotlib.figure import Figure

from drawing import Drawing, log_limits, log_log, sheet, side_by_side
from labels import Labels
from records import Row
from selection import by_mesh, by_method, by_stop, line_of, with_suffix
from words import at_stop, csv_of, threads, unseen

LEFT, TOP, BOTTOM, HEIGHT, GAP = 0.62, 0.55, 0.45, 3.6, 0.15  # inches
COLUMNS = ("mesh", "method", "load_steps", "status", "time_s", "time_once_s", "time_per_load_s")
MESHES = 2  # that there is room for


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = [row for row in rows if row.study == "load-steps" and row.load_steps]
    for stop, run in by_stop(study).items():
        shown = [row for own in list(by_mesh(run).values())[:MESHES] for row in own]
        yield Drawing(with_suffix("load_steps", stop), shown, draw, table_of, vector=True,
                      options=dict(run=run))


def table_of(rows: list[Row]) -> str:
    return csv_of([row for own in by_mesh(rows).values()
                   for line in by_method(own, "load_steps").values() for row in line], *COLUMNS)


def draw(rows: list[Row], run: list[Row]) -> Figure | str:
    timed = [row for row in rows if row.completed and row.time_s]
    if not timed:
        return "no case of the study of load steps has a time"
    figure = sheet(
        TOP + HEIGHT + BOTTOM, f"Load steps{at_stop(rows)}",
        "Time of a whole path to the same loads, over the number of its steps. Where a line is level, the "
        "time is what a body costs once, its condensation. Where it rises in proportion, it is what each "
        "step costs: contact law, recovery and check, or a whole solve. "
        f"{threads(rows)}.", *unseen(run, rows, lambda row: "only on other meshes"))
    meshes = by_mesh(timed)
    panels = side_by_side(figure, meshes, LEFT, TOP, HEIGHT, GAP)
    for axes, own in zip(panels, meshes.values()):
        log_log(axes, xlim=log_limits([row.load_steps for row in timed], 1.4),
                ylim=log_limits([row.time_s for row in timed], 1.6), xlabel="load steps",
                ylabel="time, s" if axes is panels[0] else "")
        labels = Labels(axes)
        for method, line in by_method(own, "load_steps").items():
            look = line[0].look
            labels.line(method, *line_of(line, "load_steps", "time_s"), look.colour,
                        marker=look.marker, markersize=5, linewidth=1.2)
        labels.name_lines(weight="bold")
    return figure
