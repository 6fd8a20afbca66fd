"""Error of the meshes over the number of unknowns: as they are, refined everywhere, adapted."""
from collections.abc import Iterator

import numpy as np

from catalogue import DASHED, DOTTED
from drawing import Drawing, Sheet, log_limits, log_log
from records import Row
from selection import adapting, by_body, by_mesh, exponent, grouped, is_paper_stop, kind_of, of_mesh, of_scene
from words import axis_label, columns_of, csv_of, left_out, plain

BODIES = 4  # that there is room for
LOOKS = {"as they are": dict(color="0.35", marker="s", markersize=5, linestyle=DASHED),
         "refined everywhere": dict(color="#4B6BC8", marker="D", markersize=5, linestyle=DOTTED)}

Line = tuple[str, list[Row], list[float]]  # name, a row per mesh, errors


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    run = of_scene([row for row in rows if row.n_phi and row.completed and (not row.study or row.points == "accuracy")
                    and (row.error_discretisation or row.error_total) and not is_paper_stop(row)])
    bodies = {body: own for body, own in by_body(run).items() if any(len(line) > 1 for _, line, _ in lines_of(own))}
    shown = [row for own in list(bodies.values())[:BODIES] for row in own]
    if shown:
        yield Drawing("convergence", shown, draw, table_of, dict(run=run))


def lines_of(rows: list[Row]) -> list[Line]:
    """Of a body. An adapted mesh has the total error of the method that adapted it, another the discretisation error
    of the lowest degree."""
    lines = []
    for kind in LOOKS:
        own = by_mesh(of_mesh([row for row in rows if kind_of(row) == kind])).values()
        lines.append((kind, [mesh[0] for mesh in own],
                      [float(np.median([row.error_discretisation for row in mesh])) for mesh in own]))
    adapted = grouped([row for row in rows if kind_of(row) == "adapted" and row.error_total], adapting)
    for method, own in adapted.items():
        loop = [min(mesh, key=lambda row: row.error_total) for mesh in by_mesh(
            [row for row in own if method in (row.method, row.general_name)] or own).values()]
        lines.append((f"adapted by {loop[0].label}", loop, [row.error_total for row in loop]))
    return [line for line in lines if line[1]]


def rate(line: Line) -> float | None:
    """p of error ~ n_phi^p; of adapted meshes with at least 1.5 times the first one's unknowns."""
    name, rows, errors = line
    late = [(row.n_phi, error) for row, error in zip(rows, errors)
            if name in LOOKS or row.n_phi >= 1.5 * rows[0].n_phi]
    return exponent([n for n, _ in late], [error for _, error in late], least=2)


def table_of(rows: list[Row]) -> str:
    lines = [(row, error, line) for own in by_body(rows).values() for line in lines_of(own)
             for row, error in zip(*line[1:])]
    return csv_of(lines, *columns_of(lambda line: line[0], "scene", "body", "mesh", "n_phi", "method"),
                  ("meshes", lambda line: line[2][0]), ("error", lambda line: line[1]),
                  ("rate", lambda line: rate(line[2])),
                  *columns_of(lambda line: line[0], "lower_bound_Nmm", "upper_bound_Nmm"))


def style_of(line: Line) -> dict[str, object]:
    return line[1][0].look.line() | LOOKS.get(line[0], {})


def draw(rows: list[Row], width: float, run: list[Row]) -> Sheet:
    bodies = {body: lines_of(own) for body, own in by_body(rows).items()}
    every = [line for lines in bodies.values() for line in lines]
    rates = [f"{body}, {name}: {power:.2f}" for body, lines in bodies.items() for name, own, errors in lines
             if (power := rate((name, own, errors))) is not None]
    sheet = Sheet(
        width, "Error of the meshes over the number of unknowns",
        f"Scene {rows[0].scene}. Meshes as they are or refined everywhere: discretisation error, the relative "
        "constitutive relation error between equilibrated stresses and compatible displacements. Adapted meshes: total "
        "error of the method that adapted them.",
        "p of the power law n^p, by least squares of logarithms, of adapted meshes with at least 1.5 times the first "
        f"one's unknowns. {'; '.join(rates)}.", left_out(run, rows, lambda row: "only on other bodies"),
        panels=len(bodies), key={plain(line[0]): style_of(line) for line in every}.items())
    limits = dict(xlim=log_limits([row.n_phi for _, own, _ in every for row in own], 1.3),
                  ylim=log_limits([error for *_, errors in every for error in errors], 1.4))
    for axes, (body, lines) in zip(sheet.panels, bodies.items()):
        log_log(axes, **limits, xlabel="unknowns $n_φ$", ylabel=axis_label("error_total"))
        axes.set_title(plain(body))
        for line in lines:
            axes.plot([row.n_phi for row in line[1]], line[2], **style_of(line))
    return sheet
