// Thermal strain ε0 = e(x) 1 in the plane, e linear in x: α ΔT in plane stress, (1 + ν) α ΔT in
// plane strain. It belongs to a displacement,
//
//   u_th(x) = e(c) d + (∇e·d) d − |d|²/2 ∇e,   d = x − c,   ε(u_th) = ε0 for any c,
//
// so that σ = A (ε(u) − ε0) = A ε(u − u_th): on a triangle whose sides are displaced by ū the
// stress is that of ū less u_th, in every method.
#pragma once

#include <Eigen/Core>

namespace airybench {

struct ThermalStrain {
  double at_origin = 0;
  Eigen::Vector2d slope_per_mm = {0, 0};
  // σ_zz = ν (σ_xx + σ_yy) − E/(1 + ν) e in plane strain; 0 in plane stress.
  double modulus_zz_MPa = 0;

  bool operator==(const ThermalStrain&) const = default;
  bool is_zero() const { return at_origin == 0 && slope_per_mm.isZero(0); }
  double at(const Eigen::Vector2d& x) const { return at_origin + slope_per_mm.dot(x); }
  // Zero at c.
  Eigen::Vector2d displacement(const Eigen::Vector2d& x, const Eigen::Vector2d& c) const {
    const Eigen::Vector2d d = x - c;
    return at(c) * d + slope_per_mm.dot(d) * d - d.squaredNorm() / 2 * slope_per_mm;
  }
};

}  // namespace airybench
