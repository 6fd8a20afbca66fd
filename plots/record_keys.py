"""The keys of a record, with their types and what they may be; results/README.md says what each is.

A key that figures use stands once, in Row; numbers that are only shown are bench's own list.
"""
from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import dataclass, field, fields
from pathlib import Path

from looks import Look

STATUSES = ("ok", "inaccurate", "unstressed", "not_converged", "breakdown", "timeout",
            "out_of_memory", "crashed", "machine_fault", "skipped")
COMPLETED = STATUSES[:3]
OUTCOMES = ("ok", "other_solution", *STATUSES[1:5], "unverified", "wrong_success", *STATUSES[5:])
STOPS = ("target", "paper")
# bench/plan/study.hpp: a study is a file.
STUDIES = tuple(sorted(file.stem for file in
                       (Path(__file__).resolve().parents[1] / "bench/scenes").glob("*.json")))
CONTACT_SOLVERS = ("newton", "gauss-seidel", "anderson", "admm")
# As in memory_by_owner, from what every method has to what few have.
OWNERS = ("blocks", "system_matrix", "factor", "preconditioner", "intermediate", "condensed",
          "iteration", "answer", "check", "other")


@dataclass(frozen=True)
class Kind:
    """Of a key's values."""

    allowed: str                            # in words
    accepts: Callable[[object], bool]       # of a value that is there
    of_text: Callable[[str], object] = str  # the value of a cell; the cell itself: it is none
    empty: object = ""                      # stands for a value that is not there
    may_be_empty: bool = False

    @property
    def words(self) -> str:
        return self.allowed + ", or empty" * self.may_be_empty


def is_number(value: object) -> bool:
    """Finite, and not too large for a floating-point number."""
    return (isinstance(value, (int, float)) and not isinstance(value, bool)
            and abs(value) <= sys.float_info.max)


