// The equilibrium triangle of equilibrium_element.hpp with curved sides: the same stress modes,
// whose polynomials go on to the curves (curved_side.hpp). Stresses stay free of divergence, and
// tractions continuous across straight sides. On a curved side all modes make forces, the inner
// ones too:
//
//   S = ∫ σ_i:C:σ_j over the curved thirds,   K = T S⁻¹ Tᵀ,   F as in curved_side.hpp
//
// A triangle at a curved boundary is rare: nothing here is made for speed.
#pragma once

#include <vector>

#include "assembly/elements/curved_side.hpp"
#include "assembly/elements/equilibrium_element.hpp"

namespace airybench {

// Per side of a triangle points of its curve, mm; none: it is straight.
using CurvedSides = std::array<std::span<const Eigen::Vector2d>, 3>;

// The functions of EquilibriumElement.
template <typename Scalar, int k>
class CurvedElement {
 public:
  using Straight = EquilibriumElement<Scalar, k>;
  using Degree = StressDegree<k>;
  using Stress = typename Straight::Stress;
  using OnEdges = typename Straight::OnEdges;
  using Defect = typename Straight::Defect;
  using Root = Eigen::Matrix<Scalar, Degree::modes, Degree::size, Eigen::RowMajor>;

  CurvedElement(const TriangleVertices& vertices, const Eigen::Matrix3d& compliance,
                const CurvedSides& sides);

  Root root() const;
  static void square(const Root& R, Scalar* lower);
  void subtract_outer_load(const Root& R, const Stress& particular, Scalar* forces) const;
  Stress stress(const OnEdges& displacement) const;
  Stress stress(const OnEdges& displacement, const Stress& particular) const;
  Defect defect(const OnEdges& displacement, const Stress& total) const;
  OnEdges edge_forces(const Stress& stress) const;
  Scalar energy(const Stress& sigma, const Stress& tau) const;
  Scalar independence() const { return flexibility_.independence(); }

 private:
  using Matrix = Eigen::MatrixX<Scalar>;
  using Vector = Eigen::VectorX<Scalar>;
  static constexpr int third = Degree::third, coefficients = 3 * Degree::coefficients;

  // |result|² = ∫ σ:C:σ.
  Vector weighted(const Stress& stress) const;
  Vector excess_work(const OnEdges& displacement, const Stress& stress) const;
  Vector solved(Vector work) const;

