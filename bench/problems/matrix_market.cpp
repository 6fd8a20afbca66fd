#include "bench/problems/matrix_market.hpp"

#include <fmt/format.h>

#include <iterator>
#include <type_traits>

namespace airybench {
namespace {

using Text = std::back_insert_iterator<std::string>;

template <typename Scalar>
void write_values(const Eigen::MatrixX<Scalar>& matrix, bool symmetric, Text out) {
  fmt::format_to(out, "{} {}\n", matrix.rows(), matrix.cols());
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = symmetric ? j : 0; i < matrix.rows(); ++i)
      fmt::format_to(out, "{}\n", matrix(i, j));
}

template <typename Visit>
void for_each_entry(const SparseRows& matrix, bool symmetric, Visit visit) {
  for (Eigen::Index i = 0; i < matrix.outerSize(); ++i)
    for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry)
      if (!symmetric || entry.col() <= entry.row()) visit(entry);
}

void write_values(const SparseRows& matrix, bool symmetric, Text out) {
  Eigen::Index count = 0;
  for_each_entry(matrix, symmetric, [&](const auto&) { ++count; });
  fmt::format_to(out, "{} {} {}\n", matrix.rows(), matrix.cols(), count);
  for_each_entry(matrix, symmetric, [&](const auto& entry) {
    fmt::format_to(out, "{} {} {}\n", entry.row() + 1, entry.col() + 1, entry.value());
  });
}

}  // namespace

std::string matrix_market_text(const ProblemArray& array) {
  const bool sparse = std::holds_alternative<SparseRows>(array.values);
  const bool whole_numbers = std::holds_alternative<Eigen::MatrixXi>(array.values);
  std::string text =
      fmt::format("%%MatrixMarket matrix {} {} {}\n% {}: {}\n% unit: {}\n",
                  sparse ? "coordinate" : "array", whole_numbers ? "integer" : "real",
                  array.symmetric ? "symmetric" : "general", array.name, array.about, array.unit);
  std::visit(
      [&](const auto& matrix) { write_values(matrix, array.symmetric, std::back_inserter(text)); },
      array.values);
  return text;
}

}  // namespace airybench
