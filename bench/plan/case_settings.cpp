#include "bench/plan/case_settings.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/base/method.hpp"

namespace airybench {

RunControl control_of(const CaseSettings& settings, const Deadline& deadline) {
  RunControl control;
  control.deadline = deadline;
  control.threads = settings.threads;
  control.stop = settings.stop;
  control.target_error = settings.target_error;
  control.tolerance = settings.tolerance.value_or(0);
  control.max_iterations = settings.max_iterations;
  ContactOptions& contact = control.contact;
  contact.solver = settings.contact.value_or(contact.solver);
  contact.tolerance = settings.contact_tolerance.value_or(contact.tolerance);
  contact.acceptable = std::max(contact.tolerance, settings.target_error / 1000);
  contact.max_iterations = settings.max_contact_iterations.value_or(contact.max_iterations);
  return control;
}

double first_tolerance(const Method& method, const CaseSettings& settings) {
  return settings.stop == Stop::paper
             ? method.paper_tolerance
             : std::max(tightest_tolerance, method.first_tolerance * settings.target_error);
}

double next_tolerance(double tolerance, const Solution& solution, const CaseSettings& settings) {
  // Errors are about proportional to the tolerance; 3 is a safety factor.
  const double factor = settings.target_error / solution.error_estimate.value_or(0) / 3;
  return std::max(tightest_tolerance,
                  tolerance * (std::isfinite(factor) ? std::clamp(factor, 1e-3, 0.3) : 0.1));
}

}  // namespace airybench
