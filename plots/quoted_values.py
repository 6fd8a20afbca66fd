"""What the committed records give for an expression of docs/numbers.txt (quoted_numbers.py)."""
import re
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path

import pandas as pd

from records import KEYS, read

UNITS = {None: 1, "%": 0.01, "ms": 1e-3, "min": 60, "h": 3600, "days": 86400, "MiB": 2**20,
         "GiB": 2**30}
ROUNDING = {"at most": ROUND_CEILING, "at least": ROUND_FLOOR, None: ROUND_HALF_EVEN}
EXPRESSION = re.compile(
    r"(?P<folder>[\w/-]+): (?:(?P<bound>at most|at least) )?(?:(?P<which>least|greatest) )?"
    r"(?P<quantity>[\w+*/().-]+) of (?P<mesh>[^\s/]+)/(?P<method>\S+?)"
    r"(?: per (?:(?P<divisor>[\w+*/().-]+) of )?(?P<per>\S+?))?"
    r"(?P<filters>(?:, \w+=\S*?)*)(?: in (?P<unit>\S+))?")


class QuoteError(Exception):
    """A quotation or an expression with which nothing can be done: place and reason."""


@dataclass(eq=False)
class Runs:
    """The committed runs, each read once."""

    results: Path

    @cache
    def of(self, folder: str) -> pd.DataFrame:
        return read(self.results / folder / "results.csv")


def chosen(cases: pd.DataFrame, **wanted: str) -> pd.DataFrame:
    """Key = pattern, or patterns between |."""
    for key, patterns in wanted.items():
        def fits(value: object) -> bool:
            text = "" if value is None else str(value)
            return any(fnmatchcase(text, pattern) for pattern in patterns.split("|"))
        cases = cases[cases[key].map(fits).astype(bool)]
    return cases


def quantity_of(cases: pd.DataFrame, quantity: str) -> pd.Series:
    """NaN where one of its keys is empty."""
    keys = sorted(set(re.findall(r"[a-z]\w*", quantity)))
    return cases[keys].astype(float).eval(quantity, engine="python")


@cache
def value_of(expression: str, runs: Runs) -> tuple[float, str]:
    """What the records give, and how it is rounded."""
    match = EXPRESSION.fullmatch(expression)
    if not match:
        raise QuoteError(f"'{expression}' cannot be read; expected FOLDER: [at most|at least] "
                         "[least|greatest] QUANTITY of MESH/METHOD [per [QUANTITY of] "
                         "METHODS] [, KEY=VALUE] [in UNIT]")
    if match["unit"] not in UNITS:
        raise QuoteError(f"'{expression}': unit '{match['unit']}', expected one of "
                         f"{', '.join(filter(None, UNITS))}")
    filters = {"stop": "target", "knob": ""}
    filters |= dict(pair.split("=", 1) for pair in match["filters"].split(", ")[1:])
    run = runs.of(match["folder"])
    names = re.findall(r"[a-z]\w*", f"{match['quantity']} {match['divisor'] or ''}")
    for name in {*filters, *names} - {"count"}:
        if name not in KEYS:
            raise QuoteError(f"'{expression}': no column {name}")
    cases = chosen(run, mesh=match["mesh"], method=match["method"], **filters)
    if match["quantity"] == "count":
        return float(len(cases)), ROUNDING[None]
    cases = cases.assign(value=quantity_of(cases, match["quantity"]))
    if match["per"]:
        others = chosen(run, method=match["per"], **filters)
        divisor = quantity_of(others, match["divisor"] or match["quantity"])
        others = others.assign(divisor=divisor.where(divisor != 0))
        cases = cases[["mesh", "scene", "value"]].merge(others[["mesh", "scene", "divisor"]])
        cases["value"] /= cases.divisor
    values = cases.value.dropna()
    if values.empty or (match["which"] is None and len(values) > 1):
        raise QuoteError(f"'{expression}': {len(values) or 'no'} values, expected "
                         f"{'one' if match['which'] is None else 'some'}")
    value = values.max() if match["which"] == "greatest" else values.min()
    return float(value) / UNITS[match["unit"]], ROUNDING[match["bound"]]
