"""Reads FOLDER/NAME.vtu and NAME.contact.vtu with VTK's own reader and compares them with the CSVs.

    read_vtu.py FOLDER NAME

Also draws the displaced body from what VTK has read, FOLDER/NAME.png. Exit status 0: equal; 1: not;
77: this Python has no VTK.
"""
import csv
import sys
from pathlib import Path

import numpy as np

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    sys.exit(77)

TRIANGLE, POLY_LINE, LAGRANGE_TRIANGLE = 5, 4, 69
STATES = ["open", "stick", "slip"]


def read_grid(path: Path):
    reader = vtkXMLUnstructuredGridReader()
    complaints = []
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append("error"))
    reader.AddObserver("WarningEvent", lambda *_: complaints.append("warning"))
    reader.SetFileName(str(path))
    reader.Update()
    if complaints:
        sys.exit(f"{path}: VTK's reader complains: {complaints}")
    return reader.GetOutput()


def arrays_of(data) -> dict[str, np.ndarray]:
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k))
            for k in range(data.GetNumberOfArrays())}


def table(path: Path) -> dict[str, np.ndarray]:
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([row[key] for row in rows]) for key in (rows[0] if rows else ())}


def columns(table: dict[str, np.ndarray], *names: str) -> np.ndarray:
    return np.stack([table[name].astype(float) for name in names], axis=-1)


def same(what: str, found: np.ndarray, expected: np.ndarray, off: float = 0) -> None:
    """off: of the largest number, how far apart they may be."""
    atol = off * np.abs(expected).max(initial=0)
    if found.shape != expected.shape or not np.allclose(found, expected, rtol=1e-15, atol=atol):
        sys.exit(f"{what}: {found.ravel()[:5]} {found.shape}, expected {expected.ravel()[:5]} "
                 f"{expected.shape}")


def check_curved(grid, points: np.ndarray) -> None:
    """The sides between thirds are straight, with points where VTK's coordinates say."""
    at = np.array(grid.GetCell(0).GetParametricCoords()).reshape(-1, 3)
    r, s = at[:, 0], at[:, 1]
    weights = np.stack([1 - r - s, r, s], axis=-1)
    straight = (np.abs(r) < 1e-12) | (np.abs(r + s - 1) < 1e-12)
    same("sides", points[:, straight], np.einsum("nc,tcx->tnx", weights[straight], points[:, :3]),
         1e-12)


def check_body(folder: Path, name: str):
    grid = read_grid(folder / f"{name}.vtu")
    stress = table(folder / f"{name}.stress.csv")
    points = vtk_to_numpy(grid.GetPoints().GetData())
    cells = grid.GetNumberOfCells()
    per_cell = len(points) // cells

    def corners(values: np.ndarray) -> np.ndarray:
        """Of each cell, as the rows of NAME.stress.csv."""
        return values.reshape(cells, per_cell, -1)[:, :3].reshape(3 * cells, -1)

    off = 0 if per_cell == 3 else 1e-12
    same("points", corners(points)[:, :2], columns(stress, "x_mm", "y_mm"), off)
    same("cells", vtk_to_numpy(grid.GetCells().GetConnectivityArray()), np.arange(len(points)))
    same("types", vtk_to_numpy(grid.GetCellTypesArray()),
         np.full(cells, TRIANGLE if per_cell == 3 else LAGRANGE_TRIANGLE))
    if per_cell > 3:
        check_curved(grid, points.reshape(cells, per_cell, 3))
    of_points, of_cells = arrays_of(grid.GetPointData()), arrays_of(grid.GetCellData())
    same("stress", corners(of_points["stress_MPa"]),
         columns(stress, "sxx_MPa", "syy_MPa", "sxy_MPa"), off)
    names = [grid.GetPointData().GetArray("stress_MPa").GetComponentName(k) for k in range(3)]
    if names != ["xx", "yy", "xy"]:
        sys.exit(f"components {names}")
    same("triangle", np.repeat(of_cells["triangle"], 3), stress["triangle"].astype(int))
    at_nodes = columns(table(folder / f"{name}.displacement.csv"), "ux_mm", "uy_mm").reshape(-1, 6, 2)
    u = corners(of_points["displacement_mm"]).reshape(-1, 3, 3, 3)  # triangle, third, corner, component
    for third in range(3):
        same("displacement", u[:, third, 0, :2], at_nodes[:, third], off)
        same("displacement", u[:, third, 1, :2], at_nodes[:, (third + 1) % 3], off)
        centroid = (4 * at_nodes[:, 3:].sum(1) - at_nodes[:, :3].sum(1)) / 9
        if per_cell == 3 and not np.allclose(u[:, third, 2, :2], centroid, rtol=1e-12, atol=1e-15):
            sys.exit("displacement at centroids")
    if (folder / f"{name}.error.csv").exists():
        share = columns(table(folder / f"{name}.error.csv"), "error_share").ravel()
        same("error", of_cells["error_share"], np.repeat(share, 3))
    elif "error_share" in of_cells:
        sys.exit("error_share of no file")
    return corners(points), {key: corners(values) for key, values in of_points.items()}


