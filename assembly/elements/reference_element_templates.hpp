// Definitions of ReferenceElement and reference_matrices(), to instantiate them for further
// scalars.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "assembly/elements/equilibrium_element.hpp"
#include "assembly/elements/hct_templates.hpp"

namespace airybench {
namespace reference_formulas {

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
        phi.fill(std::vector<Scalar>(bernstein_count(d), 0));
        phi[t][ring_place(d, b, c)] = 1;
        complete_spokes<Scalar>(phi, d);
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

// Components of the six flexibility matrices.
constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

}  // namespace reference_formulas

template <typename Scalar>
ReferenceElement<Scalar>::ReferenceElement(int k) {
  using namespace reference_formulas;
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
        forces.row(mode).template segment<2>(column) = traction_of<Scalar>(tau, normal).transpose();
      }
    }
  }
}

namespace reference_formulas {

// Entries of a ReferenceElement in Scalar, which is computed in Exact.
template <typename Scalar, typename Exact>
struct Rounded {
  explicit Rounded(const ReferenceElement<Exact>& element) {
    std::vector<std::pair<const Scalar**, std::size_t>> places;
    const auto put = [&](const Eigen::MatrixX<Exact>& matrix, const Scalar*& place) {
      places.emplace_back(&place, entries.size());
      for (Eigen::Index i = 0; i < matrix.size(); ++i)
        entries.push_back(static_cast<Scalar>(matrix.data()[i]));
    };
    for (int c = 0; c < 3; ++c) put(element.stress[c], matrices.stress[c]);
    put(element.mass_root, matrices.mass_root);
    for (int c = 0; c < 3; ++c) put(element.weighted[c], matrices.weighted[c]);
    for (int m = 0; m < 6; ++m) put(element.flexibility[m], matrices.flexibility[m]);
    put(element.forces, matrices.forces);
    for (const auto& [place, first] : places) *place = entries.data() + first;
  }
  std::vector<Scalar> entries;
  ReferenceMatrices<Scalar> matrices;
};

template <typename Scalar, typename Exact>
const ReferenceMatrices<Scalar>& rounded(int k) {
  return made_once(
             k, [](int degree) { return Rounded<Scalar, Exact>(ReferenceElement<Exact>(degree)); })
      .matrices;
}

}  // namespace reference_formulas

template <typename Scalar>
const ReferenceMatrices<Scalar>& reference_matrices(int k) {
  return reference_formulas::rounded<Scalar, Scalar>(k);
}

}  // namespace airybench
