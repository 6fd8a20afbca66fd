"""Reads results.csv as `bench` writes it (results/README.md), and checks what the figures need."""
from __future__ import annotations

import csv
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

STOPS = ("target", "paper")
STATUSES = ("ok", "inaccurate", "not_converged", "breakdown", "timeout", "out_of_memory", "crashed",
            "skipped")
OUTCOMES = (*STATUSES[:4], "unverified", "wrong_success", *STATUSES[4:])
STUDIES = ("", "error", "stability")


class ResultsError(Exception):
    """Names file, line, column and value, and what is allowed."""


@dataclass(frozen=True)
class Row:
    """One case. None: an empty cell."""

    line: int
    mesh: str
    scene: str
    method: str  # as it was asked for
    stop: str    # of STOPS
    status: str  # of STATUSES
    status_reason: str
    n_phi: int
    n_f: int
    n_c: int
    threads: int
    repetitions: int
    time_s: float | None
    peak_heap_bytes: float | None
    error_force: float | None
    tuning_s: float | None
    done_fraction: float | None        # timeout only
    extrapolated_time_s: float | None  # timeout only
    # What follows is empty also where there is no such column.
    target_error: float | None
    study: str = ""    # of STUDIES
    outcome: str = ""  # of OUTCOMES
    scene_group: str = ""
    knob: str = ""     # what an error study turned; empty: nothing, this is the method's one point
    knob_value: float | None = None
    error_stress: float | None = None
    error_discretisation: float | None = None  # relative, of mesh and scene
    error_total: float | None = None
    uzawa_iterations: float | None = None
    lower_bound_Nmm: float | None = None
    upper_bound_Nmm: float | None = None
    time_mad_s: float | None = None
    parameters: str = ""  # chosen: r=20, rho=20
    assembly_s: float | None = None
    stage_contact_s: float | None = None
    stage_check_s: float | None = None
    linear_iterations: float | None = None
    memory_count_ratio: float | None = None

    @property
    def completed(self) -> bool:
        return self.status in ("ok", "inaccurate")

    def status_words(self) -> str:
        """'timeout, 12 % done'."""
        text = self.status.replace("_", " ")
        if self.done_fraction is None:
            return text
        percent = 100 * self.done_fraction
        return f"{text}, {percent:.0f}\u00a0% done" if percent >= 1 else \
            f"{text}, {percent:.1g}\u00a0% done"


def scene_of(rows: list) -> str:
    """The scene to draw where there is room for one."""
    scenes = sorted({row.scene for row in rows})
    return "default" if "default" in scenes else scenes[0]


def text(cell: str) -> str:
    return cell


def name(cell: str) -> str:
    if not cell.strip():
        raise ValueError("a name")
    return cell


def one_of(words: tuple[str, ...]) -> Callable[[str], str]:
    def parse(cell: str) -> str:
        if cell not in words:
            raise ValueError("one of " + ", ".join(word or "(empty)" for word in words))
        return cell
    return parse


def count(cell: str) -> int:
    if not (cell.isascii() and cell.isdigit()):
        raise ValueError("a whole number, 0 or more")
    return int(cell)


def number(allowed: str, accept: Callable[[float], bool]) -> Callable[[str], float | None]:
    def parse(cell: str) -> float | None:
        if not cell:
            return None
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and accept(value)):
            raise ValueError(f"{allowed}, or empty")
        return value
    return parse


positive = number("a number above 0", lambda x: x > 0)
not_negative = number("a number, 0 or more", lambda x: x >= 0)
finite = number("a number", lambda x: True)
COLUMNS: dict[str, Callable] = {
    "mesh": name, "scene": name, "method": name, "stop": one_of(STOPS), "status": one_of(STATUSES),
    "status_reason": text, "n_phi": count, "n_f": count, "n_c": count, "threads": count,
    "repetitions": count, "time_s": positive, "peak_heap_bytes": positive,
    "error_force": not_negative, "tuning_s": not_negative,
    "done_fraction": number("a number from 0 to 1", lambda x: 0 <= x <= 1),
    "extrapolated_time_s": positive,
}
STUDY_COLUMNS = {  # what the rows of a study need beside COLUMNS
    "error": ("outcome", "knob", "knob_value", "error_stress", "error_discretisation",
              "error_total"),
    "stability": ("outcome", "scene_group", "error_stress"),
}
NEVER_EMPTY = {"outcome", "scene_group"}  # in the rows of a study that needs them
OPTIONAL = {"target_error": positive, "study": one_of(STUDIES), "outcome": one_of(("", *OUTCOMES)),
            "scene_group": text, "knob": text, "knob_value": not_negative,
            "error_stress": not_negative, "error_discretisation": not_negative,
            "error_total": not_negative, "uzawa_iterations": not_negative,
            "lower_bound_Nmm": finite, "upper_bound_Nmm": finite, "time_mad_s": not_negative,
            "parameters": text,
            "assembly_s": not_negative, "stage_contact_s": not_negative,
            "stage_check_s": not_negative, "linear_iterations": not_negative,
            "memory_count_ratio": not_negative}


def read_results(path: Path) -> list[Row]:
    """The rows in their order; throws ResultsError. Further columns are passed over."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            reader = csv.reader(file, strict=True)
            lines = [(reader.line_num, cells) for cells in reader]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or f"not CSV text: {error}"
        raise ResultsError(f"{path}: cannot be read: {reason}; expected results.csv of bench")
    if len(lines) < 2:
        raise ResultsError(f"{path}: no rows; expected results.csv of bench")
    header = lines[0][1]
    for column in COLUMNS:
        if header.count(column) != 1:
            raise ResultsError(f"{path}:1: {header.count(column) or 'no'} columns {column}; "
                               f"expected one each of {', '.join(COLUMNS)}")
    rows, line_of = [], {}
    for line, cells in lines[1:]:
        row = read_row(f"{path}:{line}", line, header, cells)
        case = (row.mesh, row.scene, row.method, row.stop)
        key = (*case, row.study, row.knob, row.knob_value)
        if key in line_of:
            raise ResultsError(f"{path}:{line}: mesh, scene, method, stop"
                               f"{', knob_value' if row.study else ''} are '{', '.join(case)}"
                               f"{f', {row.knob_value}' if row.study else ''}' as in line "
                               f"{line_of[key]}; expected a row per case")
        line_of[key] = line
        rows.append(row)
    return rows


def read_row(place: str, line: int, header: list[str], cells: list[str]) -> Row:
    if len(cells) != len(header):
        raise ResultsError(f"{place}: {len(cells)} values, expected {len(header)} as in line 1")
    values: dict[str, object] = {}
    for column, parse in (COLUMNS | OPTIONAL).items():
        cell = cells[header.index(column)] if column in header else ""
        try:
            values[column] = parse(cell)
        except ValueError as allowed:
            raise ResultsError(f"{place}: {column} is '{cell}', expected {allowed}")
    row = Row(line=line, **values)
    for column in STUDY_COLUMNS.get(row.study, ()):
        if column not in header:
            raise ResultsError(f"{place.rpartition(':')[0]}:1: no column {column}; the "
                               f"{row.study} study of line {line} needs it")
        if column in NEVER_EMPTY and not values[column]:
            raise ResultsError(f"{place}: {column} is '', expected a value in the "
                               f"study '{row.study}'")
    for column in ("time_s", "n_phi", "repetitions"):
        if row.completed and not values[column]:
            raise ResultsError(f"{place}: {column} is '{cells[header.index(column)]}', expected a "
                               f"number above 0, since status is {row.status}")
    return row
