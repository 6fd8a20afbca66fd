"""Error against time: what a method, its mesh and its parameter cost.

A line is a method on one kind of meshes. Where it has many solves (a parameter takes several values), it is their
front: no cheaper solve has a smaller error. Else its points are joined in the order of sizes or, on one mesh, of the values
of a program's own parameter.
"""
import re
from collections.abc import Callable, Iterator
from functools import partial

from matplotlib.axes import Axes

from catalogue import DASHED, DOTTED
from drawing import CROSS, Drawing, Sheet, error_floor, log_limits, log_log
from records import Row
from selection import adapting, by_body, by_mesh, compared, front, given, grouped, is_paper_stop, kind_of
from words import CASE, KNOB, axis_label, csv_of, left_out, plain, short, threads

ROOM, PANELS = 14, 4  # methods, panels
HIGHEST, OF_PARAMETERS = 1.0, 0.2  # errors above are of no use, and not drawn; total ones where a parameter was varied
KINDS = {"as they are": DASHED, "refined everywhere": DOTTED, "adapted": "-"}
CHOSEN = re.compile(r"(\w+)=([-+.\de]+)(?:;|$)")

Of = Callable[[Row], float | None]


def total_error(row: Row) -> float | None:
    """An inaccurate answer in displacements has no error_total."""
    return row.error_total or (row.error_discretisation if row.in_displacements else None)


def own_error(row: Row) -> float | None:
    return None if row.in_displacements or row.points != "accuracy" else row.error_force


ERRORS: dict[str, tuple[Of, str]] = {"error_time": (total_error, "error_total"),
                                     "error_time_forces": (own_error, "error_force")}


def highest(row: Row, error: Of) -> float:
    return max(OF_PARAMETERS, 1.5 * (row.error_discretisation or 0)) if error is total_error and row.knob else HIGHEST


def value_of(row: Row) -> float | None:
    """Of a program's own parameter."""
    chosen = CHOSEN.match(row.parameters) if row.program else None
    return float(chosen[2]) if chosen else None


def time_of(row: Row) -> float | None:
    """Of an adapted mesh: of the whole loop up to it, and of the method's own solve on another's mesh."""
    if not row.adapt_time_s or not row.time_s:
        return row.time_s
    return row.adapt_time_s + (0 if adapting(row) == row.method else row.time_s)


def has_own_mesh(row: Row) -> bool:
    """An adapted mesh is of the degree that solved its levels: their time is not another's."""
    of_other_degree = row.method.startswith("HYBRID:k=") or row.method == "HYBRID"
    return kind_of(row) != "adapted" or adapting(row) == row.method or not of_other_degree


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    run = [row for row in rows if not row.study or row.points == "accuracy"]
    for name, (error, _) in ERRORS.items():
        known = [row for row in run if (row.completed or row.knob) and row.time_s and error(row) is not None
                 and error(row) <= highest(row, error) and has_own_mesh(row) and (row.iterative or row.stop == "target")]
        panels = panels_of(with_room(known), error)
        if any(len(own) > 1 for own in panels.values()):
            yield Drawing(name, [row for own in panels.values() for row in own], draw,
                          partial(table_of, error=error), dict(run=run, name=name))


def with_room(rows: list[Row]) -> list[Row]:
    """All parameters of ROOM methods; those with given r and ρ share a line."""
    shown = {row.general_name for row in compared([row for row in rows if not given(row)], ROOM)}
    return [row for row in rows if given(row) or row.general_name in shown]


