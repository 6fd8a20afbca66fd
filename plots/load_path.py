"""Reads fields/NAME.steps.csv and the contact points of every step, as `bench --fields` writes them.

N steps, P contact points of one face in its order, m per edge. Forces in N per mm of thickness.
"""
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from fields import (CONTACT, STATES, WITHOUT_PIECES, by_edge, chains, part_shown, parts, read_table,
                    unrolled)
from records import RecordsError
from words import csv_of

STEPS = ("step,normal_resultant_N,tangential_resultant_N,dissipation_Nmm,n_open,n_stick,n_slip,"
         "held_x_mm,held_y_mm,loaded_x_mm,loaded_y_mm,piece,same_loads_as,fields")
WITHOUT_PIECE = STEPS.replace("piece,", "")  # of an earlier bench
WITHOUT_RETURNS = WITHOUT_PIECE.replace("same_loads_as,", "")  # of one before
PARTS = ("body", "contact")
CLOSED = 1e-3  # of the range of a force or displacement: a cycle that returns to it
SLIGHT = 0.1  # tangential motion, of the normal one: the loop shows the normal one
UNLOADED = 0.01  # of the largest contact forces of the path


@dataclass(frozen=True)
class LoadPath:
    name: str
    step: np.ndarray         # (N,) from 1
    has_body: np.ndarray     # (N,) whether the stresses of the step are in files
    is_normal: bool          # push and moved are normal to the face, else along its mean tangent
    obstacle: str            # what the face that is shown presses on: "wall" or "other body"
    push: np.ndarray         # (N,) N: force of the body that is moved on what it touches, in that direction
    normal: np.ndarray       # (N,) N: the same along the face's mean normal
    pressed: np.ndarray      # (N,) N: sum of the sizes of all contact forces
    dissipated: np.ndarray   # (N,) N mm, in each step
    moved: np.ndarray | None  # (N,) mm: displacement in that direction; None: unknown
    moved_what: str          # whose: held or loaded boundary of this body
    loads: np.ndarray        # (N,) number of the first step with these loads
    face: int                # which is shown, from 0, of
    faces: int               # this body's
    axis: str
    along: np.ndarray        # (P, 2) mm: part of the edge around each point
    state: np.ndarray        # (N, P) of STATES
    traction: np.ndarray     # (N, P, 2) MPa: pressure > 0, friction on the body along the tangent

    @cached_property
    def cycle(self) -> slice | None:
        """The last steps at whose end the loads of their beginning return after others. They return on
        the way they came from, if they ever do: to and fro is one cycle, not two."""
        for last in range(len(self.loads) - 1, 1, -1):
            same = [k for k in range(last - 1) if self.loads[k] == self.loads[last]
                    and (self.loads[k:last] != self.loads[last]).any()]
            if same:
                again = [k for k in same if k and self.loads[k - 1] == self.loads[last - 1]]
                return slice(again[-1] if again else same[0], last + 1)
        return None

    @property
    def turns(self) -> list[int]:
        """Steps, from 0, after which the motion turns round."""
        ways = np.sign(np.diff(self.push if self.moved is None else self.moved))
        moves = np.flatnonzero(ways)
        return [int(moves[k]) + 1 for k in np.flatnonzero(np.diff(ways[moves]))]

    @property
    def shown(self) -> tuple[float, float]:
        """Limits of the part of the face that is drawn, mm."""
        return part_shown(self.along, (self.state != "open").any(0))

    @property
    def telling_step(self) -> int:
        """The step, from 0, that stands for the path where one is drawn: the last; of those with a body
        in files the most loaded if the path ends unloaded."""
        last = len(self.step) - 1
        if not self.has_body.any() or self.pressed[last] > UNLOADED * self.pressed.max():
            return last
        return int(np.argmax(np.where(self.has_body, self.pressed, -1)))

    def dissipated_in_cycle(self) -> float:
        return float(self.dissipated[self.cycle][1:].sum())

    def area(self) -> float:
        """∮ push d(moved) of the cycle, N mm, by the trapezoidal rule."""
        push, moved = self.push[self.cycle], self.moved[self.cycle]
        return float(((push[1:] + push[:-1]) / 2 * np.diff(moved)).sum())


