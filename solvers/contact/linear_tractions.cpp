#include "solvers/contact/linear_tractions.hpp"

namespace airybench {
namespace {

// R, n_c × n_c1.
Eigen::SparseMatrix<double> elevation(const ContactPoints& points) {
  const int m = points.components, per_edge = points.per_edge;
  std::vector<Eigen::Triplet<double>> entries;
  for (int p = 0; p < points.count; ++p) {
    const int edge = p / per_edge;
    const double s = static_cast<double>(p % per_edge) / (per_edge - 1);
    for (int c = 0; c < m; ++c) {
      entries.emplace_back(m * p + c, m * 2 * edge + c, 2. / per_edge * (1 - s));
      entries.emplace_back(m * p + c, m * (2 * edge + 1) + c, 2. / per_edge * s);
    }
  }
  Eigen::SparseMatrix<double> R(points.size(), 2 * m * (points.count / per_edge));
  R.setFromTriplets(entries.begin(), entries.end());
  return R;
}

}  // namespace

bool has_linear_tractions(const contact::Problem& problem) {
  const ContactPoints& points = problem.points;
  return problem.is_dense() && points.per_edge > 2 && !points.boundary.empty() &&
         points.opposite.empty();
}

contact::Problem in_linear_tractions(const contact::Problem& problem) {
  const ContactPoints& all = problem.points;
  const Eigen::SparseMatrix<double> R = elevation(all);
  contact::Problem linear{.is_symmetric = problem.is_symmetric};
  linear.D = R.transpose() * (problem.D * R).eval();
  linear.G = R.transpose() * problem.G;
  linear.points.count = 2 * (all.count / all.per_edge);
  linear.points.components = all.components;
  if (all.gap.size() > 0) linear.points.gap = R.transpose() * all.gap;
  for (int p = 0; p < all.count; p += all.per_edge)
    for (int end = 0; end < 2; ++end) {
      linear.points.boundary.push_back(all.boundary[p]);
      if (!all.friction.empty()) linear.points.friction.push_back(all.friction_at(p));
    }
  return linear;
}

Eigen::VectorXd of_linear_tractions(const ContactPoints& points, const Eigen::VectorXd& F1) {
  return elevation(points) * F1;
}

}  // namespace airybench
