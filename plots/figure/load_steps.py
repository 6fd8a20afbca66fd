"""Time along a path of loads over the number of its steps: what a body costs once and each step."""
from collections.abc import Iterator

from drawing import Drawing, Sheet, keys, log_limits, log_log
from records import Row
from selection import by_mesh, by_method, by_stop, line_of, of_kind, with_suffix
from words import at_stop, csv_of, plain, threads, unseen

COLUMNS = ("mesh", "method", "load_steps", "status", "time_s", "time_once_s", "time_per_load_s")
MESHES = 2  # that there is room for


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = [row for row in of_kind(rows, "load_steps") if row.load_steps]
    for stop, run in by_stop(study).items():
        shown = [row for own in list(by_mesh(run).values())[:MESHES] for row in own]
        if len(shown) > 1:
            yield Drawing(with_suffix("load_steps", stop), shown, draw, table_of, dict(run=run))


def table_of(rows: list[Row]) -> str:
    return csv_of([row for own in by_mesh(rows).values()
                   for line in by_method(own, "load_steps").values() for row in line], *COLUMNS)


def draw(rows: list[Row], width: float, run: list[Row]) -> Sheet | str:
    timed = [row for row in rows if row.completed and row.time_s]
    if not timed:
        return "no case of the study of load steps has a time"
    meshes = by_mesh(timed)
    sheet = Sheet(
        width, f"Load steps{at_stop(rows)}",
        "Time of a whole path to the same loads, over the number of its steps. Where a line is level, the "
        "time is what a body costs once, its condensation. Where it rises in proportion, it is what each "
        f"step costs: contact law, recovery and check, or a whole solve. {threads(rows)}.",
        *unseen(run, rows, lambda row: "only on other meshes"), panels=len(meshes), height=3.2, key=keys(timed))
    for axes, (mesh, own) in zip(sheet.panels, meshes.items()):
        log_log(axes, xlim=log_limits([row.load_steps for row in timed], 1.4),
                ylim=log_limits([row.time_s for row in timed], 1.6), xlabel="load steps", ylabel="time, s")
        axes.set_title(plain(mesh))
        for line in by_method(own, "load_steps").values():
            axes.plot(*line_of(line, "load_steps", "time_s"), **line[0].look.line())
    return sheet
