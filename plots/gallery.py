#!/usr/bin/python3
"""Draws the stress field, the contact points and the error of solutions from `bench --fields`.

    gallery.py RESULTS_DIR [--out DIR] [--each]

gallery.png and .svg: Mesh0, Mesh1, Mesh3 and a rack, if RESULTS_DIR/fields has them; else, and
with --each, fields_NAME.png for every solution. error_map_NAME.png for every one that has an
element map of its discretisation error (NAME.error.csv); adapted_meshes.png where three levels of
an adaptive loop have one. NAME.csv next to each picture has its numbers. Exit 2: wrong input,
or a folder that cannot be written; one line says which, and its files stay as they were.
"""
import argparse
from collections.abc import Callable
from functools import partial
from pathlib import Path

import matplotlib
from matplotlib.figure import Figure

import command
import error_pictures as errors
from case_names import words_of_file
from drawing import PAGE_WIDTH, write_small_png
from field_drawing import scales_of
from field_panel import contact_points, draw_legend, draw_panel, is_tall, layout_of, width_of
from fields import Fields, names_in, read_error_share, read_fields, recorded
from words import plain

TEETH, RACKS = ("Mesh0", "Mesh1", "Mesh3"), ("Mesh4", "Mesh5", "Mesh6", "Mesh7")
STYLE = {"font.size": 8, "axes.titlesize": 9, "axes.linewidth": 0.6, "svg.hashsalt": "airybench",
         "xtick.labelsize": 7, "ytick.labelsize": 7}
DPI = 160
WIDTH, HEADER, FOOTER = PAGE_WIDTH, 0.8, 0.62  # inches
BODY = 5.0  # highest body in its own picture
HEADING = (
    r"Largest shear stress in the plane, "
    r"$\tau_{max}=\sqrt{((\sigma_{xx}-\sigma_{yy})/2)^2+\sigma_{xy}^2}$, as the elements have it: "
    "stresses linear\non each third of a triangle, nothing averaged. Below or beside each body its contact "
    "faces, enlarged\nand laid out straight: elements, contact points (two per edge) or a band of their "
    "states, contact pressure.\nScene and method: ")


def compose(rows: list[list[Fields]]) -> Figure:
    """Rows of panels as wide as the page; a single body is at most BODY high."""
    scales = scales_of([s for row in rows for s in row])
    widths = [WIDTH / len(row) for row in rows]
    if len(rows) == len(rows[0]) == 1:
        widths = [WIDTH if is_tall(rows[0][0]) else min(WIDTH, width_of(rows[0][0], BODY))]
    heights = [max(layout_of(s, width).height for s in row) for row, width in zip(rows, widths)]
    figure = Figure(figsize=(WIDTH, HEADER + sum(heights) + FOOTER))
    top = figure.get_size_inches()[1]
    heading = HEADING + plain(words_of_file(rows[0][0].name).partition(", ")[2])
    figure.text(0.5, 1 - 0.1 / top, heading, ha="center", va="top")
    top -= HEADER
    for row, width, height in zip(rows, widths, heights):
        for k, s in enumerate(row):
            draw_panel(figure, s, WIDTH / 2 + (k - len(row) / 2) * width, top, width, scales)
        top -= height
    draw_legend(figure, scales)
    return figure


def write(figure: Figure, path: Path) -> None:
    if path.suffix == ".svg":
        figure.savefig(path, dpi=120, metadata={"Date": None})
    else:
        write_small_png(figure, DPI, path)


def save(out: Path, name: str, table: str, **writers: Callable[[Path], object]) -> None:
    files = {f"{name}.{suffix}": write for suffix, write in writers.items()}
    command.replace_all(out, files | {f"{name}.csv": command.text_writer(table)})
    print(*(out / file for file in files), sep="\n")


def save_composed(out: Path, name: str, rows: list[list[Fields]], *suffixes: str) -> None:
    save(out, name, contact_points([s for row in rows for s in row]),
         **dict.fromkeys(suffixes, partial(write, compose(rows))))


def choose(names: list[str]) -> list[str] | None:
    """Mesh0, Mesh1, Mesh3 and the smallest rack, of one scene and method; None: not all there."""
    for suffix in [name.removeprefix("Mesh0") for name in names if name.startswith("Mesh0-")]:
        racks = [rack + suffix for rack in RACKS if rack + suffix in names]
        if racks and all(tooth + suffix in names for tooth in TEETH):
            return [tooth + suffix for tooth in TEETH] + racks[:1]
    return None


def add_arguments(parser: argparse.ArgumentParser) -> None:
    command.results_and_out(parser)
    parser.add_argument("--each", action="store_true", help="also a picture per solution")


def draw(args: argparse.Namespace) -> None:
    out = args.out or args.results / "figures"
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(STYLE)
    names, records = names_in(args.results), recorded(args.results)
    chosen = choose(names)
    wanted = names if args.each or not chosen else chosen
    solutions = {name: read_fields(args.results, name, records) for name in wanted}
    mapped = {name: solutions.get(name) or read_fields(args.results, name, records)
              for name in names_in(args.results, "error")}
    maps = {name: (s, read_error_share(args.results, s)) for name, s in mapped.items()}
    out.mkdir(parents=True, exist_ok=True)
    if chosen:
        *teeth, rack = (solutions[name] for name in chosen)
        save_composed(out, "gallery", [teeth, [rack]], "png", "svg")
    if args.each or not chosen:
        for name, s in solutions.items():
            save_composed(out, f"fields_{name}", [[s]], "png")
    levels = errors.levels_in(list(maps))
    if levels and all(maps[name][1].any() for name in levels):
        shown = [(*maps[name], records.get(name, {}).get("error_total")) for name in levels]
        save(out, "adapted_meshes", errors.levels_table(shown),
             png=partial(write_small_png, errors.draw_levels(shown), errors.LEVELS_DPI))
    for name, (s, share) in maps.items():
        if not share.any():
            print(f"error_map_{name}: left out: the solution has no discretisation error")
            continue
        save(out, f"error_map_{name}", errors.map_table(s, share),
             png=partial(write_small_png, errors.draw_map(s, share), errors.MAP_DPI, colours=200))


def main() -> None:
    command.run(__doc__, add_arguments, draw, "a folder to write to")


if __name__ == "__main__":
    main()
