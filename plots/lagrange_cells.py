"""Reads the cells of NAME.vtu, as `bench --fields` writes them: Lagrange triangles, in VTK's order of points.

A cell is the third k of a triangle with the corners v_k, v_k+1, centroid; its first side may be curved.
"""
import base64
from dataclasses import dataclass
from math import comb
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from records import RecordsError


@dataclass(frozen=True)
class Cells:
    """N cells of P points."""

    points: np.ndarray        # (N, P, 2) mm
    stress: np.ndarray        # (N, P, 3) MPa: sxx, syy, sxy
    moved: np.ndarray | None  # (N, P, 2) mm: displacement; None: unknown


def degree_of(points: int) -> int:
    return round(np.sqrt(2 * points + 0.25) - 1.5)


def steps_of(n: int) -> np.ndarray:
    """(P, 3) parts of the corners, n in all: these, the sides 01, 12, 20 without them, then the triangle inside."""
    if n == 0:
        return np.zeros((1, 3))
    inner = range(1, n)
    outside = np.array([(n, 0, 0), (0, n, 0), (0, 0, n), *((n - i, i, 0) for i in inner),
                        *((0, n - i, i) for i in inner), *((i, 0, n - i) for i in inner)])
    return outside if n < 3 else np.vstack([outside, 1 + steps_of(n - 3)])


def bernstein(weights: np.ndarray, degree: int) -> np.ndarray:
    """(..., 3) -> (..., P) values of the polynomials."""
    a, b, c = np.moveaxis(weights, -1, 0)
    return np.stack([comb(degree, i) * comb(degree - i, j) * a**(degree - i - j) * b**j * c**i
                     for i in range(degree + 1) for j in range(degree + 1 - i)], -1)


def interpolation(points: int, weights: np.ndarray) -> np.ndarray:
    """(..., 3) places in a cell -> (..., P): what the values at its points count there."""
    degree = degree_of(points)
    return bernstein(weights, degree) @ np.linalg.inv(bernstein(steps_of(degree) / degree, degree))


def along_side(points: int, parts: int) -> np.ndarray:
    """(parts + 1, P): the same at equal parts of a cell's first side."""
    s = np.linspace(0, 1, parts + 1)
    return interpolation(points, np.stack([1 - s, s, 0 * s], -1))


def read_cells(path: Path) -> Cells:
    """Throws RecordsError."""
    try:
        piece = ElementTree.parse(path).getroot().find("UnstructuredGrid/Piece")
        count = int(piece.get("NumberOfCells"))

        def array(at: str, components: int) -> np.ndarray:
            binary = base64.b64decode(piece.find(at).text)[8:]  # behind their number
            return np.frombuffer(binary).reshape(count, -1, components)

        points = array("Points/DataArray", 3)[..., :2]
        moved = "PointData/DataArray[@Name='displacement_mm']"
        return Cells(points, array("PointData/DataArray[@Name='stress_MPa']", 3),
                     None if piece.find(moved) is None else array(moved, 3)[..., :2])
    except (ElementTree.ParseError, AttributeError, ValueError, TypeError) as error:
        raise RecordsError(f"{path}: not as bench --fields writes it: {error}") from None
