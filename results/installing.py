"""Puts complete parts into results/, and says which revision the records there come from."""
from __future__ import annotations

import gzip
import json
import os
import re
import shutil
import sys
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from measuring import Workshop, missing
from parts import PROJECT, RESULTS, Part, commit_of, output_of

LARGE = 2 << 20  # bytes


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
    said = RESULTS / "reproduced.md"
    return re.findall(r"^\| \[([\w-]+)\]", said.read_text(encoding="utf-8"), re.MULTILINE) \
        if said.exists() else []


def reproduced_text(parts: Iterable[Part]) -> str:
    rows = table(row_of(RESULTS / part.name, part) for part in parts)
    return "\n".join(["# What was measured, by `./run reproduce`", "", *rows, ""])


def images_of(part: Part) -> list[tuple[Path, Path]]:
    """Figures in results/, and their copies in docs/."""
    return [(RESULTS / part.name / "figures" / f"{name}.png", PROJECT / "docs/images" / f"{name}.png")
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
        new, old = RESULTS / f".{part.name}.new", RESULTS / f".{part.name}.old"
        shutil.rmtree(new, ignore_errors=True)
        shutil.copytree(shop.folder(part), new, ignore=shutil.ignore_patterns("results.json"))
        pack(new)
        if (RESULTS / part.name).exists():
            os.replace(RESULTS / part.name, old)
        os.replace(new, RESULTS / part.name)
        shutil.rmtree(old, ignore_errors=True)
        for figure, copy in images_of(part):
            shutil.copyfile(figure, copy)
        kept.append(part.name)
        print(f"{part.name}: in results/")
    installed = [part for part in every if part.name in kept]
    (RESULTS / "reproduced.md").write_text(reproduced_text(installed), encoding="utf-8")
    output_of(sys.executable, PROJECT / "plots/quoted_numbers.py", "--write", cwd=PROJECT)
    revisions = revisions_of([context for part in installed for context in contexts_of(RESULTS / part.name)])
    if len(revisions) > 1:  # no reason to refuse: parts come one after the other
        print(f"results/ has records of {len(revisions)} revisions now: {', '.join(revisions)} "
              "(--check: which parts)")
    print("look at git diff, then commit")


def without_part(every: list[Part]) -> list[str]:
    """Folders with committed records that reproduce.toml does not name."""
    tracked = output_of("git", "ls-files", "--", "*records.jsonl*", "*/nights/*", cwd=RESULTS).splitlines()
    return sorted({file.split("/")[0] for file in tracked} - {part.name for part in every})


def out_of_date(every: list[Part]) -> list[str]:
    """What --install writes and is not of the records that are there."""
    said = RESULTS / "reproduced.md"
    installed = [part for part in every if part.name in reproduced()]
    old = [] if said.exists() and said.read_text(encoding="utf-8") == reproduced_text(installed) else [said]
    old += [copy for part in installed for figure, copy in images_of(part)
            if not copy.exists() or copy.read_bytes() != figure.read_bytes()]
    return [f"{file.relative_to(PROJECT)}: not of these records (--install writes it)" for file in old]


def check(parts: list[Part], every: list[Part], revision: str | None) -> int:
    """Prints where the records of each part come from; 1: not from one committed revision, or not all there."""
    wanted = commit_of(revision)[:10] if revision else None
    others = without_part(every) if parts == every else []
    contexts = {name: contexts_of(RESULTS / name) for name in [*(part.name for part in parts), *others]}
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
