"""What Figs 3, 4 and 5 share: a case's point with its error, the key, the place of the words.

Fill colour: error_force. Crossed: status inaccurate. Open: no answer, time extrapolated; with an
arrow: only a bound, or no estimate at all. Sizes in inches, type in points.
"""
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from matplotlib import colormaps, ticker
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from drawing import HEADROOM, LINE, TYPE
from records import Row
from selection import by_stop, of_scene
from words import axis_label, cases_by_reason, heap_caption, plain, short, time_caption, wrapped

WIDTH = 6.3  # inches: 16 cm
SMALL = 7
MARGIN = 0.08
COLORMAP = "viridis"
EDGE, UNKNOWN = "#222222", "#B8B8B8"
MARKER = 6.5
CROSS = dict(marker="x", markersize=1.5 * MARKER, markeredgecolor="#D00060", markeredgewidth=0.8,
             linestyle="none")
SHAFT = [(0, 0.35), (0, 1), (-0.2, 0.7), (0, 1), (0.2, 0.7)]  # upward from the symbol
ARROW = dict(marker=SHAFT, markersize=28, markerfacecolor="none", markeredgecolor=EDGE,
             markeredgewidth=1, linestyle="none")
EDGE_AT = 1 - 0.75 * HEADROOM


@dataclass(frozen=True)
class Quantity:
    name: str
    axis: str
    caption: Callable[[list[Row], list[Row]], str]  # of its rows and all rows of their stop

    def of(self, row: Row) -> tuple[float | None, str]:
        """Value, and how it is marked: done, open, bound, or none if there is nothing to mark."""
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

    def marked(self, rows: Iterable[Row]) -> list[tuple[Row, float | None, str]]:
        return [(row, value, mark) for row in rows for value, mark in [self.of(row)]
                if mark != "none"]

    def done(self, rows: Iterable[Row]) -> list[tuple[Row, float]]:
        return [(row, value) for row, value, mark in self.marked(rows) if mark == "done"]


TIME = Quantity("time", axis_label("time_s"), time_caption)
HEAP = Quantity("memory", axis_label("peak_heap_bytes"), heap_caption)


def notes_of(cases: Iterable[tuple[str, Row]], quantity: Quantity) -> list[str]:
    titles: dict[str, dict[str, list[str]]] = {"No point": {}, "No estimate": {}}
    for case, row in cases:
        value, mark = quantity.of(row)
        if mark == "none":
            happened = "heap not counted" if row.completed else row.status_words()
            titles["No point"].setdefault(happened, []).append(case)
        elif value is None:
            titles["No estimate"].setdefault(row.status_words(), []).append(case)
    return [f"{title}: {cases_by_reason(group)}." for title, group in titles.items() if group]


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


def of_no_study(rows: list[Row]) -> tuple[dict[str, list[Row]], ErrorScale]:
    """Rows by stop, and colours for both stops."""
    own = of_scene([row for row in rows if not row.study])
    return by_stop(own), ErrorScale(own)


def draw_point(axes: Axes, x: float, y: float | None, row: Row, mark: str, scale: ErrorScale,
               marker: str = "o") -> None:
    """At the upper edge of the axes if y is None."""
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


def key_of(rows: list[Row], quantity: Quantity) -> list[tuple[Line2D | tuple, str]]:
    marks = {mark for _, _, mark in quantity.marked(rows)}
    done = [row for row, _ in quantity.done(rows)]

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
        key.append((Line2D([], [], **arrow), "arrow: lower bound; at the upper edge: no estimate"))
    return key


class Footer:
    def __init__(self, rows: list[Row], quantity: Quantity, texts: list[str],
                 scale: ErrorScale) -> None:
        self.lines = wrapped(texts, WIDTH - 2 * MARGIN, TYPE)
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
