"""Draws the stress in a body, and the points and the pressure of a contact face, into given axes.

A body lies as it is, x to the right and y up; a face has its outward normal down.
"""
from dataclasses import dataclass
from itertools import groupby
from math import comb

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.patches import Rectangle
from matplotlib.patheffects import withStroke, withTickedStroke
from matplotlib.tri import Triangulation

from fields import Fields, between, chains, largest_shear, lengths_of, lines_of, parts
from lagrange_cells import interpolation
from drawing import SMALLEST_PT
from words import width_of

COLORMAP = "viridis"
# Okabe and Ito's colours; shape and lightness say the same in grey.
STATE = {
    "open": dict(marker="o", color="black", fill="none"),
    "stick": dict(marker="s", color="#0072B2", fill="#56A3D9"),
    "slip": dict(marker="^", color="#D55E00", fill="#F5B183"),
}
ROLE = {
    "displacement": dict(color="black", linewidth=1.4, linestyle="-"),
    "force": dict(color="black", linewidth=0.8, linestyle="-"),
    "contact": dict(color="#D00060", linewidth=2.0, linestyle=(0, (2, 1))),
}
LINES = {"rollers": ROLE["force"]} | ROLE
PRESSURE = dict(color="black", linewidth=0.8)
FRICTION = PRESSURE | {"linestyle": (0, (3, 1))}
NEARLY = 1.25
FINEST_PT, CLEAR_PT = 3, 20  # size of triangles whose lines begin to show, and show fully
ROLLER = dict(marker="o", markersize=3.2, markerfacecolor="white", markeredgecolor="black",
              markeredgewidth=0.7, linestyle="none")
OUTLINE = dict(color="0.15", linewidth=0.7, linestyle=(0, (4, 2)))
WALL = dict(color="0.45", linewidth=1.0, linestyle="-")
MOVED = 0.05  # of a body's size: largest displacement drawn
ARROW_PT, SPACING_PT, WEAKEST = 20, 13, 0.02  # of the largest load; of its arrows; of it
SMALLEST_MARKER_PT = 3.5  # smaller markers of open, stick and slip look alike
TICKED = withTickedStroke(spacing=5, angle=-135, length=0.8)  # outward, as for a clamped edge


@dataclass(frozen=True)
class Scales:
    shear: Normalize             # MPa
    pressure_MPa: float          # end of the axis
    times: float | None = None   # displacements are drawn so much larger; None: not drawn
    load_MPa: float = 0          # of the longest arrow; 0: no arrows


def scales_of(solutions: list[Fields]) -> Scales:
    """Of the largest values, singular corners aside."""
    shear = max(map(highest_shear, solutions))
    pressure = max(map(highest_pressure, solutions))
    return Scales(Normalize(0, shear or 1), 1.08 * pressure or 1, enlargement(solutions),
                  max(map(largest_load, solutions)))


def areas(s: Fields) -> np.ndarray:
    """(T,) mm^2."""
    a, b = (s.triangles[:, k] - s.triangles[:, 0] for k in (1, 2))
    return np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2


def highest_but(values: np.ndarray, weights: np.ndarray, part: float, times: float) -> float:
    """The largest value, or `times` the quantile `part` of the weights if that is far less."""
    order = np.argsort(values)
    share = np.cumsum(weights[order]) / weights.sum()
    usual = times * values[order][min(np.searchsorted(share, part), len(order) - 1)]
    return float(values.max() if values.max() <= NEARLY * usual else usual)


def highest_shear(s: Fields) -> float:
    """MPa; of 99.5 % of the area."""
    shear = largest_shear(s.stress)
    return highest_but(shear.ravel(), np.repeat(areas(s), shear[0].size), 0.995, 1.2)


def highest_pressure(s: Fields) -> float:
    """MPa; of 95 % of the contact in pressure."""
    pressure = np.abs(s.traction[..., 0]).ravel()
    lengths = np.repeat(lengths_of(s.edges), s.per_edge)
    pressed = pressure > 0
    return highest_but(pressure[pressed], lengths[pressed], 0.95, 2) if pressed.any() else 0.0


