"""Makes what results/ holds anew, unattended, from one revision (reproduce.toml says what).

    reproduce.py [--only=PART,...] [--revision=REV] [--work=DIR]
                 [--dry-run | --quick [--program=FILE] | --install | --check]

The revision REV (default: HEAD) is cloned into DIR/source, built there and measured: changes to other
trees meanwhile change no record. Figures are drawn by the tree that this file is in, which also lists the
parts. A second call continues where the first one ended, with the same revision; another machine
continues with --revision. --dry-run prints the forecast. --quick measures a thin selection with the program
as it is and draws every figure from it. --install puts what is complete into results/ and rewrites the
numbers that README.md and docs/ quote. --check prints which revision the records in results/ come from.

Exit status: 0 complete; 1 some part is not, or --check found several revisions; 2 wrong usage, or what is
there cannot be continued.
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
from dataclasses import dataclass, field
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
    pictures: list[str] = field(default_factory=list)
    images: list[str] = field(default_factory=list)
    nights: int = 0
    claims: bool = False
    peers: bool = False


def parts_of(recipe: Path, quick: bool) -> list[Part]:
    runs, nights = ("quick", "quick_nights") if quick else ("runs", "nights")
    return [Part(name, entry["shows"], entry[runs], entry.get("figures", []), entry.get("pictures", []),
                 entry.get("images", []), entry.get(nights, 0), entry.get("claims", False),
                 entry.get("peers", False) and not quick)
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


def commit_of(revision: str) -> str:
    ran = call("git", "rev-parse", "--quiet", "--verify", f"{revision}^{{commit}}", cwd=PROJECT,
               capture_output=True, text=True)
    if ran.returncode:
        raise Refused(f"--revision: '{revision}' is none of this repository (allowed: a commit, tag or branch)")
    return ran.stdout.strip()


def pinned(work: Path, revision: str | None) -> Path:
    """A clone of the revision, by default of the one that was begun with, or of HEAD."""
    source = work / "source"
    if source.exists():
        there = output_of("git", "rev-parse", "HEAD", cwd=source)
        if revision and commit_of(revision) != there:
            raise Refused(f"--revision: {source} has {there[:10]}, not {revision} (allowed: "
                          f"--revision={there[:10]}, or another --work)")
        return source
    if not revision and output_of("git", "status", "--porcelain", "--untracked-files=no", cwd=PROJECT):
        raise Refused("the tree has changes that are not committed (allowed: a clean tree, or --revision)")
    wanted = commit_of(revision or "HEAD")
    work.mkdir(parents=True, exist_ok=True)
    new = work / "source.new"  # a clone that was interrupted is no source
    shutil.rmtree(new, ignore_errors=True)
    output_of("git", "clone", "--quiet", "--no-checkout", PROJECT, new, cwd=work)
    output_of("git", "checkout", "--quiet", "--detach", wanted, cwd=new)
    os.replace(new, source)
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
    made and without fields: a run makes them again."""
    runs = [shop.folder(part, k) for k in range(1, len(part.runs) + 1)]
    whole = shop.folder(part)
    shutil.rmtree(whole, ignore_errors=True)
    output_of(shop.bench, "merge", "--runs", *runs, f"--out={whole}", cwd=shop.source)
    shutil.rmtree(whole / "meshes", ignore_errors=True)
    for run in runs:
        if (run / "programs").is_dir():
            shutil.copytree(run / "programs", whole / "programs", dirs_exist_ok=True)
        if part.pictures and (run / "fields").is_dir():
            shutil.copytree(run / "fields", whole / "fields", dirs_exist_ok=True)
    draw(whole, part)
    shutil.rmtree(whole / "fields", ignore_errors=True)
    if part.claims:
        for stop, name in (("target", "claims.md"), ("paper", "claims_paper_stop.md")):
            output_of(shop.bench, "claims", part.name, f"--stop={stop}", f"--out={whole / name}",
                      cwd=whole.parent)  # it names the folder as it was given


