// Definitions of equilibrium_element.hpp, to instantiate them for further scalars.
#pragma once

#include <cmath>
#include <vector>

#include "assembly/equilibrium_element.hpp"
#include "assembly/hct_templates.hpp"

namespace airybench {
namespace equilibrium_formulas {

using hct_formulas::next;

// φ of one mode: the Bernstein coefficients of the three thirds by ring_place().
template <typename Scalar>
using AiryModes = std::vector<std::array<std::vector<Scalar>, 3>>;

// Adds the coefficients on the spokes to those in rings.
template <typename Scalar>
void complete_spokes(std::array<std::vector<Scalar>, 3>& phi, int d) {
  for (int c = 0; c < d; ++c)
    for (int i = 0; i < 3; ++i) {
      const int before = next(next(i)), a = d - 1 - c;
      const Scalar mean = (phi[i][ring_place(d, 0, c)] + phi[i][ring_place(d, 1, c)] +
                           phi[before][ring_place(d, a, c)]) /
                          Scalar(3);
      phi[i][ring_place(d, 0, c + 1)] = mean;
      phi[before][ring_place(d, a, c + 1)] = mean;
    }
}

template <typename Scalar>
AiryModes<Scalar> airy_modes(int d) {
  AiryModes<Scalar> modes;
  const auto add_ring = [&](int c) {
    for (int t = 0; t < 3; ++t)
      for (int b = 1; b < d - c; ++b) {
        auto& phi = modes.emplace_back();
        phi.fill(std::vector<Scalar>(bernstein_count(d), Scalar(0)));
        phi[t][ring_place(d, b, c)] = 1;
        complete_spokes(phi, d);
      }
  };
  for (int c = 2; c < d; ++c) add_ring(c);
  add_ring(1);
  add_ring(0);
  return modes;
}

// W with S = WᵀW.
template <typename Scalar>
Eigen::MatrixX<Scalar> cholesky_root(const Eigen::MatrixX<Scalar>& S) {
  using std::sqrt;
  Eigen::MatrixX<Scalar> W = Eigen::MatrixX<Scalar>::Zero(S.rows(), S.cols());
  for (int j = 0; j < S.cols(); ++j)
    for (int i = 0; i <= j; ++i) {
      Scalar sum = S(i, j);
      for (int m = 0; m < i; ++m) sum -= W(m, i) * W(m, j);
      W(i, j) = i < j ? Scalar(sum / W(i, i)) : Scalar(sqrt(sum));
    }
  return W;
}

template <typename Scalar>
hct_formulas::Corners<Scalar> reference_triangle() {
  hct_formulas::Corners<Scalar> v;
  v << 0, 1, 0, 0, 0, 1;
  return v;
}

// n L of edge t.
template <typename Scalar>
Eigen::Vector2<Scalar> long_normal(const hct_formulas::Corners<Scalar>& v, int t) {
  const Eigen::Vector2<Scalar> edge = v.col(next(t)) - v.col(t);
  return {edge.y(), -edge.x()};
}

template <typename Scalar>
Eigen::Vector2<Scalar> traction_of(const Eigen::Vector3<Scalar>& stress,
                                   const Eigen::Vector2<Scalar>& normal) {
  return {stress(0) * normal.x() + stress(2) * normal.y(),
          stress(2) * normal.x() + stress(1) * normal.y()};
}

// (xx, yy, xy) of B τ Bᵀ / det B.
template <typename Scalar>
Eigen::Matrix3<Scalar> stress_map(const Eigen::Matrix2<Scalar>& B, const Scalar& determinant) {
  const Scalar a = B(0, 0), b = B(0, 1), c = B(1, 0), d = B(1, 1), two = 2;
  Eigen::Matrix3<Scalar> map;
  map << a * a, b * b, two * a * b, c * c, d * d, two * c * d, a * c, b * d, a * d + b * c;
  return map / determinant;
}

// Components of the six flexibility matrices.
constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

}  // namespace equilibrium_formulas

template <typename Scalar>
ReferenceElement<Scalar>::ReferenceElement(int k) {
  using namespace equilibrium_formulas;
  const int d = k + 2, third = bernstein_count(k);
  const hct_formulas::Corners<Scalar> v = reference_triangle<Scalar>();
  const Eigen::Vector2<Scalar> centroid = hct_formulas::mean(v);
  const AiryModes<Scalar> airy = airy_modes<Scalar>(d);
  const int modes = static_cast<int>(airy.size()), outer = 6 * k + 3;
  for (Matrix& component : stress) component.resize(3 * third, modes);
  for (int t = 0; t < 3; ++t) {
    const hct_formulas::Corners<Scalar> g =
        hct_formulas::barycentric_gradients<Scalar>(v.col(t), v.col(next(t)), centroid);
    for (int mode = 0; mode < modes; ++mode)
      for (int c = 0; c <= k; ++c)
        for (int b = 0; b <= k - c; ++b) {
          Eigen::Matrix2<Scalar> second = Eigen::Matrix2<Scalar>::Zero();  // ∇∇φ
          for (int p = 0; p < 3; ++p)
            for (int q = 0; q < 3; ++q) {
              const int place = ring_place(d, b + (p == 1) + (q == 1), c + (p == 2) + (q == 2));
              second += Scalar(d * (d - 1)) * airy[mode][t][place] *
                        g.col(p).lazyProduct(g.col(q).transpose());
            }
          const int row = third * t + ring_place(k, b, c);
          stress[0](row, mode) = second(1, 1);
          stress[1](row, mode) = second(0, 0);
          stress[2](row, mode) = -second(0, 1);
        }
  }

  mass_root = cholesky_root<Scalar>(bernstein_mass(k, Scalar(1) / Scalar(6)));
  for (int component = 0; component < 3; ++component) {
    weighted[component].resize(3 * third, modes);
    for (int t = 0; t < 3; ++t)
      weighted[component].middleRows(third * t, third) =
          mass_root.lazyProduct(stress[component].middleRows(third * t, third));
  }
  for (int m = 0; m < 6; ++m) {
    const auto [a, b] = pairs[m];
    const Matrix product = weighted[a].transpose().lazyProduct(weighted[b]);
    flexibility[m] = a == b ? product : Matrix(product + product.transpose());
  }

  forces.resize(outer, 6 * (k + 1));
  for (int t = 0; t < 3; ++t) {
    const Eigen::Vector2<Scalar> normal = long_normal(v, t) / Scalar(k + 1);
    for (int j = 0; j <= k; ++j) {
      const int row = third * t + j, column = 2 * ((k + 1) * t + j);
      for (int mode = 0; mode < outer; ++mode) {
        const int of_mode = modes - outer + mode;
        const Eigen::Vector3<Scalar> tau(stress[0](row, of_mode), stress[1](row, of_mode),
                                         stress[2](row, of_mode));
        forces.row(mode).template segment<2>(column) = traction_of(tau, normal).transpose();
      }
    }
  }
}

template <typename Scalar, int k>
const ReferenceMatrices<Scalar>& reference_matrices() {
  static const ReferenceElement<Scalar> element(k);
  static const ReferenceMatrices<Scalar> matrices = [] {
    ReferenceMatrices<Scalar> data;
    for (int c = 0; c < 3; ++c) data.stress[c] = element.stress[c].data();
    data.mass_root = element.mass_root.data();
    for (int c = 0; c < 3; ++c) data.weighted[c] = element.weighted[c].data();
    for (int m = 0; m < 6; ++m) data.flexibility[m] = element.flexibility[m].data();
    data.forces = element.forces.data();
    return data;
  }();
  return matrices;
}

template <typename Scalar, int k>
EquilibriumElement<Scalar, k>::EquilibriumElement(const TriangleVerticesFor<Scalar>& vertices,
                                                  const Eigen::Matrix3<Data<Scalar>>& compliance,
                                                  Factor factor)
    : compliance_(compliance.template cast<Scalar>()) {
  const hct_formulas::Corners<Scalar> v = hct_formulas::at_origin<Scalar>(vertices);
  B_ << v.col(1), v.col(2);
  determinant_ = B_(0, 0) * B_(1, 1) - B_(0, 1) * B_(1, 0);
  to_stress_ = equilibrium_formulas::stress_map(B_, determinant_);
  const Eigen::Matrix3<Scalar> strain = compliance_.lazyProduct(to_stress_) * determinant_;
  const Eigen::Matrix3<Scalar> c = to_stress_.transpose().lazyProduct(strain);  // in τ̂
  if (factor == Factor::of_root)
    factorise_root();
  else if (factor == Factor::of_product)
    factorise_product(c);
  else
    factorise_by_condition(c);
}

// With λ1 ≥ λ2 ≥ λ3 of the compliance c in τ̂, tr c ≥ λ1 and the sum of its 2 × 2 minors ≥ λ1 λ2:
// their product over det c = λ1 λ2 λ3 is at least the condition, λ1/λ3, at most 9 times as much.
// The map from τ̂ has the determinant 1. More than the limit loses more than 1e-12. Elements of a
// pack get the factors that each gets by itself.
template <typename Scalar, int k>
void EquilibriumElement<Scalar, k>::factorise_by_condition(const Eigen::Matrix3<Scalar>& c) {
  const SmallCholesky<Scalar, 3> of_compliance(compliance_);
  const Scalar pivots = of_compliance.L().diagonal().prod();
  const Scalar determinant = pivots * pivots * determinant_ * determinant_ * determinant_;
  const Scalar minors = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1) + c(0, 0) * c(2, 2) -
                        c(0, 2) * c(0, 2) + c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
  const auto well_conditioned = c.trace() * minors < Scalar(5000) * determinant;
  if (!any(well_conditioned)) return factorise_root();
  factorise_product(c);
  if (all(well_conditioned)) return;
  const auto of_product = flexibility_;
  factorise_root();
  flexibility_ = flexibility_.chosen(well_conditioned, of_product, flexibility_);
}

