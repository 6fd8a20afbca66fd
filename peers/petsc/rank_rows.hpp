// The rows that active sets act on (solvers/two_level/active_rows.hpp) over the ranks: A x = r by
// the Krylov method and the preconditioner of the options, KSP without a prefix where A is
// symmetric, -slip_ksp_type where points slip. With -pc_type mg it has two levels, A and the coarse
// displacements' PᵀKP, everything else as the options say (peers/petsc/*.options).
#pragma once

#include "peers/petsc/coarse_space.hpp"
#include "peers/petsc/edge_system.hpp"
#include "solvers/two_level/active_rows.hpp"

namespace airybench {

class RankRows : public ContactRows {
 public:
  static bool has_two_levels();  // by the options
  // coarse: of two levels. With one displacement per edge -per_edge_mg_coarse_pc_type and
  // …_pc_factor_mat_solver_type go before -mg_coarse_….
  RankRows(EdgeSystem& system, CoarseSpace* coarse);
  RankRows(const RankRows&) = delete;
  RankRows& operator=(const RankRows&) = delete;

  Eigen::Index slots() const override { return system_.b().size(); }
  // Points that the body would pass through the wall are closed and stick, the others are open.
  std::vector<PointLaw> first_laws(int& sweeps) override;
  void set(const std::vector<PointLaw>& laws) override;
  void move_to_gap(Eigen::VectorXd& u) const override;
  double measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) override;
  // Where the method breaks down x is zero.
  GmresResult solve(Eigen::VectorXd r, const GmresOptions& options, Eigen::VectorXd& x) override;
  double error_left(const GmresResult& solve, const Eigen::VectorXd& r, bool measured) override;
  Eigen::VectorXd of_contact(const Eigen::VectorXd& x) const override {
    return system_.of_contact(x);
  }
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override {
    system_.multiply(x, y);
  }
  double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const override {
    return parallel::sum(x.dot(y));
  }
  double norm_from_below(const Eigen::VectorXd& F_C) override;

 private:
  double norm(const Eigen::VectorXd& r);  // √(r·M⁻¹r)

  EdgeSystem& system_;
  CoarseSpace* coarse_;
  parallel::OwnedKsp symmetric_, slipping_;
  bool is_set_up_ = false;
};

}  // namespace airybench
