#include "solvers/preconditioners/drop_tolerance.hpp"

#include <cmath>
#include <memory>

#include "solvers/direct/skyline.hpp"

namespace airybench {

IncompleteFactor drop_tolerance_factor(const SparseColumns& lower, double tolerance,
                                       const Deadline& deadline) {
  constexpr int rows_per_part = 256;
  IncompleteFactor factor;
  factor.inverse_diagonal.reserve(static_cast<std::size_t>(lower.rows()));
  FactorRows growing;
  const auto store_part = [&] {
    FactorRows part = growing;  // copies have no spare capacity
    factor.parts.push_back(std::move(part));
    growing.first += rows_per_part;
    growing.start.assign(1, 0);
    growing.column.clear();
    growing.value.clear();
  };
  factor.flops = visit_ldlt_rows(
      lower,
      [&](int i, int j, const double* l, const double* d) {
        if (!(d[i - j] > 0))
          throw Breakdown("DTIC: pivot " + std::to_string(i + 1) + " of the full factor is " +
                          std::to_string(d[i - j]));
        for (int k = j; k < i; ++k) {
          const double value = l[k - j] * std::sqrt(d[k - j]);
          if (std::abs(value) < tolerance || value == 0) continue;
          growing.column.push_back(k);
          growing.value.push_back(value);
        }
        growing.start.push_back(static_cast<int>(growing.value.size()));
        factor.inverse_diagonal.push_back(1 / std::sqrt(d[i - j]));
        if (growing.start.size() == rows_per_part + 1) store_part();
      },
      deadline);
  if (growing.start.size() > 1) store_part();
  return factor;
}

static Preconditioner drop_tolerance_preconditioner(const SparseColumns& lower, double digits,
                                                    const Deadline& deadline) {
  const auto factor = std::make_shared<const IncompleteFactor>(
      drop_tolerance_factor(lower, std::pow(10.0, -digits), deadline));
  const auto applier = [factor](int) -> Apply {
    return [factor](LaneBlock& X) { solve_in_place(*factor, X); };
  };
  Preconditioner result;
  result.applier = applier;
  result.bytes = factor->bytes();
  result.entries = static_cast<std::int64_t>(factor->entries());
  result.flops = factor->flops;
  return result;
}

PreconditionerKind drop_tolerance_kind() {
  return {"DTIC", {"3", "4", "5", "6"}, "DTIC3..DTIC6", {}, drop_tolerance_preconditioner};
}

}  // namespace airybench
