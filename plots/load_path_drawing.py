"""Draws a path of load steps: the contact face over the steps, and the force over the displacement."""
import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import ListedColormap, Normalize, TwoSlopeNorm, to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from PIL import Image

from drawing import PAGE_WIDTH, axes_at, caption_of, colour_bar, panel_at, text_at
from field_drawing import COLORMAP, STATE, Scales, highest_but, scales_of
from field_panel import draw_legend, draw_panel, layout_of
from fields import STATES, Fields
from load_path import LoadPath, returns
from words import plain

LEFT, TOP, GAP, HEIGHT, BAR, BOTTOM = 0.6, 0.1, 0.34, 2.9, 0.55, 0.5  # inches, of the maps
LOOP_TOP, LOOP_HEIGHT, LOOP_WIDTH = 0.1, 2.5, 3.2
OPEN = "#E4E4E4"  # a point without pressure
CYCLE, PATH = "#F5B183", "black"
MOST_FRAMES, MOST_BYTES, FRAME_MS = 60, 1_000_000, 250
FRAME_WIDTH, FRAME_TOP, FRAME_FOOT = 8.3, 0.4, 0.62
FRAME_DPI, LEAST_SCALE = 80, 0.6
COLOURS = 112
ONE_PLACE, MOST_TURNS = 0.03, 8  # of the loop: labels as near as this are joined; turns with labels
FIXED = ("white", "black", *(STATE[state][key] for state in ("stick", "slip")
                              for key in ("color", "fill")),
         *colormaps[COLORMAP].resampled(32).colors)


def draw_path(path: LoadPath) -> Figure:
    """Maps of state, pressure and friction, places to the right and steps upwards; the loop below."""
    top = TOP + HEIGHT + BOTTOM + BAR
    figure = Figure(figsize=(PAGE_WIDTH, top + LOOP_TOP + LOOP_HEIGHT + BOTTOM))
    width = (PAGE_WIDTH - LEFT - 0.15 - 2 * GAP) / 3
    pressure, friction = path.traction[..., 0], path.traction[..., 1]
    high, largest = (usual(np.abs(values)) for values in (pressure, friction))
    clipped = ["; ends: or beyond" * bool(np.abs(values).max() > end) for values, end in ((pressure, high), (friction, largest))]
    maps = ((np.select([path.state == name for name in STATES], range(3)),
             ListedColormap([OPEN, STATE["stick"]["color"], STATE["slip"]["color"]]),
             Normalize(-0.5, 2.5), ""),
            (pressure, COLORMAP, Normalize(0, high, clip=True), "pressure, MPa" + clipped[0]),
            (friction, "PuOr", TwoSlopeNorm(0, -largest, largest), "friction, MPa" + clipped[1]))
    for k, (values, colours, norm, label) in enumerate(maps):
        axes = axes_at(figure, LEFT + k * (width + GAP), TOP, width, HEIGHT)
        drawn = axes.pcolormesh(*corners_of(path), values, cmap=colours, norm=norm, rasterized=True)
        axes.set_xlabel(path.axis.replace(" from its dot", ""), labelpad=1)
        axes.set_xlim(path.shown)
        axes.set_ylabel("" if k else "load step")
        axes.tick_params(labelleft=k == 0, length=2)
        axes.yaxis.get_major_locator().set_params(integer=True)
        place = (LEFT + k * (width + GAP) + 0.1, TOP + HEIGHT + BOTTOM)
        if label:
            colour_bar(figure, drawn, *place, width - 0.2, label)
        else:
            figure.legend(handles=[Patch(color=colour, label=state) for state, colour in
                                   zip(STATES, colours.colors)], ncol=3, loc="upper left",
                          frameon=False, handlelength=1, columnspacing=1, borderpad=0,
                          bbox_to_anchor=(place[0] / PAGE_WIDTH,
                                          1 - place[1] / figure.get_size_inches()[1]))
    draw_loop(panel_at(figure, LEFT, top + LOOP_TOP, LOOP_WIDTH, LOOP_HEIGHT), path)
    draw_dissipation(panel_at(figure, LEFT + LOOP_WIDTH + 0.85, top + LOOP_TOP,
                              PAGE_WIDTH - LEFT - LOOP_WIDTH - 1.5, LOOP_HEIGHT), path)
    return figure


def usual(values: np.ndarray) -> float:
    """The end of a scale: the largest value, or less where few values, as at a singular corner, are far larger."""
    there = values[values > 0]
    return highest_but(there, np.ones(len(there)), 0.98, 1.2) if len(there) else 1.0


def caption(path: LoadPath) -> str:
    return caption_of(
        title_of(path),
        f"Contact face{which(path)} over the load steps: where its points are open, stick or slip, "
        f"pressure, and friction (on the body, positive to the right).{part_of(path)} "
        f"Below left: force Q of the body {way_of(path)} over {whose(path)}, with numbers of steps: "
        "the first, the last, and where the motion turns. Below right: energy that friction "
        "dissipates, Σ\u00a0−F_t\u00a0Δr_t over all contact points. Forces and energies are per mm of "
        "thickness.", *words_of_cycle(path))


