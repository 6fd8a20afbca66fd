"""Lays out one solution: the body, and below or next to it its contact faces, enlarged. In inches."""
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import Bbox

import field_drawing as drawing
from drawing import bar_below
from fields import BY_LENGTH, Fields, between, unrolled
from words import columns_of, csv_of, plain

TITLE, GAP, TRACTION, LABELS, LEFT, RIGHT = 0.26, 0.2, 0.75, 0.42, 0.5, 0.26
SCALE = 0.3  # of a body, below it
NARROWEST = 1.5  # a face
ROOM_FOR_WORDS = 2.7  # of its whole axis label
MARKERS = 0.2  # below a face, for its contact points
MARKER_PT = 4.5  # at most
MARGIN = 0.04  # around a body, of its extent in y
BEHIND, BESIDE = 0.1, 0.03  # the body behind a face and the space at its ends, of its length
TALL, HIGHEST = 1.4, 5.6  # height over width of a body with its faces next to it; its height
LOW_TRACTION = 0.5  # of such a face

AddAxes = Callable[..., Axes]  # left, top, width, height; limits


def view_of(s: Fields) -> Bbox:
    """Limits of a body's axes, mm."""
    low, high = s.boundary.min(axis=(0, 1)), s.boundary.max(axis=(0, 1))
    margin = MARGIN * (high - low)[1] + (drawing.MOVED * drawing.size_of(s) if s.moved is not None else 0)
    return Bbox([low - margin, high + margin])


def slenderness(s: Fields) -> float:
    return view_of(s).height / view_of(s).width


def label_body(axes: Axes, x: str = "x, mm", y: str = "y, mm") -> None:
    axes.tick_params(length=2)
    axes.set_ylabel(y, labelpad=2)
    axes.set_xlabel(x, labelpad=1)
    axes.spines[:].set_visible(False)


def body_height(s: Fields, width: float) -> float:
    return (width - LEFT - RIGHT) * slenderness(s)


def width_of(s: Fields, body: float) -> float:
    return body / body_height(s, 1 + LEFT + RIGHT) + LEFT + RIGHT


@dataclass(frozen=True)
class Place:
    """Of a contact face: from the panel's left and upper edge."""

    left: float
    top: float
    width: float
    strip: float     # height of its elements and points
    traction: float  # and of its pressure, below
    named: bool      # the pressure's axis has its words


@dataclass(frozen=True)
class Layout:
    body_width: float  # of the body's axes, which begin at LEFT and TITLE
    body_height: float
    faces: list[Place]
    height: float


def faces_of(s: Fields) -> list[np.ndarray]:
    """In drawing order: from left to right, those of a tall body from top to bottom."""
    def place(face: np.ndarray) -> float:
        x, y = s.edges[face].mean(axis=(0, 1))
        return -y if is_tall(s) else x
    return sorted(s.faces(), key=place)


def is_tall(s: Fields) -> bool:
    return slenderness(s) > TALL and len(s.edges) > 0


def is_cut(s: Fields) -> bool:
    """Some face is drawn in part."""
    lines = [(face, unrolled(s.edges[face])) for face in s.faces()]
    return any(s.shown_of(face, line) != line.limits for face, line in lines)


def strip_of(width: float) -> float:
    return BEHIND * width / (1 + 2 * BESIDE) + MARKERS


def layout_of(s: Fields, width: float) -> Layout:
    count = len(s.faces())
    if is_tall(s):
        body = HIGHEST / slenderness(s)
        left = LEFT + body + GAP + LEFT
        across = min(width - left - RIGHT, 4.5)
        step = strip_of(across) + LOW_TRACTION + LABELS
        faces = [Place(left, TITLE + k * step, across, strip_of(across), LOW_TRACTION, True)
                 for k in range(count)]
        return Layout(body, HIGHEST, faces, TITLE + max(HIGHEST + LABELS, count * step))
    height = body_height(s, width)
    below = TITLE + height + SCALE + GAP
    room = width - LEFT - RIGHT + GAP
    in_row = min(max(int(room / (NARROWEST + GAP)), 1), max(count, 1))
    column = room / in_row - GAP
    step = strip_of(column) + TRACTION + LABELS
    faces = [Place(LEFT + k % in_row * (column + GAP), below + k // in_row * step, column,
                   strip_of(column), TRACTION, k % in_row == 0) for k in range(count)]
    rows = math.ceil(count / in_row)
    return Layout(width - LEFT - RIGHT, height, faces,
                  below + rows * step if rows else TITLE + height + LABELS)


