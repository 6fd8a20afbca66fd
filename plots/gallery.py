#!/usr/bin/python3
"""Draws the stress field, the contact points and the error of solutions from `bench --fields`.

    gallery.py RESULTS_DIR [--out DIR] [--each] [--only GLOB,...] [--animate] [--vector]

gallery.png and .svg: Mesh0, Mesh1, Mesh3 and a rack, if RESULTS_DIR/fields has them; else, and
with --each, fields_NAME.png for every solution. error_map_NAME.png for every one that has an
element map of its discretisation error (NAME.error.csv); adapted_meshes.png where three levels of
an adaptive loop have one, adapted_degrees.png where the last levels of two degrees have one;
load_path_NAME.png for every path of load steps (NAME.steps.csv), with
--animate also load_path_NAME.gif, a frame per step with the body in files, at most 60 frames and
1 MB. --only: these pictures, by name or glob; none is removed then. --vector: each but the GIF also
as .svg and .pdf, fonts included. NAME.csv next to each picture has its numbers. Exit 2: wrong input,
or a folder that cannot be written; one line says which, and its files stay as they were.
"""
import argparse
import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Colormap, LogNorm
from matplotlib.figure import Figure

import command
import drawing
from case_names import case_of_file
from drawing import PAGE_WIDTH, axes_at, bar_below, caption_of, for_papers, write_small_png
from field_drawing import (COLORMAP, areas, draw_body, draw_boundary, enlargement,
                           largest_load, scales_of)
from field_panel import (body_height, contact_points, draw_legend, draw_panel, is_cut, is_tall,
                         label_body, layout_of, slenderness, view_of, width_of)
from fields import Fields, names_in, read_error_share, read_fields, record_of, recorded
from load_path import LoadPath, read_path, table_of
from load_path_drawing import FIXED, caption as caption_of_path, draw_path, frames, frames_of, write_gif
from words import csv_of, percent

TEETH, RACKS = ("Mesh0", "Mesh1", "Mesh3"), ("Mesh4", "Mesh5", "Mesh6", "Mesh7")
STYLE = drawing.STYLE | {"axes.titlesize": 9, "xtick.labelsize": 7, "ytick.labelsize": 7}
DPI = 120
WIDTH, FOOTER, LINE = PAGE_WIDTH, 0.62, 0.15  # inches
BODY = 5.0  # highest body in its own picture
STRESS = ("Colour: the largest shear stress in the plane, τ_max = √(((σ_xx − σ_yy)/2)² + σ_xy²), of the stresses as they "
          "were solved, not averaged; the brightest stands for this or more where a peak is singular.")
FACES = ("{}: contact faces, enlarged and straightened, with elements, states of the points ({} per "
         "edge), pressure, friction.")
POINTS = {2: "two", 3: "three", 4: "four", 5: "five"}
CUT = "Mostly open faces: contact zone only."
OUTLINE = "Dashed: the outline with enlarged displacements"
WALLS = (". A wall keeps its shape: it meets the outline where the body touches it, on average; elsewhere "
         "the enlarged outline may cross it.")
BODIES = ", in which bodies that touch may cross each other."
# Pictures of the error: inches, of a map and of levels of a loop.
LEVELS_DPI = 110
SHADES = 24  # few, for a small file
SMALL_PNG = dict(colours=200, kept=[*FIXED, *colormaps["cividis"].resampled(SHADES).colors])
DECADES = 5  # of the scale of a map at most
TENTH = 0.1
HIGHEST, LEFT, RIGHT, TOP, BOTTOM, NARROWEST = 5.0, 0.55, 0.15, 0.12, 0.92, 5.5  # of a map, inches
LEVEL = re.compile(r"(?P<mesh>.+)~adapt(?P<level>\d+)(?P<case>--.*)")  # of a case's files
OF_DEGREE = re.compile(r"(?P<mesh>.+)~adapt(?P<level>\d+)(k\d)?(?P<case>--.+--HYBRID)(\+k=(?P<degree>\d))?")
SHOWN, LEVEL_LEFT, GAP, LEVEL_HIGHEST = 3, 0.5, 0.12, 4.2  # of levels, inches
TITLE, WORDS, BARS = 0.3, 0.34, 0.75

