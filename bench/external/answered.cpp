#include "bench/external/answered.hpp"

#include <utility>

#include "assembly/control_points.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/methods.hpp"

namespace airybench {
namespace {

// Coefficients of w = u − motion, from u at vertices and at the middles of edges.
DisplacementField displacement_of(const Problem& problem, const Eigen::MatrixX2d& values) {
  const auto& x = problem.mesh.vertices;
  const auto vertices = static_cast<Eigen::Index>(x.size());
  DisplacementField w = values.transpose();
  for (Eigen::Index v = 0; v < vertices; ++v) w.col(v) -= problem.motion.at(x[v]);
  for (Eigen::Index edge = vertices; edge < w.cols(); ++edge) {
    const auto& [a, b] = problem.edges.vertices[edge - vertices];
    const Eigen::Vector2d middle = w.col(edge) - problem.motion.at((x[a] + x[b]) / 2);
    w.col(edge) = edge_coefficients<Eigen::Vector2d>(w.col(a), middle, w.col(b))[1];
  }
  return w;
}

// The same with another contact law, and so every load case that follows.
template <typename Posed>
std::function<Solution(const Posed&, const RunControl&)> with_law(
    std::function<Solution(const Posed&, const RunControl&)> solve, ContactLaw law) {
  return [solve = std::move(solve), law = std::move(law)](const Posed& posed,
                                                          const RunControl& given) {
    RunControl control = given;
    control.contact.by = [&](const contact::Problem& problem) {
      ContactResult result;
      result.F_C = law(problem);
      result.converged = true;  // as it claims
      return result;
    };
    Solution solution = solve(posed, control);
    if (solution.solve_again)
      solution.solve_again = with_law<ContactSystem>(std::move(solution.solve_again), law);
    return solution;
  };
}

Method named(Method method, const std::string& name, const std::string& summary) {
  method.name = method.family = name;
  method.summary = summary;
  method.knob = AccuracyKnob::none;
  return method;
}

Solution claimed_ok() {
  Solution solution;
  solution.status = Status::ok;
  solution.message.clear();
  return solution;
}

}  // namespace

void take_airy_unknowns(const AirySystem& system, const Eigen::VectorXd& x, Solution& solution) {
  const StageTimer timer(solution.times, Stage::recover);
  Eigen::VectorXd phi = airy_function(system, x);
  solution.stress = stress_of_airy_function(*system.problem, phi);
  solution.unknowns = AiryFunction{std::move(phi)};
}

void take_displacement(const Problem& problem, const Eigen::MatrixX2d& u,
                       const ProgramTolerances& tolerances, Solution& solution) {
  const StageTimer timer(solution.times, Stage::recover);
  DisplacementField w = displacement_of(problem, u);
  solution.stress = stress_of_displacement(problem, w);
  const ControlPoints points = control_points(problem);
  solution.F_C = contact_reactions(problem, points, w);
  solution.contact_displacement = displacement_at(points, w);
  solution.unknowns = Displacements{std::move(w), tolerances};
}

Method contact_law_method(ContactLaw law, const std::string& name, const std::string& summary,
                          int degree) {
  Method method = named(select_methods("HYBRID", {}, degree).front(), name, summary);
  method.solve = with_law<ContactSystem>(std::move(method.solve), law);
  method.solve_contact =
      with_law<contact::Problem>(condensed_contact().solve_contact, std::move(law));
  return method;
}

Method airy_method(AiryUnknowns solve, const std::string& name, const std::string& summary) {
  Method method = named({.stages = {Stage::recover}}, name, summary);
  method.solve =
      on_airy_system([solve = std::move(solve)](const AirySystem& system, const RunControl&) {
        Solution solution = claimed_ok();
        const Eigen::VectorXd x = solve(system);
        if (system.n_c() > 0) {
          solution.F_C = system.C_C * x;
          if (system.F0.size() > 0) solution.F_C += system.F0;
        }
        take_airy_unknowns(system, x, solution);
        return solution;
      });
  return method;
}

Method displacement_method(QuadraticDisplacement solve, const ProgramTolerances& tolerances,
                           const std::string& name, const std::string& summary) {
  Method method = named(
      {.unknowns = Unknowns::displacements, .takes_load_steps = false, .stages = {Stage::recover}},
      name, summary);
  method.solve = [solve = std::move(solve), tolerances](const ContactSystem& system,
                                                        const RunControl&) {
    Solution solution = claimed_ok();
    take_displacement(*system.problem, solve(*system.problem), tolerances, solution);
    return solution;
  };
  return method;
}

}  // namespace airybench
