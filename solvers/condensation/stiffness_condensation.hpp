// From the factor of a stiffness to the condensed contact problem, the contact displacements being
// the last unknowns:
//
//   ⎡ K_II K_IC ⎤ ⎡ u_I ⎤   ⎡ b_I       ⎤      K_c = K_CC − K_CI K_II⁻¹ K_IC,   D = K_c⁻¹
//   ⎣ K_CI K_CC ⎦ ⎣ u_C ⎦ = ⎣ b_C + F_C ⎦      G = −D (b_C − K_CI K_II⁻¹ b_I)
#pragma once

#include <memory>

#include "solvers/base/solution.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/direct/multifrontal.hpp"

namespace airybench {

// A factor of K for methods in displacements. Its functions are called in their order here; without
// contact unknowns D and G are empty.
class StiffnessFactor {
 public:
  virtual ~StiffnessFactor() = default;
  virtual std::size_t matrix_bytes() const { return 0; }  // of its own copy of K, until factor()
  virtual void analyse() = 0;                             // throws std::bad_alloc
  // Throws Breakdown where K is not positive definite, TimeoutReached, std::bad_alloc.
  virtual void factor(const Deadline& deadline) = 0;
  virtual Eigen::MatrixXd compliance() = 0;  // D, once
  // G of the loads b, which stay for recover().
  virtual Eigen::VectorXd load(const Eigen::VectorXd& b) = 0;
  // All unknowns u of those loads, from F_C and u_C = D F_C − G.
  virtual Eigen::VectorXd recover(const Eigen::VectorXd& F_C, const Eigen::VectorXd& u_C) = 0;
  virtual void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) = 0;
  virtual void count(Solution& solution) const = 0;  // entries, flops, bytes
};

// Our own. With K = L Lᵀ and y = L⁻¹ b (multifrontal.hpp), K_c = L_CC L_CCᵀ and G = −L_CC⁻ᵀ y_C:
// no solve with n_c right-hand sides. Given u_C, the inner unknowns come from
// Lᵀ u = (y_I, L_CCᵀ u_C).
class MultifrontalStiffness final : public StiffnessFactor {
 public:
  // K is read until it is factorised.
  MultifrontalStiffness(const ElementMatrices& K, int n_c) : K_(K), n_c_(n_c) {}
  void analyse() override { factor_.analyse(K_, n_c_); }
  void factor(const Deadline& deadline) override { factor_.factor(K_, deadline); }
  Eigen::MatrixXd compliance() override;
  Eigen::VectorXd load(const Eigen::VectorXd& b) override;
  Eigen::VectorXd recover(const Eigen::VectorXd& F_C, const Eigen::VectorXd& u_C) override;
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) override {
    factor_.solve_in_place(X, deadline);
  }
  void count(Solution& solution) const override;
  const MultifrontalFactor& cholesky() const { return factor_; }

 private:
  const ElementMatrices& K_;
  int n_c_;
  MultifrontalFactor factor_;
  Eigen::VectorXd y_;
};

// The contact problem of K u = b + F_C, and into the solution the stages' times and what the factor
// takes. system: what messages call it.
contact::Problem factorise_and_condense(StiffnessFactor& factor, const Eigen::VectorXd& b,
                                        const ContactPoints& points, const std::string& system,
                                        const Deadline& deadline, Solution& solution);

}  // namespace airybench
