"""Reads fields/NAME.{stress,contact,boundary}.csv and .vtu as `bench --fields` writes them, and checks them.

Lengths in mm, stresses in MPa, forces in N (per mm of thickness).
T triangles, B boundary edges, E contact edges with m contact points each: 2, for stresses of degree k k + 1.
Thirds of a triangle have P points (lagrange_cells.py), 3 where stresses are linear; edges have Q, evenly
spread from start to end, 2 where none is curved.
"""
from collections import defaultdict
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas as pd

from case_names import case_of_file
from lagrange_cells import Cells, along_side, degree_of, read_cells
from records import RecordsError, cells_of, lines_file, read_run

STRESS = "triangle,third,corner,x_mm,y_mm,sxx_MPa,syy_MPa,sxy_MPa"
CONTACT = "x_mm,y_mm,normal_x,normal_y,edge_length_mm,F_n_N,F_t_N,gap_mm,slip_mm,opposite,piece,state"
WITHOUT_PIECES = CONTACT.replace("piece,", "")  # of an earlier bench
MAY_BE_EMPTY = ("gap_mm", "slip_mm", "opposite", "normal_resultant_N", "tangential_resultant_N",
                "n_open", "n_stick", "n_slip", "held_x_mm", "held_y_mm", "loaded_x_mm", "loaded_y_mm")
DISPLACEMENT = "triangle,node,x_mm,y_mm,ux_mm,uy_mm"
BOUNDARY = "x0_mm,y0_mm,x1_mm,y1_mm,rolls,t0_x_MPa,t0_y_MPa,t1_x_MPa,t1_y_MPa,role"
WITHOUT_LOADS = "x0_mm,y0_mm,x1_mm,y1_mm,role"  # of an earlier bench
ERROR = "triangle,error_share"
STATES = ("open", "stick", "slip")
ROLES = ("displacement", "force", "contact")
BY_LENGTH = "distance along the face from its dot, mm"
AROUND, MOST_SHOWN = 0.25, 0.75  # of the part of a face that touches; of the face
MOST_POINTS = 9  # on an edge
STRAIGHT = 0.999  # cosine of the angle between a straight face and its axis, at least
ON_CURVE = 7  # points of an edge


@dataclass(frozen=True)
class Fields:
    """One solution. Edges have the body on their left."""

    name: str
    points: np.ndarray    # (T, 3, P, 2) mm: of third k; first its corners v_k, v_k+1, centroid
    stress: np.ndarray    # (T, 3, P, 3) MPa: sxx, syy, sxy there; polynomials between
    boundary: np.ndarray  # (B, Q, 2) mm: from start to end
    role: np.ndarray      # (B,) of ROLES, or "rollers"
    edges: np.ndarray     # (E, Q, 2) mm: contact edges
    traction: np.ndarray  # (E, m, 2) MPa: Bernstein coefficients; normal (pressure < 0), tangential
    state: np.ndarray     # (E, m) of STATES
    mesh: str
    n_phi: int | None     # from the record; None: there is none
    of_face: bool = False  # seen from a face: distance outward and place along it, not x and y
    load: np.ndarray | None = None   # (B, 2, 2) MPa: given traction at start, end; None: unknown
    moved: np.ndarray | None = None  # (B, Q, 2) mm: displacement of its points
    normal: np.ndarray | None = None  # (E, m, 2): of the contact points, to the wall
    gap: np.ndarray | None = None    # (E, m) mm: along it, a mean around the point; NaN: unknown
    paired: np.ndarray | None = None  # (E,) it presses on another body, not on a wall
    touched: np.ndarray | None = None  # (E, m) the point touches in some load step; None: see state
    of_step: str = ""    # which load step it is, in words; empty: the last

    @property
    def per_edge(self) -> int:
        """m."""
        return self.state.shape[1]

    @property
    def triangles(self) -> np.ndarray:
        """(T, 3, 2) mm."""
        return self.points[:, :, 0]

    @property
    def outlines(self) -> np.ndarray:
        """(T, points, 2) mm: of the triangles, along their sides."""
        side = [0, *range(3, 2 + degree_of(self.points.shape[2]))]
        return self.points[:, :, side].reshape(len(self.points), -1, 2)

    def placed(self, points: np.ndarray) -> np.ndarray:
        """(..., 2) -> to the right and along the vertical axis of a picture: x and y as they are, a
        face from its start to the right."""
        return points[..., ::-1] if self.of_face else points

    def shown_of(self, face: np.ndarray, line: "Unrolled") -> tuple[float, float]:
        touched = self.state[face] != "open" if self.touched is None else self.touched[face]
        return part_shown(parts(line.along, self.per_edge), touched.ravel())

    def at_wall(self, face: np.ndarray) -> bool:
        return self.paired is None or not self.paired[face].any()

    def faces(self) -> list[np.ndarray]:
        """Numbers of the contact edges, a chain for each face; one around a hole begins where its y is
        least."""
        found = []
        for chain in chains(self.edges):
            starts, ends = self.edges[chain, 0], self.edges[chain, -1]
            closed = (ends[-1] == starts[0]).all()
            found.append(np.roll(chain, -starts[:, 1].argmin()) if closed else chain)
        return found