def is_count(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def is_times(value: object) -> bool:
    return isinstance(value, list) and all(is_number(time) and time > 0 for time in value)


def is_text(value: object) -> bool:
    return isinstance(value, str)


def to_number(cell: str) -> float | str:
    try:
        return float(cell)
    except ValueError:
        return cell


def number(allowed: str, accepts: Callable[[float], bool]) -> Kind:
    return Kind(allowed, lambda value: is_number(value) and accepts(value), to_number, None, True)


def words(allowed: tuple[str, ...], may_be_empty: bool = False) -> Kind:
    return Kind("one of " + ", ".join(allowed), allowed.__contains__, may_be_empty=may_be_empty)


def is_split(value: object) -> bool:
    """Owner -> peak_bytes, and counted_bytes or null."""
    return isinstance(value, dict) and all(
        owner in OWNERS and isinstance(own, dict) and isinstance(own.get("peak_bytes"), int)
        and (own.get("counted_bytes") is None or isinstance(own["counted_bytes"], int))
        for owner, own in value.items())


TEXT = Kind("a text", is_text, may_be_empty=True)
NAME = Kind("a name", lambda value: is_text(value) and bool(value.strip()))
FLAG = Kind("true or false", lambda value: isinstance(value, bool),
            lambda cell: {"true": True, "false": False}.get(cell, cell), False)
COUNT = Kind("a whole number, 0 or more", is_count,
             lambda cell: int(cell) if cell.isascii() and cell.isdigit() else cell, None)
POSITIVE = number("a number above 0", lambda x: x > 0)
NOT_NEGATIVE = number("a number, 0 or more", lambda x: x >= 0)
FINITE = number("a number", lambda x: True)
SHARE = number("a number from 0 to 1", lambda x: 0 <= x <= 1)
TIMES = Kind("a list of numbers above 0", is_times, empty=None, may_be_empty=True)
SPLIT = Kind(f"peak_bytes and counted_bytes of {', '.join(OWNERS)}", is_split, empty=None,
             may_be_empty=True)

WORDS = Kind("an object of texts", lambda value: isinstance(value, dict) and all(
    map(is_text, value.values())), empty=None, may_be_empty=True)


def key(kind: Kind, needed: bool = False) -> object:
    """needed: figures do without none of these."""
    return field(default=kind.empty, metadata={"kind": kind, "needed": needed})


@dataclass(frozen=True)
class Row:
    """One case. None, or no text: an empty cell, or a key that its record does not have."""

    line: int = 0
    mesh: str = key(NAME, needed=True)
    scene: str = key(NAME, needed=True)
    method: str = key(NAME, needed=True)          # as it was asked for
    general_name: str = key(NAME, needed=True)    # the same for all names of a method
    family: str = key(NAME, needed=True)
    preconditioner: str = key(TEXT, needed=True)
    program: str = key(TEXT)                      # another's, with its version; empty: ours
    iterative: bool = key(FLAG, needed=True)      # it has a stop to choose
    in_paper: bool = key(FLAG, needed=True)
    in_displacements: bool = key(FLAG, needed=True)  # another discrete problem
    area_mm2: float | None = key(POSITIVE)        # these four tell bodies apart
    contact_length_mm: float | None = key(NOT_NEGATIVE)
    width_mm: float | None = key(POSITIVE)
    height_mm: float | None = key(POSITIVE)
    stop: str = key(words(STOPS), needed=True)
    contact_solver: str = key(words(CONTACT_SOLVERS, may_be_empty=True))
    status: str = key(words(STATUSES), needed=True)
    status_reason: str = key(TEXT, needed=True)
    n_phi: int = key(COUNT, needed=True)
    n_f: int = key(COUNT, needed=True)
    n_c: int = key(COUNT, needed=True)
    threads: int = key(COUNT, needed=True)
    repetitions: int = key(COUNT, needed=True)
    time_s: float | None = key(POSITIVE, needed=True)
    time_mad_s: float | None = key(NOT_NEGATIVE)
    samples_s: list[float] | None = key(TIMES)    # of time_s, every timed run; in records.jsonl only
    precision: float | None = key(SHARE)          # that repetitions went on for …
    precision_reached: bool = key(FLAG)           # … and whether they got there
    load_steps: int | None = key(COUNT)
    time_once_s: float | None = key(NOT_NEGATIVE)     # of time_s, for the body …
    time_per_load_s: float | None = key(NOT_NEGATIVE)  # … and for each load step
    assembly_s: float | None = key(NOT_NEGATIVE)
    stage_contact_s: float | None = key(NOT_NEGATIVE)
    stage_check_s: float | None = key(NOT_NEGATIVE)
    noise_kernel_s: float | None = key(POSITIVE)  # a loop that is always the same, beside the case …
    busy_kernel_s: float | None = key(POSITIVE)   # … and on all threads at once
    noise_kernel_samples_s: list[float] | None = key(TIMES)  # in records.jsonl only, as samples_s
    retry_noisy: float | None = key(SHARE)        # with more noise than that the case was measured again
    noise_share: float | None = key(NOT_NEGATIVE)  # beside the attempt that was kept …
    noise_attempts: int | None = key(COUNT)       # … of so many …
    noisy: bool = key(FLAG)                       # … none of which was quiet
    tuning_s: float | None = key(NOT_NEGATIVE, needed=True)
    tuning_budget_s: float | None = key(NOT_NEGATIVE)
    tuning_cut: bool = key(FLAG)                  # the search ended for lack of time
    peak_heap_bytes: float | None = key(POSITIVE, needed=True)
    peak_rss_bytes: float | None = key(POSITIVE)
    memory_count_ratio: float | None = key(NOT_NEGATIVE)
    memory_by_owner: dict | None = key(SPLIT)
    memory_counts_differ: bool = key(FLAG)
    contact_iterations: float | None = key(NOT_NEGATIVE)
    newton_steps: float | None = key(NOT_NEGATIVE)
    linear_iterations: float | None = key(NOT_NEGATIVE)
    uzawa_iterations: float | None = key(NOT_NEGATIVE)
    parameters: str = key(TEXT)                   # chosen: r=20, rho=20
    done_fraction: float | None = key(SHARE, needed=True)           # timeout only
    extrapolated_time_s: float | None = key(POSITIVE, needed=True)  # timeout only
    target_error: float | None = key(POSITIVE)
    error_stress: float | None = key(NOT_NEGATIVE)
    error_force: float | None = key(NOT_NEGATIVE, needed=True)
    error_estimate: float | None = key(NOT_NEGATIVE)  # its own
    reference_error: float | None = key(NOT_NEGATIVE)
    error_discretisation: float | None = key(NOT_NEGATIVE)  # relative, of mesh and scene
    error_total: float | None = key(NOT_NEGATIVE)
    adapt_level: int | None = key(COUNT)          # of an adaptive loop; None: the mesh as it is
    adapt_time_s: float | None = key(POSITIVE)    # of the loop up to this level
    condition_estimate: float | None = key(NOT_NEGATIVE)  # of what the method factorises
    lower_bound_Nmm: float | None = key(FINITE)
    upper_bound_Nmm: float | None = key(FINITE)
    study: str = key(words(STUDIES, may_be_empty=True))
    outcome: str = key(words(OUTCOMES, may_be_empty=True))
    claimed_status: str = key(words(STATUSES, may_be_empty=True))
    scene_group: str = key(TEXT)
    knob: str = key(TEXT)  # what an error study turned; empty: nothing, this is the one point
    knob_value: float | None = key(NOT_NEGATIVE)
    context: dict | None = key(WORDS)  # where and with what; in records.jsonl only
    body: str = ""         # that the mesh divides; from the keys above
    look: Look = Look()    # of its family

    @property
    def completed(self) -> bool:
        return self.status in COMPLETED

    def status_words(self) -> str:
        """'timeout, 12 % done'."""
        text = self.status.replace("_", " ")
        if self.done_fraction is None:
            return text
        percent = 100 * self.done_fraction
        return f"{text}, {percent:.0f}\u00a0% done" if percent >= 1 else \
            f"{text}, {percent:.1g}\u00a0% done"


# As bench lists them (bench/records/record_fields.def).
FIELDS: list[dict] = json.loads(
    Path(__file__).with_name("record_fields.json").read_text(encoding="utf-8"))
# Those that are shown or quoted as they are: a label or a unit, and no type of their own in Row.
NUMBERS = [f["name"] for f in FIELDS if not isinstance(f["empty"], list)
           and (f["label"] or (f["unit"] and (f["nightly"] or f["column"])))]
OF_ROW: dict[str, Kind] = {f.name: f.metadata["kind"] for f in fields(Row) if f.metadata}
KEYS = OF_ROW | {name: FINITE for name in NUMBERS if name not in OF_ROW}
NEEDED = tuple(f.name for f in fields(Row) if f.metadata.get("needed"))
