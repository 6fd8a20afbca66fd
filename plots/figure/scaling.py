"""Strong and weak scaling: what more threads give on one mesh, and on meshes that grow with them.

T_p(m): median time of a method on mesh m with p threads, n(m) its n_phi.
    strong, one mesh m:      speed-up S_p = T_1(m) / T_p(m), efficiency E_p = S_p / p;
    weak, from mesh m_1 on:  m_p is the mesh of the same body with n(m_p) nearest to p n(m_1), at most a
                             factor of NEAR from it, and
        W_p = [n(m_p) / (p T_p(m_p))] / [n(m_1) / T_1(m_1)],
                             the unknowns solved per second and thread over those of one thread on m_1.
The work of a direct method grows faster than its unknowns, whatever the threads do. So
    W_p = G_p E_p(m_p),  G_p = [n(m_p) / T_1(m_p)] / [n(m_1) / T_1(m_1)]:
G_p is what growth costs one thread, E_p(m_p) what is lost to threads.
A time of one sample has no interval, and gives none of these.
"""
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from statistics import median

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullLocator

from drawing import Drawing, Sheet, keys
from figure.profiles import CONFIDENCE, SEED, medians_again
from records import Row
from selection import by_mesh, by_stop, grouped, of_scene, order, with_suffix
from words import columns_of, csv_of, left_out, plain

MESHES = 2  # of strong scaling that there is room for, the largest
OF_ROW = ("mesh", "n_phi", "body", "scene", "method", "stop", "status", "threads", "repetitions",
          "time_s")
OF_POINT = ("speed_up", "speed_up_low", "speed_up_high", "efficiency", "weak_from", "weak_growth",
            "weak_one_thread", "weak_efficiency", "busy_kernel_ratio")
NEAR = 1.3


@dataclass(frozen=True)
class Point:
    row: Row
    speed_up: float | None = None       # None: one sample, not solved, or no such case on one thread
    speed_up_low: float | None = None   # 95 % bootstrap interval of the repetitions
    speed_up_high: float | None = None
    weak_from: str = ""                 # mesh m_1; empty: the mesh is none that grows with the threads
    weak_growth: float | None = None    # n(m_p) / (p n(m_1)): 1 if unknowns grew as the threads
    weak_one_thread: float | None = None  # G_p

    @property
    def efficiency(self) -> float | None:
        return self.speed_up and self.speed_up / self.row.threads

    @property
    def weak_efficiency(self) -> float | None:
        return self.weak_one_thread and self.efficiency and self.weak_one_thread * self.efficiency

    @property
    def busy_kernel_ratio(self) -> float | None:
        """Of the noise kernel on all threads at once over that on one."""
        known = self.row.busy_kernel_s and self.row.noise_kernel_s
        return self.row.busy_kernel_s / self.row.noise_kernel_s if known else None


def is_timed(row: Row | None) -> bool:
    return row is not None and row.solved and row.repetitions > 1


