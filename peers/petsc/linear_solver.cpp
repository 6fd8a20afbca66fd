#include "peers/petsc/linear_solver.hpp"

#include <cmath>

namespace airybench {

using namespace parallel;

LinearSolver::LinearSolver(EdgeSystem& system) : system_(system), work_(system.new_vector()) {
  check(KSPCreate(PETSC_COMM_WORLD, symmetric_.put()));
  check(KSPSetOperators(symmetric_, system.A(), system.A()));
  check(KSPSetType(symmetric_, KSPCG));
  check(KSPSetNormType(symmetric_, KSP_NORM_NATURAL));
  check(KSPCreate(PETSC_COMM_WORLD, slipping_.put()));
  check(KSPSetOptionsPrefix(slipping_, "slip_"));
  check(KSPSetOperators(slipping_, system.A(), system.A()));
  check(KSPSetType(slipping_, KSPGMRES));
}

bool LinearSolver::has_two_levels() {
  std::array<char, 32> type{};
  PetscBool given = PETSC_FALSE;
  check(PetscOptionsGetString(nullptr, nullptr, "-pc_type", type.data(), type.size(), &given));
  return given == PETSC_TRUE && std::string(type.data()) == PCMG;
}

void LinearSolver::set_coarse(CoarseSpace* coarse) {
  coarse_ = coarse;
  if (coarse == nullptr || coarse->kind() != CoarseKind::per_edge) return;
  for (const std::string option : {"mg_coarse_pc_type", "mg_coarse_pc_factor_mat_solver_type"}) {
    std::array<char, 64> value{};
    PetscBool given = PETSC_FALSE;
    check(PetscOptionsGetString(nullptr, nullptr, ("-per_edge_" + option).c_str(), value.data(),
                                value.size(), &given));
    if (given == PETSC_TRUE)
      check(PetscOptionsSetValue(nullptr, ("-" + option).c_str(), value.data()));
  }
}

void LinearSolver::set_laws(const std::vector<PointLaw>& laws) {
  system_.set_laws(laws);
  PC pc = nullptr;
  check(KSPGetPC(symmetric_, &pc));
  const bool coarse_changed = coarse_ != nullptr && coarse_->set_laws(laws);
  if (!set_up_) {
    if (coarse_ != nullptr) {
      check(PCSetType(pc, PCMG));
      check(PCMGSetLevels(pc, 2, nullptr));
      check(PCMGSetDistinctSmoothUp(pc));
      check(PCMGSetInterpolation(pc, 1, coarse_->prolongation()));
      KSP of_coarse = nullptr;
      check(PCMGGetCoarseSolve(pc, &of_coarse));
      check(KSPSetOperators(of_coarse, coarse_->matrix(), coarse_->matrix()));
    }
    check(KSPSetFromOptions(symmetric_));
    check(KSPSetPC(slipping_, pc));
    check(KSPSetFromOptions(slipping_));
    for (const KSP ksp : {KSP(symmetric_), KSP(slipping_)})
      check(KSPSetResidualHistory(ksp, nullptr, PETSC_DECIDE, PETSC_TRUE));
    set_up_ = true;
  } else if (coarse_changed) {
    KSP of_coarse = nullptr;
    check(PCMGGetCoarseSolve(pc, &of_coarse));
    check(KSPSetOperators(of_coarse, coarse_->matrix(), coarse_->matrix()));
  }
  check(KSPSetUp(symmetric_));
  check(KSPSetUp(slipping_));
}

LinearSolver::Result LinearSolver::solve(Vec r, double tolerance, Vec x) {
  const KSP ksp = system_.slips() ? slipping_ : symmetric_;
  PetscInt most = 0;
  check(KSPGetTolerances(ksp, nullptr, nullptr, nullptr, &most));
  check(KSPSetTolerances(ksp, tolerance, 0, PETSC_DEFAULT, most));
  check(KSPSolve(ksp, r, x));
  Result result;
  PetscInt iterations = 0;
  check(KSPGetIterationNumber(ksp, &iterations));
  result.iterations = static_cast<int>(iterations);
  PetscReal first = 0, last = 0;
  check(KSPGetResidualNorm(ksp, &last));
  const PetscReal* history = nullptr;
  PetscInt length = 0;
  check(KSPGetResidualHistory(ksp, &history, &length));
  if (length > 0) first = history[0];
  if (first > 0) result.reduction = last / first;
  KSPConvergedReason reason;
  check(KSPGetConvergedReason(ksp, &reason));
  result.broke_down = reason < 0 && reason != KSP_DIVERGED_ITS;
  return result;
}

double LinearSolver::norm(Vec r) {
  PC pc = nullptr;
  check(KSPGetPC(symmetric_, &pc));
  check(PCApply(pc, r, work_));
  PetscScalar product = 0;
  check(VecDot(r, work_, &product));
  return std::sqrt(std::abs(product));
}

}  // namespace airybench
