// Equilibrium triangle of degree k: stresses without divergence, continuous tractions, piecewise
// P_k on the three thirds of hct.hpp. k = 1 has the stresses of the HCT element.
//
// They are those of C¹ Airy functions φ of degree d = k + 2. In Bernstein form on the thirds, with
// ring c the coefficients at c/d of the way to the centroid V4, φ is C¹ exactly if on every spoke
// V_i V4 each coefficient is the mean of three of the ring before:
//
//   c[V_i^a V4^(c+1)] = (c[V_i^a V4^c V_(i−1)] + c[V_i^a V4^c V_(i+1)] + c[V_i^(a+1) V4^c]) / 3,
//                                                                    a + c = d − 1
//
// (Lai & Schumaker, Spline Functions on Triangulations, ch. 6, 2007.) All others are free; without
// those at the vertices, which affine φ have, they are the stress modes:
//
//   6k + 3         in rings 0 and 1: they make forces on the edges, all independent
//   3k(k − 1)/2    in rings 2 …: inner modes, no forces
//
// The conditions are affine invariant, so modes τ̂ and their edge forces T̂ are constant, computed
// once on the triangle (0,0) (1,0) (0,1) from integers and thirds. With x = V1 + B x̂,
//
//   σ = B τ̂ Bᵀ / det B,    F = B F̂,    S = Σ_m c_m M_m,    K = T S⁻¹ Tᵀ,  T = (I ⊗ B) T̂
//
// with six constant matrices M_m and the six entries c_m of the compliance in τ̂. K has rank 6k + 3:
// only rigid motions have no forces. (Fraeijs de Veubeke 1965; Johnson & Mercier 1978,
// doi:10.1007/BF01403910, for k = 1; De Almeida & Maunder, Equilibrium Finite Element Formulations,
// ch. 4, 2017.)
//
// Edges, walked counter-clockwise: the traction has k + 1 Bernstein control values t_j. Forces and
// their work partners, the moments of the displacement, are
//
//   F_j = L/(k+1) t_j in N,    ū_j = (k+1)/L ∫ B_j u ds in mm,    ∫ u·t ds = Σ_j F_j·ū_j
//
// The sum S loses as many digits as the compliance in τ̂ has condition: (length/height)⁴ on slivers,
// 1/(1 − 2ν) for ν → ½. Where these are many, S is factorised by its root, S = MᵀM, M = QR
// (SmallCholesky::of_root), which loses half of them.
//
// Templates over the scalar are instantiated for double and Wide; packs of doubles use the
// constant matrices in double.
#pragma once

#include <array>
#include <type_traits>

#include "assembly/elements/bernstein.hpp"
#include "assembly/elements/hct.hpp"
#include "assembly/elements/small_cholesky.hpp"
#include "assembly/elements/stress_degrees.hpp"
#include "support/wide.hpp"

namespace airybench {

template <int k>
struct StressDegree {
  static constexpr int points = k + 1;               // control values per edge
  static constexpr int size = 6 * points;            // of K: three edges, x and y
  static constexpr int third = bernstein_count(k);   // coefficients of P_k on a third
  static constexpr int coefficients = 3 * third;     // of one component
  static constexpr int inner = 3 * k * (k - 1) / 2;  // modes without edge forces
  static constexpr int outer = 6 * k + 3;            // the others
  static constexpr int modes = inner + outer;        // 9, 18, 30, 45
};

// The constant parts, on (0,0) (1,0) (0,1). Modes: the inner ones first. All matrices by columns.
template <typename Scalar>
struct ReferenceElement {
  explicit ReferenceElement(int k);
  using Matrix = Eigen::MatrixX<Scalar>;
  std::array<Matrix, 3> stress;  // Bernstein coefficients × modes, of τ̂xx, τ̂yy, τ̂xy, by thirds
  Matrix mass_root;              // W: |W c|² = ∫ p² over a third, p with the coefficients c
  std::array<Matrix, 3> weighted;     // W times `stress`, by thirds
  std::array<Matrix, 6> flexibility;  // M_m: of xx·xx, yy·yy, xy·xy, 2 xx·yy, 2 xx·xy, 2 yy·xy
  Matrix forces;                      // T̂ᵀ, outer modes × (per edge and control value x, y)
};

// Their entries, as plain data: kernels of several instruction sets share no code for doubles.
// Those in double are rounded from Wide.
template <typename Scalar>
struct ReferenceMatrices {
  const Scalar *stress[3], *mass_root, *weighted[3], *flexibility[6], *forces;
};
template <typename Scalar>
const ReferenceMatrices<Scalar>& reference_matrices(int k);  // computed at the first call

template <typename Scalar, int k>
class EquilibriumElement {
 public:
  using Degree = StressDegree<k>;
  using Stiffness = Eigen::Matrix<Scalar, Degree::size, Degree::size>;
  using OnEdges = Eigen::Matrix<Scalar, Degree::size, 1>;  // per edge and control value x, y
  // Rows: xx, yy, xy in MPa; columns: Bernstein coefficients, third by third.
  using Stress = Eigen::Matrix<Scalar, 3, Degree::coefficients>;
  using Root = Eigen::Matrix<Scalar, Degree::outer, Degree::size, Eigen::RowMajor>;

