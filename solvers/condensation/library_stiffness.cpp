#include "solvers/condensation/library_stiffness.hpp"

#include "solvers/direct/dense_factors.hpp"
#include "solvers/direct/factor_counts.hpp"

namespace airybench {

template <typename Factor>
void LibraryStiffness<Factor>::factor(const Deadline&) {
  factor_.factor(lower_);
  Eigen::SparseMatrix<double>().swap(lower_);
}

template <typename Factor>
void LibraryStiffness<Factor>::keep(const Eigen::VectorXd& b) {
  const OwnerScope scope(MemoryOwner::factor);
  b_ = b;
}

template <typename Factor>
void LibraryStiffness<Factor>::count(Solution& solution) const {
  count_factor(factor_, solution);
  solution.storage[MemoryOwner::factor] += static_cast<std::size_t>(b_.size()) * sizeof(double);
}

template class LibraryStiffness<CholmodFactor>;
template class LibraryStiffness<MumpsFactor>;

Eigen::VectorXd CholmodStiffness::load(const Eigen::VectorXd& b) {
  keep(b);
  Eigen::VectorXd u = b;
  factor_.solve_in_place(u);
  return -u.tail(n_c_);
}

Eigen::VectorXd CholmodStiffness::recover(const Eigen::VectorXd& F_C, const Eigen::VectorXd&) {
  Eigen::VectorXd u = b_;
  u.tail(n_c_) += F_C;
  factor_.solve_in_place(u);
  return u;
}

void MumpsStiffness::factor(const Deadline& deadline) {
  LibraryStiffness::factor(deadline);
  if (n_c_ > 0) schur_factor_ = cholesky(factor_.take_schur(), "Schur complement of the stiffness");
}

Eigen::MatrixXd MumpsStiffness::compliance() {
  return n_c_ > 0 ? inverse_from_factor(schur_factor_) : Eigen::MatrixXd();
}

Eigen::VectorXd MumpsStiffness::load(const Eigen::VectorXd& b) {
  keep(b);
  if (n_c_ == 0) return {};
  Eigen::VectorXd G = -factor_.reduce(b);
  solve_by_cholesky(schur_factor_, G);
  return G;
}

Eigen::VectorXd MumpsStiffness::recover(const Eigen::VectorXd&, const Eigen::VectorXd& u_C) {
  Eigen::VectorXd u = b_;
  if (n_c_ == 0) {
    factor_.solve_in_place(u);
    return u;
  }
  factor_.reduce(b_);  // other loads may have been reduced since
  return factor_.expand(u_C);
}

void MumpsStiffness::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) {
  if (n_c_ == 0) return factor_.solve_in_place(X, deadline);
  for (auto x : X.colwise()) {
    Eigen::VectorXd u_C = factor_.reduce(x);
    solve_by_cholesky(schur_factor_, u_C);
    x = factor_.expand(u_C);
    deadline.check("the solves with MUMPS's factor");
  }
}

void MumpsStiffness::count(Solution& solution) const {
  LibraryStiffness::count(solution);
  solution.storage[MemoryOwner::factor] +=
      static_cast<std::size_t>(schur_factor_.size()) * sizeof(double);
}

}  // namespace airybench
