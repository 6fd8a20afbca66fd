// The polynomials of degree n that are 1 at one of the places 0, 1/n, …, 1 and 0 at the others.
#pragma once

#include <vector>

namespace airybench {

template <typename Scalar>
struct LagrangeBasis {
  std::vector<Scalar> value, derivative;  // per place, at t

  LagrangeBasis(int n, const Scalar& t) {
    for (int i = 0; i <= n; ++i) {
      Scalar product = 1, slope = 0;
      for (int m = 0; m <= n; ++m) {
        if (m == i) continue;
        const Scalar factor = (n * t - m) / Scalar(i - m);
        slope = slope * factor + product * Scalar(n) / Scalar(i - m);
        product *= factor;
      }
      value.push_back(product);
      derivative.push_back(slope);
    }
  }
};

}  // namespace airybench
