"""Makes what results/ holds anew, unattended, from one revision (reproduce.toml says what).

    reproduce.py [--only=PART,...] [--work=DIR] [--dry-run | --quick [--program=FILE] | --install]

The revision of HEAD is cloned into DIR/source, built there and measured: what is changed beside it
meanwhile changes no record. Figures are drawn by the tree that this file is in. A second call goes
on where the first one ended, with the same revision. --dry-run prints the forecast. --quick measures
a thin selection with the program as it is and draws every figure from it. --install puts what is
complete into results/ and rewrites the numbers that README.md and docs/ quote.

Exit status: 0 complete; 1 some part is not; 2 wrong usage, or what is there cannot be gone on with.
"""
from __future__ import annotations

import argparse
import fnmatch
import gzip
import json
import os
import re
import shutil
import subprocess
import sys
import time
import tomllib
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parent
FORECAST = re.compile(r"^the run: about (.+?)(?:,|;)", re.MULTILINE)
LARGE = 4 << 20  # bytes
SECONDS = {"h": 3600, "min": 60, "s": 1, "ms": 1e-3, "µs": 1e-6}


class Refused(Exception):
    """One line: what, and what is allowed."""


@dataclass(frozen=True)
class Part:
    name: str
    shows: str
    runs: list[str]
    figures: list[str]
    nights: int = 0
    claims: bool = False
    peers: bool = False


def parts_of(recipe: Path, quick: bool) -> list[Part]:
    runs, nights = ("quick", "quick_nights") if quick else ("runs", "nights")
    return [Part(name, entry["shows"], entry[runs], entry.get("figures", []), entry.get(nights, 0),
                 entry.get("claims", False), entry.get("peers", False) and not quick)
            for name, entry in tomllib.loads(recipe.read_text(encoding="utf-8")).items()]


def chosen(parts: list[Part], only: str | None) -> list[Part]:
    if only is None:
        return parts
    names = [part.name for part in parts]
    for word in only.split(","):
        if not fnmatch.filter(names, word):
            raise Refused(f"--only: '{word}' is no part (allowed: {', '.join(names)})")
    return [part for part in parts
            if any(fnmatch.fnmatch(part.name, word) for word in only.split(","))]


def seconds_of(words: str) -> float:
    """'1 h 53 min' -> 6780."""
    found = re.findall(r"([\d.]+) (h|min|s|ms|µs)\b", words)
    return sum(float(number) * SECONDS[unit] for number, unit in found)


def clock(seconds: float) -> str:
    minutes = round(seconds / 60)
    return f"{minutes // 60} h {minutes % 60:02} min" if minutes >= 60 else \
        f"{minutes} min" if minutes else f"{seconds:.0f} s"


def call(*command: object, cwd: Path, **more: object) -> subprocess.CompletedProcess:
    return subprocess.run(list(map(str, command)), cwd=cwd, check=False, **more)


def output_of(*command: object, cwd: Path) -> str:
    ran = call(*command, cwd=cwd, capture_output=True, text=True)
    if ran.returncode:
        raise Refused(f"{' '.join(map(str, command))}: {ran.stderr.strip()}")
    return ran.stdout.strip()


class Workshop:
    """Where it is measured: a source tree with its program, and a folder of runs.

    A thin selection is measured in any noise, and from its beginning.
    """

    def __init__(self, work: Path, source: Path, program: Path | None = None,
                 thin: bool = False) -> None:
        self.work, self.source, self.thin = work, source, thin
        self.bench = program or source / "build/release/bench/bench"

    def folder(self, part: Part, run: int | None = None) -> Path:
        """Of one of its runs, or of the whole."""
        return self.work / "runs" / part.name / str(run) if run is not None else \
            self.work / "results" / part.name

    def log(self, **what: object) -> None:
        line = {"at": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), **what}
        with open(self.work / "log.jsonl", "a", encoding="utf-8") as file:
            print(json.dumps(line, ensure_ascii=False), file=file)
        print(*(f"{key} {value}" for key, value in what.items()), sep=", ", flush=True)


