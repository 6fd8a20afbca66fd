// The size of what the loads and the rigid motion could do to a body. Errors are relative to it
// only if they leave the body without stress.
#pragma once

#include "assembly/problem.hpp"

namespace airybench {

struct LoadScale {
  double energy_norm = 0;  // √(N mm)
  double force_N = 0;
};
LoadScale load_scale(const Problem& problem);

// Of a quantity that would be zero: two bodies that do not touch leave each other without stress,
// but not without rounding.
inline bool is_rounding(double quantity, double scale) { return quantity <= 1e-11 * scale; }

// error / quantity; error / scale if the quantity is only rounding; 0 if the error is zero.
double relative_error(double error, double quantity, double scale);

// NaN if one of them is: an unknown error is the worst.
double larger_error(double one, double other);

}  // namespace airybench
