// The size of what the loads, the rigid motion with them, could do to a body: for bodies that they
// leave without any stress. Only there errors are relative to it.
#pragma once

#include "assembly/problem.hpp"

namespace airybench {

struct LoadScale {
  double energy_norm = 0;  // √(N mm)
  double force_N = 0;
};
LoadScale load_scale(const Problem& problem);

// error / quantity, or error / scale where the quantity is zero. A zero error is zero.
double relative_error(double error, double quantity, double scale);

// NaN where one of them is: an error that cannot be told is the worst.
double larger_error(double one, double other);

}  // namespace airybench
