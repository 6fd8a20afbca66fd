// One mesh under one scene: its blocks, its reference, and the measuring of methods on them.
//
// Detail (errors, counts, histories), memory and time are taken in separate runs of the same solve,
// so that none disturbs the others. Of a long solve the detail run is the other two as well.
#pragma once

#include <map>
#include <memory>

#include "bench/measure/activity_board.hpp"
#include "bench/measure/load_step_runs.hpp"
#include "bench/measure/record_notes.hpp"
#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "solvers/methods.hpp"

namespace airybench {

// Parts that broke the process that tried them, and are not to be tried again; the text says how.
struct LeftOut {
  std::map<Blocks, std::string> blocks;
  std::string reference, discretisation;
};

class Workbench {
 public:
  Workbench(PosedProblem problem, const Options& options, LeftOut left_out = {});

  // The discretisation error of the reference's stresses against the displacements of P2, or of the
  // stresses of adapt_by against displacements recovered from them.
  enum class Bound { p2, recovery };

  void show_on(ActivityBoard* board) { board_ = board; }  // what it does from now on
  // Blocks, reference, and what else cases of this method share.
  void prepare(const Method& method);

  // How a method is run on this problem, found in its detail run.
  struct Choice {
    Solve solve;
    double tolerance = 0;
    SolveContact solve_contact = {};
  };
  struct Examination {
    Record record;
    Choice choice;
  };
  // A record with the sizes, assembly figures and the detail run's verdict: status, errors, counts.
  // An iterative method is run again with a tighter tolerance until by its own estimate its error
  // is below the target; the verifier has no say in that. fields: where to write the solution's
  // fields, or empty.
  Examination examine(const Method& method, const std::filesystem::path& fields);
  // What another's program left of itself in the last detail run; empty: nothing.
  const std::string& program_log() const { return program_log_; }
  // The memory run: heap and resident set at their peak during one solve.
  void measure_memory(const Method& method, const Choice& choice, Record& record);
  TimedRun measure_time(const Method& method, const Choice& choice);

 private:
  // A solve and what it took.
  struct Run {
    Solution solution;
    double time_s = 0;
    std::optional<std::int64_t> peak_heap_bytes, peak_rss_bytes, instructions;
    std::optional<MemorySplit> memory;
    std::vector<JudgedStep> judged;  // where asked for; of a path every step, as far as it went
  };
  const AssembledBlocks& blocks(Blocks which);
  bool is_too_large_for_reference() const;
  double reference_error_at_most() const;
  const Reference* reference(int step = 0);  // null: there is none, and no_reference_ says why
  Run solve(const Choice& choice, const AssembledBlocks& blocks, Activity what);
  Choice choose(const Method& method, const AssembledBlocks& blocks, Record& record);
  // The run that meets the target, or the last that was tried; the choice has its tolerance.
  Run tighten(const Method& method, const AssembledBlocks& assembled, Choice& choice,
              Record& record);
  void note_attempt(const Choice& choice, const AssembledBlocks& blocks, Run& run, Record& record);
  bool is_answered(const Solution& solution) const;  // there is something to judge
  JudgedStep judged(int step, const DualSystem& system, const Solution& solution);
  void verify_run(const AssembledBlocks& blocks, Run& run);  // unless it is
  // Against the solution that is nearest to it, where that is none of the reference's.
  std::optional<Verification> verify_as_other_solution(const DualSystem& system,
                                                       const Solution& solution,
                                                       const Verification& v);
  // Sets what the verifier decides, from a run that is verified.
  void judge(const Method& method, const Run& run, Record& record);
  static void note_memory(const Run& run, Record& record);
  static TimedRun timed(const Run& run);

  struct Discretisation {  // of the last load step
    ConstitutiveError error;
    DisplacementField u;
    std::optional<ContactIntervals> intervals;  // of recovery, where the error is one
    Json of_steps = Json::array();              // into Record::steps
  };
  // The displacements that the discretisation error of the method's record is made with.
  std::optional<Bound> bound_for(const Method& method) const;
  const Discretisation* discretisation(Bound bound);  // null: stresses or displacements are missing
  std::optional<Discretisation> compute_discretisation(Bound bound);
  void note_discretisation(const Method& method, const Solution& solution, Record& record);
  // Of another's displacements, made admissible.
  void note_error_of_displacement(const Solution& solution, Record& record);
  // Nothing above 100 % is ok; the reason is given where a case has no other error than this one.
  static void judge_discretisation(const Method& method, Record& record);
  // How far a path with friction is from one with twice the steps; null: there is no such path, or
  // no reference.
  const Json* half_steps();
  void note_half_steps(Record& record);
  void write_fields_of(const Method& method, const DualSystem& system, const Solution& solution,
                       const Record& record, const std::filesystem::path& file);

  std::string prefix_of(std::size_t step) const;  // step_prefix()

  PosedProblem posed_;
  std::shared_ptr<const Problem> problem_;                   // null: there is no body
  std::shared_ptr<const contact::Problem> contact_problem_;  // null: there is one
  const Options& options_;
  LeftOut left_out_;
  ActivityBoard* board_ = nullptr;
  std::map<Blocks, AssembledBlocks> blocks_;
  std::vector<Reference> references_;  // of all steps
  std::string no_reference_;
  std::string program_log_;
  std::map<Bound, std::optional<Discretisation>> discretisation_;
  std::optional<Json> steps_in_halves_;
};

}  // namespace airybench
