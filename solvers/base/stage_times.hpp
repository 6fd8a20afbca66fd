// The stages of a solve: what they are called, how long each took, and who is told.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string_view>

#include "support/memory_owner.hpp"
#include "support/seconds_since.hpp"

namespace airybench {

enum class Stage {
  order,         // symbolic analysis, fill-reducing ordering
  precondition,  // building a preconditioner
  factor,        // numeric factorisation
  condense,      // from the factor to D and G
  contact,       // the contact law
  recover,       // F_C to φ and stresses
  check,         // the method's own estimate of its error, refinement
};
inline constexpr std::array<Stage, 7> all_stages = {
    Stage::order,   Stage::precondition, Stage::factor, Stage::condense,
    Stage::contact, Stage::recover,      Stage::check};
std::string_view name_of(Stage stage);  // "factor"

// Wall-clock seconds by stage. Empty: the method has no such stage, or the scene does not need it.
class StageTimes {
 public:
  std::optional<double>& operator[](Stage stage) { return seconds_[static_cast<int>(stage)]; }
  const std::optional<double>& operator[](Stage stage) const {
    return seconds_[static_cast<int>(stage)];
  }

 private:
  std::array<std::optional<double>, all_stages.size()> seconds_;
};

// Is told when a stage begins and ends, by the thread that runs it: where a crash or a time limit
// came, what each stage needs of memory. Stages do not nest.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void begins(Stage stage) = 0;
  virtual void ends(Stage stage) = 0;
};

// Has an observer told for the scope of the object, after those of the scopes inside it.
class ObservedStages {
 public:
  explicit ObservedStages(StageObserver* observer);
  ~ObservedStages();
  ObservedStages(const ObservedStages&) = delete;
  ObservedStages& operator=(const ObservedStages&) = delete;
  static void tell(void (StageObserver::*what)(Stage), Stage stage);  // all of them

 private:
  StageObserver* observer_;
  const ObservedStages* outer_;
};

// Measures one stage: adds the time from construction to destruction.
class StageTimer {
 public:
  StageTimer(StageTimes& times, Stage stage);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  std::optional<double>& seconds_;
  Stage stage_;
  std::chrono::steady_clock::time_point start_;
};

// Adds the time from construction to destruction; no observer is told.
class SecondsInto {
 public:
  explicit SecondsInto(double& seconds) : seconds_(seconds) {}
  ~SecondsInto() { seconds_ += seconds_since(start_); }
  SecondsInto(const SecondsInto&) = delete;
  SecondsInto& operator=(const SecondsInto&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Runs one stage: on its clock, what it allocates on its owner's account.
template <typename Work>
auto run_stage(StageTimes& times, Stage stage, MemoryOwner owner, Work work) {
  const StageTimer timer(times, stage);
  const OwnerScope scope(owner);
  return work();
}

}  // namespace airybench
