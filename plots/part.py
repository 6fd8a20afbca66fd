#!/usr/bin/python3
"""Draws the answer of `bench solve`, and makes a page of it.

    part.py RESULTS_DIR [--html] [--vector]

figures/part.png: the von Mises stress, the outline displaced, supports, loads, the pressure on contact faces.
--html: also part.html, which has the picture and all that `bench solve` prints, and fetches nothing.
--vector: the picture also as .svg and .pdf. Exit 2: wrong input, or a folder that cannot be written;
one line says which.
"""
import argparse
import base64
import html
import textwrap
from dataclasses import dataclass
from functools import partial
from io import BytesIO
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, TriMesh
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation

import command
from drawing import (LINE, MARGIN, PAGE_WIDTH, SMALLEST_PT, STYLE, TYPE, axes_at, bar_below, for_papers, text_at,
                     write_small_png)
from field_drawing import (ARROW_PT, COLORMAP, LINES, MOVED, OUTLINE, ROLE, ROLLER, SPACING_PT, TICKED, WEAKEST,
                           highest_but, load_arrow, round_below)
from fields import chains
from page import hash_of, part as page_part
from records import RecordsError, json_of, text_of
from words import plain

DPI, LETTERS = 130, 130  # letters in a line as wide as a page
LEFT, RIGHT, BELOW, HIGHEST = 0.55, 0.35, 0.95, 5.6  # around the axes; their height at most
NEAR = 2.4  # width and height of the enlarged contact
PRESSURE = ROLE["contact"]["color"]
NARROW, AROUND = 0.08, 1.5  # contact that is drawn enlarged, too: of the body's size; around it, of its length
TALLEST, WORDS = 0.12, 0.04  # the largest pressure, what it is: of the body's size
COMB_PT = 6     # between the lines that fill a pressure
TRIANGLE = np.array([(0, 0), (-0.9, -1.5), (0.9, -1.5), (0, 0)])  # below a point that is held
IN_POINT = dict(linestyle="none", markersize=13, markerfacecolor="white", markeredgecolor="black",
                markeredgewidth=0.8, zorder=7)
UNBOUNDED = dict(linestyle="none", marker="x", markersize=5, markeredgecolor="#D55E00", markeredgewidth=1.4,
                 zorder=7, clip_on=True)
NOTE = dict(fontsize=TYPE, path_effects=[withStroke(linewidth=2.5, foreground="white")], zorder=8)


@dataclass(frozen=True)
class Part:
    shown: dict            # part.json
    answer: dict           # NAME.answer.json
    thirds: np.ndarray     # (N, points, 3): x, y, von Mises stress; lattices from the side to the centroid
    outline: pd.DataFrame  # NAME.outline.csv, the same number of points for each edge
    faces: pd.DataFrame    # NAME.faces.csv

    @property
    def edges(self) -> np.ndarray:
        """(edges, points, columns): x, y; displacement (NaN: unknown); traction."""
        columns = ["x_mm", "y_mm", "ux_mm", "uy_mm", "tx_MPa", "ty_MPa"]
        return self.outline[columns].to_numpy(float).reshape(self.outline.edge.iat[-1], -1, 6)

    @property
    def roles(self) -> np.ndarray:
        return self.outline.role.to_numpy().reshape(self.outline.edge.iat[-1], -1)[:, 0]

    @property
    def pieces(self) -> np.ndarray:
        return self.outline.piece.to_numpy().reshape(self.outline.edge.iat[-1], -1)[:, 0]

    @property
    def size(self) -> float:
        return float(np.ptp(self.outline[["x_mm", "y_mm"]].to_numpy(), axis=0).max())


def read_part(results: Path) -> Part:
    file = results / "part.json"
    shown = json_of(text_of(file), str(file))

    def path(part: str) -> Path:
        return results / "fields" / f"{shown['case']}.{part}"

    def table(part: str, per: str) -> pd.DataFrame:
        try:
            read = pd.read_csv(path(part))
            assert len(read) and len(read) % read[per].iat[-1] == 0
        except (ValueError, KeyError, AssertionError) as error:
            raise RecordsError(f"{path(part)}: not as bench solve writes it {error}".rstrip()) from None
        return read

    answer = json_of(text_of(path("answer.json")), str(path("answer.json")))
    if not isinstance(answer.get("unbounded"), list):
        raise RecordsError(f"{path('answer.json')}: of an earlier bench; expected the present one's: solve it again")
    stress = table("von_mises.csv", "third")
    faces = pd.read_csv(path("faces.csv"))
    return Part(shown, answer, stress.to_numpy()[:, 1:].reshape(stress.third.iat[-1], -1, 3),
                table("outline.csv", "edge"), faces)


