"""Discretisation error against the mesh size, and the bounds of the energy."""
import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import cycle

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import PAGE_WIDTH, Drawing, axes_at, log_limits, log_log, panel_at, sheet
from labels import Labels
from records import Row
from selection import by_body, by_mesh, exponent, of_mesh, scene_of
from words import axis_label, columns_of, csv_of, percent, plain

LEFT, TOP, HEIGHT, BELOW, BOTTOM, GAP = 0.72, 0.4, 3.8, 2.6, 0.55, 0.85  # inches
TITLE = 0.3  # over the bounds
SIDE_BY_SIDE = 2  # bodies with bounds
MARKS = (("#0072B2", "o"), ("#D55E00", "s"), ("#00805C", "^"), ("#8A3FA0", "D"), ("#C98500", "v"),
         ("#56B4E9", "P"), ("#777777", "X"))  # of the bodies, in turn
H = r"$n_\varphi^{-1/2}$, proportional to the mesh size h"


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = [row for row in rows if row.points == "accuracy"]
    if study:
        yield Drawing("convergence", study, draw, table_of)


def table_of(rows: list[Row]) -> str:
    """Of the scene drawn, then of that of the bounds, if it is another. rate: of the body."""
    lines = [(point, rate(points))
             for scene in dict.fromkeys([scene_of(rows), bounded_of(rows)[0] or scene_of(rows)])
             for points in points_of(rows, scene).values() for point in points]
    return csv_of(lines, *columns_of(lambda line: line[0], "scene", "body", "mesh", "n_phi",
                                     "error_discretisation", "lower_bound_Nmm", "upper_bound_Nmm"),
                  ("rate", lambda line: line[1]))


def points_of(rows: list[Row], scene: str) -> dict[str, list[Row]]:
    """Body -> a row per mesh, the coarsest first. The error is of mesh and scene."""
    known = of_mesh([row for row in rows if row.scene == scene and row.n_phi])
    points = []
    for own in by_mesh(known).values():
        bounded = [row for row in own if None not in (row.lower_bound_Nmm, row.upper_bound_Nmm)]
        error = float(np.median([row.error_discretisation for row in own]))
        bounds = {} if bounded else dict(lower_bound_Nmm=None, upper_bound_Nmm=None)
        points.append(replace((bounded or own)[0], error_discretisation=error, **bounds))
    return by_body(points)


def line_of(points: list[Row]) -> tuple[list[float], list[float]]:
    """h ~ n_phi^-1/2, relative error."""
    return [1 / math.sqrt(p.n_phi) for p in points], [p.error_discretisation for p in points]


def rate(points: list[Row]) -> float | None:
    """p of error ~ h^p by least squares of logarithms; needs two meshes."""
    return exponent(*line_of(points), least=2)


def fitted(points: list[Row]) -> tuple[np.ndarray, np.ndarray]:
    h, errors = map(np.array, line_of(points))
    power = rate(points)
    ends = np.array([h.min(), h.max()])
    return ends, np.exp(np.mean(np.log(errors) - power * np.log(h))) * ends**power


def bounded_of(rows: list[Row]) -> tuple[str, dict[str, list[Row]]]:
    """The scene to draw, else the first that has bounds, and its bodies with bounds on two meshes
    or more."""
    scenes = sorted({row.scene for row in rows})
    for scene in sorted(scenes, key=lambda scene: scene != scene_of(rows)):
        known = {body: [point for point in points if point.lower_bound_Nmm is not None]
                 for body, points in points_of(rows, scene).items()}
        known = {body: points for body, points in known.items() if len(points) > 1}
        if known:
            return scene, known
    return "", {}


def draw(rows: list[Row]) -> Figure | str:
    scene = scene_of(rows)
    bodies = points_of(rows, scene)
    if sum(map(len, bodies.values())) < 2:
        return "fewer than two meshes have error_discretisation"
    bounded_scene, bounded = bounded_of(rows)
    below = TITLE + BELOW + BOTTOM
    figure = sheet(
        TOP + HEIGHT + BOTTOM + below * math.ceil(len(bounded) / SIDE_BY_SIDE),
        "Discretisation error",
        f"Scene {scene}. Relative constitutive relation error between the equilibrated "
        "stresses and the compatible P2 displacements on the same mesh. h^p: power law fitted by "
        "least squares of logarithms."
        + (f" Below: scene {bounded_scene}; the bounds of the energy are guaranteed where there is "
           "no friction." if bounded else ""))
    marks = dict(zip(dict.fromkeys([*bodies, *bounded]), cycle(MARKS)))  # colour and marker
    draw_errors(panel_at(figure, LEFT, TOP, PAGE_WIDTH - LEFT - 0.15, HEIGHT), bodies, marks)
    columns = min(len(bounded), SIDE_BY_SIDE)
    for k, (body, points) in enumerate(bounded.items()):
        width = (PAGE_WIDTH - 0.15 - GAP * columns) / columns
        axes = axes_at(figure, GAP + k % columns * (GAP + width), TOP + HEIGHT + BOTTOM + TITLE
                       + below * (k // columns), width, BELOW)
        draw_bounds(axes, body, points, marks[body][0])
    return figure


def draw_errors(axes: Axes, bodies: dict[str, list[Row]],
                marks: dict[str, tuple[str, str]]) -> None:
    h, errors = line_of([point for points in bodies.values() for point in points])
    log_log(axes, xlim=log_limits(h, 1.25), ylim=log_limits(errors, 1.4), xlabel=H,
            ylabel=f"relative {axis_label('error_discretisation')}")
    labels = Labels(axes)
    for points in bodies.values():
        labels.avoid(*line_of(points))
        if rate(points):
            labels.avoid(*fitted(points))
    for body, points in bodies.items():
        colour, marker = marks[body]
        h, errors = line_of(points)
        power = rate(points)
        axes.plot(h, errors, color=colour, marker=marker, markersize=6,
                  linestyle="none" if power else "-")
        words = plain(body)
        if power:
            axes.plot(*fitted(points), color=colour, linewidth=1.2, zorder=1.5)
            words += f": $h^{{{power:.2f}}}$"
        for point, *at in zip(points, h, errors):
            labels.add(f"{point.mesh}, {percent(point.error_discretisation)}", *at, color="0.25")
        middle = len(points) // 2
        labels.add(words, h[middle:] + h[:middle], errors[middle:] + errors[:middle],
                   formula=True, color=colour, fontsize=10)


def draw_bounds(axes: Axes, body: str, points: list[Row], colour: str) -> None:
    h, _ = line_of(points)
    lower, upper = zip(*((point.lower_bound_Nmm, point.upper_bound_Nmm) for point in points))
    axes.set_xlim(0, 1.25 * max(h))
    axes.fill_between(h, lower, upper, color=colour, alpha=0.15, linewidth=0)
    axes.plot(h, upper, color=colour, marker="v", label="upper bound")
    axes.plot(h, lower, color=colour, marker="^", linestyle=(0, (4, 1.5)), label="lower bound")
    axes.margins(y=0.12)
    axes.legend(frameon=False, loc="best")
    axes.set(xlabel=r"$n_\varphi^{-1/2}$", ylabel="energy, N mm/mm",
             title=f"bounds of the energy, {plain(body)}")
    axes.ticklabel_format(axis="y", useOffset=False)
    axes.spines[["top", "right"]].set_visible(False)
