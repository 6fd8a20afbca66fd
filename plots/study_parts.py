"""What the studies' figures share: colours and markers of methods, sheets with captions, words."""
from __future__ import annotations

import math
import re
from collections.abc import Iterable

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from figure_parts import axes_at
from figure_words import plain, short, span, wrapped
from record_keys import Row

TYPE, LINE, MARGIN = 8, 0.155, 0.1  # points; inches
STOP = dict(marker="*", markersize=17, markeredgecolor="black", markeredgewidth=0.8,
            linestyle="none", zorder=7)  # the paper's stop


def order(row: Row) -> tuple[int, str]:
    """Sorts by family, then by method."""
    return row.look.rank, row.method


def file_name(stem: str, mesh: str) -> str:
    """The mesh may be named anyhow."""
    return f"{stem}_{re.sub('[^A-Za-z0-9._-]', '-', mesh)}"


def threads(rows: list[Row]) -> str:
    count = span(row.threads for row in rows)
    return f"{count} thread{'' if count == '1' else 's'}"


def percent(value: float) -> str:
    """0.0712 -> 7.1 %; what is too small for that as 1e-6."""
    return f"{100 * value:.2g}\u00a0%" if 1e-4 <= value < 1 else f"{value:.2g}" \
        if 1 <= value < 100 else short(value)


def seconds(value: float) -> str:
    return f"{1e3 * value:.2g}\u00a0ms" if value < 0.0995 else f"{value:.2g}\u00a0s" \
        if value < 99.5 else f"{value:.0f}\u00a0s"


def mebibytes(value: float | None) -> str:
    if value is None:
        return "–"
    mib = value / 2**20
    return f"{mib:.2g}\u00a0MiB" if mib < 99.5 else f"{mib:.0f}\u00a0MiB"


def sheet(width: float, body: float, title: str, texts: Iterable[str]) -> Figure:
    """A figure of so many inches, made higher by the lines of its caption below."""
    lines = [line for text in texts if text for line in wrapped(text, width - 2 * MARGIN, TYPE)]
    height = body + LINE * len(lines) + MARGIN
    figure = Figure(figsize=(width, height))
    figure.text(MARGIN / width, 1 - 0.08 / height, plain(title), va="top", fontsize=11,
                weight="bold")
    for k, line in enumerate(lines):
        figure.text(MARGIN / width, (height - body - 0.02 - k * LINE) / height, plain(line),
                    va="top", fontsize=TYPE)
    return figure


def side_by_side(figure: Figure, titles: Iterable[str], left: float, top: float, height: float,
                 gap: float) -> list[Axes]:
    """A row of panels with a grid; the first has the numbers of the y-axis. In inches."""
    titles = list(titles)
    width = (figure.get_size_inches()[0] - left - 0.1 - (len(titles) - 1) * gap) / len(titles)
    row = []
    for k, title in enumerate(titles):
        axes = axes_at(figure, left + k * (width + gap), top, width, height)
        axes.set_title(plain(title), pad=3)
        axes.grid(which="major")
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelleft=k == 0)
        row.append(axes)
    return row


def error_floor(errors: Iterable[float]) -> float:
    """Where an error of 0 is drawn on a logarithmic axis: half a decade below the others."""
    smallest = min((error for error in errors if error > 0), default=1e-12)
    return max(10 ** (math.floor(2 * math.log10(smallest)) / 2 - 0.5), 1e-18)