def build(source: Path, peers: bool) -> None:
    wanted = [["bench", "--list"], ["meshgen", "--help"]] + ([["peers"]] if peers else [])
    for command in wanted:
        ran = call(source / "run", *command, cwd=source, stdout=subprocess.DEVNULL)
        if ran.returncode:
            raise Refused(f"./run {command[0]} ended with {ran.returncode}")


def pinned(work: Path) -> Path:
    """A clone of HEAD, or of the revision that was begun with."""
    source = work / "source"
    if source.exists():
        return source
    if output_of("git", "status", "--porcelain", "--untracked-files=no", cwd=PROJECT):
        raise Refused("the tree has changes that are not committed (allowed: a clean tree)")
    work.mkdir(parents=True, exist_ok=True)
    output_of("git", "clone", "--quiet", PROJECT, source, cwd=work)
    return source


def forecast(shop: Workshop, part: Part, run: str) -> tuple[float | None, str]:
    """Seconds, and a word: where meshes or other programs are made only when it runs, nothing is known."""
    if "--adapt" in run or "=adapted" in run:
        return None, "not known: its meshes are made on the way"
    if "--external" in run and not (shop.source / "build/peers").exists():
        return None, "not known: ./run peers builds its programs when it is measured"
    ran = call(shop.bench, *run.split(), "--dry-run", f"--out={HERE / part.name}", cwd=shop.source,
               capture_output=True, text=True)
    if ran.returncode:
        raise Refused(ran.stderr.strip())
    words = FORECAST.search(ran.stdout)
    return (seconds_of(words[1]), words[1]) if words else (None, "not known")


def print_forecast(shop: Workshop, parts: list[Part]) -> None:
    whole = 0.0
    for part in parts:
        print(f"{part.name}: {part.shows}")
        if part.nights:
            print(f"  {part.nights} nights of bench track {part.runs[0]}")
            continue
        for run in part.runs:
            seconds, words = forecast(shop, part, run)
            whole += seconds or 0
            print(f"  bench {run}\n    {words}")
    print(f"in all about {clock(whole)}, and what is not known")


def measure(shop: Workshop, part: Part, number: int, options: str) -> bool:
    """Whether the run is complete: its cases may have failed, bench may not."""
    out = shop.folder(part, number)
    done = out / "complete"
    if done.exists():
        return True
    shop.log(part=part.name, run=number, begins=options)
    start = time.monotonic()
    out.mkdir(parents=True, exist_ok=True)
    more = [] if shop.thin else ["--resume"]
    if not shop.thin and "--retry-noisy" not in options:
        more.append("--retry-noisy")
    with open(out / "printed.txt", "a", encoding="utf-8") as printed:
        code = call(shop.bench, *options.split(), *more, f"--out={out}", cwd=shop.source,
                    stdin=subprocess.DEVNULL, stdout=printed, stderr=subprocess.STDOUT).returncode
    shop.log(part=part.name, run=number, exit=code, wall_s=round(time.monotonic() - start, 1))
    if code in (0, 1) and (out / "records.jsonl").exists():
        done.touch()
    return done.exists()


def nights_of(history: Path) -> int:
    return len(list((history / "nights").glob("*.json")))


def night(shop: Workshop, part: Part) -> bool:
    history = shop.folder(part)
    history.mkdir(parents=True, exist_ok=True)
    while (there := nights_of(history)) < part.nights:
        code = call(shop.bench, "track", *part.runs[0].split(), f"--history={history}",
                    cwd=shop.source, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL).returncode
        shop.log(part=part.name, night=there + 1, exit=code)
        if code not in (0, 1):
            return False
    return True


