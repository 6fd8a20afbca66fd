"""Made-up results.csv of both studies, with the shapes that the figures have to cope with."""
import csv
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "plots"))

import results_table  # noqa: E402
from paper_sizes import SIZES  # noqa: E402

COLUMNS = [*results_table.COLUMNS, *results_table.OPTIONAL]
DIRECT = {"3STEPD": 1, "3STEPD:FILE": 1.3, "3STEPD:LEAN": 0.9, "3STEPD:CHOLMOD": 0.4, "BLIND": 0.5,
          "BLIND:SCHUR": 0.2, "BLIND:SKY": 0.7, "HYBRID": 0.03}
KRYLOV = {f"{krylov}:{preconditioner}": (2 + k) * (1 if krylov == "SYMMLQ" else 1.4)
          for krylov in ("SYMMLQ", "3STEPCG")
          for k, preconditioner in enumerate(("DTIC6", "DTIC3", "FLIC3", "SSOR1.0", "NONE"))}
OUTCOMES = ("inaccurate", "not_converged", "breakdown", "timeout", "out_of_memory")


LARGEST = {"3STEPD": 6e4, "3STEPD:CHOLMOD": 3e5, "BLIND:SCHUR": 3e5, "HYBRID": 1e6, "ALM": 6e4,
           "SDTIC6": 3e4}  # n_phi that it can do


def case(mesh: str, method: str, **cells: object) -> dict[str, object]:
    size = SIZES[mesh[:5]]
    row = dict.fromkeys(COLUMNS, "")
    row |= dict(mesh=mesh, scene="default", method=method, stop="target", status="ok",
                outcome="ok", n_phi=size.n_phi, n_f=size.n_f, n_c=size.n_c, threads=1,
                repetitions=5, time_s=0.5, peak_heap_bytes=2.0**22, error_force=1e-9,
                error_stress=1e-10, target_error=1e-6)
    return row | cells


def split(mesh: str, method: str, **owners: tuple[float, float | None]) -> dict[str, object]:
    """A line of records.jsonl; owners: MiB at the peak and counted, beside 2 of the blocks."""
    by_owner = {owner: {"peak_bytes": int(peak * 2**20), "held_bytes": int(peak * 2**20),
                        "counted_bytes": None if counted is None else int(counted * 2**20)}
                for owner, (peak, counted) in ({"blocks": (2, 2)} | owners).items()}
    return {"mesh": mesh, "scene": "default", "method": method, "n_phi": SIZES[mesh].n_phi,
            "threads": 1, "stop": "target", "status": "ok", "study": None,
            "memory_by_owner": by_owner, "memory_counts_differ": False}


def discretisation(mesh: str) -> float:
    """Relative; first order in h from 20 %, the rack starting anew."""
    first = SIZES["Mesh0" if SIZES[mesh].teeth == 1 else "Mesh4"].n_phi
    return 0.2 * (SIZES[mesh].n_phi / first) ** -0.45


def point(mesh: str, method: str, time_s: float, error: float, **cells: object) -> dict:
    floor = discretisation(mesh)
    outcome = "ok" if error <= 1e-6 else cells.pop("outcome", "inaccurate")
    return case(mesh, method, study="error", time_s=time_s, error_force=error, status=outcome
                if outcome != "wrong_success" else "inaccurate", outcome=outcome,
                error_stress=error / 3, error_discretisation=floor, error_total=floor + error / 3,
                peak_heap_bytes=30.0 * SIZES[mesh].n_phi**1.3 * (2 + time_s**0.3)) | cells


def error_study(meshes: list[str], sweep: bool = True) -> list[dict[str, object]]:
    rows = []
    for mesh in meshes:
        unit = 2e-7 * SIZES[mesh].n_phi ** 1.5
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
                                 peak_heap_bytes=600 * n_phi ** (1.1 + 0.03 * k)))
    return rows


def write(path: Path, rows: list[dict[str, object]], columns: list[str] = COLUMNS) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)
