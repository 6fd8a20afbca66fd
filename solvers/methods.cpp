#include "solvers/methods.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <sstream>
#include <stdexcept>

#include "assembly/control_points.hpp"
#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/displacement/quadratic_displacements.hpp"
#include "solvers/general_names.hpp"
#include "solvers/uzawa/alm_methods.hpp"

namespace airybench {
namespace {

Method direct(const char* name, const char* summary, bool in_paper, Blocks blocks, Solve solve) {
  Method method;
  method.name = name;
  method.summary = summary;
  method.in_paper = in_paper;
  method.blocks = blocks;
  method.stages = {"order", "factor", "condense", "contact", "recover", "check"};
  method.solve = std::move(solve);
  return method;
}

Method blind(const char* name, const char* summary, bool in_paper, Solve solve) {
  Method method = direct(name, summary, in_paper, Blocks::airy, std::move(solve));
  method.condenses_contact_only = true;
  return method;
}

// One of the paper's names for a method that has a general one.
Method alias(const char* name, const char* general_name) {
  Method method = method_of_general_name(general_name);
  method.name = name;
  method.general_name = general_name;
  method.in_paper = true;
  return method;
}

Method tuned_augmented_lagrangian() {
  Method method = method_of_general_name("ALM:r=20,rho=20");
  method.name = "ALM";
  method.summary = "augmented Lagrangian, Uzawa's algorithm with the best of the paper's grid";
  method.in_paper = true;
  method.knob = AccuracyKnob::stop;
  method.tune = tune_augmented_lagrangian;
  method.solve = [](const DualSystem& system, const RunControl& control) {
    return tune_augmented_lagrangian(system, control).solve(system, control);
  };
  return method;
}

Method with_knob(Method method, AccuracyKnob knob) {
  method.knob = knob;
  return method;
}

Method in_displacements(Method method) {
  method.in_displacements = true;
  return method;
}

Solve three_step(KeepX::Where where, Refine refine = Refine::no) {
  return [where, refine](const DualSystem& system, const RunControl& control) {
    return solve_three_step_skyline(system, control, where, refine);
  };
}

Solve blind_schur(Refine refine) {
  return [refine](const DualSystem& system, const RunControl& control) {
    return solve_blind_mumps_schur(system, control, refine);
  };
}

std::vector<Method> table() {
  std::vector<Method> all = {
      alias("SDTIC3", "SYMMLQ:DTIC3"),
      alias("3STEPCG3", "3STEPCG:DTIC3"),
      alias("SDTIC6", "SYMMLQ:DTIC6"),
      alias("3STEPCG6", "3STEPCG:DTIC6"),
      alias("SSKY", "SYMMLQ:SKY"),
      with_knob(direct("3STEPD", "three-step condensation, skyline LDLT", true, Blocks::airy,
                       three_step(KeepX::Where::memory)),
                AccuracyKnob::contact_sweeps),
      tuned_augmented_lagrangian(),
      blind("BLIND", "blind condensation, MUMPS indefinite LDLT", true, solve_blind_mumps),
      blind("BLIND:SCHUR", "blind condensation, D from MUMPS's Schur complement", false,
            blind_schur(Refine::no)),
      blind("BLIND:SCHUR:REFINED", "BLIND:SCHUR refined with residuals in long double", false,
            blind_schur(Refine::yes)),
      blind("BLIND:SKY", "blind condensation, skyline LDLT, multipliers after their unknowns",
            false, solve_blind_skyline),
      direct("3STEPD:REFINED", "3STEPD refined with residuals in long double", false, Blocks::airy,
             three_step(KeepX::Where::memory, Refine::yes)),
      direct("3STEPD:FILE", "3STEPD with the intermediate matrices in a file", false, Blocks::airy,
             three_step(KeepX::Where::file)),
      direct("3STEPD:LEAN", "3STEPD that never stores the intermediate matrices whole", false,
             Blocks::airy, three_step(KeepX::Where::nowhere)),
      direct("3STEPD:CHOLMOD", "three-step condensation, CHOLMOD supernodal Cholesky", false,
             Blocks::airy, solve_three_step_cholmod),
      with_knob(
          direct("HYBRID", "hybridized equilibrium elements, CHOLMOD; the reference of all errors",
                 false, Blocks::contact_points, solve_hybridized),
          AccuracyKnob::contact_sweeps),
      in_displacements(direct("P2",
                              "quadratic displacements, CHOLMOD: what most users would run instead",
                              false, Blocks::contact_points, solve_quadratic_displacements)),
  };
  for (const char* family : {"SYMMLQ:", "3STEPCG:"})
    for (const std::string& preconditioner : preconditioner_names())
      all.push_back(method_of_general_name(family + preconditioner));
  return all;
}

// Commas part the items, but for those inside a general name: "ALM:r=20,rho=32" is one.
std::vector<std::string> split_selection(std::string_view selection) {
  std::vector<std::string> items;
  std::istringstream parts{std::string(selection)};
  for (std::string part; std::getline(parts, part, ',');) {
    const bool goes_on = part.find('=') != part.npos && part.find(':') == part.npos;
    if (goes_on && !items.empty())
      items.back() += "," + part;
    else
      items.push_back(part);
  }
  return items;
}

std::string valid_names() {
  std::string names;
  for (const Method& method : methods())
    if (!is_general_name(method.name)) names += (names.empty() ? "" : ", ") + method.name;
  return names;
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> all = table();
  return all;
}

std::vector<Method> select_methods(std::string_view selection) {
  std::vector<bool> selected(methods().size(), false);
  std::vector<Method> more;
  for (const std::string& item : split_selection(selection)) {
    bool matched = false;
    for (std::size_t i = 0; i < methods().size(); ++i)
      if (fnmatch(item.c_str(), methods()[i].name.c_str(), 0) == 0) selected[i] = matched = true;
    if (matched) continue;
    if (!is_general_name(item))
      throw std::invalid_argument("no method matches '" + item + "' (valid: " + valid_names() +
                                  ", 3STEPCG:<preconditioner>, SYMMLQ:<preconditioner>, "
                                  "ALM:r=<r>,rho=<rho>; globs like '3STEP*')");
    more.push_back(method_of_general_name(item));
  }
  std::vector<Method> result;
  const auto add = [&](const Method& method) {
    const bool there = std::any_of(result.begin(), result.end(), [&](const Method& other) {
      return other.identity() == method.identity();
    });
    if (!there) result.push_back(method);
  };
  for (std::size_t i = 0; i < selected.size(); ++i)
    if (selected[i]) add(methods()[i]);
  for (const Method& method : more) add(method);
  if (result.empty()) throw std::invalid_argument("no method is named");
  return result;
}

namespace {

Solution failed(Status status, const std::string& message) {
  Solution solution;
  solution.status = status;
  solution.message = message;
  return solution;
}

// What is wrong with a result that claims success; null: nothing that can be seen here.
const char* flaw(const Solution& solution, const DualSystem& system) {
  const Problem& problem = *system.problem;
  const bool in_displacements = solution.displacement.cols() > 0;
  const int forces = in_displacements ? control_points(problem).law.size() : system.contact.size();
  if (solution.F_C.size() != forces) return "contact forces are missing";
  if (in_displacements && solution.displacement.cols() != displacement_nodes(problem))
    return "displacements are missing";
  if (solution.stress.size() != problem.mesh.triangles.size()) return "stresses are missing";
  bool finite =
      solution.F_C.allFinite() && solution.phi.allFinite() && solution.displacement.allFinite();
  for (const ElementStress& stress : solution.stress) finite = finite && stress.allFinite();
  return finite ? nullptr : "the result is not finite";
}

}  // namespace

Solution run(const Solve& solve, const DualSystem& system, const RunControl& control) {
  try {
    Solution solution = solve(system, control);
    if (solution.status == Status::ok) {
      if (const char* what = flaw(solution, system)) {
        solution.status = Status::breakdown;
        solution.message = what;
      }
    }
    return solution;
  } catch (const TimeoutReached& timeout) {
    Solution solution = failed(Status::timeout, timeout.what());
    solution.done_fraction = timeout.done_fraction;
    solution.error_so_far = timeout.error_so_far;
    return solution;
  } catch (const std::bad_alloc&) {
    return failed(Status::out_of_memory, "an allocation was refused");
  } catch (const Breakdown& breakdown) {
    return failed(Status::breakdown, breakdown.what());
  } catch (const std::exception& error) {
    return failed(Status::crashed, error.what());
  }
}

}  // namespace airybench