def join(shop: Workshop, part: Part) -> None:
    """Its runs become one results folder, with its figures and claims, without the meshes that --adapt
    made: a run makes them again."""
    runs = [shop.folder(part, k) for k in range(1, len(part.runs) + 1)]
    whole = shop.folder(part)
    shutil.rmtree(whole, ignore_errors=True)
    output_of(shop.bench, "merge", "--runs", *runs, f"--out={whole}", cwd=shop.source)
    shutil.rmtree(whole / "meshes", ignore_errors=True)
    for run in runs:
        if (run / "programs").is_dir():
            shutil.copytree(run / "programs", whole / "programs", dirs_exist_ok=True)
    if part.figures:
        draw(whole, part)
    if part.claims:
        for stop, name in (("target", "claims.md"), ("paper", "claims_paper_stop.md")):
            output_of(shop.bench, "claims", part.name, f"--stop={stop}", f"--out={whole / name}",
                      cwd=whole.parent)  # it names the folder as it was given


def draw(whole: Path, part: Part) -> None:
    """The figures that the part is for, and what was said of them."""
    ran = call(PROJECT / "run", "figures", whole, f"--only={','.join(part.figures)}", cwd=PROJECT,
               capture_output=True, text=True)
    figures = whole / "figures"
    figures.mkdir(exist_ok=True)
    said = (ran.stdout + ran.stderr).replace(f"{whole}/", "")
    (figures / "drawn.txt").write_text(said, encoding="utf-8")


def missing(shop: Workshop, part: Part) -> list[str]:
    """What it has not yet: nights, runs, figures."""
    if part.nights:
        lacks = part.nights - nights_of(shop.folder(part))
        return [f"{lacks} nights"] if lacks > 0 else []
    runs = [f"run {k}" for k in range(1, len(part.runs) + 1)
            if not (shop.folder(part, k) / "complete").exists()]
    if not (shop.folder(part) / "records.jsonl").exists():
        runs.append("its runs joined")
    drawn = [path.stem for path in (shop.folder(part) / "figures").glob("*")
             if path.suffix in (".png", ".csv", ".md")]
    return runs + [glob for glob in part.figures if not fnmatch.filter(drawn, glob)]


def make(shop: Workshop, part: Part) -> bool:
    """Whether all of it is there; one part's failure leaves the others alone."""
    if part.nights:
        return night(shop, part)
    complete = [measure(shop, part, k, run) for k, run in enumerate(part.runs, 1)]
    try:
        if all(complete):
            join(shop, part)
    except Refused as why:
        shop.log(part=part.name, refused=str(why))
        return False
    lacks = missing(shop, part)
    if lacks:
        shop.log(part=part.name, lacks=", ".join(lacks))
    return not lacks


def records_of(folder: Path) -> list[dict]:
    files = [folder / name for name in ("records.jsonl", "records.jsonl.gz", "latest/records.jsonl")]
    texts = [gzip.decompress(file.read_bytes()) if file.suffix == ".gz" else file.read_bytes()
             for file in files if file.exists()]
    return [json.loads(line) for text in texts for line in text.splitlines()]


def pack(folder: Path) -> None:
    """Many records, for the sake of who clones: gzip takes a fifteenth of their space."""
    lines = folder / "records.jsonl"
    if lines.exists() and lines.stat().st_size > LARGE:
        packed = gzip.compress(lines.read_bytes(), mtime=0)  # the same for the same records
        (folder / "records.jsonl.gz").write_bytes(packed)
        lines.unlink()


def row_of(folder: Path, part: Part) -> str | None:
    """Of a table: what was measured, when, how it ended, with which revision."""
    records = records_of(folder)
    if not records:
        return None
    ended = Counter(record["status"] for record in records)
    contexts = [record["context"] for record in records]
    revisions = {context["git_revision"][:10] + "+" * (context["git_dirty"] != "no")
                 for context in contexts}
    return (f"| [{part.name}]({part.name}) | {part.shows} | {len(records)} | "
            f"{', '.join(f'{n} {status}' for status, n in ended.most_common())} | "
            f"{sum(bool(record.get('noisy')) for record in records)} | "
            f"{min(context['date'] for context in contexts)} | {', '.join(sorted(revisions))} |")


