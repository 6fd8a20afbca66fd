// HYBRID: hybridized equilibrium elements, multifrontal Cholesky. HYBRID:CHOLMOD, HYBRID:MUMPS: the
// same K by a library's factor. HYBRID:PDAS: active sets on K itself. HYBRID:k=2 and more,
// HYBRID:CHOLMOD,k=2: stresses of that degree.
#include "solvers/condensation/hybridized.hpp"

#include <utility>

#include "assembly/elements/equilibrium_element.hpp"
#include "solvers/active_sets/active_set_solve.hpp"
#include "solvers/base/method.hpp"
#include "solvers/condensation/finish.hpp"
#include "solvers/condensation/library_stiffness.hpp"
#include "solvers/condensation/stiffness_body.hpp"
#include "solvers/direct/condition.hpp"
#include "solvers/names/general_names.hpp"

namespace airybench {
namespace {

using HybridizedBody = StiffnessBody<HybridizedSystem>;

void finish_hybridized(const ContactSystem& given, const RunControl& control, HybridizedBody& body,
                       Solution& solution) {
  const Problem& problem = *given.problem;
  HybridizedAnswer answer;
  body.condensed.points = given.contact;  // the load case's
  finish_in_displacements(
      problem, control, body.condensed, *body.factor,
      [&](const Eigen::VectorXd& u) {
        answer = recover_stresses(problem, body.system, u);
        solution.stress = std::move(answer.stress);
        solution.unknowns = EdgeDisplacements{
            edge_moments(problem, body.system.unknown, body.system.displacement, u)};
      },
      [&] {
        answer.unbalanced.r.tail(body.system.n_c) += solution.F_C;
        return std::move(answer.unbalanced);
      },
      solution);
}

template <typename Factor>
Solution solve_with(const ContactSystem& given, const RunControl& control) {
  const auto body = std::make_shared<HybridizedBody>();
  HybridizedSystem& system = body->system;
  Solution solution;
  run_stage(solution.times, Stage::condense, MemoryOwner::system_matrix, [&] {
    system = assemble_hybridized(*given.problem, given.contact);
    body->factor = std::make_unique<Factor>(system.K, system.n_c);
    const bool has_its_own = body->factor->matrix_bytes() > 0;
    if (has_its_own && !control.keep_body && !control.condition) system.K = {};
  });
  solution.storage[MemoryOwner::system_matrix] = system.bytes() + body->factor->matrix_bytes();
  body->condensed = factorise_and_condense(*body->factor, system.b, given.contact,
                                           "hybridized system", control.deadline, solution);
  if (control.condition)
    solution.condition_estimate = estimate_condition(
        lower_triangle(system.K),
        [&](Eigen::Ref<Eigen::MatrixXd> X) { body->factor->solve_in_place(X, control.deadline); });
  finish_hybridized(given, control, *body, solution);
  keep_if_told(given, control, body, finish_hybridized, solution);
  return solution;
}

// Of a body with many contact points, unless something else is asked of D.
bool is_for_active_sets(const ContactSystem& given, const RunControl& control) {
  const ContactOptions& law = control.contact;
  return given.contact.free.is_empty() && control.stop == Stop::target && !control.condition &&
         law.solver == ContactSolver::newton && !law.by &&
         law.max_iterations == ContactOptions().max_iterations &&
         active_sets_cost_less_than_D(given);
}

// By active sets, or, where these do not end, by D, which later load cases keep; with what both
// took.
Solution solve_by_sets_or_D(const Solve& by_sets, const ContactSystem& given,
                            const RunControl& control, bool keeps_D) {
  Solution solution = run(by_sets, given, control);
  const bool goes_on = solution.status == Status::not_converged ||
                       solution.status == Status::inaccurate ||
                       solution.status == Status::breakdown;
  if (goes_on && given.contact.size() <= max_contact_unknowns_of_D) {
    solution.solve_again = nullptr;  // frees its K
    solution.stress = {};
    RunControl of_D = control;
    of_D.keep_body = keeps_D;
    Solution by_D = solve_with<MultifrontalStiffness>(given, of_D);
    for (const Stage stage : all_stages)
      if (const auto& before = solution.times[stage])
        by_D.times[stage] = by_D.times[stage].value_or(0) + *before;
    by_D.linear_iterations = solution.linear_iterations;
    by_D.newton_steps = by_D.newton_steps.value_or(0) + solution.newton_steps.value_or(0);
    return by_D;
  }
  if (solution.solve_again)
    solution.solve_again = [again = std::move(solution.solve_again)](const ContactSystem& load_case,
                                                                     const RunControl& of_case) {
      return solve_by_sets_or_D(again, load_case, of_case, true);
    };
  return solution;
}

Solution solve_hybrid(const ContactSystem& given, const RunControl& control) {
  return is_for_active_sets(given, control)
             ? solve_by_sets_or_D(solve_by_active_sets, given, control, control.keep_body)
             : solve_with<MultifrontalStiffness>(given, control);
}

struct Variant {
  const char* name;  // behind the colon
  const char* summary;
  Solution (*solve)(const ContactSystem&, const RunControl&);
};
constexpr Variant variants[] = {
    {"", "hybridized equilibrium elements, multifrontal Cholesky; the reference of all errors",
     solve_hybrid},
    {"CHOLMOD", "HYBRID's matrix by CHOLMOD's supernodal Cholesky", solve_with<CholmodStiffness>},
    {"MUMPS", "HYBRID's matrix by MUMPS, D from its Schur complement", solve_with<MumpsStiffness>},
    {"PDAS", "primal-dual active sets on HYBRID's matrix, factorised under each; no D",
     solve_by_active_sets}};

Method hybrid_method(const Variant& of, int degree = 1) {
  const std::string first = of.name;
  Method method = {.name = "HYBRID" + (first.empty() ? "" : ":" + first),
                   .family = "HYBRID",
                   .summary = of.summary,
                   .unknowns = Unknowns::edge_displacements,
                   .degree = degree,
                   .solve = of.solve,
                   .knob = AccuracyKnob::contact_sweeps};
  if (first == "PDAS") {
    method.stages = {Stage::precondition, Stage::contact, Stage::recover, Stage::check};
    method.knob = AccuracyKnob::none;
  }
  if (degree > 1) {
    method.name += (first.empty() ? ":k=" : ",k=") + std::to_string(degree);
    method.summary = "stresses of degree " + std::to_string(degree) + ": " + method.summary;
  }
  return method;
}

}  // namespace

Method hybrid() { return hybrid_method(variants[0]); }
Method hybrid_cholmod() { return hybrid_method(variants[1]); }
Method hybrid_mumps() { return hybrid_method(variants[2]); }
Method hybrid_pdas() { return hybrid_method(variants[3]); }

Method hybrid_of_degree(GeneralName name) {
  const int degree = name.whole("k", 1, 1, highest_stress_degree);
  name.refuse_rest("k");
  for (const Variant& of : variants)
    if (name.first() == of.name) {
      Method method = hybrid_method(of, degree);
      if (method.name != name.name()) method.general_name = std::exchange(method.name, name.name());
      return method;
    }
  name.refuse("'" + name.first() + "' (valid: CHOLMOD, MUMPS, PDAS, k=<degree>)");
}

}  // namespace airybench