def interval(one: Row, many: Row) -> tuple[float | None, float | None]:
    """Of T_1 / T_p; None where the samples are not there, as in results.csv."""
    if not (one.samples_s and many.samples_s):
        return None, None
    random = np.random.default_rng(SEED)
    again = [medians_again(row.samples_s, random) for row in (one, many)]
    low, high = np.quantile(again[0] / again[1], [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    return float(low), float(high)


def points_of(rows: list[Row]) -> list[Point]:
    """rows: of one scene and stop of a scaling study. In the order of bodies, methods, meshes, threads."""
    found = []
    for own in grouped(rows, lambda row: (row.body, row.method)).values():
        cases = {(row.mesh, row.threads): row for row in own}
        alone = sorted((row for row in own if row.threads == 1 and is_timed(row)),
                       key=lambda row: row.n_phi)
        for row in sorted(own, key=lambda row: (row.n_phi, row.threads)):
            one = cases.get((row.mesh, 1))
            if not (is_timed(one) and is_timed(row)):
                found.append(Point(row))
                continue
            strong = one.time_s / row.time_s, *((1.0, 1.0) if row is one else interval(one, row))
            weak = ()
            if row.mesh == mesh_for(row.threads, alone):
                first = alone[0]
                growth = row.n_phi / first.n_phi
                weak = (first.mesh, growth / row.threads, growth * first.time_s / one.time_s)
            found.append(Point(row, *strong, *weak))
    return found


def mesh_for(threads: int, alone: list[Row]) -> str | None:
    """m_p. alone: the meshes on one thread, the smallest first."""
    def misfit(row: Row) -> float:
        return abs(math.log(row.n_phi / (threads * alone[0].n_phi)))
    best = min(alone, key=misfit)
    return best.mesh if misfit(best) <= math.log(NEAR) else None


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = of_scene([row for row in rows if row.points == "threads"])
    for stop, own in by_stop(study).items():
        yield Drawing(with_suffix("scaling", stop), own, draw, table_of)


def table_of(rows: list[Row]) -> str:
    return csv_of(points_of(rows), *columns_of(lambda point: point.row, *OF_ROW), *OF_POINT)


def draw(rows: list[Row], width: float) -> Sheet | str:
    points = [point for point in points_of(rows) if point.speed_up]
    if len({point.row.threads for point in points}) < 2:
        return ("no method is solved, and timed more than once, on one thread and on more: one "
                "sample gives no efficiency")
    meshes = list(by_mesh([point.row for point in points if point.row.threads > 1]))[-MESHES:]
    panels = [(f"{mesh}: speed-up", [point for point in points if point.row.mesh == mesh],
               lambda point: point.speed_up, float) for mesh in meshes]
    weak = [point for point in points if point.weak_from]
    grown = [point for point in weak if point.row.threads > 1]
    if grown:
        panels.append(("growing meshes: efficiency",
                       [point for point in weak if point.row.body == grown[0].row.body],
                       lambda point: point.weak_efficiency, lambda threads: 1.0))
    sheet = Sheet(width, "Scaling over threads", *caption(points, len(rows) - len(points), len(rows), grown),
                  left_out(rows, [point.row for _, own, *_ in panels for point in own], why_not),
                  panels=len(panels), in_row=3, height=3.0, key=keys(point.row for _, own, *_ in panels for point in own))
    for axes, (title, *panel) in zip(sheet.panels, panels):
        axes.set_title(plain(title))
        draw_panel(axes, *panel)
    return sheet


def why_not(row: Row) -> str:
    return "only on other meshes" if is_timed(row) else "timed once" if row.solved else "not verified"


def caption(points: list[Point], lost: int, count: int, grown: list[Point]) -> Iterator[str]:
    yield ("Speed-up: time of one solve on one thread over that on p, both medians; bars: 95 % "
           "bootstrap intervals of the repetitions; dashed: p. Speed-up over p is the efficiency "
           "(in the CSV).")
    if grown:
        growths = [point.weak_growth for point in grown]
        ratios = " to ".join(dict.fromkeys(f"{end(growths):.2f}" for end in (min, max)))
        yield (
            "Growing meshes: unknowns solved per second and thread, over those of one thread on "
            f"{grown[0].weak_from}. The meshes have {ratios} times the "
            f"unknowns per thread (allowed: a factor of {NEAR}). Work grows faster than unknowns: the "
            "CSV has this loss (weak_one_thread) apart from the loss to threads.")
    busy = [point.busy_kernel_ratio for point in points if point.busy_kernel_ratio]
    if busy:
        yield ("With all threads busy, an independent loop takes "
               f"{median(busy):.2g} times as long as alone (median).")
    if lost:
        yield (f"{lost} of {count} cases are not solved, were timed once, or have no case on "
               "one thread: not drawn.")


def draw_panel(axes: Axes, points: list[Point], value: Callable[[Point], float | None],
               ideal: Callable[[int], float]) -> None:
    strong = ideal(2) == 2
    threads = sorted({point.row.threads for point in points})
    values = [value(point) for point in points] + [ideal(count) for count in threads]
    ends = [point.speed_up_high for point in points if point.speed_up_high and strong]
    axes.set(xscale="log", xlim=(0.85, 1.6 * threads[-1]), xlabel="threads",
             ylim=(0, 1.1 * max([*values, *ends])))
    axes.set_xticks(threads, [str(count) for count in threads])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.plot(threads, [ideal(count) for count in threads], "--", color="0.5", linewidth=0.8)
    for own in grouped(sorted(points, key=lambda point: order(point.row)), lambda point: point.row.method).values():
        look = own[0].row.look
        axes.plot([point.row.threads for point in own], list(map(value, own)), **look.line())
        for point in own:
            if strong and point.speed_up_low and point.row.threads > 1:
                axes.plot([point.row.threads] * 2, [point.speed_up_low, point.speed_up_high],
                          color=look.colour, linewidth=2.5, alpha=0.5)
