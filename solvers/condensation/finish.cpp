#include "solvers/condensation/finish.hpp"

#include "solvers/base/dense_products.hpp"
#include "solvers/base/kept_body.hpp"
#include "solvers/contact/free_body_contact.hpp"

namespace airybench {
namespace {

void finish(contact::Problem& condensed, const RunControl& control,
            const std::function<void()>& recover, const std::function<void()>& check,
            Solution& solution) {
  solution.storage[MemoryOwner::condensed] = condensed.bytes();
  solve_condensed_contact(condensed, control, solution);
  if (solution.free_motion_mm.size() > 0)
    condensed.points = with_known_motion(condensed.points, solution.free_motion_mm);
  {
    const StageTimer timer(solution.times, Stage::recover);
    recover();
  }
  run_stage(solution.times, Stage::check, MemoryOwner::check, check);
}

// Whatever the load case says of b, all of it.
SaddleVector load_of(const AirySystem& system, const Eigen::VectorXd& F_C) {
  const auto or_zero = [](const Eigen::VectorXd& v, int size) {
    return v.size() > 0 ? v : Eigen::VectorXd(Eigen::VectorXd::Zero(size));
  };
  SaddleVector load{or_zero(system.q, system.n()), or_zero(system.F, system.n_f()),
                    or_zero(F_C, system.n_c())};
  if (system.F0.size() > 0) load.lambda_C -= system.F0;
  return load;
}

// What other load cases in the Airy function need.
struct KeptAiryBody {
  contact::Problem condensed;
  BodySolve solve;
  Refine refine;
  std::shared_ptr<const void> owner;  // of what `solve` refers to
};

Solution solve_load_case(KeptAiryBody& body, const AirySystem& system, const RunControl& control) {
  const auto solved = [&](const Eigen::VectorXd& F_C) {
    SaddleVector v = load_of(system, F_C);
    body.solve(system, v);
    return v;
  };
  Solution solution;
  if (system.n_c() > 0)
    run_stage(solution.times, Stage::contact, MemoryOwner::condensed, [&] {
      body.condensed.points = system.contact;
      body.condensed.G = solved({}).lambda_C;
    });
  finish_in_airy_function(system, control, body.condensed, solved, body.solve, body.refine,
                          solution);
  return solution;
}

}  // namespace

void store_airy_answer(const AirySystem& system, const Eigen::VectorXd& x, Solution& solution) {
  const OwnerScope scope(MemoryOwner::answer);
  Eigen::VectorXd phi = airy_function(system, x);
  solution.stress = stress_of_airy_function(*system.problem, phi);
  solution.unknowns = AiryFunction{std::move(phi)};
}

void finish_in_airy_function(const AirySystem& system, const RunControl& control,
                             contact::Problem& condensed,
                             const std::function<SaddleVector(const Eigen::VectorXd& F_C)>& recover,
                             const BodySolve& solve, Refine refine, Solution& solution,
                             std::shared_ptr<const void> owner) {
  if (system.n_c() == 0) condensed.points = system.contact;  // its free motions
  const SaddleSolve solve_here = [&](SaddleVector& v) { solve(system, v); };
  SaddleVector answer;
  finish(
      condensed, control,
      [&] {
        answer = recover(solution.F_C);
        store_airy_answer(system, answer.x, solution);
        solution.contact_displacement = -answer.lambda_C;
      },
      [&] {
        if (refine == Refine::yes)
          refine_airy_answer(system, condensed, solve_here, answer, control, solution);
        else
          check_airy_answer(system, condensed, solve_here, answer, control, solution);
      },
      solution);
  if (!control.keep_body || !owner) return;
  const auto body =
      std::make_shared<KeptAiryBody>(KeptAiryBody{condensed, solve, refine, std::move(owner)});
  solution.solve_again =
      for_the_same_body(system, on_airy_system([body](const AirySystem& s, const RunControl& c) {
                          return solve_load_case(*body, s, c);
                        }));
}

void finish_in_displacements(const Problem& problem, const RunControl& control,
                             contact::Problem& condensed, StiffnessFactor& factor,
                             const std::function<void(Eigen::VectorXd u)>& recover,
                             const std::function<UnbalancedForces()>& unbalanced,
                             Solution& solution) {
  Eigen::VectorXd u_C;
  finish(
      condensed, control,
      [&] {
        if (condensed.points.size() > 0) u_C = times(condensed.D, solution.F_C) - condensed.G;
        Eigen::VectorXd u = factor.recover(solution.F_C, u_C);
        solution.contact_displacement = u_C;
        const OwnerScope scope(MemoryOwner::answer);
        recover(std::move(u));
      },
      [&] {
        check_stiffness_answer(problem, condensed, unbalanced(), u_C, factor, control, solution);
      },
      solution);
}

}  // namespace airybench
