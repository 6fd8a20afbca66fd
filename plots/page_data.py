"""What the page shows, from the nights of a history: series, marks, the last run, its context."""
from __future__ import annotations

from collections.abc import Iterator

import pandas as pd

from case_names import case_name
from night_history import Night, moment
from records import with_derived

# Key, name, head of its column in the table, group; the unit is in the key. In the order shown.
QUANTITIES = (
    ("time_s", "time of one solve", "time", "time"),
    ("assembly_s", "assembly of the blocks", "assembly", "time"),
    ("tuning_s", "choosing parameters", "tuning", "time"),
    ("peak_heap_bytes", "peak heap", "heap", "memory"),
    ("peak_rss_bytes", "peak resident set", "resident", "memory"),
    ("storage_bytes", "storage of the matrices", "storage", "memory"),
    ("heap_allocated_bytes", "heap allocated", "allocated", "memory"),
    ("heap_allocations", "heap allocations", "allocations", "memory"),
    ("error_stress", "error of the stresses", "error stress", "error"),
    ("error_force", "error of the contact forces", "error force", "error"),
    ("equilibrium_residual", "equilibrium residual", "equilibrium", "error"),
    ("linear_iterations", "linear iterations", "linear iterations", "work"),
    ("contact_iterations", "contact sweeps", "contact sweeps", "work"),
    ("uzawa_iterations", "Uzawa iterations", "Uzawa iterations", "work"),
    ("factor_entries", "entries of the factors", "factor entries", "work"),
    ("factor_flops", "operations of the factorisation", "factor flops", "work"),
    ("instructions", "instructions", "instructions", "work"),
    ("noise_kernel_s", "noise kernel beside the case", "noise kernel", "time"),
)
# The table's columns, in the order shown.
COLUMNS = (("mesh", "mesh"), ("scene", "scene"), ("method", "method"), ("stop", "stop"),
           ("status", "status"), ("n_phi", "n_phi"), ("time_s", "time"), ("time_mad_s", "±"),
           *((key, head) for key, _, head, _ in QUANTITIES if key != "time_s"))
OF_SERIES = [*(key for key, *_ in QUANTITIES), "time_low_s", "time_high_s"]
OF_A_CASE = ["name", "mesh", "scene", "family", "body"]  # its name, and by what cases are grouped
# Different in every night, so that a difference says nothing.
ALWAYS_NEW = {"date", "host", "load_1min_at_start"}


def page_data(nights: list[Night], records: pd.DataFrame | None) -> dict:
    """JSON for the page's script. records: of the run to list; None: the last night's cases."""
    last, before = nights[-1], nights[-2] if len(nights) > 1 else None
    cases = named(pd.concat([night.cases.assign(night=k) for k, night in enumerate(nights)],
                            ignore_index=True))
    run = cases[cases.night == len(nights) - 1] if records is None else named(records)
    bodies = list(dict.fromkeys(cases.sort_values("n_phi", kind="stable").body))
    return {
        "nights": [{"date": night.date, "revision": night.revision, "failed": night.failed}
                   for night in nights],
        "noise": {key: [night.noise.get(key) for night in nights] for key in ("median_s", "mad_s")},
        "bodies": bodies,
        "cases": sorted(series(cases, len(nights)), key=lambda case: (
            bodies.index(case["body"]), case["mesh"], case["scene"])),
        "quantities": [{"key": key, "name": name, "group": group}
                       for key, name, _, group in QUANTITIES if cases[key].notna().any()],
        "marks": marks(nights),
        "last": {"failed": last.failed, "times_judged": last.times_judged,
                 "verdicts": last.verdicts, "statuses": list(last.cases.status)},
        "columns": [{"key": key, "name": head} for key, head in COLUMNS
                    if run[key].map(is_there).any()],
        "rows": [{key: value for key, value in row.items() if is_there(value)}
                 for row in run[list(dict.fromkeys((*OF_A_CASE, *dict(COLUMNS), "status_reason")))]
                 .to_dict("records")],
        "context": environment(last, before),
    }


def named(cases: pd.DataFrame) -> pd.DataFrame:
    """With the name of each case, and what follows from the others."""
    cases = with_derived(cases)
    return cases.assign(name=[case_name(case) for case in cases.to_dict("records")])


def is_there(value: object) -> bool:
    return value is not None and value != ""


def series(cases: pd.DataFrame, nights: int) -> Iterator[dict]:
    """Per case a list over the nights for every quantity that it ever had; None: no value."""
    for name, own in cases.groupby("name", sort=False):
        by_night = own.drop_duplicates("night", keep="last").set_index("night") \
            .reindex(range(nights)).astype(object)
        by_night = by_night.where(by_night.notna(), None)
        yield own.iloc[-1][OF_A_CASE].to_dict() | {
            "method": name.split("/", 2)[2], "status": list(by_night.status),
            "values": {key: list(by_night[key]) for key in OF_SERIES
                       if by_night[key].notna().any()}}


def marks(nights: list[Night]) -> list[dict]:
    """Every change once, as the latest night that tells of it has it, with its night's number."""
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