def words_of_cycle(path: LoadPath) -> Iterator[str]:
    """Work put in and energy dissipated: ∮ Q dU = D + ΔW, with the energy W stored in the body."""
    if path.cycle is None:
        return
    first, *_, last = path.step[path.cycle]
    lost = path.dissipated_in_cycle()
    dissipates = (f"From step {first} to step {last}, when the loads of step {first} return, friction "
                  f"dissipates {lost:.3g} N mm/mm.")
    if path.moved is None:
        yield dissipates
        return
    area = path.area()
    ends = [f"{what} ({1e3**k * values[path.cycle][0]:.4g} and {1e3**k * values[path.cycle][-1]:.4g} {unit})"
            for k, what, values, unit in ((0, "force", path.push, "N/mm"),
                                          (1, "displacement", path.moved, "µm"))
            if not returns(values, path.cycle)]
    yield (f"{dissipates} That is not the shaded area: ∮\u00a0Q\u00a0dU = {area:.3g} N mm/mm is the "
           "work of Q, with straight lines between the steps. " +
           (f"The {' and the '.join(ends)} {'does' if len(ends) == 1 else 'do'} not return: the cycle is "
            f"not closed, and the difference of {area - lost:.2g} N mm/mm is mainly energy stored in the "
            "body. Over a closed cycle in small steps the two are equal." if ends else
            "Force and displacement return as well; the difference is the error of the straight lines, "
            "the work of other loads and energy stored in the body."))


def title_of(path: LoadPath) -> str:
    mesh, scene, method = (path.name.split("--") + ["", ""])[:3]
    return f"{mesh}, {scene}, {method.replace('+', ':')}: {len(path.step)} load steps"


def which(path: LoadPath) -> str:
    return f" {path.face + 1} of {path.faces}, which is pressed most," if path.faces > 1 else ""


def part_of(path: LoadPath) -> str:
    start, end = path.along[0, 0], path.along[-1, 1]
    if path.shown == (start, end):
        return ""
    return f" The face is {end - start:.3g} mm long; what is left out of it stays open."


def way_of(path: LoadPath) -> str:
    return (f"on the {path.obstacle}, normal to it," if path.is_normal else
            f"along the {path.obstacle}")


def whose(path: LoadPath) -> str:
    if not path.moved_what:
        return "the steps (displacements are unknown)"
    way = "towards" if path.is_normal else "along"
    return f"the mean displacement of its {path.moved_what} boundary {way} it"


def corners_of(path: LoadPath) -> tuple[np.ndarray, np.ndarray]:
    """Limits of the points along the face, and of the steps."""
    return np.r_[path.along[:, 0], path.along[-1, 1]], np.r_[path.step - 0.5, path.step[-1] + 0.5]


def draw_loop(axes: Axes, path: LoadPath, until: int | None = None) -> None:
    """until: the step, from 0, that a dot marks; the others lie in grey."""
    x = path.step if path.moved is None else 1e3 * path.moved
    if path.cycle is not None and path.moved is not None:
        axes.fill(x[path.cycle], path.push[path.cycle], color=CYCLE, alpha=0.6, linewidth=0)
    axes.plot(x, path.push, color=PATH if until is None else "0.6", linewidth=1.1, marker="o",
              markersize=2.2)
    if until is not None:
        axes.plot(x[:until + 1], path.push[:until + 1], color=PATH, linewidth=1.3)
        axes.plot(x[until], path.push[until], color=STATE["slip"]["color"], marker="o", markersize=7)
    axes.axhline(0, color="0.5", linewidth=0.5)
    axes.set_xlabel("load step" if path.moved is None else
                    f"displacement of the {path.moved_what} boundary, µm", labelpad=1)
    axes.set_ylabel(f"force on the {path.obstacle}, N/mm", labelpad=2)
    axes.margins(0.08)
    if until is None:
        middle = (path.push.min() + path.push.max()) / 2
        for places in labelled(path, x):
            k = places[-1]
            axes.annotate(", ".join(str(path.step[place]) for place in places), (x[k], path.push[k]),
                          weight="bold", xytext=(5, 3 if path.push[k] >= middle else -9),
                          textcoords="offset points")


def labelled(path: LoadPath, x: np.ndarray) -> list[list[int]]:
    """Steps, from 0, whose numbers are drawn, those together that are nearly at one place."""
    ends = {0, len(x) - 1, *(range(len(x))[path.cycle][::len(x[path.cycle]) - 1] if path.cycle else ())}
    turns = path.turns
    points = np.stack([values / (np.ptp(values) or 1) for values in (x, path.push)], 1)
    found: list[list[int]] = []
    for k in sorted(ends.union(turns if len(turns) <= MOST_TURNS else turns[:1] + turns[-1:])):
        near = [group for group in found if np.hypot(*(points[group[0]] - points[k])) < ONE_PLACE]
        near[0].append(k) if near else found.append([k])
    return found