def marker(state: str) -> dict[str, str]:
    style = STATE[state]
    return dict(marker=style["marker"], markeredgecolor=style["color"],
                markerfacecolor="none" if state == "open" else style["color"])


def band(state: str) -> dict[str, object]:
    return dict(facecolor="white" if state == "open" else STATE[state]["fill"],
                edgecolor=STATE[state]["color"], linewidth=0.6)


def cut(values: np.ndarray, parts: int) -> np.ndarray:
    """Polynomials by their values (N, P, c) at the points of a third, on parts^2 triangles each: (., 3, c)."""
    k = range(parts)
    up = [((i, j), (i + 1, j), (i, j + 1)) for i in k for j in k if i + j < parts]
    down = [((i, j), (i - 1, j), (i, j - 1)) for i in k for j in k if i and j and i + j <= parts]
    ij = np.array(up + down) / parts
    weights = np.stack([1 - ij.sum(-1), ij[..., 0], ij[..., 1]], axis=-1)  # (parts^2, 3, 3)
    at_points = interpolation(values.shape[1], weights).reshape(-1, values.shape[1])
    return (at_points @ values).reshape(-1, 3, values.shape[-1])


def draw_stress(axes: Axes, s: Fields, chosen: np.ndarray, scales: Scales) -> None:
    """tau_max on the chosen triangles (T,); on each third the stress is a polynomial, tau_max is not."""
    if not chosen.any():
        return
    parts = int(np.clip(np.sqrt(6e4 / (3 * chosen.sum())), 2, 8))
    xy, stress = (cut(values[chosen].reshape(-1, *values.shape[2:]), parts)
                  for values in (s.placed(s.points), s.stress))
    tau, xy = largest_shear(stress).ravel(), xy.reshape(-1, 2)
    mesh = Triangulation(*xy.T, np.arange(len(xy)).reshape(-1, 3))
    axes.tripcolor(mesh, tau, shading="gouraud", cmap=COLORMAP, norm=scales.shear, rasterized=True)
    triangles = s.placed(s.triangles[chosen])
    corners = axes.transData.transform(triangles.reshape(-1, 2)).reshape(-1, 3, 2)
    size_pt = np.hypot(*(corners - corners[:, [1, 2, 0]]).T).mean(0) * 72 / axes.figure.dpi
    # The same part of every triangle, whatever its size; too fine to see, no lines.
    lines = np.zeros((len(triangles), 4))
    lines[:, 3] = 0.4 * np.clip((size_pt - FINEST_PT) / (CLEAR_PT - FINEST_PT), 0, 1)
    axes.add_collection(PolyCollection(s.placed(s.outlines[chosen]), facecolor="none", edgecolor=lines, rasterized=True,
                                       linewidths=np.clip(0.03 * size_pt, 0.05, 0.3)))


def draw_boundary(axes: Axes, s: Fields) -> None:
    for role, style in LINES.items():
        edges = s.placed(s.boundary[s.role == role])
        for points in lines_of(edges):
            line, = axes.plot(*points.T, **style, zorder=3, solid_capstyle="butt")
            if role == "displacement":
                line.set_path_effects([TICKED])
        if role == "rollers" and len(edges):
            axes.plot(*between(edges, np.array([0.5]))[:, 0].T, **ROLLER, zorder=3)


def draw_body(axes: Axes, s: Fields, scales: Scales) -> None:
    draw_stress(axes, s, np.full(len(s.points), True), scales)
    draw_boundary(axes, s)


def enlargement(solutions: list[Fields]) -> float | None:
    """Of displacements: 1, 2 or 5 times a power of ten. None: there are none to see."""
    largest = max((np.hypot(*s.moved.reshape(-1, 2).T).max() / size_of(s) for s in solutions
                   if s.moved is not None), default=0)
    if not largest > 0:
        return None
    return round_below(MOVED / largest)


def round_below(most: float) -> float:
    """The largest of 1, 2, 5, 10, 20, … that is not above."""
    power = 10.0 ** np.floor(np.log10(most))
    return float(power * max(factor for factor in (1, 2, 5) if factor * power <= most))


