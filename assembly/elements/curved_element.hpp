// The equilibrium triangle of equilibrium_element.hpp with curved sides: the same stress modes,
// whose polynomials go on to the curves (curved_side.hpp). Stresses stay free of divergence, and
// tractions continuous across straight sides. On a curved side all modes make forces, the inner
// ones too:
//
//   S = ∫ σ_i:C:σ_j over the curved thirds,   K = T S⁻¹ Tᵀ,   F as in curved_side.hpp
//
// A triangle at a curved boundary is rare: nothing here is made for speed, and the degree is known
// when it runs.
#pragma once

#include <array>

#include "assembly/elements/curved_side.hpp"
#include "assembly/elements/hct.hpp"
#include "assembly/elements/small_cholesky.hpp"

namespace airybench {

// The functions of EquilibriumElement, of degree k ≥ 2. Scalar: double, Wide.
template <typename Scalar>
class CurvedElement {
 public:
  using OnEdges = Eigen::VectorX<Scalar>;
  using Stress = Eigen::Matrix3X<Scalar>;
  using Root = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Defect {
    OnEdges forces;
    Scalar energy;
  };

  CurvedElement(const TriangleVertices& vertices, const Eigen::Matrix3d& compliance,
                const CurvedSides& sides, int degree);

  Root root() const;
  static void square(const Root& R, Scalar* lower);
  void subtract_outer_load(const Root& R, const Stress& particular, Scalar* forces) const;
  Stress stress(const OnEdges& displacement) const;
  Stress stress(const OnEdges& displacement, const Stress& particular) const;
  Defect defect(const OnEdges& displacement, const Stress& total) const;
  OnEdges edge_forces(const Stress& stress) const;
  Scalar energy(const Stress& sigma, const Stress& tau) const;
  Scalar independence() const { return root_.independence(); }

 private:
  using Matrix = Eigen::MatrixX<Scalar>;
  using Vector = Eigen::VectorX<Scalar>;

  Vector weighted(const Stress& stress) const;  // |result|² = ∫ σ:C:σ
  Vector excess_work(const OnEdges& displacement, const Stress& stress) const;
  Stress of_modes(Vector work) const;  // that of the modes S⁻¹ work

  Eigen::Index third_;                        // Bernstein coefficients of a third
  std::array<Matrix, 3> forces_, mass_root_;  // per side and its third
  Eigen::Matrix3<Scalar> compliance_root_;    // Lᵀ of C = L Lᵀ
  Matrix modes_;                              // σ of the modes: columns as Stress
  Matrix of_modes_;                           // weighted() of the modes
  GramRoot<Scalar> root_;                     // of these: S = RᵀR
  Matrix forces_of_modes_;                    // T
};

extern template class CurvedElement<double>;
extern template class CurvedElement<Wide>;

}  // namespace airybench