def draw(whole: Path, part: Part) -> None:
    """The figures and pictures that the part is for, and what was said of them."""
    programs = [([PROJECT / "run", "figures"], part.figures),
                ([sys.executable, PROJECT / "plots/gallery.py"], part.pictures)]
    drawn = [call(*program, whole, f"--only={','.join(globs)}", cwd=PROJECT, capture_output=True, text=True)
             for program, globs in programs if globs]
    if drawn:
        figures = whole / "figures"
        figures.mkdir(exist_ok=True)
        said = "".join(ran.stdout + ran.stderr for ran in drawn).replace(f"{whole}/", "")
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
    return runs + [glob for glob in part.figures + part.pictures if not fnmatch.filter(drawn, glob)]


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


def contexts_of(folder: Path) -> list[dict]:
    """Where and when: of every record, and of every night."""
    nights = [json.loads(file.read_bytes()) for file in sorted((folder / "nights").glob("*.json"))]
    return [entry["context"] for entry in records_of(folder) + nights]


def revisions_of(contexts: list[dict]) -> list[str]:
    """With a +: and changes that were not committed."""
    return sorted({context["git_revision"][:10] + "+" * (context["git_dirty"] != "no") for context in contexts})


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
    contexts = contexts_of(folder)
    return (f"| [{part.name}]({part.name}) | {part.shows} | {len(records)} | "
            f"{', '.join(f'{n} {status}' for status, n in ended.most_common())} | "
            f"{sum(bool(record.get('noisy')) for record in records)} | "
            f"{min(context['date'] for context in contexts)} | {', '.join(revisions_of(contexts))} |")


def table(rows: Iterable[str | None]) -> list[str]:
    return ["| part | shows | cases | ended | noisy | begun | revision |", "|---|---|---|---|---|---|---|",
            *(row for row in rows if row)]


def reproduced() -> list[str]:
    """Names of the parts that --install put into results/, some time."""
    said = HERE / "reproduced.md"
    return re.findall(r"^\| \[([\w-]+)\]", said.read_text(encoding="utf-8"), re.MULTILINE) \
        if said.exists() else []


def reproduced_text(parts: Iterable[Part]) -> str:
    rows = table(row_of(HERE / part.name, part) for part in parts)
    return "\n".join(["# What was measured, by `./run reproduce`", "", *rows, ""])


def images_of(part: Part) -> list[tuple[Path, Path]]:
    """Figures in results/, and their copies in docs/."""
    return [(HERE / part.name / "figures" / f"{name}.png", HERE.parent / "docs/images" / f"{name}.png")
            for name in part.images]


def why_not(shop: Workshop, part: Part) -> str:
    """What keeps the part out of results/; empty: nothing."""
    if lacks := missing(shop, part):
        return f"{', '.join(lacks)} missing"
    revisions = revisions_of(contexts_of(shop.folder(part)))
    if len(revisions) > 1 or any(revision.endswith("+") for revision in revisions):
        return f"its records come from {', '.join(revisions)} (allowed: one committed revision)"
    return ""


def install(shop: Workshop, parts: list[Part], every: list[Part]) -> None:
    """Replaces the folders in results/ of those parts that are complete."""
    kept = reproduced()
    for part in parts:
        if reason := why_not(shop, part):
            print(f"{part.name}: left as it is in results/, {reason}")
            continue
        new, old = HERE / f".{part.name}.new", HERE / f".{part.name}.old"
        shutil.rmtree(new, ignore_errors=True)
        shutil.copytree(shop.folder(part), new, ignore=shutil.ignore_patterns("results.json"))
        pack(new)
        if (HERE / part.name).exists():
            os.replace(HERE / part.name, old)
        os.replace(new, HERE / part.name)
        shutil.rmtree(old, ignore_errors=True)
        for figure, copy in images_of(part):
            shutil.copyfile(figure, copy)
        kept.append(part.name)
        print(f"{part.name}: in results/")
    installed = [part for part in every if part.name in kept]
    (HERE / "reproduced.md").write_text(reproduced_text(installed), encoding="utf-8")
    output_of(sys.executable, PROJECT / "plots/quoted_numbers.py", "--write", cwd=PROJECT)
    revisions = revisions_of([context for part in installed for context in contexts_of(HERE / part.name)])
    if len(revisions) > 1:  # no reason to refuse: parts come one after the other
        print(f"results/ has records of {len(revisions)} revisions now: {', '.join(revisions)} "
              "(--check: which parts)")
    print("look at git diff, then commit")


