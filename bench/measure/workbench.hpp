// One problem, a mesh under a scene: its blocks, and the measurement of methods on them. examine()
// has the order of a case's detail run. Separate runs of the same solve measure memory and time, so
// that none disturbs the others; of a long solve one run gives all.
#pragma once

#include "bench/measure/judge.hpp"
#include "solvers/methods.hpp"

namespace airybench {

// What a method needs.
struct AssembledBlocks {
  // With the loads of the path's first or last step; null if there is no body.
  std::unique_ptr<ContactSystem> system;
  std::shared_ptr<const Problem> first;  // of the path's first step; of some methods with chords
  std::vector<double> assembly_samples_s;
  std::int64_t heap_bytes = 0;  // that they hold; 0 without the heap probe
};
// Methods with the same key share their blocks: those of an AirySystem or not, of chords or not,
// and the degree of the stresses.
using BlocksKey = std::tuple<bool, bool, int>;
inline BlocksKey blocks_key(const Method& method) {
  return {method.unknowns == Unknowns::airy_function, method.takes_chords(), method.degree};
}

class Workbench {
 public:
  // common: what the problem's cases are all asked (Judge). limits must outlive the object.
  Workbench(PosedProblem problem, const CaseSettings& common, const Limits& limits,
            const LeftOut& left_out = {});

  void show_on(ActivityBoard* board);
  void prepare(const Method& method);

  // What is run: with the parameters and the tolerance that were found.
  struct Choice {
    Solve solve;
    SolveContact solve_contact = {};
    CaseSettings settings = {};
  };
  struct Examination {
    CaseResult result;
    Choice choice;
  };
  // Repeats an iterative method with tighter tolerances until its own error estimate is below the
  // target; the judge has no say in that. fields: file for the solution's fields, or empty.
  Examination examine(const Case& asked, const std::filesystem::path& fields);
  void measure_memory(const Method& method, const Choice& choice, CaseResult& result);
  TimedRun measure_time(const Method& method, const Choice& choice);

 private:
  struct Run {
    Solution solution;
    double time_s = 0;
    Memory memory;
    std::vector<JudgedStep> judged;  // if asked for; of a path every step that it reached
  };
  const AssembledBlocks& blocks(const Method& method);
  AssembledBlocks assemble_and_measure(const Method& method) const;
  RunControl control_of(const CaseSettings& settings, Activity what) const;
  Run solve(const Choice& choice, const AssembledBlocks& blocks, Activity what);
  Choice choose(const Case& asked, const AssembledBlocks& blocks, Search& search);
  // Returns the run that meets the target, or the last; sets the choice's tolerance to match.
  Run tighten(const AssembledBlocks& assembled, Choice& choice, Search& search);
  Search::Attempt attempt_of(const Choice& choice, const AssembledBlocks& blocks, Run& run);
  void verify_run(const AssembledBlocks& blocks, Run& run);  // unless it is done
  // Those of load steps by one more run, which is not measured.
  void write_fields(const Case& asked, const Choice& choice, const AssembledBlocks& blocks,
                    CaseResult& result, const std::filesystem::path& file);
  static TimedRun timed(const Run& run);

  PosedProblem posed_;
  std::shared_ptr<const Problem> problem_;                   // null: there is no body
  std::shared_ptr<const contact::Problem> contact_problem_;  // null if there is a body
  const Limits& limits_;
  Judge judge_;
  ActivityBoard* board_ = nullptr;
  std::map<BlocksKey, AssembledBlocks> blocks_;
};

}  // namespace airybench
