#!/usr/bin/python3
"""Makes one self-contained HTML page from a history of nights.

    page.py HISTORY [RESULTS] [--out=page.html]

HISTORY  folder with nights/*.json, as `bench track` writes them
RESULTS  folder of one run: its records.jsonl is listed instead of the last night's cases, and the
         pictures in its figures/ are shown

The page fetches nothing. Exit 2: wrong input, or a file that cannot be written; one line says which,
and the page that was there stays.
"""
import argparse
import base64
import hashlib
import html
import json
from pathlib import Path

import command
from page_data import OF_A_CASE, page_data, read_history
from records import RecordsError, lines_file, read

PARTS = Path(__file__).resolve().parent / "page"
SCRIPTS = ("format.js", "chart.js", "table.js", "page.js")


def main() -> None:
    command.run(__doc__, add_arguments, make, "a file to write")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("history", type=Path, metavar="HISTORY")
    parser.add_argument("results", type=Path, metavar="RESULTS", nargs="?")
    parser.add_argument("--out", type=Path, default=Path("page.html"))


def make(args: argparse.Namespace) -> None:
    text = page(args.history, args.results)
    command.replace_all(args.out.parent, {args.out.name: command.text_writer(text)})
    print(args.out)


def page(history: Path, results: Path | None) -> str:
    nights, records = read_history(history), None
    if results and not results.is_dir():
        raise RecordsError(f"{results}: no such folder; expected the --out of bench")
    if results and (lines := lines_file(results)):
        records = read(lines, OF_A_CASE)
    data = json.dumps(page_data(nights, records), ensure_ascii=False, allow_nan=False,
                      separators=(",", ":")).replace("<", "\\u003c")
    style = part("page.css")
    script = '(() => {\n"use strict";\n' + "\n".join(map(part, SCRIPTS)) + "})();\n"
    fill = {"STYLE": style, "SCRIPT": script, "DATA": data, "STYLE_HASH": hash_of(style),
            "SCRIPT_HASH": hash_of(script), "TITLE": html.escape(f"airybench {nights[-1].date}"),
            "FIGURES": figures(results / "figures") if results else ""}
    pieces = part("page.html").split("%%")  # text, name, text, name, ... text
    return "".join(fill[piece] if k % 2 else piece for k, piece in enumerate(pieces))


def part(name: str) -> str:
    return (PARTS / name).read_text(encoding="utf-8")


def hash_of(text: str) -> str:
    """As a content security policy names an inline script or style."""
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def figures(folder: Path) -> str:
    shown = []
    for file in sorted(folder.glob("*.png")):
        name = html.escape(file.stem.replace("_", " "))
        image = base64.b64encode(file.read_bytes()).decode()
        shown.append(f'<figure><button type="button" aria-label="enlarge {name}">'
                     f'<img alt="{name}" src="data:image/png;base64,{image}"></button>'
                     f'<figcaption>{name}</figcaption></figure>')
    return "\n".join(shown)


if __name__ == "__main__":
    main()
