"""The stability atlas: scenes x methods, a cell per case, coloured and lettered by its outcome."""
import math
import re
from collections import Counter
from collections.abc import Iterator
from itertools import groupby

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from drawing import SMALLEST_PT, Drawing, axes_at, file_name, sheet
from outcomes import MARKS, SIZE, Key, in_blocks
from records import Row
from selection import by_mesh, by_method, by_stop, order, with_suffix
from words import at_stop, csv_of, plain, width_of

CELL, NARROWEST, ROW, TITLE, BETWEEN = 0.32, 0.112, 0.16, 0.42, 0.25  # inches
WITH_DIGITS = 0.2  # inches: a cell in which an ok case's digits have room
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")
DEEPEST = "#7FB6DE"  # of an ok case with 15 digits; with 6 it has the fill above


def digits(row: Row) -> str:
    """Whole digits of the largest error; "+" if none is known."""
    errors = [error for error in (row.error_stress, row.error_force) if error is not None]
    if not errors:
        return "+"
    return str(min(max(math.floor(-math.log10(max(*errors, 1e-17))), 0), 16))


def shade(number: str) -> str:
    depth = (min(max(int(number), 6), 15) - 6) / 9 if number.isdigit() else 0
    light, deep = (np.array(to_rgb(colour)) for colour in (MARKS["ok"][1], DEEPEST))
    return to_hex(light + depth * (deep - light))


def scenes_of(rows: list[Row]) -> list[tuple[str, str]]:
    """Group and scene, in the order of their names; numbers in a scene's name by size."""
    def key(scene: tuple[str, str]) -> tuple[str, list[str], list[float]]:
        group, name = scene
        return group, NUMBER.split(name), [float(number) for number in NUMBER.findall(name)]
    return sorted({(row.scene_group, row.scene) for row in rows}, key=key)


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    for mesh, study in by_mesh([row for row in rows if row.study == "stability"]).items():
        for stop, own in by_stop(study).items():
            yield Drawing(with_suffix(file_name("stability", mesh), stop), own, draw, table_of)


def table_of(rows: list[Row]) -> str:
    place = {scene: k for k, scene in enumerate(scenes_of(rows))}
    rows = sorted(rows, key=lambda row: (place[row.scene_group, row.scene], order(row)))
    return csv_of(rows, "mesh", "scene_group", "scene", "method", "outcome",
                  ("digits", lambda row: digits(row) if row.outcome == "ok" else None),
                  "error_stress", "error_force")


def draw(rows: list[Row]) -> Figure:
    """A row per scene, below a line with its group's name; a column per method, in several grids where
    cells would be too narrow."""
    scenes = scenes_of(rows)
    left = 0.2 + max([width_of(scene, SIZE) for _, scene in scenes]
                     + [width_of(group, 8, "bold") for group, _ in scenes]) / 72
    lines = [line for group, own in groupby(scenes, key=lambda scene: scene[0])
             for line in ((group, ""), *own)]
    methods = list(by_method(rows, "n_phi"))
    grids, cell = in_blocks(methods, left, NARROWEST, CELL)
    height = ROW * len(lines)
    above = 0.1 + max(width_of(row.method, SIZE) for row in rows) / 72
    below = 0.5  # counts
    block = above + height + below
    deep = cell < WITH_DIGITS
    key = Key(rows, ("", "ok, deeper: more digits") if deep else
              ("12", "ok, with the digits of its largest error"))
    body = TITLE + len(grids) * (block + BETWEEN) + key.height
    figure = sheet(
        body, f"Stability on {rows[0].mesh}: {len(methods)} methods in {len(scenes)} scenes"
        f"{at_stop(rows)}",
        "A column is a method, a row an extreme scene, by group. ok: all errors and residuals at "
        "most the target; " + ("the deeper its blue, the smaller its errors of stresses and contact "
                               "forces, from 1e-6 to 1e-15. " if deep else
                               "its number n: the errors of stresses and contact forces are at "
                               "most 1e-n; +: no such error is known. ") +
        "Empty: not in the study. Below: how many of a method's cases are ok.")
    for k, grid in enumerate(grids):
        axes = axes_at(figure, left, TITLE + k * (block + BETWEEN) + above, cell * len(grid), height,
                       xlim=(0, len(grid)), ylim=(len(lines), 0))
        own = [row for row in rows if row.method in grid]
        draw_cells(axes, own, lines, grid, cell >= WITH_DIGITS)
        draw_names(axes, own, lines, grid)
    key.draw(figure, body - key.height + 0.1)
    return figure


def draw_cells(axes: Axes, rows: list[Row], lines: list[tuple[str, str]], methods: list[str],
               with_digits: bool) -> None:
    for row in rows:
        letter, fill, ink = MARKS[row.outcome]
        if row.outcome == "ok":
            letter, fill = digits(row) if with_digits else "", shade(digits(row))
        x, y = methods.index(row.method), lines.index((row.scene_group, row.scene))
        wrong = row.outcome == "wrong_success"
        # Not add_patch: it measures each for the limits, which are set.
        axes.add_artist(Rectangle((x, y), 1, 1, facecolor=fill, zorder=2 + wrong, clip_on=False,
                                  edgecolor="black" if wrong else "white",
                                  linewidth=1.6 if wrong else 0.6))
        if letter:
            axes.text(x + 0.5, y + 0.53, letter, color=ink, ha="center", va="center", zorder=4,
                      fontsize=SMALLEST_PT, weight="normal" if row.outcome == "ok" else "bold")


def draw_names(axes: Axes, rows: list[Row], lines: list[tuple[str, str]],
               methods: list[str]) -> None:
    scenes = [(k, scene) for k, (_, scene) in enumerate(lines) if scene]
    axes.set_yticks([k + 0.5 for k, _ in scenes], [plain(scene) for _, scene in scenes],
                    fontsize=SIZE)
    axes.set_xticks([k + 0.5 for k in range(len(methods))], map(plain, methods),
                    rotation=90, fontsize=SIZE)
    axes.tick_params(length=0, pad=3, labeltop=True, labelbottom=False)
    axes.spines[:].set_visible(False)
    for k, (group, scene) in enumerate(lines):
        if not scene:
            axes.annotate(plain(group), (0, k + 0.6), xycoords=axes.get_yaxis_transform(),
                          xytext=(-3, 0), textcoords="offset points", ha="right", va="center",
                          fontsize=8, weight="bold")
            axes.axhline(k + 0.9, color="0.25", linewidth=0.6, zorder=1)
    families = {row.method: row.family for row in rows}
    count = Counter(row.method for row in rows)
    ok = Counter(row.method for row in rows if row.outcome == "ok")
    for k, method in enumerate(methods):
        axes.annotate(f"{ok[method]}/{count[method]}", (k + 0.53, 0), xytext=(0, -4),
                      xycoords=axes.get_xaxis_transform(), textcoords="offset points",
                      ha="center", va="top", rotation=90, fontsize=SMALLEST_PT, color="0.3")
        if k and families[method] != families[methods[k - 1]]:
            axes.axvline(k, color="0.25", linewidth=0.8, zorder=2.5)
    axes.annotate("ok", (0, 0), xycoords="axes fraction", xytext=(-3, -4), ha="right", va="top",
                  textcoords="offset points", fontsize=SIZE, color="0.3")
