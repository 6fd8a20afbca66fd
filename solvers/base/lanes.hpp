// Several right-hand sides side by side: a row-major n × lanes block. A sparse matrix is then read
// once for all lanes, and the inner loops run over neighbouring numbers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace airybench {

using LaneBlock = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline constexpr int max_lanes = 16;
using LaneScalars = std::array<double, max_lanes>;  // one per lane; those beyond are not used

// Calls f with the number of lanes as a compile-time constant: 1 or max_lanes; throws
// std::invalid_argument for any other.
template <typename F>
void with_lanes(Eigen::Index lanes, F f) {
  if (lanes == 1)
    f(std::integral_constant<int, 1>());
  else if (lanes == max_lanes)
    f(std::integral_constant<int, max_lanes>());
  else
    throw std::invalid_argument("a block of " + std::to_string(lanes) + " lanes (allowed: 1, " +
                                std::to_string(max_lanes) + ")");
}

// y_l += a_l x_l.
template <int lanes>
void axpy(Eigen::Index n, const LaneScalars& a, const double* x, double* y) {
  for (Eigen::Index i = 0; i < n; ++i)
    for (int l = 0; l < lanes; ++l) y[i * lanes + l] += a[l] * x[i * lanes + l];
}

// y_l ← x_l + a_l y_l.
template <int lanes>
void xpay(Eigen::Index n, const double* x, const LaneScalars& a, double* y) {
  for (Eigen::Index i = 0; i < n; ++i)
    for (int l = 0; l < lanes; ++l) y[i * lanes + l] = x[i * lanes + l] + a[l] * y[i * lanes + l];
}

template <int lanes>
LaneScalars dot(Eigen::Index n, const double* x, const double* y) {
  double sum[lanes] = {};
  for (Eigen::Index i = 0; i < n; ++i)
    for (int l = 0; l < lanes; ++l) sum[l] += x[i * lanes + l] * y[i * lanes + l];
  LaneScalars result{};
  for (int l = 0; l < lanes; ++l) result[l] = sum[l];
  return result;
}

}  // namespace airybench
