"""Sheets, axes and files of figures. Lengths in inches, type in points."""
import math
import re
import textwrap
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np
from matplotlib import ticker
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.cm import ScalarMappable
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colorbar import Colorbar
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from PIL import Image

from command import text_writer
from records import Row
from words import plain, short, width_of

# A page shows a figure about 830 pixels wide: 100 an inch of the widest, 7 points as 9.7 pixels.
PAGE_WIDTH, SMALLEST_PT = 8.3, 7
COLUMN_WIDTH, COLUMN_HEIGHT = 3.46, 8.0  # of a paper: 88 mm, and the key has room
NARROWEST, LOWEST = 2.6, 1.9  # a panel
TYPE, MATH = 8, 10  # points; indices and exponents are set at 0.7 MATH
LINE, MARGIN = 0.155, 0.1  # between lines of words; of the sheet
STYLE = {"font.size": TYPE, "axes.linewidth": 0.6, "axes.labelsize": TYPE, "axes.titlesize": TYPE,
         "xtick.labelsize": TYPE, "ytick.labelsize": TYPE, "legend.fontsize": TYPE,
         "grid.color": "0.88", "grid.linewidth": 0.4, "axes.axisbelow": True,
         "xtick.major.size": 2.5, "ytick.major.size": 2.5, "xtick.minor.size": 1.5,
         "ytick.minor.size": 1.5, "svg.hashsalt": "airybench",
         # For publishers: fonts whole in a PDF (TrueType, no Type 3), words of an SVG as curves, which look
         # the same where the font is missing.
         "pdf.fonttype": 42, "svg.fonttype": "path"}
CROSS = dict(marker="x", markersize=6, markeredgecolor="#D00060", markeredgewidth=0.9, linestyle="none", zorder=6)
# Of a colour's value: what is left of it in steps of 6.
STEPS = (255 - (255 - np.arange(256) + 2) // 6 * 6).astype(np.uint8)
VECTOR_DPI, DPI, COLOURS = 200, 120, 128  # of shades in an SVG or PDF; of a PNG


class Sheet(Figure):
    """Panels in rows, and below them a key. The title and the caption are written beside the picture."""

    def __init__(self, width: float, title: str, *texts: str, panels: int = 1, in_row: int = 2,
                 height: float = 2.7, narrowest: float = NARROWEST, key: Iterable[tuple[str, dict]] = (),
                 **axes: object) -> None:
        """key: words and the style of a line. axes: properties of all panels, such as sharey=True."""
        key = list(key)
        in_row = max(1, min(panels, in_row, int(width / narrowest)))
        rows = math.ceil(panels / in_row)
        height = min(height, max(COLUMN_HEIGHT / rows, LOWEST)) if width <= COLUMN_WIDTH else height
        entry = 0.5 + max((width_of(words, TYPE) for words, _ in key), default=0) / 72
        columns = max(1, min(len(key), int((width - 0.2) / entry)))
        below = LINE * 1.2 * math.ceil(len(key) / columns) + 0.12 * bool(key)
        size = rows * height + below
        super().__init__(figsize=(width, size), layout="constrained")
        self.get_layout_engine().set(rect=(0, below / size, 1, 1 - below / size), w_pad=0.06, h_pad=0.06)
        self.caption = caption_of(title, *texts)
        self.panels = list(self.subplots(rows, in_row, squeeze=False, **axes).flat)
        for spare in self.panels[panels:]:
            spare.remove()
        del self.panels[panels:]
        for panel in self.panels:
            panel.grid(which="major")
            panel.spines[["top", "right"]].set_visible(False)
        if key:
            self.legend([Line2D([], [], **style) for _, style in key], [words for words, _ in key], ncols=columns,
                        loc="lower center", frameon=False, borderaxespad=0.3, handlelength=2.6, columnspacing=1.2,
                        labelspacing=0.25)


def caption_of(title: str, *texts: str) -> str:
    """What is written beside a picture: a line, and a paragraph for each text."""
    return "\n\n".join([title, *(textwrap.fill(" ".join(text.split(" ")), 100) for text in texts if text)]) + "\n"


def keys(rows: Iterable[Row], name: Callable[[Row], str] = lambda row: plain(row.label)) -> list[tuple[str, dict]]:
    """A line each for the key, in the order of methods."""
    return list({name(row): row.look.line() for row in sorted(rows, key=lambda row: (row.look.rank, row.method))}
                .items())


@dataclass(frozen=True)
class Drawing:
    name: str                          # of its files
    rows: list[Row]                    # that it shows, or names
    draw: Callable[..., Sheet | str]   # of rows, width and options: the figure, or why there is none
    table: Callable[[list[Row]], str]  # of rows: the numbers drawn, a CSV next to the figure
    options: dict[str, object] = field(default_factory=dict)

    def figure(self, width: float = PAGE_WIDTH) -> Sheet | str:
        return self.draw(self.rows, width, **self.options)

    def writers(self, figure: Sheet, vector: bool) -> dict[str, Callable[[Path], object]]:
        """By suffix; vector: also as .svg and .pdf, as wide as a column of a paper."""
        found = {".png": partial(write_small_png, figure, DPI, colours=COLOURS),
                 ".csv": text_writer(self.table(self.rows)), ".txt": text_writer(figure.caption)}
        return found | for_papers(self.figure(COLUMN_WIDTH)) if vector else found


def write(figure: Figure, path: Path) -> None:
    """The same bytes whenever it is drawn."""
    metadata = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}, ".png": {"Software": None}}
    figure.savefig(path, dpi=VECTOR_DPI, metadata=metadata[path.suffix])


