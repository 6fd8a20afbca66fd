"""Labels next to what they name: where they hide least, or in a column. Sizes in points."""
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from drawing import MATH, PAGE_WIDTH, TYPE
from words import plain, width_of

DISTANCES = (5, 11, 18, 27, 38, 52, 70, 95, 125)
DIRECTIONS = 16
LEADER = 8  # beyond this distance a line leads to the label
LEADER_NAME = "_leader"  # of that line, in no legend
HALO = withStroke(linewidth=2, foreground="white", alpha=0.85)
SPACING = 3  # between samples of a curve
NAMES_APART = 13  # in a column
LEFT, DASHED = 0.72, 0.36  # inches: of the axes that a column belongs to; a piece of line


@dataclass
class Labels:
    """Of axes whose limits and size are set; places labels in the order of the calls."""

    axes: Axes
    size: float = 7.5
    obstacles: list[np.ndarray] = field(default_factory=list)  # (n, 2) each
    boxes: list[np.ndarray] = field(default_factory=list)      # left, bottom, right, top
    leaders: list[np.ndarray] = field(default_factory=list)    # (2, 2) each: ends
    lines: list[tuple] = field(default_factory=list)           # still without their names

    def points(self, x: object, y: object) -> np.ndarray:
        data = np.column_stack([np.atleast_1d(x), np.atleast_1d(y)]).astype(float)
        return self.axes.transData.transform(data) * 72 / self.axes.figure.dpi

    def avoid(self, x: object, y: object) -> None:
        """A curve, or a point, that labels should not hide."""
        points = self.points(x, y)
        pieces = [points]
        for a, b in zip(points, points[1:]):
            count = min(int(np.hypot(*(b - a)) / SPACING), 400)
            pieces.append(a + np.linspace(0, 1, count + 2)[1:-1, None] * (b - a))
        self.obstacles.append(np.vstack(pieces))

    def line(self, words: str, x: list[float], y: list[float], color: object, formula: bool = False,
             **style: object) -> None:
        """Draws a curve; `name_lines` names it, if it has words, at its end rather than its beginning."""
        self.axes.plot(x, y, color=color, **style)
        self.avoid(x, y)
        self.lines.append((words, x[::-1], y[::-1], formula, color))

    def name_lines(self, **text: object) -> None:
        """Call it when all lines are drawn, so that no label hides one."""
        for words, x, y, formula, color in filter(lambda line: line[0], self.lines):
            self.add(words, x, y, formula=formula, color=color, **text)

    def reserve(self, words: str, right: float, y: float, size: float) -> None:
        """Keeps other labels off words that end at (right, y) and stand on it."""
        corner = self.points(right, y)[0]
        width = width_of(words, size)
        self.boxes.append(np.r_[corner - [width + 3, 0], corner + [0, 1.4 * size]])

    def add(self, words: str, x: object, y: object, formula: bool = False,
            **text: object) -> None:
        """Next to one of the points (x, y), preferably the first. formula: $ is math."""
        anchors = self.points(x, y)
        size = float(text.pop("fontsize", self.size))
        lines = words.split("\n")
        width = max(width_of(line, size, text.get("weight", "normal")) for line in lines)
        half = np.array([width / 2 + 1, 0.62 * size * len(lines)])
        anchor, centre = self.best(anchors, half)
        self.boxes.append(np.r_[centre - half, centre + half])
        scale = self.axes.figure.dpi / 72
        inverse = self.axes.transData.inverted().transform
        nearest = border(anchor, centre, half)
        if np.hypot(*(nearest - anchor)) > LEADER:
            self.leaders.append(np.array([anchor, nearest]))
            ends = inverse(self.leaders[-1] * scale)
            self.axes.plot(*ends.T, color=text.get("color", "0.4"), linewidth=0.4, alpha=0.7,
                           zorder=3, label=LEADER_NAME)
            self.avoid(*ends.T)
        self.axes.text(*inverse(centre * scale), words if formula else plain(words), ha="center",
                       va="center", fontsize=size, zorder=8, path_effects=[HALO], **text)

    def best(self, anchors: np.ndarray, half: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        box = self.axes.get_window_extent()
        low, high = np.array([[box.x0, box.y0], [box.x1, box.y1]]) * 72 / self.axes.figure.dpi
        around = np.linspace(0, 2 * np.pi, DIRECTIONS, endpoint=False)
        unit = np.column_stack([np.cos(around), np.sin(around)])
        # The box's border, not its centre, is so far away.
        reach = np.sign(np.round(unit, 6)) * half * np.minimum(1, 1.5 * np.abs(unit))
        seen = np.vstack([np.empty((0, 2)), *self.obstacles])
        starts, ends = np.split(np.reshape(self.boxes, (-1, 4)), 2, axis=1)
        best = (np.inf, anchors[0], np.clip(anchors[0], low + half, high - half))
        for k, anchor in enumerate(anchors):
            for distance in DISTANCES:
                least = distance + 3 * k
                if least >= best[0]:
                    break  # what is farther costs more
                centres = anchor + distance * unit + reach
                centres = centres[((centres - half >= low) & (centres + half <= high)).all(1)]
                hidden = count_near(seen, centres, half + 1)
                crossed = count_near((starts + ends) / 2, centres, half + (ends - starts) / 2)
                costs = 1000 * crossed + self.met(anchor, centres, half) + 12 * hidden + least
                if len(costs) and costs.min() < best[0]:
                    best = (costs.min(), anchor, centres[costs.argmin()])
        return best[1], best[2]

    def met(self, anchor: np.ndarray, centres: np.ndarray, half: np.ndarray) -> np.ndarray:
        """(m,): the cost of the leaders, and of the labels, that a leader to a box there would cross."""
        ends = border(anchor, centres, half)
        on_way = anchor + np.linspace(0.1, 0.9, 9)[:, None, None] * (ends - anchor)  # (9, m, 2)
        boxes = np.reshape(self.boxes, (-1, 1, 1, 4))
        inside = ((on_way > boxes[..., :2]) & (on_way < boxes[..., 2:])).all(-1).any(1).sum(0)
        others = np.reshape(self.leaders, (-1, 1, 2, 2))
        crossed = crossing(anchor, ends, others[..., 0, :], others[..., 1, :]).sum(0)
        return (np.hypot(*(ends - anchor).T) > LEADER) * (1000 * crossed + 250 * inside)


def border(anchor: np.ndarray, centre: np.ndarray, half: np.ndarray) -> np.ndarray:
    """The point of a box that is closest to the anchor."""
    return centre - np.clip(centre - anchor, -half, half)


def crossing(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Whether the segments ab and cd cross; (..., 2) each -> (...)."""
    def side(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> np.ndarray:
        (px, py), (qx, qy) = np.moveaxis(q - p, -1, 0), np.moveaxis(r - p, -1, 0)
        return np.sign(px * qy - py * qx)
    return (side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)


def count_near(points: np.ndarray, centres: np.ndarray, reach: np.ndarray) -> np.ndarray:
    """(m,): how many points (n, 2) are less than reach away, in x and in y, from centres (m, 2)."""
    return (np.abs(points - centres[:, None]) < reach).all(2).sum(1)


def spread(wanted: list[float], spacing: float, low: float, high: float) -> list[float]:
    """Ascending positions at least `spacing` apart, closest to the ascending `wanted` ones."""
    blocks: list[list[float]] = []  # [sum, count] of positions less the spacing below them
    for k, position in enumerate(wanted):
        blocks.append([position - k * spacing, 1])
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] > blocks[-1][0] / blocks[-1][1]:
            total, n = blocks.pop()
            blocks[-1] = [blocks[-1][0] + total, blocks[-1][1] + n]
    highest = high - (len(wanted) - 1) * spacing
    base = [min(max(total / n, low), highest) for total, n in blocks for _ in range(n)]
    return [position + k * spacing for k, position in enumerate(base)]


def name_places(axes: Axes, ends: dict[str, tuple[float, float] | None],
           apart_pt: float) -> Iterator[tuple[str, tuple[float, float], float]]:
    to_axes = axes.transData + axes.transAxes.inverted()
    at = {method: tuple(to_axes.transform(end)) if end else (1, 1.0)
          for method, end in ends.items()}
    order = sorted(at, key=lambda method: at[method][1])
    height_pt = 72 * axes.get_position().height * axes.figure.get_size_inches()[1]
    places = spread([at[method][1] for method in order], apart_pt / height_pt, 0.01, 0.99)
    return zip(order, map(at.get, order), places)


def draw_leader(axes: Axes, at: tuple[float, float], right: float, y: float,
                **style: object) -> None:
    """From a line's end, of the axes' size, to its name: level up to the axes' edge, so that
    leaders in the order of `name_places` do not cross."""
    axes.plot([at[0], max(at[0], 1), right], [at[1], at[1], y], transform=axes.transAxes,
              clip_on=False, linewidth=0.4, zorder=1, label=LEADER_NAME, **style)


def draw_names(axes: Axes, ends: dict[str, tuple[float, float]], colours: dict[str, str],
               powers: dict[str, float | None], dashes: dict[str, object] | None = None) -> None:
    """Name and exponent next to the last points, in their order; with dashes also a piece of line.
    Of axes at LEFT on a page."""
    inch = 1 / (axes.get_position().width * PAGE_WIDTH)
    for method, at, y in name_places(axes, ends, NAMES_APART):
        style = dict(transform=axes.transAxes, va="center", color=colours[method])
        draw_leader(axes, at, 1 + 0.22 * inch, y, color=colours[method], alpha=0.6)
        name_at = 1 + 0.26 * inch
        if dashes:
            axes.plot([name_at, name_at + DASHED * inch], [y, y], transform=axes.transAxes,
                      clip_on=False, color=colours[method], linestyle=dashes[method], linewidth=1.4)
            name_at += (DASHED + 0.06) * inch
        axes.text(name_at, y, plain(method), fontsize=TYPE, **style)
        if powers[method] is not None:
            axes.text((PAGE_WIDTH - LEFT - 0.05) * inch, y, f"$n^{{{powers[method]:.2f}}}$",
                      ha="right", fontsize=MATH, **style)


def mark_meshes(axes: Axes, sizes: dict[str, int], rotation: float, size_pt: float) -> None:
    names = sorted(sizes, key=sizes.get)
    at = [axes.transAxes.inverted().transform(axes.transData.transform((sizes[name], 1)))[0]
          for name in names]
    width, height = 72 * axes.get_position().size * axes.figure.get_size_inches()  # points
    for name, x, place in zip(names, at, spread(at, 1.64 * size_pt / width, 0, 1.05)):
        axes.plot([x, x, place], [1, 1 + 2.5 / height, 1 + 6 / height], transform=axes.transAxes,
                  clip_on=False, color="0.3", linewidth=0.6)
        axes.text(place, 1 + 8 / height, plain(name), transform=axes.transAxes,
                  rotation=rotation, ha="left", va="bottom", rotation_mode="anchor",
                  fontsize=size_pt)
