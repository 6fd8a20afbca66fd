"""Total error, of the discretisation and of the method together, against time and memory."""
import math
from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import PAGE_WIDTH, STOP, Drawing, log_limits, log_log, sheet, side_by_side, text_at
from figure.work_precision import AXES
from labels import Labels
from records import Row
from selection import (by_body, front, given, grouped, is_paper_stop, kind_of, line_of, of_mesh,
                       of_scene, value_of)
from words import (CASE, KNOB, axis_label, csv_of, lacking, left_out, mebibytes, names_of, percent,
                   plain, seconds, threads, width_of)

LEFT, TOP, HEIGHT, GAP, BOTTOM = 0.72, 0.65, 3.5, 0.2, 0.45  # inches, of a body
TABLE_LINE = 0.17  # inches: a line of the table
HIGHEST = 0.2  # total errors above are of no use, and not drawn …
OVER_FLOOR = 1.5  # … but for so many times the discretisation error of the coarsest mesh
GAIN = 0.01  # of the error: less is not worth a point of the front
STEPS = (1, 1.5, 2, 3, 5, 7)  # levels, times powers of ten
LEVELS = 7  # lines of a table at most
COSTS = ("mesh", "time", "peak heap")
NAME = dict(weight="bold", fontsize=8.5)
NAMED_IN_FULL = 2  # displacement methods
FLOOR_WORDS = 11  # points, between words of two floors
# Kinds of meshes: colour and width of their fronts.
KINDS = {"as they are": ("black", 2.2), "refined everywhere": ("#6B6B80", 1.8),
         "adapted": ("#B00020", 2.6)}  # as kind_of() says


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = of_scene([row for row in rows if row.points == "accuracy"])
    if study:
        levels_of = [row for row in rows if row.study == "" and row.adapt_level is not None
                     and row.scene == study[0].scene]
        yield Drawing("pareto", study + levels_of, draw, table_of)


def table_of(rows: list[Row]) -> str:
    """on_front_in_…: of the stress methods on meshes of the kind."""
    known = known_of(rows)
    stress = [row for row in known if not row.in_displacements]
    fronts = {column: {row.line for own in grouped(stress, lambda row: (row.body, kind_of(row)))
                       .values() for row in front(own, column, "error_total", GAIN)}
              for column in AXES}
    return csv_of(known, *CASE, *KNOB, ("kind_of_mesh", kind_of), *AXES, "error_discretisation",
                  "error_stress", "error_total",
                  *((f"on_front_in_{column}", lambda row, own=own: row.line in own)
                    for column, own in fronts.items()))


def known_of(rows: list[Row]) -> list[Row]:
    highest = highest_of(rows)
    return [row for row in rows if row.time_s and row.error_total and row.error_total <= highest
            and not is_other_value(row)]


def is_other_value(row: Row) -> bool:
    """Of a program's own parameter, which the figure `peers_penalty` draws, not the one it stands for."""
    return bool(row.program) and row.method != row.family


def highest_of(rows: list[Row]) -> float:
    """The largest total error drawn: at most 1, beyond which an answer is useless."""
    floor = max((row.error_discretisation or 0 for row in rows if not row.program), default=0)
    return min(max(HIGHEST, OVER_FLOOR * floor), 1)


def levels(errors: list[float]) -> list[float]:
    """The smallest LEVELS round errors between the smallest and the largest of `errors`."""
    low, high = min(errors), max(errors)
    found = [float(f"{m * 10.0**k:.2g}") for k in range(math.floor(math.log10(low)), 2)
             for m in STEPS]
    found = [level for level in found if level >= low]
    return [level for level in found if level <= max(high, found[0])][:LEVELS]


def displacements_of(rows: list[Row]) -> list[str]:
    return list(dict.fromkeys(row.method for row in rows if row.in_displacements))


def cheapest(rows: list[Row], level: float) -> Row | None:
    reach = [row for row in rows if row.error_total <= level]
    return min(reach, key=lambda row: row.time_s, default=None)


def with_knob(row: Row) -> str:
    """'3STEPD, contact sweeps 10'."""
    return f"{row.method}, {row.knob} {row.knob_value or 0:g}" if row.knob else row.method


def levels_table(rows: list[Row]) -> list[list[str]]:
    """Heads, and a line per error."""
    stress = [row for row in rows if not row.in_displacements]
    others = [row for row in rows if row.in_displacements]
    names = displacements_of(rows)
    lines = [["error at most", "cheapest method", *COSTS]]
    if names:
        lines[0] += [f"{names[0] if len(names) == 1 else 'displacements'}: mesh", *COSTS[1:]]
    for level in reversed(levels([row.error_total for row in rows])):
        best, other = cheapest(stress, level), cheapest(others, level)
        which = f"{other.method}, " if other and len(names) > 1 else ""
        lines.append([percent(level), with_knob(best) if best else "–", *costs(best),
                      *(costs(other, which) if names else [])])
    return lines


