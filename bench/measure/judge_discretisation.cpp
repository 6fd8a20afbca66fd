// A Judge's discretisation errors, and the fields that have them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "assembly/curved_traces.hpp"
#include "bench/measure/field_files.hpp"
#include "bench/measure/judge.hpp"
#include "bench/records/summary.hpp"
#include "solvers/methods.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench {

std::optional<Judge::Bound> Judge::bound_for(const Method& method) const {
  if (method.takes_chords()) return {};  // it has its own
  if (method.in_displacements()) return Bound::displacement;
  // P2's displacements are those of a body with curves, stresses of degree 1 of one with chords.
  const bool by_displacements =
      common_.total_error_by_displacements && method.degree == 1 && problem_->round.empty();
  return by_displacements ? Bound::displacement : Bound::recovery;
}

int Judge::degree_of_stresses(Bound bound, int degree) const {
  const bool on_curves = bound == Bound::displacement && !problem_->round.empty();
  return on_curves ? std::max(degree, 2) : degree;
}

bool Judge::wants_intervals(int degree) const { return degree > 1 || common_.intervals; }

const Judge::Discretisation* Judge::discretisation(Bound bound, int degree) {
  const auto [found, is_new] = discretisation_.try_emplace({bound, degree});
  const int of_stresses = degree_of_stresses(bound, degree);
  // Stresses of many contact points are at hand all the same.
  const bool has_stresses = reference(of_stresses) != nullptr ||
                            (bound == Bound::recovery && problem_ && no_references_.empty() &&
                             mesh_sizes(problem_->mesh).n_phi <= largest_with_reference &&
                             has_too_many_contact_points(of_stresses));
  if (is_new && has_stresses && discretisation_left_out_.empty())
    found->second = compute_discretisation(bound, degree);
  return found->second ? &*found->second : nullptr;
}

namespace {

StepMeshError bounds(const ConstitutiveError& error) {
  StepMeshError step;
  if (error.guaranteed) {
    step.lower_bound_Nmm = error.lower_bound_Nmm;
    step.upper_bound_Nmm = error.upper_bound_Nmm;
  }
  return step;
}

// last: of the last load step.
void complete(const ConstitutiveError& last, DiscretisationError& result) {
  const TotalError& total = result.total;
  for (int k = 0; k < total.steps(); ++k)
    result.of_steps[static_cast<std::size_t>(k)].error_discretisation = total.of_mesh(k);
  if (total.of_mesh(total.steps() - 1)) result.relative_of_mean = last.relative_of_mean;
}

void add_intervals(const ContactIntervals& intervals, StepMeshError& step) {
  if (const auto& normal = intervals.normal_resultant_N) {
    step.normal_resultant_low_N = normal->low;
    step.normal_resultant_high_N = normal->high;
  }
  if (const auto& tangential = intervals.tangential_resultant_N) {
    step.tangential_resultant_low_N = tangential->low;
    step.tangential_resultant_high_N = tangential->high;
  }
}

struct SolvedDisplacement {
  DisplacementField u;
  Eigen::VectorXd free_motion_mm;
};

// Of P2, P3, ... by load step, as far as they are solved, written in polynomials of `elevated_to`.
std::vector<SolvedDisplacement> solved_displacements(const std::shared_ptr<const Problem>& problem,
                                                     int degree, int elevated_to) {
  std::vector<SolvedDisplacement> of_steps;
  solve_load_steps(
      select_methods(displacements_of_degree(degree)).front(), problem, {},
      [&](int, const ContactSystem&, const Solution& answer) {
        if (answer.status == Status::ok)
          of_steps.push_back(
              {elevated(*problem, std::get<Displacements>(answer.unknowns).w, elevated_to),
               answer.free_motion_mm});
      });
  return of_steps;
}

// Of displacements, made admissible where they are not.
std::pair<ConstitutiveError, DisplacementField> error_if_admissible(const ContactSystem& system,
                                                                    const Solution& reference,
                                                                    const DisplacementField& u) {
  ConstitutiveError error = constitutive_error(system, reference.stress, reference.F_C, u);
  const bool all_straight = CurvedTraces(*system.problem, displacement_degree(*system.problem, u),
                                         sides_of_stresses(system.degree))
                                .empty();
  if (error.flaw.empty() && all_straight) return {std::move(error), u};
  // They meet the law only at nodes (at a corner of two walls with the mean normal), and may
  // penetrate a wall in between; and P2's may leave u0 and the wall between its nodes on a curve.
  DisplacementField behind = admissible_displacement(system, reference.F_C, u);
  ConstitutiveError of_it = constitutive_error(system, reference.stress, reference.F_C, behind);
  if (of_it.flaw.empty()) return {std::move(of_it), std::move(behind)};
  return {std::move(error), u};
}

}  // namespace

