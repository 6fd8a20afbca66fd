// Isotropic linear elasticity in the plane: ε = C σ with σ = (σxx, σyy, σxy), ε = (εxx, εyy, 2εxy).
//
//         1  ⎡  1  −ν'      0     ⎤      plane strain  E' = E/(1−ν²)  ν' = ν/(1−ν)
//   C =  ─── ⎢ −ν'  1       0     ⎥      plane stress  E' = E         ν' = ν
//         E' ⎣  0   0    2(1+ν')  ⎦
//
// σᵀ C τ is the paper's A⁻¹σ·τ. C is symmetric positive definite for E > 0, −1 < ν < 1/2. Its
// entries are rounded to double here, once; then they are exact data, also in higher precision.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace airybench {

enum class Plane { strain, stress };

struct Material {
  double young_MPa = 210000;
  double poisson = 0.3;
  std::optional<double> expansion_per_K = {};  // none: 0
};

inline Eigen::Matrix3d compliance(const Material& material, Plane plane) {
  const bool strain = plane == Plane::strain;
  const double nu = material.poisson;
  const double young = strain ? material.young_MPa / (1 - nu * nu) : material.young_MPa;
  const double ratio = strain ? nu / (1 - nu) : nu;
  Eigen::Matrix3d c;
  c << 1, -ratio, 0, -ratio, 1, 0, 0, 0, 2 * (1 + ratio);
  return c / young;
}

// Bulk over shear modulus of plane fields: 1 / (1 − 2ν) in plane strain.
inline double bulk_over_shear(const Eigen::Matrix3d& compliance) {
  return compliance(2, 2) / (2 * (compliance(0, 0) + compliance(0, 1)));
}

}  // namespace airybench
