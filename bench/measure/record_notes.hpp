// What is measured of a case, and what its record takes from it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure/solve_watch.hpp"
#include "bench/records/record.hpp"
#include "bench/verify/contact_intervals.hpp"
#include "bench/verify/discretisation_error.hpp"

namespace airybench {

// The blocks that methods share, and what assembling them takes.
struct AssembledBlocks {
  // With the first step's loads, or those of the path's end; null: there is no body.
  std::unique_ptr<DualSystem> system;
  std::vector<double> assembly_samples_s;
  std::optional<std::int64_t> blocks_heap_bytes;         // live after assembly
  std::optional<std::int64_t> assembly_peak_heap_bytes;  // highest during it
};
// problem: null where there is no body, and nothing to assemble.
AssembledBlocks assemble_and_measure(const std::shared_ptr<const Problem>& problem, Blocks which,
                                     int repetitions);

// Empty where the heap is not watched.
std::optional<std::int64_t> if_probed(std::int64_t bytes);

// One timed run of a case, as it travels from the case's process.
struct TimedRun {
  double time_s = 0;
  std::map<std::string, double> stages;  // stage → seconds
  Status status = Status::crashed;
  std::string message = "the run did not take place";
  std::string signal, ended_in;  // see record_fields.def
  double runs_s = 0;             // of the case, up to here
  double program_s = 0;          // of another's program, from its start to its end
};
Json to_json(const TimedRun& run);
TimedRun timed_run_of(const Json& json);

// Adds its sample. A run that ended otherwise than the detail run sets the record's status, and
// removes the samples.
void add_run(const TimedRun& run, Record& record);

void note(const Solution& solution, Record& record);
// by: whose displacements it was made with, Record::discretisation_by. After the verification.
void note(const ConstitutiveError& error, const char* by, Record& record);
void note(const ContactIntervals& intervals, Record& record);
void note(const MemorySplit& memory, Record& record);
// Reasons of an ok case, after the verification. Nothing touches, can touch, or is free:
void note_what_is_idle(const Problem& problem, Record& record);
// Of a path in equilibrium stresses, where every step is taken in two halves: other numbers of
// points stick or slip, or resultants move by more than 1 %.
void note_slip_of_half_steps(Record& record);
// Strains for which linear elasticity does not hold.
void note_large_strains(const Problem& problem, const StressField& stress, Record& record);

}  // namespace airybench