def cells_of(points: int) -> np.ndarray:
    """(cells, 3) numbers of a lattice's points, rows from the side to the centroid."""
    parts = round(np.sqrt(2 * points + 0.25) - 1.5)
    cells, start = [], 0
    for row in range(parts, 0, -1):
        above = start + row + 1
        cells += [(start + j, start + j + 1, above + j) for j in range(row)]
        cells += [(start + j + 1, above + j + 1, above + j) for j in range(row - 1)]
        start = above
    return np.array(cells)


def scale_of(part: Part) -> Normalize:
    """To the largest stress away from places where it is unbounded."""
    return Normalize(0, part.answer["von_mises_MPa"]["value"] or 1)


def draw_stress(axes: Axes, part: Part, scale: Normalize, view: np.ndarray) -> None:
    corners = part.thirds[..., :2]
    thirds = part.thirds[((corners.max(1) > view[0]) & (corners.min(1) < view[1])).all(1)]
    count, points = thirds.shape[:2]
    cells = (np.arange(count)[:, None, None] * points + cells_of(points)).reshape(-1, 3)
    x, y, stress = thirds.reshape(-1, 3).T
    mesh = TriMesh(Triangulation(x, y, cells), cmap=COLORMAP, norm=scale, rasterized=True)
    mesh.set_array(stress)
    axes.add_collection(mesh, autolim=False)  # its limits would take longer than the rest of the picture


def lines_of(part: Part, chosen: np.ndarray, points: np.ndarray) -> list[np.ndarray]:
    """(edges, points, 2) -> the chosen edges (edges,), each chain of a body's as one line."""
    found = []
    for piece in np.unique(part.pieces):
        own = np.flatnonzero(chosen & (part.pieces == piece))
        found += [points[own[chain]].reshape(-1, points.shape[2]) for chain in chains(part.edges[own][:, [0, -1], :2])]
    return found


