"""Guaranteed bounds of the energy over the unknowns: how they close in on it."""
from collections.abc import Iterator

from matplotlib.figure import Figure

from drawing import PAGE_WIDTH, Drawing, log_axis, log_limits, log_log, panel_at, sheet
from figure.adaptive import kinds_in, name_among
from labels import Labels
from records import Row
from selection import by_method, grouped, line_of
from words import CASE, csv_of, threads

LEFT, TOP, BOTTOM, HEIGHT, GAP = 0.72, 0.5, 0.45, 3.0, 0.8  # inches
FEWEST = 3  # meshes of a method


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    """Of the body and scene with most meshes."""
    bounded = [row for row in rows if not row.study and row.completed and gap_of(row)]
    lines = grouped(bounded, lambda row: (row.body, row.scene, row.method)).values()
    closing = [row for line in lines if len({row.n_phi for row in line}) >= FEWEST for row in line]
    if closing:
        bodies = grouped(closing, lambda row: (row.body, row.scene))
        yield Drawing("bounds", max(bodies.values(), key=len), draw, table_of)


def gap_of(row: Row) -> float | None:
    """Between the bounds, relative; None: a bound is missing."""
    if row.lower_bound_Nmm is None or not row.upper_bound_Nmm:
        return None
    return (row.upper_bound_Nmm - row.lower_bound_Nmm) / abs(row.upper_bound_Nmm)


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, "lower_bound_Nmm", "upper_bound_Nmm", ("relative_gap", gap_of))


def draw(rows: list[Row]) -> Figure:
    scene = f", scene {rows[0].scene}" if rows[0].scene != rows[0].body else ""
    figure = sheet(
        TOP + HEIGHT + BOTTOM, f"Bounds of the energy: {rows[0].body}{scene}",
        "Without friction the exact displacement has the least potential energy of all that keep to the wall, and "
        "the exact stresses have the least complementary energy of all in equilibrium. So computed stresses bound "
        "the energy from below, computed displacements from above; the exact energy lies between. Left: a "
        "band for each degree of the stresses. Right: the width of the bands. "
        f"Meshes: {kinds_in(rows)}; {threads(rows)}.")
    width = (PAGE_WIDTH - LEFT - GAP - 0.15) / 2
    left, right = (panel_at(figure, LEFT + k * (width + GAP), TOP, width, HEIGHT) for k in (0, 1))
    unknowns = log_limits([row.n_phi for row in rows], 1.3)
    left.set(xscale="log", xlim=unknowns, xlabel="unknowns $n_φ$", ylabel="energy, N mm")
    log_axis(left.xaxis)
    log_log(right, xlim=unknowns, ylim=log_limits(map(gap_of, rows), 2), xlabel="unknowns $n_φ$",
            ylabel="(upper − lower) / energy")
    labels = Labels(right)
    for method, line in by_method(rows, "n_phi").items():
        look = line[0].look
        n, low = line_of(line, "n_phi", "lower_bound_Nmm")
        high = line_of(line, "n_phi", "upper_bound_Nmm")[1]
        left.fill_between(n, low, high, color=look.colour, alpha=0.25, linewidth=0)
        for bound in (low, high):
            left.plot(n, bound, color=look.colour, marker=look.marker, markersize=4, linewidth=1)
        labels.line(name_among(rows, line[0]), n, [gap_of(row) for row in line], look.colour, marker=look.marker,
                    markersize=5, linewidth=1.2)
    labels.name_lines(weight="bold")
    return figure
