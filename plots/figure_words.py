"""Words in the figures: captions, and cases without a point."""
from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath

from record_keys import Row
from selection import grouped


def short(value: float) -> str:
    """0.000012 -> 1e-5."""
    mantissa, exponent = f"{value:.0e}".split("e")
    return f"{mantissa}e{int(exponent)}" if value else "0"


def plain(text: str) -> str:
    """Text in which $ does not begin a formula."""
    return text.replace("$", r"\$")


@cache
def width_of(words: str, size_pt: float, weight: str = "normal") -> float:
    """In points."""
    font = FontProperties(size=size_pt, weight=weight)
    return TextToPath().get_text_width_height_descent(words.replace("$", ""), font, False)[0]


def wrapped(text: str, width: float, size_pt: float) -> list[str]:
    """Lines of at most so many inches; no-break spaces stay."""
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}".strip()
        if width_of(longer, size_pt) > 72 * width and lines[-1]:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


@dataclass
class Notes:
    """Cases that a figure has no point for, or none with a value."""

    absent: dict[str, list[str]] = field(default_factory=dict)  # what happened -> cases
    arrows: dict[str, list[str]] = field(default_factory=dict)

    def add(self, row: Row, case: str, mark: str, value: float | None) -> None:
        if mark == "none":
            happened = "heap not counted" if row.completed else row.status_words()
            self.absent.setdefault(happened, []).append(case)
        elif value is None:
            self.arrows.setdefault(row.status_words(), []).append(case)

    def lines(self) -> list[str]:
        return [f"{title}: " + "; ".join(f"{merged(cases)} ({happened})"
                                         for happened, cases in group.items())
                for title, group in (("no point", self.absent), ("no estimate", self.arrows))
                if group]


def merged(cases: list[str]) -> str:
    """'ALM on Mesh1', 'ALM on Mesh2' -> 'ALM on Mesh1, Mesh2'."""
    methods = grouped((case.partition(" on ") for case in cases), lambda parts: parts[0])
    return ", ".join(f"{method} on {', '.join(mesh for *_, mesh in on)}" if on[0][2] else method
                     for method, on in methods.items())


def span(values: Iterable[int]) -> str:
    low, high = min(values := set(values)), max(values)
    return f"{low}" if low == high else f"{low} to {high}"


def targets(rows: list[Row]) -> list[str]:
    """The target errors of a run, as far as its rows tell."""
    found = {row.target_error for row in rows} - {None}
    for row in rows:
        told = re.search(r"above the target (\d+(?:\.\d+)?(?:e[+-]?\d+)?)", row.status_reason)
        found |= {float(told[1])} if told and not row.target_error else set()
    return [short(error) if float(short(error)) == error else f"{error:g}"
            for error in sorted(found)]


def caption(rows: list[Row], measured: str, run: list[Row]) -> str:
    """What was measured and how: scene, stop, target, threads. run: all rows of its stop."""
    target = "target error " + (" or ".join(targets(run)) or "of the run")
    stop = (f"Iterations run to the {target}." if rows[0].stop == "target" else
            f"Iterations end by the paper's own stops; {target}.")
    threads = span(row.threads for row in rows)
    plural = "" if threads == "1" else "s"
    return f"{measured}; {threads} thread{plural}. Scene {rows[0].scene}. {stop}"


def time_caption(rows: list[Row], run: list[Row]) -> str:
    words = "Time of one solve, from assembled blocks to contact forces and stresses"
    done = {row.repetitions for row in rows if row.completed}
    if done:
        words += f", median of {span(done)} repetition{'' if done == {1} else 's'}"
    words = caption(rows, words, run)
    if any(row.tuning_s for row in rows):
        words += " Finding tolerances and parameters is not in the time."
    return words


def heap_caption(rows: list[Row], run: list[Row]) -> str:
    return caption(rows, "Highest heap during one solve, its blocks and result included", run)
