"""What a method looks like: fixed for the families of the table, the next of a cycle for others."""
from __future__ import annotations

from itertools import chain, cycle, islice
from typing import NamedTuple

import pandas as pd


class Look(NamedTuple):
    """Of a family; the markers say in grey what the colours do."""

    colour: str = "#777777"
    marker: str = "v"
    dashes: object = "-"
    rank: int = 0  # among the families of a run


# Okabe and Ito's colours.
FAMILIES = {"SYMMLQ": ("#0072B2", "o"), "3STEPCG": ("#8A3FA0", "s", (0, (5, 1.5))),
            "3STEPD": ("#D55E00", "D"), "ALM": ("#00805C", "^"), "BLIND": ("#56B4E9", "<"),
            "HYBRID": ("#000000", "P"), "P2": ("#C98500", "X")}
COLOURS = ("#B0307A", "#7B4B1E", "#6B8E00", "#4B4BC8", "#777777")
MARKERS = ("v", ">", "p", "h", "d", "H", "8")  # not as many as colours, so that pairs differ

# Of Figs 4 and 5, which do without colour: a marker per method, the first of its family that is
# free; the dashes of its family, else one per preconditioner.
PLAIN_MARKERS = {"SYMMLQ": "^v>", "3STEPCG": "sD", "3STEPD": "o", "ALM": "*", "BLIND": "<",
                 "HYBRID": "P"}
PLAIN_DASHES = {"BLIND": (0, (8, 2))}
DASHES = ((0, (3, 1.5)), (0, (5, 1.5, 1, 1.5)), (0, (1, 1.2)), (0, (2, 1, 2, 3)), (0, (6, 3)))


def looks_of(families: list[str]) -> dict[str, Look]:
    """In the order of their first appearance."""
    others = [family for family in families if family not in FAMILIES]
    known = {family: Look(*look)._replace(rank=k) for k, (family, look) in
             enumerate(FAMILIES.items())}
    return known | {family: Look(COLOURS[k % len(COLOURS)], MARKERS[k % len(MARKERS)],
                                 rank=len(FAMILIES) + k) for k, family in enumerate(others)}


def with_looks(table: pd.DataFrame) -> pd.DataFrame:
    looks = looks_of(list(dict.fromkeys(table.family)))
    return table.assign(look=[looks[family] for family in table.family])


def plain_looks(methods: dict[str, tuple[str, str]]) -> dict[str, tuple[str, object]]:
    """Name -> family, preconditioner to name -> marker, dashes; in the same order."""
    reserved = set("".join(PLAIN_MARKERS.values()))
    spare = [marker for marker in "XpdhH8v<>^" if marker not in reserved]
    dashes = dict(zip(dict.fromkeys(name for _, name in methods.values() if name), cycle(DASHES)))
    looks: dict[str, tuple[str, object]] = {}
    for name, (family, preconditioner) in methods.items():
        taken = [marker for marker, _ in looks.values()]
        marker = next(chain((m for m in chain(PLAIN_MARKERS.get(family, ""), spare)
                             if m not in taken), islice(cycle(spare), len(looks), None)))
        looks[name] = marker, PLAIN_DASHES.get(family) or dashes.get(preconditioner, "-")
    return looks