def size_of(s: Fields) -> float:
    return float(np.ptp(s.boundary.reshape(-1, 2), axis=0).max())


def draw_displaced(axes: Axes, s: Fields, times: float | None) -> None:
    """The outline where enlarged displacements take it, and the walls."""
    if times is None or s.moved is None:
        return
    moved = s.boundary + times * s.moved
    for chain in chains(s.boundary):
        axes.plot(*moved[chain].reshape(-1, 2).T, **OUTLINE, zorder=4)
    if s.gap is not None and np.isfinite(s.gap).all():
        for wall in walls_of(s, times):
            axes.plot(*wall.T, **WALL, zorder=3.5, path_effects=[TICKED])


def walls_of(s: Fields, times: float) -> list[np.ndarray]:
    """(points of a face, 2) mm. With p the points, u their displacements, n their normals, g their gaps,
    the wall goes through p + u + g n. It keeps that shape, and is shifted along n by (times - 1) m,
    m the mean of u n over the points that touch it: there the enlarged outline meets it."""
    m = s.per_edge
    places = np.arange(1, m + 1) / (m + 1)  # gaps are means around these points of an edge
    at, u = (between(ends[s.role == "contact"], places) for ends in (s.boundary, s.moved))
    normal, gap = s.normal, s.gap[..., None]
    offset = (u * normal).sum(-1, keepdims=True) + gap  # from p to the wall
    found = []
    for face in filter(s.at_wall, s.faces()):
        nearest = gap[face] <= max(gap[face].min(), 0)
        touching = (s.state[face] != "open")[..., None] if (s.state[face] != "open").any() else nearest
        shift = (times - 1) * offset[face][touching].mean()
        wall, n = at + u + (gap + shift) * normal, normal[face][0, 0]
        if np.allclose(normal[face], n):  # flat; on a curved face p is on a chord, but where it touches
            level = (wall @ n)[face][touching[..., 0]].mean()
            wall = wall + (level - wall @ n)[..., None] * n
        found.append(wall[face].reshape(-1, 2))
    return found


def largest_load(s: Fields) -> float:
    """MPa."""
    return 0.0 if s.load is None else float(np.hypot(*s.load.reshape(-1, 2).T).max(initial=0))


def draw_loads(axes: Axes, s: Fields, largest: float) -> None:
    """Arrows of the given tractions, about as far apart everywhere: what pushes ends on the edge, what
    pulls begins there. largest: of the longest arrow, MPa."""
    if s.load is None or not largest > 0:
        return
    loaded = np.hypot(*np.moveaxis(s.load, -1, 0)).max(1) > WEAKEST * largest
    scale = np.abs(np.diff(axes.transData.transform([(0, 0), (1, 0)])[:, 0]))[0] * 72 / axes.figure.dpi
    edges, loads = s.boundary[loaded], s.load[loaded]
    for chain in chains(edges):
        lengths = scale * lengths_of(edges[chain])
        ends = np.cumsum(lengths)
        count = max(1, int(ends[-1] / SPACING_PT))
        for at in (np.arange(count) + 0.5) * ends[-1] / count:
            k = int(np.searchsorted(ends, at))
            part = 1 - (ends[k] - at) / lengths[k]
            traction, = between(loads[chain[k]], np.array([part]))
            if np.hypot(*traction) < WEAKEST * largest:
                continue
            before, on, after = between(edges[chain[k]], part + np.array([-0.01, 0, 0.01]))
            outward = np.array([after[1] - before[1], before[0] - after[0]])
            point = axes.transData.transform(on)
            load_arrow(axes, point * 72 / axes.figure.dpi, ARROW_PT * traction / largest, outward)


def load_arrow(axes: Axes, point: np.ndarray, arrow: np.ndarray, outward: np.ndarray) -> None:
    """At a point of an edge, from the figure's corner, points: what pushes ends there, what pulls begins."""
    tip, tail = (point + arrow, point) if arrow @ outward > 0 else (point, point - arrow)
    axes.annotate("", tip, xytext=tail, xycoords="figure points", textcoords="figure points",
                  annotation_clip=False, arrowprops=dict(arrowstyle="-|>", mutation_scale=5, linewidth=0.6,
                                                         shrinkA=0, shrinkB=0, color="black"))


