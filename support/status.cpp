#include "support/status.hpp"

namespace airybench {

std::string_view name_of(Status status) {
  constexpr std::array<std::string_view, 10> names = {
      "ok",      "inaccurate",    "unstressed", "not_converged", "breakdown",
      "timeout", "out_of_memory", "crashed",    "machine_fault", "skipped"};
  return names[static_cast<std::size_t>(status)];
}

std::optional<Status> status_of(std::string_view name) {
  for (const Status status : all_statuses)
    if (name_of(status) == name) return status;
  return {};
}

bool has_answer(Status status) {
  return status == Status::ok || status == Status::inaccurate || status == Status::unstressed;
}

std::string_view name_of(Stop stop) { return stop == Stop::paper ? "paper" : "target"; }

std::optional<Stop> stop_of(std::string_view name) {
  for (const Stop stop : {Stop::target, Stop::paper})
    if (name_of(stop) == name) return stop;
  return {};
}

std::string_view name_of(ContactSolver solver) {
  constexpr std::array<std::string_view, 4> names = {"newton", "gauss-seidel", "anderson", "admm"};
  return names[static_cast<std::size_t>(solver)];
}

std::optional<ContactSolver> contact_solver_of(std::string_view name) {
  for (const ContactSolver solver : all_contact_solvers)
    if (name_of(solver) == name) return solver;
  return {};
}

}  // namespace airybench