def check_contact(folder: Path, name: str) -> None:
    grid = read_grid(folder / f"{name}.contact.vtu")
    csv_rows = table(folder / f"{name}.contact.csv")
    if not csv_rows:
        if grid.GetNumberOfPoints() != 0:
            sys.exit("contact points of no file")
        return
    same("points", vtk_to_numpy(grid.GetPoints().GetData())[:, :2], columns(csv_rows, "x_mm", "y_mm"))
    same("types", vtk_to_numpy(grid.GetCellTypesArray()), np.full(grid.GetNumberOfCells(), POLY_LINE))
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())  # each cell is an edge, from end to end
    ends = columns(csv_rows, "x_mm", "y_mm")[np.stack([offsets[:-1], offsets[1:] - 1])]
    lengths = columns(csv_rows, "edge_length_mm").ravel()[offsets[:-1]]
    if not np.allclose(np.hypot(*(ends[1] - ends[0]).T), lengths, rtol=1e-12, atol=0):
        sys.exit("cells are not edges")
    of_points = arrays_of(grid.GetPointData())
    for key in ("F_n_N", "F_t_N", "gap_mm", "slip_mm"):
        same(key, of_points[key], columns(csv_rows, key).ravel())
    same("normal", of_points["normal"][:, :2], columns(csv_rows, "normal_x", "normal_y"))
    same("state", of_points["state"], np.array([STATES.index(s) for s in csv_rows["state"]]))


def draw(path: Path, points: np.ndarray, of_points: dict[str, np.ndarray]) -> None:
    """The largest shear stress on the body, displaced so much that it is seen."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    u = of_points["displacement_mm"][:, :2]
    size = np.ptp(points[:, :2], axis=0).max()
    moved = points[:, :2] + 0.05 * size / (np.abs(u).max() or 1) * u
    sxx, syy, sxy = of_points["stress_MPa"].T
    figure, axes = pyplot.subplots(figsize=(6, 4))
    axes.set_aspect("equal")
    axes.triplot(*points[:, :2].T, np.arange(len(points)).reshape(-1, 3), color="0.85", linewidth=0.2)
    drawn = axes.tripcolor(*moved.T, np.hypot((sxx - syy) / 2, sxy), shading="gouraud",
                           triangles=np.arange(len(points)).reshape(-1, 3))
    figure.colorbar(drawn, label="largest shear stress in MPa")
    figure.savefig(path, dpi=100)
    if len(np.unique(pyplot.imread(path).reshape(-1, 4), axis=0)) < 100:
        sys.exit("the picture is empty")


def main() -> None:
    folder, name = Path(sys.argv[1]), sys.argv[2]
    points, of_points = check_body(folder, name)
    check_contact(folder, name)
    draw(folder / f"{name}.png", points, of_points)


if __name__ == "__main__":
    main()