  std::array<Matrix, 3> forces_, mass_root_;  // per side and its third
  Eigen::Matrix3<Scalar> compliance_root_;    // Lᵀ of C = L Lᵀ
  Matrix modes_;                              // σ of the modes: columns as Stress
  Matrix of_modes_;                           // weighted() of the modes
  SmallCholesky<Scalar, Degree::modes> flexibility_;
};

template <typename Scalar, int k>
CurvedElement<Scalar, k>::CurvedElement(const TriangleVertices& vertices,
                                        const Eigen::Matrix3d& compliance,
                                        const CurvedSides& sides) {
  using Point = Eigen::Vector2<Scalar>;
  const Eigen::Matrix<Scalar, 2, 3> v = vertices.cast<Scalar>();
  const Point centroid = (v.col(0) + v.col(1) + v.col(2)) / Scalar(3);
  const ReferenceMatrices<Scalar>& reference = reference_matrices<Scalar>(k);
  Eigen::Matrix2<Scalar> B;
  B << v.col(1) - v.col(0), v.col(2) - v.col(0);
  const Scalar determinant = B(0, 0) * B(1, 1) - B(0, 1) * B(1, 0);
  using std::sqrt;
  for (int t = 0; t < 3; ++t) {
    if (!sides[t].empty()) {
      const CurvedSide<Scalar> side(sides[t], k);
      forces_[t] = side.stress_forces(centroid);
      mass_root_[t] = side.mass_root(centroid);
      continue;
    }
    mass_root_[t] = sqrt(determinant) * Eigen::Map<const Matrix>(reference.mass_root, third, third);
    const Point edge = (v.col((t + 1) % 3) - v.col(t)) / Scalar(k + 1);
    forces_[t] = Matrix::Zero(2 * Degree::points, 3 * third);
    for (int j = 0; j <= k; ++j)  // from xx, yy, xy, with n = (y, −x)
      forces_[t].template block<2, 3>(2 * j, 3 * j) << edge.y(), 0, -edge.x(), 0, -edge.x(),
          edge.y();
  }
  compliance_root_ = SmallCholesky<Scalar, 3>(compliance.cast<Scalar>()).L().transpose();

  const Eigen::Matrix3<Scalar> to_stress = equilibrium_formulas::stress_map(B, determinant);
  modes_.resize(coefficients, Degree::modes);
  of_modes_.resize(coefficients, Degree::modes);
  for (int mode = 0; mode < Degree::modes; ++mode) {
    Stress stress;
    for (int i = 0; i < Degree::coefficients; ++i) {
      Eigen::Vector3<Scalar> tau;
      for (int x = 0; x < 3; ++x) tau(x) = reference.stress[x][Degree::coefficients * mode + i];
      stress.col(i) = to_stress * tau;
    }
    modes_.col(mode) = stress.reshaped();
    of_modes_.col(mode) = weighted(stress);
  }
  const Eigen::Matrix<Scalar, coefficients, Degree::modes> M = of_modes_;
  flexibility_ = SmallCholesky<Scalar, Degree::modes>::of_root(M);
}

template <typename Scalar, int k>
typename CurvedElement<Scalar, k>::Vector CurvedElement<Scalar, k>::weighted(
    const Stress& stress) const {
  Stress result;
  for (int t = 0; t < 3; ++t)
    result.middleCols(third * t, third) =
        compliance_root_ * stress.middleCols(third * t, third) * mass_root_[t].transpose();
  return result.reshaped();
}

template <typename Scalar, int k>
typename CurvedElement<Scalar, k>::OnEdges CurvedElement<Scalar, k>::edge_forces(
    const Stress& stress) const {
  OnEdges forces;
  for (int t = 0; t < 3; ++t)
    forces.segment(2 * Degree::points * t, 2 * Degree::points) =
        forces_[t] * stress.middleCols(third * t, third).reshaped();
  return forces;
}

template <typename Scalar, int k>
typename CurvedElement<Scalar, k>::Root CurvedElement<Scalar, k>::root() const {
  Root R;
  for (int mode = 0; mode < Degree::modes; ++mode)
    R.row(mode) = edge_forces(modes_.col(mode).reshaped(3, Degree::coefficients)).transpose();
  for (int j = 0; j < Degree::size; ++j) {
    Vector column = R.col(j);
    flexibility_.solve_lower(column.data());
    R.col(j) = column;
  }
  return R;
}

template <typename Scalar, int k>
void CurvedElement<Scalar, k>::square(const Root& R, Scalar* lower) {
  for (int j = 0; j < Degree::size; ++j)
    for (int i = j; i < Degree::size; ++i) *lower++ = R.col(i).dot(R.col(j));
}

template <typename Scalar, int k>
void CurvedElement<Scalar, k>::subtract_outer_load(const Root& R, const Stress& particular,
                                                   Scalar* forces) const {
  Vector y = of_modes_.transpose() * weighted(particular);
  flexibility_.solve_lower(y.data());
  Eigen::Map<Vector>(forces, Degree::size) -= R.transpose() * y;
}

template <typename Scalar, int k>
typename CurvedElement<Scalar, k>::Vector CurvedElement<Scalar, k>::excess_work(
    const OnEdges& displacement, const Stress& stress) const {
  Vector work(Degree::modes);
  for (int mode = 0; mode < Degree::modes; ++mode)
    work(mode) = edge_forces(modes_.col(mode).reshaped(3, Degree::coefficients)).dot(displacement);
  return work - of_modes_.transpose() * weighted(stress);
}

template <typename Scalar, int k>
typename CurvedElement<Scalar, k>::Vector CurvedElement<Scalar, k>::solved(Vector work) const {
  flexibility_.solve(work.data());
  return work;
}

template <typename Scalar, int k>
typename CurvedElement<Scalar, k>::Stress CurvedElement<Scalar, k>::stress(
    const OnEdges& displacement) const {
  return stress(displacement, Stress::Zero());
}

template <typename Scalar, int k>
typename CurvedElement<Scalar, k>::Stress CurvedElement<Scalar, k>::stress(
    const OnEdges& displacement, const Stress& particular) const {
  const Vector total = modes_ * solved(excess_work(displacement, particular));
  return particular + total.reshaped(3, Degree::coefficients);
}

template <typename Scalar, int k>
typename CurvedElement<Scalar, k>::Defect CurvedElement<Scalar, k>::defect(
    const OnEdges& displacement, const Stress& total) const {
  const Vector g = excess_work(displacement, total), correction = solved(g);
  const Vector stress = modes_ * correction;
  return {edge_forces(stress.reshaped(3, Degree::coefficients)), g.dot(correction)};
}

template <typename Scalar, int k>
Scalar CurvedElement<Scalar, k>::energy(const Stress& sigma, const Stress& tau) const {
  return weighted(sigma).dot(weighted(tau));
}

}  // namespace airybench