Solve Judge::references_one_by_one(int degree) {
  return [this, degree, step = 0](const ContactSystem&, const RunControl&) mutable {
    return answer_of(*reference(degree, step++));
  };
}

Solve Judge::stresses_of_bound(Bound bound, int degree) {
  if (bound == Bound::displacement) return references_one_by_one(degree);
  const Method method = select_methods(common_.stresses_by).front();
  return method.degree == degree ? method.solve
                                 : select_methods(hybrid_of_degree(degree)).front().solve;
}

// Each step's system measures slip from the stresses' own past.
std::optional<Judge::Discretisation> Judge::compute_discretisation(Bound bound, int degree) {
  const ActivityScope scope(board_, Activity::discretisation);
  const bool by_displacements = bound == Bound::displacement;
  const int of_stresses = degree_of_stresses(bound, degree);
  const std::vector<SolvedDisplacement> solved_u =
      by_displacements ? solved_displacements(problem_, degree + 1, of_stresses + 1)
                       : std::vector<SolvedDisplacement>();
  if (by_displacements && std::ssize(solved_u) < count_of_steps(*problem_)) return {};
  Discretisation found;
  DiscretisationError& result = found.result;
  ConstitutiveError& error = found.error;
  DisplacementField& u = found.u;
  result.by = by_displacements ? displacements_of_degree(degree + 1) : "recovery";
  std::optional<ResultantLifts> lifts;
  std::shared_ptr<const Problem> lifted;
  ContactSystem system = contact_system(problem_, of_stresses);
  solve_load_steps(
      stresses_of_bound(bound, of_stresses), system, {},
      [&](int step, const ContactSystem& posed, const Solution& own) {
        if (own.status != Status::ok) return;
        if (by_displacements) {
          const SolvedDisplacement& solved = solved_u[static_cast<std::size_t>(step)];
          std::optional<ContactSystem> moved;  // as these displacements, where a body is free to
          if (solved.free_motion_mm.size() > 0)
            moved.emplace(posed).set_load_case(std::make_shared<const Problem>(
                with_free_motion(*posed.problem, solved.free_motion_mm)));
          std::tie(error, u) = error_if_admissible(moved ? *moved : posed, own, solved.u);
        } else {
          u = recovered_displacement(posed, own);
          error = constitutive_error(posed, own.stress, own.F_C, u);
        }
        result.total.add(
            error, prefix_of(step),
            by_displacements ? TotalError::Of::displacements : TotalError::Of::stresses);
        result.of_steps.push_back(bounds(error));
        result.intervals.reset();
        if (by_displacements || !error.flaw.empty() || !wants_intervals(degree)) return;
        if (!lifts || !same_supports(*problem_, lifted->loads, posed.problem->loads)) {
          lifted = posed.problem;
          lifts = resultant_lifts(*lifted, degree);
        }
        result.intervals = contact_intervals(posed, own.stress, own.F_C, u, error, *lifts);
        if (result.intervals) add_intervals(*result.intervals, result.of_steps.back());
      });
  if (result.total.steps() < count_of_steps(*problem_)) return {};
  complete(error, result);
  return found;
}

DiscretisationError Judge::total_error_of_program(const std::vector<JudgedStep>& steps) {
  DiscretisationError result;
  if (std::ssize(steps) < count_of_steps(*problem_)) return result;
  result.by = "its own displacements";
  ConstitutiveError error;
  ContactSystem system = contact_system(problem_);
  solve_load_steps(references_one_by_one(1), system, {},
                   [&](int step, const ContactSystem& posed, const Solution& own) {
                     const DisplacementField& u =
                         steps[static_cast<std::size_t>(step)].displacement;
                     error = constitutive_error(posed, own.stress, own.F_C,
                                                admissible_displacement(posed, own.F_C, u));
                     result.total.add(error, prefix_of(step), TotalError::Of::displacements);
                     result.of_steps.push_back(bounds(error));
                   });
  complete(error, result);
  return result;
}

