// BLIND: blind condensation with MUMPS, a solve per contact force, or D from the Schur complement
// that MUMPS leaves. BLIND:SKY: with the skyline LDLᵀ factorisation, multipliers numbered so that
// it needs no pivoting.
#include "solvers/base/dense_products.hpp"
#include "solvers/base/method.hpp"
#include "solvers/condensation/blind.hpp"
#include "solvers/direct/factor_counts.hpp"
#include "solvers/direct/mumps.hpp"
#include "solvers/direct/skyline.hpp"

namespace airybench {
namespace {

// M₁₁ and its factor, and what is condensed of them.
template <typename Factor>
struct BlindBody {
  BlindSystem blind;
  Factor factor;
  contact::Problem condensed;
};
using MumpsBody = BlindBody<MumpsFactor>;

// The last `trailing` unknowns are left to the Schur complement.
std::shared_ptr<MumpsBody> factorise(const AirySystem& system, const RunControl& control,
                                     int trailing, Solution& solution) {
  auto body = std::make_shared<MumpsBody>();
  body->blind = run_stage(solution.times, Stage::order, MemoryOwner::system_matrix, [&] {
    return make_blind_system(system, BlindNumbering::multipliers_last);
  });
  MumpsFactor& factor = body->factor;
  run_stage(solution.times, Stage::order, MemoryOwner::factor,
            [&] { factor.analyse(body->blind.lower, trailing); });
  control.deadline.check("MUMPS's analysis");
  run_stage(solution.times, Stage::factor, MemoryOwner::factor,
            [&] { factor.factor(body->blind.lower); });
  control.deadline.check("MUMPS's factorisation");
  check_inertia(factor.negative_pivots(), system.n_f() + system.n_c() - trailing);
  solution.storage[MemoryOwner::system_matrix] = body->blind.bytes();
  count_factor(factor, solution);
  return body;
}

Solution solve_blind_mumps(const AirySystem& system, const RunControl& control) {
  Solution solution;
  const std::shared_ptr<MumpsBody> body = factorise(system, control, 0, solution);
  solve_blindly(
      system, control, body->blind,
      [&factor = body->factor, deadline = control.deadline](Eigen::Ref<Eigen::MatrixXd> X) {
        factor.solve_in_place(X, deadline);
      },
      MumpsFactor::columns_at_once, solution, body);
  return solution;
}

Solution solve_blind_mumps_schur(const AirySystem& system, const RunControl& control,
                                 Refine refine) {
  const int n_c = system.n_c();
  Solution solution;
  const std::shared_ptr<MumpsBody> body = factorise(system, control, n_c, solution);
  const BlindSystem& blind = body->blind;
  MumpsFactor& factor = body->factor;
  contact::Problem& condensed = body->condensed;
  const Eigen::VectorXd load = blind_right_hand_side(system, blind, {});
  if (n_c > 0)
    condensed = run_stage(solution.times, Stage::condense, MemoryOwner::condensed, [&] {
      return condense_blindly(system.contact, factor.schur(), factor.reduce(load));
    });
  finish_in_airy_function(
      system, control, condensed,
      [&](const Eigen::VectorXd& F_C) {
        Eigen::VectorXd x = load;
        if (n_c > 0)
          x = factor.expand(condensed.G - times(condensed.D, F_C));
        else
          factor.solve_in_place(x, control.deadline);
        return by_blocks(system, blind, x);
      },
      [&blind, &factor, &condensed, deadline = control.deadline](const AirySystem& of,
                                                                 SaddleVector& v) {
        Eigen::VectorXd x = in_one(of, blind, v);
        if (of.n_c() > 0)
          x = factor.expand(-times(condensed.D, factor.reduce(x)));
        else
          factor.solve_in_place(x, deadline);
        v = by_blocks(of, blind, x);
      },
      refine, solution, body);
  return solution;
}

Solution solve_blind_skyline(const AirySystem& system, const RunControl& control) {
  Solution solution;
  const auto body = std::make_shared<BlindBody<SkylineFactor>>();
  body->blind = run_stage(solution.times, Stage::order, MemoryOwner::system_matrix, [&] {
    return make_blind_system(system, BlindNumbering::multipliers_after_unknowns);
  });
  body->factor = factor_in_stages(body->blind.lower, control.deadline, solution);
  check_inertia(static_cast<int>((body->factor.diagonal.array() < 0).count()),
                system.n_f() + system.n_c());
  solution.storage[MemoryOwner::system_matrix] = body->blind.bytes();
  solve_blindly(
      system, control, body->blind,
      [&factor = body->factor, deadline = control.deadline, threads = control.threads](
          Eigen::Ref<Eigen::MatrixXd> X) { solve_in_place(factor, X, deadline, threads); },
      skyline_columns_at_once * control.threads, solution, body);
  return solution;
}

Method blind_method(const char* name, const char* summary, SolveAiry solve) {
  return {.name = name,
          .family = "BLIND",
          .summary = summary,
          .condenses_contact_only = true,
          .solve = on_airy_system(std::move(solve))};
}

Method blind_schur_method(const char* name, const char* summary, Refine refine) {
  return blind_method(name, summary, [refine](const AirySystem& system, const RunControl& control) {
    return solve_blind_mumps_schur(system, control, refine);
  });
}

}  // namespace

Method blind() {
  Method method =
      blind_method("BLIND", "blind condensation, MUMPS indefinite LDLT", solve_blind_mumps);
  method.in_paper = true;
  return method;
}

Method blind_schur() {
  return blind_schur_method("BLIND:SCHUR", "blind condensation, D from MUMPS's Schur complement",
                            Refine::no);
}

Method blind_schur_refined() {
  return blind_schur_method("BLIND:SCHUR:REFINED",
                            "BLIND:SCHUR refined with residuals in extended precision",
                            Refine::yes);
}

Method blind_skyline() {
  return blind_method("BLIND:SKY",
                      "blind condensation, skyline LDLT, multipliers after their unknowns",
                      solve_blind_skyline);
}

}  // namespace airybench
