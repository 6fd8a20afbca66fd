// How large what a scene gives may be: far beyond what is meant, far from where products of it
// leave a double's range. docs/scenes.md has the table.
#pragma once

#include <Eigen/Core>

namespace airybench {

struct Magnitude {
  double most;
  const char* allowed;  // for a complaint

  bool has(double value) const { return value >= -most && value <= most; }  // not NaN
  bool has(const Eigen::Vector2d& value) const { return has(value.x()) && has(value.y()); }
};

inline constexpr Magnitude length_magnitude = {1e15, "(allowed: -1e15 to 1e15 mm)"},
                           stress_magnitude = {1e30, "(allowed: -1e30 to 1e30 MPa)"},
                           body_force_magnitude = {1e30, "(allowed: -1e30 to 1e30 N/mm³)"},
                           temperature_magnitude = {1e6, "(allowed: -1e6 to 1e6 K)"};

}  // namespace airybench
