// The rows that active sets act on (active_rows.hpp) with K in blocks, GMRES and two levels.
#pragma once

#include "solvers/active_sets/active_rows.hpp"
#include "solvers/two_level/two_levels.hpp"

namespace airybench {

class SlotRows : public ContactRows {
 public:
  SlotRows(const Problem& problem, const ContactPoints& contact, const HybridizedSystem& system,
           const EdgeMatrix& K, TwoLevelPreconditioner& M, const Deadline& deadline);

  Eigen::Index slots() const override { return K_.slots(); }
  // Those of the coarse displacements.
  std::vector<PointLaw> first_laws(int& sweeps) override;
  void set(const std::vector<PointLaw>& laws) override;
  void move_to_gap(Eigen::VectorXd& u) const override;
  double measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) override;
  GmresResult solve(Eigen::VectorXd r, const GmresOptions& options, Eigen::VectorXd& x) override;
  double error_left(const GmresResult& solve, const Eigen::VectorXd&, bool) override {
    return condition * solve.reduction * solve.norm;
  }
  Eigen::VectorXd of_contact(const Eigen::VectorXd& x) const override;
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override { K_.multiply(x, y); }
  double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const override { return x.dot(y); }
  double norm_from_below(const Eigen::VectorXd& F_C) override;

  // Between solves.
  void drop_space() { space_ = {}; }
  void drop_loads() { b_ = prescribed_u_ = K_times_u_ = Eigen::VectorXd(); }
  std::size_t bytes() const;

 private:
  void reduce(Eigen::VectorXd& r) const;

  const EdgeMatrix& K_;
  TwoLevelPreconditioner& M_;
  const Deadline deadline_;
  Eigen::VectorXd b_;                         // N, without contact forces; −K ū0 is in it
  Eigen::VectorXd prescribed_u_, K_times_u_;  // ū0, mm; K ū0
  std::vector<Eigen::Index> prescribed_;
  std::vector<Eigen::Index> slot_;  // of every contact point's normal; the tangential one follows
  std::vector<PointLaw> laws_;
  std::vector<Eigen::Index> held_;
  KrylovSpace space_;
};

}  // namespace airybench
