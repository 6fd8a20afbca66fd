#!/usr/bin/python3
"""The paper's claims on time and memory (its sections 3.2, 3.3 and 4), tested against the records of a run.

Verdicts  reproduced
          not reproduced  one part of the claim is contradicted
          undecided       a record is missing or of no use, or an interval straddles the threshold;
                          "open" says which

Two cases are compared by the ratio of their median times with its 95 % bootstrap interval (none
where both have one sample); over several meshes by geometric mean and range. ~: a case ran out of
time, and its extrapolated time is the figure; only the time it did spend counts for the verdict.

Exit status  0  whatever the verdicts
             2  wrong usage, or records that cannot be read: one line on standard error
"""
import argparse
import sys
from collections.abc import Callable, Iterator
from math import inf, log
from pathlib import Path

import pandas as pd

import command
from case_names import implied_solver
from evidence import (LONGER, NOT_REPRODUCED, REPRODUCED, UNDECIDED, Finding, Limits, Ratio, Value, judged, ratio_of,
                      spread, tested, value_of)
from records import COMPLETED, STOPS, RecordsError, lines_file, read, rows_of

NEEDED = ("mesh", "scene", "method", "status", "stop", "iterative")
SAME, SLOW, NEAR = 1.5, 2, 0.25  # factors of times or memories; ω = 1 ± NEAR
WITH_DTIC = ("SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6")
BUT_ALM = (*WITH_DTIC, "SSKY", "3STEPD")  # in Figs 4 and 5
GENERAL = {"SDTIC3": "SYMMLQ:DTIC3", "SDTIC6": "SYMMLQ:DTIC6", "SSKY": "SYMMLQ:SKY", "3STEPCG3": "3STEPCG:DTIC3",
           "3STEPCG6": "3STEPCG:DTIC6"}
CONDENSING = ("3STEPD", "BLIND", "3STEPCG", "SYMMLQ")
MEASURED = ("time_s", "peak_heap_bytes", "storage_bytes")


def cases_of(table: pd.DataFrame, stop: str, source: Path) -> pd.DataFrame:
    """By mesh and general name, of one stop and the default (or only) scene. Direct methods have no stop: records of
    the other stop count if there are none of this one."""
    table = table[table.study == ""]
    scenes = sorted(set(table.scene))
    if len(scenes) > 1 and "default" not in scenes:
        raise RecordsError(f"{source}: scene: {scenes[0]} and {scenes[1]} (allowed: default among them, or one scene "
                           "alone)")
    table = table[table.scene.isin(["default"] if "default" in scenes else scenes)
                  & ~table.case_name.str.contains("/contact=")]
    asked = table.stop == stop
    cases = pd.concat([table[~asked & ~table.iterative.astype(bool)], table[asked]])
    cases = cases.drop_duplicates(["mesh", "general_name"], keep="last").sort_values("general_name")
    cases = cases.sort_values("mesh", key=lambda mesh: mesh.map(list(table.mesh).index), kind="stable")
    rows = rows_of(cases)
    cases.index = pd.MultiIndex.from_arrays([cases.mesh, cases.general_name], names=[None, None])
    return cases.assign(**{field + "_value": [value_of(row, field) for row in rows] for field in MEASURED})


def with_preconditioners(cases: pd.DataFrame) -> str:
    """The mesh with most of them; of several, the paper's."""
    counts = (cases.preconditioner != "").groupby(cases.mesh, sort=False).sum()
    return max(counts.index, key=lambda mesh: (counts[mesh], mesh == "Mesh3"), default="")


def families_with(cases: pd.DataFrame, preconditioner: str) -> list[str]:
    """SYMMLQ (Fig. 3), and 3STEPCG if it has records of the preconditioner."""
    own = cases[(cases.mesh == with_preconditioners(cases)) & cases.preconditioner.str.startswith(preconditioner)]
    return ["SYMMLQ"] + ["3STEPCG"] * ("3STEPCG" in set(own.family))


def meshes_with(cases: pd.DataFrame, *methods: str) -> list[str]:
    return list(cases.mesh[cases.general_name.isin([GENERAL.get(method, method) for method in methods])].unique())


def values(cases: pd.DataFrame, field: str, mesh: str, *methods: str) -> tuple[dict[str, Value], list[Finding]]:
    """By method, and what is lacking."""
    found = {method: cases[field + "_value"].get((mesh, GENERAL.get(method, method)), "no record") for method in methods}
    return ({method: value for method, value in found.items() if isinstance(value, Value)}, [
        Finding(verdict=UNDECIDED, lack=(why, method, mesh)) for method, why in found.items() if isinstance(why, str)])


