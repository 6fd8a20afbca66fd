"""Which cases belong in a figure, by the columns of their records."""
import re
from collections.abc import Callable, Hashable, Iterable
from typing import TypeVar

import numpy as np

from records import STOPS, Row

Item, Key = TypeVar("Item"), TypeVar("Key", bound=Hashable)
LEVEL_OF_DEGREE = re.compile(r"\+adapt\d+k(\d+)")  # of stresses
GIVEN = re.compile(r"\br=([^,:]+),rho=([^,:]+)")  # parameters of an augmented Lagrangian method


def grouped(items: Iterable[Item], key: Callable[[Item], Key]) -> dict[Key, list[Item]]:
    groups: dict[Key, list[Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups


def by_mesh(rows: list[Row]) -> dict[str, list[Row]]:
    return grouped(sorted(rows, key=lambda row: row.n_phi), lambda row: row.mesh)


def by_body(rows: list[Row]) -> dict[str, list[Row]]:
    return grouped(rows, lambda row: row.body)


def with_suffix(name: str, stop: str) -> str:
    """Of a figure that shows one stop."""
    return f"{name}_paper_stop" if stop == "paper" else name


def by_stop(rows: list[Row]) -> dict[str, list[Row]]:
    groups = {stop: [row for row in rows if row.stop == stop] for stop in STOPS}
    return {stop: own for stop, own in groups.items() if own}


def has_other_solver(row: Row) -> bool:
    """Of the contact law than it implies; only the figure `contact` tells solvers apart."""
    return row.points != "contact" and "/contact=" in row.case_name


def comparable(rows: list[Row]) -> list[Row]:
    """Without cases that have another solver of the contact law, if others remain."""
    others_remain = any(row.points != "contact" and not has_other_solver(row) for row in rows)
    return [row for row in rows if not (others_remain and has_other_solver(row))]


def kind_of(row: Row) -> str:
    """Of mesh."""
    return "adapted" if "+adapt" in row.mesh else \
        "refined everywhere" if "+refine" in row.mesh else "as they are"


def kinds_of_studies(rows: list[Row]) -> dict[str, str]:
    """Name of a study -> its kind by what its records have, never by the name; of ordinary runs, too."""
    return {name: kind_of_study(own) for name, own in grouped(rows, lambda row: row.study).items()}


def kind_of_study(rows: list[Row]) -> str:
    """Its points; load_steps: a number of them in each scene; stability: scenes of groups; adapted meshes; or other."""
    if not rows[0].study:
        return ""
    paths = {(row.scene, row.load_steps) for row in rows if row.load_steps}
    scenes, counts = map(set, zip(*paths)) if paths else (set(), set())
    return rows[0].points or ("load_steps" if len(scenes) == len(counts) == len(paths) > 1 else
                              "stability" if all(row.scene_group for row in rows) else
                              "adapted" if any(kind_of(row) == "adapted" for row in rows) else "other")


def of_kind(rows: list[Row], kind: str) -> list[Row]:
    """The rows of such studies."""
    kinds = kinds_of_studies(rows)
    return [row for row in rows if kinds[row.study] == kind]


def adapting(row: Row) -> str:
    """The method that solved the levels of an adapted mesh."""
    degree = LEVEL_OF_DEGREE.search(row.mesh)
    return (row.context or {}).get("adapt_by") or (f"HYBRID:k={degree[1]}" if degree else "HYBRID")


def scene_of(rows: list[Row]) -> str:
    """The scene of figures that show only one."""
    scenes = sorted({row.scene for row in rows})
    return "default" if "default" in scenes else scenes[0]


def of_scene(rows: list[Row]) -> list[Row]:
    scene = scene_of(rows) if rows else ""
    return [row for row in rows if row.scene == scene]


def of_mesh(rows: list[Row]) -> list[Row]:
    """Rows whose error_discretisation is that of mesh and scene: of the lowest degree, and not of other
    programs, which have their own."""
    known = [row for row in rows if row.error_discretisation and not row.program]
    lowest = min((row.degree for row in known), default=1)
    return [row for row in known if row.degree == lowest]


def tier(row: Row) -> int:
    """0: in the paper, 1: a method with its own name, or another program, 2: a variant, 3: a preconditioner."""
    return 0 if row.in_paper else 1 if ":" not in row.method or row.method == row.family else 3 if row.preconditioner else 2


def compared(rows: list[Row], room: int) -> list[Row]:
    """Of the paper's methods and those with their own names; of variants, and then of
    preconditioners, if the methods are then at most `room`. A method under two names, an alias
    and the general one, is there once for each mesh, scene and stop: by its alias."""
    tiers: dict[str, int] = {}
    for row in rows:
        tiers[row.general_name] = min(tier(row), tiers.get(row.general_name, 9))
    shown: set[str] = set()
    for level in range(4):
        more = {method for method, own in tiers.items() if own == level}
        if level > 1 and len(shown | more) > room:
            break
        shown |= more
    once: dict[tuple[str, ...], Row] = {}
    for row in rows:
        case = (row.general_name, row.mesh, row.scene, row.stop)
        if row.general_name in shown and (case not in once or row.method != row.general_name):
            once[case] = row
    return list(once.values())


def given(row: Row) -> tuple[float, float] | None:
    """r and rho in the method's name; None: they are not given, or not numbers."""
    found = GIVEN.search(row.method)
    try:
        return (float(found[1]), float(found[2])) if found else None
    except ValueError:
        return None


def is_paper_stop(row: Row) -> bool:
    """A point of an error study that the paper's stop ended."""
    return row.iterative and row.stop == "paper"


def front(rows: list[Row], cost: Callable[[Row], float], error: Callable[[Row], float]) -> list[Row]:
    """The Pareto front, the cheapest first."""
    found: list[Row] = []
    for row in sorted(rows, key=lambda row: (cost(row), error(row))):
        if not found or error(row) < error(found[-1]):
            found.append(row)
    return found


def sharing_axes(rows: list[Row]) -> list[list[Row]]:
    """The rows of each axes over n_phi, which bodies share if their sizes do not overlap."""
    shared: list[list[Row]] = []
    for own in by_body(rows).values():
        low, high = min(row.n_phi for row in own), max(row.n_phi for row in own)
        group = next((group for group in shared if all(
            max(row.n_phi for row in other) < low or min(row.n_phi for row in other) > high
            for other in by_body(group).values())), None)
        if group is None:
            shared.append(own)
        else:
            group += own
    return shared


def order(row: Row) -> tuple[float, str]:
    return row.look.rank, row.method


def by_method(rows: list[Row], x: str) -> dict[str, list[Row]]:
    return grouped(sorted(rows, key=lambda row: (order(row), getattr(row, x))),
                   lambda row: row.method)


def value_of(row: Row, key: str) -> float | None:
    """As figures show it: memory in MiB."""
    value = getattr(row, key)
    return value / 2**20 if value and key in ("peak_heap_bytes", "peak_rss_bytes") else value


def show_seconds(time_s: float) -> str:
    """12.3 ms: as bench prints it."""
    return f"{time_s * 1e6:.3g} µs" if time_s < 1e-3 else f"{time_s * 1e3:.3g} ms" if time_s < 1 else f"{time_s:.3g} s"


def line_of(rows: list[Row], x: str, y: str) -> tuple[list[float], list[float]]:
    return [value_of(row, x) for row in rows], [value_of(row, y) for row in rows]


def exponent(x: list[float], y: list[float], least: int = 3) -> float | None:
    """p of the power law y ~ x^p by least squares of logarithms; needs `least` points."""
    if len(y) < least or len(set(x)) < 2:
        return None
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])
