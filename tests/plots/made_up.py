"""Made-up records: of the catalogue and of bodies and methods of one's own, of ordinary runs and of
both studies, with the shapes that the figures have to cope with."""
import csv
import json
import tempfile
from pathlib import Path

import numpy as np

import running  # finds plots

import records
from catalogue import SIZES, Sizes

COLUMNS = [key for key in records.KEYS if not key.startswith("memory_")]
SEVEN = {"SDTIC3": "SYMMLQ:DTIC3", "3STEPCG3": "3STEPCG:DTIC3", "SDTIC6": "SYMMLQ:DTIC6",
         "3STEPCG6": "3STEPCG:DTIC6", "SSKY": "SYMMLQ:SKY", "3STEPD": "3STEPD", "ALM": "ALM"}
IN_PAPER = (*SEVEN, "BLIND")
COMPARED = (*IN_PAPER, "HYBRID")
ITERATIVE = ("SYMMLQ", "3STEPCG", "ALM")
OWN = {mesh: Sizes(0, n_phi, 40, 16) for mesh, n_phi in (
    ("punch1", 300), ("punch2", 1100), ("punch3", 2500), ("dovetail1", 430), ("dovetail2", 1300),
    ("dovetail3", 2700))}
MEASURES = {"Mesh": (80, 6, 10, 10), "rack": (620, 24, 16, 50), "punch": (96, 6, 12, 8),
            "dovetail": (210, 13.4, 20, 18)}  # area, contact length, width, height
DIRECT = {"3STEPD": 1, "3STEPD:FILE": 1.3, "3STEPD:LEAN": 0.9, "3STEPD:CHOLMOD": 0.4, "BLIND": 0.5,
          "BLIND:SCHUR": 0.2, "BLIND:SKY": 0.7, "HYBRID": 0.03}
KRYLOV = {f"{krylov}:{preconditioner}": (2 + k) * (1 if krylov == "SYMMLQ" else 1.4)
          for krylov in ("SYMMLQ", "3STEPCG")
          for k, preconditioner in enumerate(("DTIC6", "DTIC3", "FLIC3", "SSOR1.0", "NONE"))}
OUTCOMES = ("inaccurate", "not_converged", "breakdown", "timeout", "out_of_memory")
LARGEST = {"3STEPD": 6e4, "3STEPD:CHOLMOD": 3e5, "BLIND:SCHUR": 3e5, "HYBRID": 1e6, "ALM": 6e4,
           "SDTIC6": 3e4}  # n_phi that it can do


def of_method(method: str) -> dict[str, object]:
    general = SEVEN.get(method, method)
    family, _, detail = general.partition(":")
    preconditioner = detail.partition(",")[0] if family in ("SYMMLQ", "3STEPCG") else ""
    return dict(method=method, general_name=general, family=family, preconditioner=preconditioner,
                iterative="true" if family in ITERATIVE else "false",
                in_paper="true" if method in IN_PAPER else "false",
                in_displacements="true" if family == "P2" else "false")


def of_mesh(mesh: str) -> dict[str, object]:
    size = OWN.get(mesh) or SIZES.get(mesh[:5], SIZES["Mesh0"])
    body = "rack" if size.teeth == 4 else mesh.rstrip("0123456789")
    measures = dict(zip(("area_mm2", "contact_length_mm", "width_mm", "height_mm"),
                        MEASURES.get(body, MEASURES["Mesh"])))
    return measures | dict(mesh=mesh, n_phi=size.n_phi, n_f=size.n_f,
                           n_c=40 if mesh == "Mesh0" else size.n_c)


def case(mesh: str, method: str, **cells: object) -> dict[str, object]:
    row = dict.fromkeys(COLUMNS, "") | of_method(method) | of_mesh(mesh)
    row |= dict(scene="default", stop="target", status="ok", outcome="ok", threads=1,
                repetitions=5, time_s=0.5, peak_heap_bytes=2**22, error_force=1e-9,
                error_stress=1e-10, target_error=1e-6)
    return row | dict(points=records.POINTS_OF_OLDER.get(cells.get("study"), "")) | cells


def split(mesh: str, method: str, **owners: tuple[float, float | None]) -> dict[str, object]:
    """A line of records.jsonl; owners: MiB at the peak and counted, next to 2 of the blocks."""
    by_owner = {owner: {"peak_bytes": int(peak * 2**20), "held_bytes": int(peak * 2**20),
                        "counted_bytes": None if counted is None else int(counted * 2**20)}
                for owner, (peak, counted) in ({"blocks": (2, 2)} | owners).items()}
    return record(case(mesh, method)) | {"memory_by_owner": by_owner, "memory_counts_differ": False}


def record(row: dict[str, object]) -> dict[str, object]:
    """The same as a line of records.jsonl."""
    flags = {"true": True, "false": False}
    return {key: None if value == "" else flags.get(value, value) if isinstance(value, str)
            else value for key, value in row.items()}


