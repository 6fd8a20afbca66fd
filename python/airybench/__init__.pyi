"""Types of the module; its documentation is that of help(airybench)."""
from collections.abc import Callable, Iterable, Iterator
from os import PathLike
from typing import Any, Literal

import numpy
import pandas
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from . import contact as contact

Floats = NDArray[numpy.float64]
ContactSolver = Literal["newton", "gauss-seidel", "anderson", "admm"]
__version__: str


class InputError(ValueError): ...
class Breakdown(ArithmeticError): ...
class Timeout(TimeoutError): ...


class Arrays:
    """Attributes are NumPy arrays or scipy.sparse.csr_matrix; print() lists them with their units."""
    def __getattr__(self, name: str) -> Any: ...
    def __dir__(self) -> list[str]: ...


class Method:
    name: str
    family: str
    summary: str
    degree: int
    in_paper: bool


class Problem:
    name: str
    scene: dict[str, Any]
    n_phi: int
    mesh: Arrays
    def __init__(self, mesh: str | PathLike[str], /, scene: dict[str, Any] | str | PathLike[str] | None = None,
                 **keys: Any) -> None: ...
    def body(self) -> Arrays: ...
    def airy_system(self) -> Arrays: ...
    def hybrid_system(self, degree: int = 1) -> Arrays: ...
    def condensed(self, degree: int = 1) -> contact.Problem: ...
    def solve(self, method: str | Method = "HYBRID", *, degree: int | None = None, timeout: float = 900,
              target_error: float = ..., tolerance: float = ..., max_iterations: int = ...,
              contact: ContactSolver = ..., contact_tolerance: float = ..., threads: int = ...,
              stop: Literal["target", "paper"] = ...) -> Solution: ...
    def judge(self, solution: Solution | None = None, *, forces: ArrayLike | None = None, degree: int = 1,
              target_error: float = 1e-6) -> dict[str, Any]: ...
    def adapt(self, *, error: float | None = None, unknowns: int | None = None,
              degree: int | Literal["auto"] = "auto", marking: float | None = None, threads: int = 1,
              timeout: float = 900) -> Levels: ...


class Solution:
    status: str
    message: str
    method: str
    problem: Problem
    time_s: float
    times_s: dict[str, float]
    error_estimate: float | None
    history: dict[str, Floats]
    linear_iterations: int | None
    contact_iterations: int | None
    parameters: str
    forces: Floats
    contact_displacement: Floats
    stresses: Floats
    degree: int
    steps: list[Solution]
    def stress(self, x: ArrayLike, y: ArrayLike) -> tuple[Floats, Floats, Floats]: ...
    def pressure(self) -> pandas.DataFrame: ...
    def answer(self) -> dict[str, Any]: ...
    def plot(self) -> Figure: ...


class Levels(Iterator[Level]):
    def __iter__(self) -> Levels: ...
    def __next__(self) -> Level: ...


class Level:
    problem: Problem
    solution: Solution
    number: int
    unknowns: int
    error: float | None
    squared_errors: Floats
    time_s: float


def methods() -> list[Method]: ...
def method(name: str, *, reads: Literal["condensed", "airy", "body"] = "condensed",
           elements: Literal["P2", "other"] = "P2", degree: int = 1, summary: str = "") -> Callable[[Callable[[Any], ArrayLike]], Method]: ...
def bench(mesh: str | Iterable[str] | None = None, methods: str | Method | Iterable[str | Method] = (),
          out: str | PathLike[str] = "results/latest", **options: Any) -> pandas.DataFrame: ...
def read(results: str | PathLike[str]) -> pandas.DataFrame: ...
