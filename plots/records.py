"""The fields of records, and the reader of results.csv and records.jsonl.

A value that its key does not allow is refused in one line: file, line, key, value, what is allowed.
"""
import csv
import gzip
import json
import math
import re
import zlib
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, make_dataclass, replace
from itertools import count
from pathlib import Path

import pandas as pd

from case_names import case_of_older
from catalogue import Look, with_bodies, with_looks

LONGEST_LINE, LONGEST_FILE = 2**24, 2**30  # characters; a file as in bench/records/record_reader.hpp
LONGEST_SHOWN = 200  # of a value in a message
SMALLEST, LARGEST = 1e-250, 1e250  # sizes of numbers other than 0
# From bench/records/record_fields.def; results/README.md explains them.
FIELDS: dict[str, dict] = {field["name"]: field for field in json.loads(
    Path(__file__).with_name("record_fields.json").read_text(encoding="utf-8"))}


def words_of(name: str) -> tuple[str, ...]:
    """That a field takes; empty: any."""
    return tuple(FIELDS[name].get("words", ()))


STATUSES, OUTCOMES, STOPS = map(words_of, ("status", "outcome", "stop"))
CONTACT_SOLVERS, OWNERS = map(words_of, ("contact_solver", "memory_by_owner"))
COMPLETED = STATUSES[:3]  # has_answer() of support/status.hpp
VERIFIED = ("", "ok", "other_solution")  # outcomes of an ok case that count as solved
# Records of 2.0 have no points; their studies had these names.
POINTS_OF_OLDER = {"error": "accuracy", "contact": "contact", "scaling": "threads"}


class RecordsError(Exception):
    """Names file, line, key and value, and what is allowed."""


@dataclass(frozen=True)
class Kind:
    allowed: str                            # in words
    accepts: Callable[[object], bool]       # of a value that is there
    of_text: Callable[[str], object] = str  # the value of a cell; the cell itself if it has none
    empty: object = ""                      # the value of an empty cell or a missing key
    may_be_empty: bool = True

    @property
    def words(self) -> str:
        return self.allowed + ", or empty" * self.may_be_empty