def without_part(every: list[Part]) -> list[str]:
    """Folders with committed records that reproduce.toml does not name."""
    tracked = output_of("git", "ls-files", "--", "*records.jsonl*", "*/nights/*", cwd=HERE).splitlines()
    return sorted({file.split("/")[0] for file in tracked} - {part.name for part in every})


def out_of_date(every: list[Part]) -> list[str]:
    """What --install writes and is not of the records that are there."""
    said = HERE / "reproduced.md"
    installed = [part for part in every if part.name in reproduced()]
    old = [] if said.exists() and said.read_text(encoding="utf-8") == reproduced_text(installed) else [said]
    old += [copy for part in installed for figure, copy in images_of(part)
            if not copy.exists() or copy.read_bytes() != figure.read_bytes()]
    return [f"{file.relative_to(HERE.parent)}: not of these records (--install writes it)" for file in old]


def check(parts: list[Part], every: list[Part], revision: str | None) -> int:
    """Prints where the records of each part come from; 1: not from one committed revision, or not all there."""
    wanted = commit_of(revision)[:10] if revision else None
    others = without_part(every) if parts == every else []
    contexts = {name: contexts_of(HERE / name) for name in [*(part.name for part in parts), *others]}
    rows = [("part", "records", "first run", "last run", "revision")]
    for name, own in contexts.items():
        dates = [context["date"] for context in own] or ["-"]
        rows.append((name, str(len(own)), min(dates), max(dates), ", ".join(revisions_of(own))))
    widths = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        print("  ".join(word.ljust(width) for word, width in zip(row, widths)).rstrip())
    found = revisions_of([context for own in contexts.values() for context in own])
    faults = [f"no records: {name}" for name, own in contexts.items() if not own]
    faults += [f"no part of reproduce.toml: {name}" for name in others]
    faults += [f"changes that were not committed: {one}" for one in found if one.endswith("+")]
    if len(found) > 1:
        faults.append(f"{len(found)} revisions: {', '.join(found)}")
    if wanted and set(found) - {wanted}:
        faults.append(f"not all of --revision={revision}, {wanted}")
    faults += out_of_date(every)
    print(*faults or [f"one revision: {', '.join(found)}"], sep="\n")
    return 1 if faults else 0


def run(args: argparse.Namespace) -> int:
    if args.program and not args.quick:
        raise Refused("--program: only with --quick (otherwise the program is of one revision)")
    if args.revision and args.quick:
        raise Refused("--revision: not with --quick, which measures the program as it is")
    every = parts_of(HERE / "reproduce.toml", args.quick)
    parts = chosen(every, args.only)
    if args.check:
        return check(parts, every, args.revision)
    if args.quick:
        work = args.work or PROJECT / "build/reproduce-quick"
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
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
    incomplete = [part.name for part in parts if not make(shop, part)]
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
    kind.add_argument("--dry-run", action="store_true", help="runs and their forecast, and end")
    kind.add_argument("--quick", action="store_true",
                      help="a thin selection that draws every figure, a few minutes")
    kind.add_argument("--install", action="store_true",
                      help="put what is complete into results/, rewrite the numbers quoted")
    kind.add_argument("--check", action="store_true",
                      help="print revision and dates of the records in results/; exit status 1 if revisions differ")
    try:
        return run(parser.parse_args())
    except (Refused, OSError) as wrong:
        print(f"reproduce: {wrong}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