def chains(edges: np.ndarray) -> list[np.ndarray]:
    """Numbers of the edges (n, Q, 2), chained end to start; a ring begins anywhere.

    Where two bodies touch, an edge of one starts where an edge of the other ends, and goes back: no
    chain does.
    """
    back = -0.9  # a turn by 154° or more
    starting = defaultdict(list)
    for e, start in enumerate(edges[:, 0]):
        starting[tuple(start)].append(e)
    following = {}
    for e, end in enumerate(edges[:, -1]):
        on = [f for f in starting[tuple(end)] if cosine(edges[e, -2:], edges[f, :2]) > back]
        if on:
            following[e] = max(on, key=lambda f: cosine(edges[e, -2:], edges[f, :2]))
    goes_on = set(following.values())
    left = dict.fromkeys(sorted(range(len(edges)), key=lambda e: e in goes_on))  # ends come first
    found = []
    while left:
        e = next(iter(left))
        chain = []
        while e in left:
            chain.append(e)
            del left[e]
            e = following.get(e)
        found.append(np.array(chain))
    return found


def cosine(edge: np.ndarray, other: np.ndarray) -> float:
    along, on = edge[1] - edge[0], other[1] - other[0]
    return float(along @ on / np.sqrt((along @ along) * (on @ on)))


def lines_of(edges: np.ndarray) -> list[np.ndarray]:
    """(n, Q, 2) -> the points of each chain of edges: (points, 2)."""
    return [np.vstack([edges[chain, :-1].reshape(-1, 2), edges[chain[-1:], -1]]) for chain in chains(edges)]


def between(ends: np.ndarray, places: np.ndarray) -> np.ndarray:
    """(..., Q, c) along edges -> (..., places, c): linear between their points; places: from 0 to 1."""
    q = ends.shape[-2]
    weights = np.maximum(0, 1 - np.abs((q - 1) * places[:, None] - np.arange(q)))
    return np.einsum("kq,...qc->...kc", weights, ends)


def lengths_of(edges: np.ndarray) -> np.ndarray:
    """(n, Q, 2) -> (n,) mm."""
    return np.hypot(*np.moveaxis(np.diff(edges, axis=1), -1, 0)).sum(1)


def largest_shear(stress: np.ndarray) -> np.ndarray:
    """tau_max = sqrt(((sxx - syy)/2)^2 + sxy^2), MPa; (..., 3) -> (...)."""
    return np.hypot((stress[..., 0] - stress[..., 1]) / 2, stress[..., 2])


def area(starts: np.ndarray, ends: np.ndarray) -> float:
    """Area on the left of edges (..., 2) that form closed lines, mm^2."""
    return float((starts[..., 0] * ends[..., 1] - starts[..., 1] * ends[..., 0]).sum()) / 2


