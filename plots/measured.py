"""How the records of a run were measured: a paragraph for the appendix of a paper.

Every sentence follows from the records, also of several machines, programs and settings: values that
differ are listed with the number of their cases.
"""
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from itertools import chain

import numpy as np

from records import NOT_NEGATIVE, SHARE, Row
from selection import grouped
from words import counted, percent, span, targets

UNKNOWN = "unknown"  # written by bench where the machine does not tell
UNTOLD = {"cpu": "an unknown processor", "cpus": "?", "kernel": "of unknown version",
          "cpu_governor": "not known", "compiler": "an unknown compiler", "blas": "BLAS not known"}
CHANGED = defaultdict(lambda: ", changes to it not known", yes=", with changes that are in no revision",
                      no="")
LIBRARIES = {"blas": "{}", "blas_core": "BLAS kernels {}", "cholmod": "CHOLMOD {}",
             "mumps": "MUMPS {}", "eigen": "Eigen {}"}
MACHINE = "{cpu}, {cpus} processors, Linux {kernel}, frequency governor {cpu_governor}"
PROGRAM = ("airybench {airybench_version}, git revision {revision}{changed}, compiled by {compiler} "
           "with `{compiler_flags}`")
FEWEST_FOR_INTERVAL = 6


def listed(values: Iterable[str]) -> str:
    """'a', or 'a (3 cases); b (1 case)'."""
    found = Counter(values).most_common()
    return "; ".join(value if len(found) == 1 else f"{value} ({counted(count, 'case')})"
                     for value, count in found)


class Context(dict):
    """Where and with what a record was made."""

    def __missing__(self, key: str) -> str:
        return UNTOLD.get(key, "")


def context_of(row: Row) -> Context:
    told = Context((key, value.strip()) for key, value in (row.context or {}).items()
                   if value.strip() not in ("", UNKNOWN))
    told["revision"] = told["git_revision"][:12] or "not known"
    told["changed"] = CHANGED[told["git_dirty"]]
    libraries = (words.format(told[key]) for key, words in LIBRARIES.items() if told[key])
    told["libraries"] = ", ".join(libraries)
    return told


def told_by(rows: list[Row], what: str, words: str) -> str:
    return listed(words.format_map(context_of(row)) if row.context
                  else f"{what} that the record does not name" for row in rows)


def cases(rows: list[Row]) -> Iterator[str]:
    methods, meshes, scenes = (len({getattr(row, key) for row in rows})
                               for key in ("general_name", "mesh", "scene"))
    yield (f"The records have {counted(len(rows), 'case')}: {counted(methods, 'method')}, "
           f"{counted(meshes, 'mesh', 'meshes')}, {counted(scenes, 'scene')}.")
    good = sum(row.solved for row in rows)
    others = Counter(row.outcome or row.status for row in rows if not row.solved)
    yield (f"{good} of them ended ok and verified" + ("; the others ended " + ", ".join(
        f"{outcome.replace('_', ' ')} ({count})" for outcome, count in others.most_common())
        if others else "") + ".")


def machines_and_programs(rows: list[Row]) -> Iterator[str]:
    days = sorted({context_of(row)["date"][:10] for row in rows} - {""})
    when = f", {' to '.join(dict.fromkeys((days[0], days[-1])))}" if days else ""
    yield f"They were run on {told_by(rows, 'a machine', MACHINE)}{when}."
    yield f"The program was {told_by(rows, 'a program', PROGRAM)}."
    revisions = {context_of(row)["git_revision"] for row in rows} - {""}
    if len(revisions) > 1:
        yield (f"The records are of {len(revisions)} revisions of the program: cases of different "
               "revisions should be compared with care.")
    yield f"Libraries: {told_by(rows, 'libraries', '{libraries}')}."
    yield ("BLAS, OpenMP and a method's own right-hand sides had "
           f"{listed(counted(row.threads, 'thread') for row in rows)}.")


def search(rows: list[Row]) -> Iterator[str]:
    for budget in sorted({row.tuning_budget_s for row in rows if row.tuning_budget_s}):
        own = [row for row in rows if row.tuning_budget_s == budget]
        of = "all cases" if len(own) == len(rows) else counted(len(own), "case")
        yield (f"In {of} that choice had {budget:g} s; "
               f"in {sum(row.tuning_cut for row in own)} of them it ended there with the best found.")


def times(rows: list[Row]) -> Iterator[str]:
    timed = [row for row in rows if row.time_s]
    if not timed:
        yield "No case has a time."
        return
    own = "; HYBRID assembles its own matrices in its time" \
        if any(row.family == "HYBRID" for row in timed) else ""
    yield ("A time is the wall-clock time of one solve, from assembled blocks to contact forces and "
           "stresses, of all load steps together; assembling the blocks and choosing parameters and "
           f"tolerances is not in it{own}.")
    others = [row.program for row in timed if row.program]
    if others:
        yield (f"In {counted(len(others), 'case')} another program solved ({listed(others)}): its own "
               "clock timed the solve, ours what it leaves to us.")
    again = [row for row in timed if row.repetitions > 1]
    once = len(timed) - len(again)
    if again:
        yield (f"It is the median of {span(row.repetitions for row in again)} repetitions"
               + (f"; {counted(once, 'case')} had one" if once else "") + ".")
    else:
        yield "Every case was timed once, so nothing is known of the scatter of its time."
    yield from intervals(again)
    yield ("Each case ran in a process of its own; errors, memory and times were taken in separate "
           "runs of it" + (" (of long solves, and in studies of stability, in one)" if once else "") + ".")
    turns = Counter(context_of(row)["interleaved"] for row in again)
    if turns["yes"]:
        yield (f"The repetitions of {'all' if len(turns) == 1 else turns['yes']} cases came in random "
               "turn with those of the same scene's others.")


