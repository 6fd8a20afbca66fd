"""Total error, of the discretisation and of the method together, against time and memory."""
from __future__ import annotations

import math
from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import study_parts as parts
from direct_labels import Labels
from figure_files import Drawing
from figure_parts import axes_at, log_limits, log_log
from figure_words import plain
from record_keys import Row
from selection import by_body, given, grouped, is_paper_stop, kind_of, of_scene
from work_precision_figure import AXES, curves_of, value_of

WIDTH, LEFT, TOP, HEIGHT, GAP, BETWEEN = 11.5, 0.72, 0.65, 4.4, 0.3, 0.5
SIDE_BY_SIDE = 2  # bodies
TABLE_LINE = 0.19  # inches: a line of the table
HIGHEST = 1.0  # total errors above are not drawn: nothing of such an answer is right
GAIN = 0.01  # of the error: less is not worth a point of the front
STEPS = (1, 1.5, 2, 3, 5, 7)  # levels, times powers of ten
LEVELS = 7  # lines of a table at most
TABLE = ("total error at most", "cheapest method", "mesh", "time", "peak heap",
         "displacements: mesh", "time", "peak heap")
TABLE_AT = (0.0, 0.13, 0.39, 0.5, 0.58, 0.67, 0.84, 0.92)  # of the sheet's width
FLOOR_WORDS = 11  # points, between words of two floors
# Kinds of meshes: colour and width of their fronts.
KINDS = {"as they are": ("black", 2.2), "refined everywhere": ("#6B6B80", 1.8),
         "adapted": ("#B00020", 2.6)}  # as kind_of() says


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = of_scene([row for row in rows if row.study == "error"])
    if study:
        levels_of = [row for row in rows if row.study == "" and row.adapt_level is not None
                     and row.scene == study[0].scene]
        yield Drawing("pareto", study + levels_of, draw)


def front(rows: list[Row], column: str) -> list[Row]:
    """Those that no cheaper one equals in total error, the cheapest first; GAIN is no gain."""
    found: list[Row] = []
    for row in sorted((row for row in rows if value_of(row, column)),
                      key=lambda row: (value_of(row, column), row.error_total)):
        if not found or row.error_total < (1 - GAIN) * found[-1].error_total:
            found.append(row)
    return found


def levels(errors: list[float]) -> list[float]:
    """Round ones that can be reached, up to the largest error: at most LEVELS, the smallest."""
    low, high = min(errors), max(errors)
    found = [float(f"{m * 10.0**k:.2g}") for k in range(math.floor(math.log10(low)), 2)
             for m in STEPS]
    found = [level for level in found if level >= low]
    return [level for level in found if level <= max(high, found[0])][:LEVELS]


def displacements_of(rows: list[Row]) -> list[str]:
    """Methods."""
    return list(dict.fromkeys(row.method for row in rows if row.in_displacements))


def cheapest(rows: list[Row], level: float) -> Row | None:
    """In time."""
    reach = [row for row in rows if row.error_total <= level]
    return min(reach, key=lambda row: row.time_s, default=None)


def with_knob(row: Row) -> str:
    """'3STEPD, contact sweeps 10'."""
    return f"{row.method}, {row.knob} {row.knob_value or 0:g}" if row.knob else row.method


def table_of(rows: list[Row]) -> list[tuple[str, ...]]:
    """Cells of TABLE for each level, the largest error first."""
    stress = [row for row in rows if not row.in_displacements]
    lines = []
    for level in reversed(levels([row.error_total for row in rows])):
        cells = [parts.percent(level)]
        for best, named in ((cheapest(stress, level), True),
                            (cheapest([row for row in rows if row.in_displacements], level),
                             False)):
            own = [with_knob(best) if best else "–"] if named else []
            cells += own + ([best.mesh, parts.seconds(best.time_s),
                             parts.mebibytes(best.peak_heap_bytes)] if best else ["–"] * 3)
        lines.append(tuple(cells))
    return lines