def panels_of(rows: list[Row], error: Of) -> dict[str, list[Row]]:
    """Bodies for total errors, meshes for a method's own or where a program's parameter takes several values (and stresses
    are of one degree); of too many meshes the largest and the smallest of each body."""
    swept = {(row.mesh, row.family) for own in sweeps_of(rows).values() for row in own}
    if error is total_error and (not swept or len({row.degree for row in rows if not row.in_displacements}) > 1):
        return dict(list(grouped(rows, title_of).items())[:PANELS])
    meshes = by_mesh([row for row in rows if row.scene == rows[0].scene])
    if swept:
        meshes = {mesh: own for mesh, own in meshes.items() if any((mesh, row.family) in swept for row in own)}
    if len(meshes) > PANELS:
        ends = [mesh for own in by_body([own[0] for own in meshes.values()]).values()
                for mesh in dict.fromkeys((own[0].mesh, own[-1].mesh))]
        meshes = {mesh: own for mesh, own in meshes.items() if mesh in ends[:PANELS]}
    return meshes


def title_of(row: Row) -> str:
    return row.body if row.scene in ("default", row.body) else f"{row.body}, scene {row.scene}"


def sweeps_of(rows: list[Row]) -> dict[tuple[str, str], list[Row]]:
    """Mesh and program -> its rows, where its parameter has two values or more."""
    sweeps = grouped([row for row in rows if value_of(row) is not None and not row.knob],
                     lambda row: (row.mesh, row.family))
    return {key: own for key, own in sweeps.items() if len(set(map(value_of, own))) > 1}


def name_of(row: Row) -> str:
    return f"{row.family}, paper’s stop" if is_paper_stop(row) else f"{row.family}, best of given r, ρ" if given(row) \
        else row.label if value_of(row) is None else row.family.removeprefix("EXTERNAL:")


def lines_of(rows: list[Row], error: Of) -> dict[tuple[str, str, str], list[Row]]:
    """Name, kind of meshes and the method that adapted them -> the points of a line."""
    lines = grouped(sorted(rows, key=lambda row: (row.look.rank, row.method, row.n_phi)), lambda row: (
        name_of(row), kind_of(row), adapting(row) if kind_of(row) == "adapted" else ""))
    found = {}
    for key, own in lines.items():
        is_swept = bool(sweeps_of(own))
        if any(row.knob or given(row) for row in own) or is_swept and len({row.mesh for row in own}) > 1:
            found[key] = front(own, time_of, error)
        else:
            found[key] = sorted(own, key=lambda row: value_of(row) or 0) if is_swept else own
    return found


def table_of(rows: list[Row], error: Of) -> str:
    """is_on_line: drawn; the other solves of its line are slower for as small an error."""
    drawn = {row.line for own in panels_of(rows, error).values() for line in lines_of(own, error).values() for row in line}
    return csv_of(rows, *CASE, *KNOB, "degree", ("kind_of_mesh", kind_of), ("value", value_of), ("time_s", time_of),
                  "peak_heap_bytes", ("error_total", total_error), "error_discretisation", "error_stress",
                  "error_force", "uzawa_iterations", ("is_on_line", lambda row: row.line in drawn))


