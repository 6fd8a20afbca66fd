"""Clones a revision, builds it and measures parts of results/ there: each run continues where it ended."""
from __future__ import annotations

import fnmatch
import gzip
import json
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

from parts import PROJECT, RESULTS, Part, Refused, call, commit_of, output_of

FORECAST = re.compile(r"^the run: about (.+?)(?:,|;)", re.MULTILINE)
SECONDS = {"h": 3600, "min": 60, "s": 1, "ms": 1e-3, "µs": 1e-6}


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
    wanted = [["bench", "--help"], ["meshgen", "--help"]] + ([["peers"]] if peers else [])
    for command in wanted:
        ran = call(source / "run", *command, cwd=source, stdout=subprocess.DEVNULL)
        if ran.returncode:
            raise Refused(f"./run {command[0]} ended with {ran.returncode}")


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


def seconds_of(words: str) -> float:
    """'1 h 53 min' -> 6780."""
    found = re.findall(r"([\d.]+) (h|min|s|ms|µs)\b", words)
    return sum(float(number) * SECONDS[unit] for number, unit in found)


def clock(seconds: float) -> str:
    minutes = round(seconds / 60)
    return f"{minutes // 60} h {minutes % 60:02} min" if minutes >= 60 else \
        f"{minutes} min" if minutes else f"{seconds:.0f} s"


def forecast(shop: Workshop, part: Part, run: str) -> tuple[float | None, str]:
    """Seconds, and a word: where meshes or other programs are made only when it runs, nothing is known."""
    if "--adapt" in run or "=adapted" in run or run.startswith("validate"):
        return None, "not known: its meshes are made on the way"
    if "--external" in run and not (shop.source / "build/peers").exists():
        return None, "not known: ./run peers builds its programs when it is measured"
    ran = call(shop.bench, *run.split(), "--dry-run", f"--out={RESULTS / part.name}", cwd=shop.source,
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


def forget_noisy(shop: Workshop, part: Part) -> None:
    """Takes the noisy cases out of the part's complete runs, whose --resume then measures them."""
    for number in range(1, len(part.runs) + 1):
        out = shop.folder(part, number)
        if not (out / "complete").exists():
            continue
        records = out / "records.jsonl"
        lines = records.read_bytes().splitlines(keepends=True)
        quiet = [line for line in lines if not json.loads(line).get("noisy")]
        if len(quiet) < len(lines):
            (out / "complete").unlink()
            new = out / "records.jsonl.new"
            new.write_bytes(b"".join(quiet))
            os.replace(new, records)
            shop.log(part=part.name, run=number, noisy=len(lines) - len(quiet))


def measure(shop: Workshop, part: Part, number: int, options: str) -> bool:
    """Whether the run is complete: its cases may have failed, bench may not."""
    out = shop.folder(part, number)
    done = out / "complete"
    if done.exists():
        return True
    shop.log(part=part.name, run=number, begins=options)
    start = time.monotonic()
    out.mkdir(parents=True, exist_ok=True)
    is_repeated = not shop.thin and not options.startswith("validate")
    more = ["--resume"] if is_repeated else []
    if is_repeated and "--retry-noisy" not in options:
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
    if any((run / "validation.json").exists() for run in runs):
        join_published(runs, whole)
    for run in runs:
        if (run / "programs").is_dir():
            shutil.copytree(run / "programs", whole / "programs", dirs_exist_ok=True)
        if part.pictures and (run / "fields").is_dir():
            shutil.copytree(run / "fields", whole / "fields", dirs_exist_ok=True)
    draw(whole, part)
    shutil.rmtree(whole / "fields", ignore_errors=True)
    if part.claims:
        for stop, name in (("target", "claims.md"), ("paper", "claims_paper_stop.md")):
            output_of(sys.executable, PROJECT / "plots/claims.py", part.name, f"--stop={stop}", f"--out={whole / name}",
                      cwd=whole.parent)  # it names the folder as it was given


def join_published(runs: list[Path], whole: Path) -> None:
    """Of bench validate: its values, a case a line; they and the records have all of results.csv."""
    cases = [case for run in runs for case in json.loads((run / "validation.json").read_bytes())]
    lines = ",\n".join(json.dumps(case, ensure_ascii=False, separators=(",", ":")) for case in cases)
    (whole / "validation.json.gz").write_bytes(gzip.compress(f"[\n{lines}\n]\n".encode(), mtime=0))
    (whole / "results.csv").unlink()


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