def draw(rows: list[Row]) -> Figure | str:
    """rows: of an error study's scene. The figure, or why there is none."""
    known = [row for row in rows if row.time_s and row.error_total and row.error_total <= HIGHEST]
    if not known:
        return "no row has time_s and an error_total up to 1"
    bodies = by_body(sorted(known, key=lambda row: row.n_phi))
    tables = {body: table_of(of_body) for body, of_body in bodies.items()}
    kinds = [kind for kind in KINDS if kind in map(kind_of, known)]
    columns = [column for column in AXES if any(value_of(row, column) for row in known)]
    block = TOP + len(columns) * (HEIGHT + BETWEEN)  # of as many bodies as stand side by side
    over = block * math.ceil(len(bodies) / SIDE_BY_SIDE)
    heights = {body: 0.2 + TABLE_LINE * (len(table) + 1.5) for body, table in tables.items()}
    names = displacements_of(known)
    others = (f"The displacement method {' and '.join(names)} has its own curve; by definition it "
              "has the mesh's error. ") if names else ""
    tuning = dict.fromkeys(row.family for row in known if row.iterative and given(row))
    tuned = f"; finding r and ρ of {' and '.join(tuning)} is not in the time" if tuning else ""
    adapting = " The time of adapting a mesh is not in these times." if "adapted" in kinds else ""
    figure = parts.sheet(WIDTH, over + sum(heights.values()) + 0.3,
                         "What a total error costs: method and mesh together", [
        f"Scene {known[0].scene}, {parts.threads(known)}. Total error: relative constitutive "
        "relation error of the mesh plus the method's own error of the stresses. Thick lines: the "
        "Pareto front of the stress methods on each kind of meshes: nothing cheaper has its error, "
        "give or take 1 %. Dotted: the discretisation error of meshes as they are, the lowest that "
        "a method can reach there; a method's curve ends there however many more digits it "
        f"computes. {others}Small points: all solves{tuned}.{adapting}"])
    beside = min(len(bodies), SIDE_BY_SIDE)
    panel = (WIDTH - LEFT - 0.1 - (beside - 1) * GAP) / beside
    errors = [row.error_total for row in known]
    for k, (body, of_body) in enumerate(bodies.items()):
        place, above = k % beside, block * (k // beside) + TOP
        left = LEFT + place * (panel + GAP)
        figure.text(left / WIDTH, 1 - (above - 0.18) / figure.get_size_inches()[1], plain(body),
                    fontsize=10, weight="bold")
        for j, column in enumerate(columns):
            axes = axes_at(figure, left, above + j * (HEIGHT + BETWEEN), panel, HEIGHT)
            own = [row for row in of_body if value_of(row, column)]
            log_log(axes, xlabel=AXES[column], ylim=(min(errors) / 1.25, max(errors) * 1.25),
                    xlim=log_limits([value_of(row, column) for row in own], 1.6))
            axes.spines[["top", "right"]].set_visible(False)
            if place == 0:
                axes.set_ylabel("total relative error of the stresses, 1")
            else:
                axes.tick_params(labelleft=False)
            draw_panel(axes, own, column, kinds)
    top = over + 0.1
    for body, table in tables.items():
        figure.text(LEFT / WIDTH, 1 - (top + 0.1) / figure.get_size_inches()[1], plain(body),
                    fontsize=8, style="italic")
        draw_table(figure, top + 0.2, displacements_of(bodies[body]), table)
        top += heights[body]
    return figure


def draw_panel(axes: Axes, rows: list[Row], column: str, kinds: list[str]) -> None:
    labels = Labels(axes)
    draw_floors(axes, [row for row in rows if kind_of(row) == "as they are"], labels)
    stress = [row for row in rows if not row.in_displacements]
    for mesh in dict.fromkeys(row.mesh for row in stress):
        for curve in curves_of([row for row in stress if row.mesh == mesh]).values():
            look = curve[0].look
            axes.plot([value_of(row, column) for row in curve], [row.error_total for row in curve],
                      color=look.colour, marker=look.marker, markersize=3, linewidth=0.7, alpha=0.3,
                      linestyle=look.dashes, zorder=2)
    fronts = {kind: front([row for row in stress if kind_of(row) == kind], column)
              for kind in kinds}
    for kind, best in fronts.items():
        draw_front(axes, labels, best, column, kind if len(kinds) > 1 else "")
    for method in displacements_of(rows):
        for kind in kinds:
            own = [row for row in rows if row.method == method and kind_of(row) == kind]
            if own:
                draw_displacements(axes, labels, sorted(own, key=lambda row: row.n_phi), column,
                                   kind if len(kinds) > 1 else "")
    draw_stops(axes, labels, [row for row in stress if kind_of(row) == "as they are"], column)
    named: set[tuple[str, str]] = set()
    for row in reversed(fronts.get("as they are", [])):  # the lowest of a method on a mesh
        if (row.method, row.mesh) not in named:
            labels.add(f"{row.method}, {row.mesh}", value_of(row, column), row.error_total,
                       weight="bold", color=row.look.colour)
        named.add((row.method, row.mesh))


def draw_front(axes: Axes, labels: Labels, best: list[Row], column: str, name: str) -> None:
    if not best:
        return
    colour, width = KINDS[name or "as they are"]
    line = [value_of(row, column) for row in best], [row.error_total for row in best]
    axes.step(*line, where="post", color=colour, linewidth=width, alpha=0.85, zorder=4)
    labels.avoid(*line)
    for row in best:
        axes.plot(value_of(row, column), row.error_total, color=row.look.colour,
                  marker=row.look.marker, markersize=8, markeredgecolor="white",
                  markeredgewidth=0.7, zorder=6)
    if name and name != "as they are":
        methods = " and ".join(dict.fromkeys(row.method for row in reversed(best)))
        labels.add(f"{name}: {methods}", line[0][::-1], line[1][::-1], color=colour,
                   weight="bold", fontsize=8.5)


def draw_floors(axes: Axes, rows: list[Row], labels: Labels) -> None:
    """The meshes' discretisation errors; those that are too near to each other share their words."""
    floors = {row.mesh: row.error_discretisation for row in rows if row.error_discretisation}
    groups: list[list[str]] = []
    for mesh in sorted(floors, key=floors.get, reverse=True):
        axes.axhline(floors[mesh], color="0.55", linewidth=0.8, linestyle=(0, (1, 2)), zorder=1)
        high = labels.points(axes.get_xlim()[1], floors[groups[-1][0]])[0, 1] if groups else math.inf
        if high - labels.points(axes.get_xlim()[1], floors[mesh])[0, 1] < FLOOR_WORDS:
            groups[-1].append(mesh)
        else:
            groups.append([mesh])
    for group in groups:
        ends = [group[0], group[-1]] if len(group) > 1 else group
        words = f"{'..'.join(ends)}: {' to '.join(parts.percent(floors[mesh]) for mesh in ends)}"
        at = floors[group[0]]
        axes.annotate(plain(words), (1, at), xytext=(-2, 1.5), ha="right",
                      xycoords=axes.get_yaxis_transform(), textcoords="offset points",
                      fontsize=7.5, color="0.35", zorder=9,
                      bbox=dict(facecolor="white", edgecolor="none", alpha=0.75, pad=0.3))
        labels.reserve(words, axes.get_xlim()[1], at, 7.5)


def draw_displacements(axes: Axes, labels: Labels, rows: list[Row], column: str,
                       kind: str) -> None:
    colour, marker, *_ = rows[0].look
    line = [value_of(row, column) for row in rows], [row.error_total for row in rows]
    axes.plot(*line, color=colour, marker=marker, markersize=8, linewidth=1.5, zorder=5,
              linestyle=(0, (4, 1.5)), markeredgecolor="white", markeredgewidth=0.6)
    labels.avoid(*line)
    words = f"{rows[0].method}, {kind}" if kind else f"{rows[0].method} displacements"
    labels.add(words, *line, color=colour, weight="bold",
               fontsize=8.5)


def draw_stops(axes: Axes, labels: Labels, rows: list[Row], column: str) -> None:
    """Methods that chose r and rho, ended by the paper's stop, on each mesh."""
    stops = [row for row in rows if is_paper_stop(row) and not given(row)]
    for method, own in grouped(stops, lambda row: row.method).items():
        x, y = [value_of(row, column) for row in own], [row.error_total for row in own]
        for at in zip(x, y):
            axes.plot(*at, markerfacecolor=own[0].look.colour, **parts.STOP | {"markersize": 12})
            labels.avoid(*at)
        labels.add(f"{method} with the paper's stop", x, y, color=own[0].look.colour,
                   weight="bold", fontsize=8.5)


def draw_table(figure: Figure, top: float, displacements: list[str],
               lines: list[tuple[str, ...]]) -> None:
    height = figure.get_size_inches()[1]
    heads = [f"{'/'.join(displacements)} {head}" if head.startswith("displ") else head
             for head in TABLE]
    for k, line in enumerate([heads, *lines]):
        for at, cell in zip(TABLE_AT if displacements else TABLE_AT[:5], line):
            figure.text((LEFT + at * (WIDTH - LEFT)) / WIDTH, 1 - (top + k * TABLE_LINE) / height,
                        plain(cell), va="top", fontsize=8, weight="bold" if k == 0 else "normal")
