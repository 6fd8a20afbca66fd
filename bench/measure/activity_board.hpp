// A process's activity on a page of memory that it shares with the process that watches it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "bench/plan/options.hpp"
#include "solvers/base/stage_times.hpp"

namespace airybench {

enum class Activity {
  none,  // between commands
  assembly,
  reference,
  discretisation,
  tuning,
  detail_run,
  verification,
  memory_run,
  timed_run,
};
std::string_view name_of(Activity activity);  // "detail run"
bool is_run(Activity activity);               // of the method itself: tuning and the three runs

// --timeout, or for tuning its budget if there is one.
double run_limit_s(Activity run, const Limits& limits);

class ActivityBoard : public StageObserver {
 public:
  ActivityBoard();  // maps the page; throws std::system_error
  ~ActivityBoard() override;
  ActivityBoard(const ActivityBoard&) = delete;
  ActivityBoard& operator=(const ActivityBoard&) = delete;

  struct Interrupted {  // what another activity began in
    Activity activity;
    std::int64_t ran_ns;
  };
  Interrupted begins(Activity activity);
  void ends();
  // Ends the activity; the interrupted one goes on, without the time between.
  void ends_within(const Interrupted& outer);
  void begins(Stage stage) override;
  void ends(Stage stage) override;

  Activity activity() const;
  double seconds() const;          // since the activity began; 0 in none
  std::string where() const;       // "timed run, factor"
  double seconds_in_runs() const;  // the current run included

  void beat();                // a heartbeat while the process waits for others
  double silent_s() const;    // since the last beat(), begins() or ends()
  void skip(double seconds);  // for which the process was suspended, up to now

 private:
  struct Page {
    std::atomic<int> activity, stage;  // stage: -1 between stages
    std::atomic<std::int64_t> began_ns, in_runs_ns, beat_ns;
  };
  Page* page_;
};

// board may be null. Scopes nest: steps of a path are verified within the run.
class ActivityScope {
 public:
  ActivityScope(ActivityBoard* board, Activity activity) : board_(board) {
    if (board_ != nullptr) outer_ = board_->begins(activity);
  }
  ~ActivityScope() {
    if (board_ != nullptr) board_->ends_within(outer_);
  }
  ActivityScope(const ActivityScope&) = delete;
  ActivityScope& operator=(const ActivityScope&) = delete;

 private:
  ActivityBoard* board_;
  ActivityBoard::Interrupted outer_{};
};

}  // namespace airybench
