#include "support/status.hpp"

#include <algorithm>

namespace airybench {
namespace {

template <typename Words>
auto word_of(const Words& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, [](auto word) { return name_of(word); });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

std::string_view name_of(Status status) {
  constexpr std::array<std::string_view, 10> names = {
      "ok",      "inaccurate",    "unstressed", "not_converged", "breakdown",
      "timeout", "out_of_memory", "crashed",    "machine_fault", "skipped"};
  return names[static_cast<std::size_t>(status)];
}
std::optional<Status> status_of(std::string_view name) { return word_of(all_statuses, name); }

bool has_answer(Status status) {
  return status == Status::ok || status == Status::inaccurate || status == Status::unstressed;
}

std::string_view name_of(Stop stop) { return stop == Stop::paper ? "paper" : "target"; }
std::optional<Stop> stop_of(std::string_view name) { return word_of(all_stops, name); }

std::string_view name_of(ContactSolver solver) {
  constexpr std::array<std::string_view, 4> names = {"newton", "gauss-seidel", "anderson", "admm"};
  return names[static_cast<std::size_t>(solver)];
}
std::optional<ContactSolver> contact_solver_of(std::string_view name) {
  return word_of(all_contact_solvers, name);
}

}  // namespace airybench