def costs(row: Row | None, which: str = "") -> list[str]:
    return [which + row.mesh, seconds(row.time_s), mebibytes(row.peak_heap_bytes)] if row \
        else ["–"] * 3


def draw(rows: list[Row]) -> Figure | str:
    known = known_of(rows)
    if not known:
        return "no row has time_s and an error_total up to 1"
    bodies = by_body(sorted(known, key=lambda row: row.n_phi))
    tables = {body: levels_table(of_body) for body, of_body in bodies.items()}
    kinds = [kind for kind in KINDS if kind in map(kind_of, known)]
    columns = [column for column in AXES if any(value_of(row, column) for row in known)]
    heights = {body: TOP + HEIGHT + BOTTOM + TABLE_LINE * (len(table) + 1)
               for body, table in tables.items()}
    figure = sheet(sum(heights.values()), "What a total error costs: method and mesh together",
                   caption(rows, known, kinds),
                   left_out(rows, known, lambda row: "in peers_penalty" if is_other_value(row) else
                            f"no total error up to {percent(highest_of(rows))}"),
                   lacking(known, {"peak heap": lambda row: row.peak_heap_bytes}))
    above = 0.0
    for body, of_body in bodies.items():
        errors = [row.error_total for row in of_body]
        text_at(figure, LEFT, above + TOP - 0.18, plain(body), va="baseline", fontsize=10,
                weight="bold")
        panels = side_by_side(figure, [""] * len(columns), LEFT, above + TOP, HEIGHT, GAP)
        for axes, column in zip(panels, columns):
            own = [row for row in of_body if value_of(row, column)]
            log_log(axes, xlabel=axis_label(column), ylim=(min(errors) / 1.25, max(errors) * 1.1),
                    xlim=log_limits([value_of(row, column) for row in own], 1.6))
            axes.grid(False)
            draw_panel(axes, own, column, kinds)
        panels[0].set_ylabel("total relative error of the stresses")
        draw_table(figure, above + TOP + HEIGHT + BOTTOM, tables[body])
        above += heights[body]
    return figure


def caption(rows: list[Row], known: list[Row], kinds: list[str]) -> str:
    names = displacements_of(known)
    others = ""
    if len(names) == 1:
        others = (f"The displacement method {names[0]} has its own curve; its error is that of the "
                  "mesh by definition. ")
    elif names:
        others = (f"The displacement methods {', '.join(names[:-1])} and {names[-1]} have their own "
                  "curves and errors. ")
    tuning = dict.fromkeys(row.family for row in known if row.iterative and given(row))
    tuned = f"; their time does not include the search for r and ρ of {' and '.join(tuning)}" if tuning else ""
    adapting = " Times do not include the adapting of a mesh." if "adapted" in kinds else ""
    highest = highest_of(rows)
    beyond = sum(bool(row.error_total and row.error_total > highest) for row in rows)
    cut = f" {beyond} solves with errors above {percent(highest)} are not drawn." \
        if beyond else ""
    points = grouped([row for row in known if not row.in_displacements], lambda row: row.method)
    methods = names_of([own[0] for own in points.values()])
    return (
        f"Scene {known[0].scene}, {threads(known)}. Total error: relative constitutive "
        "relation error of the mesh plus the method's own error of the stresses. Thick lines: the "
        "Pareto front of the stress methods on each kind of meshes: no cheaper solve has a smaller "
        "error, within 1 %; each method is named once, with its meshes on the front. Dotted: the "
        "discretisation error of meshes as they are, the least that a method can reach there. "
        f"{others}Small points: all solves of {methods}{tuned}.{adapting}{cut}")


