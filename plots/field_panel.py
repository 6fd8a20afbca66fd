"""Lays out one solution: the body, and below it its contact faces, enlarged. Sizes in inches."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import ConnectionPatch, Patch

import field_drawing as drawing
from fields import Fields
from figure_words import plain

TITLE, GAP, TRACTION, LABELS, LEFT, RIGHT = 0.26, 0.2, 0.75, 0.42, 0.5, 0.08
MARKERS = 0.2  # below a face, for its contact points
SCALE = 0.2  # of a body, where no face has one
MARKER_PT = 4.5  # at most
MARGIN = 0.04  # around a body, of its extent in x
BEHIND, BESIDE = 0.1, 0.03  # the body behind a face and the space at its ends, of its length

AddAxes = Callable[..., Axes]  # left, top, width, height in inches; limits


@dataclass(frozen=True)
class View:
    """Limits of a body's axes, mm: left, right and bottom, top; the axes' names."""

    across: tuple[float, float]
    upward: tuple[float, float]
    names: tuple[str, str]

    @property
    def height(self) -> float:
        """Over its width."""
        return abs(self.upward[1] - self.upward[0]) / (self.across[1] - self.across[0])


def view_of(s: Fields) -> View:
    low, high = s.boundary.min(axis=(0, 1)), s.boundary.max(axis=(0, 1))
    margin = MARGIN * (high - low)[0 if s.sideways else 1]
    (x0, y0), (x1, y1) = low - margin, high + margin
    if s.sideways:
        return View((y0, y1), (x1 - 0.75 * margin, x0), ("y in mm", "x in mm"))
    return View((x0, x1), (y0, y1), ("x in mm", "y in mm"))


def body_height(s: Fields, width: float) -> float:
    return (width - LEFT - RIGHT) * view_of(s).height


def width_of(s: Fields, body: float) -> float:
    """Of a panel whose body is so high."""
    return body / body_height(s, 1 + LEFT + RIGHT) + LEFT + RIGHT


def has_scale_below(s: Fields) -> bool:
    """A face with the body's own coordinates."""
    return any(drawing.face_frame(s.edges[face])[2] == view_of(s).names[0] for face in s.faces())


def gap_of(s: Fields) -> float:
    """Between the body and its faces."""
    return GAP if has_scale_below(s) else GAP + SCALE


def column_of(s: Fields, width: float) -> tuple[float, float]:
    """Width of a face's column, and the height of its strip of elements and points."""
    faces = s.faces()
    column = (width - LEFT - RIGHT + GAP) / len(faces) - GAP
    return column, BEHIND * column / (1 + 2 * BESIDE) + MARKERS


def height_of(s: Fields, width: float) -> float:
    faces = gap_of(s) + column_of(s, width)[1] + TRACTION if len(s.edges) else 0
    return TITLE + body_height(s, width) + faces + LABELS


def draw_panel(figure: Figure, s: Fields, left: float, top: float, width: float,
               scales: drawing.Scales) -> None:
    size = np.tile(figure.get_size_inches(), 2)

    def add_axes(left: float, top: float, width: float, height: float, **limits: object) -> Axes:
        return figure.add_axes(np.array([left, top - height, width, height]) / size, **limits)

    view, height = view_of(s), body_height(s, width)
    body = add_axes(left + LEFT, top - TITLE, width - LEFT - RIGHT, height, xlim=view.across,
                    ylim=view.upward)
    body.tick_params(length=2)
    body.set_ylabel(view.names[1], labelpad=2)
    body.tick_params(axis="x", pad=1)
    if has_scale_below(s):
        body.set_xticks([])
    else:
        body.set_xlabel(view.names[0], labelpad=1)
    body.spines[:].set_visible(False)
    n_phi = "" if s.n_phi is None else rf", $n_\varphi$ = {s.n_phi}"
    body.set_title(f"{plain(s.mesh)}: {len(s.corners)} triangles{n_phi}", pad=5)
    drawing.draw_body(body, s, scales)
    lettered = not all(drawing.looks_down(s, face) for face in s.faces())
    for k, face in enumerate(sorted(s.faces(), key=lambda face: s.placed(s.edges[face[0], 0])[0])):
        column, strip = column_of(s, width)
        corner = (left + LEFT + k * (column + GAP), top - TITLE - height - gap_of(s))
        draw_face(body, s, face, add_axes, corner, (column, strip), scales, k, lettered)


