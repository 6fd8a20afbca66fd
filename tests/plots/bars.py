"""A made-up solution, for pictures of fields."""
import numpy as np

import running  # finds plots

from fields import Fields

STATES = ("open", "slip", "stick", "slip")


def bar(width: float, height: float, faces: int, edges: int = 4, mesh: str = "bar") -> Fields:
    """A rectangle from (1, 2) on with so many contact faces of so many edges on its right side, apart;
    on each the states follow each other, the pressure falls from 8 MPa to 0."""
    left, low = 1.0, 2.0
    corners = np.array([(left, low), (left + width, low), (left + width, low + height),
                        (left, low + height)])
    triangles = corners[[[0, 1, 2], [0, 2, 3]]]
    thirds = np.array([[[t[k], t[(k + 1) % 3], t.mean(0)] for k in range(3)] for t in triangles])
    ends = np.linspace(low, low + height, faces * (edges + 1) + 2)
    right = [((left + width, a), (left + width, b)) for a, b in zip(ends, ends[1:])]
    role = ["contact" if k % (edges + 1) else "force" for k in range(len(right))]
    role[-1] = "force"
    boundary = [(corners[0], corners[1]), *right, (corners[2], corners[3]), (corners[3], corners[0])]
    role = np.array(["force", *role, "force", "displacement"])
    boundary = np.array([[np.asarray(a), np.asarray(b)] for a, b in boundary])
    contact = boundary[role == "contact"]
    of_face = np.arange(len(contact)) % edges
    pressure = 8 * (1 - np.stack([of_face, of_face + 1], 1) / edges)
    state = np.array(STATES)[of_face * len(STATES) // edges]
    return Fields("bar--default--HYBRID", thirds, np.ones((2, 3, 3, 3)), boundary, role, contact,
                  np.stack([-pressure, 0.1 * pressure], -1), np.stack([state, state], 1), mesh, 9)
