"""Contact with dry friction in stresses: problems, solvers, and the judge of what they return.

    import airybench as ab
    problem = ab.Problem("Mesh3", friction=0.3)
    solution = problem.solve("HYBRID", degree=2)
    problem.judge(solution)["error_total"]

Lengths are in mm, forces in N per mm of thickness, stresses in MPa, times in seconds. Unusable input
raises InputError, whose text is the line that bench prints. Arrays are views that cannot be written;
each keeps its owner alive. docs/python.md is the tutorial.
"""
from __future__ import annotations

import io
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterable
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from . import _airybench
from ._airybench import (Arrays, Breakdown, InputError, Level, Levels, Method, Problem, Solution, Timeout,
                         __version__, contact, methods)

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

__all__ = ["Arrays", "Breakdown", "InputError", "Level", "Levels", "Method", "Problem", "Solution",
           "Timeout", "bench", "contact", "method", "methods", "read"]
sys.modules[__name__ + ".contact"] = contact
_drawings: dict[str, ModuleType] = {}

if core := _airybench._better_blas_core():
    warnings.warn(f"OpenBLAS does not know this processor and is slow: set OPENBLAS_CORETYPE={core} "
                  "before Python starts")


def method(name: str, *, reads: str = "condensed", elements: str = "P2", degree: int = 1,
           summary: str = "") -> Callable[[Callable], Method]:
    """Makes a callable a method, for Problem.solve() and bench().

    reads: what it gets and returns.
    condensed: a contact.Problem; returns r, N, of its rows. The rest is HYBRID's, with stresses of
    that degree.
    airy: the arrays of Problem.airy_system(); returns x with S x + C_F' l + C_C' l' = q.
    body: the arrays of Problem.body(); returns u, mm: a row x, y per vertex, then per edge, at its
    middle (of linear elements the mean of its ends). Those of other elements than quadratic ones
    (elements="other") are judged by their total error alone.
    """
    def decorate(function: Callable) -> Method:
        return _airybench._method(function, name, reads, elements, degree,
                                  summary or (function.__doc__ or name).split("\n")[0])
    return decorate


def bench(mesh: str | Iterable[str] | None = None, methods: str | Method | Iterable[str | Method] = (),
          out: str | Path = "results/latest", **options: object) -> pandas.DataFrame:
    """Measures methods on meshes, each case in a process of its own, as the command bench does.

    mesh: None: Mesh0, or what problem="file.hdf5" names. methods: names, or what @method made; none:
    those of the paper. options: those of bench, with _ for -: scene="scene.json", repetitions=3,
    adapt="1%", degree=2, fields=True, timeout=10 (seconds; of your functions, too). Records, judged
    and timed, go to the folder `out`; returned are those of this run, as of read(). The heap is not
    counted here, and the resident memory contains that of Python.
    """
    def listed(items: object) -> list:
        return [items] if isinstance(items, (str, Path, Method)) else list(items)
    chosen = listed(methods)
    names = [item.name if isinstance(item, Method) else str(item) for item in chosen]
    if len(set(names)) < len(names):
        raise InputError(f"methods: {', '.join(names)} (allowed: every name once)")
    arguments = [f"--out={out}"]
    if mesh is not None or "problem" not in options:
        arguments.append(f"--mesh={','.join(map(str, listed('Mesh0' if mesh is None else mesh)))}")
    if chosen:
        arguments.append("--method=" + ",".join(names))
    for key, value in options.items():
        option = "--" + key.replace("_", "-")
        arguments += [option] * bool(value) if isinstance(value, bool) else [f"{option}={value}"]
    cases = _airybench._bench(arguments, [m for m in chosen if isinstance(m, Method)])
    table = read(out)
    return table[table.case_name.isin(cases)].reset_index(drop=True)


def read(results: str | Path) -> pandas.DataFrame:
    """The records of a folder of results, a row per case; results/README.md has the columns."""
    import pandas

    records = _plots("records")
    file = Path(results)
    if file.is_dir():
        file = file / "records.jsonl"
        file = file if file.exists() else file.with_name("records.jsonl.gz")
    try:
        return pandas.DataFrame(records.read_lines(file))
    except records.RecordsError as error:
        raise InputError(str(error)) from None


def _plots(name: str) -> ModuleType:
    """A module of the project's drawings.

    These import one another by names that scripts have, too (records, fields): only meanwhile are
    they found by them.
    """
    if name not in _drawings:
        folder = _airybench._data_folder("plots")
        names = {file.stem for file in Path(folder).iterdir()}

        def taken() -> dict[str, ModuleType]:
            return {key: sys.modules.pop(key) for key in list(sys.modules) if key.partition(".")[0] in names}
        theirs = taken()
        sys.modules.update(_drawings)
        sys.path.insert(0, folder)
        try:
            import_module(name)
        finally:
            sys.path.remove(folder)
            _drawings.update(taken())
            sys.modules.update(theirs)
    return _drawings[name]


def _pressure(self: Solution) -> pandas.DataFrame:
    """Pressure, shear, gap and slip along the contact faces, a row per point."""
    import pandas

    return pandas.read_csv(io.StringIO(self._faces_csv()))


def _plot(self: Solution) -> Figure:
    """Draws stresses, displaced outline and contact, as the pictures of bench --fields."""
    import matplotlib.pyplot as plt

    fields, gallery = _plots("fields"), _plots("gallery")
    with tempfile.TemporaryDirectory() as folder, plt.rc_context(gallery.STYLE):
        name, results = self._write(folder), Path(folder)
        return gallery.compose([[fields.read_fields(results, name, fields.recorded(results))]])


Solution.pressure, Solution.plot = _pressure, _plot
