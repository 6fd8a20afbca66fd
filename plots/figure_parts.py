"""What Figs 3, 4 and 5 share: a case's point with its error, the key, the place of the words.

Fill colour: error_force. Crossed: status inaccurate. Open: no answer, time extrapolated; with an
arrow: only a bound, or no estimate at all. Sizes in inches, type in points.
"""
from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

from matplotlib import colormaps, ticker
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from figure_words import heap_caption, plain, short, time_caption, wrapped
from record_keys import STOPS, Row
from selection import of_scene

WIDTH = 6.3  # inches: 16 cm
TYPE, SMALL, MATH = 8, 7, 10  # points; indices and exponents are set at 0.7 MATH
STYLE = {"font.size": TYPE, "axes.linewidth": 0.6, "axes.labelsize": TYPE, "axes.titlesize": TYPE,
         "xtick.labelsize": TYPE, "ytick.labelsize": TYPE, "legend.fontsize": TYPE,
         "grid.color": "0.88", "grid.linewidth": 0.4, "axes.axisbelow": True,
         "xtick.major.size": 2.5, "ytick.major.size": 2.5, "xtick.minor.size": 1.5,
         "ytick.minor.size": 1.5, "svg.hashsalt": "airybench"}
COLORMAP = "viridis"
EDGE, UNKNOWN = "#222222", "#B8B8B8"
MARKER = 6.5
CROSS = dict(marker="x", markersize=1.5 * MARKER, markeredgecolor="#D00060", markeredgewidth=0.8,
             linestyle="none")
SHAFT = [(0, 0.35), (0, 1), (-0.2, 0.7), (0, 1), (0.2, 0.7)]  # upward from the symbol
ARROW = dict(marker=SHAFT, markersize=28, markerfacecolor="none", markeredgecolor=EDGE,
             markeredgewidth=1, linestyle="none")
HEADROOM = 0.1  # of an axes' height, for arrows without a value
EDGE_AT = 1 - 0.75 * HEADROOM
LINE = 0.155  # between lines of a caption
MARGIN = 0.08


@dataclass(frozen=True)
class Quantity:
    """What a figure shows."""

    name: str
    axis: str
    caption: Callable[[list[Row], list[Row]], str]  # of its rows and all rows of their stop

    def of(self, row: Row) -> tuple[float | None, str]:
        """Value, and how it is marked: done, open, bound; none: there is nothing to mark."""
        if self is HEAP:
            if row.peak_heap_bytes is None:
                return None, "none"
            return row.peak_heap_bytes / 2**20, "done" if row.completed else "open"
        if row.completed:
            return row.time_s, "done"
        if row.status != "timeout":
            return None, "none"
        sure = row.extrapolated_time_s and row.done_fraction
        return row.extrapolated_time_s, "open" if sure else "bound"


TIME = Quantity("time", "time of one solve, s", time_caption)
HEAP = Quantity("memory", "peak heap, MiB", heap_caption)


class ErrorScale:
    """Colours of error_force, common to all figures of a results.csv."""

    def __init__(self, rows: Iterable[Row]) -> None:
        errors = [row.error_force for row in rows if row.completed and row.error_force]
        low = max(math.floor(math.log10(min(errors, default=1e-12))), -16)
        high = min(math.ceil(math.log10(max(errors, default=1e-12))), 3)  # beyond: as there
        self.norm = LogNorm(10.0**low, 10.0**max(high, low + 1), clip=True)
        self.colours = colormaps[COLORMAP]  # once: it is copied each time

    def fill(self, row: Row, mark: str) -> object:
        if mark != "done":
            return "white"
        if row.error_force is None:
            return UNKNOWN
        return self.colours(self.norm(max(row.error_force, self.norm.vmin)))

    def bar(self, figure: Figure, left: float, bottom: float, width: float) -> None:
        size = figure.get_size_inches()
        axes = figure.add_axes([left / size[0], bottom / size[1], width / size[0], 0.09 / size[1]])
        bar = figure.colorbar(ScalarMappable(self.norm, COLORMAP), cax=axes,
                              orientation="horizontal")
        low, high = (round(math.log10(v)) for v in (self.norm.vmin, self.norm.vmax))
        step = math.ceil((high - low) / 6)
        bar.set_ticks([10.0**k for k in range(low, high + 1, step)], minor=False)
        bar.ax.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: short(value)))
        bar.ax.minorticks_off()
        bar.ax.tick_params(pad=1.5, labelsize=SMALL)
        bar.outline.set_linewidth(0.4)
        bar.ax.set_title("error of the contact forces", pad=2)


def by_stop(rows: list[Row]) -> Iterator[tuple[str, list[Row], ErrorScale]]:
    """End of the figures' names, rows of an ordinary run's scene and the stop, common colours."""
    own = of_scene([row for row in rows if not row.study])
    scale = ErrorScale(own)
    for stop in STOPS:
        of_stop = [row for row in own if row.stop == stop]
        if of_stop:
            yield "_paper_stop" if stop == "paper" else "", of_stop, scale


def draw_point(axes: Axes, x: float, y: float | None, row: Row, mark: str, scale: ErrorScale,
               marker: str = "o") -> None:
    """Without y, at the upper edge of the axes."""
    where = dict(transform=axes.transData, clip_on=False)
    if y is None:
        y, where["transform"] = EDGE_AT, axes.get_xaxis_transform()
    if mark == "bound":
        axes.plot(x, y, **where, **ARROW, zorder=4)
    axes.plot(x, y, **where, **marker_style(marker, scale.fill(row, mark)), zorder=5)
    if mark == "done" and row.status == "inaccurate":
        axes.plot(x, y, **where, **CROSS, zorder=6)


