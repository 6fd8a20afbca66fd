"""Makes what results/ holds anew, unattended, from one revision (reproduce.toml says what).

    reproduce.py [--only=PART,...] [--revision=REV] [--work=DIR]
                 [--noisy | --dry-run | --quick [--program=FILE] | --install | --check]

The revision REV (default: HEAD) is cloned into DIR/source, built there and measured: changes to other
trees meanwhile change no record. Figures are drawn by the tree that this file is in, which also lists the
parts. A second call continues where the first one ended, with the same revision; another machine
continues with --revision. --noisy measures the cases again that were noisy. --dry-run prints the forecast.
--quick measures a thin selection with the program as it is and draws every figure from it. --install puts
what is complete into results/ and rewrites the numbers that README.md and docs/ quote. --check prints
which revision the records in results/ come from.

Exit status: 0 complete; 1 some part is not, or --check found several revisions; 2 wrong usage, or what is
there cannot be continued.
"""
from __future__ import annotations

import argparse
import shutil
import signal
import sys
from pathlib import Path

from installing import check, install, row_of, table
from measuring import Workshop, build, forget_noisy, make, pinned, print_forecast
from messages import messages_escaped
from parts import PROJECT, RESULTS, Refused, chosen, commit_of, parts_of


def make_empty(work: Path) -> None:
    """For --quick, which always begins anew."""
    is_of_quick = (work / "log.jsonl").exists() and not (work / "source").exists()
    if work.exists() and not is_of_quick and (not work.is_dir() or any(work.iterdir())):
        raise Refused(f"--work: {work}: is not empty (allowed with --quick: a new folder, or one of --quick)")
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)


def run(args: argparse.Namespace) -> int:
    if args.program and not args.quick:
        raise Refused("--program: only with --quick (otherwise the program is of one revision)")
    if args.revision and args.quick:
        raise Refused("--revision: not with --quick, which measures the program as it is")
    every = parts_of(RESULTS / "reproduce.toml", args.quick)
    parts = chosen(every, args.only)
    if args.check:
        return check(parts, every, args.revision)
    if args.quick:
        work = args.work or PROJECT / "build/reproduce-quick"
        make_empty(work)
        shop = Workshop(work, PROJECT, args.program, thin=True)
    else:
        work = args.work or PROJECT / "build/reproduce"
        if args.dry_run and not (work / "source").exists():
            source = PROJECT
            commit_of(args.revision or "HEAD")
        else:
            source = pinned(work, args.revision)
        shop = Workshop(work, source)
    if args.install:
        install(shop, parts, every)
        return 0
    if not args.program:
        build(shop.source, any(part.peers for part in parts) and not args.dry_run)
    if args.dry_run:
        print_forecast(shop, parts)
        return 0
    incomplete = []
    for part in parts:
        if args.noisy:
            forget_noisy(shop, part)
        if not make(shop, part):
            incomplete.append(part.name)
    print(*table(row_of(shop.folder(part), part) for part in parts), sep="\n")
    print(f"not complete: {', '.join(incomplete)}" if incomplete else
          f"complete, in {shop.work / 'results'}")
    return 1 if incomplete else 0


def main() -> int:
    parser = argparse.ArgumentParser(prog="./run reproduce", usage="./run reproduce [options]",
                                     description=__doc__.split("\n\n")[2].replace("\n", " "))
    parser.add_argument("--only", metavar="PART,...", help="these parts of results/, names or globs")
    parser.add_argument("--revision", metavar="REV", help="what is built and measured (default: what DIR has, "
                        "or else HEAD); with --check: what all records should be of")
    parser.add_argument("--work", metavar="DIR", type=lambda path: Path(path).absolute(),
                        help="where it is measured (default: build/reproduce)")
    parser.add_argument("--program", metavar="FILE", type=lambda path: Path(path).absolute(),
                        help="with --quick: a bench that is built already")
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--noisy", action="store_true",
                      help="measure noisy cases of complete runs again, and continue the others")
    kind.add_argument("--dry-run", action="store_true", help="runs and their forecast, and end")
    kind.add_argument("--quick", action="store_true",
                      help="a thin selection that draws every figure, a few minutes")
    kind.add_argument("--install", action="store_true",
                      help="put what is complete into results/, rewrite the numbers quoted")
    kind.add_argument("--check", action="store_true",
                      help="print revision and dates of the records in results/; exit status 1 if revisions differ")
    with messages_escaped():
        try:
            return run(parser.parse_args())
        except (Refused, OSError) as wrong:
            named = isinstance(wrong, OSError) and wrong.filename
            print(f"reproduce: {wrong.filename}: {wrong.strerror}" if named else f"reproduce: {wrong}", file=sys.stderr)
            return 2
        except KeyboardInterrupt:  # a second call continues
            return 128 + signal.SIGINT


if __name__ == "__main__":
    sys.exit(main())
