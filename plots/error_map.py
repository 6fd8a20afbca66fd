"""Draws the elements' shares of the discretisation error over a mesh."""
from __future__ import annotations

import math

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from case_names import words_of_file
from field_drawing import COLORMAP, draw_boundary
from field_panel import body_height, view_of, width_of
from fields import Fields
from figure_files import PAGE_WIDTH
from figure_words import plain, width_of as words_width

WIDTH, HIGHEST, LEFT, RIGHT, TOP, BOTTOM = PAGE_WIDTH, 5.0, 0.55, 0.15, 0.62, 0.92  # inches
DPI = 120
DECADES = 5  # of the scale at most
SHADES = 24  # few, for a small file
TENTH = 0.1


def draw(s: Fields, share: np.ndarray) -> Figure:
    """share (T,): of the squared error, 1; its triangles in the order of s."""
    width = min(WIDTH, width_of(s, HIGHEST))
    height = body_height(s, width)
    width = max(width, 5.5)
    figure = Figure(figsize=(width, TOP + height + BOTTOM))
    top = figure.get_size_inches()[1]
    view = view_of(s)
    across = height / view.height
    axes = figure.add_axes([((width + LEFT - RIGHT) / 2 - across / 2) / width, BOTTOM / top,
                            across / width, height / top], xlim=view.across, ylim=view.upward)
    high = 10.0 ** math.ceil(math.log10(share.max()))
    low = max(share[share > 0].min(), high / 10**DECADES)
    norm = LogNorm(10.0 ** math.floor(math.log10(low)), high, clip=True)
    shades = colormaps[COLORMAP].resampled(SHADES)
    axes.add_collection(PolyCollection(
        s.placed(s.triangles), array=np.maximum(share, norm.vmin), norm=norm, cmap=shades,
        edgecolor="white", linewidths=np.clip(10 / math.sqrt(len(share)), 0.06, 0.4),
        rasterized=True))
    draw_boundary(axes, s)
    axes.tick_params(length=2)
    axes.set_ylabel("y in mm", labelpad=2)
    axes.set_xlabel("x in mm", labelpad=1)
    axes.spines[:].set_visible(False)
    title = f"{words_of_file(s.name)}: where the discretisation error is"
    figure.text(0.1 / width, 1 - 0.1 / top, plain(title), va="top", weight="bold",
                fontsize=10 * min(1, 72 * (width - 0.2) / words_width(title, 10, "bold")))
    figure.text(0.1 / width, 1 - 0.32 / top, va="top", s=f"{len(share)} triangles; a tenth of them "
                f"has {100 * share_of_worst(share):.0f} % of the squared error.")
    bar = figure.colorbar(ScalarMappable(norm, shades), orientation="horizontal",
                          cax=figure.add_axes([0.15, 0.38 / top, 0.7, 0.1 / top]))
    bar.ax.tick_params(pad=1, length=2)
    bar.set_label("share of the squared error in a triangle, 1", labelpad=0)
    return figure


def share_of_worst(share: np.ndarray) -> float:
    """Of the tenth of the triangles that has most."""
    worst = np.sort(share)[::-1][:max(1, round(TENTH * len(share)))]
    return float(worst.sum() / share.sum())
