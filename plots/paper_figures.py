#!/usr/bin/python3
"""Draws the paper's Figs 3, 4, 5 and Tab. 1 from results.csv.

    paper_figures.py RESULTS_DIR [--out DIR]

figure3  time and memory of the preconditioners on Mesh3
figure4  time of the compared methods over the meshes' sizes
figure5  memory of the same
table1   sizes, ours beside the paper's

Figures as .svg and .png, from the rows with stop=target, and again as figureN_paper_stop from
those with stop=paper; table1 as .md. Of several scenes `default` is drawn. A line on stdout says
of each what was written or why not, a last one which rows are in none. Rows of studies are for
study_figures.py. Exit 2: wrong input; one line says which, and nothing is written.
"""
from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import matplotlib
from matplotlib.figure import Figure

import preconditioner_figure
import size_figure
from figure_files import replace_all
from figure_parts import HEAP, STYLE, TIME, ErrorScale
from figure_words import merged
from method_names import compared, general, preconditioned
from paper_sizes import SIZES, table1
from results_table import STOPS, ResultsError, Row, read_results, scene_of

DPI = 200
FIGURES = {"figure3": preconditioner_figure.draw,
           "figure4": partial(size_figure.draw, quantity=TIME),
           "figure5": partial(size_figure.draw, quantity=HEAP)}


def write(figure: Figure, path: Path) -> None:
    metadata = {"Date": None} if path.suffix == ".svg" else {"Software": None}
    figure.savefig(path, dpi=DPI, metadata=metadata)


def why_undrawn(row: Row, scene: str, drawn: list[Row]) -> str:
    if row.scene != scene:
        return f"scene {row.scene}"
    for other in drawn:
        if (general(other.method), other.mesh, other.stop) == (general(row.method), row.mesh,
                                                               row.stop):
            return f"the same method as {other.method}"
    if compared(row.method):
        return "not of Mesh0..Mesh7" if row.mesh not in SIZES else "its figure is left out"
    if preconditioned(row.method):
        return "only Figs 4, 5 have more than one mesh"
    return "not of the paper's figures"


def listed(rows: list[Row], scene: str, drawn: list[Row]) -> str:
    """The rows that are in no figure, by reason."""
    reasons: dict[str, list[str]] = {}
    for row in rows:
        if row not in drawn:
            cases = reasons.setdefault(why_undrawn(row, scene, drawn), [])
            case = f"{row.method} on {row.mesh}"
            cases += [case] if case not in cases else []
    return "; ".join(f"{merged(cases)} ({reason})" for reason, cases in reasons.items())


def draw_all(rows: list[Row], out: Path) -> None:
    rows = [row for row in rows if not row.study]
    if not rows:
        print("paper_figures.py: nothing to draw: all rows are of studies")
        return
    scene = scene_of(rows)
    shown = [row for row in rows if row.scene == scene]
    scale = ErrorScale(shown)
    writers: dict[str, Callable[[Path], object]] = {}
    report, drawn = [], []

    def leave_out(name: str, reason: str, suffix: str) -> None:
        old = f"; an earlier {name}{suffix} stays" if (out / (name + suffix)).exists() else ""
        report.append(f"{name}: left out: {reason}{old}")

    for stop in STOPS:
        of_stop = [row for row in shown if row.stop == stop]
        for figure_name, draw in FIGURES.items():
            name = figure_name + ("_paper_stop" if stop == "paper" else "")
            result = draw(of_stop, scale=scale) if of_stop else f"no rows with stop={stop}"
            if isinstance(result, str):
                leave_out(name, result, ".svg")
                continue
            figure, used = result
            drawn += used
            writers |= {name + suffix: partial(write, figure) for suffix in (".svg", ".png")}
            report.append(f"{out / name}.svg, .png: {len(used)} cases")
    if any(row.mesh in SIZES for row in shown):
        words = table1(shown)
        writers["table1.md"] = lambda path: path.write_text(words, encoding="utf-8")
        report.append(f"{out / 'table1.md'}")
    else:
        leave_out("table1", "no rows of Mesh0..Mesh7", ".md")
    if writers:
        replace_all(out, writers)
    undrawn = listed(rows, scene, drawn)
    print(*report, *([f"in no figure: {undrawn}"] if undrawn else []), sep="\n")


def fail(message: object) -> None:
    print(f"paper_figures.py: {message}", file=sys.stderr)
    sys.exit(2)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path, metavar="RESULTS_DIR", help="the --out of bench")
    parser.add_argument("--out", type=Path, metavar="DIR", help="default: RESULTS_DIR/figures")
    parser.error = fail
    args = parser.parse_args()
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(STYLE)
    try:
        draw_all(read_results(args.results / "results.csv"), args.out or args.results / "figures")
    except ResultsError as error:
        fail(error)
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}; expected a folder to write to")


if __name__ == "__main__":
    main()
