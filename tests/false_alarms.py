#!/usr/bin/python3
"""How often `bench compare` calls the same program slower: A/A comparisons, alone and with other work.

    tests/false_alarms.py [--pairs=40] [--runs=5] [--mesh=Mesh0] [--method=HYBRID,3STEPD] [--repetitions=9]

A pair is `runs` runs a side of the built program, in turn. The table has the rule (the run is the unit) and
what it replaced (the repetition is the unit, one run a side): the first run of each side, with every
repetition handed over as a run.
"""
import argparse
import contextlib
import json
import multiprocessing
import os
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

BENCH = Path(__file__).resolve().parents[1] / "build/release/bench/bench"


def disturb() -> None:
    """Another user's work: busy for up to two seconds, idle for up to two."""
    chance = random.Random(os.getpid())
    while True:
        end = time.monotonic() + chance.uniform(0, 2)
        while time.monotonic() < end:
            pass
        time.sleep(chance.uniform(0, 2))


@contextlib.contextmanager
def other_work(processes: int):
    workers = [multiprocessing.Process(target=disturb, daemon=True) for _ in range(processes)]
    for worker in workers:
        worker.start()
    try:
        yield
    finally:
        for worker in workers:
            worker.terminate()
            worker.join()


def run(folder: Path, options: argparse.Namespace) -> None:
    ended = subprocess.run([BENCH, f"--mesh={options.mesh}", f"--method={options.method}",
                            f"--repetitions={options.repetitions}", f"--out={folder}"],
                           capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        sys.exit(f"false_alarms: {ended.stderr}")


def alarm(before: list[Path], after: list[Path]) -> bool:
    sides = [",".join(str(folder) for folder in side) for side in (before, after)]
    ended = subprocess.run([BENCH, "compare", *sides], capture_output=True, text=True, check=False)
    if ended.returncode not in (0, 1):
        sys.exit(f"false_alarms: {ended.stderr}")
    return ended.returncode == 1


def repetitions_as_runs(folder: Path, first_second: int) -> list[Path]:
    lines = (folder / "records.jsonl").read_text(encoding="utf-8").splitlines()
    folders = []
    for k in range(len(json.loads(lines[0])["samples_s"])):
        folders.append(folder / f"repetition{k}")
        folders[-1].mkdir()
        with open(folders[-1] / "records.jsonl", "w", encoding="utf-8") as file:
            for line in lines:
                record = json.loads(line)
                record["samples_s"] = [record["samples_s"][k]]
                record["context"]["date"] = f"2000-01-01T00:{k:02}:{first_second:02}Z"
                file.write(json.dumps(record) + "\n")
    return folders


def pair(options: argparse.Namespace) -> tuple[bool, bool]:
    """Alarms by runs and by repetitions."""
    with tempfile.TemporaryDirectory() as name:
        sides: list[list[Path]] = [[], []]
        for k in range(2 * options.runs):
            folder = Path(name) / f"run{k}"
            run(folder, options)
            sides[k % 2].append(folder)
        by_runs = alarm(*sides)
        return by_runs, alarm(repetitions_as_runs(sides[0][0], 0),
                              repetitions_as_runs(sides[1][0], 30))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pairs", type=int, default=40)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--mesh", default="Mesh0")
    parser.add_argument("--method", default="HYBRID,3STEPD")
    parser.add_argument("--repetitions", type=int, default=9)
    options = parser.parse_args()
    print("machine             pairs  alarms by runs  alarms by repetitions")
    for label, processes in (("alone", 0), ("with other work", os.cpu_count() or 1)):
        with other_work(processes):
            results = [pair(options) for _ in range(options.pairs)]
        by_runs, by_repetitions = (sum(alarms) for alarms in zip(*results))
        print(f"{label:<18} {options.pairs:6} {by_runs:15} {by_repetitions:22}", flush=True)


if __name__ == "__main__":
    main()
