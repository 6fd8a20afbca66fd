// A local solve for a recovered displacement (displacement_recovery.hpp) where moving one
// coefficient at a time gains little: in thin triangles neighbours hold one another. All
// coefficients of a zone together minimise the terms of ½ e²,
//
//   ½ Σ_T (w − w_T)ᵀ K_T (w − w_T)  +  Σ_{Γ_C} F_n (w_n − g) + μ|F_n||Δ| + F_t Δ,    w_n ≤ g,
//
// and all others stay. Of a pair of nodes w_n and Δ = w_t + ρ_t − s are those of the difference. A
// semismooth Newton method (Hintermüller, Ito & Kunisch 2002, doi:10.1137/S1052623401383558) finds
// which nodes are at their walls, which stick and which way the others slide; each step is a sparse
// Cholesky factorisation of the zone.
#pragma once

#include <vector>

#include "verify/displacement_constraints.hpp"

namespace airybench {

struct ZoneTriangle {
  std::vector<int> nodes;
  Eigen::MatrixXd K;  // x and y of each node, N/mm
};

// Changes w at the free nodes. `triangles`: all that have one. `gradient`: of the first sum at w,
// N. What Γ_D or a contact partner outside the zone holds is not free. The walls may be missed by
// the rounding of a turned normal: constraints.apply() follows.
void improve_zone(const DisplacementConstraints& constraints,
                  const std::vector<ZoneTriangle>& triangles, std::vector<bool> is_free,
                  const Eigen::Matrix2Xd& gradient, DisplacementField& w);

}  // namespace airybench
