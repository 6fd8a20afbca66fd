"""Speed-up on one mesh and efficiency on growing meshes over the number of threads."""
from collections.abc import Callable, Iterator
from statistics import median

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from drawing import Drawing, sheet, side_by_side
from labels import Labels
from records import Row
from selection import by_mesh, grouped, of_scene, order
from thread_scaling import NEAR, Point, points_of
from words import columns_of, csv_of

LEFT, TOP, BOTTOM, HEIGHT, GAP = 0.5, 0.55, 0.45, 3.2, 0.45  # inches
MESHES = 2  # of strong scaling that there is room for, the largest
OF_ROW = ("mesh", "n_phi", "body", "scene", "method", "stop", "status", "threads", "repetitions",
          "time_s")
OF_POINT = ("speed_up", "speed_up_low", "speed_up_high", "efficiency", "weak_from", "weak_growth",
            "weak_one_thread", "weak_efficiency", "busy_kernel_ratio")


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = of_scene([row for row in rows if row.study == "scaling"])
    for stop, own in grouped(study, lambda row: row.stop).items():
        yield Drawing(f"scaling{'_paper_stop' if stop == 'paper' else ''}", own, draw, table_of,
                      vector=True)


def table_of(rows: list[Row]) -> str:
    return csv_of(points_of(rows), *columns_of(lambda point: point.row, *OF_ROW), *OF_POINT)


def draw(rows: list[Row]) -> Figure | str:
    points = [point for point in points_of(rows) if point.speed_up]
    if len({point.row.threads for point in points}) < 2:
        return ("no method is solved, and timed more than once, on one thread and on more: one "
                "sample gives no efficiency")
    meshes = list(by_mesh([point.row for point in points if point.row.threads > 1]))[-MESHES:]
    panels = [(f"{mesh}: speed-up, 1", [point for point in points if point.row.mesh == mesh],
               lambda point: point.speed_up, float) for mesh in meshes]
    weak = [point for point in points if point.weak_from]
    grown = [point for point in weak if point.row.threads > 1]
    if grown:
        panels.append(("growing meshes: efficiency, 1",
                       [point for point in weak if point.row.body == grown[0].row.body],
                       lambda point: point.weak_efficiency, lambda threads: 1.0))
    figure = sheet(TOP + HEIGHT + BOTTOM, "Scaling over threads",
                   *caption(points, len(rows) - len(points), len(rows), grown))
    row = side_by_side(figure, [title for title, *_ in panels], LEFT, TOP, HEIGHT, GAP, right=0.15)
    for axes, (_, *panel) in zip(row, panels):
        axes.tick_params(labelleft=True)
        draw_panel(axes, *panel)
    return figure


def caption(points: list[Point], lost: int, count: int, grown: list[Point]) -> Iterator[str]:
    yield ("Speed-up: time of one solve on one thread over that on p, both medians; bars: 95 % "
           "bootstrap intervals of the repetitions; dashed: p. Its share of p is the efficiency "
           "(in the CSV).")
    if grown:
        growths = [point.weak_growth for point in grown]
        ratios = " to ".join(dict.fromkeys(f"{end(growths):.2f}" for end in (min, max)))
        yield (
            "Growing meshes: unknowns solved per second and thread, over those of one thread on "
            f"{grown[0].weak_from}. The meshes have {ratios} times the "
            f"unknowns per thread (allowed: a factor of {NEAR}). Work grows faster than unknowns: the "
            "CSV has what one thread loses to that (weak_one_thread) apart from what threads lose.")
    busy = [point.busy_kernel_ratio for point in points if point.busy_kernel_ratio]
    if busy:
        yield ("With all threads busy a loop that shares nothing but the machine takes "
               f"{median(busy):.2g} times its time alone (median).")
    if lost:
        yield (f"{lost} of {count} cases are not solved, were timed once, or have no case on "
               "one thread: not drawn.")


def draw_panel(axes: Axes, points: list[Point], value: Callable[[Point], float | None],
               ideal: Callable[[int], float]) -> None:
    strong = ideal(2) == 2
    threads = sorted({point.row.threads for point in points})
    values = [value(point) for point in points] + [ideal(count) for count in threads]
    ends = [point.speed_up_high for point in points if point.speed_up_high and strong]
    axes.set(xscale="log", xlim=(0.85, 1.6 * threads[-1]), xlabel="threads, 1",
             ylim=(0, 1.1 * max([*values, *ends])))
    axes.set_xticks(threads, [str(count) for count in threads])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.plot(threads, [ideal(count) for count in threads], "--", color="0.5", linewidth=0.8)
    labels = Labels(axes)
    for method, own in grouped(sorted(points, key=lambda point: order(point.row)),
                               lambda point: point.row.method).items():
        look = own[0].row.look
        labels.line(method, [point.row.threads for point in own], list(map(value, own)),
                    look.colour, marker=look.marker, markersize=5, linewidth=1.2)
        for point in own:
            if strong and point.speed_up_low and point.row.threads > 1:
                axes.plot([point.row.threads] * 2, [point.speed_up_low, point.speed_up_high],
                          color=look.colour, linewidth=2.5, alpha=0.5)
    for method, counts, heights, _, colour in labels.lines:
        labels.add(method, counts[:1], heights[:1], color=colour, weight="bold")