@dataclass(frozen=True)
class Unrolled:
    """Of a face, a chain of n edges with the body on their left."""

    edges: np.ndarray  # (n, Q, 2) mm
    along: np.ndarray  # (n, Q) mm: their points on the picture's axis
    axis: str

    @property
    def closed(self) -> bool:
        return bool((self.edges[0, 0] == self.edges[-1, -1]).all())

    @property
    def limits(self) -> tuple[float, float]:
        return self.along[0, 0], self.along[-1, -1]

    def of(self, points: np.ndarray) -> np.ndarray:
        """(..., 2) -> distance outward and place along, of the nearest point of the face; beyond its
        ends, of the lines that go on from there."""
        flat = points.reshape(-1, 2)
        nearest, found = np.full(len(flat), np.inf), np.empty((len(flat), 2))
        starts, ends = self.edges[:, :-1].reshape(-1, 2), self.edges[:, 1:].reshape(-1, 2)
        last, along = len(starts) - 1, self.along[:, :-1].ravel()
        for k, (start, end) in enumerate(zip(starts, ends)):
            length = np.hypot(*(end - start))
            tangent = (end - start) / length
            t = (flat - start) @ tangent
            low = -np.inf if k == 0 and not self.closed else 0
            high = np.inf if k == last and not self.closed else length
            t_on = np.clip(t, low, high)
            outward = (flat - start) @ (tangent[1], -tangent[0])
            # What lies beyond an end is farther than it is from the line that goes on.
            distance = np.hypot(outward, t - np.clip(t, 0, length))
            sign = np.where(outward < 0, -1, 1)
            closer = distance < nearest
            nearest = np.where(closer, distance, nearest)
            off = np.where(t == t_on, outward, sign * np.hypot(outward, t - t_on))
            found[closer] = np.column_stack([off, along[k] + t_on])[closer]
        return found.reshape(points.shape)

    def seen(self, s: Fields, face: np.ndarray, depth: float) -> Fields:
        """Triangles and edges at most `depth` from the face, in its coordinates; face: its edges in s."""
        low = self.edges.min(axis=(0, 1)) - depth
        high = self.edges.max(axis=(0, 1)) + depth
        # What is wider lies across the beginning of a ring.
        widest = self.limits[1] / 2 if self.closed else np.inf

        def near(shapes: np.ndarray) -> np.ndarray:
            return ((shapes.max(1) > low) & (shapes.min(1) < high)).all(1)

        chosen = near(s.triangles)
        points, stress = self.of(s.points[chosen]), s.stress[chosen]
        kept = np.ptp(points[..., 1], axis=(1, 2)) < widest
        outline = near(s.boundary)
        boundary, role = self.of(s.boundary[outline]), s.role[outline]
        lines = np.ptp(boundary[..., 1], axis=1) < widest
        return replace(s, points=points[kept], stress=stress[kept], boundary=boundary[lines],
                       role=role[lines], traction=s.traction[face], state=s.state[face], of_face=True,
                       load=None, moved=None, normal=None, gap=None, paired=None,
                       edges=np.stack([np.zeros_like(self.along), self.along], -1))


def parts(along: np.ndarray, m: int) -> np.ndarray:
    """(edges, Q) -> (points of the face, 2): start and end of the m-th part of its edge around each point."""
    ends = np.linspace(along[:, 0], along[:, -1], m + 1, axis=1)
    return np.stack([ends[:, :-1], ends[:, 1:]], -1).reshape(-1, 2)


def by_edge(points: np.ndarray) -> np.ndarray | None:
    """(P, columns of CONTACT) -> (E, m, columns), from start to end of each edge. None: these are no edges."""
    for m in range(2, MOST_POINTS + 1):
        if len(points) % m == 0:
            own = points.reshape(-1, m, points.shape[1])
            steps = np.hypot(*np.moveaxis(np.diff(own[..., :2], axis=1), -1, 0))
            lengths = (own[:, 1:, 4] + own[:, :-1, 4]) / 2  # on a curve of the edge as it is there
            if np.allclose((m - 1) * steps, lengths, rtol=0.1):
                return own
    return None


def part_shown(along: np.ndarray, touched: np.ndarray) -> tuple[float, float]:
    """Limits of the part of a face that a picture shows: where its points touch and a little more, if the
    rest is large. along (P, 2) mm: part of the edge around each point; touched (P,)."""
    start, end = along[0, 0], along[-1, 1]
    if not touched.any():
        return start, end
    low, high = along[touched, 0].min(), along[touched, 1].max()
    margin = AROUND * (high - low)
    low, high = max(start, low - margin), min(end, high + margin)
    return (low, high) if high - low < MOST_SHOWN * (end - start) else (start, end)


def unrolled(edges: np.ndarray) -> Unrolled:
    """A straight face along x or y has that coordinate as its axis, others the length from their start."""
    steps = np.hypot(*np.moveaxis(np.diff(edges, axis=1), -1, 0))
    ends = np.cumsum(steps).reshape(steps.shape)
    chord = edges[-1, -1] - edges[0, 0]
    span = np.hypot(*chord)
    along = np.hstack([ends[:, :1] - steps[:, :1], ends])
    for k, name in enumerate("xy"):
        if span > STRAIGHT * ends[-1, -1] and chord[k] > STRAIGHT * span:
            return Unrolled(edges, along + edges[0, 0, k], f"{name}, mm")
    return Unrolled(edges, along, BY_LENGTH)


