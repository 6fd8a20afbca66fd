"""What the page shows, from the nights of a history: series, marks, the last run, its context."""
from __future__ import annotations

from case_names import case_name
from night_history import Night, moment

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
# Different in every night, so that a difference says nothing.
ALWAYS_NEW = {"date", "host", "load_1min_at_start"}


def page_data(nights: list[Night], records: list[dict] | None) -> dict:
    """JSON for the page's script. records: of the run to list; None: the last night's cases."""
    last, before = nights[-1], nights[-2] if len(nights) > 1 else None
    run = last.cases if records is None else records
    return {
        "nights": [{"date": night.date, "revision": night.revision, "failed": night.failed}
                   for night in nights],
        "noise": {key: [night.noise.get(key) for night in nights] for key in ("median_s", "mad_s")},
        "cases": series(nights),
        "quantities": [{"key": key, "name": name, "group": group}
                       for key, name, _, group in QUANTITIES
                       if any(case.get(key) is not None
                              for night in nights for case in night.cases)],
        "marks": marks(nights),
        "last": {"failed": last.failed, "times_judged": last.times_judged,
                 "verdicts": last.verdicts,
                 "statuses": [case["status"] for case in last.cases]},
        "columns": columns(run),
        "rows": [{key: case[key] for key in (*dict(COLUMNS), "status_reason")
                  if case.get(key) is not None} for case in run],
        "context": environment(last, before),
    }


def series(nights: list[Night]) -> list[dict]:
    """Per case a list over the nights for every quantity that it ever had; None: no value."""
    cases: dict[str, dict] = {}
    for k, night in enumerate(nights):
        for case in night.cases:
            found = cases.setdefault(case_name(case), {
                "name": case_name(case), "mesh": case["mesh"], "scene": case["scene"],
                "method": case_name(case).split("/", 2)[2],
                "status": [None] * len(nights), "values": {}})
            found["status"][k] = case["status"]
            for key in (*(key for key, *_ in QUANTITIES), "time_low_s", "time_high_s"):
                if case.get(key) is not None:
                    found["values"].setdefault(key, [None] * len(nights))[k] = case[key]
    return sorted(cases.values(), key=lambda case: (case["mesh"], case["scene"]))


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


def columns(run: list[dict]) -> list[dict]:
    """Those that some record has a value for."""
    return [{"key": key, "name": name} for key, name in COLUMNS
            if any(case.get(key) is not None for case in run)]


def environment(last: Night, before: Night | None) -> list[dict]:
    """Keys of the last two nights; `differs` where the night before had another value."""
    old = before.context if before else last.context
    return [{"key": key, "value": last.context.get(key), "before": old.get(key),
             "differs": key not in ALWAYS_NEW and last.context.get(key) != old.get(key)}
            for key in sorted(last.context.keys() | old.keys())]
