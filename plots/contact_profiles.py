#!/usr/bin/python3
"""Draws performance profiles of contact problems, at two precisions.

    bench --problem=FOLDER --study=contact --out=RESULTS_DIR
    contact_profiles.py RESULTS_DIR [--out DIR] [--vector]     contact_table.md; from 2 solvers and
                                                               3 problems on contact_profiles.png
                                                               and .csv

A precision has separate runs that stop there. Of a problem p and a solver s, whose run takes t_ps and leaves
the error e_ps,

    c_ps = t_ps if e_ps <= precision, else infinite;   rho_s(tau) = |{p : c_ps <= tau min_s c_ps}| / P

as in the comparison over FCLIB (Acary, Bremond & Huber 2018, doi:10.1007/978-3-319-75972-2_10). The
error is Siconos' measure of the answer, by bench and not by the solver. The table has the runs to
the higher precision. Exit 2: no such records, or a file that cannot be written.
"""
import argparse
from functools import partial

import matplotlib
import numpy as np
import pandas as pd

from command import Made, results_and_out, run, text_writer
from catalogue import looks_of
from drawing import DPI, COLUMN_WIDTH, PAGE_WIDTH, STYLE, Sheet, for_papers, log_axis, write_small_png
from figure.contact import LOOKS
from figure.profiles import fractions, jumps, ratios
from records import RecordsError, is_without_body, read_lines
from selection import show_seconds
from words import plain

PRECISIONS = (1e-4, 1e-8)
FEWEST_SOLVERS, FEWEST_PROBLEMS = 2, 3

def solver_of(record: dict) -> str:
    program = record["method"].removeprefix("EXTERNAL:")
    return program if program != record["method"] else record["contact_solver"]


def costs_of(records: list[dict], precision: float) -> pd.DataFrame:
    """Problems x solvers, in the order of the records: seconds; infinite: not solved. Of the runs to
    this precision."""
    table = pd.DataFrame(
        {"problem": record["mesh"], "solver": solver_of(record),
         "cost": record["time_s"] if record["knob_value"] == precision and record.get("time_s")
         and record.get("siconos_error") is not None and record["siconos_error"] <= precision
         else np.inf} for record in records)
    wide = table.pivot_table("cost", "problem", "solver", "min", sort=False).fillna(np.inf)
    return wide[list(dict.fromkeys(table.solver))]


def profile_of(costs: pd.DataFrame) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Solver -> factors of the fastest at which its share rises, and the shares there."""
    factors = ratios(costs.to_numpy())
    return {solver: (at, fractions(factors[:, s], at)) for s, solver in enumerate(costs.columns)
            for at in [jumps(factors[:, s])]}


def table_of(records: list[dict]) -> pd.DataFrame:
    return pd.DataFrame([(precision, solver, factor, share) for precision in PRECISIONS
                         for solver, steps in profile_of(costs_of(records, precision)).items()
                         for factor, share in zip(*steps)],
                        columns=["precision", "solver", "factor_of_best", "share_solved"])


def cell_of(record: dict, precision: float) -> str:
    """Its time, or how far it got."""
    error = record.get("siconos_error")
    if record.get("time_s") and error is not None and error <= precision:
        return show_seconds(record["time_s"])
    status = record["status"].replace("_", " ")
    return status if error is None else f"{status}, {error:.0e}"


def worst_of(records: list[dict], precision: float) -> str:
    """The largest natural map and the largest of Siconos' measure among those solved."""
    solved = [record for record in records if record.get("time_s")
              and record.get("siconos_error") is not None and record["siconos_error"] <= precision]
    return ", ".join(f"{max(record[key] for record in solved):.0e}"
                     for key in ("natural_map_residual", "siconos_error")) if solved else ""


