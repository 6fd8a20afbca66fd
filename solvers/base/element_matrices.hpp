// A symmetric matrix as the sum of its elements' matrices, never put together:
//
//   K = Σ_e P_eᵀ K_e P_e,   K_e of the size that all share; P_e picks the element's unknowns, and
//                           drops prescribed ones
//
// This is what a multifrontal factorisation reads (multifrontal.hpp), and products need no more.
// Where the elements are helps to order the unknowns (dissection.hpp).
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "solvers/base/equal_rows.hpp"
#include "solvers/base/index_lists.hpp"

namespace airybench {

// Of a triangle's corners, in its columns.
inline std::array<double, 2> centre_of(const Eigen::Matrix<double, 2, 3>& corners) {
  return {corners.row(0).mean(), corners.row(1).mean()};
}

// A symmetric 12×12 matrix from its lower triangle, by columns.
template <typename Scalar>
Eigen::Matrix<Scalar, 12, 12> from_lower(const Scalar* entry) {
  Eigen::Matrix<Scalar, 12, 12> whole;
  for (int j = 0; j < 12; ++j)
    for (int i = j; i < 12; ++i) whole(i, j) = whole(j, i) = *entry++;
  return whole;
}

// The same of any size.
template <typename Scalar>
Eigen::MatrixX<Scalar> from_lower(const Scalar* entry, int size) {
  Eigen::MatrixX<Scalar> whole(size, size);
  for (int j = 0; j < size; ++j)
    for (int i = j; i < size; ++i) whole(i, j) = whole(j, i) = *entry++;
  return whole;
}

template <typename Scalar>
class ElementMatricesIn {
 public:
  using Point = std::array<double, 2>;
  // Of twelve unknowns, most elements' size.
  using Unknowns = std::array<int, 12>;
  using Matrix = Eigen::Matrix<Scalar, 12, 12>;

  ElementMatricesIn() : ElementMatricesIn(12) {}
  explicit ElementMatricesIn(int of_size)
      : size(of_size), unknown(of_size), lower(of_size * (of_size + 1) / 2) {}

  int size;                   // of K_e
  int order = 0;              // of K
  EqualRows<int> unknown;     // per element; negative: prescribed
  std::vector<Point> centre;  // per element, mm
  EqualRows<Scalar> lower;    // K_e's lower triangle, by columns

  int count() const { return static_cast<int>(centre.size()); }
  std::size_t bytes() const {
    return unknown.bytes() + centre.size() * sizeof(Point) + lower.bytes();
  }
  void reserve(std::size_t elements) {
    unknown.reserve(elements);
    centre.reserve(elements);
    lower.reserve(elements);
  }
  // K_e's lower triangle, by columns.
  void add(std::span<const int> of_element, const Point& at, const Scalar* of_lower) {
    unknown.push_back(of_element.data());
    centre.push_back(at);
    lower.push_back(of_lower);
  }
  // K_e: its lower triangle is read.
  void add(std::span<const int> of_element, const Point& at,
           const Eigen::Ref<const Eigen::MatrixX<Scalar>>& K_e) {
    unknown.push_back(of_element.data());
    centre.push_back(at);
    for (int j = 0; j < size; ++j)
      for (int i = j; i < size; ++i) lower.entries().push_back(K_e(i, j));
  }
  // An unknown by itself.
  void add_diagonal(int of, const Point& at, Scalar stiffness) {
    std::vector<int> alone(static_cast<std::size_t>(size), -1);
    std::vector<Scalar> of_lower(static_cast<std::size_t>(lower.length()), Scalar(0));
    alone.front() = of;
    of_lower.front() = stiffness;
    add(alone, at, of_lower.data());
  }
  // y = K_e x.
  void multiply(int e, const Scalar* x, Scalar* y) const {
    if (size == 12)
      multiply_of<12>(lower[e].data(), x, y, 12);
    else
      multiply_of<Eigen::Dynamic>(lower[e].data(), x, y, size);
  }
  Eigen::Matrix<Scalar, 12, 1> product(int e, const Eigen::Matrix<Scalar, 12, 1>& x) const {
    Eigen::Matrix<Scalar, 12, 1> y;
    multiply_of<12>(lower[e].data(), x.data(), y.data(), 12);
    return y;
  }

