"""A made-up history: a dozen nights of eight cases, in which one method becomes slower one night,
another's memory shrinks, and one case times out at last."""
import json
import random
from datetime import datetime, timedelta, timezone
from pathlib import Path

NIGHTS, SLOWER, LEANER, TIMES_OUT = 12, 8, 5, 11
SLOW_CASE, LEAN_CASE = "Mesh0/default/3STEPD", "Mesh3/default/HYBRID"
LOST_CASE = "Mesh3/default/ALM"
METHODS = {"3STEPD": 3.2e-3, "ALM": 15.8e-3, "3STEPD:LEAN": 6.3e-3, "HYBRID": 2.9e-3}  # s on Mesh0
ERRORS = {"3STEPD": 1e-11, "ALM": 3e-7, "3STEPD:LEAN": 2e-11, "HYBRID": 4e-13}
SENTENCE = "3STEPD on Mesh0 takes 1.31 times as long <since> this night"


def date_of(night: int) -> str:
    return (datetime(2026, 3, 1, 2, 0, tzinfo=timezone.utc) + timedelta(days=night)).isoformat()


def revision_of(night: int) -> str:
    """New every other night."""
    return f"{night // 2 * 0x1234567 + 0xa000000:08x}{'0' * 32}"


def made_up_case(mesh: str, method: str, night: int, chance: random.Random) -> dict:
    size = {"Mesh0": 1, "Mesh3": 8}[mesh]
    time_s = METHODS[method] * size**1.5
    peak = 900_000 * size**1.2 * (1 + list(METHODS).index(method))
    name = f"{mesh}/default/{method}"
    if name == SLOW_CASE and night >= SLOWER:
        time_s *= 1.31
    if name == LEAN_CASE and night >= LEANER:
        peak *= 0.7
    samples = [time_s * (1 + 0.02 * chance.random()) for _ in range(5)]
    median_s = sorted(samples)[2]
    case = dict(mesh=mesh, scene="default", method=method, stop="target", status="ok", n_phi=761,
                samples_s=samples, time_s=median_s, time_low_s=min(samples),
                time_high_s=max(samples), peak_heap_bytes=int(peak), storage_bytes=int(peak / 2),
                linear_iterations=None, contact_iterations=200 + size, uzawa_iterations=None,
                error_stress=ERRORS[method] * size,
                error_force=ERRORS[method] * (1 + chance.random()), equilibrium_residual=1e-13)
    if name == LOST_CASE and night >= TIMES_OUT:
        case |= dict.fromkeys(("time_s", "time_low_s", "time_high_s", "error_stress", "error_force"))
        case |= dict(status="timeout", samples_s=[], status_reason="900 s are up")
    return case


def made_up_verdicts(night: int) -> list[dict]:
    changes = [
        (SLOWER, SLOW_CASE, "times", "time_s", "worse", SENTENCE),
        (LEANER, LEAN_CASE, "counters", "peak_heap_bytes", "better",
         "HYBRID on Mesh3 needs 0.7 of its memory"),
        (TIMES_OUT, LOST_CASE, "status", "status", "worse", "ALM on Mesh3 was ok and times out"),
    ]
    return [dict(case=case, lane=lane, quantity=quantity, kind=kind, since=date_of(since),
                 before=1, after=2, ratio=1.3, low=1.2, high=1.4, sentence=sentence)
            for since, case, lane, quantity, kind, sentence in changes if night >= since]


def made_up_night(night: int) -> dict:
    chance = random.Random(night)
    context = {"git_revision": revision_of(night), "cpu": "A processor", "cpus": "2",
               "kernel": "6.1.0" if night < NIGHTS - 1 else "6.2.0", "threads": "1",
               "compiler": "GNU 12.2.0", "date": date_of(night),
               "load_1min_at_start": f"{chance.random():.2f}"}
    verdicts = made_up_verdicts(night)
    return {"format": "airybench-night-1", "date": date_of(night), "context": context,
            "noise": {"median_s": 0.02 + 0.0002 * chance.random(), "mad_s": 1e-4, "samples_s": []},
            "cases": [made_up_case(mesh, method, night, chance)
                      for mesh in ("Mesh0", "Mesh3") for method in METHODS],
            "verdicts": verdicts, "failed": any(v["kind"] == "worse" for v in verdicts)}


def write_history(folder: Path, nights: int = NIGHTS) -> Path:
    (folder / "nights").mkdir(parents=True)
    for night in range(nights):
        file = folder / "nights" / f"{date_of(night)[:10]}.json"
        file.write_text(json.dumps(made_up_night(night)), encoding="utf-8")
    return folder