def markdown_of(records: list[dict]) -> str:
    precision = min(PRECISIONS)
    records = [record for record in records if record["knob_value"] == precision]
    solvers = list(dict.fromkeys(map(solver_of, records)))
    ours = {solver_of(record) for record in records if record["contact_solver"]}
    costs = costs_of(records, precision)
    lines = [["problem", "W", "rows", *solvers, "theirs / ours", "ours: map, measure",
              "theirs: map, measure"]]
    for problem in costs.index:
        own = [record for record in records if record["mesh"] == problem]
        by_solver = {solver_of(record): cell_of(record, precision) for record in own}
        best = [min((costs.at[problem, s] for s in solvers if (s in ours) == of_ours), default=np.inf)
                for of_ours in (False, True)]
        ratio = np.format_float_positional(
            best[0] / best[1], 2, fractional=False, trim="-") if np.isfinite(best).all() else ""
        lines.append([problem, own[0]["contact_matrix"], str(own[0]["n_c"]),
                      *(by_solver.get(s, "") for s in solvers), ratio,
                      *(worst_of([r for r in own if (solver_of(r) in ours) == of_ours], precision)
                        for of_ours in (True, False))])
    lines.insert(1, ["---"] * len(lines[0]))
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def solvers_and_problems(records: list[dict]) -> tuple[int, int]:
    return len(set(map(solver_of, records))), len({record["mesh"] for record in records})


def draw(records: list[dict], width: float = PAGE_WIDTH) -> Sheet:
    solvers, problems = solvers_and_problems(records)
    programs = [name for record in records if (name := record["method"]).startswith("EXTERNAL:")]
    looks = LOOKS | {name.removeprefix("EXTERNAL:"): look for name, look in
                     looks_of(dict(zip(programs, programs))).items()}
    names = list(dict.fromkeys(map(solver_of, records)))
    sheet = Sheet(width, f"Profiles: {solvers} contact solvers on {problems} problems",
                  "The share of problems that a solver solves within a factor of the fastest "
                  "solver's time. Solved: Siconos' error of the answer is at most the precision, "
                  "whatever the solver says of it. Each precision has its own runs, which stop there. "
                  "Problems that a program does not take count as not solved.", panels=len(PRECISIONS),
                  key=[(plain(name), looks[name].line()) for name in names])
    for axes, precision in zip(sheet.panels, PRECISIONS):
        steps = profile_of(costs_of(records, precision))
        high = 1.2 * max([10.0, *(at[-1] for at, _ in steps.values() if len(at))])
        axes.set(xscale="log", xlim=(1, high), ylim=(0, 1.04), ylabel="share of problems solved",
                 title=f"error at most {precision:.0e}", xlabel="time over that of the fastest solver")
        log_axis(axes.xaxis)
        for solver, (at, share) in steps.items():
            ends = share[-1] if len(share) else 0
            axes.step(np.r_[1, at, high], np.r_[(at[:1] == 1) * share[:1] if len(at) else 0, share, ends],
                      where="post", **looks[solver].line(marker=None, linewidth=1.4))
            axes.plot(at, share, **looks[solver].line(linestyle="none", markersize=4))
    return sheet


def make(args: argparse.Namespace) -> None:
    source = args.results / "records.jsonl"
    records = [record for record in read_lines(source)
               if is_without_body(record) and record.get("knob_value") in PRECISIONS
               and record.get("status") != "skipped"]
    if not records:
        raise RecordsError(f"{source}: no runs to {' or '.join(map(str, PRECISIONS))} of contact "
                           "problems; expected records of bench --problem=... --study=contact")
    out = args.out or args.results / "figures"
    out.mkdir(parents=True, exist_ok=True)
    made = Made(out, "contact_profiles")
    files = {"contact_table.md": text_writer(markdown_of(records))}
    solvers, problems = solvers_and_problems(records)
    with matplotlib.rc_context(STYLE):
        if solvers >= FEWEST_SOLVERS and problems >= FEWEST_PROBLEMS:
            figure = draw(records)
            papers = for_papers(draw(records, COLUMN_WIDTH)) if args.vector else {}
            files |= {f"contact_profiles{suffix}": write for suffix, write in papers.items()}
            files |= {"contact_profiles.png": partial(write_small_png, figure, DPI),
                      "contact_profiles.csv": text_writer(table_of(records).to_csv(index=False)),
                      "contact_profiles.txt": text_writer(figure.caption)}
        else:
            print(f"contact_profiles: left out: {solvers} solvers on {problems} contact problems; "
                  f"expected at least {FEWEST_SOLVERS} on {FEWEST_PROBLEMS}")
        made.replace(files)
    if gone := made.remove_others():
        print(f"removed, of other records: {', '.join(gone)}")


def main() -> None:
    run(__doc__, results_and_out, make, "a file to write")


if __name__ == "__main__":
    main()
