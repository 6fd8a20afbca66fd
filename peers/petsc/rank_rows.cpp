#include "peers/petsc/rank_rows.hpp"

#include <algorithm>
#include <cmath>

namespace airybench {

using namespace parallel;

namespace {

// √cond(M⁻¹K) of two levels, about (solvers/two_level/preconditioner.hpp), with room for a coarse
// problem that is not solved exactly.
constexpr double preconditioned_condition = 4;

PC preconditioner_of(KSP ksp) {
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc));
  return pc;
}

}  // namespace

bool RankRows::has_two_levels() { return option("-pc_type") == PCMG; }

RankRows::RankRows(EdgeSystem& system, CoarseSpace* coarse)
    : ContactRows(system.part().contact, system.part().compliance, preconditioned_condition),
      system_(system),
      coarse_(coarse) {
  // Laws that settle at a linear error may change at a smaller one: soon seen, little is lost.
  next_target = 0.01;
  for (OwnedKsp* ksp : {&symmetric_, &slipping_}) {
    check(KSPCreate(PETSC_COMM_WORLD, ksp->put()));
    check(KSPSetOperators(*ksp, system.A(), system.A()));
  }
  check(KSPSetType(symmetric_, KSPCG));
  check(KSPSetNormType(symmetric_, KSP_NORM_NATURAL));
  check(KSPSetOptionsPrefix(slipping_, "slip_"));
  check(KSPSetType(slipping_, KSPGMRES));
  if (coarse == nullptr || coarse->kind() != CoarseKind::per_edge) return;
  for (const std::string name : {"mg_coarse_pc_type", "mg_coarse_pc_factor_mat_solver_type"})
    if (const auto value = option("-per_edge_" + name))
      check(PetscOptionsSetValue(nullptr, ("-" + name).c_str(), value->c_str()));
}

std::vector<PointLaw> RankRows::first_laws(int&) {
  std::vector<PointLaw> laws(static_cast<std::size_t>(contact.count));
  for (int p = 0; p < contact.count; ++p) {
    laws[p].closed = contact.gap.size() > 0 && contact.gap(contact.components * p) < 0;
    laws[p].sticks = laws[p].closed && contact.components == 2 && contact.friction_at(p) > 0;
  }
  return laws;
}

void RankRows::set(const std::vector<PointLaw>& laws) {
  if (is_set_up_ && laws == system_.laws()) return;
  system_.set_laws(laws);
  const bool coarse_changed = coarse_ != nullptr && coarse_->set_laws(laws);
  const PC pc = preconditioner_of(symmetric_);
  if (!is_set_up_ && coarse_ != nullptr) {
    check(PCSetType(pc, PCMG));
    check(PCMGSetLevels(pc, 2, nullptr));
    check(PCMGSetDistinctSmoothUp(pc));
    check(PCMGSetInterpolation(pc, 1, coarse_->prolongation()));
  }
  if (coarse_changed) {
    KSP of_coarse = nullptr;
    check(PCMGGetCoarseSolve(pc, &of_coarse));
    check(KSPSetOperators(of_coarse, coarse_->matrix(), coarse_->matrix()));
  }
  if (!is_set_up_) {
    check(KSPSetFromOptions(symmetric_));
    check(KSPSetPC(slipping_, pc));
    check(KSPSetFromOptions(slipping_));
    for (const KSP ksp : {KSP(symmetric_), KSP(slipping_)})
      check(KSPSetResidualHistory(ksp, nullptr, PETSC_DECIDE, PETSC_TRUE));
    is_set_up_ = true;
  }
  check(KSPSetUp(symmetric_));
  check(KSPSetUp(slipping_));
}

void RankRows::move_to_gap(Eigen::VectorXd& u) const {
  system_.visit_contact([&](int row, PetscInt slot) {
    const PointLaw& law = system_.laws()[row / contact.components];
    const bool is_normal = row % contact.components == 0;
    if (is_normal ? law.closed : law.sticks)
      u(slot) = contact.gap.size() > 0 ? contact.gap(row) : 0;
  });
}

double RankRows::measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) {
  system_.multiply(u, unbalanced);
  const double energy = system_.energy(u, unbalanced);
  unbalanced = system_.b() - unbalanced;
  return energy;
}

GmresResult RankRows::solve(Eigen::VectorXd r, const GmresOptions& options, Eigen::VectorXd& x) {
  system_.reduce(r);
  x.setZero(r.size());
  GmresResult result;
  result.norm = norm(r);
  if (!(result.norm > 0) || !std::isfinite(result.norm)) return result;
  const bool slips = std::ranges::any_of(system_.laws(), [](auto& law) { return law.ratio != 0; });
  const KSP ksp = slips ? slipping_ : symmetric_;
  const double tolerance = options.enough > 0
                               ? std::clamp(options.enough / result.norm, options.tolerance, 0.5)
                               : options.tolerance;
  PetscInt most = 0, iterations = 0, length = 0;
  check(KSPGetTolerances(ksp, nullptr, nullptr, nullptr, &most));
  check(KSPSetTolerances(ksp, tolerance, 0, PETSC_DEFAULT, most));
  check(KSPSolve(ksp, as_vec(r), as_vec(x)));
  check(KSPGetIterationNumber(ksp, &iterations));
  result.iterations = static_cast<int>(iterations);
  KSPConvergedReason reason;
  check(KSPGetConvergedReason(ksp, &reason));
  if (reason < 0 && reason != KSP_DIVERGED_ITS) {
    x.setZero();
    return result;
  }
  PetscReal last = 0;
  const PetscReal* history = nullptr;
  check(KSPGetResidualNorm(ksp, &last));
  check(KSPGetResidualHistory(ksp, &history, &length));
  if (length > 0 && history[0] > 0) result.reduction = last / history[0];
  return result;
}

double RankRows::error_left(const GmresResult& solve, const Eigen::VectorXd& r, bool measured) {
  if (!measured) return condition * solve.reduction * solve.norm;
  Eigen::VectorXd reduced = r;
  system_.reduce(reduced);
  return condition * norm(reduced);
}

double RankRows::norm_from_below(const Eigen::VectorXd& F_C) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(slots());
  system_.visit_contact([&](int row, PetscInt slot) { forces(slot) = F_C(row); });
  return norm(forces);
}

double RankRows::norm(const Eigen::VectorXd& r) {
  const Eigen::VectorXd z = Eigen::VectorXd::Zero(r.size());
  check(PCApply(preconditioner_of(symmetric_), as_vec(r), as_vec(z)));
  return std::sqrt(std::abs(dot(r, z)));
}

}  // namespace airybench
