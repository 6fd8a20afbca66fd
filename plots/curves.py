#!/usr/bin/python3
"""Draws a model's curves with their numbers, from what `meshgen --show=MODEL --out=-` writes.

    curves.py CURVES.json PICTURE.png

meshgen --show=MODEL calls it. Exit 2: wrong input; one line says which, and nothing is written.
"""
import argparse
import json
from functools import partial
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

import command
from drawing import MARGIN, PAGE_WIDTH, STYLE, TYPE, write
from field_drawing import ROLE
from records import RecordsError
from words import plain

FAINT = dict(facecolors="0.93", edgecolors="0.8", linewidths=0.3)
COLOURS = ("tab:blue", "tab:orange", "tab:green", "tab:purple", "tab:red", "tab:cyan", "tab:brown",
           "tab:olive", "tab:pink", "black")
HIGHEST, LEGEND = 7.0, 0.5  # inches: the body's picture; below it


def middle_of(walk: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Halfway along a walk, and the unit normal there that leads out of the body."""
    steps = np.diff(walk, axis=0)
    lengths = np.hypot(*steps.T)
    passed = np.cumsum(lengths)
    k = int(np.searchsorted(passed, passed[-1] / 2))
    along = steps[k] / lengths[k]
    place = walk[k] + along * (passed[-1] / 2 - passed[k] + lengths[k])
    return place, np.array([along[1], -along[0]])


def draw(model: dict) -> Figure:
    vertices = np.array(model["vertices_mm"])
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    width, height = high - low
    scale = min(0.8 * PAGE_WIDTH / width, HIGHEST / height)
    size = np.array([PAGE_WIDTH, scale * height + 1.3 + LEGEND])
    figure = Figure(figsize=tuple(size))
    axes = figure.add_axes((MARGIN / size[0] + 0.05, (LEGEND + 0.3) / size[1], 0.9,
                            (size[1] - LEGEND - 0.6) / size[1]))
    axes.set_aspect("equal")
    axes.add_collection(PolyCollection(vertices[np.array(model["triangles"])], **FAINT))
    colours: dict[object, str] = {}  # curves of one group share theirs
    for curve in model["curves"]:
        group = tuple(curve["names"]) or curve["number"]
        colour = colours.setdefault(group, COLOURS[len(colours) % len(COLOURS)])
        style = ROLE[curve["role"].partition(":")[0]] | {"color": colour}
        for walk in curve["walks_mm"]:
            axes.plot(*np.array(walk).T, **style)
        place, outward = middle_of(np.array(curve["walks_mm"][0]))
        axes.annotate(str(curve["number"]), place, xytext=9 * outward, textcoords="offset points",
                      ha="center", va="center", color=colour, fontsize=TYPE + 1, fontweight="bold",
                      path_effects=[withStroke(linewidth=2, foreground="white")])
    axes.set_xlabel("x, mm")
    axes.set_ylabel("y, mm")
    axes.margins(0.06)
    axes.set_title(plain(f"{model['model']}: curves by their numbers"))
    styles = [Line2D([], [], **(style | {"color": "black"}), label=role) for role, style in ROLE.items()]
    figure.legend(handles=styles, loc="lower center", ncols=3, frameon=False)
    return figure


def show(arguments: argparse.Namespace) -> None:
    try:
        model = json.loads(arguments.curves.read_text(encoding="utf-8"))
    except ValueError as error:
        raise RecordsError(f"{arguments.curves}: {error}; expected the JSON of meshgen --show") from error
    with matplotlib.rc_context(STYLE):
        command.replace_all(arguments.picture.parent,
                            {arguments.picture.name: partial(write, draw(model))})


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("curves", type=Path, metavar="CURVES.json")
    parser.add_argument("picture", type=Path, metavar="PICTURE.png")


def main() -> None:
    command.run(__doc__, add_arguments, show, "a picture's place")


if __name__ == "__main__":
    main()
