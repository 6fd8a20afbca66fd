#!/usr/bin/python3
"""Draws published values and ours, after `bench validate`, and writes their table into docs/validation.md.

    validation.py FOLDER [--out DIR] [--page FILE]

FOLDER has validation.json. published.png (default: in FOLDER/figures): each profile next to the
published one, and how far every single value is off next to what is allowed. --page: a table of
HYBRID's values in FILE, between <!-- published cases --> and <!-- end of table -->, and below it the
sources.
"""
import argparse
import json
import re
from functools import partial
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import drawing
from command import replace_all, run, text_writer
from drawing import COLOURS, DPI, PAGE_WIDTH, write_small_png
from records import RecordsError, text_of
from words import plain

STYLE = drawing.STYLE | {"axes.titlesize": 8, "axes.spines.top": False, "axes.spines.right": False}
OURS = dict(color="#0072B2", linestyle="", marker="o", markersize=3)
PUBLISHED = dict(color="black", linewidth=0.8)
LEAST = 1e-6  # deviation that is shown
TABLE = re.compile(r"(<!-- published cases -->\n).*?(<!-- end of table -->)", re.DOTALL)


def read(folder: Path) -> list[dict]:
    """The values of HYBRID, a row each."""
    path = folder / "validation.json"
    try:
        rows = json.loads(text_of(path))
        return [row for row in rows if row["method"].startswith("HYBRID")]
    except (ValueError, KeyError, TypeError) as error:
        raise RecordsError(f"{path}: {error}; expected what bench validate writes")


def along(points: list[list[float]]) -> np.ndarray:
    """mm from the first point."""
    steps = np.linalg.norm(np.diff(np.array(points), axis=0), axis=1)
    return np.concatenate([[0], np.cumsum(steps)])


def draw_profile(axes: Axes, row: dict) -> None:
    s = along(row["at_mm"])
    axes.plot(s, row["published"], **PUBLISHED)
    axes.plot(s, row["ours"], **OURS)
    axes.set(title=plain(row["title"]), xlabel="along the points, mm", ylabel=plain(f"{row['quantity']}, {row['unit']}"))


def draw_deviations(axes: Axes, rows: list[dict]) -> None:
    """A line per case: its values, and the largest deviation that is allowed to one of them."""
    cases = {name: k for k, name in enumerate(dict.fromkeys(row["case"] for row in rows))}
    allowed = {name: max(row["allowed"] for row in rows if row["case"] == name) for name in cases}
    known = [row for row in rows if row["deviation"] is not None]
    axes.hlines(cases.values(), LEAST, allowed.values(), color="0.85", linewidth=4, label="allowed")
    axes.plot([max(abs(row["deviation"]), LEAST) for row in known], [cases[row["case"]] for row in known], **OURS,
              label=f"deviation; at the left: {LEAST:g} or less")
    axes.set_yticks(range(len(cases)), map(plain, cases), fontsize=7)
    axes.set(xscale="log", ylim=(len(cases) - 0.5, -0.5), xlim=(LEAST / 2, 0.2),
             xlabel="deviation, relative to the published value")
    axes.legend(frameon=False, loc="lower left", bbox_to_anchor=(0, 1), ncols=2)


def draw(rows: list[dict]) -> Figure:
    profiles = [row for row in rows if len(row["published"]) > 1 and row["ours"]]
    lines = -(-len(profiles) // 3)
    heights = [1.7] * lines + [0.6 + 0.145 * len({row["case"] for row in rows})]
    figure = Figure(figsize=(PAGE_WIDTH, sum(heights) + 0.4), layout="constrained")
    grid = figure.add_gridspec(lines + 1, 3, height_ratios=heights)
    for k, row in enumerate(profiles):
        draw_profile(figure.add_subplot(grid[k // 3, k % 3]), row)
    draw_deviations(figure.add_subplot(grid[lines, :]), rows)
    return figure


def percent(x: float) -> str:
    """What rounding decides is not printed: it differs from processor to processor."""
    return f"{100 * x:.2g}\u00a0%" if x >= LEAST or x == 0 else f"below {100 * LEAST:g}\u00a0%"


def number(x: float | None) -> str:
    return "–" if x is None else f"{x:.5g}"


def values(row: dict, key: str) -> str:
    return f"{len(row[key])} points" if len(row[key]) > 1 else number(row[key][0] if row[key] else None)


def table_of(rows: list[dict]) -> str:
    lines = ["| case | quantity | published | ours | off by |", "|---|---|---|---|---|"]
    for k, row in enumerate(rows):
        is_first = k == 0 or rows[k - 1]["case"] != row["case"]
        half_width = row["off"] or 0
        is_wide = row["ours"] and half_width > LEAST * abs(row["ours"][0])
        ours = values(row, "ours") + f" ± {half_width:.2g}" * bool(is_wide)
        off = "–" if row["deviation"] is None else percent(abs(row["deviation"]))
        lines.append(f"| {row['title'] + ' `' + row['case'] + '`' if is_first else ''} | {row['quantity']} | "
                     f"{values(row, 'published')} {row['unit']} | {ours} | {off} |")
    cases: dict[str, dict[str, None]] = {}  # by source
    for row in rows:
        cases.setdefault(row["source"], {})[f"`{row['case']}`"] = None
    return "\n".join([*lines, "", *(f"- {', '.join(names)}: {source}" for source, names in cases.items())]) + "\n"


def page_of(text: str, rows: list[dict], path: Path) -> str:
    if not TABLE.search(text):
        raise RecordsError(f"{path}: no table; expected <!-- published cases --> and <!-- end of table -->")
    return TABLE.sub(lambda match: match[1] + table_of(rows) + match[2], text)


def make(args: argparse.Namespace) -> None:
    rows = read(args.results)
    out = args.out or args.results / "figures"
    with matplotlib.rc_context(STYLE):
        out.mkdir(exist_ok=True)
        replace_all(out, {"published.png": partial(write_small_png, draw(rows), DPI, colours=COLOURS)})
    if args.page:
        text = page_of(text_of(args.page), rows, args.page)
        replace_all(args.page.parent, {args.page.name: text_writer(text)})
    print(out / "published.png")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=Path, metavar="FOLDER")
    parser.add_argument("--out", type=Path)
    parser.add_argument("--page", type=Path)


def main() -> None:
    run(__doc__, add_arguments, make, "a folder of bench validate")


if __name__ == "__main__":
    main()
