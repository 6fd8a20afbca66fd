"""Outcomes of cases: a cell for each, methods across, extreme scenes or adapted meshes down."""
import math
import re
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import groupby
from operator import attrgetter

from matplotlib.patches import Rectangle

from drawing import PAGE_WIDTH, SMALLEST_PT, TYPE, Drawing, Sheet, file_name
from records import OUTCOMES, Row
from selection import by_mesh, by_stop, compared, grouped, of_kind, order, with_suffix
from words import at_stop, csv_of, plain, seconds, short, threads, width_of

ROOM = 12  # methods with a column; the others of a family share one
ROW, CELL, WIDE, ABOVE = 0.165, 0.34, 0.66, 0.3  # inches
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")
# Outcome -> letter, fill, colour of the letter; the letters and the lightness say it in grey.
MARKS = {
    "ok": ("", "#EAF3FA", "#123A5A"),
    "other_solution": ("2", "#CFE8D5", "#12402A"),
    "inaccurate": ("i", "#F5D76E", "black"),
    "unstressed": ("0", "#FFFFFF", "0.4"),
    "not_converged": ("n", "#E8A33D", "black"),
    "breakdown": ("b", "#B07A4A", "white"),
    "unverified": ("?", "#FFFFFF", "black"),
    "wrong_success": ("W!", "#D00060", "white"),
    "timeout": ("t", "#A9A9B8", "black"),
    "out_of_memory": ("m", "#6B6B80", "white"),
    "crashed": ("X", "#000000", "white"),
    "machine_fault": ("f", "#DADADA", "black"),
    "skipped": ("–", "#FFFFFF", "0.4"),
}
# Of the table, of scenes and of adapted meshes.
OF_SCENES = ("scene_group", "scene")
OF_MESHES = ("body", "n_phi", "error_total", "time_s", "peak_heap_bytes")
GOOD = ("ok", "other_solution", "unstressed", "skipped")
WORDS = {"other_solution": "another solution than the reference's", "unstressed": "no stress, so no relative error",
         "unverified": "reported ok, cannot be verified", "wrong_success": "wrong success: reported ok, but is not",
         "timeout": "time limit reached", "machine_fault": "no process or file available"}


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    for mesh, study in by_mesh(of_kind(rows, "stability")).items():
        for stop, own in by_stop(study).items():
            yield Drawing(with_suffix(file_name("outcomes", mesh), stop), own, draw, table_of)
    for stop, own in by_stop(of_kind(rows, "adapted")).items():
        yield Drawing(with_suffix("outcomes_adapted", stop), own, draw, table_of)


def outcome_of(row: Row) -> str:
    return row.outcome or row.status


def digits(row: Row) -> str:
    """Whole digits of the largest error; "+" if none is known."""
    errors = [error for error in (row.error_stress, row.error_force) if error is not None]
    if not errors:
        return "+"
    return str(min(max(math.floor(-math.log10(max(*errors, 1e-17))), 0), 16))


def has_scenes(rows: list[Row]) -> bool:
    """Scenes in its lines, or meshes."""
    return all(row.scene_group for row in rows)


def line_key(rows: list[Row]) -> Callable[[Row], tuple[str, str]]:
    """Group and name of the line of cells that a case is in."""
    return attrgetter(*(("scene_group", "scene") if has_scenes(rows) else ("body", "mesh")))


def lines_of(rows: list[Row]) -> list[tuple[str, str]]:
    """In the order of groups, then of sizes or of the numbers in a scene's name."""
    line_of, of_scenes = line_key(rows), has_scenes(rows)
    sizes = {line_of(row): 0 if of_scenes else row.n_phi for row in rows}
    return sorted(sizes, key=lambda line: (line[0], sizes[line], NUMBER.split(line[1]),
                                           [float(number) for number in NUMBER.findall(line[1])]))


def columns_of(rows: list[Row]) -> dict[str, list[str]]:
    """Head of a column -> its methods: those with room, then what is left of each family."""
    rows = sorted(rows, key=order)
    named = {row.method for row in compared(rows, ROOM)}
    columns = {row.label: [row.method] for row in rows if row.method in named}
    for family, own in grouped((row for row in rows if row.method not in named), lambda row: row.family).items():
        methods = list(dict.fromkeys(row.method for row in own))
        columns[f"{family}: {len(methods)} more" if len(methods) > 1 else own[0].label] = methods
    return columns


def kappa_of(rows: list[Row]) -> float | None:
    """HYBRID factorises another matrix, whose κ is smaller by orders of magnitude."""
    return max((row.condition_estimate for row in rows if row.condition_estimate and row.family != "HYBRID"), default=None)


def cell_of(rows: list[Row], wide: bool) -> tuple[str, str, str]:
    """Words, fill and colour of a cell: of one case, or of several methods the worst of their outcomes."""
    outcomes = Counter(map(outcome_of, rows))
    worst = max(outcomes, key=lambda outcome: (outcome not in GOOD, outcome == "wrong_success", outcomes[outcome]))
    letter, fill, ink = MARKS[worst]
    if len(rows) > 1:
        good = sum(outcomes[outcome] for outcome in GOOD)
        return letter if outcomes[worst] == len(rows) and letter else f"{good}/{len(rows)}", fill, ink
    row, = rows
    if wide and row.completed and row.time_s:
        return seconds(row.time_s), fill, ink
    return (letter or digits(row)), fill, ink


