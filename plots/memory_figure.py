"""Whose the heap of a solve is at its peak, method by method, beside what the methods count."""
from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import study_parts as parts
from figure_parts import axes_at
from memory_records import OWNERS, Split
from method_names import KRYLOV, compared

WIDTH, LEFT, RIGHT, TOP, BOTTOM, BAR = 8.6, 1.5, 1.75, 0.92, 0.45, 0.27
MIB = 2**20
# Okabe and Ito's colours, and what they stand for.
LOOKS = {"blocks": ("#999999", "blocks S, C, q"),
         "system_matrix": ("#000000", "own system matrix"),
         "factor": ("#0072B2", "factor"),
         "preconditioner": ("#56B4E9", "preconditioner"),
         "intermediate": ("#E69F00", "S⁻¹Cᵀ and its kin"),
         "condensed": ("#D55E00", "D, G and contact"),
         "iteration": ("#009E73", "iteration vectors"),
         "answer": ("#CC79A7", "answer φ, σ"),
         "check": ("#F0E442", "error estimate"),
         "other": ("#DDDDDD", "other")}
COUNT = dict(marker="D", markersize=5.5, markerfacecolor="white", markeredgecolor="black",
             markeredgewidth=1.1, linestyle="none")


def is_shown(method: str) -> bool:
    """All but the preconditioners' variants, of which the paper's stand for the others."""
    return compared(method) is not None or parts.family(method) not in KRYLOV


def chosen(splits: list[Split]) -> list[Split]:
    """Of the largest mesh that has two methods or more; by peak, each method once."""
    meshes: dict[tuple[int, str], dict[str, Split]] = {}
    for split in splits:
        if is_shown(split.method):
            known = meshes.setdefault((split.n_phi, split.mesh), {})
            known[compared(split.method) or split.method] = split
    shown = max(((size, known) for size, known in meshes.items() if len(known) > 1),
                key=lambda of_mesh: of_mesh[0], default=(None, {}))[1]
    return sorted(shown.values(), key=total_peak)


def total_peak(split: Split) -> int:
    return sum(split.peak_bytes.values())


def draw(splits: list[Split]) -> Figure | str:
    """splits: of one scene. The figure, or why there is none."""
    bars = chosen(splits)
    if not bars:
        return "no mesh has two methods whose heap was split"
    used = [owner for owner in OWNERS if any(bar.peak_bytes.get(owner, 0) > 0 for bar in bars)]
    height = BAR * len(bars)
    figure = parts.sheet(WIDTH, TOP + height + BOTTOM, [
        f"{bars[0].mesh}, n_φ = {bars[0].n_phi}, scene {bars[0].scene}, {parts.threads(bars)}. "
        "Highest heap during one solve, split by whose it was at that moment: workspace counts for "
        "the owner it is made for. Diamond: what the method's matrices and vectors take by its own "
        "count, entries times size, and the blocks. A bar that ends beyond it is workspace; one "
        "that ends before it never holds everything at once.",
        "The count differs from the heap by more than 10 %: "
        + ", ".join(bar.method for bar in bars if bar.differs) + "."
        if any(bar.differs for bar in bars) else ""])
    figure.text(parts.MARGIN / WIDTH, 1 - 0.08 / figure.get_size_inches()[1], va="top",
                s="Where the memory goes", fontsize=11, weight="bold")
    axes = axes_at(figure, LEFT, TOP, WIDTH - LEFT - RIGHT, height)
    draw_bars(axes, bars, used)
    figure.legend(*axes.get_legend_handles_labels(), loc="upper left", ncols=4, frameon=False,
                  bbox_to_anchor=(LEFT / WIDTH - 0.01, 1 - 0.26 / figure.get_size_inches()[1]),
                  borderpad=0, columnspacing=1.4, handlelength=1.2, labelspacing=0.3)
    return figure


def draw_bars(axes: Axes, bars: list[Split], used: list[str]) -> None:
    counts = [sum(bar.counted_bytes.values()) / MIB for bar in bars]
    places = range(len(bars))
    start = [0.0] * len(bars)
    for owner in used:
        colour, words = LOOKS[owner]
        widths = [max(bar.peak_bytes.get(owner, 0), 0) / MIB for bar in bars]
        axes.barh(places, widths, left=start, height=0.72, color=colour, label=words,
                  edgecolor="white", linewidth=0.4)
        start = [left + width for left, width in zip(start, widths)]
    axes.plot(counts, places, label="the method's own count", **COUNT)
    axes.set(xlim=(0, 1.04 * max(*start, *counts)), ylim=(-0.6, len(bars) - 0.4),
             xlabel="heap at the peak of the solve, MiB")
    axes.set_yticks(places, [bar.method for bar in bars])
    axes.invert_yaxis()
    axes.tick_params(axis="y", length=0)
    axes.grid(axis="x")
    axes.spines[["top", "right"]].set_visible(False)
    for place, bar, count in zip(places, bars, counts):
        axes.annotate(f"{parts.mebibytes(total_peak(bar))}, counted "
                      f"{parts.mebibytes(count * MIB)}", (1.01, place), va="center",
                      xycoords=axes.get_yaxis_transform(), fontsize=7, annotation_clip=False)
