"""Draws levels of an adaptive loop side by side: mesh and stress, and below where the error is."""
from __future__ import annotations

import re

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from field_drawing import COLORMAP, Scales, draw_body, draw_boundary
from field_panel import view_of
from fields import Fields
from figure_files import PAGE_WIDTH
from figure_words import plain

LEVEL = re.compile(r"(?P<mesh>.+)%2Badapt(?P<level>\d+)(?P<case>--.*)")  # of a case's files
SHOWN, WIDTH, LEFT, GAP, HIGHEST = 3, PAGE_WIDTH, 0.5, 0.12, 4.2  # inches
TITLE, WORDS, BARS = 0.55, 0.34, 0.75
SHADES = 24
DPI = 110


def chosen(names: list[str]) -> list[str]:
    """Three levels of the first loop that has as many: its first, a middle and its last one."""
    loops: dict[tuple[str, str], list[tuple[int, str]]] = {}
    for name in names:
        if found := LEVEL.fullmatch(name):
            loops.setdefault((found["mesh"], found["case"]), []).append((int(found["level"]), name))
    for levels in loops.values():
        if len(levels) >= SHOWN:
            ordered = [name for _, name in sorted(levels)]
            return [ordered[0], ordered[len(ordered) // 2], ordered[-1]]
    return []


def draw(levels: list[tuple[Fields, np.ndarray, float | None]]) -> Figure:
    """Of each level its fields, its triangles' shares (T,) of e², 1, and its total error."""
    scales = Scales.of([levels[-1][0]])  # of the finest
    view = view_of(levels[0][0])
    panel = (WIDTH - LEFT - len(levels) * GAP) / len(levels)
    height = panel * view.height
    if height > HIGHEST:
        panel, height = panel * HIGHEST / height, HIGHEST
    top = TITLE + 2 * (height + WORDS) + BARS
    figure = Figure(figsize=(WIDTH, top))
    figure.text(0.1 / WIDTH, 1 - 0.08 / top, plain(f"{levels[0][0].mesh.split('+')[0]}, adapted"),
                va="top", fontsize=11, weight="bold")
    step = (WIDTH - LEFT) / len(levels)
    norm = LogNorm(1e-2, 1e2, clip=True)
    shades = colormaps["cividis"].resampled(SHADES)
    for k, (s, share, error) in enumerate(levels):
        place = (LEFT + k * step + (step - GAP - panel) / 2) / WIDTH
        for row in (0, 1):
            axes = figure.add_axes(
                [place, 1 - (TITLE + (row + 1) * height + row * WORDS) / top, panel / WIDTH,
                 height / top], xlim=view.across, ylim=view.upward)
            axes.spines[:].set_visible(False)
            axes.tick_params(length=2, labelleft=k == 0, labelbottom=row == 1)
            if k == 0:
                axes.set_ylabel("y in mm", labelpad=2)
            if row == 0:
                draw_body(axes, s, scales)
                words = f"{len(s.corners)} triangles"
                axes.set_title(words if error is None else f"{words}, {100 * error:.2g} %", pad=4)
                continue
            axes.set_xlabel("x in mm", labelpad=1)
            axes.add_collection(PolyCollection(
                s.placed(s.triangles), array=np.maximum(share * len(share), norm.vmin), norm=norm,
                cmap=shades, edgecolor="none", rasterized=True))
            draw_boundary(axes, s)
    for left, mappable, words in (
            (0.08, ScalarMappable(scales.shear, COLORMAP),
             "largest shear stress in the plane, MPa; brightest: or more"),
            (0.56, ScalarMappable(norm, shades), "a triangle's part of the squared error over "
                                                 "their mean, 1")):
        bar = figure.colorbar(mappable, orientation="horizontal",
                              cax=figure.add_axes([left, 0.38 / top, 0.38, 0.1 / top]))
        bar.ax.tick_params(pad=1, length=2)
        bar.set_label(words, labelpad=0)
    return figure
