#include "bench/verify/answer_hash.hpp"

#include <fmt/format.h>

#include <cmath>

#include "support/sha256.hpp"

namespace airybench {
namespace {

std::string digits(double value) { return value == 0 ? "0" : fmt::format("{:.4e}", value); }

// value / (|value| + |other|) in steps of 1e-5.
std::string share(double value, double other) {
  const double sum = std::abs(value) + std::abs(other);
  return fmt::format("{}", sum > 0 ? std::llround(value / sum * 1e5) : 0);
}

}  // namespace

std::string answer_hash(const Verification& v) {
  const double normal = v.normal_resultant_N.value_or(0);
  const double tangential = v.tangential_resultant_N.value_or(0);
  const double complementary = v.complementary_energy_Nmm.value_or(0);
  if (v.unstressed || !std::isfinite(v.strain_energy_Nmm + complementary + normal + tangential))
    return "";
  const std::string rounded =
      fmt::format("W {} N {} C {} T {}", digits(v.strain_energy_Nmm), digits(normal),
                  share(complementary, v.strain_energy_Nmm), share(tangential, normal));
  return sha256_hex(rounded).substr(0, 16);
}

}  // namespace airybench