Level = tuple[Fields, np.ndarray, float | None]  # fields, shares (T,) of e², total error


def compose(rows: list[list[Fields]]) -> Figure:
    """Rows of panels as wide as the page; a single body is at most BODY high."""
    shown = [s for row in rows for s in row]
    scales = scales_of(shown)
    widths = [WIDTH / len(row) for row in rows]
    if len(rows) == len(rows[0]) == 1:
        widths = [WIDTH if is_tall(rows[0][0]) else min(WIDTH, width_of(rows[0][0], BODY))]
    heights = [max(layout_of(s, width).height for s in row) for row, width in zip(rows, widths)]
    figure = Figure(figsize=(WIDTH, sum(heights) + FOOTER))
    top = figure.get_size_inches()[1]
    for row, width, height in zip(rows, widths, heights):
        for k, s in enumerate(row):
            draw_panel(figure, s, WIDTH / 2 + (k - len(row) / 2) * width, top, width,
                       replace(scales, times=enlargement([s]), load_MPa=largest_load(s)))
        top -= height
    draw_legend(figure, scales, shown)
    return figure


def words_of_file(name: str) -> str:
    return case_of_file(name).replace("/", ", ")


def caption(solutions: list[Fields]) -> str:
    scales, lines = scales_of(solutions), [STRESS]
    touching = [s for s in solutions if len(s.edges)]
    if touching:
        places = sorted({"next to" if is_tall(s) else "below" for s in touching})
        body = "each body" if len(solutions) > 1 else "the body"
        points = " or ".join(POINTS[m] for m in sorted({s.per_edge for s in touching}))
        lines.append(FACES.format(f"{' or '.join(places).capitalize()} {body}", points))
        if any(map(is_cut, touching)):
            lines.append(CUT)
    if touching and scales.times is not None:
        has_walls = any(s.at_wall(face) for s in touching for face in s.faces())
        lines.append(OUTLINE + (WALLS if has_walls else BODIES))
    lines += dict.fromkeys(s.of_step for s in solutions if s.of_step)
    return caption_of(", ".join(words_of_file(s.name) for s in solutions), *lines)


def share_of_worst(share: np.ndarray) -> float:
    worst = np.sort(share)[::-1][:max(1, round(TENTH * len(share)))]
    return float(worst.sum() / share.sum())


def most_of(part: float) -> str:
    """0.81 -> 81 %; of less than all never 100 %."""
    return "more than 99 %" if 0.995 <= part < 1 else f"{100 * part:.0f} %"


def draw_shares(axes: Axes, s: Fields, values: np.ndarray, norm: LogNorm, shades: Colormap,
                **edges: object) -> None:
    axes.add_collection(PolyCollection(s.placed(s.outlines), array=np.maximum(values, norm.vmin),
                                       norm=norm, cmap=shades, rasterized=True, **edges))
    draw_boundary(axes, s)


def draw_map(s: Fields, share: np.ndarray) -> Figure:
    """share (T,): of the squared error, 1; its triangles in the order of s."""
    width = min(PAGE_WIDTH, width_of(s, HIGHEST))
    height = body_height(s, width)
    width = max(width, NARROWEST)
    figure = Figure(figsize=(width, TOP + height + BOTTOM))
    view = view_of(s)
    across = height / slenderness(s)
    axes = axes_at(figure, (width + LEFT - RIGHT) / 2 - across / 2, TOP, across, height,
                   xlim=view.intervalx, ylim=view.intervaly)
    high = 10.0 ** math.ceil(math.log10(share.max()))
    low = max(share[share > 0].min(), high / 10**DECADES)
    norm = LogNorm(10.0 ** math.floor(math.log10(low)), high, clip=True)
    shades = colormaps[COLORMAP].resampled(SHADES)
    draw_shares(axes, s, share, norm, shades, edgecolor="white",
                linewidths=np.clip(10 / math.sqrt(len(share)), 0.06, 0.4))
    label_body(axes)
    bar_below(figure, ScalarMappable(norm, shades), 0.15, 0.7, "a triangle's share of the squared error" +
             "; darkest: this or less" * bool(share.min() < norm.vmin))
    return figure


