#!/usr/bin/python3
"""Makes one self-contained HTML page from a run, or from a history of nights.

    page.py RESULTS [--out=page.html]
    page.py HISTORY [RESULTS] [--out=page.html]

RESULTS  folder of one run: its cases in a table, error against time, and the pictures in its figures/
HISTORY  folder with nights/*.json, as `bench track` writes them; without RESULTS the cases are those of the
         last night

The page fetches nothing. Exit 2: wrong input, or a file that cannot be written; one line says which,
and the page that was there stays.
"""
import argparse
import base64
import hashlib
import html
import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

import pandas as pd

import command
from messages import escaped
from records import (FIELDS, FINITE, FLAG, KEYS, NAME, TEXT, Kind, RecordsError, checked, is_text,
                     json_of, lines_file, one_of, read, text_of, with_derived)

PARTS = Path(__file__).resolve().parent / "page"
SCRIPTS = ("format.js", "chart.js", "table.js", "scatter.js", "page.js")
FORMAT = "airybench-night-1"
OF_A_CASE = ("mesh", "scene", "method", "status")  # required by the page
GROUPS = {"s": "time", "B": "memory", "1": "error"}  # of quantities, by their units; else work
QUANTITIES = {name: field for name, field in FIELDS.items() if field["nightly"] and field["label"]}
# The table's columns, in the order shown: the errors stand next to the time.
COLUMNS = tuple(dict.fromkeys((
    "mesh", "scene", "method", "stop", "status", "n_phi", "time_s", "time_mad_s", "peak_heap_bytes",
    "error_stress", "error_force", "error_total", *QUANTITIES)))
HEADS = {"n_phi": "n_phi", "time_mad_s": "±"}
OF_SERIES = [*QUANTITIES, "time_low_s", "time_high_s"]
GROUPED_BY = ["name", "mesh", "scene", "family", "body"]  # of a case
# They differ from night to night anyway.
ERRORS = ("error_total", "error_force", "error_stress")  # against time
ALWAYS_NEW = {"date", "host", "load_1min_at_start"}


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

    @property
    def machine(self) -> str:
        return ", ".join(self.context.get(key, "") for key in ("cpu", "cpus", "threads"))


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
    files = sorted((folder / "nights").glob("*.json"))
    if not files:
        raise RecordsError(f"{folder / 'nights'}: no *.json; expected what bench track writes, or the records of a run")
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


def page_data(nights: list[Night], records: pd.DataFrame | None) -> dict:
    """JSON for the page's script. nights: none for the page of one run. records: of the run to list; None: the last
    night's cases."""
    cases = named(pd.concat([night.cases.assign(night=k) for k, night in enumerate(nights)], ignore_index=True)) \
        if nights else None
    run = cases[cases.night == len(nights) - 1] if records is None else named(records)
    run = run.assign(colour=[look.colour for look in run.look])
    points = {key: int((run[key].notna() & run.time_s.notna()).sum()) for key in ERRORS}
    return {
        "errors": [name for name in COLUMNS if FIELDS[name]["unit"] == "1"],
        "scatter": sorted(filter(points.get, points), key=points.get, reverse=True),  # most cases first
        "columns": [{"key": key, "name": HEADS.get(key, head_of(key))} for key in COLUMNS
                    if run[key].map(is_there).any()],
        "rows": [{key: value for key, value in row.items() if is_there(value)}
                 for row in run[list(dict.fromkeys((*GROUPED_BY, *COLUMNS, "status_reason", "colour")))]
                 .to_dict("records")],
    } | history_data(nights, cases, run)


def history_data(nights: list[Night], cases: pd.DataFrame | None, run: pd.DataFrame) -> dict:
    """What the page shows night by night, and where it was measured."""
    if not nights:
        context = next(filter(None, run.context), {})
        return {"nights": [], "noise": {"median_s": [], "mad_s": []}, "bodies": [], "cases": [], "quantities": [],
                "marks": [], "context": [{"key": key, "value": value, "differs": False}
                                         for key, value in sorted(context.items())]}
    last, before = nights[-1], nights[-2] if len(nights) > 1 else None
    bodies = list(dict.fromkeys(cases.sort_values("n_phi", kind="stable").body))
    return {
        "nights": [{"date": night.date, "revision": night.revision, "machine": night.machine}
                   for night in nights],
        "noise": {key: [night.noise.get(key) for night in nights] for key in ("median_s", "mad_s")},
        "bodies": bodies,
        "cases": sorted(series(cases, len(nights)), key=lambda case: (
            bodies.index(case["body"]), case["mesh"], case["scene"])),
        "quantities": [{"key": key, "name": field["label"],
                        "group": GROUPS.get(field["unit"], "work")}
                       for key, field in QUANTITIES.items() if cases[key].notna().any()],
        "marks": marks(nights),
        "last": {"failed": last.failed, "times_judged": last.times_judged,
                 "verdicts": last.verdicts, "statuses": list(last.cases.status)},
        "context": environment(last, before),
    }


