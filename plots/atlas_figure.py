"""The stability atlas: methods x scenes, a cell per case, coloured and lettered by its outcome."""
from __future__ import annotations

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

import study_parts as parts
from figure_files import Drawing
from figure_words import plain
from record_keys import OUTCOMES, Row
from selection import by_mesh

# Outcome -> letter, fill, colour of the letter; the letters and the lightness say it in grey.
MARKS = {
    "ok": ("", "#EAF3FA", "#123A5A"),
    "other_solution": ("2", "#CFE8D5", "#12402A"),
    "inaccurate": ("i", "#F5D76E", "black"),
    "unstressed": ("0", "#FFFFFF", "0.4"),
    "not_converged": ("n", "#E8A33D", "black"),
    "breakdown": ("b", "#B07A4A", "white"),
    "unverified": ("?", "#FFFFFF", "black"),
    "wrong_success": ("W!", "#D00060", "white"),
    "timeout": ("t", "#A9A9B8", "black"),
    "out_of_memory": ("m", "#6B6B80", "white"),
    "crashed": ("X", "#000000", "white"),
    "machine_fault": ("f", "#DADADA", "black"),
    "skipped": ("–", "#FFFFFF", "0.4"),
}
WORDS = {"other_solution": "another solution than the reference's",
         "unstressed": "no stress, so no relative error",
         "unverified": "said ok, and no reference can tell",
         "wrong_success": "wrong success: said ok, and is not", "timeout": "time limit reached",
         "machine_fault": "no process or no file to be had"}
CELL, ROW, RIGHT, TITLE, KEY = 0.29, 0.235, 0.75, 0.4, 0.62  # inches
LETTER = 0.078  # inches: of a name's letter, about
SIZE = 7.5
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")
DEEPEST = "#A9CDE8"  # of an ok case with 15 digits; with 6 it has the fill above


def digits(row: Row) -> str:
    """Whole digits of the largest error; none is known: +."""
    errors = [error for error in (row.error_stress, row.error_force) if error is not None]
    if not errors:
        return "+"
    return str(min(max(math.floor(-math.log10(max(*errors, 1e-17))), 0), 16))


def shade(number: str) -> str:
    """Fill of an ok case by its digits."""
    depth = (min(max(int(number), 6), 15) - 6) / 9 if number.isdigit() else 0
    light, deep = (np.array(to_rgb(colour)) for colour in (MARKS["ok"][1], DEEPEST))
    return to_hex(light + depth * (deep - light))


def columns_of(rows: list[Row]) -> list[tuple[str, str]]:
    """Group and scene, in the order of their names; numbers in a scene's name by size."""
    def key(column: tuple[str, str]) -> tuple[str, list[str], list[float]]:
        group, scene = column
        return group, NUMBER.split(scene), [float(number) for number in NUMBER.findall(scene)]
    return sorted({(row.scene_group, row.scene) for row in rows}, key=key)


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    for mesh, own in by_mesh([row for row in rows if row.study == "stability"]).items():
        yield Drawing(parts.file_name("stability", mesh), own, draw)


def draw(rows: list[Row]) -> Figure | str:
    """rows: of a stability study's mesh. The figure, or why there is none."""
    if not rows:
        return "no rows"
    columns = columns_of(rows)
    families = {row.method: row.family for row in sorted(rows, key=parts.order)}
    methods = list(families)
    groups = [(name, len(list(g))) for name, g in groupby(columns, key=lambda c: c[0])]
    left = 0.25 + LETTER * max(map(len, methods))
    above = 0.3 + 0.62 * LETTER * max(len(name) for name, _ in groups)
    below = 0.15 + LETTER * max(len(scene) for _, scene in columns)
    width = max(left + CELL * len(columns) + max(RIGHT, above), 9)
    top = TITLE + above
    body = top + ROW * len(methods) + below + KEY
    figure = parts.sheet(width, body, f"Stability on {rows[0].mesh}: {len(methods)} methods in "
                         f"{len(columns)} scenes", [
        "A row is a method, a column an extreme scene; scenes by group. ok: all errors and "
        "residuals at most the target; its number n says that the errors of stresses and contact "
        "forces are at most 1e-n; +: no such error is known. Empty: not in the study. "
        "Right: how many of its cases are ok."])
    height = figure.get_size_inches()[1]
    axes = figure.add_axes([left / width, (height - top - ROW * len(methods)) / height,
                            CELL * len(columns) / width, ROW * len(methods) / height],
                           xlim=(0, len(columns)), ylim=(len(methods), 0))
    draw_cells(axes, rows, columns, methods)
    draw_names(axes, rows, columns, families)
    draw_groups(axes, groups)
    draw_key(figure, rows, parts.MARGIN, body - KEY + 0.1, width)
    return figure


