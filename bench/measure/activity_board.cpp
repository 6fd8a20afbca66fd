#include "bench/measure/activity_board.hpp"

#include <fmt/format.h>
#include <sys/mman.h>

#include <array>
#include <cerrno>
#include <new>
#include <system_error>

namespace airybench {
namespace {

std::int64_t now_ns() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double seconds_after(std::int64_t began_ns) {
  return 1e-9 * static_cast<double>(now_ns() - began_ns);
}

}  // namespace

std::string_view name_of(Activity activity) {
  constexpr std::array<std::string_view, 9> names = {
      "nothing",      "assembly",   "reference", "discretisation error", "tuning", "detail run",
      "verification", "memory run", "timed run"};
  return names[static_cast<std::size_t>(activity)];
}

bool is_run(Activity activity) {
  return activity == Activity::tuning || activity == Activity::detail_run ||
         activity == Activity::memory_run || activity == Activity::timed_run;
}

double run_limit_s(Activity run, const Limits& limits) {
  return run == Activity::tuning ? limits.tuning_budget_s.value_or(limits.timeout_s)
                                 : limits.timeout_s;
}

ActivityBoard::ActivityBoard() {
  void* page =
      mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED)
    throw std::system_error(errno, std::generic_category(), "a page shared with a child process");
  page_ = new (page) Page{};
  page_->stage = -1;
}

ActivityBoard::~ActivityBoard() { munmap(page_, sizeof(Page)); }

ActivityBoard::Interrupted ActivityBoard::begins(Activity activity) {
  const Interrupted outer{this->activity(), now_ns() - page_->began_ns};
  if (is_run(outer.activity)) page_->in_runs_ns += outer.ran_ns;
  beat();
  page_->began_ns = now_ns();
  page_->activity = static_cast<int>(activity);
  return outer;
}

void ActivityBoard::ends() { ends_within({Activity::none, 0}); }

void ActivityBoard::ends_within(const Interrupted& outer) {
  if (is_run(activity())) page_->in_runs_ns += now_ns() - page_->began_ns;
  if (is_run(outer.activity)) page_->in_runs_ns -= outer.ran_ns;  // counted again from here on
  beat();
  page_->began_ns = now_ns() - outer.ran_ns;
  page_->activity = static_cast<int>(outer.activity);
}

void ActivityBoard::beat() { page_->beat_ns = now_ns(); }
double ActivityBoard::silent_s() const { return seconds_after(page_->beat_ns); }

void ActivityBoard::skip(double seconds) {
  if (!(seconds > 0)) return;
  beat();
  const auto skipped_ns = static_cast<std::int64_t>(1e9 * seconds);
  if (page_->began_ns < now_ns() - skipped_ns) page_->began_ns += skipped_ns;
}

void ActivityBoard::begins(Stage stage) { page_->stage = static_cast<int>(stage); }
void ActivityBoard::ends(Stage) { page_->stage = -1; }

Activity ActivityBoard::activity() const { return static_cast<Activity>(page_->activity.load()); }

double ActivityBoard::seconds() const {
  return activity() == Activity::none ? 0 : seconds_after(page_->began_ns);
}

std::string ActivityBoard::where() const {
  const std::string text(name_of(activity()));
  const int stage = page_->stage;
  return stage < 0 ? text : fmt::format("{}, {}", text, name_of(static_cast<Stage>(stage)));
}

double ActivityBoard::seconds_in_runs() const {
  return 1e-9 * static_cast<double>(page_->in_runs_ns) + (is_run(activity()) ? seconds() : 0);
}

}  // namespace airybench
