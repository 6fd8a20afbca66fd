#include "solvers/contact/weighted_compliance.hpp"

#include "solvers/direct/dense_factors.hpp"

namespace airybench {

WeightedCompliance::WeightedCompliance(const contact::Problem& problem) : problem_(&problem) {
  constexpr std::int64_t max_fill = 4;
  if (problem.is_dense()) return;
  cholmod_ = std::make_unique<CholmodFactor>();
  if (problem.bodies) {
    weight_ = problem.bodies->D_diagonal;
    cholmod_->analyse(with_bodies());
    return;
  }
  const Eigen::SparseMatrix<double> transposed = problem.rows.transpose();
  lower_ = (Eigen::SparseMatrix<double>(problem.rows) + transposed).triangularView<Eigen::Lower>();
  lower_ *= 0.5;
  cholmod_->analyse(lower_);
  if (cholmod_->entries() <= max_fill * problem.rows.nonZeros()) return;
  cholmod_.reset();
  lower_.resize(0, 0);
}

Eigen::SparseMatrix<double> WeightedCompliance::with_bodies() const {
  const contact::Bodies& bodies = *problem_->bodies;
  const Eigen::SparseMatrix<double> scaled = bodies.H * weight_.cwiseInverse().asDiagonal();
  return (bodies.M + scaled * bodies.H.transpose()).triangularView<Eigen::Lower>();
}

void WeightedCompliance::factorise(const Eigen::VectorXd& weight) {
  if (problem_->is_dense()) {
    L_ = problem_->D;
    if (!problem_->is_symmetric) L_ = (L_ + L_.transpose()).eval() / 2;
    L_.diagonal() += weight;
    L_ = cholesky(std::move(L_), "ADMM: D with weights on its diagonal");
  } else if (problem_->bodies) {
    weight_ = weight;
    cholmod_->factor(with_bodies());
  } else if (cholmod_) {
    const Eigen::VectorXd change = weight_.size() > 0 ? Eigen::VectorXd(weight - weight_) : weight;
    for (Eigen::Index i = 0; i < change.size(); ++i) lower_.coeffRef(i, i) += change(i);
    cholmod_->factor(lower_);
  }
  weight_ = weight;
}

// Preconditioned by the diagonal.
void WeightedCompliance::solve_iteratively(const Eigen::VectorXd& b, Eigen::VectorXd& F) const {
  constexpr double tolerance = 1e-14;  // ‖b − (D + W) F‖ ≤ tolerance · ‖b‖
  constexpr int max_iterations = 500;
  const SparseRows& D = problem_->rows;
  const auto times = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd y = D * x;
    if (!problem_->is_symmetric) y = (y + D.transpose() * x) / 2;
    return Eigen::VectorXd(y + weight_.cwiseProduct(x));
  };
  const Eigen::VectorXd inverse = (D.diagonal() + weight_).cwiseInverse();
  Eigen::VectorXd rest = b - times(F), z = inverse.cwiseProduct(rest), along = z;
  double product = rest.dot(z);
  for (int k = 0; k < max_iterations && rest.norm() > tolerance * b.norm(); ++k) {
    const Eigen::VectorXd image = times(along);
    const double length = product / along.dot(image);
    F += length * along;
    rest -= length * image;
    z = inverse.cwiseProduct(rest);
    const double next = rest.dot(z);
    along = z + next / product * along;
    product = next;
  }
}

void WeightedCompliance::solve(const Eigen::VectorXd& b, Eigen::VectorXd& F) {
  if (problem_->is_dense()) {
    F = b;
    solve_by_cholesky(L_, F);
  } else if (problem_->bodies) {
    const Eigen::SparseMatrix<double>& H = problem_->bodies->H;
    Eigen::VectorXd v = H * b.cwiseQuotient(weight_);
    cholmod_->solve_in_place(v);
    F = (b - H.transpose() * v).cwiseQuotient(weight_);
  } else if (cholmod_) {
    F = b;
    cholmod_->solve_in_place(F);
  } else {
    solve_iteratively(b, F);
  }
}

}  // namespace airybench
