#include "solvers/preconditioners/triangular_solve.hpp"

namespace airybench {
namespace {

template <int lanes>
void forward(const IncompleteFactor& L, double* x) {
  for (const FactorRows& part : L.parts) {
    const int rows = static_cast<int>(part.start.size()) - 1;
    for (int k = 0; k < rows; ++k) {
      double* const own = x + std::ptrdiff_t{part.first + k} * lanes;
      double sum[lanes];
      for (int l = 0; l < lanes; ++l) sum[l] = own[l];
      for (int e = part.start[k]; e < part.start[k + 1]; ++e) {
        const double* const other = x + std::ptrdiff_t{part.column[e]} * lanes;
        for (int l = 0; l < lanes; ++l) sum[l] -= part.value[e] * other[l];
      }
      for (int l = 0; l < lanes; ++l) own[l] = sum[l] * L.inverse_diagonal[part.first + k];
    }
  }
}

template <int lanes>
void backward(const IncompleteFactor& L, double* x) {
  for (auto part = L.parts.rbegin(); part != L.parts.rend(); ++part) {
    for (int k = static_cast<int>(part->start.size()) - 2; k >= 0; --k) {
      double* const own = x + std::ptrdiff_t{part->first + k} * lanes;
      double solved[lanes];
      for (int l = 0; l < lanes; ++l)
        own[l] = solved[l] = own[l] * L.inverse_diagonal[part->first + k];
      for (int e = part->start[k]; e < part->start[k + 1]; ++e) {
        double* const other = x + std::ptrdiff_t{part->column[e]} * lanes;
        for (int l = 0; l < lanes; ++l) other[l] -= part->value[e] * solved[l];
      }
    }
  }
}

}  // namespace

std::size_t IncompleteFactor::entries() const {
  std::size_t count = inverse_diagonal.size();
  for (const FactorRows& part : parts) count += part.value.size();
  return count;
}

std::size_t IncompleteFactor::bytes() const {
  std::size_t sum = inverse_diagonal.size() * sizeof(double);
  for (const FactorRows& part : parts)
    sum += part.value.size() * (sizeof(double) + sizeof(int)) + part.start.size() * sizeof(int);
  return sum;
}

void solve_in_place(const IncompleteFactor& factor, LaneBlock& X) {
  with_lanes(X.cols(), [&](auto lanes) {
    forward<lanes>(factor, X.data());
    backward<lanes>(factor, X.data());
  });
}

}  // namespace airybench
