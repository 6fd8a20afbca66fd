"""What the paper's stop of ALM does to the answer, for given parameters r and rho."""
from collections.abc import Iterator

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawing import Drawing, log_limits, log_log, panel_at, sheet
from labels import Labels
from records import Row
from selection import given, grouped, is_paper_stop, of_scene
from words import CASE, axis_label, csv_of, left_out, percent, short

LEFT, TOP, PANEL, GAP, HEIGHT, BOTTOM = 0.72, 0.4, 3.38, 0.72, 3.8, 0.5  # inches
SHADES = ("#000000", "#0072B2", "#D55E00", "#00805C", "#8A3FA0", "#C98500", "#56B4E9", "#777777")
MARKERS = "o^sDvP<X"


def drawings(rows: list[Row]) -> Iterator[Drawing]:
    study = of_scene([row for row in rows if row.points == "accuracy"])
    if study:
        yield Drawing("stop_and_error", [row for row in study if parameters_of(row)], draw, table_of,
                      options=dict(run=study))


def table_of(rows: list[Row]) -> str:
    return csv_of(rows, *CASE, ("r", lambda row: parameters_of(row)[0]),
                  ("rho_over_r", lambda row: parameters_of(row)[1]), "error_force",
                  "uzawa_iterations")


def parameters_of(row: Row) -> tuple[float, float] | None:
    """r and rho / r; None: not given under the paper's stop, or no error is known."""
    r, rho = given(row) or (0, 0)
    if not (r > 0 and is_paper_stop(row) and row.error_force):
        return None
    return r, float(f"{rho / r:.6g}")


def curves_of(rows: list[Row]) -> dict[str, list[Row]]:
    """'Mesh3, rho = 2 r' -> its cases by r."""
    stops = [row for row in rows if parameters_of(row)]
    families = {row.family for row in stops}

    def name(row: Row) -> str:
        _, ratio = parameters_of(row)
        family = f"{row.family}, " if len(families) > 1 else ""
        return f"{family}{row.mesh}, ρ = {'r' if ratio == 1 else f'{ratio:g} r'}"
    return grouped(sorted(stops, key=lambda row: (row.n_phi, *parameters_of(row)[::-1])), name)


def draw(rows: list[Row], run: list[Row]) -> Figure | str:
    curves = curves_of(rows)
    if not any(len(curve) > 1 for curve in curves.values()):
        return "no two methods NAME:r=..,rho=.. with stop=paper and error_force"
    stops = [row for curve in curves.values() for row in curve]
    families = " and ".join(dict.fromkeys(row.family for row in stops))
    target = next((row.target_error for row in stops if row.target_error), 1e-6)
    low, high = (percent(end(row.error_force for row in stops)) for end in (min, max))
    figure = sheet(
        TOP + HEIGHT + BOTTOM, f"The paper's stop: errors from {low} to {high}",
        f"Scene {rows[0].scene}. {families} with given r and ρ, ended by the paper's stop: no "
        "force is out of balance by more than 1e-3 N/mm. Left: the error of its contact forces then, "
        f"which the stop does not measure; dashed: the target error {short(target)} of the other "
        "figures. Right: the iterations it took.",
        left_out(run, rows, lambda row: "not with r and ρ given and the paper's stop"))
    left = panel_at(figure, LEFT, TOP, PANEL, HEIGHT)
    draw_panel(left, curves, "error_force", [target])
    left.axhline(target, color="0.25", linewidth=0.9, linestyle=(0, (5, 3)))
    left.set_ylabel(f"relative {axis_label('error_force')}")
    right = panel_at(figure, LEFT + PANEL + GAP, TOP, PANEL, HEIGHT)
    draw_panel(right, curves, "uzawa_iterations", [])
    right.set_ylabel(axis_label("uzawa_iterations"))
    return figure


def draw_panel(axes: Axes, curves: dict[str, list[Row]], column: str,
               included: list[float]) -> None:
    """Curves of a single point are grey; those with the same r share a label."""
    known = {words: [(parameters_of(row)[0], getattr(row, column), row.mesh) for row in curve
                     if getattr(row, column)] for words, curve in curves.items()}
    points = [point for curve in known.values() for point in curve]
    log_log(axes, xlabel="penalty r, relative to the stiffness",
            xlim=log_limits([r for r, *_ in points], 1.5),
            ylim=log_limits([*(y for _, y, _ in points), *included], 1.8))
    labels = Labels(axes)
    for k, words in enumerate(words for words, curve in curves.items() if len(curve) > 1):
        if known[words]:
            r, y, _ = zip(*known[words])
            labels.line(words, r, y, SHADES[k % len(SHADES)], marker=MARKERS[k % len(MARKERS)],
                        markersize=5, linewidth=1.1, linestyle="-" if k < len(SHADES) else "--")
    single = [point for words, curve in curves.items() if len(curve) == 1
              for point in known[words]]
    for own in grouped(single, lambda point: point[0]).values():
        r, y, meshes = zip(*own)
        axes.plot(r, y, color="0.55", marker="x", markersize=4.5, linestyle="none")
        labels.avoid(r, y)
        labels.add("..".join(dict.fromkeys([meshes[0], meshes[-1]])), r, y, color="0.4", fontsize=8)
    labels.name_lines(fontsize=8)
