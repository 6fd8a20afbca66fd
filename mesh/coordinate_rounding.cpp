#include "mesh/coordinate_rounding.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace airybench {
namespace {

int digits_of(double x) {
  constexpr int shown = 12;
  std::array<char, 32> buffer;  // "1.23000000000e+02"
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(x),
                                 std::chars_format::scientific, shown - 1)
                       .ptr;
  const std::string_view text(buffer.data(), end);
  const auto last = text.substr(0, text.find('e')).find_last_not_of("0.");
  return last == text.npos ? 0 : std::max(1, static_cast<int>(last));
}

bool is_single(double x) {
  constexpr double rounding = 1e-13;  // of a division by the unit
  return std::abs(static_cast<double>(static_cast<float>(x)) - x) <= rounding * std::abs(x);
}

}  // namespace

void CoordinateRounding::add(double coordinate) {
  largest_ = std::max(largest_, std::abs(coordinate));
  digits_ = std::max(digits_, digits_of(coordinate));
  are_single_ = are_single_ && is_single(coordinate);
}

std::optional<double> CoordinateRounding::unit() const {
  constexpr int fewest = 6, most = 10;
  if (digits_ < fewest) return 0;
  if (digits_ <= most) return std::pow(10, std::floor(std::log10(largest_)) + 1 - digits_);
  if (are_single_) return largest_ * 0x1p-23;
  return {};
}

double rounding_of_points(const std::vector<Eigen::Vector2d>& points_mm, double mm_per_unit) {
  constexpr double of_double = 1e-12;  // of the largest coordinate
  CoordinateRounding positive, negative;
  double largest = 0;
  for (const Eigen::Vector2d& point : points_mm)
    for (const double coordinate : point) {
      largest = std::max(largest, std::abs(coordinate));
      (coordinate < 0 ? negative : positive).add(coordinate / mm_per_unit);
    }
  const double unit =
      mm_per_unit * std::max(positive.unit().value_or(0), negative.unit().value_or(0));
  return std::max(of_double * largest, 1.5 * unit);  // √2/2 of the point, √2/2 of the curve
}

}  // namespace airybench