def read_table(path: Path, header: str,
               words: tuple[str, ...] = (), *others: str) -> tuple[np.ndarray, np.ndarray]:
    """(numbers (rows, columns), words (rows,)); with `words` the last column is one of them.
    Numbers that are not known are NaN. others: headers that are allowed, too."""
    lines = cells_of(path)
    columns = next((other for other in others if lines and lines[0] == other.split(",")),
                   header).split(",")
    if not lines or lines[0] != columns:
        raise RecordsError(f"{path}:1: expected the header {header}")
    cells = np.array(lines[1:], dtype=object).reshape(-1, len(columns))
    for at in np.flatnonzero(~np.isin(cells[:, -1], words)) if words else []:
        raise RecordsError(f"{path}:{at + 2}: {columns[-1]} is '{cells[at, -1]}', expected one of "
                           + ", ".join(words))
    cells, last = cells[:, : len(columns) - bool(words)], cells[:, -1]
    numbers = pd.to_numeric(cells.ravel(), errors="coerce").astype(float).reshape(cells.shape)
    empty = (cells == "") & np.isin(columns[: cells.shape[1]], MAY_BE_EMPTY)
    for at, column in np.argwhere(~np.isfinite(numbers) & ~empty):
        raise RecordsError(f"{path}:{at + 2}: {columns[column]} is '{cells[at, column]}', expected "
                           "a finite number")
    return numbers, last


def recorded(results: Path) -> dict[str, dict]:
    """Name of a case -> its record; empty without records."""
    if not lines_file(results) and not (results / "results.csv").is_file():
        return {}
    table = read_run(results, needed=("mesh", "scene", "method", "n_phi"))
    return {case["case_name"]: case for case in table.to_dict("records")}


def record_of(records: dict[str, dict], name: str) -> dict:
    """Of the files of that name; without a record the mesh is read from it."""
    case = case_of_file(name)
    return records.get(case, {"mesh": case.partition("/")[0], "n_phi": None})


def read_error_share(results: Path, s: Fields) -> np.ndarray:
    """(T,) share of each triangle in the squared discretisation error, all 0 where there is none;
    throws RecordsError."""
    path = results / "fields" / f"{s.name}.error.csv"
    rows, _ = read_table(path, ERROR)
    if not np.array_equal(rows[:, 0], np.arange(len(s.points)) + 1):
        raise RecordsError(f"{path}: {len(rows)} rows; expected one for each of the "
                          f"{len(s.points)} triangles of {s.name}.stress.csv, from 1")
    wrong = np.flatnonzero((rows[:, 1] < 0) | (rows[:, 1] > 1))
    if wrong.size:
        raise RecordsError(f"{path}:{wrong[0] + 2}: error_share is '{rows[wrong[0], 1]:g}', "
                          "expected a number from 0 to 1")
    return rows[:, 1]


def names_in(results: Path, part: str = "stress") -> list[str]:
    """Names of the solutions in results/fields with this part, sorted."""
    folder = results / "fields"
    if not results.is_dir():
        raise RecordsError(f"{results}: no such folder; expected the --out of bench --fields")
    names = sorted(path.name.removesuffix(f".{part}.csv") for path in folder.glob(f"*.{part}.csv"))
    if not names and part == "stress":
        raise RecordsError(f"{folder}: no fields; expected NAME.stress.csv from bench --fields")
    return names


