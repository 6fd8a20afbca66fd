"""Residual over the iterations of iterative methods, of runs with --fields=histories."""
from collections.abc import Iterator

from drawing import Drawing, Sheet, keys, log_axis, log_limits
from records import Row
from selection import compared, grouped, of_scene
from words import CASE, columns_of, csv_of, plain

ROOM, PANELS, FEW = 10, 4, 30  # methods, panels, points that have room for markers


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    """Of the largest mesh, a panel for each name that methods give their residuals."""
    known = of_scene([row for row in rows if row.histories])
    if by_name(known):
        largest = max((row for own in by_name(known).values() for row, _ in own), key=lambda row: row.n_phi)
        yield Drawing("histories", compared([row for row in known if (row.mesh, row.stop, row.knob) == (
            largest.mesh, largest.stop, largest.knob)], ROOM), draw, table_of)


def by_name(rows: list[Row]) -> dict[str, list[tuple[Row, list[float]]]]:
    return {name: [(row, values) for row, _, values in own] for name, own in grouped(
        [(row, name, values) for row in rows for name, values in row.histories.items() if len(list(filter(None, values))) > 1],
        lambda item: item[1]).items()}


def table_of(rows: list[Row]) -> str:
    steps = [(row, name, k, value) for name, own in by_name(rows).items() for row, values in own
             for k, value in enumerate(values)]
    return csv_of(steps, *columns_of(lambda step: step[0], *CASE), ("history", lambda step: step[1]),
                  ("iteration", lambda step: step[2]), ("residual", lambda step: step[3]))


def draw(rows: list[Row], width: float) -> Sheet:
    histories = dict(list(by_name(rows).items())[:PANELS])
    sheet = Sheet(width, f"Residuals over iterations: {rows[0].mesh}",
                  f"Scene {rows[0].scene}, {rows[0].n_phi} unknowns. The residual that a method computes in each "
                  "iteration, relative as the method defines it, from the run that was recorded in detail. Residuals "
                  "of 0, or not known, are not drawn.", panels=len(histories), key=keys(rows))
    for axes, (name, own) in zip(sheet.panels, histories.items()):
        for row, values in own:
            axes.plot(range(len(values)), [value or float("nan") for value in values],
                      **row.look.line() | dict(marker=row.look.marker if len(values) < FEW else None))
        axes.set(yscale="log", xlabel="iteration", ylabel="residual", title=plain(name), ylim=log_limits(
            [value for _, values in own for value in values if value], 1.5))
        log_axis(axes.yaxis)
        axes.xaxis.get_major_locator().set_params(integer=True)
    return sheet
