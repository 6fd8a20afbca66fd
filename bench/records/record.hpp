// One case's record: everything that a line of the output says.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "assembly/mesh.hpp"
#include "bench/cases/stages.hpp"
#include "bench/judging/verifier.hpp"
#include "bench/records/case_name.hpp"
#include "bench/records/json.hpp"
#include "bench/records/memory_split.hpp"
#include "solvers/method.hpp"
#include "solvers/solution.hpp"

namespace airybench {

struct Record {
  std::string mesh, mesh_file, mesh_sha256, scene, method;
  std::string scene_definition = "{}";  // the scene file's JSON
  int case_number = 0;                  // in the plan of its run, from 1
  Status status = Status::crashed;
  std::string status_reason = "the case did not run";
  std::string signal;                   // that ended the case's process: "SIGSEGV"; empty: none
  std::string ended_in;                 // what the process was doing then: "timed run, factor"
  std::optional<double> time_so_far_s;  // of that activity
  int n_phi = 0, n_f = 0, n_c = 0;  // as solved: μ = 0 moves the tangential contact rows to n_f
  int threads = 1;
  std::vector<double> samples_s;           // every timed run, blocks assembled → F_C and stresses
  std::vector<StageTimes> stage_samples;   // of the same runs
  std::vector<double> assembly_samples_s;  // the blocks' assembly
  std::vector<double> noise_kernel_samples_s;  // the machine's own pace, see noise_kernel.hpp
  std::optional<std::int64_t> instructions;    // of the memory run
  std::optional<double> runs_s;                // in this case's solves of all runs, tuning included
  std::optional<double> wall_s;  // in this case altogether, but its share of preparation
  std::optional<std::int64_t> peak_heap_bytes;  // blocks and all that the solve added, at the peak
  std::optional<std::int64_t> peak_rss_bytes;   // of the process, during the solve
  std::optional<std::int64_t> blocks_heap_bytes;         // live after assembly
  std::optional<std::int64_t> assembly_peak_heap_bytes;  // highest during assembly
  std::optional<std::int64_t> process_peak_heap_bytes;   // highest of the process so far
  std::size_t storage_bytes = 0;
  std::optional<std::int64_t> library_bytes, factor_entries;  // see Solution
  std::optional<double> factor_flops;
  std::optional<MemorySplit> memory;  // of the memory run
  std::optional<std::int64_t> linear_iterations;
  std::optional<int> contact_iterations, uzawa_iterations;
  Stop stop = Stop::target;
  double target_error = 1e-6;
  std::optional<double> tolerance;  // of the linear or Uzawa iteration, relative
  std::string parameters;           // chosen or changed, "r=20, rho=32"
  std::optional<double> tuning_s;   // spent on finding them
  std::vector<GridPoint> grid;      // what was tried
  std::optional<double> done_fraction, extrapolated_time_s, error_so_far;  // on timeout
  bool measured_once = false;  // detail, memory and time are of one and the same run
  std::optional<Verification> verification;
  std::string answer_hash;                                   // see answer_hash.hpp
  std::optional<Status> claimed_status;                      // what the method said itself
  std::optional<double> error_estimate, condition_estimate;  // see Solution
  // Of the mesh, see discretisation_error.hpp; the bounds where they are guaranteed.
  std::optional<double> error_discretisation, lower_bound_Nmm, upper_bound_Nmm;
  std::string study;  // "error", "stability"; empty: an ordinary run
  std::string knob;   // what a study turns: "tolerance"; empty: nothing
  std::optional<double> knob_value;
  std::string scene_group;  // of the stability atlas: "nearly incompressible"
  std::vector<StageDecision> stages;
  std::vector<IterationHistory> histories;
};

// One timed run of a case.
struct TimedRun {
  double time_s = 0;
  StageTimes stages;
  Status status = Status::crashed;
  std::string message = "the run did not take place";
  std::string signal, ended_in;  // see Record
  double runs_s = 0;             // of the case, up to here
};
// Adds its sample. A run that ended otherwise than the detail run did sets the record's status, and
// takes the samples away.
void add_run(const TimedRun& run, Record& record);

CaseName name_of(const Record& record);

// Has it an answer whose time and memory are worth taking? Also one that was cut short on purpose.
bool is_measured(const Record& record);

// One word for what became of a case: its status, or `wrong_success` where the method said ok and
// the verifier disagrees; `unverified` where it has no reference to say.
std::string outcome_of(const Record& record);

std::string column_of(Stage stage);  // "stage_factor_s"

// Of the grid's combinations: iterations of the best; median and largest of those that converged or
// were given up, with what they had made by then; how many diverged.
struct GridSummary {
  std::optional<int> best, median, worst, failures;
};
GridSummary summary_of(const std::vector<GridPoint>& grid);

// The flat view: names and values of the columns, in order; null: does not apply.
using Columns = std::vector<std::pair<std::string, Json>>;
Columns columns(const Record& record);

// {"factor": 0.12, …}, of the stages that there are.
Json json_of(const StageTimes& times);

// A line of records.jsonl: the columns, then samples, stages, mesh hash and histories.
Json to_json(const Record& record);

}  // namespace airybench
