#!/usr/bin/python3
"""Compares the numbers quoted in README.md and docs/ with the committed records.

docs/numbers.txt quotes phrases, with {} where a number stands, and says below each phrase what the
records must give, a line per number:

    [README.md]
    on Mesh7 {} of 3STEPD's time
      paper: time_s of Mesh7/HYBRID per 3STEPD

    FOLDER: [at most|at least] [least|greatest] QUANTITY of CASES [per [QUANTITY of] METHODS]
            [, KEY=VALUE ...] [in UNIT]

FOLDER is one of results/. QUANTITY is `count`, or column names of results.csv with + - * / and
brackets. CASES is MESH/METHOD; as in a shell * stands for anything, and | separates choices. `per`
divides by the same (or another) quantity of other methods on the same mesh and scene. KEY=VALUE
keeps the rows with that value; stop=target and knob= (not a point of a swept knob) hold unless they
are given. Several cases need `least` or `greatest`. `at most` rounds up, `at least` down, all else
to nearest, to as many significant digits as are written.

A line `EXPRESSION is NUMBER`, `is below NUMBER` or `is above NUMBER` is a condition for words
next to the numbers, such as "less than": the phrase has no {} for it.

Tables stand between <!-- table FOLDER: MESHES / METHODS --> and <!-- end of table -->: as bench prints
them, or, with `/ KEY,KEY` before -->, these values of a method per row and a mesh per column; in
italics where the case is not ok, a dash where there is none.
"""
import argparse
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Decimal
from fnmatch import fnmatchcase
from functools import cache
from itertools import chain
from pathlib import Path

import pandas as pd

from command import replace_all, run, text_writer
from records import KEYS, RecordsError, Row, read, rows_of
from selection import grouped, show_seconds
from selection import value_of as value_of_row
from words import percent, short

PROJECT = Path(__file__).resolve().parent.parent
WORDS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
NUMBER = r"\d{1,3}(?: \d{3})+|\d+(?:\.\d+)?(?:e[+-]?\d+)?|" + "|".join(rf"\b{w}\b" for w in WORDS)
CONDITION = re.compile(r"(?P<expression>.+) is (?P<relation>below |above |)(?P<number>\S+)")
TABLE = re.compile(r"(?P<head><!-- table (?P<folder>[\w/-]+): (?P<mesh>\S+) / (?P<method>\S+)(?: / (?P<keys>\S+))? -->\n)"
                   r"(?P<body>.*?)(?P<end><!-- end of table -->)", re.DOTALL)
UNITS = {None: 1, "%": 0.01, "ms": 1e-3, "min": 60, "h": 3600, "days": 86400, "MiB": 2**20,
         "GiB": 2**30}
ROUNDING = {"at most": ROUND_CEILING, "at least": ROUND_FLOOR, None: ROUND_HALF_EVEN}
EXPRESSION = re.compile(
    r"(?P<folder>[\w/-]+): (?:(?P<bound>at most|at least) )?(?:(?P<which>least|greatest) )?"
    r"(?P<quantity>[\w+*/().-]+) of (?P<mesh>[^\s/]+)/(?P<method>\S+?)"
    r"(?: per (?:(?P<divisor>[\w+*/().-]+) of )?(?P<per>\S+?))?"
    r"(?P<filters>(?:, \w+=\S*?)*)(?: in (?P<unit>\S+))?")


class QuoteError(RecordsError):
    """A phrase or an expression that cannot be used: place and reason."""


@dataclass(eq=False)
class Runs:
    """The committed runs, each read once."""

    results: Path

    @cache
    def of(self, folder: str) -> pd.DataFrame:
        return read(self.results / folder / "results.csv")


def chosen(cases: pd.DataFrame, **wanted: str) -> pd.DataFrame:
    """Key = pattern, or patterns between |."""
    for key, patterns in wanted.items():
        def fits(value: object) -> bool:
            text = "" if value is None else str(value)
            return any(fnmatchcase(text, pattern) for pattern in patterns.split("|"))
        cases = cases[cases[key].map(fits).astype(bool)]
    return cases


