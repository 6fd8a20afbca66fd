#include "solvers/preconditioners/preconditioner.hpp"

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "solvers/preconditioners/drop_tolerance.hpp"
#include "solvers/preconditioners/exact.hpp"
#include "solvers/preconditioners/fill_level.hpp"
#include "solvers/preconditioners/identity.hpp"
#include "solvers/preconditioners/ssor.hpp"

namespace airybench {
namespace {

// The number that follows `prefix`, if that is all of the name.
std::optional<double> number_after(std::string_view prefix, std::string_view name) {
  if (!name.starts_with(prefix)) return {};
  double value = 0;
  const char *const begin = name.data() + prefix.size(), *const end = name.data() + name.size();
  const auto [stopped, error] = std::from_chars(begin, end, value, std::chars_format::fixed);
  if (error != std::errc() || stopped != end || begin == end) return {};
  return value;
}

bool is_whole_within(std::optional<double> value, int least, int most) {
  return value && *value == std::floor(*value) && *value >= least && *value <= most;
}

}  // namespace

MakePreconditioner preconditioner_named(std::string_view name) {
  if (name == "NONE") return identity_preconditioner;
  if (name == "SKY") return exact_preconditioner;
  if (const auto x = number_after("DTIC", name); is_whole_within(x, 3, 6))
    return [tolerance = std::pow(10.0, -*x)](const SparseColumns& lower, const Deadline& deadline) {
      return drop_tolerance_preconditioner(lower, tolerance, deadline);
    };
  if (const auto level = number_after("FLIC", name); is_whole_within(level, 1, 5))
    return
        [level = static_cast<int>(*level)](const SparseColumns& lower, const Deadline& deadline) {
          return fill_level_preconditioner(lower, level, deadline);
        };
  if (const auto omega = number_after("SSOR", name); omega && *omega > 0 && *omega < 2)
    return [omega = *omega](const SparseColumns& lower, const Deadline&) {
      return ssor_preconditioner(lower, omega);
    };
  throw std::invalid_argument("'" + std::string(name) +
                              "' is no preconditioner (valid: DTIC3..DTIC6, FLIC1..FLIC5, SSOR "
                              "followed by a number above 0 and below 2, SKY, NONE)");
}

const std::vector<std::string>& preconditioner_names() {
  static const std::vector<std::string> names = {
      "DTIC3",   "DTIC4",    "DTIC5",   "DTIC6",    "FLIC1",   "FLIC2",
      "FLIC3",   "FLIC4",    "FLIC5",   "SSOR0.25", "SSOR0.5", "SSOR0.75",
      "SSOR1.0", "SSOR1.25", "SSOR1.5", "SSOR1.75", "SKY",     "NONE"};
  return names;
}

}  // namespace airybench
