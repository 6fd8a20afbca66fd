"""Fig. 3: time and memory of the preconditioners, for the families that have them side by side."""
import math
import re
from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import TYPE, Drawing, axes_at, log_axis, log_limits, text_at
from marks import (HEAP, MARGIN, SMALL, TIME, WIDTH, ErrorScale, Footer, Quantity, draw_point,
                   notes_of, of_no_study)
from records import Row
from selection import by_body, by_mesh, grouped, with_suffix
from words import CASE, EXTRAPOLATED, csv_of, left_out, plain, short

HEADS = {"SSOR": r"SSOR $\omega$"}
MARKERS = "osD^v<>pPX*hd"
LEFT, RIGHT, GAP, TOP, ERRORS = 0.62, 0.08, 0.14, 0.24, 0.46
TIME_HEIGHT, HEAP_HEIGHT, BETWEEN, LABELS = 2.2, 1.5, 0.12, 0.6
BLOCK = TOP + ERRORS + TIME_HEIGHT + BETWEEN + HEAP_HEIGHT + LABELS  # of a body
BETWEEN_GROUPS = 0.5  # of a slot
NARROWEST = 8.5 / 72  # a slot whose upright label does not touch its neighbour's

Slot = tuple[str, float | None]  # group and parameter: DTIC 3, SKY without
Columns = dict[str, dict[Slot, Row]]  # family -> slot -> row


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    stops, scale = of_no_study(rows)
    for stop, own in stops.items():
        shown = [row for of_body in by_body(own).values()
                 for column in columns_of(chosen(of_body)).values() for row in column.values()]
        yield Drawing(with_suffix("figure3", stop), shown, draw, table_of, vector=True,
                      options=dict(run=own, scale=scale))


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, "family", "preconditioner", "time_s", *EXTRAPOLATED,
                  "peak_heap_bytes", "error_force")


def chosen(rows: list[Row]) -> list[Row]:
    """Of the mesh with most preconditioners, unless all of them are in Figs 4 and 5."""
    meshes = by_mesh([row for row in rows if row.preconditioner])
    in_paper = {row.general_name for row in rows if row.in_paper}
    full = [own for own in meshes.values() if {row.general_name for row in own} - in_paper]
    return max(reversed(full), default=[], key=lambda own: len({row.general_name for row in own}))


def slot_of(row: Row) -> Slot:
    group, number = re.fullmatch(r"(.*?)(\d+(?:\.\d+)?)?", row.preconditioner).groups()
    return group, None if number is None else float(number)


def columns_of(rows: list[Row]) -> Columns:
    """Of several cases of a preconditioner the one without further options, rather not under an alias."""
    columns: Columns = {row.family: {} for row in rows}
    for row in sorted(rows, key=lambda row: (
            f"{row.family}:{row.preconditioner}" != row.general_name,
            row.method != row.general_name)):
        columns[row.family].setdefault(slot_of(row), row)
    return columns


def places_of(rows: list[Row]) -> dict[Slot, float]:
    """Slot -> position, in slots from the left: groups with parameters first, as they come."""
    groups = list(dict.fromkeys(slot_of(row)[0] for row in rows))
    slots = sorted({slot_of(row) for row in rows},
                   key=lambda slot: (slot[1] is None, groups.index(slot[0]), slot[1]))
    gaps = [sum(a[0] != b[0] for a, b in zip(slots[:k], slots[1:k + 1]))
            for k in range(len(slots))]
    return {slot: k + BETWEEN_GROUPS * gap for k, (slot, gap) in enumerate(zip(slots, gaps))}


def draw(rows: list[Row], run: list[Row], scale: ErrorScale) -> Figure | str:
    if not rows:
        return "no preconditioners beyond those of figures 4 and 5"
    meshes = grouped(rows, lambda row: row.mesh)
    cases = [(row.general_name + (f" on {row.mesh}" if len(meshes) > 1 else ""), row)
             for row in rows]
    timed = [(case, row) for case, row in cases if TIME.marked([row])]  # the others are named once
    sizes = [f"{mesh}, {own[0].n_phi}" for mesh, own in meshes.items()]
    texts = [f"{'; '.join(sizes)} degrees of freedom. {TIME.caption(rows, run)}"
             " Below: highest heap during one solve, its blocks and result included.",
             left_out(run, rows, why),
             *notes_of(cases, TIME)]
    texts += [line.replace("No point", "No point below") for line in notes_of(timed, HEAP)]
    footer = Footer(rows, TIME, texts, scale)
    figure = Figure(figsize=(WIDTH, BLOCK * len(meshes) + footer.height))
    for k, (mesh, own) in enumerate(meshes.items()):
        if len(meshes) > 1:
            text_at(figure, MARGIN, k * BLOCK + TOP - 0.06, plain(mesh), va="bottom", weight="bold")
        draw_block(figure, k * BLOCK + TOP, own, scale)
    footer.draw(figure)
    return figure


