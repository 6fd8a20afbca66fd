"""What a claim rests on: measured values, their ratios with intervals, and what these say of it."""
from collections.abc import Iterable
from math import inf
from statistics import geometric_mean
from typing import NamedTuple

import numpy as np

from records import Row
from selection import show_seconds

RESAMPLES, TAIL = 2000, 50  # 2.5 % of them at each end
VERDICTS = NOT_REPRODUCED, UNDECIDED, REPRODUCED = "not reproduced", "undecided", "reproduced"  # a claim's is the first

Limits = tuple[float, float]  # (low, high]
LONGER: Limits = (1, inf)


class Value(NamedTuple):
    figure: float         # seconds or bytes
    text: str             # "3.4 MiB", "12.3 s (inaccurate)", "~120 s (timeout, above 60 s)"
    samples: list[float]  # after a timeout the time spent, a lower bound
    timed_out: bool = False


class Ratio(NamedTuple):
    figure: float
    low: float
    high: float
    estimated: bool = False  # rests on an extrapolated time

    def __str__(self) -> str:
        return f"{'~' * self.estimated}{self.figure:.3g}"

    def with_interval(self) -> str:
        """1.34 [1.3, 1.38], ~5.2 above 3.1."""
        return str(self) + (
            " (no bound)" if (self.low, self.high) == (0, inf) else f" above {self.low:.3g}" if self.high == inf else
            f" below {self.high:.3g}" if self.low == 0 else
            f" [{self.low:.3g}, {self.high:.3g}]" if self.low < self.high else "")


def value_of(row: Row, field: str) -> Value | str:
    """Or why there is none."""
    value = getattr(row, field)
    if row.status == "timeout" and field == "time_s":
        if not (whole_s := row.extrapolated_time_s):
            return "timeout without an extrapolated time"
        spent_s = (row.done_fraction or 0) * whole_s
        return Value(whole_s, f"~{show_seconds(whole_s)} (timeout, above {show_seconds(spent_s)})", [spent_s], True)
    if not row.completed or value is None:  # a timeout's memory is that of the moment
        return f"no {field}" if row.completed else row.status
    text = show_seconds(value) if field == "time_s" else \
        f"{value / 2**20:.1f} MiB" if value < 2**30 else f"{value / 2**30:.2f} GiB"
    return Value(value, text + " (inaccurate)" * (row.status == "inaccurate"), row.samples_s or [value])


def bootstrap(above: np.ndarray, below: np.ndarray) -> tuple[float, float]:
    """95 % interval of the ratio of medians, with the random numbers of bench/records/robust.hpp."""
    draws = np.random.RandomState(1).randint(2**32, size=(RESAMPLES, above.size + below.size), dtype=np.uint32)
    with np.errstate(divide="ignore", invalid="ignore"):  # after a timeout at once
        ratios = np.sort(np.median(above[draws[:, :above.size] % above.size], 1)
                         / np.median(below[draws[:, above.size:] % below.size], 1))
    return ratios[TAIL], ratios[-1 - TAIL]


def ratio_of(above: Value, below: Value) -> Ratio:
    """Of times."""
    low, high = bootstrap(np.array(above.samples), np.array(below.samples))
    return Ratio(above.figure / below.figure, 0 if below.timed_out else low, inf if above.timed_out else high,
                 above.timed_out or below.timed_out)


def spread(ratios: list[Ratio]) -> Ratio:
    """Geometric mean and range, with the bounds of estimated ratios."""
    return Ratio(geometric_mean(ratio.figure for ratio in ratios),
                 min(ratio.low if ratio.estimated else ratio.figure for ratio in ratios),
                 max(ratio.high if ratio.estimated else ratio.figure for ratio in ratios),
                 any(ratio.estimated for ratio in ratios))


class Finding(NamedTuple):
    """A part of a claim, or a figure alone."""

    figure: str = ""
    interval: str = ""
    verdict: str | None = None
    open: str = ""                             # why it is undecided
    lack: tuple[str, str, str] | None = None   # why, method, mesh: it cannot be reproduced any more


def tested(label: str, ratio: Ratio, limits: Limits) -> Finding:
    """Is the ratio within? Undecided if a limit is inside its interval."""
    low, high = limits
    verdict = NOT_REPRODUCED if ratio.high <= low or ratio.low > high else \
        REPRODUCED if ratio.low > low and ratio.high <= high else UNDECIDED
    return Finding("", f"{label} {ratio.with_interval()}", verdict, f"{label}: the interval straddles the threshold")


def some_of(names: list[str]) -> str:
    return ", ".join(names) if len(names) <= 4 else f"{', '.join(names[:3])} and {len(names) - 3} more"


def judged(findings: Iterable[Finding]) -> tuple[str, dict[str, list[str]]]:
    """The verdict, and what it rests on."""
    findings, lacks = list(findings), {}
    verdicts = [finding.verdict for finding in findings if finding.verdict]
    for why, method, mesh in filter(None, (finding.lack for finding in findings)):
        lacks.setdefault(why, {}).setdefault(method, {})[mesh] = None
    reasons = dict.fromkeys(finding.open for finding in findings if finding.verdict == UNDECIDED and finding.open)
    return min(verdicts, key=VERDICTS.index, default=UNDECIDED), {
        "figures": [finding.figure for finding in findings if finding.figure],
        "interval": [finding.interval for finding in findings if finding.interval],
        "open": [*reasons, *["no records"] * (not verdicts), *(
            f"{why}: " + ", ".join(f"{method} ({some_of(list(meshes))})" for method, meshes in methods.items())
            for why, methods in sorted(lacks.items()))]}