def quantity_of(cases: pd.DataFrame, quantity: str) -> pd.Series:
    """NaN where a key is empty."""
    keys = sorted(set(re.findall(r"[a-z]\w*", quantity)))
    return cases[keys].astype(float).eval(quantity, engine="python")


@cache
def value_of(expression: str, runs: Runs) -> tuple[float, str]:
    match = EXPRESSION.fullmatch(expression)
    if not match:
        raise QuoteError(f"'{expression}' cannot be read; expected FOLDER: [at most|at least] "
                         "[least|greatest] QUANTITY of MESH/METHOD [per [QUANTITY of] "
                         "METHODS] [, KEY=VALUE] [in UNIT]")
    if match["unit"] not in UNITS:
        raise QuoteError(f"'{expression}': unit '{match['unit']}', expected one of "
                         f"{', '.join(filter(None, UNITS))}")
    filters = {"stop": "target", "knob": ""}
    filters |= dict(pair.split("=", 1) for pair in match["filters"].split(", ")[1:])
    run = runs.of(match["folder"])
    names = re.findall(r"[a-z]\w*", f"{match['quantity']} {match['divisor'] or ''}")
    for name in {*filters, *names} - {"count"}:
        if name not in KEYS:
            raise QuoteError(f"'{expression}': no column {name}")
    cases = chosen(run, mesh=match["mesh"], method=match["method"], **filters)
    if match["quantity"] == "count":
        return float(len(cases)), ROUNDING[None]
    cases = cases.assign(value=quantity_of(cases, match["quantity"]))
    if match["per"]:
        others = chosen(run, method=match["per"], **filters)
        divisor = quantity_of(others, match["divisor"] or match["quantity"])
        others = others.assign(divisor=divisor.where(divisor != 0))
        cases = cases[["mesh", "scene", "value"]].merge(others[["mesh", "scene", "divisor"]])
        cases["value"] /= cases.divisor
    values = cases.value.dropna()
    if values.empty or (match["which"] is None and len(values) > 1):
        raise QuoteError(f"'{expression}': {len(values) or 'no'} values, expected "
                         f"{'one' if match['which'] is None else 'some'}")
    value = values.max() if match["which"] == "greatest" else values.min()
    return float(value) / UNITS[match["unit"]], ROUNDING[match["bound"]]


@dataclass(frozen=True)
class Quote:
    place: str  # in docs/numbers.txt
    file: str
    phrase: str
    expressions: list[str]  # in the order of the {}
    conditions: list[str]


@dataclass(frozen=True)
class Difference:
    file: str
    line: int
    written: str
    records: str
    source: str
    span: tuple[int, int]     # of the file
    replacement: str | None   # None: the numbers are right, the words are not: for an author

    def sentence(self) -> str:
        return (f"{self.file}:{self.line}: '{self.written}', but the records give "
                f"'{self.records}' ({self.source})")


def shown(value: float, rounding: str, like: str) -> str:
    """The value in the form of a number as it is written: words, exponent, digits, groups."""
    if like in WORDS:
        return WORDS[int(value)] if value in range(len(WORDS)) else f"{value:g}"
    mantissa, _, exponent = like.partition("e")
    digits = len(mantissa.replace(".", "").replace(" ", "").lstrip("0")) or 1
    exact = Decimal(repr(value))
    if not exact:
        return "0"
    last = exact.adjusted() - digits + 1
    if not exponent:
        last = min(last, 0)  # never coarser than a whole number

    def to(place: int) -> Decimal:
        return exact.quantize(Decimal(1).scaleb(place), rounding=rounding)

    def grows(number: Decimal) -> bool:
        return number.adjusted() > exact.adjusted()

    rounded = to(last)
    if grows(rounded) and last == 0 and not exponent:  # 9.78 is 9.8: 10 would say more
        last, rounded = -1, to(-1)
    if grows(rounded) and last < 0:  # 0.0996 is 0.10
        rounded = rounded.quantize(Decimal(1).scaleb(last + 1))
    if exponent:
        text, power = f"{rounded:.{digits - 1}e}".split("e")
        return f"{text}e{int(power)}"
    return f"{rounded:,f}".replace(",", " ") if " " in like else f"{rounded:f}"


