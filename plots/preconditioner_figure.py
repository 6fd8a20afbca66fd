"""Fig. 3: time and memory of the preconditioners, for SYMMLQ and 3STEPCG side by side."""
from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import figure_parts as parts
from figure_parts import HEAP, TIME, ErrorScale, Footer, axes_at, draw_point
from figure_words import Notes, short
from method_names import KRYLOV, PAPER_NAMES, general, preconditioned
from results_table import Row

GROUPS = ("DTIC", "FLIC", "SSOR", "SKY", "NONE")
HEADS = {"SSOR": r"SSOR $\omega$"}
MARKERS = {"DTIC": "o", "FLIC": "s", "SSOR": "D", "SKY": "^", "NONE": "v"}
LEFT, RIGHT, GAP, TOP, ERRORS = 0.62, 0.08, 0.14, 0.24, 0.46
TIME_HEIGHT, HEAP_HEIGHT, BETWEEN, LABELS = 2.2, 1.5, 0.12, 0.6
BETWEEN_GROUPS = 0.5  # of a slot
NARROWEST = 8.5 / 72  # a slot whose upright label does not touch its neighbour's

Slot = tuple[str, float]  # family and parameter


def choose_mesh(rows: list[Row]) -> str | None:
    """Mesh3; else the one with most preconditioners; None: only those of Figs 4 and 5 anywhere."""
    seen: dict[str, set[str]] = {}
    for row in rows:
        if preconditioned(row.method):
            seen.setdefault(row.mesh, set()).add(general(row.method))
    full = {mesh: names for mesh, names in seen.items() if names - PAPER_NAMES.keys()}
    return max(full, key=lambda mesh: (mesh == "Mesh3", len(full[mesh])), default=None)


def columns_of(rows: list[Row]) -> dict[str, dict[Slot, Row]]:
    """Krylov method -> slot -> row. A method asked for by two names is there once."""
    columns: dict[str, dict[Slot, Row]] = {krylov: {} for krylov in KRYLOV}
    for row in rows:
        krylov, *slot = preconditioned(row.method) or (None,)
        if krylov and (tuple(slot) not in columns[krylov] or row.method == general(row.method)):
            columns[krylov][tuple(slot)] = row
    return {krylov: column for krylov, column in columns.items() if column}


def places_of(columns: dict[str, dict[Slot, Row]]) -> dict[Slot, float]:
    """Slot -> position, in slots from the left."""
    slots = sorted({slot for column in columns.values() for slot in column},
                   key=lambda slot: (GROUPS.index(slot[0]), slot[1]))
    families = [family for family, _ in slots]
    gaps = [sum(a != b for a, b in zip(families[:k], families[1:k + 1]))
            for k in range(len(slots))]
    return {slot: k + BETWEEN_GROUPS * gap for k, (slot, gap) in enumerate(zip(slots, gaps))}


def draw(rows: list[Row], scale: ErrorScale) -> tuple[Figure, list[Row]] | str:
    """The figure and its rows, or why there is none. rows: of one scene, one stop."""
    mesh = choose_mesh(rows)
    if mesh is None:
        return "no rows of preconditioners beyond those of figures 4 and 5"
    columns = columns_of([row for row in rows if row.mesh == mesh])
    used = [row for column in columns.values() for row in column.values()]
    notes = {TIME: Notes(), HEAP: Notes()}
    for row in used:
        for quantity in (TIME, HEAP):
            value, mark = quantity.of(row)
            notes[quantity].add(row, general(row.method), mark, value)
            if mark == "none":
                break  # said once
    texts = [f"{mesh}, {used[0].n_phi} degrees of freedom. " + TIME.caption(used, rows)
             + " Below: highest heap during one solve, its blocks and result included.",
             *notes[TIME].lines()]
    texts += [line.replace("no point", "no point below") for line in notes[HEAP].lines()]
    footer = Footer(used, TIME, texts, scale)
    body = ERRORS + TIME_HEIGHT + BETWEEN + HEAP_HEIGHT + LABELS
    figure = Figure(figsize=(parts.WIDTH, TOP + body + footer.height))
    places = places_of(columns)
    width = (parts.WIDTH - LEFT - RIGHT - GAP * (len(columns) - 1)) / len(columns)
    for k, (krylov, column) in enumerate(columns.items()):
        left = LEFT + k * (width + GAP)
        limits = dict(xlim=(-0.7, max(places.values()) + 0.7))
        upper = axes_at(figure, left, TOP + ERRORS, width, TIME_HEIGHT, yscale="log", **limits,
                        ylim=limits_of(used, TIME))
        lower = axes_at(figure, left, TOP + ERRORS + TIME_HEIGHT + BETWEEN, width, HEAP_HEIGHT,
                        **limits, ylim=limits_of(used, HEAP))
        parts.log_axis(upper.yaxis)
        if k == 0:
            upper.annotate("error", (0, 1), xycoords="axes fraction", xytext=(-4, 6), ha="right",
                           textcoords="offset points", fontsize=parts.SMALL)
        upper.set_title(krylov, pad=72 * ERRORS + 3, fontsize=parts.TYPE + 1)
        for axes, quantity in ((upper, TIME), (lower, HEAP)):
            axes.grid(axis="y")
            axes.spines[["top", "right"]].set_visible(False)
            axes.tick_params(labelleft=k == 0)
            if k == 0:
                axes.set_ylabel(quantity.axis)
                axes.yaxis.set_label_coords(-0.44 / width, 0.5)
            draw_column(axes, column, places, quantity, scale)
        slot_inches = width / (max(places.values()) + 1.4)
        name_slots(upper, lower, places, column, slot_inches)
    footer.draw(figure)
    return figure, used


