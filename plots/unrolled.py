"""Contact faces laid out straight: positions by their distance from a face and their place along it."""
from dataclasses import dataclass, replace

import numpy as np

from fields import Fields

BY_LENGTH = "along the face from its dot, mm"
STRAIGHT = 0.999  # cosine of an axis with a face that is told by that axis


@dataclass(frozen=True)
class Unrolled:
    """Of a face, a chain of n edges with the body on their left."""

    edges: np.ndarray  # (n, 2, 2) mm
    along: np.ndarray  # (n, 2) mm: start and end of each edge, on the picture's axis
    axis: str

    @property
    def closed(self) -> bool:
        """Around a hole, or a whole body."""
        return bool((self.edges[0, 0] == self.edges[-1, 1]).all())

    def of(self, points: np.ndarray) -> np.ndarray:
        """(..., 2) -> distance outward and place along, of the nearest point of the face; beyond its
        ends, of the lines that go on from there."""
        flat = points.reshape(-1, 2)
        nearest, found = np.full(len(flat), np.inf), np.empty((len(flat), 2))
        last = len(self.edges) - 1
        for k, (start, end) in enumerate(self.edges):
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
            found[closer] = np.column_stack([off, self.along[k, 0] + t_on])[closer]
        return found.reshape(points.shape)

    def seen(self, s: Fields, face: np.ndarray, depth: float) -> Fields:
        """The triangles and edges next to the face, so deep, as it sees them; face: its numbers in s."""
        low = self.edges.min(axis=(0, 1)) - depth
        high = self.edges.max(axis=(0, 1)) + depth
        # What is wider lies across the beginning of a ring.
        widest = self.along[-1, 1] / 2 if self.closed else np.inf

        def near(shapes: np.ndarray) -> np.ndarray:
            return ((shapes.max(1) > low) & (shapes.min(1) < high)).all(1)

        chosen = near(s.triangles)
        corners, stress = self.of(s.corners[chosen]), s.stress[chosen]
        kept = np.ptp(corners[..., 1].reshape(len(corners), 9), axis=1) < widest
        outline = near(s.boundary)
        boundary, role = self.of(s.boundary[outline]), s.role[outline]
        lines = np.ptp(boundary[..., 1], axis=1) < widest
        return replace(s, corners=corners[kept], stress=stress[kept], boundary=boundary[lines],
                       role=role[lines], traction=s.traction[face], state=s.state[face], of_face=True,
                       edges=np.stack([np.zeros_like(self.along), self.along], -1))


def unrolled(edges: np.ndarray) -> Unrolled:
    """A straight face along x or y goes by that coordinate, another by its own length from its start."""
    lengths = np.hypot(*(edges[:, 1] - edges[:, 0]).T)
    ends = np.cumsum(lengths)
    chord = edges[-1, 1] - edges[0, 0]
    span = np.hypot(*chord)
    along = np.stack([ends - lengths, ends], 1)
    for k, name in enumerate("xy"):
        if span > STRAIGHT * ends[-1] and chord[k] > STRAIGHT * span:
            return Unrolled(edges, along + edges[0, 0, k], f"{name} in mm")
    return Unrolled(edges, along, BY_LENGTH)
