#include "verify/total_error.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/problem/load_scale.hpp"

namespace airybench {

static constexpr double rounding = 1e-10;  // of the largest norm of all steps

void TotalError::add(const ConstitutiveError& error, const std::string& step, Of answer) {
  if (flaw_.empty() && !error.flaw.empty()) flaw_ = step + error.flaw;
  const double norm = answer == Of::stresses ? error.stress_norm
                                             : std::max(error.stress_norm, error.displacement_norm);
  const double squared = error.squared_Nmm();
  of_step_.push_back({norm, error.flaw.empty() ? std::optional(error.relative) : std::nullopt,
                      squared > 0 ? error.relative * std::sqrt(error.geometry_Nmm / squared) : 0});
  const bool is_first_loaded = largest_norm_ < rounding * norm;
  largest_norm_ = std::max(largest_norm_, norm);
  sliding_.include(error.sliding);
  parts_.resize(error.of_triangle_Nmm.size());
  of_chords_.resize(parts_.size());
  if (is_first_loaded)  // what was added so far is relative to rounding
    for (std::vector<double>* parts : {&parts_, &of_chords_}) std::ranges::fill(*parts, 0);
  if (!(squared > 0) || is_unloaded(steps() - 1)) return;
  const double scale = error.relative * error.relative / squared;
  for (std::size_t t = 0; t < parts_.size(); ++t) parts_[t] += scale * error.of_triangle_Nmm[t];
  for (std::size_t t = 0; t < error.of_chords_Nmm.size(); ++t)
    of_chords_[t] += scale * error.of_chords_Nmm[t];
}

bool TotalError::is_unloaded(int step) const {
  return steps() > 1 && of_step_[static_cast<std::size_t>(step)].norm < rounding * largest_norm_;
}

std::optional<double> TotalError::of_mesh(int step) const {
  return is_unloaded(step) ? std::nullopt : of_step_[static_cast<std::size_t>(step)].relative;
}

template <typename OfStep>
std::optional<double> TotalError::largest(const OfStep& of_step) const {
  if (!flaw_.empty()) return {};
  std::optional<double> largest;
  for (int k = 0; k < steps(); ++k)
    if (const std::optional<double> error = of_step(k))
      largest = largest ? larger_error(*largest, *error) : *error;
  return largest;
}

std::optional<double> TotalError::of_mesh() const {
  return largest([&](int step) { return of_mesh(step); });
}

std::optional<double> TotalError::relative() const {
  return largest([&](int step) {
    std::optional<double> error = of_mesh(step);
    if (const auto k = static_cast<std::size_t>(step); error && k < of_method_.size())
      *error += of_method_[k];
    return error;
  });
}

std::optional<int> TotalError::largest_step() const {
  const std::optional<double> largest = of_mesh();
  for (int k = 0; largest && k < steps(); ++k)
    if (const auto error = of_mesh(k); error && (*error == *largest || std::isnan(*error)))
      return k;
  return {};
}

double TotalError::geometry() const {
  const std::optional<int> step = largest_step();
  return step ? of_step_[static_cast<std::size_t>(*step)].geometry : 0;
}

}  // namespace airybench
