// Stress fields that are polynomials of a degree k on each third of each triangle, and their
// energies.
//
// Energies of φ are computed from stresses, not as ½φᵀSφ: φ is large where the stress is not, and
// its affine part cancels (measured on a rack: 4e-8 relative lost for a constant stress). Templates
// over the scalar are instantiated for double and Wide.
#pragma once

#include "assembly/elements/bernstein.hpp"
#include "assembly/problem/problem.hpp"

namespace airybench {

// Linear on each third. Columns: the nine corners of the three thirds as in HctStress; rows: xx,
// yy, xy in MPa.
template <typename Scalar>
using ElementStressIn = Eigen::Matrix<Scalar, 3, 9>;
using ElementStress = ElementStressIn<double>;

// Per triangle the Bernstein coefficients of its thirds: the columns of EquilibriumElement::Stress.
// For k = 1 these are the corner values, ElementStress.
class StressField {
 public:
  StressField() = default;
  explicit StressField(std::size_t triangles, int degree = 1)
      : degree_(degree),
        columns_(3 * bernstein_count(degree)),
        values_(3, columns_ * static_cast<Eigen::Index>(triangles)) {}

  int degree() const { return degree_; }
  std::size_t size() const { return static_cast<std::size_t>(values_.cols() / columns_); }
  bool empty() const { return values_.cols() == 0; }
  auto operator[](std::size_t triangle) {
    return values_.middleCols(static_cast<Eigen::Index>(triangle) * columns_, columns_);
  }
  auto operator[](std::size_t triangle) const {
    return values_.middleCols(static_cast<Eigen::Index>(triangle) * columns_, columns_);
  }
  bool operator==(const StressField& other) const = default;
  // At the nine corners of its thirds.
  ElementStress corners(std::size_t triangle) const {
    ElementStress corners;
    const auto own = (*this)[triangle];
    for (Eigen::Index t = 0; t < 3; ++t)
      corners.middleCols<3>(3 * t) << own.col(t * columns_ / 3),
          own.col(t * columns_ / 3 + degree_), own.col((t + 1) * columns_ / 3 - 1);
    return corners;
  }
  // Of all triangles, one after the other.
  Eigen::Matrix3Xd& values() { return values_; }
  const Eigen::Matrix3Xd& values() const { return values_; }

 private:
  int degree_ = 1;
  Eigen::Index columns_ = 9;
  Eigen::Matrix3Xd values_;
};

// phi: as airy_function() returns it. Adds the particular stress of the body force.
StressField stress_of_airy_function(const Problem& problem, const Eigen::VectorXd& phi);

// Subtracts the affine part of an element's twelve unknowns: it carries no stress and would cancel.
template <typename Scalar>
void subtract_affine_part(const TriangleVertices& v, const EdgeSigns& outward,
                          Eigen::Matrix<Scalar, 12, 1>& local);

template <typename Scalar = double>
ElementStressIn<Scalar> particular_element_stress(const Problem& problem, int triangle);

// w with Σ w·τ = ∫ σ : compliance : τ for every τ that is linear on each third.
template <typename Scalar>
ElementStressIn<Scalar> stress_dual(const Eigen::Matrix<Scalar, 3, 9>& stress,
                                    std::type_identity_t<Scalar> area_mm2,
                                    const Eigen::Matrix3<Data<Scalar>>& compliance);

// The same with ∫ ε0 : τ, of thermal strain.
template <typename Scalar>
ElementStressIn<Scalar> thermal_dual(const Problem& problem, int triangle);

// ∫ σ : C : τ over a triangle, 1 mm thick, N mm, of fields of one degree, or of their coefficients
// there. Where stresses of the degree follow curves (Problem::round), up to these.
using StressCoefficients = Eigen::Ref<const Eigen::Matrix3Xd>;
double stress_product(const Problem& problem, int triangle, const StressCoefficients& sigma,
                      const StressCoefficients& tau);
inline double stress_product(const Problem& problem, int triangle, const StressField& sigma,
                             const StressField& tau) {
  const auto t = static_cast<std::size_t>(triangle);
  return stress_product(problem, triangle, sigma[t], tau[t]);
}

// ∫ σ : compliance : σ over the body, 1 mm thick, N mm: twice the strain energy.
double stress_norm_squared(const Problem& problem, const StressField& stress);

// √∫(σ−τ):C:(σ−τ) in √(N mm), of fields of one degree.
double stress_distance(const Problem& problem, const StressField& stress, const StressField& other);

// Forces on edge k for the outward normal, N, of a triangle of a StressField. Columns: the control
// values' forces F_j (equilibrium_element.hpp) in the element's walk; rows: x, y.
using ForcesOnEdge = EdgeMoments;
ForcesOnEdge element_edge_forces(const TriangleVertices& v, const StressCoefficients& stress,
                                 int k);
// The same on a curve of that edge (curved_side.hpp).
ForcesOnEdge curved_edge_forces(const TriangleVertices& v, const StressCoefficients& stress, int k,
                                const SideCurve& curve);

}  // namespace airybench
