#!/usr/bin/python3
"""Draws published values and ours, after `bench validate`, and writes their tables into docs/validation.md.

    validation.py FOLDER [--out DIR] [--page FILE]

FOLDER has validation.json, or validation.json.gz. In DIR (default: FOLDER/figures): published.png, how far every
value of the method that adapted the mesh is off, next to what is allowed; published_profiles.png, each profile and
its closed form. --page: in FILE, between <!-- published cases --> and <!-- end of table -->, a row per case with its
largest deviation, and the sources; between <!-- published by method --> and <!-- end of table --> a row per method.
"""
import argparse
import json
import re
from collections import Counter
from functools import partial
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import drawing
from command import replace_all, run, text_writer
from drawing import COLOURS, DPI, PAGE_WIDTH, write_small_png
from records import RecordsError, text_of
from words import plain

STYLE = drawing.STYLE | {"axes.titlesize": 8, "axes.spines.top": False, "axes.spines.right": False}
OURS = dict(color="#0072B2", linestyle="", marker="o", markersize=3)
PUBLISHED = dict(color="black", linestyle="", marker="o", markersize=6, fillstyle="none", markeredgewidth=0.6)
LEAST = 1e-6  # deviation that is shown
COLUMNS = 3  # of profiles
PROGRAM = "EXTERNAL:"
CASES = Path(__file__).resolve().parents[1] / "validation"


def current_words(case: str) -> dict:
    """Title and source as the case's file has them now: they were not measured."""
    path = CASES / f"{case}.json"
    if not path.exists():
        return {}
    now = json.loads(path.read_text(encoding="utf-8"))
    return {key: now[key] for key in ("title", "source")}


def read(folder: Path) -> list[dict]:
    """The cases, each with its quantities and the answers of methods; the first is that of the adapting one."""
    path = folder / "validation.json"
    if not path.exists():
        path = folder / "validation.json.gz"
    try:
        cases = json.loads(text_of(path))
        for case in cases:
            for answer in case["answers"]:
                if len(answer["values"]) != len(case["quantities"]):
                    raise ValueError(f"{case['case']}: {answer['method']}: not one value per quantity")
        return [case | current_words(case["case"]) for case in cases]
    except (ValueError, KeyError, TypeError) as error:
        raise RecordsError(f"{path}: {error}; expected what bench validate writes")


def rows_of(cases: list[dict]) -> list[dict]:
    """The values of the method that adapted the mesh, a row each."""
    return [{"case": case["case"], "title": case["title"], **quantity, **value}
            for case in cases for quantity, value in zip(case["quantities"], case["answers"][0]["values"])]


def along(points: list[list[float]]) -> tuple[np.ndarray, str]:
    """mm, and what of: the coordinate that alone changes, or the way from the first point."""
    x, y = np.array(points).T
    for values, name in ((x, "x"), (y, "y")):
        other = y if name == "x" else x
        if np.ptp(other) < 0.01 * np.ptp(values):
            return values, f"{name}, mm"
    return np.concatenate([[0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))]), "from the first point, mm"


def draw_profile(axes: Axes, row: dict) -> None:
    """The largest value with its interval, where there is one."""
    s, where = along(row["at_mm"])
    published, ours = np.array(row["published"]), np.array(row["ours"])
    axes.fill_between(s, *(published + side * row["allowed"] * np.abs(published).max() for side in (-1, 1)),
                      color="0.8", linewidth=0)
    axes.plot(s, published, **PUBLISHED)
    axes.plot(s, ours, **OURS)
    if row["off"]:
        peak = np.abs(ours).argmax()
        axes.errorbar(s[peak], ours[peak], row["off"], color=OURS["color"], capsize=3, linewidth=0.8)
    axes.set_title(plain(f"{row['case']}: {row['name']}"), pad=3, fontsize=drawing.SMALLEST_PT)
    axes.set_ylabel(row["unit"], fontsize=drawing.SMALLEST_PT)
    axes.set_xlabel(where, fontsize=drawing.SMALLEST_PT)
    axes.tick_params(labelsize=drawing.SMALLEST_PT)


