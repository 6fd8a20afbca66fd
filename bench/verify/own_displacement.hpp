// The displacement of degree k + 1 on one triangle whose stress is nearest to σ in the energy norm,
// up to a rigid motion. σ has the degree k on each third.
//
// Of all strains of degree k the nearest is ε* = C Π σ, Π the L² projection. For k = 1 it belongs
// to a displacement. For k ≥ 2 there are k(k − 1)/2 conditions Nᵀε = 0 (Saint-Venant's), and the
// nearest strain that satisfies them is
//
//   ε = ε* − M⁻¹ N (Nᵀ M⁻¹ N)⁻¹ Nᵀ ε*,    εᵀ M ε = ∫ ε:A:ε
//
// In the coordinates ξ of displacement_triangle.hpp, with û = Bᵀu and ε̂ = Bᵀ ε B, conditions and
// integration are constant, and Nᵀ M⁻¹ N = Σ_m ĉ_m N_m has six constant matrices and the entries
// ĉ_m of the compliance there.
#pragma once

#include "assembly/displacement_triangle.hpp"

namespace airybench {

template <int k>
class OwnDisplacement {
 public:
  using Triangle = DisplacementTriangle<k + 1>;
  using Stress = Eigen::Matrix<double, 3, 3 * Triangle::strains>;  // coefficients by thirds, MPa

  OwnDisplacement();
  typename Triangle::Displacement operator()(const TriangleShape& shape,
                                             const Eigen::Matrix3d& compliance,
                                             const Stress& stress) const;

 private:
  static constexpr int n = Triangle::strains, conditions = k * (k - 1) / 2;
  Eigen::Matrix<double, 3 * n, n> projection_;                  // Π, of coefficients by thirds
  Eigen::Matrix<double, 2 * Triangle::nodes, 3 * n> integral_;  // ε̂ → û
  Eigen::Matrix<double, 3 * n, conditions> condition_;          // N
  std::array<Eigen::Matrix<double, conditions, conditions>, 6> product_;  // N_m
  Eigen::Matrix<double, n, n> mass_inverse_;
};

}  // namespace airybench
