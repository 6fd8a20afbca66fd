// The cases of one posed scene, each in a separate process.
//
//   bench ──fork──► the scene's process ──fork──► a process per case
//
// The scene's process assembles and computes the reference once; a case's process is forked from
// it, and so has both at no cost. It lives from the case's examination to its last repetition, so
// that the repetitions of several cases can be interleaved. A process that dies, hangs or eats all
// memory becomes its case's record; when the scene's own does (in the assembly, in the reference),
// another takes its place that leaves that out.
//
// Commands are lines, "prepare 3", "examine 3", "time 3", "end 3"; answers are JSON on a line.
#pragma once

#include <memory>
#include <set>
#include <string>
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
  // The cases of this scene, by their index from here on. Both must outlive the object.
  IsolatedScene(const std::vector<const Case*>& cases, const Options& options)
      : cases_(cases), options_(options) {}

  Record examine(std::size_t k);                           // detail and memory run
  TimedRun measure_time(std::size_t k);                    // one timed run
  void end(std::size_t k);                                 // of its process; its memory is free
  double preparation_s() const { return preparation_s_; }  // assembly and reference

 private:
  void prepare_all();
  void prepare(std::size_t k);
  bool is_silent() const;
  // Empty: there is no process any more, or it is silent for too long and was ended.
  std::optional<std::string> ask(const std::string& verb, std::size_t k);

  const std::vector<const Case*>& cases_;
  const Options& options_;
  ActivityBoard board_;  // of the scene's process
  LeftOut left_out_;     // what broke it
  std::unique_ptr<ChildProcess> process_;
  std::string no_process_ = "its scene's process ended again and again";  // why there is none
  bool prepared_ = false;           // what all cases share, by this process
  std::set<std::size_t> examined_;  // by this process
  double preparation_s_ = 0;
};

// A run of a process that ended without an answer: status, a sentence, signal, where and how long
// it was there.
TimedRun obituary_of(const ChildEnd& end, const ActivityBoard& board, const Options& options);

// For a process of ours: exit() by a library to which the machine has refused memory ends it with
// no_memory_exit_code.
void tell_refused_memory_at_exit();

}  // namespace airybench
