// The size of what the loads would do, for bodies that they leave next to free of stress: where a
// quantity is nothing but rounding, errors are relative to this instead.
#pragma once

#include "assembly/problem.hpp"

namespace airybench {

struct LoadScale {
  double energy_norm = 0;  // √(N mm)
  double force_N = 0;
};
LoadScale load_scale(const Problem& problem);

// Only rounding: ≤ 1e-9 · scale.
bool is_rounding(double quantity, double scale);
// error / quantity, or error / scale where the quantity is only rounding. A zero error is zero.
double relative_error(double error, double quantity, double scale);

}  // namespace airybench