def intervals(again: list[Row]) -> Iterator[str]:
    with_ends = [row for row in again if row.repetitions >= FEWEST_FOR_INTERVAL]
    if with_ends:
        yield (f"{listed_share(len(with_ends), again)} at least {FEWEST_FOR_INTERVAL} samples, and "
               "with them a 95 % confidence interval of the median from order statistics (Le Boudec "
               "2010, theorem 2.1), which covers what changes within a run, not between runs.")
    for asked, own in sorted(grouped(again, lambda row: context_of(row)["precision"]).items()):
        share = SHARE.of_text(asked)
        if SHARE.accepts(share):
            yield (f"{listed_share(len(own), again, 'was', 'were')} repeated until both ends of that "
                   f"interval were within {percent(share)} of the median, or a limit was reached; "
                   f"{sum(is_known_to(share, row) for row in own)} of {len(own)} became so precise.")


def is_known_to(share: float, row: Row) -> bool:
    return row.time_ci_low_s is not None and max(
        row.time_s - row.time_ci_low_s, row.time_ci_high_s - row.time_s) <= share * row.time_s


def listed_share(count: int, of: list[Row], one: str = "has", many: str = "have") -> str:
    if count == len(of):
        return f"Every such case {one}"
    return f"{count} of {len(of)} such cases {many if count > 1 else one}"


def noise(rows: list[Row]) -> Iterator[str]:
    samples: list[float] = []  # over the median of their machine
    for own in grouped(rows, lambda row: context_of(row)["cpu"]).values():
        of_machine = list(chain.from_iterable(row.noise_kernel_samples_s or () for row in own))
        samples += list(np.array(of_machine) / np.median(of_machine)) if of_machine else []
    if samples:
        spread = np.median(np.abs(np.array(samples) - 1))
        yield ("A fixed loop, timed before and after every case, scattered by "
               f"{percent(spread)} (median absolute deviation over median of {len(samples)} times).")
    for share in sorted({row.retry_noisy for row in rows if row.retry_noisy}):
        own = [row for row in rows if row.retry_noisy == share and row.noise_attempts]
        again = sum(row.noise_attempts > 1 for row in own)
        yield (f"A case around which that loop was slower or scattered by more than {percent(share)} was "
               f"measured again, up to three times: {again} of {len(own)} were, and "
               f"{sum(row.noisy for row in own)} never had a quiet attempt.")
    told = (NOT_NEGATIVE.of_text(context_of(row)["load_1min_at_start"]) for row in rows)
    loads = list(filter(NOT_NEGATIVE.accepts, told))
    if loads:
        yield ("The machine's load in the minute before a run began was "
               + " to ".join(dict.fromkeys(f"{end(loads):.2f}" for end in (min, max))) + ".")


def memory(rows: list[Row]) -> Iterator[str]:
    known = [row for row in rows if row.peak_heap_bytes]
    if known:
        yield ("Memory is the highest heap during one solve, its blocks and result included, counted "
               "at the allocator, libraries included"
               + (f" ({len(known)} of {len(rows)} cases have it)." if len(known) < len(rows)
                  else "."))


def errors(rows: list[Row]) -> Iterator[str]:
    judged = [row for row in rows if row.error_force is not None or row.error_stress is not None]
    if judged:
        known = [row.reference_error for row in judged if row.reference_error is not None]
        told = "" if len(known) == len(judged) else f" in the {len(known)} cases that report it"
        yield ("Errors are of the algebra, not of the mesh: relative, in the energy norms ∫ σ:C:σ of "
               "stresses and FᵀDF of contact forces, against a reference solution of the same discrete "
               "problem, by hybridized elements and refined in long double"
               + (f", whose own error is by its estimate at most {max(known):.1e}{told}" if known
                  else "") + ".")
        yield ("They, equilibrium and the contact law are judged by a verifier that no solver calls.")
    if any(row.in_displacements for row in rows):
        yield ("Methods in displacements solve another discrete problem and are judged by the error of "
               "the mesh alone.")
    told = targets(rows)
    if told:
        yield f"A case is ok if its errors and residuals are at most {' or '.join(told)}."
    yield from stops(rows)


def is_turned(row: Row) -> bool:
    return row.points == "accuracy" and bool(row.knob)


def stops(rows: list[Row]) -> Iterator[str]:
    turned = [row for row in rows if is_turned(row)]
    ended = Counter(row.stop for row in rows if row.iterative and not is_turned(row))
    if ended["target"]:
        yield ("Iterative methods were tightened towards that by their own estimates"
               + (f" ({counted(ended['target'], 'case')}) or ended by the paper's stops "
                  f"({ended['paper']})." if ended["paper"] else "."))
    elif ended["paper"]:
        yield "Iterative methods ended by the paper's own stops, whatever error they leave."
    if turned:
        yield (f"In {counted(len(turned), 'case')} the accuracy was set on purpose, by "
               f"{' or '.join(sorted({row.knob for row in turned}))}.")


PARTS: tuple[Callable[[list[Row]], Iterator[str]], ...] = (
    cases, machines_and_programs, times, search, noise, memory, errors)


def paragraph(rows: list[Row]) -> str:
    return ("# How this was measured\n\n" + " ".join(chain.from_iterable(part(rows) for part in PARTS))
            + "\n")
