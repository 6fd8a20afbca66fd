// The degrees of stresses, and what chooses between them when the program runs.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>

// The degrees there are; X(k) for each. A further one is an entry here.
#define AIRYBENCH_STRESS_DEGREES(X) X(1) X(2) X(3) X(4)

namespace airybench {

#define AIRYBENCH_LISTED(k) k,
inline constexpr int highest_stress_degree = std::max({AIRYBENCH_STRESS_DEGREES(AIRYBENCH_LISTED)});
#undef AIRYBENCH_LISTED

// Calls run(std::integral_constant<int, k>()) for a degree k of stresses.
template <typename Run>
decltype(auto) with_degree(int k, Run run) {
#define AIRYBENCH_CASE(degree) \
  case degree:                 \
    return run(std::integral_constant<int, degree>());
  switch (k) { AIRYBENCH_STRESS_DEGREES(AIRYBENCH_CASE) }
#undef AIRYBENCH_CASE
  throw std::invalid_argument("stresses of degree " + std::to_string(k) + " (allowed: 1 to " +
                              std::to_string(highest_stress_degree) + ")");
}

// make(k), made at the first call with this k. `make` has no state.
template <typename Make>
const auto& made_once(int k, Make make) {
  using Value = std::invoke_result_t<Make, int>;
  return with_degree(k, [&](auto degree) -> const Value& {
    static const Value value = make(degree);
    return value;
  });
}

}  // namespace airybench