def caption_of_map(s: Fields, share: np.ndarray) -> str:
    return caption_of(f"{words_of_file(s.name)}: discretisation error by triangle", f"{len(share)} triangles; the worst "
                      f"tenth of them has {most_of(share_of_worst(share))} of the squared error.")


def map_table(s: Fields, share: np.ndarray) -> str:
    lines = zip(range(1, len(share) + 1), *s.triangles.mean(axis=1).T, areas(s), share)
    names = ("triangle", "x_mm", "y_mm", "area_mm2", "error_share")
    return csv_of(lines, *((name, lambda line, k=k: float(line[k]) if k else line[k])
                           for k, name in enumerate(names)))


def levels_in(names: list[str]) -> list[str]:
    """The first, a middle and the last level of the first loop with three or more."""
    loops: dict[tuple[str, str], list[tuple[int, str]]] = {}
    for name in names:
        if found := LEVEL.fullmatch(name):
            loops.setdefault((found["mesh"], found["case"]), []).append((int(found["level"]), name))
    for levels in loops.values():
        if len(levels) >= SHOWN:
            ordered = [name for _, name in sorted(levels)]
            return [ordered[0], ordered[len(ordered) // 2], ordered[-1]]
    return []


def degrees_in(names: list[str]) -> dict[int, str]:
    """Degree of the stresses -> last level of its loop, of the first body with two degrees or more."""
    bodies: dict[tuple[str, str], dict[int, tuple[int, str]]] = {}
    for name in names:
        if found := OF_DEGREE.fullmatch(name):
            last = bodies.setdefault((found["mesh"], found["case"]), {})
            degree = int(found["degree"] or 1)
            last[degree] = max(last.get(degree, (0, "")), (int(found["level"]), name))
    several = next((last for last in bodies.values() if len(last) > 1), {})
    return {degree: name for degree, (_, name) in sorted(several.items())}


def draw_levels(levels: list[Level], titles: tuple[str, ...] = ()) -> Figure:
    """titles: first line above each."""
    scales = scales_of([levels[-1][0]])  # of the finest
    view = view_of(levels[0][0])
    panel = (PAGE_WIDTH - LEVEL_LEFT - len(levels) * GAP) / len(levels)
    height = panel * slenderness(levels[0][0])
    above = TITLE + LINE * bool(titles)
    if height > LEVEL_HIGHEST:
        panel, height = panel * LEVEL_HIGHEST / height, LEVEL_HIGHEST
    figure = Figure(figsize=(PAGE_WIDTH, above + 2 * (height + WORDS) + BARS))
    step = (PAGE_WIDTH - LEVEL_LEFT) / len(levels)
    norm = LogNorm(1e-2, 1e2, clip=True)
    shades = colormaps["cividis"].resampled(SHADES)
    for k, (s, share, error) in enumerate(levels):
        upper, lower = (
            axes_at(figure, LEVEL_LEFT + k * step + (step - GAP - panel) / 2,
                    above + row * (height + WORDS), panel, height, xlim=view.intervalx,
                    ylim=view.intervaly) for row in (0, 1))
        draw_body(upper, s, scales)
        words = f"{len(s.points)} triangles"
        words += f", total error {percent(error)}" if error is not None else ""
        upper.set_title("\n".join([*titles[k:k + 1], words]), pad=4)
        draw_shares(lower, s, share * len(share), norm, shades, edgecolor="none")
        label_body(upper, x="", y="y, mm" if k == 0 else "")
        label_body(lower, y="y, mm" if k == 0 else "")
        upper.tick_params(labelleft=k == 0, labelbottom=False)
        lower.tick_params(labelleft=k == 0)
    bar_below(figure, ScalarMappable(scales.shear, COLORMAP), 0.08, 0.38,
             "largest shear stress in the plane, MPa; brightest: this or more")
    bar_below(figure, ScalarMappable(norm, shades), 0.56, 0.38,
             "squared error of a triangle over the mean; ends: or beyond")
    return figure


def caption_of_levels(levels: list[Level], titles: tuple[str, ...]) -> str:
    return caption_of(f"{levels[0][0].mesh.split('+')[0]}, adapted" + ", by the degree of the stresses" * bool(titles),
                      "Above: the largest shear stress in the plane; below: the squared error of a triangle over the mean.")


def levels_table(levels: list[Level]) -> str:
    return csv_of(levels, ("mesh", lambda level: level[0].mesh),
                  ("n_phi", lambda level: level[0].n_phi),
                  ("triangles", lambda level: len(level[1])),
                  ("error_total", lambda level: level[2]),
                  ("error_share_of_worst_tenth", lambda level: share_of_worst(level[1])))


def write(figure: Figure, path: Path) -> None:
    if path.suffix == ".svg":
        figure.savefig(path, dpi=120, metadata={"Date": None})
    else:
        write_small_png(figure, DPI, path, **SMALL_PNG)


def save(made: command.Made, name: str, words: str, table: str, vector: Figure | None,
         **writers: Callable[[Path], object]) -> None:
    files = {f"{name}{suffix}": write for suffix, write in for_papers(vector).items()} if vector else {}
    files |= {f"{name}.{suffix}": write for suffix, write in writers.items()}
    made.replace(files | {f"{name}.csv": command.text_writer(table), f"{name}.txt": command.text_writer(words)})
    print(*(made.folder / file for file in files), sep="\n")


def save_composed(made: command.Made, name: str, rows: list[list[Fields]], vector: bool,
                  *suffixes: str) -> None:
    figure = compose(rows)
    shown = [s for row in rows for s in row]
    save(made, name, caption(shown), contact_points(shown), figure if vector else None,
         **dict.fromkeys(suffixes, partial(write, figure)))


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
    parser.add_argument("--only", metavar="GLOB,...", help="these pictures")
    parser.add_argument("--animate", action="store_true", help="also a .gif per path of load steps")


def draw(args: argparse.Namespace) -> None:
    out = args.out or args.results / "figures"
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(STYLE)
    names, records = names_in(args.results), recorded(args.results)
    if others := [name for name in names if records and case_of_file(name) not in records]:
        print(f"left out, fields of no recorded case: {', '.join(others)}")
        names = [name for name in names if name not in others]
    chosen = choose(names)
    singles = names if args.each or not chosen else []
    with_map = [name for name in names_in(args.results, "error") if name in names]
    with_path = [name for name in names_in(args.results, "steps") if name in names]
    degrees = degrees_in(with_map)
    levels = {"adapted_meshes": (levels_in(with_map), ()),
              "adapted_degrees": (list(degrees.values()), tuple(f"degree {k}" for k in degrees))}
    pictures = command.selected(args.only, "picture of these fields", [
        *["gallery"] * bool(chosen), *(f"fields_{name}" for name in singles),
        *(picture for picture, (own, _) in levels.items() if own),
        *(f"error_map_{name}" for name in with_map), *(f"load_path_{name}" for name in with_path)])
    singles, with_map, with_path = (
        [name for name in own if f"{kind}_{name}" in pictures]
        for kind, own in (("fields", singles), ("error_map", with_map), ("load_path", with_path)))
    levels = {picture: shown for picture, shown in levels.items() if picture in pictures}
    mapped = dict.fromkeys([*with_map, *(name for own, _ in levels.values() for name in own)])
    drawn = dict.fromkeys([*(chosen if "gallery" in pictures else ()), *singles, *mapped])
    paths = {name: read_path(args.results, name) for name in names_in(args.results, "steps")
             if name in drawn or name in with_path}
    solutions = {name: read_telling(args.results, name, records, paths.get(name)) for name in drawn}
    maps = {name: (solutions[name], read_error_share(args.results, solutions[name])) for name in mapped}
    out.mkdir(parents=True, exist_ok=True)
    made = command.Made(out, "gallery")
    if "gallery" in pictures:
        *teeth, rack = (solutions[name] for name in chosen)
        save_composed(made, "gallery", [teeth, [rack]], args.vector, "png", "svg")
    for name in singles:
        save_composed(made, f"fields_{name}", [[solutions[name]]], args.vector, "png")
    for picture, (names_of_levels, titles) in levels.items():
        if all(maps[name][1].any() for name in names_of_levels):
            shown = [(*maps[name], record_of(records, name).get("error_total")) for name in names_of_levels]
            figure = draw_levels(shown, titles)
            save(made, picture, caption_of_levels(shown, titles), levels_table(shown), figure if args.vector else None,
                 png=partial(write_small_png, figure, LEVELS_DPI, **SMALL_PNG))
    for name in with_map:
        s, share = maps[name]
        if not share.any():
            print(f"error_map_{name}: left out: the solution has no discretisation error")
            continue
        figure = draw_map(s, share)
        save(made, f"error_map_{name}", caption_of_map(s, share), map_table(s, share), figure if args.vector else None,
             png=partial(write_small_png, figure, DPI, **SMALL_PNG))
    draw_paths(args, made, {name: paths[name] for name in with_path}, records)
    if args.only is None and (gone := made.remove_others()):
        print(f"removed, of other fields: {', '.join(gone)}")


def is_newer(file: Path, than: Path) -> bool:
    return file.is_file() and file.stat().st_mtime >= than.stat().st_mtime


def read_step(results: Path, name: str, step: int, records: dict[str, dict]) -> Fields:
    """step: from 0."""
    record = record_of(records, name)
    return replace(read_fields(results, f"{name}.steps/{step + 1:04}", {}), name=name,
                   mesh=record["mesh"], n_phi=record["n_phi"])


def read_telling(results: Path, name: str, records: dict[str, dict],
                 path: LoadPath | str | None) -> Fields:
    """The solution, or of a path that ends unloaded its most loaded step."""
    if not isinstance(path, LoadPath) or path.telling_step == len(path.step) - 1:
        return read_fields(results, name, records)
    step, last = path.step[path.telling_step], path.step[-1]
    words = f"Load step {step} of {last}, the most loaded one: the last one is unloaded."
    return replace(read_step(results, name, path.telling_step, records), of_step=words)


def draw_paths(args: argparse.Namespace, made: command.Made, paths: dict[str, LoadPath | str],
               records: dict[str, dict]) -> None:
    for name, path in paths.items():
        if isinstance(path, str):
            print(f"load_path_{name}: left out: {path}")
            continue
        figure = draw_path(path)
        writers = {"png": partial(write_small_png, figure, DPI, **SMALL_PNG)}
        moving = made.folder / f"load_path_{name}.gif"
        if not args.animate and moving.name in made.earlier() and is_newer(
                moving, args.results / "fields" / f"{name}.steps.csv"):
            made.now.add(moving.name)  # of these fields: it stays
        if args.animate and path.has_body.any():
            of_steps = {k: read_step(args.results, name, k, records) for k in frames_of(path)}
            writers["gif"] = partial(write_gif, frames(path, of_steps))
        save(made, f"load_path_{name}", caption_of_path(path), table_of(path), figure if args.vector else None, **writers)


def main() -> None:
    command.run(__doc__, add_arguments, draw, "a folder to write to")


if __name__ == "__main__":
    main()
