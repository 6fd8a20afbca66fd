// The same stresses with coefficients of a higher degree, so that they can be compared.
#pragma once

#include "assembly/stress_field.hpp"

namespace airybench::testing {

// One by one: c'_α = Σ_i α_i / d c_{α − e_i}.
inline StressField elevated(StressField field, int degree) {
  while (field.degree() < degree) {
    const int d = field.degree() + 1, before = bernstein_count(d - 1), after = bernstein_count(d);
    StressField higher(field.size(), d);
    higher.values().setZero();
    for (int third = 0; third < 3 * static_cast<int>(field.size()); ++third)
      for (int c = 0; c <= d; ++c)
        for (int b = 0; b <= d - c; ++b) {
          auto to = higher.values().col(third * after + ring_place(d, b, c));
          const auto from = [&](int b1, int c1) {
            return field.values().col(third * before + ring_place(d - 1, b1, c1));
          };
          if (const int a = d - b - c; a > 0) to += double(a) / d * from(b, c);
          if (b > 0) to += double(b) / d * from(b - 1, c);
          if (c > 0) to += double(c) / d * from(b, c - 1);
        }
    field = std::move(higher);
  }
  return field;
}

}  // namespace airybench::testing
