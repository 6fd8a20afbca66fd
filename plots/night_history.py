"""Reads a history, a folder with nights/*.json as `bench track` writes them, and checks it."""
from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

from results_table import STATUSES, STOPS, ResultsError, one_of

FORMAT = "airybench-night-1"
KINDS = ("worse", "better", "changed")
LANES = ("counters", "errors", "times", "status")


@dataclass(frozen=True)
class Night:
    date: str                  # ISO 8601
    context: dict[str, str]    # where and with what
    noise: dict                # median_s, mad_s of the same kernel, night by night
    cases: list[dict]          # as in records.jsonl
    verdicts: list[dict]       # case, lane, quantity, kind, since, sentence
    failed: bool
    times_judged: bool = True  # False: too few nights of this machine

    @property
    def revision(self) -> str:
        return self.context.get("git_revision", "unknown")


def moment(date: str) -> datetime:
    """Dates compare as moments: with and without an offset, which then is UTC."""
    parsed = datetime.fromisoformat(date)
    return parsed if parsed.tzinfo else parsed.replace(tzinfo=timezone.utc)


def read_history(folder: Path) -> list[Night]:
    """The nights by date, one at least; throws ResultsError."""
    files = sorted((folder / "nights").glob("*.json"))
    if not files:
        raise ResultsError(f"{folder / 'nights'}: no *.json; expected what bench track writes")
    nights = [read_night(file) for file in files]
    return sorted(nights, key=lambda night: moment(night.date))


def read_night(file: Path) -> Night:
    night = read_json(file, read_text(file), str(file))
    if not isinstance(night, dict) or night.get("format") != FORMAT:
        raise ResultsError(f"{file}: not a night; expected an object with format {FORMAT}")
    try:
        date = text(night, "date")
        check(night, "date", moment, "a date in ISO 8601")
        context = typed(night, "context", dict, "an object of texts")
        for key in context:
            text(context, key)
        noise = typed(night, "noise", dict, "an object", {})
        for key in ("median_s", "mad_s"):
            number_or_null(noise, key)
        cases = typed(night, "cases", list, "a list")
        verdicts = typed(night, "verdicts", list, "a list", [])
        failed = typed(night, "failed", bool, "true or false")
        times_judged = typed(night, "times_judged", bool, "true or false", True)
    except ValueError as wrong:
        raise ResultsError(f"{file}: {wrong}")
    for what, items, parse in (("cases", cases, check_case), ("verdicts", verdicts, check_verdict)):
        for k, item in enumerate(items):
            try:
                parse(item)
            except ValueError as wrong:
                raise ResultsError(f"{file}: {what}[{k}]: {wrong}")
    return Night(date, context, noise, cases, verdicts, failed, times_judged)


def read_records(file: Path) -> list[dict]:
    """The lines of records.jsonl; throws ResultsError."""
    records = []
    for line, words in enumerate(read_text(file).splitlines(), 1):
        record = read_json(file, words, f"{file}:{line}")
        try:
            check_case(record)
        except ValueError as wrong:
            raise ResultsError(f"{file}:{line}: {wrong}")
        records.append(record)
    return records


def read_text(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ResultsError(f"{file}: cannot be read: "
                           f"{getattr(error, 'strerror', None) or 'not UTF-8'}")


def read_json(file: Path, words: str, place: str) -> object:
    def refuse(constant: str) -> None:
        raise ValueError(f"{constant} is not JSON")
    try:
        return json.loads(words, parse_constant=refuse)
    except json.JSONDecodeError as error:
        if place == str(file):
            place = f"{file}:{error.lineno}"
        raise ResultsError(f"{place}: not JSON: {error.msg}; expected an object")
    except ValueError as error:
        raise ResultsError(f"{place}: {error}; expected null")


def check_case(case: object) -> None:
    if not isinstance(case, dict):
        raise ValueError(f"{json.dumps(case)}, expected an object")
    for key in ("mesh", "scene", "method"):
        text(case, key)
    check(case, "status", one_of(STATUSES), "")
    if case.get("stop") is not None:
        check(case, "stop", one_of(STOPS), "")
    for key, value in case.items():
        if key.endswith(("_s", "_bytes", "_iterations")) and not isinstance(value, list):
            number_or_null(case, key)
    for key in ("error_stress", "error_force", "equilibrium_residual", "instructions"):
        number_or_null(case, key)


def check_verdict(verdict: object) -> None:
    if not isinstance(verdict, dict):
        raise ValueError(f"{json.dumps(verdict)}, expected an object")
    for key in ("case", "quantity", "sentence"):
        text(verdict, key)
    check(verdict, "kind", one_of(KINDS), "")
    check(verdict, "lane", one_of(LANES), "")
    check(verdict, "since", moment, "a date in ISO 8601")


def typed(values: dict, key: str, kind: type, expected: str, default: object = None) -> object:
    value = values.get(key, default)
    if not isinstance(value, kind):
        raise ValueError(f"{key} is {json.dumps(value)}, expected {expected}")
    return value


def text(values: dict, key: str) -> str:
    return typed(values, key, str, "a text")


def check(values: dict, key: str, parse: Callable[[str], object], expected: str) -> None:
    try:
        parse(text(values, key))
    except ValueError as wrong:
        if isinstance(values.get(key), str):
            raise ValueError(f"{key} is '{values[key]}', expected {expected or wrong}")
        raise


def number_or_null(values: dict, key: str) -> None:
    value = values.get(key)
    if value is not None and (isinstance(value, bool) or not isinstance(value, (int, float))):
        raise ValueError(f"{key} is {json.dumps(value)}, expected a number or null")