def is_real(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_number(value: object) -> bool:
    """Of a size that axes, their logarithms and their margins can cope with."""
    return is_real(value) and (value == 0 or SMALLEST <= abs(value) <= LARGEST)


def is_text(value: object) -> bool:
    """Of characters: half of one is equal to any other half, for pandas."""
    return isinstance(value, str) and not re.search("[\ud800-\udfff]", value)


def is_split(value: object) -> bool:
    """Owner -> peak_bytes, and counted_bytes or null."""
    return isinstance(value, dict) and all(
        owner in OWNERS and isinstance(own, dict) and isinstance(own.get("peak_bytes"), int)
        and (own.get("counted_bytes") is None or isinstance(own["counted_bytes"], int))
        for owner, own in value.items())


def to_number(cell: str) -> float | str:
    try:
        return float(cell)
    except ValueError:
        return cell


def whole(digits: str) -> int | float:
    """A float if it is too large for numpy's integers; ValueError: too many digits."""
    return int(digits) if abs(int(digits)) < 2**63 else float(digits)


def number(allowed: str, accepts: Callable[[float], bool]) -> Kind:
    return Kind(allowed, lambda value: is_number(value) and accepts(value), to_number, None)


def whole_number(least: int) -> Kind:
    def accepts(value: object) -> bool:
        return isinstance(value, int) and not isinstance(value, bool) and value >= least
    return Kind(f"a whole number, {least} or more", accepts,
                lambda cell: int(cell) if re.fullmatch("[0-9]{1,18}", cell) else cell, None)


def one_of(allowed: tuple[str, ...], may_be_empty: bool = True) -> Kind:
    return Kind("one of " + ", ".join(allowed), allowed.__contains__, may_be_empty=may_be_empty)


TEXT = Kind("a text", is_text)
NAME = Kind("a name", lambda value: is_text(value) and bool(value.strip()), may_be_empty=False)
FLAG = Kind("true or false", lambda value: isinstance(value, bool),
            lambda cell: {"true": True, "false": False}.get(cell, cell), False, False)
COUNT, SIZE = whole_number(0), whole_number(1)
POSITIVE = number("a number above 0", lambda x: x > 0)
NOT_NEGATIVE = number("a number, 0 or more", lambda x: x >= 0)
FINITE = number("a number", lambda x: True)
SHARE = number("a number from 0 to 1", lambda x: 0 <= x <= 1)
TIMES = Kind("a list of numbers above 0", lambda value: isinstance(value, list) and all(
    is_number(time) and time > 0 for time in value), empty=None)
SPLIT = Kind(f"peak_bytes and counted_bytes of {', '.join(OWNERS)}", is_split, empty=None)
HISTORIES = Kind("an object of lists of numbers or null", lambda value: isinstance(value, dict) and all(
    isinstance(own, list) and all(x is None or is_real(x) for x in own) for own in value.values()), empty=None)
WORDS = Kind("an object of texts", lambda value: isinstance(value, dict) and all(
    map(is_text, value.values())), empty=None)
# Of bench/records/record.hpp; figures ask no field of another kind.
KINDS = {"name": NAME, "text": TEXT, "flag": FLAG, "count": COUNT, "size": SIZE, "number": FINITE,
         "amount": NOT_NEGATIVE, "positive": POSITIVE, "fraction": SHARE, "times": TIMES,
         "by_owner": SPLIT, "words_by_word": WORDS, "numbers_by_word": HISTORIES}

# In every row that figures show.
FILLED = ("mesh", "scene", "method", "general_name", "family", "iterative", "in_paper",
          "in_displacements", "stop", "status", "n_phi", "n_f", "n_c", "threads", "repetitions")
# Required by the figures.
NEEDED = (*FILLED, "preconditioner", "status_reason", "time_s", "tuning_s", "peak_heap_bytes",
          "done_fraction", "extrapolated_time_s", "error_force")
KEYS: dict[str, Kind] = {
    name: replace(kind, may_be_empty=name not in FILLED) for name, field in FIELDS.items()
    if (kind := KINDS.get(field["kind"]) or (one_of(words_of(name)) if words_of(name) else None))}
OF_STUDY = {  # also required in rows of a study, by its points; "": of scenes with groups
    "accuracy": ("outcome", "knob", "knob_value", "error_stress",
                             "error_discretisation", "error_total"),
    "contact": ("outcome", "contact_solver"),
    "": ("outcome", "error_stress"),
}
OF_COMPLETED = ("time_s", "n_phi", "repetitions")


class Case:
    @property
    def completed(self) -> bool:
        return self.status in COMPLETED

    @property
    def solved(self) -> bool:
        return self.status == "ok" and self.outcome in VERIFIED and self.time_s is not None

    @property
    def label(self) -> str:
        """HYBRID:k=2 -> 'HYBRID, degree 2', EXTERNAL:mine -> 'mine'."""
        return re.sub(r":k=(\d+)", r", degree \1", self.method.removeprefix("EXTERNAL:"))

    def status_words(self) -> str:
        """'timeout, 12 % done'."""
        text = self.status.replace("_", " ")
        if self.done_fraction is None:
            return text
        percent = 100 * self.done_fraction
        return f"{text}, {percent:.0f}\u00a0% done" if percent >= 1 else \
            f"{text}, {percent:.1g}\u00a0% done"


# One case. None or "" stands for an empty cell or a missing key. `line` (in its file), `body` (that its
# mesh divides) and `look` (of its family) are added.
Row = make_dataclass("Row", [("line", int, 0), *((name, object, kind.empty) for name, kind in
                                                 KEYS.items()),
                             ("body", str, ""), ("look", Look, Look())], bases=(Case,), frozen=True)


def shown(value: object) -> str:
    """In one line, what is too long cut off: as support/shortened.hpp."""
    text = value if isinstance(value, str) else json.dumps(value)
    text = "".join(letter if letter.isprintable() else "?" for letter in text)
    text = text if len(text) <= LONGEST_SHOWN else text[:LONGEST_SHOWN - 1] + "…"
    return f"'{text}'" if isinstance(value, str) else text


def checked(items: list[dict], kinds: dict[str, Kind], needed: Collection[str],
            place: Callable[[int], str], text: bool = False) -> pd.DataFrame:
    """A line per item, a column per kind. text: the items' values are cells of a CSV."""
    for k, item in enumerate(items):
        if not isinstance(item, dict):
            raise RecordsError(f"{place(k)}: {shown(item)}, expected an object")
    columns = {}
    for name, kind in kinds.items():
        columns[name] = column = []
        for k, item in enumerate(items):
            raw = item.get(name)
            there = raw is not None and raw != ""
            value = kind.empty if not there else kind.of_text(raw) if text else raw
            if not (kind.accepts(value) if there else kind.may_be_empty or name not in needed):
                extreme = is_real(value) and 0 < abs(value) < math.inf and not is_number(value)
                allowed = f"0 or {SMALLEST:g} to {LARGEST:g} in size" if extreme else kind.words
                raise RecordsError(f"{place(k)}: {name} is {shown(raw)}, expected {allowed}")
            column.append(value)
    return pd.DataFrame(columns, dtype=object)


def points_of(item: Mapping) -> str:
    """Of a record as it is in its file."""
    return item["points"] or "" if "points" in item else POINTS_OF_OLDER.get(item.get("study"), "")


def is_without_body(item: object) -> bool:
    """A contact problem of bench --problem."""
    return (isinstance(item, dict) and item.get("scene") == "fclib"
            and item.get("n_phi") in (None, "") and item.get("n_c") not in (None, ""))


def read(path: Path, needed: Collection[str] = NEEDED) -> pd.DataFrame:
    """results.csv or records.jsonl, a line per case, with `line`, `body` and `look`. Keys that Row
    does not know are passed over, and so are contact problems, which no figure shows."""
    items, header = read_csv(path, needed) if path.suffix == ".csv" else (read_lines(path), None)
    if not items:
        raise RecordsError(f"{path}: no rows; expected {path.name} of bench")
    lines = [line for line, item in enumerate(items, 1 if header is None else 2)
             if not is_without_body(item)]
    items = [item for item in items if not is_without_body(item)]
    if not items:
        raise RecordsError(f"{path}: only contact problems without a body; expected a body's cases")

    def place(k: int) -> str:
        return f"{path}:{lines[k]}"

    table = checked(items, KEYS, needed, place, text=header is not None)
    table.insert(0, "line", lines)
    table["points"] = list(map(points_of, items))
    for points, names in OF_STUDY.items():
        for k in table.index[(table.points == points) & (table.study != "") & ((table.scene_group != "") | (points != ""))]:
            for name in names:
                if header and name not in header:
                    raise RecordsError(f"{path}:1: no column {name}; the {table.study[k]} study of "
                                       f"line {table.line[k]} needs it")
                if name == "outcome" and not table[name][k]:
                    raise RecordsError(f"{place(k)}: {name} is '', expected a value in the study "
                                       f"'{table.study[k]}'")
    for name in OF_COMPLETED:
        for k in table.index[table.status.isin(COMPLETED) & ~table[name].astype(bool)]:
            if name in needed:
                raise RecordsError(f"{place(k)}: {name} is {shown(items[k].get(name))}, expected a "
                                   f"number above 0, since status is {table.status[k]}")
    table = with_derived(table)
    for k in table.index[table.case_name.duplicated()]:
        first = table.line[(table.case_name == table.case_name[k]).idxmax()]
        raise RecordsError(f"{place(k)}: the case {shown(table.case_name[k])} is that of line {first}; "
                           "expected a row per case")
    return table


def with_derived(table: pd.DataFrame) -> pd.DataFrame:
    """Adds body and look, and what older records lack."""
    general = table.general_name.where(table.general_name != "", table.method)
    family = table.family.where(table.family != "", general.str.partition(":")[0])
    names = [row["case_name"] or case_of_older(row) for row in table.to_dict("records")]
    return with_looks(with_bodies(table.assign(
        general_name=general, family=family, degree=table.degree.where(table.degree.notna(), 1),
        case_name=pd.Series(names, table.index, dtype=object))))


def read_csv(path: Path, needed: Collection[str]) -> tuple[list[dict], list[str]]:
    lines = cells_of(path)
    header = lines[0] if lines else []
    for name in KEYS:
        if header.count(name) > 1 or (lines and name in needed and name not in header):
            raise RecordsError(f"{path}:1: {header.count(name) or 'no'} columns {name}; expected "
                               f"one each of {', '.join(needed)}")
    # A ' before what a spreadsheet would take for a formula is not the text's.
    return [dict(zip(header, [cell.removeprefix("'") for cell in cells]))
            for cells in lines[1:]], header


def cells_of(path: Path) -> list[list[str]]:
    """The lines of a CSV, all with as many cells as the first."""
    lines: list[list[str]] = []
    try:
        for cells in csv.reader(lines_of(path), strict=True):
            lines.append(cells)
            if len(cells) != len(lines[0]):
                raise RecordsError(f"{path}:{len(lines)}: {len(cells)} values, expected "
                                   f"{len(lines[0])} as in line 1")
    except csv.Error as error:
        raise RecordsError(f"{path}: cannot be read: not CSV text: {error}")
    return lines


def read_lines(path: Path) -> list[object]:
    """Without the start of a record, which a run that was ended leaves."""
    return [json_of(line.removesuffix("\n"), f"{path}:{number}")
            for number, line in enumerate(lines_of(path), 1) if line.endswith("\n")]


def text_of(path: Path) -> str:
    return "".join(lines_of(path))


def lines_of(path: Path) -> Iterator[str]:
    """With their line ends; U+2028 is not one. Stops unpacking at the first line that is too long."""
    if path.exists() and not path.is_file():  # opening a pipe would block
        raise RecordsError(f"{path}: is no regular file; expected what bench writes")
    length = 0
    try:
        with (gzip.open if path.suffix == ".gz" else open)(path, "rt", encoding="utf-8") as file:
            for number in count(1):
                line = file.readline(LONGEST_LINE + 1)
                length += len(line)
                if len(line) > LONGEST_LINE or length > LONGEST_FILE:
                    raise RecordsError(f"{path}:{number}: too long; expected at most "
                                       f"{LONGEST_LINE >> 20} MiB in a line, "
                                       f"{LONGEST_FILE >> 30} GiB in a file, unpacked")
                if not line:
                    return
                yield line
    except (gzip.BadGzipFile, EOFError, zlib.error):
        raise RecordsError(f"{path}: cannot be read: not of gzip, or damaged; expected what gzip "
                           "made of records.jsonl")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "not UTF-8"
        raise RecordsError(f"{path}: cannot be read: {reason}; expected what bench writes")


def json_of(text: str, place: str) -> object:
    def refuse(constant: str) -> None:
        raise RecordsError(f"{place}: {constant} is not JSON; expected null")
    try:
        return json.loads(text, parse_constant=refuse, parse_int=whole)
    except json.JSONDecodeError as error:
        at = f"{place}:{error.lineno}" if "\n" in text else place
        raise RecordsError(f"{at}: not JSON: {error.msg}; expected an object")
    except (RecursionError, ValueError) as error:  # also a number of thousands of digits
        why = "nested too deep" if isinstance(error, RecursionError) else "a number too long"
        raise RecordsError(f"{place}: not JSON: {why}; expected an object")


def rows_of(table: pd.DataFrame) -> list[Row]:
    return [Row(**values) for values in table.to_dict("records")]


def lines_file(folder: Path) -> Path | None:
    files = (folder / name for name in ("records.jsonl", "records.jsonl.gz"))
    return next((file for file in files if file.exists()), None)


def read_run(folder: Path, needed: Collection[str] = NEEDED) -> pd.DataFrame:
    """From records.jsonl, else from results.csv."""
    return read(lines_file(folder) or folder / "results.csv", needed)