def draw(rows: list[Row], width: float, run: list[Row], name: str) -> Sheet:
    error, label = ERRORS[name]
    panels = panels_of(rows, error)
    lines = {panel: lines_of(own, error) for panel, own in panels.items()}
    kinds = [kind for kind in KINDS if kind in map(kind_of, rows)]
    floor = error_floor(map(error, rows))
    target = next((row.target_error for row in rows if row.target_error), None) if error is own_error else None
    shown = [row for own in lines.values() for line in own.values() for row in line]
    key = list({key[0]: style_of(line[0], len(kinds)) | dict(markerfacecolor=line[0].look.colour) for own in lines.values()
                for key, line in sorted(own.items(), key=lambda item: (item[1][0].look.rank, item[0]))}.items())
    is_by_mesh = bool(set(panels) & {row.mesh for row in rows})
    swept = [f"{own[0].family.removeprefix('EXTERNAL:')}: {CHOSEN.match(own[0].parameters)[1]} "
             f"{', '.join(f'{value_of(row):g}' for row in sorted(own, key=value_of))}"
             for own in {own[0].family: own for own in sweeps_of(rows).values()}.values()]
    sheet = Sheet(
        width, f"{axis_label(label)[0].upper()}{axis_label(label)[1:]} against time",
        ("Total error of the stresses, mesh and method together" if error is total_error else
         "Error of the contact forces against the reference, a method's own error") +
        f", over the time of one solve; {threads(rows)}. A panel is a "
        f"{'mesh' if is_by_mesh else 'body'}. A line is a method; where a parameter takes "
        "several values, the front of its solves: no cheaper one has a smaller error. The time to find parameters is "
        "not in it." + (" Stars: the paper's own stop." if any(map(is_paper_stop, rows)) else "") +
        (f" Dashed line: the target {short(target)}." if target else ""),
        f"Meshes: {', '.join(f'{kind} ({look})' for kind, look in zip(KINDS, ('open, dashed', 'open, dotted', 'filled, solid')) if kind in kinds)}."
        if len(kinds) > 1 else f"Meshes: {''.join(kinds)}.",
        "Time on an adapted mesh: the whole loop, all levels and estimates of the error; of a method that did not "
        "adapt its mesh that loop plus its own solve." if "adapted" in kinds else "",
        f"Joined along a program's own parameter, in this order: {'; '.join(swept)}." if swept and is_by_mesh else "",
        "Crossed: not ok." if any(is_crossed(row, error) for row in shown) else "",
        not_drawn(run, rows, error), left_out(run, shown, lambda row: why(row, error)),
        panels=len(panels), height=2.9, key=[(plain(words), style) for words, style in key])
    errors = log_limits([max(error(row), floor) for row in shown] + [target] * bool(target), 1.5)
    for axes, (panel, own) in zip(sheet.panels, lines.items()):
        log_log(axes, xlim=log_limits([time_of(row) for line in own.values() for row in line], 1.5), ylim=errors,
                xlabel="time, s", ylabel=axis_label(label))
        axes.set_title(plain(panel))
        if target:
            axes.axhline(target, color="0.25", linewidth=0.8, linestyle=(0, (5, 3)))
        for line in own.values():
            draw_line(axes, line, error, floor, len(kinds))
    return sheet


def draw_line(axes: Axes, line: list[Row], error: Of, floor: float, kinds: int) -> None:
    axes.plot(list(map(time_of, line)), [max(error(row), floor) for row in line], **style_of(line[0], kinds))
    for row in line:
        if is_crossed(row, error):
            axes.plot(time_of(row), max(error(row), floor), **CROSS)


def style_of(row: Row, kinds: int) -> dict[str, object]:
    """Dashes and filling say the kind of mesh where there are several."""
    if is_paper_stop(row):
        return row.look.line(marker="*", markersize=11, linestyle="none", markeredgecolor="black", zorder=5)
    if kinds == 1:
        return row.look.line()
    filled = {} if kind_of(row) == "adapted" else dict(markerfacecolor="white", markeredgecolor=row.look.colour)
    return row.look.line(linestyle=KINDS[kind_of(row)], **filled)


def is_crossed(row: Row, error: Of) -> bool:
    return error is total_error and row.status != "ok" and not row.knob and not is_paper_stop(row)


def not_drawn(run: list[Row], rows: list[Row], error: Of) -> str:
    others = [row for row in run if error(row) and row.body not in {row.body for row in rows}]
    words = [f"Bodies not drawn: {', '.join(by_body(others))}."] if others else []
    beyond = sum(bool(error(row) and error(row) > highest(row, error)) for row in run)
    return " ".join(words + [f"{beyond} solves with errors of no use are not drawn: above {HIGHEST:g}, or total ones above "
                             f"{OF_PARAMETERS:g} where a parameter was varied."] * bool(beyond))


def why(row: Row, error: Of) -> str:
    return "in displacements, which have other contact forces" if error is own_error and row.in_displacements else \
        "no error" if error(row) is None else "error of no use" if error(row) > highest(row, error) else \
        "on meshes adapted by another degree" if not has_own_mesh(row) else "never the best of its line" if given(row) else \
        "no room"
