// A x = r by the Krylov method and the preconditioner of the options: KSP without a prefix where A
// is symmetric, -slip_ksp_type where points slip. With -pc_type mg it has two levels, A and the
// coarse displacements' PᵀKP, everything else as the options say (peers/petsc/*.options).
#pragma once

#include "peers/petsc/coarse_space.hpp"

namespace airybench {

// √cond(M⁻¹K) of two levels, about (solvers/two_level/preconditioner.hpp), with room for a coarse
// problem that is not solved exactly.
inline constexpr double preconditioned_condition = 4;

class LinearSolver {
 public:
  explicit LinearSolver(EdgeSystem& system);
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  static bool has_two_levels();  // by the options
  // Two levels: before the first laws. With one displacement per edge
  // -per_edge_mg_coarse_pc_type and …_pc_factor_mat_solver_type go before -mg_coarse_….
  void set_coarse(CoarseSpace* coarse);
  // Holds what laws hold, in A and in the preconditioner, and sets it up.
  void set_laws(const std::vector<PointLaw>& laws);

  struct Result {
    int iterations = 0;
    double reduction = 1;  // that was reached
    bool broke_down = false;
  };
  // Reduces r by the factor `tolerance`, in the norm of the method.
  Result solve(Vec r, double tolerance, Vec x);
  // √(r·M⁻¹r): about the energy norm of what is wrong with x where r is its residual.
  double norm(Vec r);

 private:
  EdgeSystem& system_;
  CoarseSpace* coarse_ = nullptr;
  parallel::OwnedKsp symmetric_, slipping_;
  parallel::OwnedVec work_;
  bool set_up_ = false;
};

}  // namespace airybench
