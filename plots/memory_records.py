"""Reads from records.jsonl where the heap of each case went (results/README.md)."""
from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from results_table import ResultsError

# As in memory_by_owner, from what every method has to what few have.
OWNERS = ("blocks", "system_matrix", "factor", "preconditioner", "intermediate", "condensed",
          "iteration", "answer", "check", "other")


@dataclass(frozen=True)
class Split:
    """Of one case of an ordinary run, completed, with stop=target."""

    mesh: str
    scene: str
    method: str
    n_phi: int
    threads: int
    peak_bytes: dict[str, int]     # owner -> bytes at the overall peak
    counted_bytes: dict[str, int]  # owner -> its own count, where it has one
    differs: bool                  # the counts do not agree with what was measured


def whole_number(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def split_of(record: dict, place: str) -> Split | None:
    """None: not such a case, or its heap was not split."""
    owners = record.get("memory_by_owner")
    if (record.get("study") or record.get("stop") != "target" or owners is None
            or record.get("status") not in ("ok", "inaccurate")):
        return None
    if not isinstance(owners, dict) or not all(
            owner in OWNERS and isinstance(bytes_of, dict) and whole_number(
                bytes_of.get("peak_bytes")) and (bytes_of.get("counted_bytes") is None
                                                 or whole_number(bytes_of["counted_bytes"]))
            for owner, bytes_of in owners.items()):
        raise ResultsError(f"{place}: memory_by_owner is {json.dumps(owners)}, expected peak_bytes "
                           f"and counted_bytes of {', '.join(OWNERS)}")
    return Split(record["mesh"], record["scene"], record["method"], record["n_phi"],
                 record["threads"], {owner: own["peak_bytes"] for owner, own in owners.items()},
                 {owner: own["counted_bytes"] for owner, own in owners.items()
                  if own.get("counted_bytes") is not None},
                 bool(record.get("memory_counts_differ")))


def read_splits(path: Path) -> list[Split]:
    """In the order of the lines; none without the file. Throws ResultsError."""
    if not path.exists():
        return []
    splits = []
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise ResultsError(f"{path}: cannot be read: {error}; expected records.jsonl of bench")
    for number, line in enumerate(lines, 1):
        try:
            split = split_of(json.loads(line), f"{path}:{number}")
        except (ValueError, KeyError, AttributeError):
            raise ResultsError(f"{path}:{number}: not a record; expected a line of bench")
        if split is not None:
            splits.append(split)
    return splits
