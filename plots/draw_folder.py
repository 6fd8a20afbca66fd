"""What a results folder has, drawn: fields by gallery.py, contact problems without a body by
contact_profiles.py, the answer of `bench solve` by part.py, all other records by figures.py.
./run figures calls it."""
import argparse
import subprocess
import sys
import threading
from pathlib import Path

import command
from records import RecordsError, is_without_body, points_of, read_lines

RECORDS = ("records.jsonl", "records.jsonl.gz", "results.csv")


def is_part(folder: Path) -> bool:
    """What `bench solve` wrote last: after its records."""
    part, lines = folder / "part.json", folder / "records.jsonl"
    return part.exists() and (not lines.exists() or part.stat().st_mtime_ns >= lines.stat().st_mtime_ns)


def drawing_programs(folder: Path, only: str | None, animate: bool) -> list[str]:
    """With `only` records alone are drawn. Throws RecordsError."""
    if animate and only:
        raise RecordsError("--animate: not together with --only, which draws no fields")
    if animate and not list(folder.glob("fields/*.steps.csv")):
        raise RecordsError(f"--animate: {folder}/fields has no path of load steps (bench --fields with a scene "
                           "that has load_steps)")
    programs = ["gallery.py"] if (folder / "fields").is_dir() and not only else []
    lines = folder / "records.jsonl"
    records = list(read_lines(lines)) if lines.exists() and not only else []
    without_body = [record for record in records if is_without_body(record)]
    has_profiles = any(points_of(record) == "contact" for record in without_body)
    if has_profiles:
        programs.append("contact_profiles.py")
    if any((folder / name).exists() for name in RECORDS) and not (has_profiles and len(without_body) == len(records)):
        programs.append("figures.py")
    if not programs:
        raise RecordsError(f"{folder} has {'no records' if only else 'neither records nor fields/'} "
                           f"(bench --out={folder})")
    return programs


def show_life(folder: Path, done: threading.Event) -> None:
    while not done.wait(10):
        print(f"figures of {folder} are being drawn", file=sys.stderr)


def draw(args: argparse.Namespace) -> None:
    if is_part(args.results) and not args.only and not args.animate:
        import part  # here: others need no matplotlib in this process
        part.make(args)
        return
    status, done = 0, threading.Event()
    programs = drawing_programs(args.results, args.only, args.animate)
    threading.Thread(target=show_life, args=(args.results, done), daemon=True).start()
    for program in programs:
        options = ["--vector"] * args.vector
        options += ["--animate"] * (args.animate and program == "gallery.py")
        options += [f"--only={args.only}"] * bool(args.only)
        ran = subprocess.run([sys.executable, Path(__file__).with_name(program), *options, "--", args.results],
                             stdout=subprocess.PIPE, text=True, check=False)
        status = status or ran.returncode
        if not args.quiet:
            print(ran.stdout, end="", flush=True)
    done.set()
    if args.quiet and status == 0:
        print(f"figures in {args.results}/figures")
    sys.exit(status)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=Path, nargs="?", default=Path("results/latest"), metavar="RESULTS_DIR",
                        help="a results folder; default: results/latest")
    parser.add_argument("--only", metavar="GLOB,...", help="of its records these figures and tables")
    parser.add_argument("--animate", action="store_true", help="also a .gif of every path of load steps")
    parser.add_argument("--html", action="store_true", help="of a solve also one page, part.html")
    parser.add_argument("--vector", action="store_true", help="each figure also as .svg and .pdf")
    parser.add_argument("--quiet", action="store_true", help=argparse.SUPPRESS)  # after bench


def main() -> None:
    command.run(__doc__, add_arguments, draw, "a folder to write to")


if __name__ == "__main__":
    main()