def times(cases: pd.DataFrame, above: str, below: str, on: tuple[str, ...], limits: Limits | None = None,
          with_tuning: bool = False) -> Iterator[Finding]:
    """A ratio per mesh that has records of one of `on`. Their geometric mean and range decide if there are limits."""
    texts, ratios, meshes = [], [], meshes_with(cases, *on)
    for mesh in meshes:
        found, lacks = values(cases, "time_s", mesh, above, below)
        yield from lacks if limits else ()
        if lacks or with_tuning and not (tuning_s := cases.tuning_s[mesh, above]):
            continue
        if with_tuning:
            time = found[above]
            found[above] = Value(time.figure + tuning_s, f"({time.text} + {tuning_s:.3g} s)",
                                 [sample + tuning_s for sample in time.samples], time.timed_out)
        ratios.append(ratio_of(found[above], found[below]))
        texts.append(f"{mesh} {found[above].text}/{found[below].text} = {ratios[-1]}")
    label = f"not in the claim: ({above} + its tuning)/{below}" if with_tuning else f"{above}/{below}"
    if ratios:
        yield Finding(f"{label}: {', '.join(texts)}")
        finding = tested(f"{label} on {len(ratios)} mesh{'es' * (len(ratios) > 1)}",
                         spread(ratios) if len(ratios) > 1 else ratios[0], limits or LONGER)
        yield finding if limits and len(ratios) == len(meshes) else Finding(interval=finding.interval)


def several(*tests: tuple) -> Callable[[pd.DataFrame], Iterator[Finding]]:
    """times() with each of these arguments."""
    return lambda cases: (finding for test in tests for finding in times(cases, *test))


def levels(name: str, first: int, last: int, pairs: Callable[[dict[int, Value]], list[tuple[int, int]]],
           families: Callable[[pd.DataFrame], list[str]]) -> Callable[[pd.DataFrame], Iterator[Finding]]:
    """Times of a preconditioner's levels; of each pair the first is slower."""
    def test(cases: pd.DataFrame) -> Iterator[Finding]:
        mesh = with_preconditioners(cases)
        for family in families(cases):
            found, lacks = values(cases, "time_s", mesh, *(f"{family}:{name}{x}" for x in range(first, last + 1)))
            yield from lacks
            own = {int(method[-1]): time for method, time in found.items()}
            if own:
                yield Finding(f"{mesh}, {family}: " + ", ".join(f"{name}{x} {time.text}" for x, time in own.items()))
            for slow, fast in pairs(own):
                yield tested(f"{family} {name}{slow}/{name}{fast}", ratio_of(own[slow], own[fast]), LONGER)
    return test


def neighbours(times_s: dict[int, Value]) -> list[tuple[int, int]]:
    return [(x, x + 1) for x in times_s if x + 1 in times_s]


def ends_and_best(times_s: dict[int, Value]) -> list[tuple[int, int]]:
    """None unless all are there."""
    best = min((2, 3, 4), key=lambda x: times_s[x].figure) if len(times_s) == 5 else 0
    return [(1, best), (5, best)] if best else []


def equal_memory(cases: pd.DataFrame) -> Iterator[Finding]:
    """FLIC4 as in the paper, or the level whose memory is nearest. Of SYMMLQ: 3STEPCG's memory is mostly S⁻¹Cᵀ."""
    mesh, level = with_preconditioners(cases), "FLIC4"
    sizes, lacks = values(cases, "storage_bytes", mesh, "SYMMLQ:DTIC3", "SYMMLQ:FLIC4")
    yield from lacks
    if not lacks:
        dtic, flic4 = sizes.values()
        yield Finding(f"{mesh}, SYMMLQ: memory DTIC3 {dtic.text}, FLIC4 {flic4.text}")
        flics, _ = values(cases, "storage_bytes", mesh, *(f"SYMMLQ:FLIC{x}" for x in (4, 1, 2, 3, 5)))
        factors = {method[7:]: size.figure / dtic.figure for method, size in flics.items()}
        nearest = min(factors, key=lambda name: abs(log(factors[name])))
        if abs(log(factors[level])) > log(SAME):
            level = nearest
            yield Finding(f"SYMMLQ: FLIC4's memory is not DTIC3's, the nearest is {level}'s, {factors[level]:.3g} times "
                          "as much")
        if abs(log(factors[level])) > log(SAME):
            yield Finding(verdict=UNDECIDED, open=f"SYMMLQ: no FLIC has DTIC3's memory within a factor {SAME}")
    found, late = values(cases, "time_s", mesh, "SYMMLQ:DTIC3", f"SYMMLQ:{level}")
    yield from late
    if not lacks + late:
        dtic, flic = found.values()
        ratio = ratio_of(flic, dtic)
        yield Finding(f"SYMMLQ {level}/DTIC3: {flic.text}/{dtic.text} = {ratio}")
        yield tested(f"SYMMLQ {level}/DTIC3", ratio, LONGER)


