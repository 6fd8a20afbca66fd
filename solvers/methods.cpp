#include "solvers/methods.hpp"

#include <fnmatch.h>

#include <cmath>
#include <new>
#include <sstream>
#include <stdexcept>

#include "solvers/condensation/condensation_methods.hpp"

namespace airybench {

const std::vector<Method>& methods() {
  static const std::vector<Method> table = {
      {"3STEPD",
       "three-step condensation, skyline LDLT",
       true,
       Blocks::airy,
       {"order", "factor", "condense", "contact", "recover"},
       solve_three_step_skyline},
      {"3STEPD:CHOLMOD",
       "three-step condensation, CHOLMOD supernodal Cholesky",
       false,
       Blocks::airy,
       {"order", "factor", "condense", "contact", "recover"},
       solve_three_step_cholmod},
      {"BLIND",
       "blind condensation, MUMPS LDLT of the whole system, a solve per contact force",
       true,
       Blocks::airy,
       {"order", "factor", "condense", "contact", "recover"},
       solve_blind_mumps},
      {"BLIND:SCHUR",
       "the same without these solves: MUMPS's Schur complement",
       false,
       Blocks::airy,
       {"order", "factor", "condense", "contact", "recover"},
       solve_blind_mumps_schur},
      {"BLIND:SKY",
       "blind condensation, skyline LDLT with multipliers after their unknowns",
       false,
       Blocks::airy,
       {"order", "factor", "condense", "contact", "recover"},
       solve_blind_skyline},
      {"HYBRID",
       "hybridized equilibrium elements, CHOLMOD; the reference of all errors",
       false,
       Blocks::contact_points,
       {"order", "factor", "condense", "contact", "recover"},
       solve_hybridized},
  };
  return table;
}

std::vector<Method> select_methods(std::string_view selection) {
  std::vector<bool> selected(methods().size(), false);
  std::istringstream items{std::string(selection)};
  for (std::string item; std::getline(items, item, ',');) {
    bool matched = false;
    for (std::size_t i = 0; i < methods().size(); ++i)
      if (fnmatch(item.c_str(), methods()[i].name.c_str(), 0) == 0) selected[i] = matched = true;
    if (!matched) {
      std::string valid;
      for (const Method& method : methods()) valid += (valid.empty() ? "" : ", ") + method.name;
      throw std::invalid_argument("no method matches '" + item + "' (valid: " + valid +
                                  "; globs like '3STEP*')");
    }
  }
  std::vector<Method> result;
  for (std::size_t i = 0; i < selected.size(); ++i)
    if (selected[i]) result.push_back(methods()[i]);
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
  if (solution.F_C.size() != system.contact.size()) return "contact forces are missing";
  if (solution.stress.size() != system.problem->mesh.triangles.size())
    return "stresses are missing";
  bool finite = solution.F_C.allFinite() && solution.phi.allFinite();
  for (const ElementStress& stress : solution.stress) finite = finite && stress.allFinite();
  return finite ? nullptr : "the result is not finite";
}

}  // namespace

Solution run(const Method& method, const DualSystem& system, const RunControl& control) {
  try {
    Solution solution = method.solve(system, control);
    if (solution.status == Status::ok) {
      if (const char* what = flaw(solution, system)) {
        solution.status = Status::breakdown;
        solution.message = what;
      }
    }
    return solution;
  } catch (const TimeoutReached& timeout) {
    return failed(Status::timeout, timeout.what());
  } catch (const std::bad_alloc&) {
    return failed(Status::out_of_memory, "an allocation was refused");
  } catch (const Breakdown& breakdown) {
    return failed(Status::breakdown, breakdown.what());
  } catch (const std::exception& error) {
    return failed(Status::crashed, error.what());
  }
}

}  // namespace airybench
