// StiffnessFactor by the libraries that the paper's methods use, so that HYBRID's formulation and
// its factor can be told apart. K is put together, and asked for no more.
#pragma once

#include "assembly/sparse_bytes.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"
#include "solvers/direct/cholmod.hpp"
#include "solvers/direct/mumps.hpp"

namespace airybench {

// CHOLMOD does not solve in halves around L_CC:  D = (L_CC L_CCᵀ)⁻¹,  G = −(K⁻¹ b)_C,
// u = K⁻¹ (b + F_C).
class CholmodStiffness final : public StiffnessFactor {
 public:
  CholmodStiffness(const ElementMatrices& K, int n_c) : lower_(lower_triangle(K)), n_c_(n_c) {}
  std::size_t matrix_bytes() const override { return bytes_of(lower_); }
  void analyse() override { factor_.analyse(lower_, n_c_); }
  void factor(const Deadline& deadline) override;
  Eigen::MatrixXd compliance() override { return factor_.inverse_of_schur(); }
  Eigen::VectorXd load(const Eigen::VectorXd& b) override;
  Eigen::VectorXd recover(const Eigen::VectorXd& F_C, const Eigen::VectorXd& u_C) override;
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) override {
    factor_.solve_in_place(X, deadline);
  }
  void count(Solution& solution) const override;

 private:
  Eigen::SparseMatrix<double> lower_;  // until it is factorised
  int n_c_;
  CholmodFactor factor_;
  Eigen::VectorXd b_;
};

// MUMPS leaves K_c, its Schur complement:  D = K_c⁻¹,  G = −D reduce(b),  u = expand(u_C).
class MumpsStiffness final : public StiffnessFactor {
 public:
  MumpsStiffness(const ElementMatrices& K, int n_c)
      : lower_(lower_triangle(K)), n_c_(n_c), factor_(MumpsFactor::Definite::yes) {}
  std::size_t matrix_bytes() const override { return bytes_of(lower_); }
  void analyse() override { factor_.analyse(lower_, n_c_); }
  void factor(const Deadline& deadline) override;
  Eigen::MatrixXd compliance() override;
  Eigen::VectorXd load(const Eigen::VectorXd& b) override;
  Eigen::VectorXd recover(const Eigen::VectorXd& F_C, const Eigen::VectorXd& u_C) override;
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) override;
  void count(Solution& solution) const override;

 private:
  Eigen::SparseMatrix<double> lower_;  // until it is factorised
  int n_c_;
  MumpsFactor factor_;
  Eigen::MatrixXd schur_factor_;  // Cholesky factor of K_c
  Eigen::VectorXd b_;
};

}  // namespace airybench