  enum class Factor { by_condition, of_product, of_root };  // of S

  // v: counter-clockwise, mm. compliance: elasticity.hpp.
  EquilibriumElement(const TriangleVerticesFor<Scalar>& v,
                     const Eigen::Matrix3<Data<Scalar>>& compliance,
                     Factor factor = Factor::by_condition);

  // K, N/mm: forces of the edges' displacements. Positive semidefinite to rounding.
  Stiffness stiffness() const;
  // R = L⁻¹ Tᵀ, and K = RᵀR: its lower triangle by columns.
  Root root() const;
  static void square(const Root& R, Scalar* lower);
  // f, N, with F = K ū + f for the total stress under a particular one, σ_p: F of σ_p, less Rᵀ
  // times the outer modes' share.
  OnEdges load(const Stress& particular) const;
  void subtract_outer_load(const Root& R, const Stress& particular, Scalar* forces) const;
  // The total stress of edges displaced by ū, mm: modes, and σ_p.
  Stress stress(const OnEdges& displacement) const { return of_modes(work_of(displacement)); }
  Stress stress(const OnEdges& displacement, const Stress& particular) const;

  // g = Tᵀ ū − ∫ σ(modes):C:σ is zero for the total stress σ that ū makes, but for rounding. The
  // correction S⁻¹ g of the modes has these forces, N, and the energy gᵀ S⁻¹ g, N mm.
  struct Defect {
    OnEdges forces;
    Scalar energy;
  };
  Defect defect(const OnEdges& displacement, const Stress& total) const;

  // F of any stress, N.
  OnEdges edge_forces(const Stress& stress) const;
  // ∫ σ : C : τ, N mm.
  Scalar energy(const Stress& sigma, const Stress& tau) const;

  // Smallest sine between a mode and those before it, in S's scalar product. Below a few roundings
  // S is not positive definite; NaN: data are not finite.
  Scalar independence() const { return flexibility_.independence(); }

 private:
  using Modes = std::array<Scalar, Degree::modes>;
  void factorise_root();
  void factorise_product(const Eigen::Matrix3<Scalar>& compliance_in_tau);
  void factorise_by_condition(const Eigen::Matrix3<Scalar>& compliance_in_tau);
  Modes modes_load(const Stress& particular) const;  // ∫ σ(modes) : C : σ_p
  Modes work_of(const OnEdges& displacement) const;  // Tᵀ ū
  Modes excess_work(const OnEdges& displacement, const Stress& stress) const;  // their difference
  Stress of_modes(Modes work) const;  // that of the modes S⁻¹ work

  const ReferenceMatrices<Constant<Scalar>>& reference_;
  Eigen::Matrix2<Scalar> B_;
  Scalar determinant_;
  Eigen::Matrix3<Scalar> to_stress_;   // (xx, yy, xy) of τ̂ → σ
  Eigen::Matrix3<Scalar> compliance_;  // C
  SmallCholesky<Scalar, Degree::modes> flexibility_;
};

namespace equilibrium_formulas {

// (xx, yy, xy) of B τ Bᵀ / det B.
template <typename Scalar>
Eigen::Matrix3<Scalar> stress_map(const Eigen::Matrix2<Scalar>& B, const Scalar& determinant) {
  const Scalar a = B(0, 0), b = B(0, 1), c = B(1, 0), d = B(1, 1), two = 2;
  const Scalar entries[3][3] = {
      {a * a, b * b, two * a * b}, {c * c, d * d, two * c * d}, {a * c, b * d, a * d + b * c}};
  Eigen::Matrix3<Scalar> map;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) map(i, j) = entries[i][j] / determinant;
  return map;
}

}  // namespace equilibrium_formulas

// Bernstein coefficients, as columns of EquilibriumElement::Stress, of a linear stress from its
// values (xx, yy, xy) at V1, V2, V3.
template <int k, typename Scalar>
typename EquilibriumElement<Scalar, k>::Stress linear_stress(
    const Eigen::Matrix3<Scalar>& at_vertices);

template <>
const ReferenceMatrices<double>& reference_matrices(int k);
extern template const ReferenceMatrices<Wide>& reference_matrices(int k);

}  // namespace airybench
