"""The numbers of a figure, for the CSV beside it: a line per item drawn, units in the columns' names."""
from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable

Column = str | tuple[str, Callable[[object], object]]  # an attribute, or a name and what it is

CASE = ("mesh", "body", "n_phi", "scene", "method", "stop", "status")  # which one a line is of
KNOB = ("knob", "knob_value")
EXTRAPOLATED = ("extrapolated_time_s", "done_fraction")  # of one that reached its time limit


def csv_of(items: Iterable[object], *columns: Column) -> str:
    """A line per item under the columns' names, numbers unrounded; what is not there is empty."""
    named = [(column, lambda item, name=column: getattr(item, name)) if isinstance(column, str)
             else column for column in columns]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(name for name, _ in named)
    writer.writerows([cell(of(item)) for _, of in named] for item in items)
    return text.getvalue()


def cell(value: object) -> object:
    """As in results.csv: true and false; a ' before what a spreadsheet would take for a formula."""
    if value is None or isinstance(value, bool):
        return "" if value is None else str(value).lower()
    if isinstance(value, str) and value[:1] in tuple("=+-@'"):
        return "'" + value
    return value