def read_fields(results: Path, name: str, records: dict[str, dict]) -> Fields:
    """One solution; throws RecordsError. Its files must describe the same body. Without cells of a higher
    degree the stresses are taken as linear on each third, and sides as straight."""
    path = {part: results / "fields" / f"{name}.{part}.csv"
            for part in ("stress", "contact", "boundary", "displacement")}
    rows, _ = read_table(path["stress"], STRESS)
    n = len(rows) // 9
    count = np.arange(len(rows))
    order = np.stack([count // 9, count // 3 % 3, count % 3], axis=1) + 1
    if n == 0 or len(rows) % 9 or (rows[:, :3] != order).any():
        raise RecordsError(f"{path['stress']}: {len(rows)} rows; expected nine per triangle, "
                          "thirds 1 to 3 with corners 1 to 3, triangles from 1")
    corners = rows[:, 3:5].reshape(n, 3, 3, 2)
    outline, role = read_table(path["boundary"], BOUNDARY, ROLES, WITHOUT_LOADS)
    boundary, load = outline[:, :4].reshape(-1, 2, 2), None
    if outline.shape[1] > 4:
        load = outline[:, 5:].reshape(-1, 2, 2)
        role = np.where(outline[:, 4] == 1, "rollers", role)

    inside, enclosed = area(corners[:, :, 0], corners[:, :, 1]), area(*boundary.swapaxes(0, 1))
    if not np.isclose(inside, enclosed, rtol=1e-9):
        raise RecordsError(f"{path['boundary']}: encloses {enclosed:.9g} mm^2; expected the "
                          f"{inside:.9g} mm^2 of the triangles in {path['stress'].name}")
    points, state = read_table(path["contact"], CONTACT, STATES, WITHOUT_PIECES)
    contact, of_edges = boundary[role == "contact"], by_edge(points)
    if of_edges is None or not np.array_equal(of_edges[:, [0, -1], :2], contact):
        raise RecordsError(f"{path['contact']}: {len(points)} points; expected start and end of "
                          f"each of the {len(contact)} contact edges of {path['boundary'].name}")
    record, m = record_of(records, name), of_edges.shape[1]
    s = Fields(name, corners, rows[:, 5:].reshape(n, 3, 3, 3), boundary, role, contact,
               traction=of_edges[..., 5:7] / (of_edges[..., 4:5] / m),  # F = (L/m) t
               state=state.reshape(-1, m), mesh=record["mesh"], n_phi=record["n_phi"], load=load,
               moved=moved_boundary(path["displacement"], boundary),
               normal=of_edges[..., 2:4], gap=of_edges[..., 7],
               paired=np.isfinite(of_edges[..., 9]).any(1))
    cells = results / "fields" / f"{name}.vtu"
    return with_cells(s, read_cells(cells), cells) if cells.is_file() else s


def with_cells(s: Fields, cells: Cells, path: Path) -> Fields:
    """The solution with the polynomials of its cells, and with edges along their curves."""
    shape, size = (len(s.points), 3, cells.points.shape[1]), np.ptp(s.boundary, axis=(0, 1)).max()
    if len(cells.points) != 3 * shape[0] or not np.allclose(
            cells.points[:, :3].reshape(s.points.shape), s.points, rtol=0, atol=1e-9 * size):
        raise RecordsError(f"{path}: other triangles than in {s.name}.stress.csv")
    if shape[2] == 3:
        return s
    thirds = {(tuple(start), tuple(end)): k
              for k, (start, end) in enumerate(s.points[:, :, :2].reshape(-1, 2, 2).tolist())}
    own = [thirds.get((tuple(start), tuple(end))) for start, end in s.boundary.tolist()]
    if None in own:
        raise RecordsError(f"{path.with_suffix('.boundary.csv')}:{own.index(None) + 2}: not a side of a triangle")
    s = replace(s, points=cells.points.reshape(*shape, 2), stress=cells.stress.reshape(*shape, 3))
    along = along_side(shape[2], ON_CURVE - 1)
    sides = along @ cells.points[own]
    sides[:, [0, -1]] = s.boundary
    if np.allclose(sides, between(s.boundary, np.linspace(0, 1, ON_CURVE)), rtol=0, atol=1e-9 * size):
        return s
    return replace(s, boundary=sides, edges=sides[s.role == "contact"],
                   moved=None if s.moved is None or cells.moved is None else along @ cells.moved[own])


def moved_boundary(path: Path, boundary: np.ndarray) -> np.ndarray | None:
    """(B, 2, 2) mm: displacement of the edges' ends; None without the file."""
    if not path.is_file():
        return None
    rows, _ = read_table(path, DISPLACEMENT)
    at = {(x, y): u for _, _, x, y, *u in rows[rows[:, 1] <= 3].tolist()}
    ends = [at.get(tuple(end)) for end in boundary.reshape(-1, 2).tolist()]
    if None in ends:
        raise RecordsError(f"{path}: no displacement at {boundary.reshape(-1, 2)[ends.index(None)]}, "
                           "an end of an edge of the boundary")
    return np.array(ends).reshape(-1, 2, 2)