def draw_panel(figure: Figure, s: Fields, left: float, top: float, width: float,
               scales: drawing.Scales) -> None:
    """left, top: of the panel, from the figure's lower left corner."""
    size = np.tile(figure.get_size_inches(), 2)

    def add_axes(x: float, below: float, width: float, height: float, **limits: object) -> Axes:
        return figure.add_axes(np.array([left + x, top - below - height, width, height]) / size,
                               **limits)

    view, layout = view_of(s), layout_of(s, width)
    body = add_axes(LEFT, TITLE, layout.body_width, layout.body_height, xlim=view.intervalx,
                    ylim=view.intervaly)
    label_body(body, x="; ".join(["x, mm", *drawn_over(s, scales)]))
    body.tick_params(axis="x", pad=1)
    n_phi = "" if s.n_phi is None else rf", $n_\varphi$ = {s.n_phi}"
    figure.text((left + LEFT + (layout.body_width / 2 if not is_tall(s) else 0)) / size[0],
                (top - TITLE + 0.07) / size[1],
                f"{plain(s.mesh)}: {len(s.points)} triangles{n_phi}", va="bottom", fontsize=9,
                ha="left" if is_tall(s) else "center")
    drawing.draw_body(body, s, scales)
    drawing.draw_displaced(body, s, scales.times)
    drawing.draw_loads(body, s, scales.load_MPa)
    faces = faces_of(s)
    for k, (face, place) in enumerate(zip(faces, layout.faces)):
        draw_face(body, s, face, add_axes, place, scales, letter_of(k) if len(faces) > 1 else "")


def drawn_over(s: Fields, scales: drawing.Scales) -> list[str]:
    load = drawing.largest_load(s)
    return ([f"displacements × {scales.times:g}"] if scales.times else []) + (
        [f"loads to {load:.3g} MPa"] if load > 0 else [])


