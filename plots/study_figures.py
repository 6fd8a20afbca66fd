#!/usr/bin/python3
"""Draws the error study, the stability study and all methods of a run from results.csv.

    study_figures.py RESULTS_DIR [--out DIR]

work_precision_MESH  error against time and memory, a curve per method, for each mesh
stop_and_error       the paper's stop of ALM for given parameters
pareto               total error against time and memory, over all meshes
convergence          discretisation error against the mesh size, with rates; bounds of the energy
stability_MESH       outcome of each method in each scene
all_methods          time, memory and error over n_phi, a line per method of two sizes or more
memory_by_owner      peak heap of each method by whose it is, on the largest mesh; from records.jsonl

All as .png. All but the stability study are of one scene, `default` if it is there. A line
on stdout says of each what was written, or why not where the folder has rows for it. Exit 2: wrong
input; one line says which, and nothing is written.
"""
from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import matplotlib
from matplotlib.figure import Figure

import atlas_figure
import convergence_figure
import all_methods_figure
import memory_figure
import pareto_figure
import stop_figure
import work_precision_figure
from figure_files import replace_all, write_small_png
from figure_parts import STYLE
from memory_records import Split, read_splits
from results_table import ResultsError, Row, read_results, scene_of

DPI, COLOURS = 120, 128

# Name, how, of what.
Drawing = tuple[str, Callable[[list], "Figure | str"], list[Row] | list[Split]]


def by_mesh(rows: list[Row]) -> dict[str, list[Row]]:
    meshes: dict[str, list[Row]] = {}
    for row in sorted(rows, key=lambda row: row.n_phi):
        meshes.setdefault(row.mesh, []).append(row)
    return meshes


def file_name(stem: str, mesh: str) -> str:
    """The mesh may be a path."""
    return f"{stem}_{re.sub('[^A-Za-z0-9._-]', '-', mesh)}"


def drawings_of(rows: list[Row], splits: list[Split]) -> list[Drawing]:
    studies = {study: [row for row in rows if row.study == study]
               for study in ("", "error", "stability")}
    drawings: list[Drawing] = []
    if studies["error"]:
        scene = scene_of(studies["error"])
        error = [row for row in studies["error"] if row.scene == scene]
        drawings += [(file_name("work_precision", mesh), work_precision_figure.draw, own)
                     for mesh, own in by_mesh(error).items()]
        drawings += [("stop_and_error", stop_figure.draw, error),
                     ("pareto", pareto_figure.draw, error),
                     ("convergence", convergence_figure.draw, studies["error"])]
    drawings += [(file_name("stability", mesh), atlas_figure.draw, own)
                 for mesh, own in by_mesh(studies["stability"]).items()]
    sizes = [row for row in studies[""] if row.stop == "target"] or studies[""]
    if sizes:
        scene = scene_of(sizes)
        drawings.append(("all_methods", all_methods_figure.draw,
                         [row for row in sizes if row.scene == scene]))
    if splits:
        scene = scene_of(splits)
        drawings.append(("memory_by_owner", memory_figure.draw,
                         [split for split in splits if split.scene == scene]))
    return drawings


def draw_all(rows: list[Row], splits: list[Split], out: Path) -> None:
    report, writers = [], {}
    for name, draw, own in drawings_of(rows, splits):
        result = draw(own)
        if isinstance(result, str):
            old = f"; an earlier {name}.png stays" if (out / f"{name}.png").exists() else ""
            report.append(f"{name}: left out: {result}{old}")
            continue
        writers[f"{name}.png"] = partial(write_small_png, result, DPI, colours=COLOURS)
        report.append(f"{out / name}.png: {len(own)} records")
    if writers:
        replace_all(out, writers)
    print(*report, sep="\n")


def fail(message: object) -> None:
    print(f"study_figures.py: {message}", file=sys.stderr)
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
        draw_all(read_results(args.results / "results.csv"),
                 read_splits(args.results / "records.jsonl"), args.out or args.results / "figures")
    except ResultsError as error:
        fail(error)
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}; expected a folder to write to")


if __name__ == "__main__":
    main()
