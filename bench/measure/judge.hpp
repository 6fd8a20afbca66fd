// Judges answers to one problem: by the contact law, against a reference, and by the discretisation
// error of the reference. Each is computed when first needed.
#pragma once

#include <map>
#include <memory>

#include "bench/measure/activity_board.hpp"
#include "bench/measure/case_result.hpp"

namespace airybench {

// Parts that broke a process and are not tried again; the text says how.
struct LeftOut {
  std::string reference, discretisation;
};

class Judge {
 public:
  // common: of the problem's cases; what they share decides on reference and total error.
  Judge(const PosedProblem& problem, const CaseSettings& common, const LeftOut& left_out);

  void show_on(ActivityBoard* board) { board_ = board; }
  void prepare(const Method& method);

  bool is_answered(const Solution& solution) const;  // there is something to judge
  // system: null without a body.
  bool knows_errors(const ContactSystem* system) {
    return contact_problem_ || reference(system->degree) != nullptr;
  }
  // before: the steps of the path up to this one.
  JudgedStep judged(const std::vector<JudgedStep>& before, const ContactSystem& system,
                    const Solution& solution);
  JudgedStep judged(const ContactSystem* system, const Solution& solution);  // without a path
  // Of what was solved: its solution and steps. Fills its errors.
  Verdict judge(const Case& asked, CaseResult& result);
  void write_fields_of(const Method& method, const ContactSystem& system, const Solution& solution,
                       bool is_other_solution, const std::filesystem::path& file);

 private:
  // Discretisation error of the reference's stresses with the displacements of P2, P3, …, one
  // degree more than theirs, or of the stresses of CaseSettings::stresses_by or, for another
  // degree, HYBRID with displacements recovered from them.
  enum class Bound { displacement, recovery };
  struct Discretisation {
    DiscretisationError result;  // intervals: of recovery
    ConstitutiveError error;     // of the last load step, as u
    DisplacementField u;
  };

  std::string too_large_for_reference(int degree) const;  // empty: it is not
  bool has_too_many_contact_points(int degree) const;     // for a reference
  double reference_error_at_most() const { return common_.target_error / 10; }
  // References belong to a degree of the stresses.
  const ReferencePath& references(int degree);
  const Reference* reference(int degree, int step = 0);  // null: references().missing says why
  // Gives the references' answers, step by step; they must be there.
  Solve references_one_by_one(int degree);
  std::string prefix_of(std::int64_t step) const {
    return problem_ ? step_prefix(step, *problem_) : "";
  }
  // Against the nearest solution, if that is not the reference's. start_off_N: how far slip is off
  // from which the step starts, Verification::slip_off_N.
  std::optional<Verification> verify_as_other_solution(const ContactSystem& system,
                                                       const Solution& solution,
                                                       const Verification& v, double start_off_N);
  void take_eight_steps(const FinerPath& path, const Method& method, CaseResult& result) const;
  // Each is asked of an answer that is ok so far.
  Verdict judge_method_error(const Case& asked, Verdict so_far, CaseResult& result);
  // Of an external program: through the wall by more than it is allowed is inaccurate.
  Verdict judge_penetration(const std::vector<JudgedStep>& steps, double allowed,
                            Verdict so_far) const;
  // An error of 100 % is not ok.
  Verdict judge_total_error(const Method& method, Verdict so_far, const CaseResult& result) const;

  std::optional<Bound> bound_for(const Method& method) const;  // none: it has its own
  // Of the stresses that an error is relative to: displacements of a body with curves have none of
  // degree 1.
  int degree_of_stresses(Bound bound, int degree) const;
  bool wants_intervals(int degree) const;
  // Null: stresses or displacements are missing.
  const Discretisation* discretisation(Bound bound, int degree);
  Solve stresses_of_bound(Bound bound, int degree);
  std::optional<Discretisation> compute_discretisation(Bound bound, int degree);
  DiscretisationError discretisation_error(const Method& method, bool is_other_solution);
  // For an external program with references: its displacements, made admissible.
  DiscretisationError total_error_of_program(const std::vector<JudgedStep>& steps);
  // The steps of a path with friction, each in so many halves of halves; a load case is a path
  // where CaseSettings::in_eight_steps asks for it, and faces slip. 0: not halved, as without a
  // reference.
  int halvings(int degree);
  const FinerPath* finer_path(int degree);  // null: not halved

  std::shared_ptr<const Problem> problem_;                   // null: there is no body
  std::shared_ptr<const contact::Problem> contact_problem_;  // null if there is a body
  const CaseSettings common_;
  std::string discretisation_left_out_;
  ActivityBoard* board_ = nullptr;
  std::string no_references_;  // why; empty: they can be had
  std::map<int, ReferencePath> references_;
  std::map<std::pair<Bound, int>, std::optional<Discretisation>> discretisation_;
  std::map<int, FinerPath> finer_paths_;  // by degree
};

}  // namespace airybench