def table(rows: Iterable[str | None]) -> list[str]:
    return ["| part | shows | cases | ended | noisy | begun | revision |", "|---|---|---|---|---|---|---|",
            *(row for row in rows if row)]


def install(shop: Workshop, parts: list[Part], every: list[Part]) -> None:
    """Replaces the folders in results/ of those parts that are complete."""
    said = HERE / "reproduced.md"
    kept = re.findall(r"^\| \[([\w-]+)\]", said.read_text(encoding="utf-8"), re.MULTILINE) \
        if said.exists() else []
    for part in parts:
        lacks = missing(shop, part)
        if lacks:
            print(f"{part.name}: left as it is in results/, {', '.join(lacks)} missing")
            continue
        new, old = HERE / f".{part.name}.new", HERE / f".{part.name}.old"
        shutil.rmtree(new, ignore_errors=True)
        shutil.copytree(shop.folder(part), new, ignore=shutil.ignore_patterns("results.json"))
        pack(new)
        if (HERE / part.name).exists():
            os.replace(HERE / part.name, old)
        os.replace(new, HERE / part.name)
        shutil.rmtree(old, ignore_errors=True)
        kept.append(part.name)
        print(f"{part.name}: in results/")
    rows = table(row_of(HERE / part.name, part) for part in every if part.name in kept)
    said.write_text("\n".join(["# What was measured, by `./run reproduce`", "", *rows, ""]),
                    encoding="utf-8")
    output_of(sys.executable, PROJECT / "plots/quoted_numbers.py", "--write", cwd=PROJECT)
    print("look at git diff, then commit")


def run(args: argparse.Namespace) -> int:
    if args.program and not args.quick:
        raise Refused("--program: only with --quick (otherwise the program is of one revision)")
    every = parts_of(HERE / "reproduce.toml", args.quick)
    parts = chosen(every, args.only)
    if args.quick:
        work = args.work or PROJECT / "build/reproduce-quick"
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        shop = Workshop(work, PROJECT, args.program, thin=True)
    else:
        work = args.work or PROJECT / "build/reproduce"
        source = PROJECT if args.dry_run and not (work / "source").exists() else pinned(work)
        shop = Workshop(work, source)
    if args.install:
        install(shop, parts, every)
        return 0
    if not args.program:
        build(shop.source, any(part.peers for part in parts) and not args.dry_run)
    if args.dry_run:
        print_forecast(shop, parts)
        return 0
    incomplete = [part.name for part in parts if not make(shop, part)]
    print(*table(row_of(shop.folder(part), part) for part in parts), sep="\n")
    print(f"not complete: {', '.join(incomplete)}" if incomplete else
          f"complete, in {shop.work / 'results'}")
    return 1 if incomplete else 0


def main() -> int:
    parser = argparse.ArgumentParser(prog="./run reproduce", usage="./run reproduce [options]",
                                     description=__doc__.split("\n\n")[2].replace("\n", " "))
    parser.add_argument("--only", metavar="PART,...", help="these parts of results/, names or globs")
    parser.add_argument("--work", metavar="DIR", type=lambda path: Path(path).absolute(),
                        help="where it is measured (default: build/reproduce)")
    parser.add_argument("--program", metavar="FILE", type=lambda path: Path(path).absolute(),
                        help="with --quick: a bench that is built already")
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--dry-run", action="store_true", help="runs and their forecast, and end")
    kind.add_argument("--quick", action="store_true",
                      help="a thin selection that draws every figure, a few minutes")
    kind.add_argument("--install", action="store_true",
                      help="put what is complete into results/, rewrite the numbers quoted")
    try:
        return run(parser.parse_args())
    except (Refused, OSError) as wrong:
        print(f"reproduce: {wrong}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
