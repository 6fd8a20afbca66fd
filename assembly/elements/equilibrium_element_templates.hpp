// Definitions of equilibrium_element.hpp, to instantiate them for further scalars.
#pragma once

#include <cmath>

#include "assembly/elements/equilibrium_element.hpp"

namespace airybench {
namespace equilibrium_formulas {

// W times the n coefficients of each third, as columns xx, yy, xy: their scalar products are
// integrals.
template <typename Scalar>
void to_orthonormal(const Constant<Scalar>* W, int n, const Scalar* stress, Scalar* result) {
  for (int t = 0; t < 3; ++t, stress += 3 * n)
    for (int i = 0; i < n; ++i, result += 3) {
      for (int a = 0; a < 3; ++a) result[a] = 0;
      for (int j = i; j < n; ++j)
        for (int a = 0; a < 3; ++a) result[a] += W[n * j + i] * stress[3 * j + a];
    }
}

}  // namespace equilibrium_formulas

template <typename Scalar, int k>
EquilibriumElement<Scalar, k>::EquilibriumElement(const TriangleVerticesFor<Scalar>& vertices,
                                                  const Eigen::Matrix3<Data<Scalar>>& compliance,
                                                  Factor factor)
    : reference_(reference_matrices<Constant<Scalar>>(k)),
      compliance_(compliance.template cast<Scalar>()) {
  for (int x = 0; x < 2; ++x)
    for (int i = 0; i < 2; ++i) B_(x, i) = Scalar(vertices(x, i + 1)) - Scalar(vertices(x, 0));
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
  const auto& L = of_compliance.L();
  const Scalar pivots = L(0, 0) * L(1, 1) * L(2, 2);
  const Scalar determinant = pivots * pivots * determinant_ * determinant_ * determinant_;
  const Scalar minors = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1) + c(0, 0) * c(2, 2) -
                        c(0, 2) * c(0, 2) + c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
  const Scalar trace = c(0, 0) + c(1, 1) + c(2, 2);
  const auto well_conditioned = trace * minors < Scalar(5000) * determinant;
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
    for (int c = 0; c < 3; ++c) weighted[c] = reference_.weighted[c] + rows * mode;
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
    for (int m = 0; m < 6; ++m) M[m] = reference_.flexibility[m] + Degree::modes * j;
    for (int i = j; i < Degree::modes; ++i)  // its lower triangle is read
      S(i, j) = c(0, 0) * M[0][i] + c(1, 1) * M[1][i] + c(2, 2) * M[2][i] + c(0, 1) * M[3][i] +
                c(0, 2) * M[4][i] + c(1, 2) * M[5][i];
  }
  flexibility_ = SmallCholesky<Scalar, Degree::modes>(S);
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Root EquilibriumElement<Scalar, k>::root() const {
  Root R;  // Tᵀ = T̂ᵀ (I ⊗ Bᵀ). The inner modes' rows are zero and stay so under L⁻¹.
  const Constant<Scalar>* forces = reference_.forces;
  for (int j = 0; j < Degree::size; j += 2, forces += 2 * Degree::outer)
    for (int i = 0; i < Degree::outer; ++i)
      for (int x = 0; x < 2; ++x)
        R(i, j + x) = forces[i] * B_(x, 0) + forces[Degree::outer + i] * B_(x, 1);
  constexpr int first = Degree::inner;
  for (int i = 0; i < Degree::outer; ++i) {
    const auto factor = [&](int j) { return -flexibility_.L()(first + i, first + j); };
    add_multiples(&R(i, 0), Degree::size, i, factor, &R(0, 0), Degree::size);
    for (int j = 0; j < Degree::size; ++j) R(i, j) *= flexibility_.reciprocal()(first + i);
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

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Modes EquilibriumElement<Scalar, k>::modes_load(
    const Stress& particular) const {
  constexpr int n = Degree::coefficients;
  const Eigen::Matrix3<Scalar> dual =
      (to_stress_.transpose() * determinant_).lazyProduct(compliance_);
  Scalar orthonormal[3 * n], columns[3 * n], strain[3][n];
  equilibrium_formulas::to_orthonormal(reference_.mass_root, Degree::third, particular.data(),
                                       orthonormal);
  transform_columns(dual, orthonormal, n, columns);
  for (int i = 0; i < n; ++i)
    for (int a = 0; a < 3; ++a) strain[a][i] = columns[3 * i + a];
  Modes load;
  for (int mode = 0; mode < Degree::modes; ++mode) {
    load[mode] = 0;
    for (int a = 0; a < 3; ++a)
      load[mode] += in_four_sums(reference_.weighted[a] + n * mode, strain[a], 0, n);
  }
  return load;
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::OnEdges EquilibriumElement<Scalar, k>::load(
    const Stress& particular) const {
  OnEdges f = edge_forces(particular);
  subtract_outer_load(root(), particular, f.data());
  return f;
}

template <typename Scalar, int k>
void EquilibriumElement<Scalar, k>::subtract_outer_load(const Root& R, const Stress& particular,
                                                        Scalar* forces) const {
  Modes y = modes_load(particular);
  flexibility_.solve_lower(y.data());
  add_multiples(
      forces, Degree::size, Degree::outer, [&](int m) { return -y[Degree::inner + m]; }, &R(0, 0),
      Degree::size);
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Modes EquilibriumElement<Scalar, k>::work_of(
    const OnEdges& displacement) const {
  const Scalar* u = displacement.data();
  Scalar in_reference[Degree::size];
  for (int j = 0; j < Degree::size; j += 2)
    for (int i = 0; i < 2; ++i) in_reference[j + i] = B_(0, i) * u[j] + B_(1, i) * u[j + 1];
  Modes work;
  for (Scalar& of_mode : work) of_mode = 0;
  add_multiples(
      &work[Degree::inner], Degree::outer, Degree::size, [&](int j) { return in_reference[j]; },
      reference_.forces, Degree::outer);
  return work;
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Modes EquilibriumElement<Scalar, k>::excess_work(
    const OnEdges& displacement, const Stress& stress) const {
  Modes work = work_of(displacement);
  const Modes known = modes_load(stress);
  for (int m = 0; m < Degree::modes; ++m) work[m] -= known[m];
  return work;
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Stress EquilibriumElement<Scalar, k>::stress(
    const OnEdges& displacement, const Stress& particular) const {
  Stress total = of_modes(excess_work(displacement, particular));
  for (int i = 0; i < 3 * Degree::coefficients; ++i) total.data()[i] += particular.data()[i];
  return total;
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Defect EquilibriumElement<Scalar, k>::defect(
    const OnEdges& displacement, const Stress& total) const {
  const Modes g = excess_work(displacement, total);
  Modes correction = g;
  flexibility_.solve(correction.data());
  Defect result;
  result.energy = in_four_sums(g.data(), correction.data(), 0, Degree::modes);
  Scalar force[Degree::size];  // in x̂
  for (int j = 0; j < Degree::size; ++j)
    force[j] = in_four_sums(reference_.forces + Degree::outer * j, &correction[Degree::inner], 0,
                            Degree::outer);
  for (int j = 0; j < Degree::size; j += 2)
    for (int x = 0; x < 2; ++x)
      result.forces(j + x) = B_(x, 0) * force[j] + B_(x, 1) * force[j + 1];
  return result;
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Stress EquilibriumElement<Scalar, k>::of_modes(
    Modes work) const {
  constexpr int n = Degree::coefficients;
  flexibility_.solve(work.data());
  Scalar tau[3][n], columns[3 * n];
  for (int a = 0; a < 3; ++a) {
    for (Scalar& coefficient : tau[a]) coefficient = 0;
    add_multiples(
        tau[a], n, Degree::modes, [&](int m) { return work[m]; }, reference_.stress[a], n);
    for (int i = 0; i < n; ++i) columns[3 * i + a] = tau[a][i];
  }
  Stress stress;
  transform_columns(to_stress_, columns, n, stress.data());
  return stress;
}

template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::OnEdges EquilibriumElement<Scalar, k>::edge_forces(
    const Stress& stress) const {
  Scalar edge[3][2];
  for (int x = 0; x < 2; ++x) {
    edge[0][x] = B_(x, 0);
    edge[1][x] = B_(x, 1) - B_(x, 0);
    edge[2][x] = -B_(x, 1);
  }
  OnEdges forces;
  Scalar* force = forces.data();
  for (int t = 0; t < 3; ++t) {
    const Scalar n_x = edge[t][1] / Scalar(k + 1), n_y = -edge[t][0] / Scalar(k + 1);
    for (int j = 0; j <= k; ++j, force += 2) {
      const Scalar* s = &stress(0, Degree::third * t + j);
      force[0] = s[0] * n_x + s[2] * n_y;
      force[1] = s[2] * n_x + s[1] * n_y;
    }
  }
  return forces;
}

template <typename Scalar, int k>
Scalar EquilibriumElement<Scalar, k>::energy(const Stress& sigma, const Stress& tau) const {
  constexpr int n = 3 * Degree::coefficients;
  Scalar first[n], second[n], strain[n];
  equilibrium_formulas::to_orthonormal(reference_.mass_root, Degree::third, sigma.data(), first);
  equilibrium_formulas::to_orthonormal(reference_.mass_root, Degree::third, tau.data(), second);
  transform_columns(compliance_, first, Degree::coefficients, strain);
  return determinant_ * in_four_sums(strain, second, 0, n);
}

template <int k, typename Scalar>
typename EquilibriumElement<Scalar, k>::Stress linear_stress(
    const Eigen::Matrix3<Scalar>& at_vertices) {
  // A linear function's Bernstein coefficients are its values at the domain points.
  typename EquilibriumElement<Scalar, k>::Stress stress;
  for (int a = 0; a < 3; ++a) {
    const Scalar at_centroid =
        (at_vertices(a, 0) + at_vertices(a, 1) + at_vertices(a, 2)) / Scalar(3);
    for (int t = 0; t < 3; ++t)
      for (int c = 0; c <= k; ++c)
        for (int b = 0; b <= k - c; ++b)
          stress(a, StressDegree<k>::third * t + ring_place(k, b, c)) =
              (Scalar(k - b - c) * at_vertices(a, t) + Scalar(b) * at_vertices(a, (t + 1) % 3) +
               Scalar(c) * at_centroid) /
              Scalar(k);
  }
  return stress;
}

}  // namespace airybench