def quotes_in(path: Path) -> list[Quote]:
    file, quote, quotes = "", None, []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        place = f"{path}:{number}"
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("[") and line.endswith("]"):
            file, quote = line[1:-1], None
        elif not line.startswith(" "):
            quote = Quote(place, file, line, [], [])
            quotes.append(quote)
        elif quote is None:
            raise QuoteError(f"{place}: what the records must give without a phrase above it")
        else:
            lines = quote.conditions if CONDITION.fullmatch(line) else quote.expressions
            lines.append(line.strip())
    return quotes


def found(quote: Quote, text: str) -> re.Match:
    """The one place of the phrase, with a group per number; lines may break at any space."""
    parts = [r"\s+".join(map(re.escape, re.split(r"\s+", part)))
             for part in quote.phrase.split("{}")]
    if len(parts) - 1 != len(quote.expressions):
        raise QuoteError(f"{quote.place}: {len(parts) - 1} numbers in the phrase, but "
                         f"{len(quote.expressions)} lines say what the records must give")
    places = list(re.finditer(rf"({NUMBER})".join(parts), text))
    if len(places) != 1:
        raise QuoteError(f"{quote.place}: '{quote.phrase}' stands {len(places)} times in "
                         f"{quote.file}; expected once")
    return places[0]


def holds(relation: str, value: float, number: float) -> bool:
    return value < number if relation == "below " else value > number if relation == "above " \
        else value == number


def differences_of(quote: Quote, text: str, runs: Runs) -> Iterator[Difference]:
    match = found(quote, text)

    def value(expression: str) -> tuple[float, str]:
        try:
            return value_of(expression, runs)
        except QuoteError as error:
            raise QuoteError(f"{quote.place}: {error}")

    def difference(group: int, right: str, source: str) -> Difference:
        return Difference(quote.file, text.count("\n", 0, match.start(group)) + 1,
                          " ".join(match[group].split()), right, source, match.span(group),
                          right if group else None)

    for group, expression in enumerate(quote.expressions, 1):
        right = shown(*value(expression), match[group])
        if match[group] != right:
            yield difference(group, right, expression)
    for line in quote.conditions:
        expression, relation, number = CONDITION.fullmatch(line).groups()
        right = value(expression)[0]
        if not holds(relation, right, float(number)):
            yield difference(0, f"{right:.6g}", line)


OF_THE_MESH = ("error_total", "error_discretisation")  # in per cent
HEADS = ("case", "n_phi", "time", "±", "heap", "error stress", "error force", "status")


def cells_of(row: Row) -> tuple[str, ...]:
    def number(value: float | None, show: str) -> str:
        return "-" if value is None else format(value, show)
    return (row.case_name, str(row.n_phi), show_seconds(row.time_s),
            "n=1" if row.repetitions == 1 else show_seconds(row.time_mad_s or 0),
            number(value_of_row(row, "peak_heap_bytes"), ".1f") + " MiB",
            number(row.error_stress, ".1e"), number(row.error_force, ".1e"), row.status)


def in_words(key: str, value: float | None) -> str:
    if value is None:
        return "—"
    if key.endswith("_bytes"):
        return f"{value:.3g} MiB"
    return show_seconds(value) if key.endswith("_s") else percent(value) if key in OF_THE_MESH else short(value)


def table_by_mesh(rows: list[Row], keys: list[str]) -> str:
    meshes = list(dict.fromkeys(row.mesh for row in rows))
    lines = [["", *meshes], ["---"] * (len(meshes) + 1)]
    for method, own in grouped(rows, lambda row: row.method).items():
        cells = {row.mesh: ", ".join(in_words(key, value_of_row(row, key)) for key in keys) for row in own}
        cells |= {row.mesh: f"*{cells[row.mesh]}*" for row in own if row.status != "ok"}
        lines.append([method.removeprefix("EXTERNAL:"), *(cells.get(mesh, "—") for mesh in meshes)])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def table(rows: list[Row]) -> str:
    """As `bench` prints it (support/text_table.cpp), a line of dots between meshes."""
    cells = [HEADS, *map(cells_of, rows)]
    widths = [max(map(len, column)) for column in zip(*cells)]
    lines = []
    for i, line in enumerate(cells):
        if i > 1 and rows[i - 1].mesh != rows[i - 2].mesh:
            lines.append("…")
        lines.append("  ".join(cell.rjust(width) if 1 <= column < len(HEADS) - 1 else cell.ljust(width)
                               for column, (cell, width) in enumerate(zip(line, widths))).rstrip())
    return "```\n" + "\n".join(lines) + "\n```\n"


