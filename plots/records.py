"""The one reader of records: results.csv, records.jsonl, and what a history is made of.

What does not fit its key (record_keys.py) is refused in one line: file, line, key, value, and what
is allowed.
"""
from __future__ import annotations

import csv
import gzip
import io
import json
import zlib
from collections.abc import Callable, Collection
from dataclasses import fields
from pathlib import Path

import pandas as pd

from bodies import with_bodies
from looks import with_looks
from record_keys import COMPLETED, KEYS, NEEDED, Kind, Row

IDENTITY = ["mesh", "scene", "method", "stop", "contact_solver", "study", "knob",
            "knob_value"]  # of a case
OF_STUDY = {  # what the rows of a study need beside
    "error": ("outcome", "knob", "knob_value", "error_stress", "error_discretisation",
              "error_total"),
    "contact": ("outcome", "contact_solver"),
    "stability": ("outcome", "scene_group", "error_stress"),
}
NEVER_EMPTY = ("outcome", "scene_group")       # in a study that needs them
OF_COMPLETED = ("time_s", "n_phi", "repetitions")


class RecordsError(Exception):
    """Names file, line, key and value, and what is allowed."""


def shown(value: object) -> str:
    return f"'{value}'" if isinstance(value, str) else json.dumps(value)


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
                raise RecordsError(f"{place(k)}: {name} is {shown(raw)}, expected {kind.words}")
            column.append(value)
    return pd.DataFrame(columns, dtype=object)


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
    for study, names in OF_STUDY.items():
        for k in table.index[table.study == study]:
            missing = [name for name in names if header and name not in header]
            if missing:
                raise RecordsError(f"{path}:1: no column {missing[0]}; the {study} study of line "
                                   f"{table.line[k]} needs it")
            for name in NEVER_EMPTY:
                if name in names and not table[name][k]:
                    raise RecordsError(f"{place(k)}: {name} is '', expected a value in the study "
                                       f"'{study}'")
    for name in OF_COMPLETED:
        for k in table.index[table.status.isin(COMPLETED) & ~table[name].astype(bool)]:
            if name in needed:
                raise RecordsError(f"{place(k)}: {name} is {shown(items[k].get(name))}, expected a "
                                   f"number above 0, since status is {table.status[k]}")
    for k in table.index[table.duplicated(IDENTITY)]:
        case = [value for value in table.loc[k, IDENTITY] if value not in ("", None)]
        same = table[IDENTITY].astype(str).eq(table.loc[k, IDENTITY].astype(str)).all(axis=1)
        raise RecordsError(f"{place(k)}: the case '{', '.join(map(str, case))}' is that of line "
                           f"{table.line[same.idxmax()]}; expected a row per case")
    return with_derived(table)


def with_derived(table: pd.DataFrame) -> pd.DataFrame:
    """With what follows from other keys; records of before have no general_name and no family."""
    general = table.general_name.where(table.general_name != "", table.method)
    family = table.family.where(table.family != "", general.str.partition(":")[0])
    return with_looks(with_bodies(table.assign(general_name=general, family=family)))


def read_csv(path: Path, needed: Collection[str]) -> tuple[list[dict], list[str]]:
    """Rows as texts, and the header."""
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
    """Of a CSV, line by line; as many in each as in the first."""
    try:
        lines = list(csv.reader(io.StringIO(text_of(path)), strict=True))
    except csv.Error as error:
        raise RecordsError(f"{path}: cannot be read: not CSV text: {error}")
    for line, cells in enumerate(lines, 1):
        if len(cells) != len(lines[0]):
            raise RecordsError(f"{path}:{line}: {len(cells)} values, expected {len(lines[0])} as "
                               "in line 1")
    return lines


def read_lines(path: Path) -> list[object]:
    """A JSON value per line."""
    text = text_of(path)
    lines = text.removesuffix("\n").split("\n") if text else []  # U+2028 ends none
    return [json_of(words, f"{path}:{line}") for line, words in enumerate(lines, 1)]


def text_of(path: Path) -> str:
    if path.exists() and not path.is_file():  # a pipe would be waited for
        raise RecordsError(f"{path}: is no regular file; expected what bench writes")
    try:
        with (gzip.open if path.suffix == ".gz" else open)(path, "rt", encoding="utf-8") as file:
            return file.read()
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
        return json.loads(text, parse_constant=refuse)
    except json.JSONDecodeError as error:
        at = f"{place}:{error.lineno}" if "\n" in text else place
        raise RecordsError(f"{at}: not JSON: {error.msg}; expected an object")
    except (RecursionError, ValueError) as error:  # also a number of thousands of digits
        why = "nested too deep" if isinstance(error, RecursionError) else "a number too long"
        raise RecordsError(f"{place}: not JSON: {why}; expected an object")


def rows_of(table: pd.DataFrame) -> list[Row]:
    own = [field.name for field in fields(Row)]
    return [Row(**values) for values in table[own].to_dict("records")]


def lines_file(folder: Path) -> Path | None:
    """records.jsonl, or what gzip made of it, where one is there."""
    files = (folder / name for name in ("records.jsonl", "records.jsonl.gz"))
    return next((file for file in files if file.exists()), None)


def read_run(folder: Path, needed: Collection[str] = NEEDED) -> pd.DataFrame:
    """Its records, a line each; where these are not, the flat view of them."""
    return read(lines_file(folder) or folder / "results.csv", needed)
