// Hsieh–Clough–Tocher triangle: a C¹ piecewise cubic for the Airy function φ.
//
// The triangle V1 V2 V3 is split at its centroid V4 into three thirds; third t lies on edge V_t
// V_{t+1}. On each third φ is a cubic in Bernstein form with coefficients from
//
//   12 degrees of freedom, in this order:
//     φ, φ,x, φ,y at V1, V2, V3,  then ∂φ/∂n at the middle of edges V1V2, V2V3, V3V1
//
// Edge normals are oriented once per mesh: for an edge from its low to its high vertex with tangent
// s, n = (s_y, −s_x). Every cubic is reproduced; φ is C¹ across thirds and elements. The stress
//
//   σxx = φ,yy   σyy = φ,xx   σxy = −φ,xy
//
// is linear on each third and given by its corner values. It is divergence-free inside thirds, with
// continuous traction everywhere.
//
// Clough & Tocher 1965; Bernadou & Hassan, Int. J. Numer. Methods Eng. 17 (1981), 784–789,
// doi:10.1002/nme.1620170510; Lai & Schumaker, Spline Functions on Triangulations, ch. 6 (2007).
//
// Functions that are templates over the scalar are instantiated for double (others:
// hct_templates.hpp). Coordinates are exact (exact_data.hpp); their differences are formed first,
// in the scalar.
#pragma once

#include <Eigen/Core>
#include <array>
#include <type_traits>

#include "assembly/elements/exact_data.hpp"

namespace airybench {

// Columns V1 V2 V3, counter-clockwise, mm.
template <typename Scalar>
using TriangleVerticesFor = Eigen::Matrix<Data<Scalar>, 2, 3>;
using TriangleVertices = TriangleVerticesFor<double>;
// +1: the edge's global normal is outward, −1: inward.
using EdgeSigns = std::array<double, 3>;

// Rows: the 19 Bernstein coefficients; columns: the 12 degrees of freedom.
//   0..2    at V_i                           12..14  inside third t
//   3..8    at (2V_t+V_{t+1})/3, (V_t+2V_{t+1})/3   15..17  at (V_i+2V4)/3
//   9..11   at (2V_i+V4)/3                   18      at V4
template <typename Scalar>
using HctCoefficientsIn = Eigen::Matrix<Scalar, 19, 12>;
using HctCoefficients = HctCoefficientsIn<double>;
template <typename Scalar = double>
HctCoefficientsIn<Scalar> hct_coefficients(const TriangleVerticesFor<Scalar>& v,
                                           const EdgeSigns& outward);

// Rows of HctCoefficients that belong to third t, in the order
// 300 030 003 210 120 201 021 111 102 012 of the barycentric exponents on V_t, V_{t+1}, V4.
std::array<int, 10> hct_third(int t);

// Rows: 3 corner + component, with corner = 3 t + (0: V_t, 1: V_{t+1}, 2: V4) and component xx, yy,
// xy. Columns: degrees of freedom. Times φ in N: stress in MPa.
template <typename Scalar>
using HctStressIn = Eigen::Matrix<Scalar, 27, 12>;
using HctStress = HctStressIn<double>;
template <typename Scalar = double>
HctStressIn<Scalar> hct_stress(const TriangleVerticesFor<Scalar>& v, const EdgeSigns& outward);

// ∫ σ(φ_i) : compliance : σ(φ_j) over the triangle, 1 mm thick.
// compliance: 3×3 in (xx, yy, xy), see elasticity.hpp. Exact: on a third of area a with corner
// values σ_m, ∫ = a/12 (Σσ_m : Σσ_m + Σ σ_m : σ_m). Symmetric, positive semidefinite; kernel:
// affine φ.
using HctFlexibility = Eigen::Matrix<double, 12, 12>;
HctFlexibility hct_flexibility(const HctStress& stress, double area_mm2,
                               const Eigen::Matrix3d& compliance);

// M with MᵀM = the flexibility.
Eigen::Matrix<double, 36, 12> hct_flexibility_root(const HctStress& stress, double area_mm2,
                                                   const Eigen::Matrix3d& compliance);

}  // namespace airybench
