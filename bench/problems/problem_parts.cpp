#include "bench/problems/problem_parts.hpp"

#include <fmt/format.h>

#include <utility>

#include "assembly/problem/boundary_values.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/condensation/global_problem.hpp"
#include "solvers/contact/compliance.hpp"

namespace airybench {
namespace {

constexpr int max_dense_rows = 20'000;  // 3.2 GB
// Of W and q: forces q / W, up to 1e100, have squares, energies and friction that a double can be.
constexpr double min_entry = 1e-50, max_entry = 1e50;

contact::Problem in_range(contact::Problem problem, const std::string& place,
                          const Refuse& refuse) {
  const auto is_in_range = [](double x) { return x >= min_entry && x <= max_entry; };
  const Eigen::VectorXd diagonal = D_diagonal(problem);
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (!is_in_range(diagonal(i)))
      refuse(place, fmt::format("diagonal entry {} is {:.3g}", i, diagonal(i)),
             fmt::format("{:g} to {:g}", min_entry, max_entry));
  const double of_W = problem.is_dense()        ? problem.D.lpNorm<Eigen::Infinity>()
                      : problem.rows.size() > 0 ? problem.rows.coeffs().cwiseAbs().maxCoeff()
                                                : 0;
  if (!(of_W <= max_entry))
    refuse(place, fmt::format("entries of up to {:.3g}", of_W), fmt::format("{:g}", max_entry));
  const double of_q = problem.G.lpNorm<Eigen::Infinity>();
  if (of_q != 0 && !is_in_range(of_q))
    refuse(place, fmt::format("its vector has entries of up to {:.3g}", of_q),
           fmt::format("0, or {:g} to {:g}", min_entry, max_entry));
  return problem;
}

// Whether it is, exactly.
template <typename Matrix>
bool check_symmetric(const Matrix& matrix, const std::string& place, const Refuse& refuse) {
  constexpr double max_off = 0.01;  // few digits, or other programs' inertia in another frame
  const Eigen::VectorXd diagonal = matrix.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (!(diagonal(i) > 0))
      refuse(place, fmt::format("diagonal entry {} is {}", i, diagonal(i)), "> 0");
  const Matrix difference = matrix - Matrix(matrix.transpose());
  const double off = difference.nonZeros() == 0 ? 0 : difference.coeffs().cwiseAbs().maxCoeff();
  if (!(off <= max_off * diagonal.maxCoeff()))
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
    if (!(mu(k) >= 0 && mu(k) <= max_friction))
      refuse(place, fmt::format("[{}] is {}", k, mu(k)), fmt::format("0 to {:g}", max_friction));
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
    return in_range(std::move(problem), place, refuse);
  }
  if (W.rows() > max_dense_rows)
    refuse(place, fmt::format("{} rows with {} entries", W.rows(), W.nonZeros()),
           fmt::format("up to {} rows, more of a sparse matrix", max_dense_rows));
  problem.D = W;
  problem.how = "dense";
  return in_range(std::move(problem), place, refuse);
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
    return in_range(std::move(problem), place_of_M, refuse);
  } catch (const Breakdown&) {
    refuse(place_of_M, "is not positive definite to rounding", "a positive definite matrix");
    throw;
  }
}

}  // namespace airybench