def marker_style(marker: str, fill: object) -> dict[str, object]:
    size = MARKER * {"*": 1.45, "P": 1.1, "D": 0.85}.get(marker, 1)
    return dict(marker=marker, markersize=size, markerfacecolor=fill, markeredgecolor=EDGE,
                markeredgewidth=0.6, linestyle="none")


def key_of(rows: Iterable[Row], quantity: Quantity) -> list[tuple[Line2D | tuple, str]]:
    """Handles and words for the marks that these rows have."""
    rows = list(rows)
    marks = {mark for row in rows for _, mark in [quantity.of(row)]}
    done = [row for row in rows if quantity.of(row)[1] == "done"]

    def sample(marker: str = "o", fill: object = "white") -> Line2D:
        return Line2D([], [], **marker_style(marker, fill))

    key = []
    if any(row.status == "inaccurate" for row in done):
        key.append(((sample(fill="0.8"), Line2D([], [], **CROSS)),
                    "inaccurate: an error, or its estimate, above the target"))
    if any(row.error_force is None for row in done):
        key.append((sample(fill=UNKNOWN), "grey: error not known"))
    if "open" in marks:
        key.append((sample(), "open: time limit reached, time extrapolated" if quantity is TIME
                    else "open: no answer, heap up to there"))
    if "bound" in marks:
        arrow = {**ARROW, "marker": [(0, -1), *SHAFT[1:]], "markersize": 10}
        key.append((Line2D([], [], **arrow), "arrow: at least so much; no estimate: upper edge"))
    return key


class Footer:
    """Key and colours, then caption and footnotes, along the figure's lower edge."""

    def __init__(self, rows: list[Row], quantity: Quantity, texts: list[str],
                 scale: ErrorScale) -> None:
        self.lines = [line for text in texts for line in wrapped(text, WIDTH - 2 * MARGIN, TYPE)]
        self.key = key_of(rows, quantity)
        self.scale = scale
        self.key_height = max(0.44, LINE * len(self.key) + 0.06)
        self.height = self.key_height + LINE * len(self.lines) + MARGIN

    def draw(self, figure: Figure) -> None:
        height = figure.get_size_inches()[1]
        for below, line in enumerate(self.lines, 1 - len(self.lines)):
            figure.text(MARGIN / WIDTH, (MARGIN - below * LINE) / height, plain(line), va="bottom")
        bottom = self.height - self.key_height
        self.scale.bar(figure, 0.58 * WIDTH, bottom + 0.2, 0.42 * WIDTH - 0.2)
        if self.key:
            handles, words = zip(*self.key)
            figure.legend(handles, words, loc="lower left", frameon=False, borderpad=0,
                          labelspacing=0.25, handlelength=1.5, handletextpad=0.4,
                          bbox_to_anchor=(MARGIN / WIDTH, (bottom + 0.05) / height))


def axes_at(figure: Figure, left: float, top: float, width: float, height: float,
            **properties: object) -> Axes:
    """top: inches below the figure's upper edge."""
    size = figure.get_size_inches()
    return figure.add_axes([left / size[0], 1 - (top + height) / size[1], width / size[0],
                            height / size[1]], **properties)


def log_axis(axis: Axis) -> None:
    """Of an axis with its limits set: as many labels a decade as there is room for."""
    low, high = axis.get_view_interval()
    choices = [(1,), (1, 3), (1, 2, 5), (1, 1.5, 2, 3, 5, 7)][:4 if high / low < 10 else
                                                              3 if high / low < 200 else 1]
    size = axis.axes.get_position().size * axis.figure.get_size_inches()
    letters = max(len(tick_label(10.0**round(math.log10(end)))) for end in (low, high))
    along, room = (size[0], 0.05 + 0.07 * letters) if axis.axis_name == "x" else (size[1], 0.15)
    decade = along / math.log10(high / low)  # inches, as room
    labelled = next((choice for choice in reversed(choices)
                     if math.log10(min(b / a for a, b in pairwise((*choice, 10)))) * decade > room),
                    choices[0])
    axis.set_major_formatter(ticker.FuncFormatter(lambda v, _: tick_label(v)))
    axis.set_major_locator(ticker.LogLocator(10.0**math.ceil(room / decade) if decade < room else 10,
                                             subs=labelled, numticks=99))
    axis.set_minor_locator(ticker.LogLocator(subs=range(2, 10), numticks=99))
    axis.set_minor_formatter(ticker.NullFormatter())


def tick_label(value: float) -> str:
    return f"{value:g}" if 1e-3 <= value < 1e5 else short(value)


def log_log(axes: Axes, **properties: object) -> None:
    """With its limits among the properties."""
    axes.set(xscale="log", yscale="log", **properties)
    log_axis(axes.xaxis)
    log_axis(axes.yaxis)
    axes.spines[["right"]].set_visible(False)


def log_limits(values: list[float | None], pad: float = 1.5) -> tuple[float, float]:
    """At least a decade; with headroom where there is a case without a value."""
    known = [value for value in values if value is not None] or [1]
    low, high = min(known) / pad, max(known) * pad
    wider = math.sqrt(max(10 * low / high, 1))
    low, high = low / wider, high * wider
    return low, high if None not in values else high * (high / low) ** (HEADROOM / (1 - HEADROOM))
