// A method as the harness sees it: a name, what it needs, and a function.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/airy_system.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

using Solve = std::function<Solution(const ContactSystem&, const RunControl&)>;
using SolveAiry = std::function<Solution(const AirySystem&, const RunControl&)>;
using SolveContact = std::function<Solution(const contact::Problem&, const RunControl&)>;

// A method's function of an AirySystem as one of any system, which must be an AirySystem then, as
// assemble() makes it.
template <typename OfAirySystem>
auto on_airy_system(OfAirySystem function) {
  return [function = std::move(function)](const ContactSystem& system, const RunControl& control) {
    return function(dynamic_cast<const AirySystem&>(system), control);
  };
}

// One combination of parameters that was tried.
struct GridPoint {
  double r, rho;
  int iterations;
  std::string outcome;  // "converged", "diverged", "given up": slower than the best so far, "not
                        // tried": no time
};

// Parameters chosen for one problem.
struct Tuning {
  std::string parameters;  // "r=20, rho=20"
  Solve solve;             // with them
  std::vector<GridPoint> grid;
};

// The parameter that decides how accurate the answer is, for studies that vary it.
enum class AccuracyKnob {
  none,              // a direct method: it has one accuracy
  krylov_tolerance,  // RunControl::tolerance
  uzawa_iterations,  // RunControl::max_iterations
  contact_sweeps,    // ContactOptions::max_iterations
  stop               // RunControl::stop; parameters are chosen for it
};

// What a method solves for.
enum class Unknowns {
  airy_function,
  edge_displacements,
  displacements,  // of another discrete problem: the stresses do not balance and are not those of
                  // the reference, so they are judged by the discretisation error alone
  contact_forces  // of a problem that came condensed
};

struct Method {
  std::string name = {};            // "SDTIC3"
  std::string family = {};          // "SYMMLQ": the variants and preconditioners of one idea
  std::string preconditioner = {};  // "DTIC3", as preconditioner_names() spells it; empty: none
  std::string summary = {};         // one line
  bool in_paper = false;            // named there; these are run by default
  Unknowns unknowns = Unknowns::airy_function;
  int degree = 1;                // of its stresses on each third of a triangle
  bool joins_bodies = true;      // solves bodies that press on each other
  bool takes_load_steps = true;  // measures slip from the step before (Loads::slid_mm)
  std::vector<Stage> stages = {Stage::order,   Stage::factor,  Stage::condense,
                               Stage::contact, Stage::recover, Stage::check};  // in order
  // Version of the external program, as it reports it (bench/external); empty: the method is ours.
  std::string program = {};
  // The force multipliers stay in the factorised or iterated matrix (BLIND, SYMMLQ): without
  // contact there is nothing to condense.
  bool condenses_contact_only = false;
  Solve solve = {};                 // bodies; null: it takes contact problems only
  SolveContact solve_contact = {};  // contact problems without a body; null: it takes none
  std::string general_name = {};    // "SYMMLQ:DTIC3" where the name is an alias; else empty
  // Of an iterative method: the harness starts with this tolerance per target error and tightens
  // it until the target is met. Zero: its error does not follow RunControl::tolerance.
  double first_tolerance = 0;
  double paper_tolerance = 0;  // RunControl::tolerance with the paper's stop; zero: it has its own
  AccuracyKnob knob = AccuracyKnob::none;
  // Chooses parameters for a problem, outside the time of the solve; null: there are none. `solve`
  // chooses and solves.
  std::function<Tuning(const ContactSystem&, const RunControl&)> tune = {};

  const std::string& identity() const { return general_name.empty() ? name : general_name; }
  // Its iteration has a stop to choose.
  bool is_iterative() const {
    return is_tightened() || knob == AccuracyKnob::krylov_tolerance ||
           knob == AccuracyKnob::uzawa_iterations || knob == AccuracyKnob::stop;
  }
  bool condenses_contact() const {
    return std::find(stages.begin(), stages.end(), Stage::condense) != stages.end();
  }
  bool is_tightened() const { return first_tolerance > 0; }  // by the harness
  bool in_displacements() const { return unknowns == Unknowns::displacements; }
  // Programs in displacements have the chords of curved sides.
  bool takes_chords() const { return in_displacements() && !program.empty(); }
};

// What the method solves.
std::unique_ptr<ContactSystem> assemble(const Method& method,
                                        std::shared_ptr<const Problem> problem);

// Runs a method; exceptions become statuses: TimeoutReached, std::bad_alloc, Breakdown, any other
// std::exception (crashed). A success whose result is incomplete or not finite is a breakdown.
Solution run(const Solve& solve, const ContactSystem& system, const RunControl& control);
Solution run(const SolveContact& solve, const contact::Problem& problem, const RunControl& control);
inline Solution run(const Method& method, const ContactSystem& system, const RunControl& control) {
  return run(method.solve, system, control);
}

}  // namespace airybench
