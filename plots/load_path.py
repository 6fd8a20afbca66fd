"""Reads fields/NAME.steps.csv and the contact points of every step, as `bench --fields` writes them.

N steps, P contact points of one face in its order, two per edge. Forces in N per mm of thickness.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fields import CONTACT, STATES, chains, halves, read_table, unrolled
from records import RecordsError
from words import csv_of

STEPS = ("step,normal_resultant_N,tangential_resultant_N,dissipation_Nmm,n_open,n_stick,n_slip,"
         "held_x_mm,held_y_mm,loaded_x_mm,loaded_y_mm,fields")
PARTS = ("body", "contact")
CLOSED = 1e-3  # of the range of a force: a cycle that returns to it
SAME = 1e-6  # of the range of a displacement: two steps at the same place


@dataclass(frozen=True)
class LoadPath:
    name: str
    step: np.ndarray         # (N,) from 1
    has_body: np.ndarray     # (N,) whether the stresses of the step are in files
    push: np.ndarray         # (N,) N: force on the wall along the face's mean tangent
    normal: np.ndarray       # (N,) N: force on the wall along its mean normal
    dissipated: np.ndarray   # (N,) N mm, in each step
    moved: np.ndarray | None  # (N,) mm: displacement along that tangent; None: unknown
    moved_what: str          # whose: held or loaded boundary
    face: int                # which is shown, from 0, of
    faces: int
    axis: str
    along: np.ndarray        # (P, 2) mm: half edge of each point
    state: np.ndarray        # (N, P) of STATES
    traction: np.ndarray     # (N, P, 2) MPa: pressure > 0, friction on the body along the tangent

    @property
    def cycle(self) -> int | None:
        """The last step but the end, from 0, at the end's displacement, if others lie between."""
        if self.moved is None or not np.ptp(self.moved):
            return None
        same = np.flatnonzero(np.abs(self.moved - self.moved[-1]) < SAME * np.ptp(self.moved))
        before = same[same < len(self.moved) - 2]
        return int(before[-1]) if before.size else None

    @property
    def force_returns(self) -> bool:
        """The force at the end is that of the cycle's beginning."""
        return bool(abs(self.push[-1] - self.push[self.cycle]) < CLOSED * np.ptp(self.push))

    def dissipated_in_cycle(self) -> float:
        return float(self.dissipated[self.cycle + 1:].sum())

    def area(self) -> float:
        """∮ push d(moved) of the cycle, N mm, by the trapezoidal rule."""
        push, moved = self.push[self.cycle:], self.moved[self.cycle:]
        return float(((push[1:] + push[:-1]) / 2 * np.diff(moved)).sum())


def contact_of(results: Path, name: str, step: int) -> tuple[np.ndarray, np.ndarray]:
    return read_table(results / "fields" / f"{name}.steps" / f"{step:04}.contact.csv", CONTACT, STATES)


def read_path(results: Path, name: str) -> LoadPath | str:
    """The path, or why there is nothing to see; throws RecordsError."""
    table = results / "fields" / f"{name}.steps.csv"
    numbers, parts = read_table(table, STEPS, PARTS)
    if not np.array_equal(numbers[:, 0], np.arange(len(numbers)) + 1) or len(numbers) == 0:
        raise RecordsError(f"{table}: expected the steps 1, 2, 3 and so on, a row each")
    points = [contact_of(results, name, step) for step in range(1, len(numbers) + 1)]
    first = points[0][0]
    for step, (own, _) in enumerate(points, 1):
        if not np.array_equal(own[:, :5], first[:, :5]):
            raise RecordsError(f"{table.with_suffix('')}/{step:04}.contact.csv: other contact points "
                               "than in step 1")
    if not len(first):
        return "no contact points"
    force = np.array([own[:, 5:7] for own, _ in points])
    edges = first[:, :2].reshape(-1, 2, 2)
    faces = chains(edges)
    face = int(np.argmin([force[:, rows_of(own), 0].sum() for own in faces]))  # pressed most
    chosen = rows_of(faces[face])
    line = unrolled(edges[faces[face]])
    normals, lengths = first[:, 2:4], first[:, 4]
    tangents = np.stack([-normals[:, 1], normals[:, 0]], 1)
    on_body = force[..., :1] * normals + force[..., 1:] * tangents
    mean = unit((lengths[:, None] * normals)[chosen].sum(0))
    along = np.array([-mean[1], mean[0]])
    ways = {what: numbers[:, k:k + 2] @ along for what, k in
            (("held", 7), ("loaded", 9)) if np.isfinite(numbers[:, k:k + 2]).all()}
    moved_what = max(ways, key=lambda what: np.ptp(ways[what]), default="")
    return LoadPath(
        name, numbers[:, 0].astype(int), parts == "body", -on_body.sum(1) @ along,
        -on_body.sum(1) @ mean, numbers[:, 3], ways.get(moved_what), moved_what, face, len(faces),
        line.axis, halves(line.along),
        np.array([state for _, state in points])[:, chosen],
        force[:, chosen] * np.array([-1, 1]) / (lengths[chosen, None] / 2))  # F = (L/2) t


def rows_of(edges: np.ndarray) -> np.ndarray:
    """Rows of the contact points of these edges."""
    return np.stack([2 * edges, 2 * edges + 1], 1).ravel()


def unit(vector: np.ndarray) -> np.ndarray:
    return vector / (np.hypot(*vector) or 1)


def table_of(path: LoadPath) -> str:
    """A line per step: what the picture shows."""
    shares = {state: (path.state == state) @ np.diff(path.along, axis=1)[:, 0] for state in STATES}
    lines = range(len(path.step))
    return csv_of(lines, ("step", lambda k: int(path.step[k])),
                  ("moved_mm", lambda k: None if path.moved is None else float(path.moved[k])),
                  ("push_N", lambda k: float(path.push[k])),
                  ("normal_N", lambda k: float(path.normal[k])),
                  ("dissipated_Nmm", lambda k: float(path.dissipated[k])),
                  *((f"{state}_mm", lambda k, own=own: float(own[k]))
                    for state, own in shares.items()))
