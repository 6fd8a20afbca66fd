"""Methods on adapted meshes: a cell per case with its outcome, time, error and condition number."""
from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from drawing import SMALLEST_PT, Drawing, axes_at, sheet
from outcomes import MARKS, SIZE, Key, in_blocks
from records import Row
from selection import by_mesh, by_method, by_stop, of_scene, order, with_suffix
from words import at_stop, csv_of, percent, plain, seconds, short, threads

CELL, NARROWEST, ROW, ABOVE, BETWEEN = 1.2, 1.02, 0.36, 0.6, 0.1  # inches
LETTER = 0.078  # inches: of a name's letter, about
COLUMNS = ("mesh", "body", "n_phi", "error_total", "method", "outcome", "time_s",
           "peak_heap_bytes", "error_stress", "error_force", "condition_estimate")


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = of_scene([row for row in rows if row.study == "adapted"])
    for stop, own in by_stop(study).items():
        yield Drawing(with_suffix("adapted_methods", stop), own, draw, table_of)


def table_of(rows: list[Row]) -> str:
    return csv_of([row for own in by_mesh(rows).values() for row in sorted(own, key=order)],
                  *COLUMNS)


def words_of(row: Row) -> tuple[str, str]:
    if not row.completed or not row.time_s:
        status, _, done = row.status_words().partition(", ")
        return status, done
    second = [short(max(row.error_stress or 0, row.error_force or 0))] \
        if row.error_stress is not None else []
    second += [f"κ {short(row.condition_estimate)}"] if row.condition_estimate else []
    return seconds(row.time_s), ", ".join(second)


def head_of(rows: list[Row]) -> str:
    """Of a mesh: body, error and size. Its error is that of any method whose own is far below."""
    errors = [row.error_discretisation for row in rows
              if row.error_discretisation and not row.in_displacements]
    return f"{rows[0].body}\n{percent(min(errors)) if errors else '?'}\n$n_\\varphi$ = {rows[0].n_phi}"


def draw(rows: list[Row]) -> Figure:
    meshes = list(by_mesh(rows).values())
    methods = list(by_method(rows, "n_phi"))
    left = 0.25 + LETTER * max(map(len, methods))
    blocks, cell = in_blocks(meshes, left, NARROWEST, CELL)
    block = ABOVE + ROW * len(methods)
    key = Key(rows, ("", "ok"))
    body = 0.3 + len(blocks) * (block + BETWEEN) + key.height
    figure = sheet(
        body, f"Methods on adapted meshes{at_stop(rows)}",
        f"Scene {rows[0].scene}, {threads(rows)}. A column is a mesh, with its total error. A "
        "cell: time of one solve; below it the larger of the relative errors of stresses and contact "
        "forces, and κ, an estimate of the 1-norm condition number of the matrix that the method "
        "factorises.")
    for k, own in enumerate(blocks):
        axes = axes_at(figure, left, 0.3 + k * (block + BETWEEN) + ABOVE, cell * len(own),
                       ROW * len(methods), xlim=(0, len(own)), ylim=(len(methods), 0))
        draw_cells(axes, own, methods)
        axes.set_yticks([k + 0.5 for k in range(len(methods))], map(plain, methods), fontsize=8)
        axes.set_xticks([])
        axes.tick_params(length=0, pad=3)
        axes.spines[:].set_visible(False)
    key.draw(figure, body - key.height + 0.12)
    return figure


def draw_cells(axes: Axes, meshes: list[list[Row]], methods: list[str]) -> None:
    for x, own in enumerate(meshes):
        axes.annotate(head_of(own), (x + 0.5, 0), xytext=(0, 3), textcoords="offset points",
                      ha="center", va="bottom", fontsize=SIZE)
        for row in own:
            y = methods.index(row.method)
            _, fill, ink = MARKS[row.outcome or row.status]
            axes.add_patch(Rectangle((x, y), 1, 1, facecolor=fill, edgecolor="white",
                                     linewidth=0.8))
            first, second = words_of(row)
            axes.text(x + 0.5, y + (0.33 if second else 0.5), first, color=ink, ha="center",
                      va="center", fontsize=SIZE, weight="bold")
            axes.text(x + 0.5, y + 0.72, second, color=ink, ha="center", va="center",
                      fontsize=SMALLEST_PT)