 private:
  template <int fixed>
  static void multiply_of(const Scalar* entry, const Scalar* x, Scalar* y, int n) {
    if constexpr (fixed != Eigen::Dynamic) n = fixed;
    std::fill_n(y, n, Scalar(0));
    for (int j = 0; j < n; ++j) {
      y[j] += *entry++ * x[j];
      for (int i = j + 1; i < n; ++i, ++entry) {
        y[i] += *entry * x[j];
        y[j] += *entry * x[i];
      }
    }
  }
};
using ElementMatrices = ElementMatricesIn<double>;

// y += K x.
template <typename Scalar>
void add_product(const ElementMatricesIn<Scalar>& K, const Eigen::VectorX<Scalar>& x,
                 Eigen::VectorX<Scalar>& y) {
  std::vector<Scalar> from(static_cast<std::size_t>(K.size)), to(from);
  for (int e = 0; e < K.count(); ++e) {
    const std::span<const int> unknown = K.unknown[e];
    for (int i = 0; i < K.size; ++i) from[i] = unknown[i] < 0 ? Scalar(0) : x(unknown[i]);
    K.multiply(e, from.data(), to.data());
    for (int i = 0; i < K.size; ++i)
      if (unknown[i] >= 0) y(unknown[i]) += to[i];
  }
}

// Put together after all: the lower triangle.
template <typename Scalar>
Eigen::SparseMatrix<Scalar> lower_triangle(const ElementMatricesIn<Scalar>& K) {
  const int size = K.size;
  // Columns size e + j of the elements, by unknown.
  const IndexLists columns = gather_lists(K.order, [&](auto add) {
    for (int e = 0; e < K.count(); ++e)
      for (int j = 0; j < size; ++j)
        if (const int u = K.unknown[e][j]; u >= 0) add(u, size * e + j);
  });
  // Calls visit(row, element, i, j) for the entries that a column of K sums.
  const auto visit_column = [&](int column, auto visit) {
    for (const int of_element : columns[column]) {
      const int e = of_element / size, j = of_element % size;
      for (int i = 0; i < size; ++i)
        if (const int row = K.unknown[e][i]; row >= column) visit(row, e, i, j);
    }
  };
  std::vector<int> met(static_cast<std::size_t>(K.order), -1);  // in which column last
  Eigen::Index entries = 0;
  for (int column = 0; column < K.order; ++column)
    visit_column(column, [&](int row, int, int, int) {
      entries += met[row] != column;
      met[row] = column;
    });
  Eigen::SparseMatrix<Scalar> lower(K.order, K.order);
  lower.reserve(entries);
  met.assign(met.size(), -1);
  const auto place = [size](int i, int j) { return j * size - j * (j - 1) / 2 + i - j; };
  std::vector<Scalar> sum(static_cast<std::size_t>(K.order), 0);  // zero between columns
  std::vector<int> rows;
  for (int column = 0; column < K.order; ++column) {
    rows.clear();
    visit_column(column, [&](int row, int e, int i, int j) {
      if (met[row] != column) rows.push_back(row);
      met[row] = column;
      sum[row] += K.lower[e][place(std::max(i, j), std::min(i, j))];
    });
    std::sort(rows.begin(), rows.end());
    lower.startVec(column);
    for (const int row : rows) lower.insertBack(row, column) = std::exchange(sum[row], Scalar(0));
  }
  lower.finalize();
  return lower;
}

// The same with entries of another scalar, rounded.
template <typename To, typename From>
ElementMatricesIn<To> rounded(const ElementMatricesIn<From>& K) {
  ElementMatricesIn<To> result(K.size);
  result.order = K.order;
  result.unknown = K.unknown;
  result.centre = K.centre;
  result.lower.entries().reserve(K.lower.entries().size());
  for (const From& entry : K.lower.entries())
    result.lower.entries().push_back(static_cast<To>(entry));
  return result;
}

}  // namespace airybench
