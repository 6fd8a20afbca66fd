#include "bench/records/method_names.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "solvers/methods.hpp"

namespace airybench {

std::string general_name(const std::string& method) {
  for (const Method& known : methods())
    if (known.name == method && !known.general_name.empty()) return known.general_name;
  const std::size_t omega = method.find(":SSOR");
  if (omega == method.npos) return method;
  const char* const start = method.c_str() + omega + 5;
  char* end = nullptr;
  const double value = std::strtod(start, &end);
  return end == start ? method : fmt::format("{}:SSOR{}{}", method.substr(0, omega), value, end);
}

std::string family_of(const std::string& general_name) {
  return general_name.substr(0, general_name.find(':'));
}

bool is_direct(const std::string& general_name) {
  const std::string family = family_of(general_name);
  return family == "3STEPD" || family == "BLIND" || family == "HYBRID" || family == "P2";
}

}  // namespace airybench
