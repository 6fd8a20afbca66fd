// What airybench found for problems with known answers: tests/data/validation/profiles.csv.
#pragma once

#include <fmt/format.h>

#include <string>

#include "tests/bench/studies/expected_table.hpp"
#include "tests/support/places.hpp"
#include "tests/validation/edge_tractions.hpp"

namespace airybench::testing {

inline ExpectedTable& committed_profiles() {
  static auto* const own = static_cast<ExpectedTable*>(::testing::AddGlobalTestEnvironment(
      new ExpectedTable(test_data("validation/profiles.csv"), 4)));
  return *own;
}
inline const ExpectedTable& opened_profiles = committed_profiles();

// Compares with the committed value, or notes this one. `size`: of such values.
inline void expect_committed(const std::string& what, int refined, const std::string& quantity,
                             double x, double value, double size) {
  const ExpectedTable::Row key = {what, std::to_string(refined), quantity,
                                  fmt::format("{:.6g}", x)};
  if (update() != Update::no) return committed_profiles().note(key, {fmt::format("{:.8g}", value)});
  const auto* row = committed_profiles().find(key);
  ASSERT_NE(row, nullptr) << what << " " << quantity << " at " << x;
  EXPECT_NEAR(value, std::stod(row->front()), 1e-6 * size)
      << what << " " << quantity << " at " << x;
}

// Of the whole face, numbers of the size 1.
inline void expect_committed(const std::string& what, int refined,
                             std::initializer_list<std::pair<const char*, double>> quantities) {
  for (const auto& [quantity, value] : quantities)
    expect_committed(what, refined, quantity, 0, value, 1);
}
// Pressure and shear of its edges, MPa, of the size 10.
inline void expect_committed(const std::string& what, int refined,
                             const std::vector<EdgeTraction>& edges) {
  for (const EdgeTraction& edge : edges) {
    const double x = edge.middle().x();
    expect_committed(what, refined, "pressure", x, edge.pressure, 10);
    expect_committed(what, refined, "shear", x, edge.shear, 10);
  }
}

}  // namespace airybench::testing