def differing_tables(file: str, text: str, runs: Runs) -> Iterator[Difference]:
    tables = list(TABLE.finditer(text))
    if len(tables) != text.count("<!-- table"):
        raise QuoteError(f"{file}: {text.count('<!-- table')} comments begin a table, "
                         f"{len(tables)} of them can be read; expected <!-- table FOLDER: MESHES / "
                         "METHODS --> or ... / METHODS / KEYS -->, and <!-- end of table -->")
    for match in tables:
        cases = runs.of(match["folder"])
        keys = match["keys"].split(",") if match["keys"] else []
        for key in filter(lambda key: key not in KEYS, keys):
            raise QuoteError(f"{file}: {match['head'].strip()}: no column {key}")
        for key, pattern in ((key, pattern) for key in ("mesh", "method") for pattern in match[key].split("|")):
            if chosen(cases, **{key: pattern}).empty:
                raise QuoteError(f"{file}: {match['head'].strip()}: no case of {pattern} in {match['folder']}")
        rows = [row for mesh in match["mesh"].split("|") for method in match["method"].split("|")
                for row in rows_of(chosen(cases, mesh=mesh, method=method, stop="target"))
                if row.completed or keys]
        right = table_by_mesh(rows, keys) if keys else table(rows)
        if match["body"] != right:
            before, after = match["body"].splitlines(), right.splitlines()
            # Reports the first line that differs, not the whole table.
            i = next((i for i, pair in enumerate(zip(before, after)) if pair[0] != pair[1]),
                     min(len(before), len(after)))
            yield Difference(file, text.count("\n", 0, match.start("body")) + 1 + i,
                             "".join(before[i:i + 1]), "".join(after[i:i + 1]),
                             match["head"].strip(), match.span("body"), right)


def differences(project: Path) -> dict[str, list[Difference]]:
    """By file, in the order of the text."""
    runs = Runs(project / "results")
    quotes = grouped(quotes_in(project / "docs" / "numbers.txt"), lambda quote: quote.file)
    pages = {*quotes, "README.md", *(f"docs/{page.name}" for page in (project / "docs").glob("*.md"))}
    texts = {file: (project / file).read_text(encoding="utf-8") for file in sorted(pages)}
    return {file: sorted(chain(differing_tables(file, text, runs), *(
        differences_of(quote, text, runs) for quote in quotes.get(file, []))), key=lambda d: d.span)
        for file, text in texts.items()}


def rewrite(project: Path, by_file: dict[str, list[Difference]]) -> None:
    for file, of_file in by_file.items():
        path = project / file
        text = path.read_text(encoding="utf-8")
        for difference in reversed(of_file):
            if difference.replacement is not None:
                start, end = difference.span
                text = text[:start] + difference.replacement + text[end:]
        replace_all(path.parent, {path.name: text_writer(text)})


def add_arguments(parser: argparse.ArgumentParser) -> None:
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--check", action="store_true",
                      help="list the numbers that the records do not give; exit status 1 if any")
    what.add_argument("--write", action="store_true",
                      help="rewrite them; exit status 1 if words next to them no longer hold")
    parser.add_argument("--project", type=Path, default=PROJECT, help="default: this one")


def check_or_write(arguments: argparse.Namespace) -> None:
    by_file = differences(arguments.project)
    if arguments.write:
        rewrite(arguments.project, by_file)
    every = list(chain.from_iterable(by_file.values()))
    for difference in every:
        print(difference.sentence())
    if any(difference.replacement is None or arguments.check for difference in every):
        sys.exit(1)


def main() -> None:
    run(__doc__, add_arguments, check_or_write, "a file of the project")


if __name__ == "__main__":
    main()
