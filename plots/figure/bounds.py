"""Guaranteed bounds of the energy over the unknowns: how they close in on it."""
from collections.abc import Iterator

from drawing import Drawing, Sheet, keys, log_axis, log_limits, log_log
from records import Row
from selection import by_method, grouped, line_of
from words import CASE, csv_of, threads

FEWEST = 3  # meshes of a method


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    """Of the body and scene with most meshes."""
    bounded = [row for row in rows if row.completed and gap_of(row) and not row.knob]
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


def draw(rows: list[Row], width: float) -> Sheet:
    scene = f", scene {rows[0].scene}" if rows[0].scene != rows[0].body else ""
    sheet = Sheet(
        width, f"Bounds of the energy: {rows[0].body}{scene}",
        "Without friction the exact displacement has the least potential energy of all that keep to the wall, and "
        "the exact stresses have the least complementary energy of all in equilibrium. So computed stresses bound "
        "the energy from below, computed displacements from above; the exact energy lies between. First panel: a "
        f"band for each method. Second: the width of the bands. {threads(rows)}.", panels=2, key=keys(rows))
    energy, gap = sheet.panels
    unknowns = dict(xlim=log_limits([row.n_phi for row in rows], 1.3), xlabel="unknowns $n_φ$")
    energy.set(xscale="log", ylabel="energy, N mm", **unknowns)
    log_axis(energy.xaxis)
    log_log(gap, ylim=log_limits(map(gap_of, rows), 2), ylabel="(upper − lower) / energy", **unknowns)
    for line in by_method(rows, "n_phi").values():
        look = line[0].look
        n, low = line_of(line, "n_phi", "lower_bound_Nmm")
        high = line_of(line, "n_phi", "upper_bound_Nmm")[1]
        energy.fill_between(n, low, high, color=look.colour, alpha=0.25, linewidth=0)
        for bound in (low, high):
            energy.plot(n, bound, **look.line(markersize=4, linewidth=1))
        gap.plot(n, [gap_of(row) for row in line], **look.line())
    return sheet