def letter_of(k: int) -> str:
    """A to Z, then A2 to Z2, …"""
    return chr(ord("A") + k % 26) + (str(k // 26 + 1) if k > 25 else "")


def draw_face(body: Axes, s: Fields, face: np.ndarray, add_axes: AddAxes, place: Place,
              scales: drawing.Scales, letter: str) -> None:
    line = unrolled(s.edges[face])
    start, end = s.shown_of(face, line)
    limits = (start - BESIDE * (end - start), end + BESIDE * (end - start))
    per_mm = place.width / (limits[1] - limits[0])

    strip = add_axes(place.left, place.top, place.width, place.strip, xlim=limits, xticks=[],
                     yticks=[], ylim=(MARKERS / per_mm, (MARKERS - place.strip) / per_mm))
    strip.spines[:].set_color("0.5")
    strip.spines["bottom"].set_visible(False)
    spacing_pt = 72 * per_mm * float(np.diff(line.limits)[0]) / (s.state[face].size / 2)
    local = line.seen(s, face, place.strip / per_mm)
    drawing.draw_strip(strip, local, min(MARKER_PT, 0.67 * spacing_pt), scales)

    traction = add_axes(place.left, place.top + place.strip, place.width, place.traction,
                        xlim=limits, ylim=(scales.pressure_MPa, 0))
    traction.tick_params(labelleft=place.named, length=2)
    traction.spines[["right", "bottom"]].set_visible(False)
    traction.set_xlabel(line.axis if place.width > ROOM_FOR_WORDS else
                        line.axis.replace("distance along the face ", ""), labelpad=1)
    traction.set_ylabel("MPa" if place.named else "", labelpad=2)
    drawing.draw_traction(traction, local)

    if line.axis == BY_LENGTH:
        body.plot(*s.edges[face[0], 0], marker="o", markersize=5, markeredgecolor="white",
                  color=drawing.ROLE["contact"]["color"], zorder=5, clip_on=False)
    if letter:
        box = dict(facecolor="white", edgecolor="none", pad=0.8)
        start, middle, end = between(s.edges[face[len(face) // 2]], np.array([0, 0.5, 1]))
        tangent = (end - start) / np.hypot(*(end - start))
        body.annotate(letter, middle, xytext=9 * np.array([tangent[1], -tangent[0]]),
                      textcoords="offset points", ha="center", va="center", weight="bold")
        strip.annotate(letter, (0, 1), xycoords="axes fraction", xytext=(4, -3), weight="bold",
                       textcoords="offset points", va="top", bbox=box)


def draw_legend(figure: Figure, scales: drawing.Scales, solutions: list[Fields]) -> None:
    """Of what is drawn of the solutions."""
    roles = {role for s in solutions for role in s.role}
    states = {state for s in solutions for state in s.state.ravel()}
    displaced = scales.times is not None
    has_walls = displaced and any(s.at_wall(face) for s in solutions for face in s.faces())
    ticked, edge = {"path_effects": [drawing.TICKED]}, drawing.ROLE["force"]
    lines = (("held", "displacement" in roles, drawing.ROLE["displacement"] | ticked),
             ("on rollers", "rollers" in roles, edge | drawing.ROLLER | {"linestyle": "-"}),
             ("free or loaded", "force" in roles, edge),
             ("contact", "contact" in roles, drawing.ROLE["contact"]),
             ("outline, displaced", displaced, drawing.OUTLINE),
             ("wall", has_walls, drawing.WALL | ticked),
             ("pressure", "contact" in roles, drawing.PRESSURE),
             ("|friction|", "contact" in roles, drawing.FRICTION))
    handles = [Line2D([], [], **style, label=label) for label, drawn, style in lines if drawn]
    words = [handle.get_label() for handle in handles]
    for state in filter(states.__contains__, drawing.STATE):
        handles.append((Patch(**drawing.band(state)), Line2D([], [], linestyle="none",
                                                             **drawing.marker(state))))
        words.append(state)
    figure.legend(handles, words, loc="lower left", ncol=math.ceil(len(handles) / 3), frameon=False,
                  columnspacing=1.2, borderaxespad=0.2, bbox_to_anchor=(0, 0))
    bar_below(figure, ScalarMappable(scales.shear, drawing.COLORMAP), 0.7, 0.27,
              r"$\tau_{max}$, MPa; brightest: this or more")


def contact_points(solutions: list[Fields]) -> str:
    """A line per contact point, by face in the pictures' order, evenly spread over its edge; along: the
    pictures' axis of the face."""
    lines = []
    for s in solutions:
        for k, face in enumerate(faces_of(s)):
            for edge, (start, *_, end) in zip(face, unrolled(s.edges[face]).along):
                at = np.linspace(0, 1, len(s.state[edge]))
                places = between(s.edges[edge], at)
                lines += [(s, letter_of(k), *point) for point in
                          zip(places, map(float, (1 - at) * start + at * end), s.traction[edge], s.state[edge])]
    return csv_of(lines, *columns_of(lambda line: line[0], "mesh", "n_phi"),
                  ("face", lambda line: line[1]), ("x_mm", lambda line: float(line[2][0])),
                  ("y_mm", lambda line: float(line[2][1])), ("along_mm", lambda line: line[3]),
                  ("pressure_MPa", lambda line: 0.0 - line[4][0]),
                  ("friction_MPa", lambda line: float(line[4][1])), ("state", lambda line: line[5]))
