#!/usr/bin/python3
"""Draws our answers next to those from outside, from tests/data/validation/profiles.csv.

    validation_profiles.py [--out FILE]     default: docs/images/validation.png
    validation_profiles.py --table          prints the tables of docs/validation.md
"""
import argparse
from functools import partial
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import drawing
from command import replace_all, run
from drawing import COLOURS, DPI, PAGE_WIDTH, write_small_png

PROJECT = Path(__file__).resolve().parents[1]
PROFILES = PROJECT / "tests/data/validation/profiles.csv"
STYLE = drawing.STYLE | {"axes.titlesize": 9, "axes.spines.top": False, "axes.spines.right": False}
OURS = dict(color="#0072B2", linestyle="", marker="o", markersize=2.5)
OURS_TOO = dict(color="#D55E00", linestyle="", marker="s", markersize=2.2)
OUTSIDE = dict(color="black", linewidth=0.8)
PUBLISHED_UM = {0: 28.6, 1.25: 27.2, 5: 22.8, 7.5: 19.8, 11.25: 15.0}  # test SSNV128: the mean
MU, RADIUS, MODULUS = 0.2, 4, 82.4286 / (1 - 0.4999**2)


def read_profiles() -> pd.DataFrame:
    return pd.read_csv(PROFILES, comment="#")


def of(table: pd.DataFrame, case: str, quantity: str, refined: int | None = None) -> pd.DataFrame:
    """By x; without `refined` the finest mesh's."""
    rows = table[(table.case == case) & (table.quantity == quantity)]
    finest = rows.refined.max() if refined is None else refined
    return rows[rows.refined == finest].sort_values("x_mm")


def number(table: pd.DataFrame, case: str, quantity: str, refined: int | None = None) -> float:
    return float(of(table, case, quantity, refined).value.iloc[0])


def hertz(force: float) -> tuple[float, float]:
    a = np.sqrt(4 * force * RADIUS / (np.pi * MODULUS))
    return a, 2 * force / (np.pi * a)


def block_rows(table: pd.DataFrame) -> list[str]:
    rows = ["| x, mm | published mean, µm | HYBRID | P2 | own − published |", "|---|---|---|---|---|"]
    for x, mean in PUBLISHED_UM.items():
        stress, displacement = (of(table, "friction_block", f"u_x {method}").set_index("x_mm")
                                .value[x] for method in ("HYBRID", "P2"))
        rows.append(f"| {x:g} | {mean} | {stress:.3f} | {displacement:.3f} | "
                    f"{100 * (stress / mean - 1):.1f} % |")
    return rows


def cattaneo_rows(table: pd.DataFrame) -> list[str]:
    rows = ["| refined | edges on the face | a off by | p₀ off by | c off by |", "|---|---|---|---|---|"]
    for refined in sorted(table[table.case == "cattaneo_mindlin"].refined.unique()):
        force, shear, *found = (number(table, "cattaneo_mindlin", quantity, refined)
                                for quantity in ("P", "Q", "a", "p0", "c"))
        a, p0 = hertz(force)
        exact = a, p0, a * np.sqrt(1 - shear / (MU * force))
        errors = (f"{100 * abs(own / right - 1):.2f} %" for own, right in zip(found, exact))
        rows.append(f"| {refined} | {48 * 2**refined} | {' | '.join(errors)} |")
    return rows


def persson(table: pd.DataFrame) -> tuple[float, np.ndarray, np.ndarray]:
    """The reach ε of a pin's contact and its pressure p R / P over φ, degrees: docs/validation.md."""
    clearance, low, high = number(table, "persson", "E* clearance / P"), 1e-3, 1.0
    for _ in range(60):
        b = (low + high) / 2
        found = (2 - np.log1p(b**2) - 2 * b**4) / (np.pi * b**2 * (1 + b**2))
        low, high = (b, high) if found > clearance else (low, b)
    reach = 2 * np.arctan(low)
    phi = reach * np.sin(np.linspace(0, np.pi / 2, 401))
    y, s = np.tan(phi / 2), np.sqrt(1 + low**2)
    t = np.sqrt(np.maximum(0, low**2 - y**2))
    pressure = 2 * t / (np.pi * s * (1 + y**2)) + np.log((s + t) / (s - t)) / (2 * np.pi * (low * s)**2)
    return np.degrees(reach), np.degrees(phi), pressure


def other_rows(table: pd.DataFrame) -> list[str]:
    rows = ["| case | largest deviation |", "|---|---|"]
    for case in sorted(case for case in table.case.unique() if case.startswith("hertz")):
        force = number(table, case, "P")
        (a, p0), found = hertz(force), [number(table, case, quantity) for quantity in ("a", "p0")]
        worst = max(abs(own / right - 1) for own, right in zip(found, (a, p0)))
        rows.append(f"| Hertz, P = {force:.2f} N/mm: a, p₀ | {100 * worst:.2f} % |")
    for refined in range(3):
        worst = number(table, "punch", "worst deviation for |x| < 0.8", refined)
        rows.append(f"| punch, {40 * 2**refined} edges: p(x), \\|x\\| < 0.8 a | {100 * worst:.2f} % |")
    return rows


