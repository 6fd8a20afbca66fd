// What came of a case: a plain value, whose members Workbench fills in their order, those of the
// answer's errors its Judge. The statuses of a case come from
//
//   the method          Solution::status, what it claims (solvers/base/method.hpp)
//   Judge::judge()      the last word on what the method claims
//   Workbench           what could not be assembled, a memory run that ends otherwise than the
//   first add_run()           a timed run that does IsolatedScene       a process that ended or was
//   suspended, a file of fields that cannot be
//                       written, a defect (bench/run/isolated_scene.cpp)
//   blank_record()      a case that is skipped, or did not run
//
// and to_record() alone makes the record.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure/load_step_runs.hpp"
#include "bench/measure/solve_watch.hpp"
#include "bench/plan/plan.hpp"
#include "bench/records/record.hpp"
#include "verify/contact_intervals.hpp"
#include "verify/total_error.hpp"

namespace airybench {

struct TimedRun {
  double time_s = 0;
  std::map<std::string, double> stages;  // stage → seconds
  Verdict end = {Status::crashed, "the run did not take place"};
  double runs_s = 0;                      // of all runs of the case so far
  double program_s = 0, processor_s = 0;  // of an external program, from start to end
  double program_solve_s = 0;             // of its solve, by its own clock
};
Json to_json(const TimedRun& run);
TimedRun timed_run_of(const Json& json);

// For parameters and tolerances, before the run that counts.
struct Search {
  struct Attempt {  // with a tolerance: what the method claims of it, and what the verifier finds
    double tolerance = 0;
    Status claimed_status = Status::crashed;
    std::optional<double> error_estimate, error;
  };
  std::vector<Attempt> attempts;
  std::optional<double> tolerance;  // that was found
  std::optional<double> tuning_s;
  bool tuning_cut = false;  // it ran out of time
};

// How far the stresses on this mesh are from the exact ones.
struct DiscretisationError {
  TotalError total;  // without steps: not known
  std::string by;    // Record::discretisation_by
  std::string missing;
  // Of every load step; relative_of_mean and intervals: of the last.
  std::vector<StepMeshError> of_steps;
  std::optional<double> relative_of_mean;     // ConstitutiveError; empty: it has no stress
  std::optional<ContactIntervals> intervals;  // if asked for, and the error is one
};

struct Memory {
  std::optional<std::int64_t> peak_heap_bytes, peak_rss_bytes, process_peak_heap_bytes;
  std::optional<MemorySplit> split;
};

struct CaseResult {
  Verdict verdict;
  std::vector<double> assembly_samples_s = {};
  Search search = {};
  // Empty: nothing was solved. Without its arrays once examine() ends, so that the memory run
  // begins without them.
  std::optional<Solution> solution = {};
  std::vector<JudgedStep> steps = {};  // of a path every step that it reached
  // The judge's, of an answer:
  std::optional<Verification> verification = {};  // of the last load step
  bool is_other_solution = false;                 // than the reference's
  bool is_right_on_the_mesh = false;  // what is inaccurate is the mesh, or small displacements
  std::string polygons = {};
  DiscretisationError of_mesh = {};
  std::vector<StepResult> steps_in_halves = {}, in_eight_steps = {};
  std::optional<double> change_in_eight_steps = {};  // of the stresses, relative, in energy
  // Measured:
  std::optional<double> extrapolated_time_s = {};
  Memory memory = {};
  std::optional<TimedRun> only_run = {};  // which gave all, memory too
  std::optional<double> runs_s = {};      // all solves
};

// The only writer of a record of what came of a case.
Record to_record(const Case& asked, const Limits& limits, const CaseResult& result);
// As of its record.
bool is_measured(const Case& asked, const CaseResult& result);

// Adds a timed run's sample to the record. If it did not end as the detail run, its end becomes the
// record's, and samples and memory figures go.
void add_run(const TimedRun& run, Record& record);
Verdict ended_otherwise(const TimedRun& run, const char* which);  // "in a timed run: …"

}  // namespace airybench
