"""What the outcomes of cases look like in a grid of cells, and the key to them."""
import math
from collections import Counter
from typing import TypeVar

from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from drawing import MARGIN, PAGE_WIDTH, text_at
from records import OUTCOMES, Row

Item = TypeVar("Item")
SIZE = 7.5  # points
# Outcome -> letter, fill, colour of the letter; the letters and the lightness say it in grey.
MARKS = {
    "ok": ("", "#EAF3FA", "#123A5A"),
    "other_solution": ("2", "#CFE8D5", "#12402A"),
    "inaccurate": ("i", "#F5D76E", "black"),
    "unstressed": ("0", "#FFFFFF", "0.4"),
    "not_converged": ("n", "#E8A33D", "black"),
    "breakdown": ("b", "#B07A4A", "white"),
    "unverified": ("?", "#FFFFFF", "black"),
    "wrong_success": ("W!", "#D00060", "white"),
    "timeout": ("t", "#A9A9B8", "black"),
    "out_of_memory": ("m", "#6B6B80", "white"),
    "crashed": ("X", "#000000", "white"),
    "machine_fault": ("f", "#DADADA", "black"),
    "skipped": ("–", "#FFFFFF", "0.4"),
}
WORDS = {"other_solution": "another solution than the reference's",
         "unstressed": "no stress, so no relative error",
         "unverified": "reported ok, cannot be verified",
         "wrong_success": "wrong success: reported ok, but is not", "timeout": "time limit reached",
         "machine_fault": "no process or file available"}


def in_blocks(columns: list[Item], left: float, narrowest: float,
              widest: float) -> tuple[list[list[Item]], float]:
    """Columns of a grid that begins at `left`, in as few blocks as their width allows; the width."""
    room = max(PAGE_WIDTH - left - MARGIN, narrowest)  # names may be wider than the page
    most = math.ceil(len(columns) / math.ceil(len(columns) * narrowest / room))
    return [columns[k:k + most] for k in range(0, len(columns), most)], min(widest, room / most)


class Key:
    LINE = 0.25  # inches

    def __init__(self, rows: list[Row], of_ok: tuple[str, str]) -> None:
        count = Counter(row.outcome for row in rows)
        self.of_ok = of_ok
        self.places: list[tuple[str, str, float, int]] = []  # outcome, words, x, line
        x, line = MARGIN, 0
        for outcome in OUTCOMES:
            if not count[outcome] and outcome != "wrong_success":
                continue
            words = of_ok[1] if outcome == "ok" else WORDS.get(outcome, outcome.replace("_", " "))
            words += f": {count[outcome]}"
            needed = 0.36 + 0.066 * len(words) + 0.22
            if x + needed > PAGE_WIDTH:
                x, line = MARGIN, line + 1
            self.places.append((outcome, words, x, line))
            x += needed
        self.height = 0.12 + self.LINE * (line + 1)

    def draw(self, figure: Figure, top: float) -> None:
        height = figure.get_size_inches()[1]
        for outcome, words, x, line in self.places:
            letter, fill, ink = MARKS[outcome]
            y = top + self.LINE * line
            figure.add_artist(Rectangle((x / PAGE_WIDTH, 1 - (y + 0.19) / height),
                                        0.28 / PAGE_WIDTH, 0.19 / height, facecolor=fill,
                                        edgecolor="0.5", linewidth=0.5))
            text_at(figure, x + 0.14, y + 0.1, letter or self.of_ok[0], color=ink, ha="center",
                    va="center", fontsize=SIZE, weight="bold" if letter else "normal")
            text_at(figure, x + 0.36, y + 0.1, words, va="center", fontsize=8,
                    weight="bold" if outcome == "wrong_success" else "normal")
