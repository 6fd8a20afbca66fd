// Stress fields that are linear on each third of each triangle, and their energies.
//
// The energies of φ are computed from here and not as ½φᵀSφ: φ is large where the stress is not,
// and its affine part cancels (measured on a rack: 4e-8 relative lost for a constant stress).
//
// Templates over the scalar are instantiated for double and long double.
#pragma once

#include <vector>

#include "assembly/problem.hpp"

namespace airybench {

// Columns: the nine corners of the three thirds as in HctStress; rows: xx, yy, xy in MPa.
template <typename Scalar>
using ElementStressIn = Eigen::Matrix<Scalar, 3, 9>;
using ElementStress = ElementStressIn<double>;
using StressField = std::vector<ElementStress>;  // per triangle

// The stress of an Airy function given as airy_function() returns it, plus the particular stress of
// the body force.
StressField stress_of_airy_function(const Problem& problem, const Eigen::VectorXd& phi);

// Takes the affine part out of an element's twelve unknowns: it carries no stress, and without it
// less cancels.
template <typename Scalar>
void subtract_affine_part(const TriangleVertices& v, const EdgeSigns& outward,
                          Eigen::Matrix<Scalar, 12, 1>& local);

// The particular stress of the body force on one triangle.
template <typename Scalar = double>
ElementStressIn<Scalar> particular_element_stress(const Problem& problem, int triangle);

// The field w with Σ w·τ = ∫ σ : compliance : τ for every τ that is linear on each third.
template <typename Scalar>
ElementStressIn<Scalar> stress_dual(const Eigen::Matrix<Scalar, 3, 9>& stress,
                                    std::type_identity_t<Scalar> area_mm2,
                                    const Eigen::Matrix3<Data<Scalar>>& compliance);

// ∫ σ : compliance : σ over the body, 1 mm thick, N mm. Twice the strain energy.
double stress_norm_squared(const Problem& problem, const StressField& stress);

// √∫(σ−τ):C:(σ−τ), the distance of two fields in the energy norm, √(N mm).
double stress_distance(const Problem& problem, const StressField& stress, const StressField& other);

// Generalised forces (edge_forces.hpp) of an element's stress on its edge k, with the outward
// normal: columns at the edge's start and end as the element walks it; rows x, y; N.
template <typename Scalar>
Eigen::Matrix2<Scalar> element_edge_forces(const TriangleVerticesFor<Scalar>& v,
                                           const Eigen::Matrix<Scalar, 3, 9>& stress, int k);

}  // namespace airybench
