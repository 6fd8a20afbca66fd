"""Performance profiles (Dolan & Moré 2002) and data profiles (Moré & Wild 2009) of methods over cases.

Methods s = 1..S on cases p = 1..P with costs c_ps, infinite where s does not solve p:
    performance profile  ρ_s(τ) = |{p : c_ps <= τ min_s c_ps}| / P,
    data profile         d_s(t) = |{p : c_ps <= t}| / P.
ρ depends on all methods compared: with more than two, the order of those that are not the best can
change when one is left out (Gould & Scott, ACM Trans. Math. Softw. 43, 2016, 15). d does not.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib.axes import Axes

from drawing import Drawing, Sheet, keys, log_axis
from records import Row
from selection import by_stop, compared, grouped, of_kind, with_suffix
from words import axis_label, counted, csv_of, left_out, threads

METHODS = 2  # at least
KINDS = ("", "stability", "adapted", "load_steps")  # of studies; "": ordinary runs
ROOM = 10  # methods
FEWEST = 3  # cases
RESAMPLES, SEED, CONFIDENCE = 400, 1, 0.95

Case = tuple[str, str, str, float | None]  # mesh, scene, stop, target error


@dataclass(frozen=True)
class Cases:
    methods: list[str]
    cases: list[Case]
    rows: dict[tuple[Case, str], Row]
    dropped: int       # cases of which some method has no record

    def costs(self, of: Callable[[Row], float | None]) -> np.ndarray:
        """(P, S); infinite: not solved."""
        return np.array([[of(self.rows[case, method]) if self.rows[case, method].solved else np.inf
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
                    times[:, p, s] = medians_again(samples, random)
        return times


def medians_again(samples_s: list[float], random: np.random.Generator) -> np.ndarray:
    """(RESAMPLES,) of samples drawn with replacement."""
    return np.median(random.choice(samples_s, (RESAMPLES, len(samples_s))), 1)


def case_of(row: Row) -> Case:
    return row.mesh, row.scene, row.stop, row.target_error


def cases_of(rows: list[Row]) -> Cases:
    """Takes methods in the order of their number of cases, if at least half of all cases, and FEWEST,
    remain common to all methods taken. One that every case was skipped for is not compared."""
    able = {row.general_name for row in rows if row.status != "skipped"}
    shown = compared([row for row in rows if not row.in_displacements and row.general_name in able], ROOM)
    every = list(dict.fromkeys(map(case_of, shown)))
    methods = [{case_of(row): row for row in own}
               for own in grouped(shown, lambda row: row.general_name).values()]
    needed = max(len(every) / 2, min(FEWEST, len(every)))
    common, kept = set(every), []
    for own in sorted(methods, key=len, reverse=True):
        if not kept or len(common & own.keys()) >= needed:
            kept.append(own)
            common &= own.keys()
    name = {id(own): next(iter(own.values())).method for own in methods}
    cases = [case for case in every if case in common]
    return Cases([name[id(own)] for own in kept], cases,
                 {(case, name[id(own)]): own[case] for own in kept for case in cases},
                 len(every) - len(cases))


def ratios(costs: np.ndarray) -> np.ndarray:
    """(..., P, S) costs over the least of their case; infinite where no method solves it."""
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
    """Whether ρ(factor) swaps any two methods when the leading one is left out; None: fewer than three."""
    if costs.shape[1] < 3:
        return None
    with_all = fractions(ratios(costs).T, np.array([factor]))[:, 0]
    leader = int(with_all.argmax())
    before = np.delete(with_all, leader)
    after = fractions(ratios(np.delete(costs, leader, axis=1)).T, np.array([factor]))[:, 0]
    return bool((np.sign(before[:, None] - before) * np.sign(after[:, None] - after) < 0).any())


@dataclass(frozen=True)
class Profile:
    kind: str             # performance or data
    quantity: str         # of Row
    axis: str
    values: np.ndarray    # (P, S): factors of the best, or seconds
    resampled: np.ndarray  # (RESAMPLES, P, S); (1, P, S): without repetitions

    def shares(self, s: int, at: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return fractions(self.values[:, s], at), *band(self.resampled[..., s], at)


def jumps(values: np.ndarray) -> np.ndarray:
    return np.unique(values[np.isfinite(values)])


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    for kind in KINDS:
        for stop, own in by_stop(of_kind(rows, kind)).items():
            yield Drawing(with_suffix("_".join(filter(None, ("profiles", kind))), stop), own, draw, table_of)


def profiles_of(cases: Cases) -> list[Profile]:
    times = cases.costs(lambda row: row.time_s)
    repeated = any(len(row.samples_s or ()) > 1 for row in cases.rows.values())
    again = cases.resampled() if repeated else times[None]
    found = [Profile("performance", "time_s", "time relative to that of the fastest method",
                     ratios(times), ratios(again)),
             Profile("data", "time_s", axis_label("time_s"), times, again)]
    heaps = cases.costs(lambda row: row.peak_heap_bytes or np.nan)
    if not np.isnan(heaps).any():
        found.insert(1, Profile("performance", "peak_heap_bytes",
                                "peak heap relative to the smallest", ratios(heaps),
                                ratios(heaps)[None]))
    return found


def table_of(rows: list[Row]) -> str:
    cases = cases_of(rows)
    lines = [(profile, method, *step) for profile in profiles_of(cases)
             for s, method in enumerate(cases.methods)
             for at in [jumps(profile.values[:, s])] for step in zip(at, *profile.shares(s, at))]

    def at(kind: str) -> object:
        return lambda line: float(line[2]) if line[0].kind == kind else None
    return csv_of(lines, ("profile", lambda line: line[0].kind),
                  ("quantity", lambda line: line[0].quantity), ("method", lambda line: line[1]),
                  ("factor_of_best", at("performance")), ("time_s", at("data")),
                  *((name, lambda line, k=k: float(line[k])) for k, name in
                    enumerate(("share_solved", "share_solved_low", "share_solved_high"), 3)))


def draw(rows: list[Row], width: float) -> Sheet | str:
    cases = cases_of(rows)
    if len(cases.methods) < METHODS or len(cases.cases) < FEWEST:
        return (f"{counted(len(cases.methods), 'method')} on {counted(len(cases.cases), 'case')} that all "
                f"of them have; needs {METHODS} and {FEWEST}")
    if not np.isfinite(cases.costs(lambda row: row.time_s)).any():
        return f"none of its {len(cases.cases)} cases is solved"
    shown = profiles_of(cases)
    sheet = Sheet(width, f"Profiles: {len(cases.methods)} methods on {len(cases.cases)} cases", *caption(cases, shown),
                  left_out(rows, list(cases.rows.values()), partial(why, compared(rows, ROOM))),
                  panels=len(shown), in_row=3, height=2.6, key=keys(cases.rows.values()))
    for axes, profile in zip(sheet.panels, shown):
        draw_panel(axes, profile, cases)
    return sheet


def why(compared_ones: list[Row], row: Row) -> str:
    names = {other.general_name for other in compared_ones}
    return "in displacements" if row.in_displacements else "records of too few of the cases" \
        if row.general_name in names else "no room"


def caption(cases: Cases, shown: list[Profile]) -> Iterator[str]:
    rows = list(cases.rows.values())
    scenes, meshes = (len({getattr(row, name) for row in rows}) for name in ("scene", "mesh"))
    yield (f"Cases: {counted(meshes, 'mesh', 'meshes')}, {counted(scenes, 'scene')}; "
           f"{threads(rows)}. A case is solved if its status is ok and verified; all other "
           "outcomes, skipped included, are not. First panels: performance profiles (Dolan & Moré 2002), the share of all cases that a method "
           "solves within a factor of the best method's cost; at 1: how often it is the best. "
           "Last: data profile (Moré & Wild 2009), the share solved within a time.")
    yield ("A performance profile depends on the methods compared: with more than two, the order "
           "of those behind the best can change when one is left out (Gould & Scott 2016)"
           + {None: ".", True: "; here it does, at factor 2, without the leading method.",
              False: "; here it does not, at factor 2, without the leading method."}[
                  order_depends_on_best(shown[0].values)])
    if all(profile.quantity != "peak_heap_bytes" for profile in shown):
        yield "No profile of the peak heap: not all solved cases have one."
    if len(shown[0].resampled) > 1:
        yield (f"Bands: {100 * CONFIDENCE:.0f} % of {RESAMPLES} bootstrap "
               "resamples of each case's repetitions; they do not cover the choice of cases.")
    if cases.dropped:
        yield (f"Left out, since some method has no record of them: {cases.dropped} of "
               f"{cases.dropped + len(cases.cases)} cases.")


def draw_panel(axes: Axes, profile: Profile, cases: Cases) -> None:
    every = jumps(profile.resampled)
    low = 1 if profile.kind == "performance" else every[0] / 1.5
    high = max(1.2 * every[-1], 2 * low)
    axes.set(xscale="log", xlim=(low, high), ylim=(0, 1.04), xlabel=profile.axis,
             ylabel="share of cases solved")
    log_axis(axes.xaxis)
    for s, method in enumerate(cases.methods):
        look = cases.rows[cases.cases[0], method].look
        at = np.r_[low, jumps(profile.resampled[..., s]), high]
        share, under, over = profile.shares(s, at)
        axes.step(at, share, where="post", **look.line(marker=None, linewidth=1.4))
        steps = jumps(profile.values[:, s])
        axes.plot(steps, fractions(profile.values[:, s], steps), **look.line(linestyle="none", markersize=4))
        if len(profile.resampled) > 1:
            axes.fill_between(at, under, over, step="post", alpha=0.12, linewidth=0, color=look.colour)
