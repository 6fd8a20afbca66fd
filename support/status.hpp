// What becomes of a case, and when its iterations stop: words that travel from a solver into the
// records.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airybench {

enum class Status {
  ok,
  inaccurate,     // finished, with an error above the target by the method's own estimate, or the
                  // verifier's finding
  unstressed,     // the body has no stress at all: no error can be relative to one
  not_converged,  // an iteration ended before its tolerance was met
  breakdown,      // a pivot, a scalar or a result that the method cannot go on with
  timeout,
  out_of_memory,
  crashed,
  machine_fault,  // no process or no file could be had: not the method's doing; --resume runs it
                  // again
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
// Ended with an answer, whose time and memory count: ok, inaccurate or unstressed.
bool has_answer(Status status);

// When an iterative method stops: by a tolerance that is tightened until the method's own
// estimate is below the target; or as the paper does it.
enum class Stop { target, paper };
std::string_view name_of(Stop stop);  // "paper"
std::optional<Stop> stop_of(std::string_view name);

// What solves the condensed contact problem (solvers/contact/).
enum class ContactSolver { newton, gauss_seidel, anderson, admm };
inline constexpr std::array<ContactSolver, 4> all_contact_solvers = {
    ContactSolver::newton, ContactSolver::gauss_seidel, ContactSolver::anderson,
    ContactSolver::admm};
std::string_view name_of(ContactSolver solver);  // "gauss-seidel"
std::optional<ContactSolver> contact_solver_of(std::string_view name);

// Of all_statuses, all_contact_solvers and the like.
template <typename Words>
std::vector<std::string> names_of(const Words& all) {
  std::vector<std::string> names;
  for (const auto& word : all) names.emplace_back(name_of(word));
  return names;
}

}  // namespace airybench
