"""What follows from other keys of records: the body that a mesh divides, the look of a family."""
import os
import re
from itertools import chain, cycle, islice
from typing import NamedTuple

import pandas as pd


class Sizes(NamedTuple):
    teeth: int
    n_phi: int
    n_f: int
    n_c: int


SIZES = {  # as printed
    "Mesh0": Sizes(1, 761, 96, 38), "Mesh1": Sizes(1, 1973, 144, 80),
    "Mesh2": Sizes(1, 3105, 176, 120), "Mesh3": Sizes(1, 6287, 232, 160),
    "Mesh4": Sizes(4, 8360, 392, 200), "Mesh5": Sizes(4, 19128, 588, 480),
    "Mesh6": Sizes(4, 26538, 708, 576), "Mesh7": Sizes(4, 50483, 920, 640),
}
BODIES = {1: "one tooth", 4: "rack of four teeth"}
MEASURES = ["area_mm2", "contact_length_mm", "width_mm", "height_mm"]
AGREE = 0.02  # relative: a curved boundary is cut by its edges


class Look(NamedTuple):
    """Of a family; without colour, its marker tells it from others."""

    colour: str = "#777777"
    marker: str = "v"
    dashes: object = "-"
    rank: int = 0  # among the families of a run


# Okabe and Ito's colours.
FAMILIES = {"SYMMLQ": ("#0072B2", "o"), "3STEPCG": ("#8A3FA0", "s", (0, (5, 1.5))),
            "3STEPD": ("#D55E00", "D"), "ALM": ("#00805C", "^"), "BLIND": ("#56B4E9", "<"),
            "HYBRID": ("#000000", "P"), "P2": ("#C98500", "X")}
# Of stresses of degree 2, 3, …: colours that go on from the family's, and markers.
OF_DEGREE = {"HYBRID": (("#5B2A86", "o"), ("#B0307A", "s"), ("#E8743B", "^")),
             "P2": (("#8A5A00", "D"), ("#573300", "*"))}
FAMILIES |= dict(zip(("P3", "P4"), OF_DEGREE["P2"]))
COLOURS = ("#008B9E", "#7B4B1E", "#6B8E00", "#4B4BC8", "#777777")
MARKERS = ("v", ">", "p", "h", "d", "H", "8")  # not as many as colours, so that pairs differ

# Of Figs 4 and 5, which do without colour: a marker per method, the first of its family that is
# free; the dashes of its family, else one per preconditioner.
PLAIN_MARKERS = {"SYMMLQ": "^v>", "3STEPCG": "sD", "3STEPD": "o", "ALM": "*", "BLIND": "<",
                 "HYBRID": "P"}
PLAIN_DASHES = {"BLIND": (0, (8, 2))}
DASHES = ((0, (3, 1.5)), (0, (5, 1.5, 1, 1.5)), (0, (1, 1.2)), (0, (2, 1, 2, 3)), (0, (6, 3)))


def with_bodies(table: pd.DataFrame) -> pd.DataFrame:
    """Per scene, since a scene may change a mesh."""
    body = {}
    measures = table.groupby(["scene", "mesh"], sort=False)[MEASURES].first().astype(float)
    for scene, own in measures.groupby("scene", sort=False):
        for name, meshes in bodies_of(own.droplevel("scene")).items():
            body |= {(scene, mesh): name for mesh in meshes}
    return table.assign(body=[body[case] for case in zip(table.scene, table.mesh)])


def bodies_of(measures: pd.DataFrame) -> dict[str, list[str]]:
    """Name -> meshes, by first appearance; measures: MEASURES by mesh, NaN where unknown."""
    groups: list[list[str]] = []
    for mesh in measures.index:
        same = [group for group in groups
                if any(alike(measures, mesh, other) for other in group)]
        joined = [*chain(*same), mesh]
        groups = [joined if group is same[0] else group for group in groups
                  if group not in same[1:]] if same else [*groups, joined]
    named: dict[str, list[str]] = {}
    for group in groups:
        name = name_of(group) if name_of(group) not in named else group[0]
        while name in named:
            name += "’"
        named[name] = group
    return named


def alike(measures: pd.DataFrame, mesh: str, other: str) -> bool:
    a, b = measures.loc[mesh], measures.loc[other]
    if a.isna().any() or b.isna().any():
        return name_of([mesh]) == name_of([other])
    return bool(((a - b).abs() <= AGREE * pd.concat([a, b], axis=1).max(axis=1)).all())


def name_of(meshes: list[str]) -> str:
    """'one tooth' of the catalogue's, adapted, refined or not; punch1, punch2 -> punch; else the
    first mesh's."""
    meshes = list(dict.fromkeys(re.split(r"\+(?:adapt|refined?)\d", mesh)[0] for mesh in meshes))
    ours = [catalogue_mesh(mesh) for mesh in meshes]
    if all(ours):
        return BODIES[SIZES[ours[0]].teeth]
    return os.path.commonprefix(meshes).rstrip("0123456789_-. ") or meshes[0]


def catalogue_mesh(mesh: str) -> str | None:
    """Mesh7 of Mesh7, Mesh7-refined2, Mesh7_refined_twice; None: not of the catalogue."""
    found = re.fullmatch(r"(Mesh\d+)([-_.].*)?", mesh)
    return found[1] if found and found[1] in SIZES else None


def looks_of(families: list[str]) -> dict[str, Look]:
    looks = {family: Look(*look)._replace(rank=k)
             for k, (family, look) in enumerate(FAMILIES.items())}
    for k, family in enumerate(family for family in families if family not in FAMILIES):
        looks[family] = Look(COLOURS[k % len(COLOURS)], MARKERS[k % len(MARKERS)],
                             rank=len(FAMILIES) + k)
    return looks


def with_looks(table: pd.DataFrame) -> pd.DataFrame:
    looks = looks_of(list(dict.fromkeys(table.family)))
    degrees = table.degree if "degree" in table else [1] * len(table)
    return table.assign(look=[of_degree(looks[family], family, degree)
                              for family, degree in zip(table.family, degrees)])


def of_degree(look: Look, family: str, degree: int) -> Look:
    own = OF_DEGREE.get(family, ())
    return look if not 2 <= degree <= 1 + len(own) else \
        look._replace(colour=own[degree - 2][0], marker=own[degree - 2][1])


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
