"""Error of the contact forces against time and memory: what each method pays for each digit."""
from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import STOP, Drawing, error_floor, file_name, log_limits, log_log, panel_at, sheet
from labels import Labels
from records import Row
from selection import (by_mesh, front, given, grouped, is_paper_stop, of_scene, order,
                       value_of)
from words import CASE, KNOB, axis_label, csv_of, lacking, percent, short, threads, unseen

LEFT, TOP, PANELS, HEIGHT, GAP, BOTTOM = 0.72, 0.35, (4.75, 2.45), 5.0, 0.28, 0.5  # inches
HIGHEST = 1e3  # errors above are drawn here
SIZE = 4.5
GREY = "0.78"  # curves of parameters, behind the best of their family
AXES = ("time_s", "peak_heap_bytes")


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = of_scene([row for row in rows if row.points == "accuracy"])
    for mesh, own in by_mesh(study).items():
        yield Drawing(file_name("work_precision", mesh), own, draw, table_of)


def table_of(rows: list[Row]) -> str:
    """on_envelope: of a family with given parameters, this row is among the best in time."""
    known = known_of(rows)
    best = {row.line for own in families_of(curves_of(known)).values()
            for row in front(own, "time_s", "error_force")}
    return csv_of(known, *CASE, *KNOB, "time_s", "peak_heap_bytes", "error_force",
                  ("on_envelope", lambda row: row.line in best))


def known_of(rows: list[Row]) -> list[Row]:
    return [row for row in rows if row.time_s and row.error_force is not None
            and not row.in_displacements]


def families_of(curves: dict[tuple[str, str], list[Row]]) -> dict[str, list[Row]]:
    """Family -> all points of its methods with given parameters, where there are two or more."""
    given_ones = grouped([row for curve in curves.values() for row in curve if given(row)],
                         lambda row: row.family)
    return {family: own for family, own in given_ones.items()
            if len({row.method for row in own}) > 1}


def curves_of(rows: list[Row]) -> dict[tuple[str, str], list[Row]]:
    """Method and knob -> points in the order of the knob, by family; without the paper's stop."""
    shown = [row for row in rows if not is_paper_stop(row) and not row.in_displacements]
    shown.sort(key=lambda row: (order(row), row.knob, row.knob_value or 0))
    return grouped(shown, lambda row: (row.method, row.knob))


def caption(rows: list[Row], known: list[Row], floor: float, target: float) -> Iterator[str]:
    knobs = sorted({row.knob for row in known if row.knob})
    words = (f"{known[0].mesh}, {known[0].n_phi} degrees of freedom, scene {known[0].scene}, "
             f"{threads(known)}. Error of the contact forces against the reference, a point "
             f"per solve. Joined: a method at several values of a parameter ({', '.join(knobs) or 'none'}); "
             f"single points: methods without one. Dashed: the target error {short(target)}.")
    for family, own in families_of(curves_of(known)).items():
        words += (f" {family}, thick: the best of its {len({row.method for row in own})} given r "
                  "and ρ, known only afterwards; grey: each of them.")
    stops = grouped([row for row in known if is_paper_stop(row)], lambda row: row.family)
    if stops:
        words += (f" Stars: {' and '.join(stops)} ended by the paper's stop; small "
                  "stars: with given r and ρ.")
    if any(row.error_force < floor for row in known):
        words += " Errors of 0 are drawn at the lower edge."
    yield words
    yield from unseen(rows, known, lambda row: "in displacements, which have other contact forces"
                      if row.in_displacements else "no error of the contact forces")
    yield lacking(known, {"peak heap": lambda row: row.peak_heap_bytes})


def draw(rows: list[Row]) -> Figure | str:
    known = known_of(rows)
    if not known:
        return "no row has time_s and error_force"
    floor = error_floor(row.error_force for row in known)
    target = next((row.target_error for row in known if row.target_error), 1e-6)
    figure = sheet(TOP + HEIGHT + BOTTOM, f"{known[0].mesh}: what each digit costs",
                   *caption(rows, known, floor, target))
    columns = [column for column in AXES if any(getattr(row, column) for row in known)]
    widths = PANELS if len(columns) > 1 else [sum(PANELS)]
    for k, (column, width) in enumerate(zip(columns, widths)):
        axes = panel_at(figure, LEFT + k * (PANELS[0] + GAP), TOP, width, HEIGHT)
        draw_panel(axes, column, [row for row in known if value_of(row, column)], floor, target)
    return figure