def draw_panel(axes: Axes, rows: list[Row], column: str, kinds: list[str]) -> None:
    labels = Labels(axes)
    draw_floors(axes, [row for row in rows if kind_of(row) == "as they are"], labels)
    stress = [row for row in rows if not row.in_displacements]
    for row in stress:
        axes.plot(value_of(row, column), row.error_total, color=row.look.colour,
                  marker=row.look.marker, markersize=2.5, alpha=0.35, markeredgewidth=0, zorder=2)
    fronts = {kind: front([row for row in stress if kind_of(row) == kind], column, "error_total",
                          GAIN) for kind in kinds}
    for kind, best in fronts.items():
        if best:
            draw_front(axes, labels, line_of(best, column, "error_total"), best, kind)
    displacements = grouped(
        sorted((row for row in rows if row.in_displacements), key=lambda row: row.n_phi),
        lambda row: (displacements_of(rows).index(row.method), kinds.index(kind_of(row))))
    words = "" if len(displacements) > NAMED_IN_FULL else " displacements"
    for (_, k), own in sorted(displacements.items()):
        line, look = line_of(own, column, "error_total"), own[0].look
        axes.plot(*line, color=look.colour, marker=look.marker, markersize=8, linewidth=1.5,
                  zorder=5, linestyle=(0, (4, 1.5)), markeredgecolor="white", markeredgewidth=0.6)
        labels.avoid(*line)
        labels.add(f"{own[0].label}, {kinds[k]}" if len(kinds) > 1 else own[0].label + words, *line,
                   color=look.colour, **NAME)
    draw_stops(axes, labels, [row for row in stress if kind_of(row) == "as they are"], column)
    for name, own in grouped(fronts.get("as they are", []), lambda row: row.label).items():
        meshes = list(dict.fromkeys(row.mesh for row in sorted(own, key=lambda row: row.n_phi)))
        labels.add(f"{name}, {joined(meshes)}", *line_of(own[::-1], column, "error_total"),
                   weight="bold", color=own[0].look.colour)


def joined(meshes: list[str]) -> str:
    return meshes[0] if len(meshes) == 1 else f"{meshes[0]}..{meshes[-1]}"


def draw_front(axes: Axes, labels: Labels, line: tuple[list[float], list[float]], best: list[Row],
               kind: str) -> None:
    colour, width = KINDS[kind]
    axes.step(*line, where="post", color=colour, linewidth=width, alpha=0.85, zorder=4)
    labels.avoid(*line)
    for cost, row in zip(line[0], best):
        axes.plot(cost, row.error_total, color=row.look.colour, marker=row.look.marker,
                  markersize=8, markeredgecolor="white", markeredgewidth=0.7, zorder=6)
    if kind != "as they are":
        methods = " and ".join(dict.fromkeys(row.label for row in reversed(best)))
        labels.add(f"{kind}: {methods}", line[0][::-1], line[1][::-1], color=colour, **NAME)


def draw_floors(axes: Axes, rows: list[Row], labels: Labels) -> None:
    """The meshes' discretisation errors, of the lowest degree; close lines share a label."""
    right = axes.get_xlim()[1]
    floors = {row.mesh: row.error_discretisation for row in of_mesh(rows)}
    groups: list[list[str]] = []
    for mesh in sorted(floors, key=floors.get, reverse=True):
        axes.axhline(floors[mesh], color="0.55", linewidth=0.8, linestyle=(0, (1, 2)), zorder=1)
        high = labels.points(right, floors[groups[-1][0]])[0, 1] if groups else math.inf
        if high - labels.points(right, floors[mesh])[0, 1] < FLOOR_WORDS:
            groups[-1].append(mesh)
        else:
            groups.append([mesh])
    for group in groups:
        ends = [group[0], group[-1]] if len(group) > 1 else group
        words = f"{joined(ends)}: {' to '.join(percent(floors[mesh]) for mesh in ends)}"
        axes.annotate(plain(words), (1, floors[group[0]]), xytext=(-2, 1.5), ha="right",
                      xycoords=axes.get_yaxis_transform(), textcoords="offset points",
                      fontsize=7.5, color="0.35", zorder=9,
                      bbox=dict(facecolor="white", edgecolor="none", alpha=0.75, pad=0.3))
        labels.reserve(words, right, floors[group[0]], 7.5)


def draw_stops(axes: Axes, labels: Labels, rows: list[Row], column: str) -> None:
    stops = [row for row in rows if is_paper_stop(row) and not given(row)]
    for method, own in grouped(stops, lambda row: row.method).items():
        x, y = line_of(own, column, "error_total")
        for at in zip(x, y):
            axes.plot(*at, markerfacecolor=own[0].look.colour, **STOP | {"markersize": 12})
            labels.avoid(*at)
        labels.add(f"{method} with the paper's stop", x, y, color=own[0].look.colour, **NAME)


def draw_table(figure: Figure, top: float, table: list[list[str]]) -> None:
    widths = [max(width_of(cell, 8, "bold") for cell in column) / 72 for column in zip(*table)]
    gap = (PAGE_WIDTH - LEFT - 0.1 - sum(widths)) / (len(widths) - 1)
    for k, line in enumerate(table):
        left = LEFT
        for cell, width in zip(line, widths):
            text_at(figure, left, top + k * TABLE_LINE, plain(cell), fontsize=8,
                    weight="bold" if k == 0 else "normal")
            left += width + min(gap, 0.35)
