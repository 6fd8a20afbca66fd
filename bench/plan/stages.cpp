#include "bench/plan/stages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "assembly/control_points.hpp"
#include "assembly/problem/contact_pairs.hpp"

namespace airybench {

MeshSizes solved_sizes(const PosedProblem& problem) {
  const Problem* const body = body_of(problem);
  MeshSizes sizes;
  if (body == nullptr) {
    sizes.n_c = held<contact::Problem>(problem)->points.size();
    return sizes;
  }
  sizes = mesh_sizes(body->mesh);
  if (!body->has_friction()) {
    sizes.n_f += sizes.n_c / 2;
    sizes.n_c -= sizes.n_c / 2;
  }
  sizes.n_f += 2 * static_cast<int>(std::ranges::count(body->loads.rollers, true));
  sizes.n_f -= static_cast<int>(body->free.pins.size());
  return sizes;
}

std::string why_skipped(const PosedProblem& posed, const Method& method) {
  const Problem* const body = body_of(posed);
  if (body == nullptr) return method.solve_contact ? "" : "the problem has no body";
  if (!method.solve)
    return "the problem has a body: HYBRID condenses it, and solves the contact law";
  const bool external = !method.program.empty();
  if (!body->later_steps.empty() && !method.takes_load_steps)
    return "a path of load steps: the declaration lacks load_steps";
  if (external && method.condenses_contact() && mesh_sizes(body->mesh).contact_edges == 0)
    return "no contact boundary: nothing is left for the program";
  if (external && !method.condenses_contact() && !body->loads.thermal.empty())
    return "thermal strain: files for other programs do not contain it";
  if (!body->opposite.empty() && !method.joins_bodies)
    return external
               ? "bodies in contact with each other: the declaration lacks joins_bodies"
               : "bodies in contact with each other: active sets on K hold edges at walls only";
  if (has_free_motions(*body) && (external || !method.condenses_contact()))
    return "a body held by contact or points alone: only methods of airybench that condense on the "
           "contact points find its motion";
  if (method.unknowns == Unknowns::displacements && !body->opposite.empty())
    return why_no_control_points(*body);
  if (method.unknowns != Unknowns::airy_function) return "";
  const std::string why = why_no_airy_function(*body);
  if (why.empty()) return why;
  std::vector<std::string> others;
  for (const Method& other : methods())
    if (other.unknowns != Unknowns::airy_function) others.push_back(other.name);
  return fmt::format("{} (methods without one: {})", why, fmt::join(others, ", "));
}

int edges_out_of_reach(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const std::string label = fmt::format("force:{}", out_of_reach);
  return static_cast<int>(std::ranges::count_if(mesh.boundary, [&](const BoundaryEdge& edge) {
    return boundary_label(mesh, edge) == label;
  }));
}

std::vector<StageDecision> decide_stages(const PosedProblem& posed, const Method& method,
                                         bool fields_asked) {
  if (const std::string why = why_skipped(posed, method); !why.empty())
    return {{"all stages", false, why}};
  if (body_of(posed) == nullptr) return {{"contact", true, ""}};
  const Problem& problem = *body_of(posed);
  const MeshSizes sizes = mesh_sizes(problem.mesh);
  const bool airy = method.unknowns == Unknowns::airy_function;
  const bool contact = sizes.contact_edges > 0;
  const bool friction = problem.has_friction();
  const Loads& loads = problem.loads;
  const bool constrained = solved_sizes(posed).n_f > 0;
  const bool loaded = loads.displacement_mm || loads.has_body_force() || !loads.thermal.empty();
  const bool forced = loads.traction_MPa || loads.has_body_force();
  const std::string unused = "the method does not work with the Airy function";

  std::vector<StageDecision> decisions;
  const auto decide = [&](const std::string& stage, bool needed, const std::string& why_not) {
    decisions.push_back({stage, needed, needed ? "" : why_not});
  };
  decide("assemble S", airy, unused);
  decide("assemble C_F", airy && constrained, airy ? "no force boundary" : unused);
  decide("assemble C_C", airy && contact, airy ? "no contact boundary" : unused);
  decide("assemble q", airy && loaded,
         airy ? "no displacement that strains the body, no body force, no thermal strain" : unused);
  decide("assemble F", airy && constrained && forced,
         !airy ? unused : (constrained ? "no traction, no body force" : "no force boundary"));
  decide("assemble F0", airy && contact && loads.has_body_force(),
         !airy ? unused : (contact ? "no body force" : "no contact boundary"));
  decide("assemble gap", contact && problem.has_gap(),
         contact ? "the gap is zero" : "no contact boundary");
  for (const Stage stage : method.stages) {
    const bool for_contact =
        stage == Stage::contact || (stage == Stage::condense && method.condenses_contact_only);
    decide(std::string(name_of(stage)), contact || !for_contact, "no contact boundary");
    if (stage == Stage::condense && airy) {
      if (!method.condenses_contact_only)
        decide("condense: eliminate force multipliers", constrained, "no force boundary");
      decide("condense: D and G", contact, "no contact boundary");
    }
    if (stage == Stage::contact)
      decide("contact: tangential law", contact && friction,
             contact ? "no friction: tangential forces are prescribed to zero"
                     : "no contact boundary");
  }
  decide("write fields", fields_asked, "not asked for (--fields)");
  return decisions;
}

}  // namespace airybench