def table_of(rows: list[Row]) -> str:
    place, line_of = {line: k for k, line in enumerate(lines_of(rows))}, line_key(rows)
    return csv_of(sorted(rows, key=lambda row: (place[line_of(row)], order(row))),
                  "mesh", *(OF_SCENES if has_scenes(rows) else OF_MESHES), "method", "outcome",
                  ("digits", lambda row: digits(row) if outcome_of(row) == "ok" else None),
                  "error_stress", "error_force", "condition_estimate")


def draw(rows: list[Row], width: float) -> Sheet:
    """As wide as a page at least: a table cannot be narrower than its words."""
    lines, columns = lines_of(rows), columns_of(rows)
    line_of, of_scenes = line_key(rows), has_scenes(rows)
    places = [line for group, own in groupby(lines, key=lambda line: line[0]) for line in ((group, ""), *own)]
    kappas = {line: kappa_of([row for row in rows if line_of(row) == line]) for line in lines}
    with_kappa = any(kappas.values())
    counts = Counter(map(outcome_of, rows))
    subject = f"{len(lines)} scenes on {rows[0].mesh}" if of_scenes else f"{len(lines)} adapted meshes"
    across = len(columns) + 1.5 * with_kappa
    cell = min(CELL if of_scenes else WIDE, (PAGE_WIDTH - 1.9) / across)
    names = max(width_of(line[1] or line[0], TYPE, "bold") for line in places) / 72 + 0.2
    above = max(width_of(name, TYPE) for name in columns) / 72 + 0.15
    key = [(f"{MARKS[outcome][0]} {words}: {counts[outcome]}".strip(), dict(
        linestyle="none", marker="s", markersize=9, markerfacecolor=MARKS[outcome][1], markeredgecolor="0.5"))
        for outcome in OUTCOMES if counts[outcome] or outcome == "wrong_success"
        for words in [WORDS.get(outcome, outcome.replace("_", " "))]]
    sheet = Sheet(
        max(names + cell * across + 0.2, 5), f"Outcomes: {len({row.method for row in rows})} methods, {subject}{at_stop(rows)}",
        "A row is an extreme scene. ok: all errors and residuals at most the target; a number n: the errors of "
        "stresses and contact forces are at most 1e-n; +: no such error is known." if of_scenes else
        f"{threads(rows)}. A row is an adapted mesh, a cell the time of one solve.",
        "A column with several methods: how many of them are ok, in the colour of the worst outcome; each case is in "
        "the CSV. Empty: not in the study. Last line: how many of a column's cases are ok.",
        "κ: estimate of the 1-norm condition number of the matrix that a method other than HYBRID factorises, the largest of "
        "those that got so far." if with_kappa else "", height=above + ROW * (len(places) + 1) + 0.15, key=key)
    axes, = sheet.panels
    axes.set(xlim=(0, across), ylim=(len(places) + 1, 0))
    axes.grid(False)
    axes.spines[:].set_visible(False)
    cases = grouped(rows, lambda row: (line_of(row), row.method))
    for x, methods in enumerate(columns.values()):
        for y, line in enumerate(places):
            if own := [row for method in methods for row in cases.get((line, method), ())]:
                words, fill, ink = cell_of(own, wide=not of_scenes)
                bold = fill == MARKS["wrong_success"][1]
                axes.add_artist(Rectangle((x, y), 1, 1, facecolor=fill, edgecolor="black" if bold else "white",
                                          linewidth=0.6, clip_on=False, zorder=2 + bold))
                axes.text(x + 0.5, y + 0.53, words, color=ink, ha="center", va="center", fontsize=SMALLEST_PT, zorder=4)
        every = [row for method in methods for row in rows if row.method == method]
        axes.text(x + 0.5, len(places) + 0.55, f"{sum(outcome_of(row) == 'ok' for row in every)}\n/{len(every)}",
                  ha="center", va="top", fontsize=SMALLEST_PT, color="0.35", linespacing=0.9)
    for y, line in enumerate(places):
        if not line[1]:
            axes.axhline(y + 0.95, color="0.25", linewidth=0.6, zorder=5)
        elif kappas[line]:
            axes.text(across, y + 0.53, short(kappas[line]), ha="right", va="center", fontsize=SMALLEST_PT)
    if with_kappa:
        axes.text(across, 0.5, "κ", ha="right", va="center", fontsize=TYPE)
    axes.set_yticks([y + 0.5 for y in range(len(places))], [plain(name or group) for group, name in places])
    for tick, (_, name) in zip(axes.get_yticklabels(), places):
        tick.set_fontweight("normal" if name else "bold")
    axes.set_xticks([x + 0.5 for x in range(len(columns))], map(plain, columns), rotation=90)
    axes.tick_params(length=0, pad=3, labeltop=True, labelbottom=False)
    return sheet