def for_papers(figure: Figure) -> dict[str, Callable[[Path], object]]:
    """What --vector adds, by suffix."""
    return {suffix: partial(write, figure) for suffix in (".svg", ".pdf")}


def write_small_png(figure: Figure, dpi: int, path: Path, colours: int | None = None,
                    kept: Iterable[object] = ()) -> None:
    """In steps of 6/255 of colour, which halves a PNG with shades, or with so many colours, those `kept`
    included, however few pixels have them."""
    figure.set_dpi(dpi)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    image = Image.fromarray(STEPS[np.asarray(canvas.buffer_rgba())[..., :3]])
    if colours:  # the commonest as they are, the others as the nearest of them
        common = sorted(image.getcolors(image.width * image.height), reverse=True)
        known = dict.fromkeys([*(tuple(STEPS[round(255 * part)] for part in to_rgb(colour)) for colour in kept),
                               *(colour for _, colour in common)])
        palette = Image.new("P", (1, 1))
        palette.putpalette([int(value) for colour in list(known)[:colours] for value in colour])
        image = image.quantize(palette=palette, dither=Image.Dither.NONE)
    image.save(path, format="PNG", optimize=True, dpi=(dpi, dpi))


def file_name(stem: str, mesh: str) -> str:
    """Without the letters of a mesh's name that a file's should not have."""
    return f"{stem}_{re.sub('[^A-Za-z0-9._-]', '-', mesh)}"


def text_at(figure: Figure, left: float, top: float, words: str, **style: object) -> None:
    """top: inches below the figure's upper edge."""
    width, height = figure.get_size_inches()
    figure.text(left / width, 1 - top / height, words, **{"va": "top"} | style)


def axes_at(figure: Figure, left: float, top: float, width: float, height: float,
            **properties: object) -> Axes:
    size = figure.get_size_inches()
    return figure.add_axes([left / size[0], 1 - (top + height) / size[1], width / size[0],
                            height / size[1]], **properties)


def panel_at(figure: Figure, left: float, top: float, width: float, height: float) -> Axes:
    """Axes with a grid, open above and to the right."""
    axes = axes_at(figure, left, top, width, height)
    axes.grid(which="major")
    axes.spines[["top", "right"]].set_visible(False)
    return axes


def colour_bar(figure: Figure, shades: ScalarMappable, left: float, top: float, width: float,
               words: str) -> Colorbar:
    bar = figure.colorbar(shades, orientation="horizontal", cax=axes_at(figure, left, top, width, 0.1))
    bar.ax.tick_params(pad=1, length=2)
    bar.set_label(words, labelpad=1)
    return bar


def bar_below(figure: Figure, shades: ScalarMappable, left: float, width: float, words: str) -> Colorbar:
    """left, width: of the figure's."""
    across, height = figure.get_size_inches()
    return colour_bar(figure, shades, left * across, height - 0.48, width * across, words)


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
    """The properties must include the limits."""
    axes.set(xscale="log", yscale="log", **properties)
    log_axis(axes.xaxis)
    log_axis(axes.yaxis)
    axes.spines[["right"]].set_visible(False)


def log_limits(values: Iterable[float], pad: float = 1.5) -> tuple[float, float]:
    """At least a decade."""
    values = list(values) or [1]
    low, high = min(values) / pad, max(values) * pad
    wider = math.sqrt(max(10 * low / high, 1))
    return low / wider, high * wider


def error_floor(errors: Iterable[float]) -> float:
    """Where an error of 0 is drawn on a logarithmic axis: half a decade below the others."""
    smallest = min((error for error in errors if error > 0), default=1e-12)
    return max(10 ** (math.floor(2 * math.log10(smallest)) / 2 - 0.5), 1e-18)