def returns(values: np.ndarray, cycle: slice) -> bool:
    """The value at the end of the cycle is that of its beginning."""
    of_cycle = values[cycle]
    return bool(abs(of_cycle[-1] - of_cycle[0]) <= CLOSED * np.ptp(values))


def contact_of(results: Path, name: str, step: int) -> tuple[np.ndarray, np.ndarray]:
    return read_table(results / "fields" / f"{name}.steps" / f"{step:04}.contact.csv", CONTACT, STATES,
                      WITHOUT_PIECES)


def on_moved_body(points: np.ndarray, steps: np.ndarray) -> np.ndarray:
    """(P,) whether it is a contact point of the body that the path moves. Files of an earlier bench do
    not tell: those at walls, and the first of two bodies."""
    if points.shape[1] > 10:
        return points[:, 10] == steps[0, 11]
    return ~(points[:, 9] < np.arange(len(points)) + 1)


def read_path(results: Path, name: str) -> LoadPath | str:
    """The path, or why there is nothing to see; throws RecordsError."""
    table = results / "fields" / f"{name}.steps.csv"
    numbers, files = read_table(table, STEPS, PARTS, WITHOUT_PIECE, WITHOUT_RETURNS)
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
    of_edges = by_edge(first)
    if of_edges is None:
        raise RecordsError(f"{table.with_suffix('')}/0001.contact.csv: expected start and end of each contact edge")
    edges, m = of_edges[:, [0, -1], :2], of_edges.shape[1]
    ours = on_moved_body(first, numbers)
    faces = [own for own in chains(edges) if ours[rows_of(own, m)].all()]
    if not faces:
        return "no contact points on the body that it moves"
    face = int(np.argmin([force[:, rows_of(own, m), 0].sum() for own in faces]))  # pressed most
    chosen = rows_of(faces[face], m)
    line = unrolled(edges[faces[face]])
    normals, lengths = first[:, 2:4], first[:, 4]
    tangents = np.stack([-normals[:, 1], normals[:, 0]], 1)
    on_body = force[..., :1] * normals + force[..., 1:] * tangents
    mean = unit((lengths[:, None] * normals)[chosen].sum(0))
    ways = {what: numbers[:, k:k + 2] @ np.stack([mean, (-mean[1], mean[0])], 1) for what, k in
            (("held", 7), ("loaded", 9)) if np.isfinite(numbers[:, k:k + 2]).all()}
    moved_what = max(ways, key=lambda what: np.ptp(ways[what], axis=0).max(), default="")
    moved = ways.get(moved_what)
    push = -on_body[:, ours].sum(1) @ np.stack([mean, (-mean[1], mean[0])], 1)
    loads = numbers[:, -1] if numbers.shape[1] > 11 else numbers[:, 0]
    path = LoadPath(
        name, numbers[:, 0].astype(int), files == "body", False,
        "other body" if np.isfinite(first[chosen, 9]).any() else "wall", push[:, 1], push[:, 0],
        np.hypot(*force.T).T.sum(1), numbers[:, 3], None if moved is None else moved[:, 1], moved_what, loads.astype(int), face,
        len(faces), line.axis, parts(line.along, m),
        np.array([state for _, state in points])[:, chosen],
        force[:, chosen] * np.array([-1, 1]) / (lengths[chosen, None] / m))  # F = (L/m) t
    if moved is None:
        return path
    normal, tangential = np.ptp(moved[path.cycle or slice(None)], axis=0)
    if tangential >= SLIGHT * normal:
        return path
    return replace(path, is_normal=True, push=push[:, 0], moved=moved[:, 0])


def rows_of(edges: np.ndarray, m: int) -> np.ndarray:
    """Rows of the contact points of these edges, m each."""
    return (m * edges[:, None] + np.arange(m)).ravel()


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
                  ("same_loads_as", lambda k: int(path.loads[k])),
                  ("dissipated_Nmm", lambda k: float(path.dissipated[k])),
                  *((f"{state}_mm", lambda k, own=own: float(own[k]))
                    for state, own in shares.items()))
