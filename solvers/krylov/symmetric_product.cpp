#include "solvers/krylov/symmetric_product.hpp"

namespace airybench {

template <int lanes>
void symmetric_product(const SparseColumns& lower, const double* x, double* y) {
  const int* const row = lower.innerIndexPtr();
  const double* const value = lower.valuePtr();
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    const double* const xj = x + j * lanes;
    double own[lanes];  // y_j
    double xs[lanes];
    for (int l = 0; l < lanes; ++l) own[l] = y[j * lanes + l], xs[l] = xj[l];
    for (int e = lower.outerIndexPtr()[j]; e < lower.outerIndexPtr()[j + 1]; ++e) {
      const std::ptrdiff_t i = row[e];
      if (i == j) {
        for (int l = 0; l < lanes; ++l) own[l] += value[e] * xs[l];
        continue;
      }
      for (int l = 0; l < lanes; ++l) own[l] += value[e] * x[i * lanes + l];
      for (int l = 0; l < lanes; ++l) y[i * lanes + l] += value[e] * xs[l];
    }
    for (int l = 0; l < lanes; ++l) y[j * lanes + l] = own[l];
  }
}

template void symmetric_product<1>(const SparseColumns&, const double*, double*);
template void symmetric_product<max_lanes>(const SparseColumns&, const double*, double*);

void symmetric_product(const SparseColumns& lower, const LaneBlock& X, LaneBlock& Y) {
  Y.setZero();
  with_lanes(X.cols(), [&](auto lanes) { symmetric_product<lanes>(lower, X.data(), Y.data()); });
}

}  // namespace airybench
