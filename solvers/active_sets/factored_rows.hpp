// The rows that active sets act on (active_rows.hpp) with K factorised anew under every set of
// laws. D, whose cost grows with n_c³, is not formed: this is for many contact points.
//
// Slots are the unknowns of the hybridized system. What the laws hold leaves it; of a closed pair
// of two bodies (paired_points.hpp) ū_p + ū_q = ḡ, and both are one unknown v of the reduced
// system:
//
//   x_p = v,  x_q = −v;   r_v = r_p − r_q
//
// The factor is that of the reduced K, which is symmetric. Without slip one application solves the
// system; rows of slip, which take the normal reaction along, cost a few of GMRES's iterations.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/active_sets/active_rows.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/direct/multifrontal.hpp"

namespace airybench {

class FactoredRows : public ContactRows {
 public:
  // system: of these points, and must outlive this; set() changes its K while it factorises. start:
  // contact forces to choose the first laws by, in the rows of F_C; empty: what the body would
  // push through the wall sticks.
  FactoredRows(const Problem& problem, const ContactPoints& points, HybridizedSystem& system,
               const Eigen::VectorXd& start, const Deadline& deadline);

  Eigen::Index slots() const override { return system_.b.size(); }
  std::vector<PointLaw> first_laws(int& sweeps) override;
  // Throws Breakdown, TimeoutReached, std::bad_alloc.
  void set(const std::vector<PointLaw>& laws) override;
  void move_to_gap(Eigen::VectorXd& u) const override;
  double measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) override;
  GmresResult solve(Eigen::VectorXd r, const GmresOptions& options, Eigen::VectorXd& x) override;
  double error_left(const GmresResult& solve, const Eigen::VectorXd&, bool) override {
    return condition * solve.reduction * solve.norm;
  }
  Eigen::VectorXd of_contact(const Eigen::VectorXd& x) const override;
  Eigen::VectorXd reactions(const Eigen::VectorXd& unbalanced) const override;
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override;
  double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const override { return x.dot(y); }
  double norm_from_below(const Eigen::VectorXd& F_C) override;

  // The largest factor, and the operations of all.
  struct Made {
    std::size_t bytes = 0;
    std::int64_t entries = 0;
    double flops = 0;
  };
  const Made& made() const { return made_; }
  std::size_t bytes() const;  // without the factor

 private:
  // Of a joined point's first component; the others follow.
  struct Slots {
    Eigen::Index first, second;  // of the body, of the other one: none at a wall
  };
  static constexpr Eigen::Index none = -1;
  static constexpr int held = -1;

  void number_slots();
  void change_signs();
  void add_friction(Eigen::VectorXd& r) const;
  Eigen::VectorXd reduced(const Eigen::VectorXd& r) const;
  void expand(const Eigen::VectorXd& reduced, Eigen::VectorXd& x) const;
  Eigen::VectorXd solved(Eigen::VectorXd r) const;  // of the reduced system

  HybridizedSystem& system_;
  const Deadline deadline_;
  PrescribedForces<double> prescribed_;
  std::vector<Slots> slots_;
  std::vector<bool> is_second_;  // per slot
  std::vector<int> elements_with_seconds_;
  Eigen::VectorXd start_;
  std::vector<PointLaw> laws_;
  bool is_factored_ = false;  // under these laws
  Made made_;
  std::vector<int> number_;  // per slot, of its unknown in the reduced system
  int unknowns_ = 0;         // of the reduced system
  MultifrontalFactor factor_;
  KrylovSpace space_;
};

}  // namespace airybench
