"""Words and numbers of figures: captions, cases without a point, the CSV next to a picture."""
import csv
import io
import re
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from operator import attrgetter

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath

from records import FIELDS, Row
from selection import grouped

Column = str | tuple[str, Callable[[object], object]]  # an attribute, or a name and what it is

CASE = ("mesh", "body", "n_phi", "scene", "method", "stop", "status")  # which one a line is of
KNOB = ("knob", "knob_value")
EXTRAPOLATED = ("extrapolated_time_s", "done_fraction")  # of one that reached its time limit


def csv_of(items: Iterable[object], *columns: Column) -> str:
    """A line per item below the columns' names; numbers are not rounded, None is empty."""
    named = [(column, lambda item, name=column: getattr(item, name)) if isinstance(column, str)
             else column for column in columns]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(name for name, _ in named)
    writer.writerows([cell(of(item)) for _, of in named] for item in items)
    return text.getvalue()


def columns_of(part: Callable[[object], object], *names: str) -> list[Column]:
    """Attributes of a part of the item; empty where that is None."""
    return [(name, lambda item, name=name: getattr(part(item), name, None)) for name in names]


def cell(value: object) -> object:
    """As in results.csv: true and false; a ' before what a spreadsheet would take for a formula."""
    if value is None or isinstance(value, bool):
        return "" if value is None else str(value).lower()
    if isinstance(value, str) and value[:1] in tuple("=+-@'"):
        return "'" + value
    return value


def axis_label(key: str) -> str:
    """peak_heap_bytes -> peak heap, MiB."""
    field = FIELDS[key]
    unit = {"1": "", "B": "MiB"}.get(field["unit"], field["unit"])
    return ", ".join(filter(None, (field["label"], unit)))


def short(value: float) -> str:
    """0.000012 -> 1e-5."""
    mantissa, exponent = f"{value:.0e}".split("e")
    return f"{mantissa}e{int(exponent)}" if value else "0"


def percent(value: float) -> str:
    """0.0712 -> 7.1 %; what is too small for that as 1e-6, what is nearly all or more as 0.997, 1.2."""
    if not 1e-4 <= value < 100:
        return short(value)
    return f"{100 * value:.2g}\u00a0%" if value < 0.995 else f"{value:.{3 if value < 1 else 2}g}"


def seconds(value: float) -> str:
    return f"{1e3 * value:.2g}\u00a0ms" if value < 0.0995 else f"{value:.2g}\u00a0s" \
        if value < 99.5 else f"{value:.0f}\u00a0s"


def counted(count: int, noun: str, nouns: str = "") -> str:
    return f"{count} {noun if count == 1 else nouns or f'{noun}s'}"


def span(values: Iterable[int]) -> str:
    low, high = min(values := set(values)), max(values)
    return f"{low}" if low == high else f"{low} to {high}"


def threads(rows: list[Row]) -> str:
    count = span(row.threads for row in rows)
    return f"{count} thread{'' if count == '1' else 's'}"


def plain(text: str) -> str:
    """Text in which $ does not begin a formula."""
    return text.replace("$", r"\$")


@cache
def width_of(words: str, size_pt: float, weight: str = "normal") -> float:
    font = FontProperties(size=size_pt, weight=weight)
    return TextToPath().get_text_width_height_descent(words.replace("$", ""), font, False)[0]


def merged(cases: list[str]) -> str:
    """'ALM on Mesh1', 'ALM on Mesh2' -> 'ALM on Mesh1, Mesh2'."""
    methods = grouped((case.partition(" on ") for case in cases), lambda parts: parts[0])
    return ", ".join(f"{method} on {', '.join(mesh for *_, mesh in on)}" if on[0][2] else method
                     for method, on in methods.items())


def cases_by_reason(reasons: dict[str, list[str]]) -> str:
    return "; ".join(f"{merged(cases)} ({reason})" for reason, cases in reasons.items())


def no_point(rows: list[Row]) -> str:
    """The cases that were not solved; empty if there are none."""
    failed = grouped([row for row in rows if not row.completed], Row.status_words)
    words = cases_by_reason({why: list(dict.fromkeys(f"{row.method} on {row.mesh}" for row in own))
                             for why, own in failed.items()})
    return f"No point: {words}." if words else ""


def left_out(run: list[Row], drawn: list[Row], why: Callable[[Row], str]) -> str:
    """The methods of a run that have nothing in a figure, with the reason; empty if there are none."""
    shown = {row.general_name for row in drawn}
    absent = grouped((row for row in run if row.general_name not in shown), lambda row: row.general_name)
    rows = [next((row for row in own if row.completed), own[0]) for own in absent.values()]
    reasons = grouped(rows, lambda row: why(row) if row.completed else row.status_words())
    words = "; ".join(f"{names_of(own)} ({reason})" for reason, own in reasons.items())
    return f"Not drawn: {words}." if words else ""


def unseen(run: list[Row], drawn: list[Row], why: Callable[[Row], str]) -> list[str]:
    """Cases of a run without an answer or a point, and methods that have one but nothing in the figure."""
    lines = {row.line for row in drawn}
    return [no_point([row for row in run if row.line not in lines]),
            left_out([row for row in run if row.completed], drawn, why)]


def lacking(rows: list[Row], panels: Mapping[str, Callable[[Row], object]],
            name: Callable[[Row], str] = attrgetter("method")) -> str:
    """What is drawn in some panels only: 'No peak heap: P2. ...'; empty if all is in all of them."""
    own = grouped(rows, name)
    absent = {panel: [name for name, group in own.items() if all(of(row) is None for row in group)]
              for panel, of in panels.items()}
    return " ".join(f"No {panel}: {', '.join(names)}." for panel, names in absent.items() if names)


def names_of(rows: list[Row]) -> str:
    few = 3
    methods = grouped(rows, lambda row: row.family).items()
    return ", ".join(", ".join(row.method for row in own) if len(own) <= few else
                     f"{len(own)} of {family}" for family, own in methods)


def at_stop(rows: list[Row]) -> str:
    """Behind the title of a figure that shows one stop."""
    return ", with the paper's stops" if rows[0].stop == "paper" else ""


def targets(rows: list[Row]) -> list[str]:
    found = {row.target_error for row in rows} - {None}
    for row in rows:
        told = re.search(r"above the target (\d+(?:\.\d+)?(?:e[+-]?\d+)?)", row.status_reason)
        found |= {float(told[1])} if told and not row.target_error else set()
    return [short(error) if float(short(error)) == error else f"{error:g}"
            for error in sorted(found)]


def caption(rows: list[Row], measured: str, run: list[Row]) -> str:
    """What was measured and how: scene, stop, target, threads. run: all rows of its stop."""
    target = "target error " + (" or ".join(targets(run)) or "of the run")
    stop = (f"Iterations run to the {target}." if rows[0].stop == "target" else
            f"Iterations end by the paper's own stops; {target}.")
    return f"{measured}; {threads(rows)}. Scene {rows[0].scene}. {stop}"


def time_caption(rows: list[Row], run: list[Row]) -> str:
    words = "Time of one solve, from assembled blocks to contact forces and stresses"
    done = {row.repetitions for row in rows if row.completed}
    if done:
        words += f", median of {span(done)} repetition{'' if done == {1} else 's'}"
    words = caption(rows, words, run)
    if any(row.tuning_s for row in rows):
        words += " The time does not include the search for tolerances and parameters."
    return words
