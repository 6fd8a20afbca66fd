"""Which meshes divide the same body, what it is called, and which bodies share a pair of axes."""
from __future__ import annotations

import os
import re
from itertools import chain

import pandas as pd

from paper_sizes import BODIES, SIZES, catalogue_mesh
from record_keys import Row
from selection import by_body

MEASURES = ["area_mm2", "contact_length_mm", "width_mm", "height_mm"]
AGREE = 0.02  # relative: a curved boundary is cut by its edges


def with_bodies(table: pd.DataFrame) -> pd.DataFrame:
    """A scene may change a mesh, so bodies are of a scene."""
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
    """'one tooth' of the catalogue's, adapted, refined or not; punch1, punch2 -> punch; else the first mesh's."""
    meshes = list(dict.fromkeys(re.split(r"\+(?:adapt|refined)\d", mesh)[0] for mesh in meshes))
    ours = [catalogue_mesh(mesh) for mesh in meshes]
    if all(ours):
        return BODIES[SIZES[ours[0]].teeth]
    return os.path.commonprefix(meshes).rstrip("0123456789_-. ") or meshes[0]


def sharing_axes(rows: list[Row]) -> list[list[Row]]:
    """Bodies whose sizes do not overlap share axes over n_phi: the rows of each axes."""
    shared: list[list[Row]] = []
    for own in by_body(rows).values():
        low, high = min(row.n_phi for row in own), max(row.n_phi for row in own)
        group = next((group for group in shared if all(
            max(row.n_phi for row in other) < low or min(row.n_phi for row in other) > high
            for other in by_body(group).values())), None)
        if group is None:
            shared.append(own)
        else:
            group += own
    return shared
