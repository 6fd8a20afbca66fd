"""Reads a history, a folder with nights/*.json as `bench track` writes them, and checks it."""
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

import pandas as pd

from records import (FINITE, FLAG, KEYS, NAME, TEXT, Kind, RecordsError, checked, is_text, json_of,
                     one_of, text_of)

FORMAT = "airybench-night-1"
OF_A_CASE = ("mesh", "scene", "method", "status")  # what the page does not do without


@dataclass(frozen=True)
class Night:
    date: str                  # ISO 8601
    context: dict[str, str]    # where and with what
    noise: dict                # median_s, mad_s of the same kernel, night by night
    cases: pd.DataFrame        # as of records.jsonl
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


def is_date(value: object) -> bool:
    try:
        return is_text(value) and bool(moment(value))
    except ValueError:
        return False


def instance(kind: type, allowed: str) -> Kind:
    return Kind(allowed, lambda value: isinstance(value, kind), empty=None, may_be_empty=False)


DATE = Kind("a date in ISO 8601", is_date, may_be_empty=False)
VERDICT = {"case": NAME, "lane": one_of(("counters", "errors", "times", "status"), False),
           "quantity": NAME, "kind": one_of(("worse", "better", "changed"), False), "since": DATE,
           "sentence": TEXT}
NIGHT = {"date": DATE, "context": instance(dict, "an object of texts"),
         "noise": instance(dict, "an object"), "cases": instance(list, "a list"),
         "verdicts": instance(list, "a list"), "failed": FLAG, "times_judged": FLAG}


def read_history(folder: Path) -> list[Night]:
    """The nights by date, one at least; throws RecordsError."""
    files = sorted((folder / "nights").glob("*.json"))
    if not files:
        raise RecordsError(f"{folder / 'nights'}: no *.json; expected what bench track writes")
    return sorted(map(read_night, files), key=lambda night: moment(night.date))


def read_night(file: Path) -> Night:
    night = json_of(text_of(file), str(file))
    if not isinstance(night, dict) or night.get("format") != FORMAT:
        raise RecordsError(f"{file}: not a night; expected an object with format {FORMAT}")
    night = {"noise": {}, "verdicts": [], "times_judged": True} | night

    def of(items: str = "") -> Callable[[int], str]:
        return lambda k: f"{file}: {items}[{k}]" if items else str(file)

    checked([night], NIGHT, NIGHT, of())
    context, noise = night["context"], night["noise"]
    checked([context], dict.fromkeys(context, TEXT), context, of())
    checked([noise], dict.fromkeys(("median_s", "mad_s"), FINITE), (), of())
    verdicts = checked(night["verdicts"], VERDICT, VERDICT, of("verdicts"))
    cases = checked(night["cases"], KEYS, OF_A_CASE, of("cases"))
    return Night(night["date"], context, noise, cases, verdicts.to_dict("records"),
                 night["failed"], night["times_judged"])
