// What is measured of a case, and what its record takes from it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure/memory_watch.hpp"
#include "bench/records/record.hpp"
#include "bench/verify/contact_intervals.hpp"
#include "bench/verify/discretisation_error.hpp"
#include "solvers/base/stage_times.hpp"

namespace airybench {

// The blocks that methods share, and what assembling them takes.
struct AssembledBlocks {
  std::unique_ptr<DualSystem> system;  // with the first step's loads, or those of the path's end
  std::vector<double> assembly_samples_s;
  std::optional<std::int64_t> blocks_heap_bytes;         // live after assembly
  std::optional<std::int64_t> assembly_peak_heap_bytes;  // highest during it
};
AssembledBlocks assemble_and_measure(const std::shared_ptr<const Problem>& problem, Blocks which,
                                     int repetitions);

// Nothing where the heap is not watched.
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

// The stages that there are.
std::map<std::string, double> by_name(const StageTimes& times);

// Adds its sample. A run that ended otherwise than the detail run did sets the record's status, and
// takes the samples away.
void add_run(const TimedRun& run, Record& record);

// The method's own word, with counts and sizes.
void note(const Solution& solution, Record& record);
// by: whose displacements it was made with, Record::discretisation_by. After the verification.
void note(const ConstitutiveError& error, const char* by, Record& record);
void note(const ContactIntervals& intervals, Record& record);
void note(const MemorySplit& memory, Record& record);
// Of an ok case, after the verification: nothing touches, nothing can touch, nothing is free.
void note_what_is_idle(const Problem& problem, Record& record);
// The same, of a path in equilibrium stresses: that another number of contact points sticks, or
// resultants move by more than 1 %, where every step is taken in two halves.
void note_slip_of_half_steps(Record& record);
// The same: strains for which linear elasticity does not hold.
void note_large_strains(const Problem& problem, const StressField& stress, Record& record);

}  // namespace airybench
