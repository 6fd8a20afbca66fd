#include "solvers/condensation/finish.hpp"

namespace airybench {
namespace {

void finish(const CondensedSystem& condensed, const ContactPoints& contact,
            const RunControl& control, const std::function<void()>& recover,
            const std::function<void()>& check, Solution& solution) {
  solution.storage[MemoryOwner::condensed] = condensed.bytes();
  solve_condensed_contact(condensed, contact, control, solution);
  {
    const StageTimer timer(solution.times, Stage::recover);
    recover();
  }
  run_stage(solution.times, Stage::check, MemoryOwner::check, check);
}

}  // namespace

void store_airy_answer(const DualSystem& system, const Eigen::VectorXd& x, Solution& solution) {
  const OwnerScope scope(MemoryOwner::answer);
  solution.phi = airy_function(system, x);
  solution.stress = stress_of_airy_function(*system.problem, solution.phi);
}

void finish_in_airy_function(const DualSystem& system, const RunControl& control,
                             const CondensedSystem& condensed,
                             const std::function<SaddleVector(const Eigen::VectorXd& F_C)>& recover,
                             const SaddleSolve& solve, Refine refine, Solution& solution) {
  SaddleVector answer;
  finish(
      condensed, system.contact, control,
      [&] {
        answer = recover(solution.F_C);
        store_airy_answer(system, answer.x, solution);
      },
      [&] {
        if (refine == Refine::yes)
          refine_airy_answer(system, condensed.D, solve, answer, control, solution);
        else
          check_airy_answer(system, condensed.D, solve, answer, control, solution);
      },
      solution);
}

void finish_in_displacements(const Problem& problem, const ContactPoints& contact,
                             const RunControl& control, const CondensedSystem& condensed,
                             StiffnessFactor& factor,
                             const std::function<void(Eigen::VectorXd u)>& recover,
                             const std::function<UnbalancedForces()>& unbalanced,
                             Solution& solution) {
  Eigen::VectorXd u_C;
  finish(
      condensed, contact, control,
      [&] {
        if (contact.size() > 0) u_C = condensed.D * solution.F_C - condensed.G;
        Eigen::VectorXd u = all_displacements(factor, u_C);
        const OwnerScope scope(MemoryOwner::answer);
        recover(std::move(u));
      },
      [&] {
        check_stiffness_answer(problem, contact, condensed, unbalanced(), u_C, factor, control,
                               solution);
      },
      solution);
}

}  // namespace airybench