def draw_cells(axes: Axes, rows: list[Row], columns: list[tuple[str, str]],
               methods: list[str]) -> None:
    for row in rows:
        letter, fill, ink = MARKS[row.outcome]
        if row.outcome == "ok":
            letter, fill = digits(row), shade(digits(row))
        x, y = columns.index((row.scene_group, row.scene)), methods.index(row.method)
        wrong = row.outcome == "wrong_success"
        # Not add_patch: it measures each for the limits, which are set.
        axes.add_artist(Rectangle((x, y), 1, 1, facecolor=fill, zorder=2 + wrong, clip_on=False,
                                  edgecolor="black" if wrong else "white",
                                  linewidth=1.6 if wrong else 0.6))
        axes.text(x + 0.5, y + 0.53, letter, color=ink, ha="center", va="center",
                  fontsize=SIZE, zorder=4, weight="normal" if row.outcome == "ok" else "bold")


def draw_names(axes: Axes, rows: list[Row], columns: list[tuple[str, str]],
               families: dict[str, str]) -> None:
    methods = list(families)
    axes.set_xticks([k + 0.5 for k in range(len(columns))],
                    [plain(scene) for _, scene in columns], rotation=90, fontsize=SIZE)
    axes.set_yticks([k + 0.5 for k in range(len(methods))], map(plain, methods), fontsize=8)
    axes.tick_params(length=0, pad=3)
    axes.spines[:].set_visible(False)
    count = Counter(row.method for row in rows)
    ok = Counter(row.method for row in rows if row.outcome == "ok")
    for k, method in enumerate(methods):
        axes.annotate(f"{ok[method]} of {count[method]}", (1, k + 0.53), xytext=(5, 0),
                      xycoords=axes.get_yaxis_transform(), textcoords="offset points",
                      va="center", fontsize=SIZE, color="0.3")
        if k and families[method] != families[methods[k - 1]]:
            axes.plot([0, len(columns)], [k, k], color="0.25", linewidth=0.8, zorder=2.5)


def draw_groups(axes: Axes, groups: list[tuple[str, int]]) -> None:
    """A bracket over the scenes of each, and its name."""
    start = 0
    for name, count in groups:
        end = start + count
        if start:
            axes.axvline(start, color="0.25", linewidth=0.8, zorder=2.5)
        bracket = [start + 0.12, start + 0.12, end - 0.12, end - 0.12], [-0.2, -0.45, -0.45, -0.2]
        axes.plot(*bracket, color="black", linewidth=0.8, clip_on=False)
        axes.text((start + end) / 2, -0.65, plain(name), rotation=40, rotation_mode="anchor",
                  ha="left", va="bottom", fontsize=8)
        start = end


def draw_key(figure: Figure, rows: list[Row], left: float, top: float, width: float,
             of_ok: tuple[str, str] = ("12", "ok, with the digits of its largest error")) -> None:
    """The outcomes, with counts, in a line or two. of_ok: in its field, and beside it."""
    height = figure.get_size_inches()[1]
    count = Counter(row.outcome for row in rows)
    x = left
    for outcome in OUTCOMES:
        if not count[outcome] and outcome != "wrong_success":
            continue
        letter, fill, ink = MARKS[outcome]
        words = of_ok[1] if outcome == "ok" else WORDS.get(outcome, outcome.replace("_", " "))
        words += f": {count[outcome]}"
        needed = 0.36 + 0.066 * len(words) + 0.22
        if x + needed > width:
            x, top = left, top + 0.25
        figure.add_artist(Rectangle((x / width, 1 - (top + 0.19) / height), 0.28 / width,
                                    0.19 / height, facecolor=fill, edgecolor="0.5",
                                    linewidth=0.5))
        figure.text((x + 0.14) / width, 1 - (top + 0.1) / height, letter or of_ok[0], color=ink,
                    ha="center", va="center", fontsize=SIZE, weight="bold" if letter else "normal")
        figure.text((x + 0.36) / width, 1 - (top + 0.1) / height, words, va="center", fontsize=8,
                    weight="bold" if outcome == "wrong_success" else "normal")
        x += needed
