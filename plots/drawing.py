"""Sheets, axes and files of figures. Lengths in inches, type in points."""
import math
import re
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
from PIL import Image

from command import text_writer
from records import Row
from words import plain, short, wrapped

# A page shows a figure about 830 pixels wide: 100 an inch of the widest, 7 points as 9.7 pixels.
PAGE_WIDTH, SMALLEST_PT = 8.3, 7
TYPE, MATH = 8, 10  # points; indices and exponents are set at 0.7 MATH
LINE, MARGIN = 0.155, 0.1  # between lines of a caption; of the sheet
STYLE = {"font.size": TYPE, "axes.linewidth": 0.6, "axes.labelsize": TYPE, "axes.titlesize": TYPE,
         "xtick.labelsize": TYPE, "ytick.labelsize": TYPE, "legend.fontsize": TYPE,
         "grid.color": "0.88", "grid.linewidth": 0.4, "axes.axisbelow": True,
         "xtick.major.size": 2.5, "ytick.major.size": 2.5, "xtick.minor.size": 1.5,
         "ytick.minor.size": 1.5, "svg.hashsalt": "airybench",
         # For publishers: fonts whole in a PDF (TrueType, no Type 3), words of an SVG as curves, which look
         # the same where the font is missing.
         "pdf.fonttype": 42, "svg.fonttype": "path"}
STOP = dict(marker="*", markersize=17, markeredgecolor="black", markeredgewidth=0.8,
            linestyle="none", zorder=7)  # the paper's stop
HEADROOM = 0.1  # of an axes' height, for arrows without a value
# Of a colour's value: what is left of it in steps of 6.
STEPS = (255 - (255 - np.arange(256) + 2) // 6 * 6).astype(np.uint8)
VECTOR_DPI, DPI, COLOURS = 200, 120, 128


@dataclass(frozen=True)
class Drawing:
    name: str                          # of its files
    rows: list[Row]                    # that it shows, or names
    draw: Callable[..., Figure | str]  # of rows and options: the figure, or why there is none
    table: Callable[[list[Row]], str]  # of rows: the numbers drawn, a CSV next to the figure
    vector: bool = False               # as .svg and .png; else as a small .png
    options: dict[str, object] = field(default_factory=dict)

    def figure(self) -> Figure | str:
        return self.draw(self.rows, **self.options)

    @property
    def suffixes(self) -> tuple[str, ...]:
        return (".svg", ".png", ".csv") if self.vector else (".png", ".csv")

    def writer(self, figure: Figure, suffix: str) -> Callable[[Path], object]:
        if suffix == ".csv":
            return text_writer(self.table(self.rows))
        return partial(write, figure) if self.vector else \
            partial(write_small_png, figure, DPI, colours=COLOURS)


def write(figure: Figure, path: Path) -> None:
    """The same bytes whenever it is drawn."""
    metadata = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}, ".png": {"Software": None}}
    figure.savefig(path, dpi=VECTOR_DPI, metadata=metadata[path.suffix])


def for_papers(figure: Figure, name: str) -> dict[str, Callable[[Path], object]]:
    """What --vector adds."""
    return {f"{name}{suffix}": partial(write, figure) for suffix in (".svg", ".pdf")}


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


def sheet(body: float, title: str, *texts: str, width: float = PAGE_WIDTH) -> Figure:
    """A figure with its title above and a caption below; `body`: the height between them."""
    lines = wrapped(texts, width - 2 * MARGIN, TYPE)
    height = body + LINE * len(lines) + MARGIN
    figure = Figure(figsize=(width, height))
    text_at(figure, MARGIN, 0.08, plain(title), fontsize=11, weight="bold")
    for k, line in enumerate(lines):
        figure.text(MARGIN / width, (height - body - 0.02 - k * LINE) / height, plain(line),
                    va="top", fontsize=TYPE)
    return figure


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


def side_by_side(figure: Figure, titles: Iterable[str], left: float, top: float, height: float,
                 gap: float, right: float = 0.1) -> list[Axes]:
    titles = list(titles)
    width = (figure.get_size_inches()[0] - left - right - (len(titles) - 1) * gap) / len(titles)
    row = []
    for k, title in enumerate(titles):
        axes = panel_at(figure, left + k * (width + gap), top, width, height)
        axes.set_title(plain(title), pad=3)
        axes.tick_params(labelleft=k == 0)
        row.append(axes)
    return row


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


def log_limits(values: Iterable[float | None], pad: float = 1.5) -> tuple[float, float]:
    """At least a decade; with headroom where there is a case without a value."""
    values = list(values)
    known = [value for value in values if value is not None] or [1]
    low, high = min(known) / pad, max(known) * pad
    wider = math.sqrt(max(10 * low / high, 1))
    low, high = low / wider, high * wider
    return low, high if None not in values else high * (high / low) ** (HEADROOM / (1 - HEADROOM))


def error_floor(errors: Iterable[float]) -> float:
    """Where an error of 0 is drawn on a logarithmic axis: half a decade below the others."""
    smallest = min((error for error in errors if error > 0), default=1e-12)
    return max(10 ** (math.floor(2 * math.log10(smallest)) / 2 - 0.5), 1e-18)