def draw_dissipation(axes: Axes, path: LoadPath) -> None:
    axes.bar(path.step, path.dissipated, width=0.8, color=CYCLE, label="in the step")
    total = axes.twinx()
    total.plot(path.step, np.cumsum(path.dissipated), color=PATH, linewidth=1.1)
    total.set_ylim(0, 1.08 * max(path.dissipated.sum(), 1e-300))
    axes.set_ylim(0, 1.08 * max(path.dissipated.max(), 1e-300))
    axes.set_xlabel("load step", labelpad=1)
    axes.set_ylabel("dissipated in a step (bars), N mm/mm", labelpad=2)
    total.set_ylabel("from the beginning (line), N mm/mm", labelpad=2)
    total.spines["top"].set_visible(False)
    axes.xaxis.get_major_locator().set_params(integer=True)


def frames_of(path: LoadPath) -> list[int]:
    """Steps, from 0, with a body in files: all, or so many, evenly spread, and the last."""
    there = np.flatnonzero(path.has_body)
    count = min(len(there), MOST_FRAMES)
    return sorted(set(there[np.linspace(0, len(there) - 1, count).round().astype(int)].tolist()))


def frames(path: LoadPath, of_steps: dict[int, Fields]) -> Iterator[Figure]:
    """All with the same scales, factor of displacements and legend."""
    scales = scales_of(list(of_steps.values()))
    touched = np.any([s.state != "open" for s in of_steps.values()], axis=0)
    for step, s in of_steps.items():
        figure = draw_frame(path, step, replace(s, touched=touched), scales)
        draw_legend(figure, scales, list(of_steps.values()))
        yield figure


def draw_frame(path: LoadPath, step: int, s: Fields, scales: Scales) -> Figure:
    """One step: body and contact faces, and next to them where on the loop it is."""
    loop = 2.9
    layout = layout_of(s, FRAME_WIDTH - loop)
    figure = Figure(figsize=(FRAME_WIDTH, FRAME_TOP + layout.height + FRAME_FOOT))
    text_at(figure, 0.1, 0.08, plain(f"{title_of(path)}, step {path.step[step]}"), fontsize=11,
            weight="bold")
    top = figure.get_size_inches()[1] - FRAME_TOP
    draw_panel(figure, s, 0, top, FRAME_WIDTH - loop, scales)
    draw_loop(panel_at(figure, FRAME_WIDTH - loop + 0.6, FRAME_TOP + 0.3, loop - 0.75, 2.2), path, step)
    text_at(figure, FRAME_WIDTH - loop + 0.6, FRAME_TOP + 3.05,
            f"dissipated so far\n{path.dissipated[:step + 1].sum():.3g} N mm/mm")
    return figure


def write_gif(figures: Iterable[Figure], path: Path, most_bytes: int = MOST_BYTES) -> None:
    """An animation that goes on and on, shrunk until it has at most so many bytes; where it would be
    too small to read, of every second frame, and so on."""
    frames = [image_of(figure, FRAME_DPI) for figure in figures]
    scale, every = 1.0, 1
    while True:
        shown = [shrunk(frame, scale) for frame in frames[::-every][::-1]]
        palette = palette_of(shown[-1])
        first, *others = [frame.quantize(palette=palette, dither=Image.Dither.NONE)
                          for frame in shown]
        first.save(path, format="GIF", save_all=True, append_images=others, loop=0, optimize=True,
                   duration=[FRAME_MS] * len(others) + [4 * FRAME_MS])
        size = path.stat().st_size
        if size <= most_bytes or not others:
            return
        scale *= 0.95 * math.sqrt(most_bytes / size)
        if scale < LEAST_SCALE:
            scale, every = LEAST_SCALE, 2 * every


def shrunk(image: Image.Image, scale: float) -> Image.Image:
    size = round(scale * image.width), round(scale * image.height)
    return image if scale == 1 else image.resize(size, Image.Resampling.LANCZOS)


def palette_of(image: Image.Image) -> Image.Image:
    """The states' and the scale's colours, which may be few pixels, and those that stand for the rest."""
    fixed = [round(255 * part) for colour in FIXED for part in to_rgb(colour)]
    others = image.quantize(COLOURS - len(FIXED)).getpalette()[:3 * (COLOURS - len(FIXED))]
    palette = Image.new("P", (1, 1))
    palette.putpalette(fixed + others)
    return palette


def image_of(figure: Figure, dpi: int) -> Image.Image:
    figure.set_dpi(dpi)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3])
