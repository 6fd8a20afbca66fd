// The words that a solver hands on to the records: its status, and when its iterations stop.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airybench {

enum class Status {
  ok,
  inaccurate,     // its own estimate or the verifier finds an error above the target
  unstressed,     // without stress, no error can be relative
  not_converged,  // an iteration ended before it met its tolerance
  breakdown,      // the method met an unusable pivot, scalar or result
  timeout,
  out_of_memory,
  crashed,
  machine_fault,  // no process or file could be had; --resume runs it again
  skipped,
};
inline constexpr std::array<Status, 10> all_statuses = {Status::ok,
                                                        Status::inaccurate,
                                                        Status::unstressed,
                                                        Status::not_converged,
                                                        Status::breakdown,
                                                        Status::timeout,
                                                        Status::out_of_memory,
                                                        Status::crashed,
                                                        Status::machine_fault,
                                                        Status::skipped};
std::string_view name_of(Status status);  // "not_converged"
std::optional<Status> status_of(std::string_view name);
// The solve ended with an answer whose time and memory count: ok, inaccurate or unstressed.
bool has_answer(Status status);

// target: the tolerance is tightened until the method's own estimate is below the target.
enum class Stop { target, paper };
inline constexpr std::array<Stop, 2> all_stops = {Stop::target, Stop::paper};
std::string_view name_of(Stop stop);  // "paper"
std::optional<Stop> stop_of(std::string_view name);

enum class ContactSolver { newton, gauss_seidel, anderson, admm };
inline constexpr std::array<ContactSolver, 4> all_contact_solvers = {
    ContactSolver::newton, ContactSolver::gauss_seidel, ContactSolver::anderson,
    ContactSolver::admm};
std::string_view name_of(ContactSolver solver);  // "gauss-seidel"
std::optional<ContactSolver> contact_solver_of(std::string_view name);

template <typename Words>
std::vector<std::string> names_of(const Words& all) {
  std::vector<std::string> names;
  for (const auto& word : all) names.emplace_back(name_of(word));
  return names;
}

}  // namespace airybench