def discretisation(mesh: str) -> float:
    """Relative; first order in h from 20 %, the rack from 20 % again."""
    size = of_mesh(mesh)["n_phi"]
    first = {"Mesh": "Mesh4" if size > 8000 else "Mesh0"}.get(mesh[:-1], mesh[:-1] + "1")
    return 0.2 * (size / of_mesh(first)["n_phi"]) ** -0.45


def point(mesh: str, method: str, time_s: float, error: float, **cells: object) -> dict:
    floor = discretisation(mesh)
    outcome = "ok" if error <= 1e-6 else cells.pop("outcome", "inaccurate")
    return case(mesh, method, study="error", time_s=time_s, error_force=error, status=outcome
                if outcome != "wrong_success" else "inaccurate", outcome=outcome,
                error_stress=error / 3, error_discretisation=floor, error_total=floor + error / 3,
                peak_heap_bytes=int(30 * of_mesh(mesh)["n_phi"]**1.3 * (2 + time_s**0.3))) | cells


def error_study(meshes: list[str], sweep: bool = True) -> list[dict[str, object]]:
    rows = []
    for mesh in meshes:
        unit = 2e-7 * of_mesh(mesh)["n_phi"] ** 1.5
        for method, factor in DIRECT.items():
            rows.append(point(mesh, method, unit * factor, 1e-12 * factor))
        rows[-1] |= dict(error_force=0, error_stress=0)  # HYBRID
        for method, factor in KRYLOV.items():
            for digits in range(1, 13, 2):
                rows.append(point(mesh, method, unit * factor * (0.3 + digits / 6),
                                  3 * 10.0**-digits + 1e-10 * factor, knob="tolerance",
                                  knob_value=10.0**-digits))
        for k in range(1, 11):
            rows.append(point(mesh, "ALM", unit * (0.5 + 0.02 * 2**k), 0.5 * 0.1**k,
                              knob="uzawa iterations", knob_value=2**k))
        rows.append(point(mesh, "ALM", 0.55 * unit, 7e-2, stop="paper", outcome="wrong_success",
                          uzawa_iterations=9))
        for k in range(6):
            rows.append(point(mesh, "HYBRID", unit * (0.02 + 0.004 * k), 0.3 * 10.0**-k,
                              knob="contact sweeps", knob_value=4**k))
        rows.append(point(mesh, "P2", 0.02 * unit, 0, lower_bound_Nmm=-10 - discretisation(mesh),
                          upper_bound_Nmm=-10 + discretisation(mesh))
                    | dict(error_force="", error_stress=""))
        for r in (5, 20, 80, 320, 1280) if sweep else ():
            rows.append(point(mesh, f"ALM:r={r},rho={r}", unit, 0.5 / r, stop="paper",
                              uzawa_iterations=r + 2000 // r))
    return rows


def stability_study(mesh: str = "Mesh0", seed: int = 1) -> list[dict[str, object]]:
    """25 methods in 24 scenes of 11 groups."""
    random = np.random.default_rng(seed)
    methods = [*DIRECT, *KRYLOV, "ALM", "ALM:r=1e-6,rho=1e-6", "ALM:r=20,rho=40", "P2",
               "SYMMLQ:SKY", "3STEPCG:SKY", "HYBRID:DENSE"]
    groups = {"nearly incompressible": 2, "layers of contrast": 2, "units": 3, "moved away": 2,
              "loads": 2, "slivers": 3, "size grading": 1, "friction": 2, "contact state": 2,
              "parameters of ALM": 3, "refinement": 2}
    rows = []
    for group, count in groups.items():
        for k in range(count):
            for m, method in enumerate(methods):
                outcome = "ok" if random.random() < 0.8 else OUTCOMES[random.integers(5)]
                error = 10.0 ** -random.uniform(6, 15) if outcome == "ok" else 1e-4
                if (group, m % 12) == ("slivers", 3):
                    outcome = "wrong_success"
                rows.append(case(mesh, method, study="stability", scene_group=group,
                                 scene=f"{group.split()[0]}-{10**k:.0e}", outcome=outcome,
                                 status="inaccurate" if outcome == "wrong_success" else outcome,
                                 error_force=error, error_stress=error / 10))
    return rows


def sizes_to_the_limit() -> list[dict[str, object]]:
    """An ordinary run over the catalogue and two meshes refined from Mesh7."""
    rows = []
    sizes = {mesh: size.n_phi for mesh, size in SIZES.items()}
    sizes |= {"Mesh7-refined1": 201000, "Mesh7-refined2": 801000}
    for mesh, n_phi in sizes.items():
        for k, (method, most) in enumerate(LARGEST.items()):
            if n_phi < most:
                rows.append(case(mesh, method, n_phi=n_phi, error_force=1e-15 * n_phi * (1 + k),
                                 time_s=1e-8 * n_phi ** (1.2 + 0.1 * k),
                                 peak_heap_bytes=int(600 * n_phi ** (1.1 + 0.03 * k))))
    return rows


def of_all_kinds() -> list[dict]:
    """Lines of records of an ordinary run and of every study."""
    rows = error_study(["Mesh0", "Mesh1", "Mesh4"]) + stability_study("Mesh0")
    rows += sizes_to_the_limit()
    rows += [case("Mesh1", f"{family}:{name}") for family in ("SYMMLQ", "3STEPCG")
             for name in ("DTIC4", "FLIC2", "SSOR1.0", "NONE")]
    rows += [case("Mesh3", method, study="load-steps", scene=f"steps_{n:02d}",
                          load_steps=n, time_s=0.1 * k + 0.01 * n) for n in (1, 5, 20)
             for k, method in enumerate(("3STEPD", "ALM"))]
    rows += [case(f"Mesh{k}", method, study="scaling", threads=p, knob="threads", knob_value=p,
                          time_s=0.1 * k / (1 + 0.3 * m * (p - 1)))
             for k in (4, 5, 6, 7) for p in (1, 2, 4, 6)
             for m, method in enumerate(("3STEPD", "BLIND", "SDTIC6"))]
    rows += [case(f"Mesh{k}+adapt{level}", method, study="adapted", n_phi=900 * 2**level,
                          error_discretisation=0.1, condition_estimate=1e9)
             for k in (0, 4) for level in range(4) for method in ("HYBRID", "3STEPD:CHOLMOD")]
    rows += [case(f"Mesh0+adapt{level}", "HYBRID", n_phi=900 * 2**level, adapt_level=level,
                          adapt_time_s=0.1 * 2**level, error_total=0.1 / 2**level,
                          time_s=0.02 * 2**level, lower_bound_Nmm=27 - 0.1 / 4**level,
                          upper_bound_Nmm=27 + 0.2 / 4**level) for level in range(4)]
    rows += [case(f"L+adapt{level}" + "k2" * (degree == 2), method, scene="L", degree=degree,
                          adapt_time_s=0.1 * 2**level, error_total=0.1 / 2**(degree * level))
             for level in range(4)
             for method, degree in (("HYBRID", 1), ("HYBRID:k=2", 2), ("P2", 1))]
    rows += [case(mesh, "ALM:AUTO", stop=stop, time_s=time_s * slower, error_total=error)
             for stop, slower in (("target", 5), ("paper", 1))
             for mesh, time_s, error in (("Mesh0", 0.01, 0.04), ("Mesh1", 0.05, 0.02))]
    rows += [case(f"Mesh3+refine{k}", method, n_phi=6287 * 4**k, time_s=0.01 * 5**k * m,
                          peak_heap_bytes=int(2**23 * 4.2**k), linear_iterations=40 + k,
                          error_stress="" if k == 4 else 1e-12, error_estimate=1e-8)
             for k in range(1, 5) for m, method in enumerate(("HYBRID", "HYBRID:CG"), 1)]
    rows += [case(mesh, "3STEPD", study="contact", scene=scene, contact_solver=solver,
                          stage_contact_s=0.01, contact_iterations=20) for mesh in ("Mesh0", "Mesh1")
             for scene in ("default", "friction_10") for solver in ("newton", "admm")]
    rows += [case("Mesh0", f"EXTERNAL:x:penalty={value}", time_s=0.1 * value, error_total=0.1 / value,
                          parameters=f"penalty={value}; direct", program="x 1", family="EXTERNAL:x",
                          in_displacements="true") for value in (1, 10)]
    owned = [split("Mesh0", method, factor=(3, 2)) for method in ("BLIND:LEAN", "NEWTON")]
    told = [record(case("Mesh2", method)) | {"histories": {"residual": [1, 0.1, 1e-3, None]}}
            for method in ("BLIND:SKY", "SSKY")]
    return [record(row) for row in rows] + owned + told


def write(path: Path, rows: list[dict[str, object]], columns: list[str] = COLUMNS) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)


def write_lines(path: Path, records: list[dict[str, object]]) -> None:
    """records.jsonl."""
    lines = "".join(json.dumps(record) + "\n" for record in records)
    path.write_text(lines, encoding="utf-8")


def read(rows: list[dict[str, object]], columns: list[str] = COLUMNS) -> list[records.Row]:
    """As figures get them from a results.csv of these."""
    with tempfile.TemporaryDirectory() as folder:
        write(Path(folder) / "results.csv", rows, columns)
        return records.rows_of(records.read_run(Path(folder)))


def read_lines(lines: list[dict[str, object]]) -> list[records.Row]:
    """As figures get them from a records.jsonl of these."""
    with tempfile.TemporaryDirectory() as folder:
        write_lines(Path(folder) / "records.jsonl", lines)
        return records.rows_of(records.read_run(Path(folder)))