def draw_outline(axes: Axes, part: Part) -> None:
    for role, style in LINES.items():
        edges = part.edges[part.roles == role]
        for line in lines_of(part, part.roles == role, part.edges[..., :2]):
            drawn, = axes.plot(*line.T, **style, zorder=4, solid_capstyle="butt")
            if role == "displacement":
                drawn.set_path_effects([TICKED])
        if role == "rollers" and len(edges):
            axes.plot(*edges[:, edges.shape[1] // 2, :2].T, **ROLLER, zorder=4)


def draw_point_supports(axes: Axes, part: Part, view: np.ndarray) -> None:
    """A triangle per component that is held, its tip in the point, on the side away from the middle."""
    for support in part.answer["point_supports"]:
        inward = np.where(np.array(support["at_mm"]) > view.mean(0), -1, 1)
        for component, shape in enumerate((TRIANGLE[:, ::-1], TRIANGLE)):
            if support["displacement_mm"][component] is not None:
                axes.plot(*support["at_mm"], **IN_POINT, marker=inward[component] * shape, clip_on=False)


def enlargement(part: Part) -> float | None:
    if "free_motion" in part.answer:  # nothing determines where it is
        return None
    largest = np.hypot(*part.edges[..., 2:4].reshape(-1, 2).T).max()
    return round_below(MOVED * part.size / largest) if largest > 0 else None


def draw_displaced(axes: Axes, part: Part, times: float | None) -> None:
    if times is not None:
        moved = part.edges[..., :2] + times * part.edges[..., 2:4]
        for line in lines_of(part, part.roles != "", moved):
            axes.plot(*line.T, **OUTLINE, zorder=5)


def outward(line: np.ndarray) -> np.ndarray:
    """Normals of a line with the body on its left; edges may meet in equal points."""
    keep = np.append(True, np.hypot(*np.diff(line, axis=0).T) > 0)
    tangent = np.gradient(line[keep], axis=0)[np.cumsum(keep) - 1]
    return np.column_stack([tangent[:, 1], -tangent[:, 0]]) / np.hypot(*tangent.T)[:, None]


def pressures(part: Part, face: dict) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Lines of a face, its pressure there (MPa) and outward normals; of a pair those of the side that is not
    hollow, so that lines along the normals do not cross."""
    def of_side(label: str) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        own = part.faces[part.faces.face == label]
        starts = np.append(np.flatnonzero(np.diff(own.along_mm, prepend=np.inf) < 0), len(own))
        xy, pressure = own[["x_mm", "y_mm"]].to_numpy(), own.pressure_MPa.to_numpy()
        return [(xy[a:b], pressure[a:b], outward(xy[a:b])) for a, b in zip(starts, starts[1:])]

    def spread(side: list[tuple[np.ndarray, np.ndarray, np.ndarray]]) -> float:
        return sum((np.diff(base, axis=0) * np.diff(normal, axis=0)).sum() for base, _, normal in side)
    return max(map(of_side, face["labels"]), key=spread)


def draw_pressures(axes: Axes, part: Part, limit: float, size: float) -> None:
    """On every face, up to `limit`, MPa, which is TALLEST of `size`; with the largest value."""
    height = TALLEST * size / limit
    for face in part.answer["faces"]:
        highest = face["pressure_MPa"]["value"]
        if not highest > 0:
            continue
        lines = pressures(part, face)
        for base, pressure, normal in lines:
            tips = base + height * np.clip(pressure, 0, limit)[:, None] * normal
            pressed = np.convolve(pressure > 1e-3 * limit, (1, 1, 1), "same") > 0  # with its ends
            axes.fill(*np.vstack([base, tips[::-1]]).T, facecolor=PRESSURE, alpha=0.18, linewidth=0, zorder=5)
            axes.plot(*np.where(pressed[:, None], tips, np.nan).T, color=PRESSURE, linewidth=1, zorder=6)
            axes.add_collection(LineCollection(comb(axes, base[pressed], tips[pressed]), color=PRESSURE,
                                               linewidth=0.5, zorder=6))
        base, pressure, normal = map(np.concatenate, zip(*lines))
        at = np.hypot(*(base - face["pressure_MPa"]["at_mm"]).T).argmin()
        is_unbounded = part.shown["largest_pressure_is"] == "unbounded" and highest >= limit
        x, y = normal[at]
        axes.annotate("unbounded" if is_unbounded else f"{highest:.4g} MPa",
                      base[at] + height * min(highest, limit) * normal[at], xytext=(8 * x, 8 * y),
                      textcoords="offset points", color=PRESSURE, annotation_clip=True,
                      ha="center" if abs(x) < 0.7 else "left" if x > 0 else "right",
                      va="center" if abs(y) < 0.7 else "bottom" if y > 0 else "top", **NOTE)


def comb(axes: Axes, base: np.ndarray, tips: np.ndarray) -> np.ndarray:
    """Lines from a face to its pressure, COMB_PT apart on the sheet: (lines, 2, 2)."""
    if len(base) < 2:
        return np.empty((0, 2, 2))
    at = axes.transData.transform(base) * 72 / axes.figure.dpi
    along = np.append(0, np.cumsum(np.hypot(*np.diff(at, axis=0).T)))
    places = np.linspace(0, along[-1], max(2, round(along[-1] / COMB_PT) + 1))
    return np.stack([np.column_stack([np.interp(places, along, ends[:, k]) for k in (0, 1)])
                     for ends in (base, tips)], 1)


def draw_loads(axes: Axes, part: Part, largest: float) -> None:
    """Arrows of the given tractions; largest: of them, MPa."""
    traction = np.hypot(*np.moveaxis(part.edges[..., 4:6], -1, 0))
    for line in lines_of(part, traction.max(1) > WEAKEST * largest, part.edges) if largest > 0 else []:
        at = axes.transData.transform(line[:, :2]) * 72 / axes.figure.dpi
        along = np.append(0, np.cumsum(np.hypot(*np.diff(at, axis=0).T)))
        count = max(1, int(along[-1] / SPACING_PT))
        normals = outward(line[:, :2])
        for place in (np.arange(count) + 0.5) * along[-1] / count:
            t = np.array([np.interp(place, along, line[:, k]) for k in (4, 5)])
            if np.hypot(*t) < WEAKEST * largest:
                continue
            point = np.array([np.interp(place, along, at[:, k]) for k in (0, 1)])
            load_arrow(axes, point, ARROW_PT * t / largest, normals[np.abs(along - place).argmin()])


def mark_largest(axes: Axes, part: Part, view: np.ndarray) -> None:
    for place in part.answer["unbounded"]:
        axes.plot(*place["at_mm"], **UNBOUNDED)
    stress = part.answer["von_mises_MPa"]
    at = np.array(stress["at_mm"])
    if not stress["value"] > 0 or (at < view[0]).any() or (at > view[1]).any():
        return
    for colour, width in (("white", 2.6), ("black", 1.2)):
        axes.plot(*at, marker="o", markersize=7, markerfacecolor="none", markeredgecolor=colour,
                  markeredgewidth=width, zorder=7)
    across, up = (at - view[0]) / (view[1] - view[0])
    for face in part.answer["faces"]:  # away from the words of a pressure
        if np.hypot(*(away := at - face["pressure_MPa"]["at_mm"])) < TALLEST * np.ptp(view[:, 0]):
            up = 0 if away[1] >= 0 and at[1] != view[0, 1] else 1
    off = f" ± {stress['off']:.2g}" if "off" in stress else ""
    side = 0 if abs(across - 0.5) < 0.1 else 1 if across < 0.5 else -1  # of the words
    axes.annotate(f"largest {stress['value']:.4g}{off} MPa", at, xytext=(9 * side, 12 if up < 0.5 else -12),
                  textcoords="offset points", weight="bold", ha=("center", "left", "right")[side],
                  va="bottom" if up < 0.5 else "top", **NOTE)


def title_of(part: Part) -> str:
    error = part.shown["error_total"]
    return f"{part.shown['name']}: " + ("total error not known" if error is None else
                                        f"total error {100 * error:.2g} % in energy")


def highest_pressure(part: Part) -> float:
    """MPa; where it is not bounded, of most of the contact."""
    highest = max((face["pressure_MPa"]["value"] for face in part.answer["faces"]), default=0)
    pressed = part.faces.pressure_MPa[part.faces.pressure_MPa > 0].to_numpy()
    if part.shown["largest_pressure_is"] == "unbounded" and pressed.size:
        return highest_but(pressed, np.ones(pressed.size), 0.95, 2)
    return highest


def whole_view(part: Part, times: float | None, loads: bool, limit: float) -> np.ndarray:
    """(2, 2) mm: lower left and upper right corner."""
    corners = part.edges[..., :2].reshape(-1, 2)
    shown = np.vstack([corners, corners + (times or 0) * np.nan_to_num(part.edges[..., 2:4].reshape(-1, 2))])
    view = np.array([shown.min(axis=0), shown.max(axis=0)])
    at = np.array([face["pressure_MPa"]["at_mm"] for face in part.answer["faces"]]).reshape(-1, 2)
    reaches_out = limit > 0 and min((at - view[0]).min(), (view[1] - at).min()) < TALLEST * part.size
    margin = max(0.02, 2 * WORDS * loads, (TALLEST + WORDS) * reaches_out) * part.size
    return view + np.array([[-margin], [margin]])


def near_view(part: Part) -> np.ndarray | None:
    """(2, 2) mm: around the contact with the largest pressure, if it is narrow."""
    closed = [face for face in part.answer["faces"] if face["closed_mm"] > 0]
    face = max(closed, key=lambda own: own["pressure_MPa"]["value"], default=None)
    if face is None or face["closed_mm"] > NARROW * part.size:
        return None
    half = (0.5 + AROUND) * face["closed_mm"]
    return np.array(face["pressure_MPa"]["at_mm"]) + np.array([[-half], [half]])


def draw(part: Part) -> Figure:
    times, scale, limit = enlargement(part), scale_of(part), highest_pressure(part)
    load = float(np.hypot(*np.moveaxis(part.edges[..., 4:6], -1, 0)).max())
    view, near = whole_view(part, times, load > 0, limit), near_view(part)
    room = PAGE_WIDTH - LEFT - RIGHT - (0 if near is None else NEAR + LEFT)
    wide, high = view[1] - view[0]
    height = min(room * high / wide, HIGHEST)
    words = textwrap.wrap(part.shown["assumptions"].split(": ", 1)[-1], LETTERS)
    top = 0.36 + LINE * len(words)
    figure = Figure(figsize=(PAGE_WIDTH, top + max(height, 0 if near is None else NEAR + 0.3) + BELOW))
    text_at(figure, MARGIN, 0.08, plain("von Mises stress of " + title_of(part)), fontsize=11, weight="bold")
    for k, line in enumerate(words):
        text_at(figure, MARGIN, 0.3 + LINE * k, plain(line), color="0.35")

    def view_at(left: float, below: float, width: float, tall: float, limits: np.ndarray) -> Axes:
        axes = axes_at(figure, left, below, width, tall, xlim=limits[:, 0], ylim=limits[:, 1])
        axes.set_xlabel("x, mm", labelpad=1)
        axes.set_ylabel("y, mm", labelpad=2)
        draw_stress(axes, part, scale, limits)
        draw_outline(axes, part)
        mark_largest(axes, part, limits)
        if limit > 0:
            draw_pressures(axes, part, limit, min(part.size, 2 * np.ptp(limits[:, 0])))
        return axes

    axes = view_at(LEFT + (room - height * wide / high) / 2, top, height * wide / high, height, view)
    axes.spines[:].set_visible(False)
    draw_displaced(axes, part, times)
    draw_point_supports(axes, part, view)
    draw_loads(axes, part, load)
    if near is not None:
        axes.add_patch(Rectangle(near[0], *(near[1] - near[0]), fill=False, linewidth=0.8, zorder=8))
        enlarged = view_at(PAGE_WIDTH - RIGHT - NEAR, top + 0.3, NEAR, NEAR, near)
        enlarged.set_title("contact, enlarged", pad=3)
    draw_legend(figure, part, times, load, limit > 0)
    bar = bar_below(figure, ScalarMappable(scale, COLORMAP), 0.64, 0.31, "von Mises stress, MPa" +
                    ("; brightest: this or more" if part.answer["unbounded"] else ""))
    bar.locator = MaxNLocator(5)
    return figure


def draw_legend(figure: Figure, part: Part, times: float | None, load: float, has_pressure: bool) -> None:
    edge = ROLE["force"]
    lines = (("held", "displacement" in part.roles, ROLE["displacement"] | {"path_effects": [TICKED]}),
             ("on rollers", "rollers" in part.roles, edge | ROLLER | {"linestyle": "-"}),
             ("held in a point", bool(part.answer["point_supports"]), IN_POINT | {"marker": TRIANGLE}),
             ("contact", "contact" in part.roles, ROLE["contact"]),
             ("stress unbounded", bool(part.answer["unbounded"]), UNBOUNDED),
             (f"outline, displacement × {times or 0:g}", times is not None, OUTLINE),
             (f"load, up to {load:.3g} MPa", load > 0, edge | {"marker": ">", "markersize": 4}))
    handles = [Line2D([], [], **style, label=label) for label, drawn, style in lines if drawn]
    if has_pressure:
        handles.append(Patch(facecolor=PRESSURE, alpha=0.4, label="contact pressure"))
    figure.legend(handles=handles, loc="lower left", ncol=2, frameon=False, fontsize=SMALLEST_PT + 1,
                  columnspacing=1.2, borderaxespad=0.2, bbox_to_anchor=(0, 0))


def page(part: Part, picture: bytes) -> str:
    style = page_part("page.css") + page_part("part.css")
    image = base64.b64encode(picture).decode()
    notes = "".join(f"<li>{html.escape(note)}</li>" for note in part.shown["notes"])
    fill = {"STYLE": style, "STYLE_HASH": hash_of(style), "TITLE": html.escape(title_of(part)),
            "ASSUMPTIONS": html.escape(part.shown["assumptions"]),
            "PICTURE": f'<img alt="von Mises stress of {html.escape(part.shown["name"])}" '
                       f'src="data:image/png;base64,{image}">',
            "REPORT": "\n".join(map(block, part.shown["report"])),
            "NOTES": notes or "<li>Everything was read as it is.</li>"}
    pieces = page_part("part.html").split("%%")  # text, name, text, name, ... text
    return "".join(fill[piece] if k % 2 else piece for k, piece in enumerate(pieces))


def block(of: str | list[list[str]]) -> str:
    if isinstance(of, str):
        return f"<p>{html.escape(of)}</p>"
    columns = [k for k, head in enumerate(of[0]) if head]
    head = "".join(f'<th scope="col">{html.escape(of[0][k])}</th>' for k in columns)
    rows = "".join("<tr>" + "".join(f'<th scope="row">{html.escape(row[k])}</th>' if k == 0 else
                                    f"<td>{html.escape(row[k])}</td>" for k in columns) + "</tr>"
                   for row in of[1:])
    return f'<div class="scroll" tabindex="0"><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>'


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=Path, metavar="RESULTS_DIR", help="the --out of bench solve")
    parser.add_argument("--html", action="store_true", help="also a page, part.html")
    parser.add_argument("--vector", action="store_true", help="the picture also as .svg and .pdf")


def make(args: argparse.Namespace) -> None:
    part = read_part(args.results)
    with matplotlib.rc_context(STYLE):
        figure = draw(part)
        picture = BytesIO()
        write_small_png(figure, DPI, picture)
        folder = args.results / "figures"
        folder.mkdir(exist_ok=True)
        made = command.Made(folder, "part.py")
        made.replace({"part.png": partial(Path.write_bytes, data=picture.getvalue())} |
                     ({f"part{suffix}": write for suffix, write in for_papers(figure).items()} if args.vector else {}))
        made.remove_others()
    print(f"picture: {folder / 'part.png'}")
    if args.html:
        text = command.text_writer(page(part, picture.getvalue()))
        command.replace_all(args.results, {"part.html": text})
        print(f"page: {args.results / 'part.html'}")


def main() -> None:
    command.run(__doc__, add_arguments, make, "a folder to write to")


if __name__ == "__main__":
    main()