def head_of(key: str) -> str:
    """peak_heap_bytes -> peak heap."""
    return key.removesuffix("_s").removesuffix("_bytes").replace("_", " ")


def named(cases: pd.DataFrame) -> pd.DataFrame:
    cases = with_derived(cases)
    return cases.assign(name=cases.case_name, time_mad_s=cases.time_mad_s.where(cases.repetitions != 1, None))


def is_there(value: object) -> bool:
    return value is not None and value != ""


def series(cases: pd.DataFrame, nights: int) -> Iterator[dict]:
    """Per case and quantity its values, one per night; None: no value."""
    for name, own in cases.groupby("name", sort=False):
        by_night = own.drop_duplicates("night", keep="last").set_index("night") \
            .reindex(range(nights)).astype(object)
        by_night = by_night.where(by_night.notna(), None)
        yield own.iloc[-1][GROUPED_BY].to_dict() | {
            "method": name.split("/", 2)[2], "status": list(by_night.status),
            "values": {key: list(by_night[key]) for key in OF_SERIES
                       if by_night[key].notna().any()}}


def marks(nights: list[Night]) -> list[dict]:
    """Every change once, as in the latest night that reports it, with the number of its own night."""
    latest = {}
    for night in nights:
        for verdict in night.verdicts:
            name = verdict["case"]
            latest[name, verdict["quantity"], moment(verdict["since"])] = verdict
    found = []
    for (name, _, since), verdict in latest.items():
        after = [k for k, night in enumerate(nights) if moment(night.date) >= since]
        if after:
            found.append({"case": name, "night": after[0]} |
                         {key: verdict[key] for key in ("lane", "quantity", "kind", "since",
                                                        "sentence")})
    return found


def environment(last: Night, before: Night | None) -> list[dict]:
    """Keys of the last two nights; `differs` where the night before had another value."""
    old = before.context if before else last.context
    return [{"key": key, "value": last.context.get(key), "before": old.get(key),
             "differs": key not in ALWAYS_NEW and last.context.get(key) != old.get(key)}
            for key in sorted(last.context.keys() | old.keys())]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", type=Path, metavar="HISTORY|RESULTS", help="a history, or a results folder")
    parser.add_argument("results", type=Path, metavar="RESULTS", nargs="?")
    parser.add_argument("--out", type=Path, default=Path("page.html"))


def make(args: argparse.Namespace) -> None:
    text = page(args.folder, args.results)
    command.replace_all(args.out.parent, {args.out.name: command.text_writer(text)})
    print(args.out)


def records_of(folder: Path) -> Path | None:
    table = folder / "results.csv"
    return lines_file(folder) or (table if table.exists() else None)


def page(folder: Path, results: Path | None) -> str:
    is_run = results is None and not (folder / "nights").is_dir() and records_of(folder) is not None
    nights, results = ([], folder) if is_run else (read_history(folder), results)
    if results and not results.is_dir():
        raise RecordsError(f"{results}: no such folder; expected the --out of bench")
    records = read(file, OF_A_CASE) if results and (file := records_of(results)) else None
    data = json.dumps(page_data(nights, records), ensure_ascii=False, allow_nan=False,
                      separators=(",", ":")).replace("<", "\\u003c")
    data = escaped(data, backslash="\\\\")  # of a string of JSON
    style = part("page.css")
    script = '(() => {\n"use strict";\n' + "\n".join(map(part, SCRIPTS)) + "})();\n"
    fill = {"STYLE": style, "SCRIPT": script, "DATA": data, "STYLE_HASH": hash_of(style),
            "SCRIPT_HASH": hash_of(script), "TITLE": html.escape(f"airybench {nights[-1].date if nights else results.resolve().name}"),
            "FIGURES": figures(results / "figures") if results else ""}
    pieces = part("page.html").split("%%")  # text, name, text, name, ... text
    return "".join(fill[piece] if k % 2 else piece for k, piece in enumerate(pieces))


def part(name: str) -> str:
    return (PARTS / name).read_text(encoding="utf-8")


def hash_of(text: str) -> str:
    """As a content security policy names an inline script or style."""
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def figures(folder: Path) -> str:
    shown = []
    for file in sorted([*folder.glob("*.png"), *folder.glob("*.gif")]):
        name = html.escape(escaped(file.stem.replace("_", " ")))
        words = file.with_suffix(".txt")  # its caption
        about = html.escape(escaped(text_of(words))) if words.is_file() else ""
        image = base64.b64encode(file.read_bytes()).decode()
        shown.append(f'<figure><button type="button" aria-label="enlarge {name}">'
                     f'<img alt="{name}" src="data:image/{file.suffix[1:]};base64,{image}"></button>'
                     f'<figcaption>{f"<details><summary>{name}</summary><p>{about}</p></details>" if about else name}'
                     '</figcaption></figure>')
    return "\n".join(shown)


def main() -> None:
    command.run(__doc__, add_arguments, make, "a file to write")


if __name__ == "__main__":
    main()
