"""Strong and weak scaling: what more threads give on one mesh, and on meshes that grow with them.

T_p(m): median time of a method on mesh m with p threads, n(m) its n_phi.
    strong, one mesh m:      speed-up S_p = T_1(m) / T_p(m), efficiency E_p = S_p / p;
    weak, from mesh m_1 on:  m_p is the mesh of the same body with n(m_p) nearest to p n(m_1), at most a
                             factor of NEAR from it, and
        W_p = [n(m_p) / (p T_p(m_p))] / [n(m_1) / T_1(m_1)],
                             the unknowns solved per second and thread over those of one thread on m_1.
The work of a direct method grows faster than its unknowns, whatever the threads do. So
    W_p = G_p E_p(m_p),  G_p = [n(m_p) / T_1(m_p)] / [n(m_1) / T_1(m_1)]:
G_p is what growth costs one thread, E_p(m_p) what is lost to threads.
A time of one sample has no interval, and gives none of these.
"""
import math
from dataclasses import dataclass

import numpy as np

from profiles import CONFIDENCE, RESAMPLES, SEED, solved
from records import Row
from selection import grouped

NEAR = 1.3


@dataclass(frozen=True)
class Point:
    row: Row
    speed_up: float | None = None       # None: one sample, not solved, or no such case on one thread
    speed_up_low: float | None = None   # 95 % bootstrap interval of the repetitions
    speed_up_high: float | None = None
    weak_from: str = ""                 # mesh m_1; empty: the mesh is none that grows with the threads
    weak_growth: float | None = None    # n(m_p) / (p n(m_1)): 1 if unknowns grew as the threads
    weak_one_thread: float | None = None  # G_p

    @property
    def efficiency(self) -> float | None:
        return self.speed_up and self.speed_up / self.row.threads

    @property
    def weak_efficiency(self) -> float | None:
        return self.weak_one_thread and self.efficiency and self.weak_one_thread * self.efficiency

    @property
    def busy_kernel_ratio(self) -> float | None:
        """Of the noise kernel on all threads at once over that on one."""
        known = self.row.busy_kernel_s and self.row.noise_kernel_s
        return self.row.busy_kernel_s / self.row.noise_kernel_s if known else None


def is_timed(row: Row | None) -> bool:
    return row is not None and solved(row) and row.repetitions > 1


def interval(one: Row, many: Row) -> tuple[float | None, float | None]:
    """Of T_1 / T_p; None where the samples are not there, as in results.csv."""
    if not (one.samples_s and many.samples_s):
        return None, None
    random = np.random.default_rng(SEED)
    again = [np.median(random.choice(row.samples_s, (RESAMPLES, len(row.samples_s))), 1)
             for row in (one, many)]
    low, high = np.quantile(again[0] / again[1], [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    return float(low), float(high)


def points_of(rows: list[Row]) -> list[Point]:
    """rows: of one scene and stop of a scaling study. In the order of bodies, methods, meshes, threads."""
    found = []
    for own in grouped(rows, lambda row: (row.body, row.method)).values():
        cases = {(row.mesh, row.threads): row for row in own}
        alone = sorted((row for row in own if row.threads == 1 and is_timed(row)),
                       key=lambda row: row.n_phi)
        for row in sorted(own, key=lambda row: (row.n_phi, row.threads)):
            one = cases.get((row.mesh, 1))
            if not (is_timed(one) and is_timed(row)):
                found.append(Point(row))
                continue
            strong = one.time_s / row.time_s, *((1.0, 1.0) if row is one else interval(one, row))
            weak = ()
            if row.mesh == mesh_for(row.threads, alone):
                first = alone[0]
                growth = row.n_phi / first.n_phi
                weak = (first.mesh, growth / row.threads, growth * first.time_s / one.time_s)
            found.append(Point(row, *strong, *weak))
    return found


def mesh_for(threads: int, alone: list[Row]) -> str | None:
    """m_p. alone: the meshes on one thread, the smallest first."""
    def misfit(row: Row) -> float:
        return abs(math.log(row.n_phi / (threads * alone[0].n_phi)))
    best = min(alone, key=misfit)
    return best.mesh if misfit(best) <= math.log(NEAR) else None