def draw_profiles(rows: list[dict]) -> Figure:
    profiles = [row for row in rows if len(row["published"]) > 1 and row["ours"]]
    lines = -(-len(profiles) // COLUMNS)
    heights = [0.25, *[1.45] * lines]
    figure = Figure(figsize=(PAGE_WIDTH, sum(heights)), layout="constrained")
    grid = figure.add_gridspec(lines + 1, COLUMNS, height_ratios=heights)
    for k, row in enumerate(profiles):
        draw_profile(figure.add_subplot(grid[1 + k // COLUMNS, k % COLUMNS]), row)
    legend = figure.add_subplot(grid[0, :])
    legend.axis("off")
    legend.legend([Line2D([], [], **PUBLISHED), Line2D([], [], **OURS), Patch(color="0.8"),
                   Line2D([], [], color=OURS["color"], marker="_", linestyle="", markersize=7)],
                  ["closed form", "ours", "allowed", "interval of the largest pressure"], frameon=False,
                  loc="center", ncols=4)
    return figure


def draw_deviations(rows: list[dict]) -> Figure:
    """A line per case: its values, and the largest deviation that is allowed to one of them."""
    cases = {name: k for k, name in enumerate(dict.fromkeys(row["case"] for row in rows))}
    allowed = {name: max(row["allowed"] for row in rows if row["case"] == name) for name in cases}
    known = [row for row in rows if row["deviation"] is not None]
    figure = Figure(figsize=(PAGE_WIDTH, 1 + 0.145 * len(cases)), layout="constrained")
    axes = figure.add_subplot()
    axes.hlines(cases.values(), LEAST, allowed.values(), color="0.85", linewidth=4, label="allowed")
    axes.plot([max(abs(row["deviation"]), LEAST) for row in known], [cases[row["case"]] for row in known], **OURS,
              label=f"deviation; at the left: {LEAST:g} or less")
    axes.set_yticks(range(len(cases)), map(plain, cases), fontsize=7)
    axes.set(xscale="log", ylim=(len(cases) - 0.5, -0.5), xlim=(LEAST / 2, 0.2),
             xlabel="deviation, relative to the published value")
    axes.legend(frameon=False, loc="lower left", bbox_to_anchor=(0, 1), ncols=2)
    return figure


def percent(x: float) -> str:
    """What rounding decides is not printed: it differs from processor to processor."""
    return f"{100 * x:.2g}\u00a0%" if x >= LEAST or x == 0 else f"below {100 * LEAST:g}\u00a0%"


def worst(case: dict) -> dict:
    """The value of the adapting method that is farthest off; of those equal to rounding, the first."""
    known = [row for row in rows_of([case]) if row["deviation"] is not None]
    return max(known, key=lambda row: max(abs(row["deviation"]), LEAST), default={})


def values(row: dict) -> str:
    if len(row["published"]) > 1:
        return f"{len(row['published'])} points"
    return f"{row['published'][0]:.5g} {row['unit']}".rstrip() + f", ours {row['ours'][0]:.5g}"


def table_of_cases(cases: list[dict]) -> str:
    """Of each case how many values agree, and the one with the largest deviation."""
    lines = ["| case | values | largest deviation | of | allowed, because |", "|---|---|---|---|---|"]
    for case in cases:
        row = worst(case)
        found = [percent(abs(row["deviation"])),
                 f"{row['name']}: {values(row)}" if abs(row["deviation"]) >= LEAST else "all",
                 f"{100 * row['allowed']:.2g}\u00a0%: {row['because']}"] if row else ["–"] * 3
        cells = [f"{case['title']} `{case['case']}`", str(len(case["quantities"])), *found]
        lines.append(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |")
    of_source: dict[str, list[str]] = {}
    for case in cases:
        of_source.setdefault(case["source"], []).append(f"`{case['case']}`")
    return "\n".join([*lines, "", *(f"- {', '.join(names)}: {source}" for source, names in of_source.items())]) + "\n"


class Reasons:
    """Of cases that a method has no answer to: letters, and what they stand for."""

    def __init__(self) -> None:
        self.letters: dict[str, str] = {}

    def letter(self, answer: dict) -> str:
        text = f"{answer['status']}: {answer['reason']}".removeprefix("skipped: ")
        text = re.sub(r"(?<![A-Z\d])(\d[\d.e+-]*\d|\d)", "…", text)  # sizes differ from case to case
        count = len(self.letters)
        return self.letters.setdefault(text, ("" if count < 26 else chr(96 + count // 26)) + chr(97 + count % 26))

    def lines(self) -> list[str]:
        return [f"- *{letter}*: {text}" for text, letter in self.letters.items()]


def is_answered(answer: dict) -> bool:
    return answer["time_s"] is not None


def deviations(answer: dict) -> list[float]:
    return [abs(value["deviation"]) for value in answer["values"] if value["deviation"] is not None]


def agrees(answer: dict) -> bool:
    return all(value["verdict"] == "agrees" for value in answer["values"] if value["deviation"] is not None)


def median(numbers: list[float]) -> str:
    return f"{np.median(numbers):.2g}" if numbers else "–"


def row_of_method(method: str, cases: list[dict], reasons: Reasons) -> str:
    answers = [(answer, case["answers"][0]) for case in cases for answer in case["answers"]
               if answer["method"] == method]
    solved = [(answer, adapting) for answer, adapting in answers if is_answered(answer)]
    known = [answer for answer, _ in solved if deviations(answer)]
    unsolved = Counter(reasons.letter(answer) for answer, _ in answers if not is_answered(answer))
    return " | ".join([f"| {method.removeprefix(PROGRAM)}", str(len(solved)), f"{sum(map(agrees, known))} of {len(known)}",
                       median([100 * max(deviations(answer)) for answer in known]),
                       median([100 * answer["error_total"] for answer, _ in solved if answer["error_total"] is not None]),
                       median([answer["time_s"] / adapting["time_s"] for answer, adapting in solved if adapting["time_s"]]),
                       ", ".join(f"{count} *{letter}*" for letter, count in unsolved.items()) + " |"])


def table_of_methods(cases: list[dict]) -> str:
    """How many cases each method solves, how far off, at what cost, and why not the others; and each deviation."""
    methods = sorted({answer["method"] for case in cases for answer in case["answers"][1:]},
                     key=lambda method: (method.startswith(PROGRAM), method))
    reasons = Reasons()
    rows = [row_of_method(method, cases, reasons) for method in methods]
    names = [method.removeprefix(PROGRAM) for method in methods]
    return "\n".join(["| method or program | solved | all values agree | deviation, % | total error, % | time ratio | not solved |",
                      "|---|---|---|---|---|---|---|", *rows, "",
                      "Largest deviation of each case in %; in italics beyond what is allowed, or a letter of the reasons below.", "",
                      f"| case | {' | '.join(names)} |", "|---" * (len(names) + 1) + "|",
                      *(row_of_deviations(case, methods, reasons) for case in cases), "", *reasons.lines()]) + "\n"


def row_of_deviations(case: dict, methods: list[str], reasons: Reasons) -> str:
    answers = {answer["method"]: answer for answer in case["answers"]}

    def cell(method: str) -> str:
        answer = answers.get(method)
        if answer is None:
            return ""
        if not is_answered(answer):
            return f"*{reasons.letter(answer)}*"
        off = deviations(answer)
        text = f"{100 * max(off):.2g}" if off and max(off) >= LEAST else "0" if off else "–"
        return text if agrees(answer) else f"*{text}*"
    return f"| `{case['case']}` | {' | '.join(map(cell, methods))} |"


def page_of(text: str, cases: list[dict], path: Path) -> str:
    for name, table in (("published cases", table_of_cases), ("published by method", table_of_methods)):
        found = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end of table -->)", re.DOTALL)
        if not found.search(text):
            raise RecordsError(f"{path}: no table; expected <!-- {name} --> and <!-- end of table -->")
        text = found.sub(lambda match: match[1] + table(cases) + match[2], text)
    return text


def make(args: argparse.Namespace) -> None:
    cases = read(args.results)
    rows = rows_of(cases)
    out = args.out or args.results / "figures"
    with matplotlib.rc_context(STYLE):
        out.mkdir(exist_ok=True)
        replace_all(out, {name: partial(write_small_png, figure, DPI, colours=COLOURS) for name, figure in
                          (("published.png", draw_deviations(rows)), ("published_profiles.png", draw_profiles(rows)))})
    if args.page:
        text = page_of(text_of(args.page), cases, args.page)
        replace_all(args.page.parent, {args.page.name: text_writer(text)})
    print(out / "published.png")
    print(out / "published_profiles.png")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=Path, metavar="FOLDER")
    parser.add_argument("--out", type=Path)
    parser.add_argument("--page", type=Path)


def main() -> None:
    run(__doc__, add_arguments, make, "a folder of bench validate")


if __name__ == "__main__":
    main()