DiscretisationError Judge::discretisation_error(const Method& method, bool is_other_solution) {
  DiscretisationError result;
  const std::optional<Bound> bound = bound_for(method);
  const Discretisation* known = bound ? discretisation(*bound, method.degree) : nullptr;
  if (is_other_solution) {
    result.missing = "it is known for the reference's solution only";
  } else if (known != nullptr) {
    result = known->result;
  } else if (method.in_displacements()) {
    const std::string& missing = references(degree_of_stresses(*bound, method.degree)).missing;
    result.missing = !missing.empty()                   ? missing
                     : discretisation_left_out_.empty() ? method.name + " has no answer"
                                                        : discretisation_left_out_;
  }
  return result;
}

int Judge::halvings(int degree) {
  constexpr int eight_steps = 3;
  constexpr Eigen::Index max_contact_unknowns = 2000;  // eight solves of more take minutes
  if (!problem_ || !problem_->has_friction() || reference(degree) == nullptr ||
      !discretisation_left_out_.empty())
    return 0;
  if (count_of_steps(*problem_) > 1) return 1;
  const Reference& known = *reference(degree);
  if (!common_.in_eight_steps || known.F_C.size() > max_contact_unknowns) return 0;
  const ContactPoints& points = known.condensed.points;
  const std::vector<ContactState> states = contact_states(points, known.F_C);
  for (int p = 0; p < points.count; ++p)  // where there is no friction, slip has no past
    if (states[p] == ContactState::slip && points.friction_at(p) > 0) return eight_steps;
  return 0;
}

const FinerPath* Judge::finer_path(int degree) {
  const int times = halvings(degree);
  if (times == 0) return nullptr;
  const auto [found, is_new] = finer_paths_.try_emplace(degree);
  if (is_new) {
    const ActivityScope scope(board_, Activity::discretisation);
    found->second = path_in_parts(*problem_, degree, times);
  }
  return &found->second;
}

// A total error of 100 % and more. Where bodies miss each other on the mesh it is 1 up to rounding.
static bool is_all_error(const std::optional<double>& error) {
  return error && !(*error < 1 - 1e-9);  // NaN: nothing is known
}

Verdict Judge::judge_total_error(const Method& method, Verdict so_far,
                                 const CaseResult& result) const {
  // By which a contact law's normal may turn where a face slides; beyond, small displacements do
  // not hold, whatever the method.
  constexpr double max_slide_turn = 0.1;
  const TotalError& total = result.of_mesh.total;
  if (const std::optional<double> error = total.of_mesh(); is_all_error(error))
    return {Status::inaccurate,
            prefix_of(*total.largest_step()) +
                (std::isinf(*error) ? "it has stress, and the reference has none"
                                    : fmt::format("its total error is {:.0f} %: nothing of it is "
                                                  "known",
                                                  100 * *error))};
  if (const Sliding& slid = total.sliding(); slid.turn > max_slide_turn)
    return {
        Status::inaccurate,
        fmt::format("a face slides {:.3g} mm along another, whose normal turns by {:.2g}° on the "
                    "way: small displacements, which all of this assumes, do not hold",
                    slid.mm, slid.turn * 180 / std::numbers::pi)};
  else if (slid.edges > 1)
    so_far.add(
        fmt::format("a face slides up to {:.3g} mm along another, farther than an edge is "
                    "long: it presses on what faced it at first",
                    slid.mm));
  if (method.in_displacements() && !total.of_mesh() && so_far.reason.empty())
    so_far.add("its total error is not known: " +
               (total.flaw().empty() ? result.of_mesh.missing : total.flaw()));
  return so_far;
}

void Judge::write_fields_of(const Method& method, const ContactSystem& system,
                            const Solution& solution, bool is_other_solution,
                            const std::filesystem::path& file) {
  const std::optional<Bound> bound = bound_for(method);
  const Discretisation* known =
      bound && !is_other_solution ? discretisation(*bound, method.degree) : nullptr;
  SolvedFields fields = own_fields(system, solution);
  fields.picture = common_.picture;
  fields.points_mm = common_.points_mm;
  if (!fields.w && known != nullptr && known->u.allFinite()) fields.w = known->u;
  if (known != nullptr && known->error.flaw.empty()) {
    fields.error = &known->error;
    if (known->result.intervals) fields.intervals = &*known->result.intervals;
    if (common_.mean_fields)
      fields.mean = mean_stress(
          *problem_,
          method.in_displacements()
              ? references(degree_of_stresses(*bound, method.degree)).steps.back().stress
              : solution.stress,
          known->u);
  }
  write_fields(file.parent_path(), file.filename(), fields);
}

}  // namespace airybench
