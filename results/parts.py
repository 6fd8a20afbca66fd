"""The parts of results/, as reproduce.toml lists them, and what measuring and installing share."""
from __future__ import annotations

import fnmatch
import subprocess
import sys
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

RESULTS = Path(__file__).resolve().parent
PROJECT = RESULTS.parent
sys.path.append(str(PROJECT / "plots"))  # messages.py


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


def call(*command: object, cwd: Path, **more: object) -> subprocess.CompletedProcess:
    return subprocess.run(list(map(str, command)), cwd=cwd, check=False, **more)


def output_of(*command: object, cwd: Path) -> str:
    ran = call(*command, cwd=cwd, capture_output=True, text=True)
    if ran.returncode:
        raise Refused(f"{' '.join(map(str, command))}: {ran.stderr.strip()}")
    return ran.stdout.strip()


def commit_of(revision: str) -> str:
    ran = call("git", "rev-parse", "--quiet", "--verify", f"{revision}^{{commit}}", cwd=PROJECT,
               capture_output=True, text=True)
    if ran.returncode:
        raise Refused(f"--revision: '{revision}' is none of this repository (allowed: a commit, tag or branch)")
    return ran.stdout.strip()