def ssor(cases: pd.DataFrame) -> Iterator[Finding]:
    mesh = with_preconditioners(cases)
    for family in families_with(cases, "SSOR"):
        own = cases[(cases.mesh == mesh) & cases.general_name.str.fullmatch(rf"{family}:SSOR[\d.]+")]
        said = {float(name[4:]): value for name, value in zip(own.preconditioner, own.time_s_value)}
        if said:
            yield Finding(f"{mesh}, {family}: " + ", ".join(
                f"ω={omega:g} {value.text if isinstance(value, Value) else value}" for omega, value in said.items()))
        found = {omega: value for omega, value in sorted(said.items()) if isinstance(value, Value)}
        if not found:
            yield Finding(verdict=UNDECIDED, lack=("no time", f"{family}:SSOR", mesh))
            continue
        best = min(found, key=lambda omega: found[omega].figure)
        if not (min(found) < 1 - NEAR and max(found) > 1 + NEAR and any(abs(omega - 1) <= NEAR for omega in found)):
            yield Finding(verdict=UNDECIDED, open=f"{family}: SSOR needs an ω below {1 - NEAR}, one above {1 + NEAR} and "
                          "one between")
        else:  # every ω that may be the best must be near 1
            may_be = [omega for omega, time in found.items() if omega == best
                      or tested("", ratio_of(time, found[best]), LONGER).verdict != REPRODUCED]
            near = [abs(omega - 1) <= NEAR for omega in may_be]
            yield Finding(f"{family}: best ω: {' or '.join(f'{omega:g}' for omega in may_be)}", "",
                          REPRODUCED if all(near) else UNDECIDED if any(near) else NOT_REPRODUCED,
                          f"{family}: the best ω may be near 1 or not")
        dtic, lacks = values(cases, "time_s", mesh, f"{family}:DTIC3")
        yield from lacks
        for time in dtic.values():
            yield Finding(f"{family}: DTIC3 {time.text}")
            yield tested(f"{family} SSOR{best:g}/DTIC3", ratio_of(found[best], time), (SLOW, inf))


def least_memory(cases: pd.DataFrame) -> Iterator[Finding]:
    ratios = []
    for mesh in meshes_with(cases, "ALM", *BUT_ALM):
        heaps, lacks = values(cases, "peak_heap_bytes", mesh, "ALM", *BUT_ALM)
        yield from lacks
        direct = heaps["3STEPD"].text if "3STEPD" in heaps else "-"
        if (alm := heaps.pop("ALM", None)) and heaps:
            least = min(heaps, key=lambda method: heaps[method].figure)
            ratios.append(Ratio(*[alm.figure / heaps[least].figure] * 3))
            yield Finding(f"{mesh}: ALM {alm.text}, 3STEPD {direct}, least but ALM {least} {heaps[least].text}", "",
                          REPRODUCED if ratios[-1].figure < 1 else NOT_REPRODUCED)
    if ratios:
        yield Finding(interval=f"ALM/least of the others {spread(ratios).with_interval()}")


def gauss_seidel(cases: pd.DataFrame) -> Iterator[Finding]:
    own = cases[cases.family.isin(CONDENSING)]
    known = own[own.status.isin(COMPLETED) & own.time_s.notna() & own.stage_contact_s.notna()]
    swept = known[[(row["contact_solver"] or implied_solver(row)) == "gauss-seidel" for row in known.to_dict("records")]]
    if others := len(known) - len(swept):
        yield Finding(f"{others} cases by active sets, not by Gauss–Seidel")
    if swept.empty:
        if others:
            yield Finding(verdict=UNDECIDED, open="no case by Gauss–Seidel, which --stop=paper takes")
        return
    shares = (swept.stage_contact_s / swept.time_s).astype(float)
    largest = shares.groupby(swept.mesh, sort=False).idxmax()
    yield Finding("largest share: " + ", ".join(
        f"{mesh} {100 * shares[place]:.2g} % ({swept.method[place]}{', inaccurate' * (swept.status[place] == 'inaccurate')})"
        for mesh, place in largest.items()))
    yield Finding(f"under 1 % in {(shares < 0.01).sum()} of {len(swept)} cases; {len(own) - len(known)} without a time",
                  f"share [{100 * shares.min():.2g} %, {100 * shares.max():.2g} %]",
                  REPRODUCED if shares.max() < 0.01 else NOT_REPRODUCED)


