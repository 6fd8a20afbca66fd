"""The numbers of the pictures of fields, for the CSV beside each."""
from __future__ import annotations

import numpy as np

from error_map import share_of_worst
from field_drawing import areas
from field_panel import faces_of, letter_of
from fields import Fields
from figure_table import csv_of
from unrolled import unrolled


def contact_points(solutions: list[Fields]) -> str:
    """A line per contact point, by face in the pictures' order; along: the pictures' axis of the face."""
    lines = []
    for s in solutions:
        for k, face in enumerate(faces_of(s)):
            for edge, along in zip(face, unrolled(s.edges[face]).along):
                lines += [(s, letter_of(k), *point) for point in
                          zip(s.edges[edge], map(float, along), s.traction[edge], s.state[edge])]
    return csv_of(lines, ("mesh", lambda line: line[0].mesh), ("n_phi", lambda line: line[0].n_phi),
                  ("face", lambda line: line[1]), ("x_mm", lambda line: float(line[2][0])),
                  ("y_mm", lambda line: float(line[2][1])), ("along_mm", lambda line: line[3]),
                  ("pressure_MPa", lambda line: 0.0 - line[4][0]),
                  ("friction_MPa", lambda line: float(line[4][1])), ("state", lambda line: line[5]))


def error_shares(s: Fields, share: np.ndarray) -> str:
    """A line per triangle; x, y: of its centroid."""
    lines = zip(range(1, len(share) + 1), s.triangles.mean(axis=1), areas(s), share)
    return csv_of(lines, ("triangle", lambda line: line[0]), ("x_mm", lambda line: float(line[1][0])),
                  ("y_mm", lambda line: float(line[1][1])),
                  ("area_mm2", lambda line: float(line[2])),
                  ("error_share", lambda line: float(line[3])))


def adapted_levels(levels: list[tuple[Fields, np.ndarray, float | None]]) -> str:
    """As adapted_meshes draws them."""
    return csv_of(levels, ("mesh", lambda level: level[0].mesh),
                  ("n_phi", lambda level: level[0].n_phi),
                  ("triangles", lambda level: len(level[1])),
                  ("error_total", lambda level: level[2]),
                  ("error_share_of_worst_tenth", lambda level: share_of_worst(level[1])))