def limits_of(rows: list[Row], quantity: parts.Quantity) -> tuple[float, float]:
    values = [value for row in rows for value, mark in [quantity.of(row)] if mark != "none"]
    if quantity is TIME:
        return parts.log_limits(values, 1.6)
    return 0, 1.12 * max(values, default=1)


def draw_column(axes: Axes, column: dict[Slot, Row], places: dict[Slot, float],
                quantity: parts.Quantity, scale: ErrorScale) -> None:
    """Points, those of a family joined; memory on stems."""
    for family in GROUPS:
        line = [(places[slot], quantity.of(column[slot])[0])
                for slot in places if slot[0] == family and slot in column
                and quantity.of(column[slot])[1] == "done"]
        if quantity is TIME:
            axes.plot(*zip(*line), color="0.55", linewidth=0.7, zorder=2) if line else None
        elif line:
            axes.vlines([x for x, _ in line], 0, [y for _, y in line], color="0.55",
                        linewidth=0.7, zorder=2)
    for slot, row in column.items():
        value, mark = quantity.of(row)
        if mark != "none":
            draw_point(axes, places[slot], value, row, mark, scale, MARKERS[slot[0]])


def name_slots(upper: Axes, lower: Axes, places: dict[Slot, float], column: dict[Slot, Row],
               slot_inches: float) -> None:
    """Parameters and groups below, errors above; of a dense sweep of omega every second, third."""
    step = math.ceil(NARROWEST / slot_inches)
    sweep = [slot for slot in places if slot[0] == "SSOR"]
    named = [slot for slot in places if slot[0] != "SSOR" or sweep.index(slot) % step == 0]
    for axes in (upper, lower):
        axes.set_xticks([places[slot] for slot in named],
                        [label_of(slot) for slot in named] if axes is lower else [])
        axes.set_xticks([places[slot] for slot in places if slot not in named], minor=True)
    for slot, tick in zip(named, lower.get_xticklabels()):
        tick.set(rotation=90 if slot[0] in ("SSOR", "SKY", "NONE") else 0, fontsize=parts.SMALL)
    for slot in named:
        row = column.get(slot)
        known = row and row.completed and row.error_force is not None
        upper.annotate(short(row.error_force) if known else "–", (places[slot], 1),
                       xycoords=upper.get_xaxis_transform(), xytext=(0, 4), ha="center",
                       textcoords="offset points", rotation=90, fontsize=parts.SMALL, va="bottom")
    for family in ("DTIC", "FLIC", "SSOR"):
        at = [place for slot, place in places.items() if slot[0] == family]
        if at:
            lower.annotate(HEADS.get(family, family), (sum(at) / len(at), 0),
                           xycoords=lower.get_xaxis_transform(), xytext=(0, -27), ha="center",
                           textcoords="offset points", va="top")


def label_of(slot: Slot) -> str:
    family, parameter = slot
    return family if family in ("SKY", "NONE") else f"{parameter:g}"
