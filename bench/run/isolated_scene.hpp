// The cases of one posed scene, each in a process of its own.
//
//   bench ──fork──► the scene's process ──fork──► a process per case
//
// The scene's process assembles and computes the reference once; a case's process is forked from
// it, and so has both at no cost. It lives from the case's examination to its last repetition, so
// that the repetitions of several cases can be interleaved. A process that dies, hangs or eats all
// memory becomes its case's record; when the scene's own does (in the assembly, in the reference),
// another takes its place that leaves that out.
#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/measure/activity_board.hpp"
#include "bench/measure/workbench.hpp"
#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/records/record.hpp"
#include "bench/run/child_process.hpp"

namespace airybench {

// Ctrl-C, SIGTERM or SIGHUP: what() says which. What has been measured by then is on disk.
struct Interrupted : std::runtime_error {
  explicit Interrupted(int number);
  int signal;
};

// Makes these signals end waiting with Interrupted; a second one ends the program at once.
void catch_interrupts();
void throw_if_interrupted();

class IsolatedScene {
 public:
  // The cases of this scene, by their index from here on. Both must outlive the object.
  IsolatedScene(const std::vector<const Case*>& cases, const Options& options);

  Record examine(std::size_t k);                           // detail and memory run
  TimedRun measure_time(std::size_t k);                    // one timed run
  void end(std::size_t k);                                 // of its process; its memory is free
  double preparation_s() const { return preparation_s_; }  // assembly and reference

 private:
  void prepare_all();
  void prepare(std::size_t k);
  bool overdue() const;
  // Empty: there is no process any more, or it is silent for too long and was ended.
  std::optional<std::string> ask(const std::string& line);

  const std::vector<const Case*>& cases_;
  const Options& options_;
  ActivityBoard board_;  // of the scene's process
  LeftOut left_out_;     // what broke it
  std::unique_ptr<ChildProcess> process_;
  std::string no_process_ = "its scene's process ended again and again";  // why there is none
  int generation_ = 0;                                                    // of the process
  std::map<std::size_t, int> examined_in_;
  bool prepared_ = false;  // what all cases share, in this generation
  double preparation_s_ = 0;
};

}  // namespace airybench
