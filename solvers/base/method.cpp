#include "solvers/base/method.hpp"

#include <new>

#include "assembly/control_points.hpp"

namespace airybench {
namespace {

Solution failed(Status status, const std::string& message) {
  Solution solution;
  solution.status = status;
  solution.message = message;
  return solution;
}

// What is wrong with a result that claims success; null: nothing that can be seen here.
const char* flaw(const Solution& solution, const ContactSystem& system) {
  const Problem& problem = *system.problem;
  const auto* const displacements = solution.as<Displacements>();
  const auto* const airy = solution.as<AiryFunction>();
  const int degree = system.degree + 1;  // of displacements
  const int forces =
      displacements != nullptr ? control_points(problem, degree).law.size() : system.contact.size();
  if (solution.F_C.size() != forces) return "contact forces are missing";
  if (displacements != nullptr && displacements->w.cols() != displacement_nodes(problem, degree))
    return "displacements are missing";
  if (solution.stress.size() != problem.mesh.triangles.size()) return "stresses are missing";
  const bool finite = solution.F_C.allFinite() && (airy == nullptr || airy->phi.allFinite()) &&
                      (displacements == nullptr || displacements->w.allFinite()) &&
                      solution.stress.values().allFinite();
  return finite ? nullptr : "the result is not finite";
}

const char* flaw(const Solution& solution, const contact::Problem& problem) {
  if (solution.F_C.size() != problem.points.size()) return "contact forces are missing";
  return solution.F_C.allFinite() ? nullptr : "the result is not finite";
}

template <typename SolveAny, typename Problem>
Solution run_any(const SolveAny& solve, const Problem& problem, const RunControl& control) {
  try {
    Solution solution = solve(problem, control);
    if (solution.status == Status::ok) {
      if (const char* what = flaw(solution, problem)) {
        solution.status = Status::breakdown;
        solution.message = what;
      }
    }
    return solution;
  } catch (const TimeoutReached& timeout) {
    Solution solution = failed(Status::timeout, timeout.what());
    solution.done_fraction = timeout.done_fraction;
    return solution;
  } catch (const std::bad_alloc&) {
    return failed(Status::out_of_memory, "an allocation was refused");
  } catch (const Breakdown& breakdown) {
    return failed(Status::breakdown, breakdown.what());
  } catch (const std::exception& error) {
    return failed(Status::crashed, error.what());
  }
}

std::shared_ptr<const Problem> body_of(const Method& method,
                                       std::shared_ptr<const Problem> problem) {
  if (!method.takes_chords() || problem->round.empty()) return problem;
  return std::make_shared<const Problem>(with_chords(*problem));
}

}  // namespace

std::unique_ptr<ContactSystem> assemble(const Method& method,
                                        std::shared_ptr<const Problem> problem) {
  std::unique_ptr<ContactSystem> system;  // made in place: no copies
  if (method.unknowns == Unknowns::airy_function)
    system.reset(new AirySystem(airy_system(std::move(problem))));
  else
    system.reset(
        new ContactSystem(contact_system(body_of(method, std::move(problem)), method.degree)));
  return system;
}

Solution run(const Solve& solve, const ContactSystem& system, const RunControl& control) {
  return run_any(solve, system, control);
}

Solution run(const SolveContact& solve, const contact::Problem& problem,
             const RunControl& control) {
  return run_any(solve, problem, control);
}

}  // namespace airybench