def draw_strip(axes: Axes, s: Fields, marker_pt: float, scales: Scales) -> None:
    """Elements behind a face and its contact points; s as the face sees it, axes with limits set.

    A point is drawn outside the body, in the middle of its part of the edge; the edge's second point a
    little farther out. Where they would be too small, their states make a band.
    """
    (left, right), (outside, inside) = axes.get_xlim(), axes.get_ylim()
    x, y = s.triangles[..., 0], s.triangles[..., 1]
    behind = (x.max(1) > inside) & (x.max(1) < 0.2 * outside)
    draw_stress(axes, s, behind & (y.max(1) > left) & (y.min(1) < right), scales)
    draw_boundary(axes, s)
    if marker_pt < SMALLEST_MARKER_PT:
        draw_states(axes, s, outside)
        return
    along = parts(s.edges[:, [0, -1], 1], s.per_edge).mean(1).reshape(s.state.shape)
    off = np.broadcast_to(np.linspace(0.42, 0.75, s.per_edge) * outside, along.shape)
    for name in STATE:
        axes.plot(along[s.state == name], off[s.state == name], linestyle="none", **marker(name),
                  markersize=marker_pt, markeredgewidth=0.5)


def runs(states: np.ndarray) -> list[tuple[str, list[int]]]:
    return [(state, list(run)) for state, run in
            groupby(range(states.size), states.ravel().__getitem__)]


def draw_states(axes: Axes, s: Fields, outside: float) -> None:
    place = parts(s.edges[:, [0, -1], 1], s.per_edge)
    box, limits = axes.get_window_extent(), axes.get_xlim()
    pt_per_mm = 72 / axes.figure.dpi * box.width / np.diff(axes.get_xlim())[0]
    for state, run in runs(s.state):
        left, right = np.clip((place[run[0], 0], place[run[-1], 1]), *limits)
        axes.add_patch(Rectangle((left, 0.25 * outside), right - left, 0.65 * outside,
                                 **band(state)))
        if width_of(state, SMALLEST_PT) + 4 < (right - left) * pt_per_mm:
            axes.text((left + right) / 2, 0.59 * outside, state, ha="center", va="center",
                      fontsize=SMALLEST_PT)


def sampled(values: np.ndarray, places: np.ndarray) -> np.ndarray:
    """(E, m) Bernstein coefficients -> (E, ...): values at places (...), from 0 to 1."""
    m = values.shape[1]
    basis = [comb(m - 1, j) * places**j * (1 - places)**(m - 1 - j) for j in range(m)]
    return np.tensordot(values, np.array(basis), 1)


def draw_traction(axes: Axes, s: Fields) -> None:
    """Pressure (filled by state) and |friction| (dashed), polynomials on each edge of a face; a note tells of
    pressure beyond the axis."""
    pressure, friction = np.moveaxis(np.abs(s.traction), -1, 0)
    m = pressure.shape[1]
    samples = 2 if m == 2 else 5
    of_parts = (np.arange(m)[:, None] + np.linspace(0, 1, samples)) / m
    ends = s.edges[:, [0, -1], 1]
    x, y = (sampled(values, of_parts).reshape(-1, samples) for values in (ends, pressure))
    for state, run in runs(s.state):
        axes.fill_between(x[run].ravel(), y[run].ravel(), color=STATE[state]["fill"], linewidth=0)
    along = np.linspace(0, 1, 2 if m == 2 else 13)
    for values, style in ((pressure, PRESSURE), (friction, FRICTION)):
        axes.plot(sampled(ends, along).T, sampled(values, along).T, **style)
    highest = pressure.max()
    if highest > max(axes.get_ylim()):
        axes.annotate(f"up to {float(f'{highest:.3g}'):g} MPa", (0.5, 0), xytext=(0, 3),
                      xycoords="axes fraction", textcoords="offset points", ha="center", fontsize=SMALLEST_PT,
                      path_effects=[withStroke(linewidth=2, foreground="white")])