# Sentence (section of the paper; here: what it is taken for), what the cases say of it.
CLAIMS = {
    "A larger x makes DTICx faster (4.0.2)": levels("DTIC", 3, 6, neighbours, lambda cases: ["SYMMLQ", "3STEPCG"]),
    "FLICx is fastest at an inner x, near 3 (4.0.2); here: 3 ± 1":
        levels("FLIC", 1, 5, ends_and_best, lambda cases: families_with(cases, "FLIC")),
    "DTIC beats FLIC at equal memory, e.g. DTIC3 and FLIC4 (4.0.2)": equal_memory,
    f"SSOR is best with ω near 1, and slow (4.0.2); here: 1 ± {NEAR}, {SLOW} times DTIC3's time": ssor,
    f"SYMMLQ and 3STEPCG take the same time with the same preconditioner (4.0.3); here: within a factor {SAME}":
        several(*((*pair, WITH_DTIC, (1 / SAME, SAME)) for pair in (WITH_DTIC[:2], WITH_DTIC[2:]))),
    f"Iterative methods are as fast as 3STEPD only with SKY (4.0.3); here: as fast up to a factor {SAME}":
        several(("SSKY", "3STEPD", BUT_ALM, (-inf, SAME)),
                *((method, "3STEPD", BUT_ALM, (SAME, inf)) for method in WITH_DTIC)),
    f"ALM takes the same time as 3STEPD, slightly less (4.0.3); here: between 1/{SAME} and 1 of it":
        several(*(("ALM", "3STEPD", ("ALM", "3STEPD"), *test) for test in (((1 / SAME, 1),), (None, True)))),
    "ALM needs the least memory of all, less than 3STEPD (4.0.3)": least_memory,
    "Gauss–Seidel usually takes under 1 % of the time (3.3); here: in every condensing case": gauss_seidel,
    "Blind condensation is too expensive (3.2.1); here: slower than 3STEPD":
        several(("BLIND", "3STEPD", ("BLIND",), LONGER),
                *((ours, "3STEPD", (ours,)) for ours in ("BLIND:SCHUR", "BLIND:SKY"))),
}


def show(args: argparse.Namespace) -> None:
    if args.out and args.out.suffix != ".md":
        raise RecordsError(f"--out: {args.out} (allowed: a name that ends in .md)")
    if not args.out and sys.__stdout__ is None:
        raise RecordsError("standard output: is closed (allowed: an open one, or --out=FILE)")
    file = lines_file(args.results) or args.results / "records.jsonl"
    cases = cases_of(read(file, NEEDED), args.stop, file)
    text = (f"{file}: {len(cases)} cases, stop {args.stop}, scene {'default' if cases.empty else cases.scene.iloc[0]}, "
            f"preconditioners on {with_preconditioners(cases) or 'no mesh'}\n\n")
    table = text + "| | claim (section of the paper) | figures | interval | verdict |\n" + "|---" * 5 + "|\n"
    for number, (sentence, test) in enumerate(CLAIMS.items(), 1):
        verdict, said = judged(test(cases))
        text += f"{number:>2}  {verdict:<14}  {sentence}\n" + "".join(
            f"    {name:<8}  {line}\n" for name, lines in said.items() for line in lines)
        cells = [sentence], said["figures"], said["interval"], [f"**{verdict}**", *said["open"]]
        table += f"| {number} | " + " | ".join("<br>".join(cell).replace("|", "\\|") for cell in cells) + " |\n"
    if args.out:
        command.replace_all(args.out.parent, {args.out.name: command.text_writer(table)})
    print(text, end="")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=Path, nargs="?", default=Path("results/latest"), metavar="RESULTS_DIR",
                        help="a results folder; default: results/latest")
    parser.add_argument("--stop", choices=STOPS, default="target", help="use the records with this stop of the iterative methods")
    parser.add_argument("--out", type=Path, metavar="TABLE.md", help="also write the table to this file")


def main() -> None:
    command.run(__doc__, add_arguments, show, "a file to write")


if __name__ == "__main__":
    main()
