// Runs the cases of one posed scene, each in a separate process.
//
//   bench ──fork──► the scene's process ──fork──► a process per case
//
// The scene's process assembles and computes the reference once; the cases' processes inherit both.
// A case's process lives from its examination to its last repetition, so that cases can be
// interleaved. If it dies, hangs or exhausts memory, that becomes its record. If the assembly of
// blocks breaks the scene's process, that becomes the record of every case that needs them; a
// reference that does is left out by a new one. A run during which a process was suspended does not
// count, and is repeated.
//
// Commands are lines, "prepare 3", "examine 3", "time 3", "end 3"; answers are JSON on a line.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure/activity_board.hpp"
#include "bench/measure/workbench.hpp"
#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/records/record.hpp"
#include "support/process.hpp"

namespace airybench {

class IsolatedScene {
 public:
  // Cases are numbered by their index in `cases`; out: the results folder. The arguments must
  // outlive the object.
  IsolatedScene(const std::vector<const Case*>& cases, const Limits& limits,
                const std::filesystem::path& out)
      : cases_(cases), limits_(limits), out_(out) {}

  Record examine(std::size_t k);         // detail and memory run
  TimedRun measure_time(std::size_t k);  // one timed run
  void end(std::size_t k);               // ends the case's process and frees its memory
  double preparation_s() const { return preparation_s_; }  // assembly and reference

 private:
  void prepare_all();
  void prepare(std::size_t k);
  void end_process();
  bool is_silent() const;
  std::string sign_of(const std::string& verb, std::size_t k, double since_s) const;
  // Empty if there is no process or it has ended; kills one that is overdue or silent.
  std::optional<std::string> ask(const std::string& verb, std::size_t k);

  const std::vector<const Case*>& cases_;
  const Limits& limits_;
  const std::filesystem::path& out_;
  ActivityBoard board_;                              // of the scene's process
  LeftOut left_out_;                                 // parts that broke it
  std::map<BlocksKey, TimedRun> broken_assemblies_;  // whose assembly broke it, and how it ended
  std::unique_ptr<ChildProcess> process_;
  Verdict why_no_process_ = {Status::machine_fault, "its scene's process ended again and again"};
  bool prepared_ = false;           // process_ has what all cases share
  std::set<std::size_t> examined_;  // in process_
  double preparation_s_ = 0;
};

// Passed the limit of its activity, or of a phase between two (fields). A grace lets a method end
// by itself and report its progress.
bool is_overdue(const ActivityBoard& board, const Limits& limits);

TimedRun obituary_of(const ChildEnd& end, const ActivityBoard& board, const Limits& limits);

// Of a case whose record cannot be read: a crash.
Record record_of_defect(const Case& c, const Limits& limits, const RecordError& wrong);

// From now on exit() after a refused allocation ends this process with no_memory_exit_code.
void tell_refused_memory_at_exit();

}  // namespace airybench
