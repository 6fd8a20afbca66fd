// StiffnessFactor by the libraries that the paper's methods use, so that measurements separate
// HYBRID's formulation from its factor. Each has its own copy of K.
#pragma once

#include "assembly/sparse_bytes.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"
#include "solvers/direct/cholmod.hpp"
#include "solvers/direct/mumps.hpp"

namespace airybench {

template <typename Factor>
class LibraryStiffness : public StiffnessFactor {
 public:
  std::size_t matrix_bytes() const final { return bytes_of(lower_); }
  void analyse() final { factor_.analyse(lower_, n_c_); }
  void factor(const Deadline& deadline) override;
  void count(Solution& solution) const override;

 protected:
  template <typename... OfFactor>
  LibraryStiffness(const ElementMatrices& K, int n_c, OfFactor... of_factor)
      : lower_(lower_triangle(K)), n_c_(n_c), factor_(of_factor...) {}
  void keep(const Eigen::VectorXd& b);

  Eigen::SparseMatrix<double> lower_;  // until it is factorised
  int n_c_;
  Factor factor_;
  Eigen::VectorXd b_;
};

// CHOLMOD does not solve in halves around L_CC:  D = (L_CC L_CCᵀ)⁻¹,  G = −(K⁻¹ b)_C,
// u = K⁻¹ (b + F_C).
class CholmodStiffness final : public LibraryStiffness<CholmodFactor> {
 public:
  CholmodStiffness(const ElementMatrices& K, int n_c) : LibraryStiffness(K, n_c) {}
  Eigen::MatrixXd compliance() override { return factor_.inverse_of_schur(); }
  Eigen::VectorXd load(const Eigen::VectorXd& b) override;
  Eigen::VectorXd recover(const Eigen::VectorXd& F_C, const Eigen::VectorXd& u_C) override;
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) override {
    factor_.solve_in_place(X, deadline);
  }
};

// MUMPS leaves K_c, its Schur complement:  D = K_c⁻¹,  G = −D reduce(b),  u = expand(u_C).
class MumpsStiffness final : public LibraryStiffness<MumpsFactor> {
 public:
  MumpsStiffness(const ElementMatrices& K, int n_c)
      : LibraryStiffness(K, n_c, MumpsFactor::Definite::yes) {}
  void factor(const Deadline& deadline) override;
  Eigen::MatrixXd compliance() override;
  Eigen::VectorXd load(const Eigen::VectorXd& b) override;
  Eigen::VectorXd recover(const Eigen::VectorXd& F_C, const Eigen::VectorXd& u_C) override;
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) override;
  void count(Solution& solution) const override;

 private:
  Eigen::MatrixXd schur_factor_;  // Cholesky factor of K_c
};

}  // namespace airybench
