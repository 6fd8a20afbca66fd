// One mesh under one scene: its blocks, its reference, and the measurement of methods on them.
// Separate runs of the same solve give details (errors, counts, histories), memory and time, so
// that none disturbs the others; of a long solve one run gives all.
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

// Parts that broke a process and are not tried again; the text says how.
struct LeftOut {
  std::map<Blocks, std::string> blocks;
  std::string reference, discretisation;
};

class Workbench {
 public:
  Workbench(PosedProblem problem, const Options& options, LeftOut left_out = {});

  // Discretisation error of the reference's stresses with P2's displacements, or of adapt_by's
  // stresses with displacements recovered from them.
  enum class Bound { p2, recovery };

  void show_on(ActivityBoard* board) { board_ = board; }
  void prepare(const Method& method);

  struct Choice {
    Solve solve;
    double tolerance = 0;
    SolveContact solve_contact = {};
  };
  struct Examination {
    Record record;
    Choice choice;
  };
  // Repeats an iterative method with tighter tolerances until its own error estimate is below the
  // target; the verifier has no say in that. fields: file for the solution's fields, or empty.
  Examination examine(const Method& method, const std::filesystem::path& fields);
  // Of an external program in the last detail run; may be empty.
  const std::string& program_log() const { return program_log_; }
  void measure_memory(const Method& method, const Choice& choice, Record& record);
  TimedRun measure_time(const Method& method, const Choice& choice);

 private:
  struct Run {
    Solution solution;
    double time_s = 0;
    std::optional<std::int64_t> peak_heap_bytes, peak_rss_bytes, instructions;
    std::optional<MemorySplit> memory;
    std::vector<JudgedStep> judged;  // if asked for; of a path every step that it reached
  };
  const AssembledBlocks& blocks(Blocks which);
  bool is_too_large_for_reference() const;
  double reference_error_at_most() const;
  const Reference* reference(int step = 0);  // null: there is none, and no_reference_ says why
  Run solve(const Choice& choice, const AssembledBlocks& blocks, Activity what);
  Choice choose(const Method& method, const AssembledBlocks& blocks, Record& record);
  // Returns the run that meets the target, or the last; sets choice.tolerance to match.
  Run tighten(const Method& method, const AssembledBlocks& assembled, Choice& choice,
              Record& record);
  void note_attempt(const Choice& choice, const AssembledBlocks& blocks, Run& run, Record& record);
  bool is_answered(const Solution& solution) const;  // there is something to judge
  JudgedStep judged(int step, const DualSystem& system, const Solution& solution);
  void verify_run(const AssembledBlocks& blocks, Run& run);  // unless it is done
  // Against the nearest solution, if that is not the reference's.
  std::optional<Verification> verify_as_other_solution(const DualSystem& system,
                                                       const Solution& solution,
                                                       const Verification& v);
  void judge(const Method& method, const Run& run, Record& record);
  static void note_memory(const Run& run, Record& record);
  static TimedRun timed(const Run& run);

  struct Discretisation {  // of the last load step
    ConstitutiveError error;
    DisplacementField u;
    std::optional<ContactIntervals> intervals;  // for recovery, if the error is valid
    Json of_steps = Json::array();              // merged into Record::steps
  };
  std::optional<Bound> bound_for(const Method& method) const;
  const Discretisation* discretisation(Bound bound);  // null: stresses or displacements are missing
  std::optional<Discretisation> compute_discretisation(Bound bound);
  void note_discretisation(const Method& method, const Solution& solution, Record& record);
  // For an external program: its displacements, made admissible.
  void note_error_of_displacement(const Solution& solution, Record& record);
  // An error above 100 % is not ok. Gives a reason if a displacement method has no error.
  static void judge_discretisation(const Method& method, Record& record);
  // A path with friction in twice as many steps; null without such a path or a reference.
  const Json* half_steps();
  void note_half_steps(Record& record);
  void write_fields_of(const Method& method, const DualSystem& system, const Solution& solution,
                       const Record& record, const std::filesystem::path& file);

  std::string prefix_of(std::size_t step) const;  // step_prefix()

  PosedProblem posed_;
  std::shared_ptr<const Problem> problem_;                   // null: there is no body
  std::shared_ptr<const contact::Problem> contact_problem_;  // null if there is a body
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