def draw_face(body: Axes, s: Fields, face: np.ndarray, add_axes: AddAxes,
              corner: tuple[float, float], size: tuple[float, float], scales: drawing.Scales,
              k: int, lettered: bool) -> None:
    """A strip of elements with the contact points, below it the pressure. corner: left, top.

    The k-th face: lines lead to it from the body, or it is lettered in both.
    """
    origin, frame, along = drawing.face_frame(s.edges[face])
    local = s.moved(origin, frame)
    start, end = local.edges[face[0], 0, 1], local.edges[face[-1], 1, 1]
    limits = (start - BESIDE * (end - start), end + BESIDE * (end - start))
    per_mm = size[0] / (limits[1] - limits[0])

    strip = add_axes(*corner, *size, xlim=limits, xticks=[], yticks=[],
                     ylim=(MARKERS / per_mm, (MARKERS - size[1]) / per_mm))
    strip.spines[:].set_color("0.5")
    strip.spines["bottom"].set_visible(False)
    spacing_pt = 72 * per_mm * (end - start) / len(face)
    drawing.draw_strip(strip, local, face, scales, min(MARKER_PT, 0.67 * spacing_pt))

    traction = add_axes(corner[0], corner[1] - size[1], size[0], TRACTION,
                        xlim=limits, ylim=(scales.pressure_MPa, 0))
    traction.tick_params(labelleft=k == 0, length=2)
    traction.spines[["right", "bottom"]].set_visible(False)
    traction.set_xlabel(along, labelpad=1)
    traction.set_ylabel("MPa" if k == 0 else "", labelpad=2)
    drawing.draw_traction(traction, local, face)

    if lettered:
        letter, box = chr(ord("A") + k % 26), dict(facecolor="white", edgecolor="none", pad=0.8)
        middle = s.edges[face].mean(axis=(0, 1))
        normal = s.placed(frame[:, 0]) * (-1 if s.sideways else 1, 1)
        body.annotate(letter, s.placed(middle), xytext=9 * normal, textcoords="offset points",
                      ha="center", va="center", weight="bold")
        strip.annotate(letter, (0, 1), xycoords="axes fraction", xytext=(4, -3), weight="bold",
                       textcoords="offset points", va="top", bbox=box)
        return
    for side, point in enumerate((s.edges[face[0], 0], s.edges[face[-1], 1])):
        body.add_artist(ConnectionPatch(s.placed(point), (side, 1), "data", "axes fraction",
                                        axesA=body, axesB=strip, color="0.5", linewidth=0.5))


def draw_legend(figure: Figure, scales: drawing.Scales) -> None:
    """Along the figure's lower edge."""
    handles = [Line2D([], [], **style, label=role if role == "contact" else f"{role} prescribed")
               for role, style in drawing.ROLE.items()]
    handles[0].set_path_effects([drawing.TICKED])
    handles += [Line2D([], [], linestyle="none", label=state, **drawing.marker(state))
                for state in drawing.STATE]
    handles += [Patch(color=drawing.STATE["stick"]["fill"], label="pressure, sticking"),
                Patch(color=drawing.STATE["slip"]["fill"], label="pressure, slipping"),
                Line2D([], [], **drawing.FRICTION, label="|friction|")]
    figure.legend(handles=handles, loc="lower left", ncol=3, frameon=False,
                  bbox_to_anchor=(0.04, 0))
    height = figure.get_size_inches()[1]
    bar = figure.colorbar(ScalarMappable(scales.shear, drawing.COLORMAP), orientation="horizontal",
                          cax=figure.add_axes([0.62, 0.36 / height, 0.35, 0.12 / height]))
    bar.set_label(r"$\tau_{max}$ in MPa", labelpad=1)