def draw_panel(axes: Axes, column: str, rows: list[Row], floor: float, target: float) -> None:
    def line_of(points: list[Row]) -> tuple[list[float], list[float]]:
        return ([value_of(row, column) for row in points],
                [min(max(row.error_force, floor), HIGHEST) for row in points])

    curves = curves_of(rows)
    highest = min(max([row.error_force for row in rows] + [target]), HIGHEST)
    log_log(axes, xlabel=axis_label(column), ylim=(floor / 2, 4 * highest),
            xlim=log_limits([value_of(row, column) for row in rows], 1.7))
    axes.axhline(target, color="0.25", linewidth=0.9, linestyle=(0, (5, 3)), zorder=2)
    first = column == "time_s"
    axes.set_ylabel(f"relative {axis_label('error_force')}" if first else "")
    axes.tick_params(labelleft=first)
    labels = Labels(axes)
    labels.avoid(axes.get_xlim(), [target] * 2)
    families = families_of(curves)
    ends: dict[str, tuple[list[tuple[float, float]], Row]] = {}
    for (method, knob), curve in curves.items():
        look, behind = curve[0].look, given(curve[0]) and curve[0].family in families
        x, y = line_of(curve)
        axes.plot(x, y, color=GREY if behind else look.colour, marker=look.marker,
                  markersize=2.5 if behind else SIZE if knob else 7,
                  linewidth=0.7 if behind else 1.2, linestyle=look.dashes,
                  markeredgecolor="white", markeredgewidth=0 if behind else 0.4,
                  zorder=1.5 if behind else 4 if knob else 5)
        if not behind:
            labels.avoid(x, y)
            ends.setdefault(method, (sorted(zip(y, x)), curve[0]))  # without knob first
    best = {family: front(own, column, "error_force") for family, own in families.items()}
    for points in best.values():
        look, (x, y) = points[0].look, line_of(points)
        axes.step(x, y, where="post", color=look.colour, linewidth=2, zorder=4)
        axes.plot(x, y, color=look.colour, marker=look.marker, linestyle="none",
                  markersize=SIZE, markeredgecolor="white", markeredgewidth=0.4, zorder=4)
        labels.avoid(x, y)
    draw_stops(axes, labels, [row for row in rows if is_paper_stop(row)], column)
    for family, points in best.items() if first else ():
        labels.add(f"{family}, best of given r, ρ", *line_of(points[::-1]), weight="bold",
                   color=points[0].look.colour)
    for method, (points, row) in ends.items():
        if not first and given(row) and row.family in ends:
            continue  # its memory is that of the method that chooses r and rho
        y, x = zip(*points)
        labels.add(row.label, x, y, color=row.look.colour if len(points) > 1 else "0.1")


def draw_stops(axes: Axes, labels: Labels, stops: list[Row], column: str) -> None:
    """Large marks where ALM chose r and rho, labelled with the error of the stop; small ones where they
    were given."""
    for row in stops:
        at = value_of(row, column), min(row.error_force, HIGHEST)
        size = STOP["markersize"] * (0.6 if given(row) else 1)
        axes.plot(*at, markerfacecolor=row.look.colour, **STOP | {"markersize": size})
        labels.obstacles.append(labels.points(*at) + [[-4, 0], [0, 0], [4, 0]])
    families = grouped(stops, lambda row: row.family) if column == "time_s" else {}
    for family, own in families.items():
        shown = [row for row in own if not given(row)] or own
        errors = [row.error_force for row in shown]
        words = percent(max(errors))
        if len(shown) > 1:
            words = f"{percent(min(errors))} to {words}"
        labels.add(f"{family} with the paper's stop:\nerror {words}",
                   [value_of(row, column) for row in shown],
                   [min(error, HIGHEST) for error in errors], weight="bold", fontsize=8.5,
                   color=shown[0].look.colour)
