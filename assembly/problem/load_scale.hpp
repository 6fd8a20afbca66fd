// The size of what the loads and the rigid motion could do to a body. Errors are relative to it
// only if they leave the body without stress.
#pragma once

#include "assembly/problem/problem.hpp"

namespace airybench {

// error / quantity; error / scale if the quantity is zero; 0 if the error is zero.
double relative_error(double error, double quantity, double scale);

struct LoadScale {
  double energy_norm = 0;  // √(N mm)
  double force_N = 0;
  // What rounding may leave of either where it should be zero: bodies that miss each other move as
  // a whole, each by its own motion, and only that of all is taken out beforehand; warmth that
  // nothing hinders cancels. (Of a lug and its pin 6e-12 is left, more on finer meshes.)
  double rounding = 0;

  bool is_no_energy(double norm) const { return norm <= rounding * energy_norm; }
  double relative_energy(double error, double norm) const {
    return relative_error(error, is_no_energy(norm) ? 0 : norm, energy_norm);
  }
  double relative_force(double error, double force) const {
    return relative_error(error, force <= rounding * force_N ? 0 : force, force_N);
  }
};
LoadScale load_scale(const Problem& problem);

// NaN if one of them is: an unknown error is the worst.
double larger_error(double one, double other);

}  // namespace airybench
