// What is measured in a case, and how its record takes it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure/solve_watch.hpp"
#include "bench/records/record.hpp"
#include "bench/verify/contact_intervals.hpp"
#include "bench/verify/total_error.hpp"

namespace airybench {

// What a method needs.
struct AssembledBlocks {
  // With the loads of the path's first or last step; null if there is no body.
  std::unique_ptr<ContactSystem> system;
  std::vector<double> assembly_samples_s;
  std::int64_t heap_bytes = 0;  // that they hold; 0 without the heap probe
};
AssembledBlocks assemble_and_measure(const std::shared_ptr<const Problem>& problem,
                                     const Method& method, int repetitions);

std::optional<std::int64_t> if_probed(std::int64_t bytes);

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

// Whether it ended like the detail run. If not, its end becomes the record's, and samples and
// memory figures go. which: "timed", "memory".
bool ended_alike(const TimedRun& run, const char* which, Record& record);
// A timed run's sample, if it ended alike.
void add_run(const TimedRun& run, Record& record);

// What contact faces press on, for messages.
inline const char* obstacle_of(const Problem& problem) {
  return problem.opposite.empty() ? "wall" : "wall or other body";
}

// All but its status, of which the judge has the last word.
void note(const Solution& solution, Record& record);
// Needs the verification. last: of the last load step. by: Record::discretisation_by, the source of
// the displacements.
void note(const TotalError& total, const ConstitutiveError& last, const std::string& by,
          Record& record);
void note(const ContactIntervals& intervals, Record& record);
void note(const MemorySplit& memory, Record& record);
// "; the least gap to the wall is 0.012 mm", of the body as it is held, before it deforms; empty:
// it has no contact boundary, or a path of load steps.
std::string words_of_least_gap(const Problem& problem);
// Remarks on an answer that is ok. Nothing touches, can touch, or is free; bodies that may move
// without resistance and load:
std::vector<std::string> remarks_on_what_is_idle(const Problem& problem, const Verification& v);
// Half-size load steps change, in any step, how many points stick or slip, or the resultant by over
// 1 %:
std::vector<std::string> remarks_on_half_steps(const Record& record);
// Curves that it solves as polygons (Record::polygons), and what of the total error is theirs:
std::string remark_on_polygons(const Method& method, const Record& record);
// Strains above 10 %; else empty:
std::string remark_on_large_strains(const Problem& problem, const StressField& stress);

}  // namespace airybench
