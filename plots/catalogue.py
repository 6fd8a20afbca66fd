"""What follows from other keys of records: the body that a mesh divides, the look of a method."""
import os
import re
import zlib
from itertools import chain
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
    """Of a method, the same in every figure."""

    colour: str = "#777777"
    marker: str = "v"
    dashes: object = "-"
    rank: float = 0  # among methods: the order of keys

    def line(self, **style: object) -> dict[str, object]:
        size = 5 * {"P": 1.35, "X": 1.3, "*": 1.7, "<": 1.15, ">": 1.15, "v": 1.15, "^": 1.15}.get(self.marker, 1)
        return dict(color=self.colour, marker=self.marker, linestyle=self.dashes, linewidth=1.2, markersize=size,
                    markeredgecolor="white", markeredgewidth=0.4) | style


# Method, by its general name -> colour and marker, dashes of a variant. Okabe and Ito's colours; a family shares a
# hue. Values of a program's own parameter look as the program does.
DASHED, DOTTED, MIXED = (0, (4, 1.5)), (0, (1, 1.2)), (0, (5, 1.5, 1, 1.5))
METHODS = {
    "SYMMLQ:DTIC3": ("#0072B2", "^"), "SYMMLQ:DTIC6": ("#0072B2", "v", DASHED), "SYMMLQ:SKY": ("#0072B2", ">", DOTTED),
    "SYMMLQ": ("#0072B2", "p"),
    "3STEPCG:DTIC3": ("#8A3FA0", "s"), "3STEPCG:DTIC6": ("#8A3FA0", "D", DASHED), "3STEPCG": ("#8A3FA0", "H"),
    "3STEPD": ("#D55E00", "o"), "3STEPD:CHOLMOD": ("#D55E00", "s", DASHED), "3STEPD:LEAN": ("#D55E00", "^", MIXED),
    "3STEPD:FILE": ("#D55E00", "v", DOTTED), "3STEPD:REFINED": ("#8C3D00", "D", DASHED),
    "ALM": ("#00805C", "*"), "ALM:AUTO": ("#00805C", "p", DASHED),
    "BLIND": ("#56B4E9", "<"), "BLIND:SCHUR": ("#2B7DAB", "X", DASHED), "BLIND:SKY": ("#56B4E9", "d", MIXED),
    "BLIND:SCHUR:REFINED": ("#174A66", "h", DOTTED),
    "HYBRID": ("#000000", "P"), "HYBRID:CHOLMOD": ("#555555", "s", DASHED), "HYBRID:MUMPS": ("#555555", "^", MIXED),
    "HYBRID:PDAS": ("#555555", "d", DOTTED), "HYBRID:CG": ("#CC79A7", "v"),
    "HYBRID:k=2": ("#5B2A86", "o"), "HYBRID:k=3": ("#B0307A", "s"), "HYBRID:k=4": ("#E8743B", "^"),
    "P2": ("#C98500", "X"), "P3": ("#8A5A00", "D"), "P4": ("#573300", "*"),
    "EXTERNAL:calculix-mortar": ("#7B4B1E", ">"), "EXTERNAL:calculix-penalty": ("#6B8E00", "p"),
    "EXTERNAL:fenicsx-nitsche": ("#4B4BC8", "h"), "EXTERNAL:freefem-uzawa": ("#B00020", "d"),
    "EXTERNAL:getfem-coefficients": ("#008B9E", "v"), "EXTERNAL:getfem-nodes": ("#008B9E", "^", DASHED),
    "EXTERNAL:hybrid-petsc": ("#777777", "H"), "EXTERNAL:fortran-mumps": ("#777777", "8", DASHED),
    "EXTERNAL:scipy-newton": ("#A0522D", "<", DASHED), "EXTERNAL:siconos-nsgs": ("#9A9A00", "o"),
    "EXTERNAL:siconos-admm": ("#9A9A00", "s", DASHED), "EXTERNAL:siconos-cpg": ("#9A9A00", "D", MIXED),
    "EXTERNAL:siconos-lemke": ("#9A9A00", "X", DOTTED), "EXTERNAL:siconos-nsn-ac": ("#5C5C00", "P", DASHED)}
COLOURS = ("#008B9E", "#7B4B1E", "#6B8E00", "#4B4BC8", "#B00020", "#777777")  # of families that are not in the table
MARKERS = "ovs^D<P>Xdphh8H"


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


def looks_of(families: dict[str, str]) -> dict[str, Look]:
    """Method, by its general name, to its family -> its look. What the table does not have begins at a place that its
    name gives, so that it looks the same in most runs, and takes the next that is free."""
    looks, ranks = {}, {name: k for k, name in enumerate(METHODS)}
    for name, family in families.items():
        known = METHODS.get(name) or (METHODS.get(family) if name.startswith("EXTERNAL:") else None)
        if known:
            looks[name] = Look(*known)._replace(rank=ranks.get(name, ranks[family]))
    for name, family in families.items():
        if name not in looks:
            first = zlib.crc32(family.encode()) % len(COLOURS)
            colours = METHODS[family][:1] if family in METHODS else COLOURS[first:] + COLOURS[:first]
            first = zlib.crc32(name.encode()) % len(MARKERS)
            pairs = [(colour, marker) for colour in colours for marker in MARKERS[first:] + MARKERS[:first]]
            taken = {look[:2] for look in looks.values()}
            colour, marker = next((pair for pair in pairs if pair not in taken), pairs[0])
            looks[name] = Look(colour, marker, DASHED if name != family else "-", ranks.get(family, len(ranks)) + 0.5)
    return looks


def with_looks(table: pd.DataFrame) -> pd.DataFrame:
    looks = looks_of(dict(zip(table.general_name, table.family)))
    return table.assign(look=table.general_name.map(looks))
