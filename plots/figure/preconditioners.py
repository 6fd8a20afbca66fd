"""The paper's Fig. 3: time, memory and error of the preconditioners, for the families that have them side by side."""
import re
from collections.abc import Iterator

from catalogue import METHODS
from drawing import CROSS, Drawing, Sheet, log_axis, log_limits
from records import Row
from selection import by_body, by_mesh, by_stop, grouped, of_scene, value_of, with_suffix
from words import CASE, EXTRAPOLATED, axis_label, csv_of, left_out, no_point, plain, time_caption

QUANTITIES = ("time_s", "peak_heap_bytes", "error_force")

Slot = tuple[str, float | None]  # group and parameter: DTIC 3, SKY without


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    for stop, own in by_stop(of_scene([row for row in rows if not row.study])).items():
        shown = [row for of_body in by_body(own).values() for row in by_slot(chosen(of_body)).values()]
        if shown:
            yield Drawing(with_suffix("preconditioners", stop), shown, draw, table_of, dict(run=own))


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, "family", "preconditioner", "time_s", *EXTRAPOLATED, "peak_heap_bytes", "error_force")


def chosen(rows: list[Row]) -> list[Row]:
    """Of the mesh with most preconditioners, unless the paper compares all of them in its Figs 4 and 5."""
    meshes = by_mesh([row for row in rows if row.preconditioner])
    in_paper = {row.general_name for row in rows if row.in_paper}
    full = [own for own in meshes.values() if {row.general_name for row in own} - in_paper]
    return max(reversed(full), default=[], key=lambda own: len({row.general_name for row in own}))


def slot_of(row: Row) -> Slot:
    group, number = re.fullmatch(r"(.*?)(\d+(?:\.\d+)?)?", row.preconditioner).groups()
    return group, None if number is None else float(number)


def by_slot(rows: list[Row]) -> dict[tuple[str, Slot], Row]:
    """Of several cases of a preconditioner the one without further options, rather not under an alias."""
    found: dict[tuple[str, Slot], Row] = {}
    for row in sorted(rows, key=lambda row: (f"{row.family}:{row.preconditioner}" != row.general_name,
                                             row.method != row.general_name)):
        found.setdefault((row.family, slot_of(row)), row)
    return found


def places_of(rows: list[Row]) -> dict[Slot, float]:
    """Slot -> position: groups with parameters first, as they come, half a place between groups."""
    groups = list(dict.fromkeys(slot_of(row)[0] for row in rows))
    slots = sorted({slot_of(row) for row in rows}, key=lambda slot: (slot[1] is None, groups.index(slot[0]), slot[1]))
    between = [sum(a[0] != b[0] for a, b in zip(slots[:k], slots[1:k + 1])) for k in range(len(slots))]
    return {slot: k + 0.5 * gap for k, (slot, gap) in enumerate(zip(slots, between))}


def label_of(slot: Slot) -> str:
    group, parameter = slot
    return plain(group) + ("" if parameter is None else f" {parameter:g}")


def draw(rows: list[Row], width: float, run: list[Row]) -> Sheet | str:
    timed = [row for row in rows if row.time_s or row.extrapolated_time_s]
    if not timed:
        return f"none of its {len(rows)} cases has a time"
    meshes = grouped(rows, lambda row: row.mesh)
    quantities = [key for key in QUANTITIES if any(value_of(row, key) for row in rows)]
    styles = {family: dict(color=METHODS.get(family, ("0.3",))[0], linewidth=0.9, markersize=5, marker="os^D"[k % 4])
              for k, family in enumerate(dict.fromkeys(row.family for row in rows))}
    sheet = Sheet(
        width, "Preconditioners", time_caption(rows, run), "; ".join(
            f"{mesh}: {own[0].n_phi} unknowns" for mesh, own in meshes.items()) +
        ". SSOR's number is ω. Open: time limit reached, time extrapolated. Crossed: inaccurate.",
        left_out(run, rows, lambda row: "its preconditioner with other options is" if row.preconditioner else
                 "no preconditioner"), no_point([row for row in rows if row not in timed]),
        panels=len(meshes) * len(quantities), in_row=1, height=2.1, key=[(plain(name), style) for name, style in styles.items()])
    panels = iter(sheet.panels)
    for mesh, own in meshes.items():
        places = places_of(own)
        for quantity in quantities:
            axes = next(panels)
            values = {row.line: value for row in own
                      if (value := value_of(row, quantity) or (row.extrapolated_time_s if quantity == "time_s" else None))}
            axes.set(yscale="log", ylabel=axis_label(quantity), ylim=log_limits(values.values(), 1.6))
            log_axis(axes.yaxis)
            axes.set_xticks(list(places.values()), map(label_of, places), rotation=90)
            axes.tick_params(labelbottom=quantity == quantities[-1])
            for (family, _), group in grouped(own, lambda row: (row.family, slot_of(row)[0])).items():
                line = sorted((places[slot_of(row)], values[row.line]) for row in group
                              if row.line in values and row.completed)
                axes.plot([x for x, _ in line], [y for _, y in line], **styles[family])
                for row in group:
                    at = places[slot_of(row)], values.get(row.line)
                    if at[1] and not row.completed:
                        axes.plot(*at, **styles[family] | dict(markerfacecolor="white", linestyle="none"))
                    elif at[1] and row.status == "inaccurate":
                        axes.plot(*at, **CROSS)
        if len(meshes) > 1:
            sheet.panels[list(meshes).index(mesh) * len(quantities)].set_title(plain(mesh))
    return sheet
