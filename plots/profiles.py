"""Performance profiles (Dolan & Moré 2002) and data profiles (Moré & Wild 2009) of methods over cases.

Methods s = 1..S on cases p = 1..P with costs c_ps, infinite where s does not solve p:
    performance profile  ρ_s(τ) = |{p : c_ps <= τ min_s c_ps}| / P,
    data profile         d_s(t) = |{p : c_ps <= t}| / P.
ρ depends on all methods compared: with more than two, the order of those that are not the best can
change when one is left out (Gould & Scott, ACM Trans. Math. Softw. 43, 2016, 15). d does not.
"""
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from records import Row
from selection import compared, grouped

ROOM = 12  # methods
FEWEST = 3  # cases
RESAMPLES, SEED, CONFIDENCE = 400, 1, 0.95
VERIFIED = ("", "ok", "other_solution")  # outcomes of an ok case that count as solved

Case = tuple[str, str, str, float | None]  # mesh, scene, stop, target error


@dataclass(frozen=True)
class Cases:
    methods: list[str]
    cases: list[Case]
    rows: dict[tuple[Case, str], Row]
    absent: list[str]  # methods with records of too few of them
    dropped: int       # cases of which some method has no record

    def costs(self, of: Callable[[Row], float | None]) -> np.ndarray:
        """(P, S); infinite: not solved."""
        return np.array([[of(self.rows[case, method]) if solved(self.rows[case, method]) else np.inf
                          for method in self.methods] for case in self.cases], float)

    def resampled(self) -> np.ndarray:
        """(RESAMPLES, P, S) medians of samples_s, drawn with replacement; where there are no two
        of them, time_s."""
        random = np.random.default_rng(SEED)
        times = np.tile(self.costs(lambda row: row.time_s), (RESAMPLES, 1, 1))
        for p, case in enumerate(self.cases):
            for s, method in enumerate(self.methods):
                samples = self.rows[case, method].samples_s
                if len(samples or ()) > 1 and np.isfinite(times[0, p, s]):
                    times[:, p, s] = np.median(random.choice(samples, (RESAMPLES, len(samples))), 1)
        return times


def solved(row: Row) -> bool:
    return row.status == "ok" and row.outcome in VERIFIED and row.time_s is not None


def case_of(row: Row) -> Case:
    return row.mesh, row.scene, row.stop, row.target_error


def cases_of(rows: list[Row]) -> Cases:
    """Of the methods worth comparing, those with most cases first: each that leaves half of all cases,
    and FEWEST, which all have."""
    shown = compared([row for row in rows if not row.in_displacements], ROOM)
    every = list(dict.fromkeys(map(case_of, shown)))
    methods = [{case_of(row): row for row in own}
               for own in grouped(shown, lambda row: row.general_name).values()]
    needed = max(len(every) / 2, min(FEWEST, len(every)))
    common, kept, absent = set(every), [], []
    for own in sorted(methods, key=len, reverse=True):
        fits = not kept or len(common & own.keys()) >= needed
        (kept if fits else absent).append(own)
        common &= own.keys() if fits else common
    name = {id(own): next(iter(own.values())).method for own in methods}
    cases = [case for case in every if case in common]
    return Cases([name[id(own)] for own in kept], cases,
                 {(case, name[id(own)]): own[case] for own in kept for case in cases},
                 [name[id(own)] for own in absent], len(every) - len(cases))


def ratios(costs: np.ndarray) -> np.ndarray:
    """(..., P, S) costs over the least of their case; infinite where nobody solves it."""
    best = costs.min(axis=-1, keepdims=True)
    return np.divide(costs, best, out=np.full_like(costs, np.inf), where=np.isfinite(costs))


def fractions(values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """(..., P), (m,) -> (..., m): the share of values that are at most so large."""
    return (values[..., None, :] <= at[:, None]).mean(-1)


def band(values: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(RESAMPLES, P), (m,) -> lower and upper ends (m,) of the pointwise interval."""
    low, high = np.quantile(fractions(values, at), [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2], 0)
    return low, high


def order_depends_on_best(costs: np.ndarray, factor: float = 2) -> bool | None:
    """Whether ρ(factor) puts any two of the others the other way round without the method that leads
    there; None: there are not three."""
    if costs.shape[1] < 3:
        return None
    with_all = fractions(ratios(costs).T, np.array([factor]))[:, 0]
    leader = int(with_all.argmax())
    before = np.delete(with_all, leader)
    after = fractions(ratios(np.delete(costs, leader, axis=1)).T, np.array([factor]))[:, 0]
    return bool((np.sign(before[:, None] - before) * np.sign(after[:, None] - after) < 0).any())
