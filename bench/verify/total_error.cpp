#include "bench/verify/total_error.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/problem/load_scale.hpp"

namespace airybench {

void TotalError::add(const ConstitutiveError& error, const std::string& step, Of answer) {
  if (flaw_.empty() && !error.flaw.empty()) flaw_ = step + error.flaw;
  const double norm = answer == Of::stresses ? error.stress_norm
                                             : std::max(error.stress_norm, error.displacement_norm);
  const double squared = error.squared_Nmm();
  of_step_.push_back({norm, error.flaw.empty() ? std::optional(error.relative) : std::nullopt,
                      squared > 0 ? error.relative * std::sqrt(error.geometry_Nmm / squared) : 0});
  largest_norm_ = std::max(largest_norm_, norm);
  parts_.resize(error.of_triangle_Nmm.size());
  if (!(squared > 0) || is_unloaded(steps() - 1)) return;
  const double scale = error.relative * error.relative / squared;
  for (std::size_t t = 0; t < parts_.size(); ++t) parts_[t] += scale * error.of_triangle_Nmm[t];
}

bool TotalError::is_unloaded(int step) const {
  constexpr double rounding = 1e-10;
  return steps() > 1 && of_step_[static_cast<std::size_t>(step)].norm < rounding * largest_norm_;
}

std::optional<double> TotalError::relative(int step) const {
  return is_unloaded(step) ? std::nullopt : of_step_[static_cast<std::size_t>(step)].relative;
}

std::optional<double> TotalError::relative() const {
  if (!flaw_.empty()) return {};
  std::optional<double> largest;
  for (int k = 0; k < steps(); ++k)
    if (const auto own = relative(k)) largest = largest ? larger_error(*largest, *own) : *own;
  return largest;
}

double TotalError::geometry() const {
  const std::optional<double> largest = relative();
  for (int k = 0; largest && k < steps(); ++k)
    if (relative(k) == largest) return of_step_[static_cast<std::size_t>(k)].geometry;
  return 0;
}

}  // namespace airybench
