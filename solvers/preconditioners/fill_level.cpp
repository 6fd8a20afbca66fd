#include "solvers/preconditioners/fill_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <queue>

namespace airybench {
namespace {

// The pattern of L, strictly lower, by rows.
FactorRows symbolic(const SparseRows& lower, int most, const Deadline& deadline) {
  struct Entry {
    int row, level;
  };
  const int n = static_cast<int>(lower.rows());
  constexpr int absent = std::numeric_limits<int>::max();
  std::vector<std::vector<Entry>> column(static_cast<std::size_t>(n));  // of the rows so far
  std::vector<int> level(static_cast<std::size_t>(n), absent);
  std::priority_queue<int, std::vector<int>, std::greater<>> waiting;  // columns of row i
  FactorRows pattern;
  for (int i = 0; i < n; ++i) {
    for (SparseRows::InnerIterator entry(lower, i); entry && entry.col() < i; ++entry) {
      level[entry.col()] = 0;
      waiting.push(static_cast<int>(entry.col()));
    }
    while (!waiting.empty()) {
      const int k = waiting.top();
      waiting.pop();
      for (const Entry& other : column[k]) {  // rows between k and i
        const int fill = level[k] + other.level + 1;
        if (fill > most || fill >= level[other.row]) continue;
        if (level[other.row] == absent) waiting.push(other.row);
        level[other.row] = fill;
      }
      pattern.column.push_back(k);
    }
    for (std::size_t e = pattern.start.back(); e < pattern.column.size(); ++e) {
      const int k = pattern.column[e];
      column[k].push_back({i, level[k]});
      level[k] = absent;
    }
    pattern.start.push_back(static_cast<int>(pattern.column.size()));
    if (i % 1024 == 0) deadline.check("the symbolic factorisation by level of fill");
  }
  pattern.column.shrink_to_fit();
  return pattern;
}

// The values of L for S + shift · diag(S); false at a pivot that is too small.
bool numeric(const SparseRows& lower, double shift, IncompleteFactor& factor,
             std::vector<double>& row, const Deadline& deadline) {
  constexpr double smallest_pivot = 1e-10;  // of an equilibrated matrix
  FactorRows& L = factor.parts.front();
  factor.flops = 0;
  for (int i = 0; i < static_cast<int>(lower.rows()); ++i) {
    if (i % 1024 == 0) deadline.check("the factorisation by level of fill");
    double pivot = 0;
    for (SparseRows::InnerIterator entry(lower, i); entry; ++entry) {
      if (entry.col() < i)
        row[entry.col()] = entry.value();
      else
        pivot = (1 + shift) * entry.value();
    }
    for (int e = L.start[i]; e < L.start[i + 1]; ++e) {
      const int j = L.column[e];
      double value = row[j];
      for (int f = L.start[j]; f < L.start[j + 1]; ++f) value -= L.value[f] * row[L.column[f]];
      factor.flops += 2 * (L.start[j + 1] - L.start[j]) + 3;
      row[j] = L.value[e] = value * factor.inverse_diagonal[j];
      pivot -= row[j] * row[j];
    }
    for (int e = L.start[i]; e < L.start[i + 1]; ++e) row[L.column[e]] = 0;
    if (!(pivot > smallest_pivot)) return false;
    factor.inverse_diagonal[i] = 1 / std::sqrt(pivot);
  }
  return true;
}

}  // namespace

FillLevelFactor fill_level_factor(const SparseColumns& lower, int level, const Deadline& deadline) {
  constexpr double first_shift = 1e-4;
  const SparseRows rows = lower;
  const auto n = static_cast<std::size_t>(lower.rows());
  FillLevelFactor result;
  IncompleteFactor& factor = result.factor;
  factor.parts.push_back(symbolic(rows, level, deadline));
  factor.parts.front().value.resize(factor.parts.front().column.size());
  factor.inverse_diagonal.resize(n);
  std::vector<double> row(n, 0.0);
  while (!numeric(rows, result.shift, factor, row, deadline)) {
    result.shift = result.shift == 0 ? first_shift : 2 * result.shift;
    if (result.shift > 1)
      throw Breakdown("FLIC" + std::to_string(level) +
                      ": a pivot is not positive, with any shift of the diagonal up to 1");
  }
  return result;
}

Preconditioner fill_level_preconditioner(const SparseColumns& lower, double level,
                                         const Deadline& deadline) {
  const auto made = std::make_shared<const FillLevelFactor>(
      fill_level_factor(lower, static_cast<int>(level), deadline));
  const auto applier = [made](int) -> Apply {
    return [made](LaneBlock& X) { solve_in_place(made->factor, X); };
  };
  Preconditioner result;
  result.applier = applier;
  result.bytes = made->factor.bytes();
  result.entries = static_cast<std::int64_t>(made->factor.entries());
  result.flops = made->factor.flops;
  result.shift = made->shift;
  return result;
}

PreconditionerKind fill_level_kind() {
  return {"FLIC", {"1", "2", "3", "4", "5"}, "FLIC1..FLIC5", {}, fill_level_preconditioner};
}

}  // namespace airybench
