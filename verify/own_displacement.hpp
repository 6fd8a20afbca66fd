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

#include "assembly/elements/displacement_triangle.hpp"

namespace airybench {

class OwnDisplacement {
 public:
  static const OwnDisplacement& of_degree(int k);  // of σ; made at the first call
  // stress: coefficients by thirds, MPa.
  DisplacementTriangle::Displacement operator()(
      const TriangleShape& shape, const Eigen::Matrix3d& compliance,
      const DisplacementTriangle::StressRef& stress) const;

 private:
  explicit OwnDisplacement(int k);

  const DisplacementTriangle& triangle_;
  Eigen::MatrixXd projection_;              // Π, of coefficients by thirds
  Eigen::MatrixXd integral_;                // ε̂ → û
  Eigen::MatrixXd condition_;               // N
  std::array<Eigen::MatrixXd, 6> product_;  // N_m
  Eigen::MatrixXd mass_inverse_;
};

}  // namespace airybench
