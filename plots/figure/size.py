"""Time, memory, error and iterations over the number of unknowns, of all methods of a run."""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import groupby

from matplotlib.axes import Axes

from drawing import CROSS, Drawing, Sheet, error_floor, keys, log_limits, log_log
from records import Row
from selection import by_body, by_method, by_stop, compared, exponent, kind_of, of_scene, sharing_axes, value_of, with_suffix
from words import (CASE, EXTRAPOLATED, at_stop, axis_label, csv_of, lacking, left_out, no_point, plain, threads,
                   time_caption)

ROOM = 12  # methods
ASYMPTOTIC = 200_000  # unknowns: where three sizes are as large, exponents are those of the large ones


@dataclass(frozen=True)
class Quantity:
    name: str
    axis: str
    of: Callable[[Row], float | None]
    grows: bool = False  # as a power of the unknowns


def time_of(row: Row) -> float | None:
    return row.time_s if row.completed else row.extrapolated_time_s if row.status == "timeout" else None


def memory_of(row: Row) -> float | None:
    """MiB; the memory of another program is not in our heap."""
    return value_of(row, "peak_rss_bytes" if row.program else "peak_heap_bytes") if row.completed else None


QUANTITIES = (Quantity("time_s", axis_label("time_s"), time_of, True),
              Quantity("memory_MiB", axis_label("peak_heap_bytes"), memory_of, True),
              Quantity("error_force", axis_label("error_force"),
                       lambda row: row.error_force if row.completed else None),
              Quantity("linear_iterations", axis_label("linear_iterations"),
                       lambda row: (row.linear_iterations or None) if row.completed else None))


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    for stop, run in by_stop(of_scene([row for row in rows if not row.study and kind_of(row) != "adapted"])).items():
        if any(len({row.n_phi for row in line}) > 1 for line in lines_of(run).values()):
            yield Drawing(with_suffix("size", stop), compared(run, ROOM), draw, table_of, dict(run=run))


def lines_of(rows: list[Row]) -> dict[str, list[Row]]:
    return by_method([row for row in rows if row.n_phi and time_of(row)], "n_phi")


def power(line: list[Row], quantity: Quantity) -> float | None:
    done = [row for row in line if row.completed and quantity.of(row)]
    late = [row for row in done if row.n_phi >= ASYMPTOTIC]
    fitted = late if len(late) > 2 else done
    return exponent([row.n_phi for row in fitted], [quantity.of(row) for row in fitted]) if quantity.grows else None


def table_of(rows: list[Row]) -> str:
    lines = lines_of(rows)
    return csv_of([row for line in lines.values() for row in line], *CASE, "threads",
                  *((quantity.name, quantity.of) for quantity in QUANTITIES), *EXTRAPOLATED,
                  *((f"exponent_of_{quantity.name}", lambda row, quantity=quantity: power(lines[row.method], quantity))
                    for quantity in QUANTITIES if quantity.grows))


def draw(rows: list[Row], width: float, run: list[Row]) -> Sheet | str:
    lines = lines_of(rows)
    if not lines:
        return f"none of its {len(rows)} cases has a time"
    shown = [row for line in lines.values() for row in line]
    quantities = [quantity for quantity in QUANTITIES if any(map(quantity.of, shown))]

    def name(row: Row) -> str:
        powers = [f"{p:.2f}" for quantity in QUANTITIES if (p := power(lines[row.method], quantity)) is not None]
        return plain(row.label) + (f"  $n^{{{', '.join(powers)}}}$" if powers else "")
    sizes = dict(sorted({row.mesh: row.n_phi for row in shown}.items(), key=lambda size: size[1]))
    groups = sharing_axes(shown)
    sheet = Sheet(
        width, f"Time, memory and error over the number of unknowns{at_stop(rows)}", time_caption(rows, run),
        "Memory: highest heap during one solve, its blocks and result included; of other programs the resident "
        "memory of all their processes. Iterations: of the linear solves of all active sets together; direct methods "
        "have none. Error: against the reference; errors of 0 are at the lower edge. Open: time limit reached, time "
        "extrapolated. Crossed: inaccurate. n^p behind a name: power law of its time and of its memory, by least "
        "squares of logarithms over its completed cases, three or more; where three of them have "
        f"{ASYMPTOTIC} unknowns or more, over these. Lines are interrupted between bodies. {threads(rows)}.",
        "Unknowns: " + ", ".join(f"{mesh} {n_phi}" for mesh, n_phi in sizes.items()) + ".",
        "Bodies, one above the other: " + "; ".join(", ".join(by_body(own)) for own in groups) + "."
        if len(groups) > 1 else "",
        no_point([row for row in rows if not time_of(row)]), left_out(run, rows, lambda row: "no room"),
        lacking(shown, {quantity.axis.split(",")[0]: quantity.of for quantity in quantities}),
        panels=len(groups) * len(quantities), in_row=2 if len(quantities) != 3 else 3,
        height=2.9, key=keys(shown, name))
    panels = iter(sheet.panels)
    for own in groups:
        for quantity in quantities:
            draw_panel(next(panels), quantity, lines_of(own))
    return sheet


def draw_panel(axes: Axes, quantity: Quantity, lines: dict[str, list[Row]]) -> None:
    known = [[row for row in line if quantity.of(row) is not None] for line in lines.values()]
    rows = [row for line in known for row in line]
    floor = error_floor(map(quantity.of, rows)) if quantity.name == "error_force" else 0

    def shown(row: Row) -> float:
        return max(quantity.of(row), floor)
    log_log(axes, xlabel="unknowns $n_φ$", ylabel=quantity.axis, ylim=log_limits(map(shown, rows)),
            xlim=log_limits([row.n_phi for line in lines.values() for row in line], 1.3))
    for line in known:
        for _, piece in groupby(line, key=lambda row: row.body):
            piece = list(piece)
            axes.plot([row.n_phi for row in piece], list(map(shown, piece)), **piece[0].look.line())
        for row in line:
            if not row.completed:
                axes.plot(row.n_phi, shown(row), **row.look.line(markerfacecolor="white",
                                                                 markeredgecolor=row.look.colour))
            elif row.status == "inaccurate":
                axes.plot(row.n_phi, shown(row), **CROSS)
