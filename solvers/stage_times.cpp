#include "solvers/stage_times.hpp"

namespace airybench {
namespace {

StageObserver* observer = nullptr;

}  // namespace

std::string_view name_of(Stage stage) {
  constexpr std::array<std::string_view, all_stages.size()> names = {
      "order", "precondition", "factor", "condense", "contact", "recover", "check"};
  return names[static_cast<int>(stage)];
}

ObservedStages::ObservedStages(StageObserver* told) : before_(observer) { observer = told; }
ObservedStages::~ObservedStages() { observer = before_; }

StageTimer::StageTimer(StageTimes& times, Stage stage) : seconds_(times[stage]), stage_(stage) {
  if (observer != nullptr) observer->begins(stage_);
  start_ = std::chrono::steady_clock::now();
}

StageTimer::~StageTimer() {
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  seconds_ = seconds_.value_or(0) + spent.count();
  if (observer != nullptr) observer->ends(stage_);
}

}  // namespace airybench
