#include "solvers/preconditioners/ssor.hpp"

#include <memory>

namespace airybench {
namespace {

// The first entry of every column of `lower` is its diagonal.
template <int lanes>
void apply(const SparseColumns& lower, double omega, double* x) {
  const int* const start = lower.outerIndexPtr();
  const int* const row = lower.innerIndexPtr();
  const double* const value = lower.valuePtr();
  const double scale = omega * (2 - omega);
  double own[lanes];
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {  // y ← ω(2−ω) D (D + ωL)⁻¹ x
    const double diagonal = value[start[j]];
    for (int l = 0; l < lanes; ++l) own[l] = x[j * lanes + l] / diagonal;
    for (int e = start[j] + 1; e < start[j + 1]; ++e) {
      double* const other = x + std::ptrdiff_t{row[e]} * lanes;
      for (int l = 0; l < lanes; ++l) other[l] -= omega * value[e] * own[l];
    }
    for (int l = 0; l < lanes; ++l) x[j * lanes + l] = scale * diagonal * own[l];
  }
  for (Eigen::Index j = lower.cols() - 1; j >= 0; --j) {  // (D + ωLᵀ)⁻¹ y
    for (int l = 0; l < lanes; ++l) own[l] = x[j * lanes + l];
    for (int e = start[j] + 1; e < start[j + 1]; ++e) {
      const double* const other = x + std::ptrdiff_t{row[e]} * lanes;
      for (int l = 0; l < lanes; ++l) own[l] -= omega * value[e] * other[l];
    }
    for (int l = 0; l < lanes; ++l) x[j * lanes + l] = own[l] / value[start[j]];
  }
}

}  // namespace

Preconditioner ssor_preconditioner(const SparseColumns& lower, double omega, const Deadline&) {
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    const int first = lower.outerIndexPtr()[j];
    if (lower.outerIndexPtr()[j + 1] == first || lower.innerIndexPtr()[first] != j ||
        !(lower.valuePtr()[first] > 0))
      throw Breakdown("SSOR: diagonal entry " + std::to_string(j + 1) + " is not positive");
  }
  const auto applier = [&lower, omega](int) -> Apply {
    return [&lower, omega](LaneBlock& X) {
      with_lanes(X.cols(), [&](auto lanes) { apply<lanes>(lower, omega, X.data()); });
    };
  };
  Preconditioner result;
  result.applier = applier;
  return result;
}

PreconditionerKind ssor_kind() {
  return {"SSOR",
          {"0.25", "0.5", "0.75", "1.0", "1.25", "1.5", "1.75"},
          "SSOR followed by a number above 0 and below 2",
          [](double omega) { return omega > 0 && omega < 2; },
          ssor_preconditioner};
}

}  // namespace airybench
