// What FCLIB's own library reads in a file: read_fclib FILE
//
// Prints, number by number: spacedim, m, then W by rows, q, mu, u, r. Exit status 1: it cannot.
#include <cstdio>
#include <vector>

extern "C" {
#include <fclib.h>
}

namespace {

void print(const double* values, int count) {
  for (int i = 0; i < count; ++i) std::printf("%.17g\n", values[i]);
}

std::vector<double> by_rows(const fclib_matrix& W) {
  std::vector<double> dense(static_cast<std::size_t>(W.m) * W.n);
  for (int row = 0; row < W.m; ++row)
    for (int k = W.p[row]; k < W.p[row + 1]; ++k) dense[row * W.n + W.i[k]] = W.x[k];
  return dense;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 1;
  const fclib_local* problem = fclib_read_local(arguments[1]);
  const fclib_solution* solution = fclib_read_solution(arguments[1]);
  constexpr int compressed_rows = -2;
  if (problem == nullptr || solution == nullptr || problem->W->nz != compressed_rows) return 1;
  const int m = problem->W->m;
  std::printf("%d\n%d\n", problem->spacedim, m);
  const std::vector<double> W = by_rows(*problem->W);
  print(W.data(), static_cast<int>(W.size()));
  print(problem->q, m);
  print(problem->mu, m / problem->spacedim);
  print(solution->u, m);
  print(solution->r, m);
}