template <typename Scalar, int k>
void EquilibriumElement<Scalar, k>::factorise_root() {
  using std::sqrt;
  const SmallCholesky<Scalar, 3> of_compliance(compliance_);
  const Eigen::Matrix3<Scalar> R =
      of_compliance.L().transpose().lazyProduct(to_stress_) * sqrt(determinant_);
  constexpr int rows = Degree::coefficients;
  Eigen::Matrix<Scalar, 3 * rows, Degree::modes> M;
  for (int mode = 0; mode < Degree::modes; ++mode) {
    const Constant<Scalar>* weighted[3];
    for (int c = 0; c < 3; ++c) weighted[c] = reference().weighted[c] + rows * mode;
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < rows; ++i)
        M(a * rows + i, mode) =
            R(a, 0) * weighted[0][i] + R(a, 1) * weighted[1][i] + R(a, 2) * weighted[2][i];
  }
  flexibility_ = SmallCholesky<Scalar, Degree::modes>::of_root(M);
}

template <typename Scalar, int k>
void EquilibriumElement<Scalar, k>::factorise_product(const Eigen::Matrix3<Scalar>& c) {
  Eigen::Matrix<Scalar, Degree::modes, Degree::modes> S;
  for (int j = 0; j < Degree::modes; ++j) {
    const Constant<Scalar>* M[6];
    for (int m = 0; m < 6; ++m) M[m] = reference().flexibility[m] + Degree::modes * j;
    for (int i = j; i < Degree::modes; ++i)  // its lower triangle is read
      S(i, j) = c(0, 0) * M[0][i] + c(1, 1) * M[1][i] + c(2, 2) * M[2][i] + c(0, 1) * M[3][i] +
                c(0, 2) * M[4][i] + c(1, 2) * M[5][i];
  }
  flexibility_ = SmallCholesky<Scalar, Degree::modes>(S);
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Root EquilibriumElement<Scalar, k>::root() const {
  Root R;  // Tᵀ = T̂ᵀ (I ⊗ Bᵀ). The inner modes' rows are zero and stay so under L⁻¹.
  const Constant<Scalar>* forces = reference().forces;
  for (int j = 0; j < Degree::size; j += 2, forces += 2 * Degree::outer)
    for (int i = 0; i < Degree::outer; ++i)
      for (int x = 0; x < 2; ++x)
        R(i, j + x) = forces[i] * B_(x, 0) + forces[Degree::outer + i] * B_(x, 1);
  constexpr int first = Degree::inner;
  for (int i = 0; i < Degree::outer; ++i) {
    const auto factor = [&](int j) { return -flexibility_.L()(first + i, first + j); };
    add_multiples(&R(i, 0), Degree::size, i, factor, &R(0, 0), Degree::size);
    R.row(i) *= flexibility_.reciprocal()(first + i);
  }
  return R;
}

template <typename Scalar, int k>
void EquilibriumElement<Scalar, k>::square(const Root& R, Scalar* lower) {
  for (int j = 0; j < Degree::size; ++j) {
    const int length = Degree::size - j;
    for (int i = 0; i < length; ++i) lower[i] = 0;
    add_multiples(
        lower, length, Degree::outer, [&](int m) { return R(m, j); }, &R(0, j), Degree::size);
    lower += length;
  }
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Stiffness EquilibriumElement<Scalar, k>::stiffness() const {
  Scalar lower[Degree::size * (Degree::size + 1) / 2];
  square(root(), lower);
  Stiffness K;
  const Scalar* entry = lower;
  for (int j = 0; j < Degree::size; ++j)
    for (int i = j; i < Degree::size; ++i) K(i, j) = K(j, i) = *entry++;
  return K;
}

namespace equilibrium_formulas {

// W times the coefficients of each third and component: their scalar products are integrals.
template <typename Scalar, int coefficients>
Eigen::Matrix<Scalar, 3, coefficients> in_orthonormal(
    const Constant<Scalar>* W, const Eigen::Matrix<Scalar, 3, coefficients>& stress) {
  constexpr int n = coefficients / 3;
  Eigen::Matrix<Scalar, 3, coefficients> result = Eigen::Matrix<Scalar, 3, coefficients>::Zero();
  for (int t = 0; t < 3; ++t)
    for (int i = 0; i < n; ++i)
      for (int j = i; j < n; ++j)
        result.col(n * t + i) += Scalar(W[n * j + i]) * stress.col(n * t + j);
  return result;
}

}  // namespace equilibrium_formulas

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Modes EquilibriumElement<Scalar, k>::modes_load(
    const Stress& particular) const {
  const Eigen::Matrix3<Scalar> dual = to_stress_.transpose().lazyProduct(compliance_);
  const Components strain = determinant_ * dual.lazyProduct(equilibrium_formulas::in_orthonormal(
                                                                reference().mass_root, particular))
                                               .transpose();
  Modes load = Modes::Zero();
  for (int component = 0; component < 3; ++component)
    for (int mode = 0; mode < Degree::modes; ++mode)
      load(mode) += in_four_sums(reference().weighted[component] + Degree::coefficients * mode,
                                 &strain(0, component), 0, Degree::coefficients);
  return load;
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::OnEdges EquilibriumElement<Scalar, k>::load(
    const Stress& particular) const {
  return edge_forces(particular) - root().transpose().lazyProduct(outer_load(particular));
}

template <typename Scalar, int k>
Eigen::Matrix<Scalar, StressDegree<k>::outer, 1> EquilibriumElement<Scalar, k>::outer_load(
    const Stress& particular) const {
  Modes y = modes_load(particular);
  flexibility_.solve_lower(y);
  return y.template tail<Degree::outer>();
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Modes EquilibriumElement<Scalar, k>::work_of(
    const OnEdges& displacement) const {
  OnEdges u;  // in x̂
  for (int j = 0; j < Degree::size; j += 2)
    u.template segment<2>(j) = B_.transpose().lazyProduct(displacement.template segment<2>(j));
  Modes work = Modes::Zero();
  add_multiples(
      &work(Degree::inner), Degree::outer, Degree::size, [&](int j) { return u(j); },
      reference().forces, Degree::outer);
  return work;
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Defect EquilibriumElement<Scalar, k>::defect(
    const OnEdges& displacement, const Stress& total) const {
  const Modes g = work_of(displacement) - modes_load(total);
  Modes correction = g;
  flexibility_.solve(correction);
  Defect result{OnEdges::Zero(), g.dot(correction)};
  const auto force = [&](int j) {
    return in_four_sums(reference().forces + Degree::outer * j, &correction(Degree::inner), 0,
                        Degree::outer);
  };
  for (int j = 0; j < Degree::size; j += 2)
    result.forces.template segment<2>(j) =
        B_.lazyProduct(Eigen::Vector2<Scalar>(force(j), force(j + 1)));
  return result;
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Stress EquilibriumElement<Scalar, k>::of_modes(
    Modes work) const {
  flexibility_.solve(work);
  Components tau = Components::Zero();
  for (int component = 0; component < 3; ++component)
    add_multiples(
        &tau(0, component), Degree::coefficients, Degree::modes, [&](int m) { return work(m); },
        reference().stress[component], Degree::coefficients);
  return to_stress_.lazyProduct(tau.transpose());
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::OnEdges EquilibriumElement<Scalar, k>::edge_forces(
    const Stress& stress) const {
  using namespace equilibrium_formulas;
  hct_formulas::Corners<Scalar> v;
  v << Eigen::Vector2<Scalar>::Zero(), B_;
  OnEdges forces;
  for (int t = 0; t < 3; ++t) {
    const Eigen::Vector2<Scalar> normal = long_normal(v, t) / Scalar(k + 1);
    for (int j = 0; j <= k; ++j)
      forces.template segment<2>(2 * ((k + 1) * t + j)) =
          traction_of<Scalar>(stress.col(Degree::third * t + j), normal);
  }
  return forces;
}

template <typename Scalar, int k>
Scalar EquilibriumElement<Scalar, k>::energy(const Stress& sigma, const Stress& tau) const {
  using equilibrium_formulas::in_orthonormal;
  const Stress strain = compliance_.lazyProduct(in_orthonormal(reference().mass_root, sigma));
  return determinant_ * strain.cwiseProduct(in_orthonormal(reference().mass_root, tau)).sum();
}

template <int k, typename Scalar>
typename EquilibriumElement<Scalar, k>::Stress linear_stress(
    const Eigen::Matrix3<Scalar>& at_vertices) {
  // A linear function's Bernstein coefficients are its values at the domain points.
  const Eigen::Vector3<Scalar> at_centroid = at_vertices.rowwise().sum() / Scalar(3);
  typename EquilibriumElement<Scalar, k>::Stress stress;
  for (int t = 0; t < 3; ++t)
    for (int c = 0; c <= k; ++c)
      for (int b = 0; b <= k - c; ++b)
        stress.col(StressDegree<k>::third * t + ring_place(k, b, c)) =
            (Scalar(k - b - c) * at_vertices.col(t) +
             Scalar(b) * at_vertices.col(equilibrium_formulas::next(t)) + Scalar(c) * at_centroid) /
            Scalar(k);
  return stress;
}

}  // namespace airybench
