"""Contact problems u = W r + q with Coulomb's law, and their solvers."""
from os import PathLike
from typing import Any, Literal

import numpy
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[numpy.float64]


class Problem:
    W: Any
    q: Floats
    gap: Floats
    mu: Floats
    components: int
    name: str
    def __init__(self, W: Any, q: ArrayLike, mu: ArrayLike = 0.0, components: int | None = None) -> None: ...
    def __len__(self) -> int: ...


class Result:
    r: Floats
    u: Floats
    converged: bool
    iterations: int
    newton_steps: int
    residual: float
    history: Floats
    time_s: float


def read(file: str | PathLike[str]) -> Problem: ...
def solve(problem: Problem, solver: Literal["newton", "gauss-seidel", "anderson", "admm"] = "newton", *,
          tolerance: float = 1e-12, max_iterations: int = 100000, timeout: float = 900,
          start: ArrayLike | None = None) -> Result: ...
def judge(problem: Problem, r: ArrayLike) -> dict[str, Any]: ...
