#include "bench/problems/problem_parts.hpp"

#include <fmt/format.h>

#include <utility>

#include "solvers/base/solution.hpp"
#include "solvers/condensation/global_problem.hpp"

namespace airybench {
namespace {

constexpr int most_dense_rows = 20'000;  // 3.2 GB

// Whether it is, exactly.
template <typename Matrix>
bool check_symmetric(const Matrix& matrix, const std::string& place, const Refuse& refuse) {
  constexpr double most_off = 0.01;  // few digits, or other programs' inertia in another frame
  const Eigen::VectorXd diagonal = matrix.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (!(diagonal(i) > 0))
      refuse(place, fmt::format("diagonal entry {} is {}", i, diagonal(i)), "> 0");
  const Matrix difference = matrix - Matrix(matrix.transpose());
  const double off = difference.nonZeros() == 0 ? 0 : difference.coeffs().cwiseAbs().maxCoeff();
  if (!(off <= most_off * diagonal.maxCoeff()))
    refuse(place, fmt::format("differs from its transpose by {:.3g}", off),
           "1 % of the largest diagonal entry");
  return off == 0;
}

}  // namespace

void check_rows(int rows, int dimension, const std::string& place, const Refuse& refuse) {
  if (rows % dimension != 0)
    refuse(place, std::to_string(rows), fmt::format("a multiple of {} per contact", dimension));
}

ContactPoints points_of(int dimension, const Eigen::VectorXd& mu, const std::string& place,
                        const Refuse& refuse) {
  ContactPoints points;
  points.count = static_cast<int>(mu.size());
  points.components = dimension;
  points.friction.assign(mu.begin(), mu.end());
  for (Eigen::Index k = 0; k < mu.size(); ++k)
    if (mu(k) < 0) refuse(place, fmt::format("[{}] is {}", k, mu(k)), "at least 0");
  return points;
}

contact::Problem local_problem(SparseRows W, Eigen::VectorXd q, ContactPoints points,
                               const std::string& place, const Refuse& refuse) {
  contact::Problem problem;
  problem.is_symmetric = check_symmetric(W, place, refuse);
  problem.G = std::move(q);
  problem.points = std::move(points);
  if (held_sparse(W.rows(), W.nonZeros())) {
    problem.rows = std::move(W);
    problem.how = "sparse";
    return problem;
  }
  if (W.rows() > most_dense_rows)
    refuse(place, fmt::format("{} rows with {} entries", W.rows(), W.nonZeros()),
           fmt::format("up to {} rows, more of a sparse matrix", most_dense_rows));
  problem.D = W;
  problem.how = "dense";
  return problem;
}

contact::Problem global_problem(GlobalArrays arrays, ContactPoints points,
                                const std::string& place_of_M, const std::string& place_of_H,
                                const Refuse& refuse) {
  check_symmetric(arrays.M, place_of_M, refuse);
  arrays.H.prune(0.0, 0.0);
  for (Eigen::Index j = 0; j < arrays.H.cols(); ++j)
    if (arrays.H.col(j).nonZeros() == 0)
      refuse(place_of_H, fmt::format("column {} moves nothing", j), "columns that are not zero");
  try {
    contact::Problem problem =
        condense_global(std::move(arrays.M), std::move(arrays.H), arrays.f, arrays.w);
    problem.points = std::move(points);
    return problem;
  } catch (const Breakdown&) {
    refuse(place_of_M, "is not positive definite to rounding", "a positive definite matrix");
    throw;
  }
}

}  // namespace airybench