def bodies_rows(table: pd.DataFrame) -> list[str]:
    rows = ["| case | largest deviation |", "|---|---|"]
    force, shear, *found = (number(table, "two_cylinders", quantity)
                            for quantity in ("P", "Q", "a", "p0", "c"))
    a, p0 = hertz(force)
    exact = a, p0, a * np.sqrt(1 - shear / (MU * force))
    worst = max(abs(own / right - 1) for own, right in zip(found, exact))
    rows.append(f"| two equal cylinders, P = {force:.2f}, Q = {shear:.2f} N/mm: a, p₀, c | "
                f"{100 * worst:.2f} % |")
    worst = number(table, "persson", "worst deviation for phi < 0.95 reach")
    rows.append(f"| pin, touching for \\|φ\\| < {persson(table)[0]:.1f}°: p(φ) over p(0), to 0.95 of it | "
                f"{100 * worst:.2f} % |")
    return rows


def draw_block(axes: Axes, table: pd.DataFrame) -> None:
    own = of(table, "friction_block", "floor HYBRID")
    axes.plot(own.x_mm, own.value, **OURS, label="HYBRID, every vertex")
    axes.errorbar(list(PUBLISHED_UM), list(PUBLISHED_UM.values()), color="black", fmt="_",
                  yerr=[0.05 * u for u in PUBLISHED_UM.values()], linewidth=0.8, capsize=2,
                  label="published mean, 5 %")
    axes.set(title="Block with friction", xlabel="x on the floor, mm",
             ylabel="tangential displacement, µm")


def draw_cattaneo(axes: Axes, table: pd.DataFrame, case: str = "cattaneo_mindlin",
                  title: str = "Cattaneo–Mindlin, at a wall") -> None:
    force = number(table, case, "P")
    a, p0 = hertz(force)
    c = a * np.sqrt(1 - number(table, case, "Q") / (MU * force))
    x = np.linspace(-a, a, 801)
    pressure = p0 * np.sqrt(1 - (x / a)**2)
    stuck = MU * p0 * c / a * np.sqrt(np.maximum(0, 1 - (x / c)**2))
    axes.plot(x, pressure, **OUTSIDE, label="Hertz, Cattaneo, Mindlin")
    axes.plot(x, (MU * pressure - stuck) / MU, **OUTSIDE)
    for quantity, look, scale, label in (("pressure", OURS, 1, "pressure"),
                                         ("shear", OURS_TOO, MU, "shear / µ")):
        own = of(table, case, quantity)
        own = own[(own.x_mm.abs() < 1.1 * a)]
        axes.plot(own.x_mm, own.value / scale, **look, label=label)
    axes.set(title=title, xlabel="x, mm", ylabel="traction, MPa")


def draw_two_cylinders(axes: Axes, table: pd.DataFrame) -> None:
    draw_cattaneo(axes, table, "two_cylinders", "Cattaneo–Mindlin, two bodies")


def draw_pin(axes: Axes, table: pd.DataFrame) -> None:
    _, phi, pressure = persson(table)
    axes.plot(phi, pressure, **OUTSIDE, label="Persson")
    own = of(table, "persson", "pressure R / P")
    axes.plot(own.x_mm, own.value, **OURS, label="mean of every edge")
    axes.set(title="Pin in a hole", xlabel="φ, degrees", ylabel="p R / P", xlim=(0, 90))


def draw_punch(axes: Axes, table: pd.DataFrame) -> None:
    x = np.sin(np.linspace(-1, 1, 801) * np.pi / 2 * 0.995)
    axes.plot(x, number(table, "punch", "P") / (np.pi * np.sqrt(1 - x**2)), **OUTSIDE,
              label="P / (π √(a² − x²))")
    own = of(table, "punch", "pressure")
    axes.plot(own.x_mm, own.value, **OURS, label="mean of every edge")
    axes.set(title="Flat punch", xlabel="x, mm", ylabel="pressure, MPa",
             ylim=(0, 5 * number(table, "punch", "P") / np.pi))


def draw_hertz(axes: Axes, table: pd.DataFrame) -> None:
    loads = np.linspace(0, 22, 201)
    axes.plot(loads, np.sqrt(4 * loads * RADIUS / (np.pi * MODULUS)), **OUTSIDE,
              label="Hertz: √(4PR / (πE*))")
    cases = [case for case in table.case.unique() if case.startswith("hertz")]
    axes.plot([number(table, case, "P") for case in cases],
              [number(table, case, "a") for case in cases], **OURS | dict(markersize=4),
              label="fitted to the pressure")
    axes.set(title="Hertz", xlabel="load P, N/mm", ylabel="half width a, mm")


def draw(table: pd.DataFrame) -> Figure:
    figure = Figure(figsize=(PAGE_WIDTH, 9), layout="constrained")
    panels = (draw_block, draw_cattaneo, draw_punch, draw_hertz, draw_two_cylinders, draw_pin)
    for axes, panel in zip(figure.subplots(3, 2).flat, panels):
        panel(axes, table)
        axes.legend(frameon=False, fontsize=7)
        axes.set_ylim(bottom=0)
    return figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--out", type=Path, default=PROJECT / "docs/images/validation.png")
    parser.add_argument("--table", action="store_true")


def make(args: argparse.Namespace) -> None:
    table = read_profiles()
    if args.table:
        for rows in (block_rows, cattaneo_rows, other_rows, bodies_rows):
            print("\n".join(rows(table)), end="\n\n")
        return
    with matplotlib.rc_context(STYLE):
        replace_all(args.out.parent, {args.out.name: partial(write_small_png, draw(table), DPI,
                                                             colours=COLOURS)})


def main() -> None:
    run(__doc__, add_arguments, make, "a file to write")


if __name__ == "__main__":
    main()
