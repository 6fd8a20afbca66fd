// Stress fields that are linear on each third of each triangle, and their energies.
//
// Energies of φ are computed from stresses, not as ½φᵀSφ: φ is large where the stress is not, and
// its affine part cancels (measured on a rack: 4e-8 relative lost for a constant stress). Templates
// over the scalar are instantiated for double and long double.
#pragma once

#include <vector>

#include "assembly/problem.hpp"

namespace airybench {

// Columns: the nine corners of the three thirds as in HctStress; rows: xx, yy, xy in MPa.
template <typename Scalar>
using ElementStressIn = Eigen::Matrix<Scalar, 3, 9>;
using ElementStress = ElementStressIn<double>;
using StressField = std::vector<ElementStress>;  // per triangle

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

// ∫ σ : compliance : σ over the body, 1 mm thick, N mm: twice the strain energy.
double stress_norm_squared(const Problem& problem, const StressField& stress);

// √∫(σ−τ):C:(σ−τ) in √(N mm).
double stress_distance(const Problem& problem, const StressField& stress, const StressField& other);

// Generalised forces (edge_forces.hpp) on edge k for the outward normal, N. Columns: start and end
// in the element's walk; rows: x, y.
template <typename Scalar>
Eigen::Matrix2<Scalar> element_edge_forces(const TriangleVerticesFor<Scalar>& v,
                                           const Eigen::Matrix<Scalar, 3, 9>& stress, int k);

}  // namespace airybench
