"""Performance and data profiles: the share of cases that a method solves within so much of the best."""
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import profiles
from catalogue import DASHES
from drawing import PAGE_WIDTH, TYPE, Drawing, log_axis, panel_at, sheet
from labels import DASHED, LEFT, draw_names
from profiles import Cases
from records import Row
from selection import grouped
from words import counted, csv_of, threads, width_of

TOP, PANEL, BETWEEN, BOTTOM = 0.45, 2.3, 0.55, 0.5  # inches
METHODS = 2  # at least
SETS = {"": "", "stability": "_stability", "adapted": "_adapted",
        "load-steps": "_load_steps"}  # study -> end of the file's name


@dataclass(frozen=True)
class Profile:
    kind: str             # performance or data
    quantity: str         # of Row
    axis: str
    values: np.ndarray    # (P, S): factors of the best, or seconds
    resampled: np.ndarray | None  # (RESAMPLES, P, S)

    def every(self, s: int) -> np.ndarray:
        """All the values that the method has, in (RESAMPLES, P)."""
        return (self.values if self.resampled is None else self.resampled)[..., s]

    def shares(self, s: int, at: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        share = profiles.fractions(self.values[:, s], at)
        return (share, share, share) if self.resampled is None else \
            (share, *profiles.band(self.every(s), at))


def jumps(values: np.ndarray) -> np.ndarray:
    return np.unique(values[np.isfinite(values)])


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    for (study, stop), own in grouped([row for row in rows if row.study in SETS],
                                      lambda row: (row.study, row.stop)).items():
        yield Drawing(f"profiles{SETS[study]}{'_paper_stop' if stop == 'paper' else ''}", own, draw,
                      table_of)


def profiles_of(cases: Cases) -> list[Profile]:
    times, again = cases.costs(lambda row: row.time_s), None
    if any(len(row.samples_s or ()) > 1 for row in cases.rows.values()):
        again = cases.resampled()
    found = [Profile("performance", "time_s", "time over that of the fastest method, 1",
                     profiles.ratios(times), None if again is None else profiles.ratios(again)),
             Profile("data", "time_s", "time of one solve, s", times, again)]
    heaps = cases.costs(lambda row: row.peak_heap_bytes or np.nan)
    if not np.isnan(heaps).any():
        found.insert(1, Profile("performance", "peak_heap_bytes",
                                "peak heap over that of the smallest, 1",
                                profiles.ratios(heaps), None))
    return found


def table_of(rows: list[Row]) -> str:
    """A line per method and step of its curve."""
    cases = profiles.cases_of(rows)
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


def draw(rows: list[Row]) -> Figure | str:
    cases = profiles.cases_of(rows)
    if len(cases.methods) < METHODS or len(cases.cases) < profiles.FEWEST:
        return (f"{len(cases.methods)} methods on {len(cases.cases)} cases that all of them have; "
                f"needs {METHODS} and {profiles.FEWEST}")
    if not np.isfinite(cases.costs(lambda row: row.time_s)).any():
        return f"none of its {len(cases.cases)} cases is solved"
    shown = profiles_of(cases)
    figure = sheet(TOP + len(shown) * (PANEL + BETWEEN),
                   f"Profiles: {len(cases.methods)} methods on {len(cases.cases)} cases",
                   *caption(cases, shown))
    names = max(width_of(method, TYPE) / 72 for method in cases.methods)
    for k, profile in enumerate(shown):
        draw_panel(panel_at(figure, LEFT, TOP + k * (PANEL + BETWEEN),
                            PAGE_WIDTH - LEFT - 0.4 - DASHED - names, PANEL), profile, cases)
    return figure


def caption(cases: Cases, shown: list[Profile]) -> Iterator[str]:
    rows = list(cases.rows.values())
    scenes, meshes = (len({getattr(row, name) for row in rows}) for name in ("scene", "mesh"))
    yield (f"Cases: {counted(meshes, 'mesh', 'meshes')}, {counted(scenes, 'scene')}; "
           f"{threads(rows)}. Solved: status ok and verified; whatever else became of a case, "
           "skipped too, it is not. Above: performance profiles (Dolan & Moré 2002), the share of all cases that a method "
           "solves within a factor of the best method's cost; at 1: how often it is the best. "
           "Lowest: data profile (Moré & Wild 2009), the share solved within a time.")
    yield ("A performance profile depends on the methods compared: with more than two, the order "
           "of those behind the best can change when one is left out (Gould & Scott 2016)"
           + {None: ".", True: "; here it does at factor 2 without the one that leads there.",
              False: "; at factor 2 it does not here without the one that leads there."}[
                  profiles.order_depends_on_best(shown[0].values)])
    if shown[0].resampled is not None:
        yield (f"Bands: {100 * profiles.CONFIDENCE:.0f} % of {profiles.RESAMPLES} bootstrap "
               "resamples of each case's repetitions; of the choice of cases they say nothing.")
    if cases.absent:
        yield f"Left out, with records of too few of the cases: {', '.join(cases.absent)}."
    if cases.dropped:
        yield (f"Left out, since some method has no record of them: {cases.dropped} of "
               f"{cases.dropped + len(cases.cases)} cases.")


def draw_panel(axes: Axes, profile: Profile, cases: Cases) -> None:
    every = jumps(profile.values if profile.resampled is None else profile.resampled)
    low = 1 if profile.kind == "performance" else every[0] / 1.5
    high = max(1.2 * every[-1], 2 * low)
    axes.set(xscale="log", xlim=(low, high), ylim=(0, 1.04), xlabel=profile.axis,
             ylabel="share of cases solved, 1")
    log_axis(axes.xaxis)
    looks = {method: cases.rows[cases.cases[0], method].look for method in cases.methods}
    families = grouped(cases.methods, lambda method: looks[method].colour)
    dashes = {method: ("-", *DASHES)[k % (len(DASHES) + 1)]
              for own in families.values() for k, method in enumerate(own)}
    ends = {}
    for s, method in enumerate(cases.methods):
        at = np.r_[low, jumps(profile.every(s)), high]
        share, under, over = profile.shares(s, at)
        axes.step(at, share, where="post", linewidth=1.4, zorder=3, linestyle=dashes[method],
                  color=looks[method].colour)
        if profile.resampled is not None:
            axes.fill_between(at, under, over, step="post", alpha=0.15, linewidth=0,
                              color=looks[method].colour)
        ends[method] = high, share[-1]
    # Of those that end alike the one that was there first is above.
    last = dict(zip(ends, np.where(np.isfinite(profile.values), profile.values, 0).max(axis=0)))
    ends = {method: ends[method] for method in sorted(ends, key=last.get, reverse=True)}
    draw_names(axes, ends, {method: look.colour for method, look in looks.items()},
               dict.fromkeys(ends), dashes)
