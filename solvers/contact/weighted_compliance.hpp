// (D + W)⁻¹ b for ADMM (admm.hpp), with the symmetric part of D and a diagonal W > 0 that changes
// while it runs. By the form of D:
//
//   dense       Cholesky
//   sparse      CHOLMOD; where its factor has more than some times the entries of D, conjugate
//               gradients from the last answer: W is about D's diagonal, so that few steps suffice
//   not formed  W⁻¹ (b − Hᵀ v), (M + H W⁻¹ Hᵀ) v = H W⁻¹ b, by CHOLMOD: D + W = Hᵀ M⁻¹ H + W
#pragma once

#include <memory>

#include "solvers/contact/condensed.hpp"
#include "solvers/direct/cholmod.hpp"

namespace airybench {

class WeightedCompliance {
 public:
  explicit WeightedCompliance(const contact::Problem& problem);  // which must outlive this
  // Throws Breakdown, std::bad_alloc.
  void factorise(const Eigen::VectorXd& weight);
  // F: at first a guess.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& F);

 private:
  Eigen::SparseMatrix<double> with_bodies() const;
  void solve_iteratively(const Eigen::VectorXd& b, Eigen::VectorXd& F) const;

  const contact::Problem* problem_;
  Eigen::VectorXd weight_;
  Eigen::MatrixXd L_;                       // dense
  Eigen::SparseMatrix<double> lower_;       // of D, sparse
  std::unique_ptr<CholmodFactor> cholmod_;  // null: conjugate gradients
};

}  // namespace airybench
