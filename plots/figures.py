#!/usr/bin/python3
"""Draws the figures of a run from its records.jsonl, or from its results.csv alone.

    figures.py RESULTS_DIR [--out DIR] [--only GLOB,...] [--vector]

The figures are those that the modules figure/*.py plan: each has a function
drawings(rows), which names them and says which rows they show (../results/README.md lists them).
table1.md, the paper's Tab. 1 next to the run's sizes, comes with the meshes of the catalogue,
budget.csv and budget.md, the least error within a time, with an error study. measured.md says how
the records were measured, in words for a paper. --only draws these of the figures and tables, by
name or glob, and says nothing of the others. --vector writes each
figure also as .svg and .pdf, fonts included.

Figures of an earlier run that these records do not give are removed, unless --only is given; the
folder's list .airybench.made names what the programs made there.

Where there is room for one scene it is `default`, if that is there. A line on stdout says of each
figure what was written, or why not; a last one which cases are in none. Exit 2: wrong input,
or a folder that cannot be written; one line says which, and the files that were there stay.
"""
import argparse
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import matplotlib

import command
from documents import documents_of
from drawing import STYLE, Drawing
from messages import in_figures
from records import Row, read_run, rows_of
from selection import comparable, grouped, has_other_solver
from words import cases_by_reason


# Names of earlier figures, which papers and scripts may use -> that of the figure that shows the same.
EARLIER = {"figure3": "preconditioners", "figure4": "size", "figure5": "size", "all_methods": "size", "growth": "size",
           "work_precision": "error_time_forces", "stop_and_error": "error_time_forces", "pareto": "error_time",
           "overview": "error_time", "degrees": "error_time", "peers_penalty": "error_time", "adaptive": "convergence",
           "stability": "outcomes", "adapted_methods": "outcomes_adapted"}


def under_today(only: str | None) -> str | None:
    """Globs of figures, earlier names replaced: figure4_paper_stop -> size_paper_stop."""
    def today(glob: str) -> str:
        earlier = max((name for name in EARLIER if glob.startswith(name)), key=len, default="")
        rest = glob.removeprefix(earlier)
        return EARLIER[earlier] + ("" if earlier == "work_precision" else rest) if earlier and rest[:1] in ("", "_") else glob
    return only and ",".join(map(today, only.split(",")))


def drawings_of(rows: list[Row]) -> list[Drawing]:
    rows = comparable(rows)
    modules = sorted(path.stem for path in Path(__file__).parent.glob("figure/[!.]*.py"))  # .#x.py: an editor's
    return [drawing for name in modules
            for drawing in import_module(f"figure.{name}").drawings(rows)]


def why_undrawn(row: Row, drawn: list[Row]) -> str:
    if has_other_solver(row) and not all(map(has_other_solver, drawn)):
        return f"contact law by {row.contact_solver}"
    scenes = {other.scene for other in drawn if other.study == row.study}
    if row.scene not in scenes:
        return f"scene {row.scene}"
    same = next((other for other in drawn if other.general_name == row.general_name
                 and (other.mesh, other.stop) == (row.mesh, row.stop)), None)
    return f"the same method as {same.method}" if same else "no figure of its kind has room"


def listed(rows: list[Row], drawn: list[Row]) -> str:
    lines = {row.line for row in drawn}
    reasons = grouped((row for row in rows if row.line not in lines),
                      lambda row: why_undrawn(row, drawn))
    return cases_by_reason({why: list(dict.fromkeys(f"{row.method} on {row.mesh}" for row in own))
                            for why, own in reasons.items()})


def draw_all(rows: list[Row], out: Path, only: str | None = None, vector: bool = False) -> None:
    report, drawn, made = [], [], command.Made(out, "figures")
    writers: dict[str, Callable[[Path], object]] = {}
    drawings, documents = drawings_of(rows), documents_of(rows)
    names = command.selected(under_today(only), "figure of these records", [*(drawing.name for drawing in drawings), *list(documents)[:-1]])
    for drawing in drawings:
        if drawing.name not in names:
            continue
        result = drawing.figure()
        if isinstance(result, str):
            old = f"{drawing.name}.png"
            stays = (out / old).exists() and (only is not None or old not in made.earlier())
            report.append(f"{drawing.name}: left out: {result}" + f"; an earlier {old} stays" * stays)
            continue
        drawn += drawing.rows
        own = {drawing.name + suffix: writer for suffix, writer in drawing.writers(result, vector).items()}
        writers |= own
        suffixes = ", ".join(name.removeprefix(drawing.name) for name in own)
        report.append(f"{out / drawing.name}{suffixes}: "
                      f"{len(drawing.rows)} cases")
    for name, texts in documents.items():
        if name in names or only is None:
            report.append(f"{out / name}{', '.join(texts)}")
        if name in names or name == "measured":
            writers |= {name + suffix: command.text_writer(text) for suffix, text in texts.items()}
    out.mkdir(parents=True, exist_ok=True)
    made.replace(writers)
    if only is None and (gone := made.remove_others()):
        report.append(f"removed, of other records: {', '.join(gone)}")
    undrawn = listed(rows, drawn) if only is None else ""
    print(*report, *([f"in no figure: {undrawn}"] if undrawn else []), sep="\n")


def draw(args: argparse.Namespace) -> None:
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(STYLE)
    table = read_run(args.results)
    for name in ("mesh", "scene", "body", "method", "general_name", "family"):
        table[name] = table[name].map(in_figures)
    draw_all(rows_of(table), args.out or args.results / "figures", args.only,
             args.vector)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    command.results_and_out(parser)
    parser.add_argument("--only", metavar="GLOB,...", help="these figures and tables")


def main() -> None:
    command.run(__doc__, add_arguments, draw, "a folder to write to")


if __name__ == "__main__":
    main()
