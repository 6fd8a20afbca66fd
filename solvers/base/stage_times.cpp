#include "solvers/base/stage_times.hpp"

namespace airybench {
namespace {

const ObservedStages* innermost = nullptr;

}  // namespace

std::string_view name_of(Stage stage) {
  constexpr std::array<std::string_view, all_stages.size()> names = {
      "order", "precondition", "factor", "condense", "contact", "recover", "check"};
  return names[static_cast<int>(stage)];
}

ObservedStages::ObservedStages(StageObserver* observer) : observer_(observer), outer_(innermost) {
  innermost = this;
}
ObservedStages::~ObservedStages() { innermost = outer_; }

void ObservedStages::tell(void (StageObserver::*what)(Stage), Stage stage) {
  for (const ObservedStages* scope = innermost; scope != nullptr; scope = scope->outer_)
    if (scope->observer_ != nullptr) (scope->observer_->*what)(stage);
}

StageTimer::StageTimer(StageTimes& times, Stage stage) : seconds_(times[stage]), stage_(stage) {
  ObservedStages::tell(&StageObserver::begins, stage_);
  start_ = std::chrono::steady_clock::now();
}

StageTimer::~StageTimer() {
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  seconds_ = seconds_.value_or(0) + spent.count();
  ObservedStages::tell(&StageObserver::ends, stage_);
}

}  // namespace airybench
