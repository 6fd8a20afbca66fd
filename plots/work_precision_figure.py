"""Error of the contact forces against time and memory: what each method pays for each digit."""
from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import study_parts as parts
from direct_labels import Labels
from figure_parts import axes_at, log_axis, log_limits
from figure_words import short
from results_table import Row

WIDTH, LEFT, TOP, PANELS, HEIGHT, GAP, BOTTOM = 11.5, 0.72, 0.35, (6.6, 3.6), 5.6, 0.42, 0.5
HIGHEST = 1e3  # errors above are drawn here
SIZE = 4.5
AXES = {"time_s": "time of one solve, s", "peak_heap_bytes": "peak heap, MiB"}


def is_paper_stop(row: Row) -> bool:
    return row.stop == "paper" and parts.family(row.method) == "ALM"


def stops_shown(rows: list[Row]) -> list[Row]:
    """ALM with the paper's stop: as the grid chose r and rho; else what was given, the worst
    first."""
    stops = [row for row in rows if is_paper_stop(row) and row.error_force and row.time_s]
    own = [row for row in stops if row.method == "ALM"]
    return own or sorted(stops, key=lambda row: -row.error_force)


def curves_of(rows: list[Row]) -> dict[str, list[Row]]:
    """Method -> its points in the order of the knob, by family."""
    curves: dict[str, list[Row]] = {}
    for row in sorted(rows, key=lambda row: (parts.order(row.method), row.knob,
                                             row.knob_value or 0)):
        if not is_paper_stop(row) and row.method != parts.DISPLACEMENTS:
            curves.setdefault(row.method, []).append(row)
    return curves


def draw(rows: list[Row]) -> Figure | str:
    """rows: of an error study's mesh and scene. The figure, or why there is none."""
    known = [row for row in rows if row.time_s and row.error_force is not None
             and row.method != parts.DISPLACEMENTS]
    if not known:
        return "no row has time_s and error_force"
    curves, stops = curves_of(known), stops_shown(known)
    heap = any(row.peak_heap_bytes for row in known)
    absent = [f"{row.method} ({row.status_words()})" for row in rows
              if row not in known and row.method != parts.DISPLACEMENTS]
    target = next((row.target_error for row in known if row.target_error), 1e-6)
    knobs = sorted({row.knob for row in known if row.knob})
    figure = parts.sheet(WIDTH, TOP + HEIGHT + BOTTOM, [
        f"{known[0].mesh}, {known[0].n_phi} degrees of freedom, scene {known[0].scene}, "
        f"{parts.threads(known)}. Error of the contact forces against the "
        "reference, a point per solve. Joined: one iterative method with its knob turned"
        + (f" ({', '.join(knobs)})" if knobs else "") + "; single points: direct methods. "
        f"Dashed line: the target error {short(target)}."
        + (" Pink ring: the method said it had succeeded, but an error is above the target."
           if any(row.outcome == "wrong_success" for row in known) else "")
        + (f" Errors of 0 and below {short(1e-18)} are drawn at the lower edge."
           if any(row.error_force < 1e-18 for row in known) else ""),
        f"No point: {'; '.join(dict.fromkeys(absent))}." if absent else ""])
    figure.text(parts.MARGIN / WIDTH, 1 - 0.08 / figure.get_size_inches()[1], va="top",
                s=f"{known[0].mesh}: what each digit costs", fontsize=11, weight="bold")
    floor = parts.error_floor(row.error_force for row in known)
    left = LEFT
    for column, width in zip(AXES if heap else ["time_s"], PANELS):
        axes = axes_at(figure, left, TOP, width if heap else sum(PANELS), HEIGHT)
        draw_panel(axes, column, curves, stops, floor, target)
        left += width + GAP
    return figure


def value_of(row: Row, column: str) -> float | None:
    value = getattr(row, column)
    return value / 2**20 if value and column == "peak_heap_bytes" else value


def draw_panel(axes: Axes, column: str, curves: dict[str, list[Row]], stops: list[Row],
               floor: float, target: float) -> None:
    shown = {method: [row for row in curve if value_of(row, column)]
             for method, curve in curves.items()}
    rows = [row for curve in [*shown.values(), stops] for row in curve if value_of(row, column)]
    highest = min(max([row.error_force for row in rows] + [target]), HIGHEST)
    axes.set(xscale="log", yscale="log", xlabel=AXES[column], ylim=(floor / 2, 4 * highest),
             xlim=log_limits([value_of(row, column) for row in rows], 1.7))
    log_axis(axes.xaxis)
    log_axis(axes.yaxis)
    axes.grid(axis="both")
    axes.spines[["top", "right"]].set_visible(False)
    axes.axhline(target, color="0.25", linewidth=0.9, linestyle=(0, (5, 3)), zorder=2)
    first = column == "time_s"
    labels = Labels(axes)
    labels.avoid(axes.get_xlim(), [target] * 2)
    if first:
        axes.set_ylabel("relative error of the contact forces, 1")
    else:
        axes.tick_params(labelleft=False)
    ends = {}
    for method, curve in shown.items():
        if not curve:
            continue
        colour, marker = parts.style(method)
        x = [value_of(row, column) for row in curve]
        y = [min(max(row.error_force, floor), HIGHEST) for row in curve]
        axes.plot(x, y, color=colour, marker=marker, markersize=SIZE if len(curve) > 1 else 7,
                  linewidth=1.1, linestyle=parts.dashes(method), markeredgecolor="white", markeredgewidth=0.4, zorder=4)
        wrong = [k for k, row in enumerate(curve) if row.outcome == "wrong_success"]
        axes.plot([x[k] for k in wrong], [y[k] for k in wrong], "o", markersize=11,
                  markerfacecolor="none", markeredgecolor=parts.ALARM, markeredgewidth=1.4)
        labels.avoid(x, y)
        ends[method] = sorted(zip(y, x))
    draw_stops(axes, labels, stops, column)
    for method, points in ends.items():
        y, x = zip(*points)
        labels.add(method, x, y, color=parts.style(method)[0] if len(points) > 1 else "0.1")


def draw_stops(axes: Axes, labels: Labels, stops: list[Row], column: str) -> None:
    """Big marks, the first with the words of what the stop costs."""
    stops = [row for row in stops if value_of(row, column)]
    for row in stops:
        at = value_of(row, column), min(row.error_force, HIGHEST)
        axes.plot(*at, markerfacecolor=parts.style("ALM")[0], **parts.STOP)
        for dx in (-6, 0, 6):
            labels.obstacles.append(labels.points(*at) + [dx, 0])
    if stops and column == "time_s":
        errors = [row.error_force for row in stops]
        words = f"error {parts.percent(max(errors))}" if len(stops) == 1 else \
            f"error {parts.percent(min(errors))} to {parts.percent(max(errors))}"
        labels.add(f"ALM with the paper's stop:\n{words}", value_of(stops[0], column),
                   min(errors[0], HIGHEST), weight="bold", fontsize=9,
                   color=parts.style("ALM")[0])

