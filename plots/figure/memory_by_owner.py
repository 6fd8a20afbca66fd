"""Whose the heap of a solve is at its peak, method by method, next to what the methods count."""
from collections.abc import Iterator

from matplotlib.axes import Axes

from drawing import Drawing, Sheet
from records import Row
from selection import by_body, by_mesh, compared, grouped, of_scene
from words import CASE, columns_of, csv_of, left_out, plain, threads

BAR, AXIS = 0.2, 0.55  # inches
ROOM = 24  # bars
MIB = 2**20
# Okabe and Ito's colours, and what they stand for, from what every method has to what few have.
LOOKS = {"blocks": ("#999999", "blocks S, C, q"),
         "system_matrix": ("#000000", "own system matrix"),
         "factor": ("#0072B2", "factor"),
         "preconditioner": ("#56B4E9", "preconditioner"),
         "intermediate": ("#E69F00", "S⁻¹Cᵀ and similar"),
         "condensed": ("#D55E00", "D, G and contact"),
         "iteration": ("#009E73", "iteration vectors"),
         "answer": ("#CC79A7", "answer φ, σ"),
         "check": ("#F0E442", "error estimate"),
         "other": ("#DDDDDD", "other")}
COUNT = dict(marker="D", markersize=5.5, markerfacecolor="white", markeredgecolor="black",
             markeredgewidth=1.1, linestyle="none")


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    run = of_scene([row for row in rows if row.stop == "target" and not row.study])
    split = [row for row in run if row.memory_by_owner and row.completed]
    if split:
        bars = [bar for own in by_body(split).values() for bar in chosen(own)]
        yield Drawing("memory_by_owner", bars, draw, table_of, dict(run=run))


def chosen(rows: list[Row]) -> list[Row]:
    """Of a body's largest mesh that has two methods or more; by peak."""
    meshes = [compared(own, ROOM) for own in by_mesh(rows).values()]
    return sorted(next((own for own in reversed(meshes) if len(own) > 1), []), key=peak_of)


def table_of(rows: list[Row]) -> str:
    pieces = [(row, owner, own) for row in rows for owner, own in row.memory_by_owner.items()]
    return csv_of(pieces, *columns_of(lambda piece: piece[0], *CASE),
                  ("owner", lambda piece: piece[1]),
                  *((name, lambda piece, name=name: piece[2].get(name))
                    for name in ("peak_bytes", "counted_bytes")))


def peak_of(row: Row, *owners: str) -> int:
    """Bytes of these owners, of all without any, at the overall peak."""
    return sum(row.memory_by_owner[owner]["peak_bytes"] for owner in owners or row.memory_by_owner
               if owner in row.memory_by_owner)


def counted(row: Row) -> int:
    return sum(own.get("counted_bytes") or 0 for own in row.memory_by_owner.values())


def draw(rows: list[Row], width: float, run: list[Row]) -> Sheet | str:
    if not rows:
        return "no mesh has two methods whose heap was split"
    used = [owner for owner in LOOKS if any(peak_of(row, owner) > 0 for row in rows)]
    meshes = grouped(rows, lambda row: row.mesh)
    sizes = [f"{mesh}, n_φ = {own[0].n_phi}" for mesh, own in meshes.items()]
    differ = [row.method + (f" on {row.mesh}" if len(meshes) > 1 else "") for row in rows
              if row.memory_counts_differ]
    sheet = Sheet(
        width, "Where the memory goes",
        f"{'; '.join(sizes)}, scene {rows[0].scene}, {threads(rows)}. "
        "Peak heap of one solve, by owner at that moment; workspace belongs to the part that it serves. "
        "Diamond: the method's own count of its matrices and vectors, entries times size, and the blocks. "
        "What a bar has beyond it is workspace; where a bar is shorter, the solve never holds everything "
        "at once. The numbers are in the CSV.",
        f"The count differs from the heap by more than 10 %: {', '.join(differ)}." if differ
        else "", left_out(run, rows, lambda row: "no room, or not on these meshes" if row.memory_by_owner
                          else "heap not split by owner"),
        panels=len(meshes), in_row=1, height=AXIS + BAR * max(map(len, meshes.values())),
        key=[(LOOKS[owner][1], dict(color=LOOKS[owner][0], linewidth=7, solid_capstyle="butt")) for owner in used]
        + [("the method's own count", COUNT)])
    for axes, (mesh, own) in zip(sheet.panels, meshes.items()):
        draw_bars(axes, own, used)
        axes.set_title(plain(mesh), loc="left")
    return sheet


def draw_bars(axes: Axes, rows: list[Row], used: list[str]) -> None:
    counts = [counted(row) / MIB for row in rows]
    places = range(len(rows))
    start = [0.0] * len(rows)
    for owner in used:
        colour, _ = LOOKS[owner]
        widths = [max(peak_of(row, owner), 0) / MIB for row in rows]
        axes.barh(places, widths, left=start, height=0.72, color=colour, edgecolor="white", linewidth=0.4)
        start = [left + width for left, width in zip(start, widths)]
    axes.plot(counts, places, **COUNT)
    axes.set(xlim=(0, 1.04 * max(*start, *counts)), ylim=(-0.6, len(rows) - 0.4),
             xlabel="heap at the peak of the solve, MiB")
    axes.set_yticks(places, [plain(row.method) for row in rows])
    axes.invert_yaxis()
    axes.tick_params(axis="y", length=0)
    axes.grid(False, axis="y")