def why(row: Row) -> str:
    return "its preconditioner with other options is" if row.preconditioner else "no preconditioner"


def draw_block(figure: Figure, top: float, rows: list[Row], scale: ErrorScale) -> None:
    columns, places = columns_of(rows), places_of(rows)
    width = (WIDTH - LEFT - RIGHT - GAP * (len(columns) - 1)) / len(columns)
    limits = dict(xlim=(-0.7, max(places.values()) + 0.7))
    for k, (family, column) in enumerate(columns.items()):
        left = LEFT + k * (width + GAP)
        upper = axes_at(figure, left, top + ERRORS, width, TIME_HEIGHT, yscale="log", **limits,
                        ylim=limits_of(rows, TIME))
        lower = axes_at(figure, left, top + ERRORS + TIME_HEIGHT + BETWEEN, width, HEAP_HEIGHT,
                        **limits, ylim=limits_of(rows, HEAP))
        log_axis(upper.yaxis)
        if k == 0:
            upper.annotate("error", (0, 1), xycoords="axes fraction", xytext=(-4, 6), ha="right",
                           textcoords="offset points", fontsize=SMALL)
        upper.set_title(plain(family), pad=72 * ERRORS + 3, fontsize=TYPE + 1)
        for axes, quantity in ((upper, TIME), (lower, HEAP)):
            axes.grid(axis="y")
            axes.spines[["top", "right"]].set_visible(False)
            axes.tick_params(labelleft=k == 0)
            if k == 0:
                axes.set_ylabel(quantity.axis)
                axes.yaxis.set_label_coords(-0.44 / width, 0.5)
            draw_column(axes, column, places, quantity, scale)
        name_slots(upper, lower, places, column, width / (max(places.values()) + 1.4))


def limits_of(rows: list[Row], quantity: Quantity) -> tuple[float, float]:
    values = [value for _, value, _ in quantity.marked(rows)]
    if quantity is TIME:
        return log_limits(values, 1.6)
    return 0, 1.12 * max(values, default=1)


def draw_column(axes: Axes, column: dict[Slot, Row], places: dict[Slot, float],
                quantity: Quantity, scale: ErrorScale) -> None:
    groups = list(dict.fromkeys(group for group, _ in places))
    for group in groups:
        own = [column[slot] for slot in places if slot[0] == group and slot in column]
        line = [(places[slot_of(row)], value) for row, value in quantity.done(own)]
        if line and quantity is TIME:
            axes.plot(*zip(*line), color="0.55", linewidth=0.7, zorder=2)
        elif line:
            x, y = zip(*line)
            axes.vlines(x, 0, y, color="0.55", linewidth=0.7, zorder=2)
    for row, value, mark in quantity.marked(column.values()):
        group, _ = slot = slot_of(row)
        draw_point(axes, places[slot], value, row, mark, scale,
                   MARKERS[groups.index(group) % len(MARKERS)])


def name_slots(upper: Axes, lower: Axes, places: dict[Slot, float], column: dict[Slot, Row],
               slot_inches: float) -> None:
    """Parameters and groups below, errors above; of a dense sweep every second or third."""
    step = math.ceil(NARROWEST / slot_inches)
    groups = grouped(places, lambda slot: slot[0])
    upright = {group for group, slots in groups.items()
               if max(len(label_of(slot)) for slot in slots) > 1}
    named = [slot for slot in places if slot[0] not in upright
             or groups[slot[0]].index(slot) % step == 0]
    for axes in (upper, lower):
        axes.set_xticks([places[slot] for slot in named],
                        [label_of(slot) for slot in named] if axes is lower else [])
        axes.set_xticks([places[slot] for slot in places if slot not in named], minor=True)
    for slot, tick in zip(named, lower.get_xticklabels()):
        tick.set(rotation=90 if slot[0] in upright else 0, fontsize=SMALL)
    for slot in named:
        row = column.get(slot)
        known = row and row.completed and row.error_force is not None
        upper.annotate(short(row.error_force) if known else "–", (places[slot], 1),
                       xycoords=upper.get_xaxis_transform(), xytext=(0, 4), ha="center",
                       textcoords="offset points", rotation=90, fontsize=SMALL, va="bottom")
    for group, slots in groups.items():
        at = [places[slot] for slot in slots]
        if slots[0][1] is not None:
            lower.annotate(HEADS.get(group, plain(group)), (sum(at) / len(at), 0),
                           xycoords=lower.get_xaxis_transform(), xytext=(0, -27), ha="center",
                           textcoords="offset points", va="top")


def label_of(slot: Slot) -> str:
    group, parameter = slot
    return plain(group) if parameter is None else f"{parameter:g}"
