#include "solvers/loading/load_steps.hpp"

#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include <Eigen/LU>

#include "assembly/control_points.hpp"
#include "assembly/curved_traces.hpp"
#include "assembly/elements/bernstein.hpp"
#include "solvers/base/kept_body.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

// The polynomials of degree k that have the k + 1 moments of slip on every edge.
void add_of_contact_points(const ContactPoints& contact, const Eigen::VectorXd& slip,
                           Eigen::MatrixXd& slid) {
  const int k = contact.per_edge - 1;
  Eigen::MatrixXd moments_of(k + 1, k + 1);
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i) moments_of(j, i) = edge_moment(k, j, k, i);
  const Eigen::PartialPivLU<Eigen::MatrixXd> factor(moments_of);
  for (int p = 0; p < contact.count; p += k + 1) {
    const Eigen::VectorXd moments = slip(Eigen::seqN(2 * p + 1, k + 1, 2));
    slid.col(contact.boundary[p]) += factor.solve(moments);
  }
}

// Coefficients of nodes. A node that is held has no law, and slips as its displacement w says; not
// on one across that has: there all of the pair's slip is the other's.
void add_of_control_points(const Problem& problem, const ControlPoints& points,
                           const Eigen::VectorXd& slip, const DisplacementField& w,
                           Eigen::MatrixXd& slid) {
  std::map<int, double> of_node;
  for (int p = 0; p < points.law.count; ++p) of_node[points.node[p]] = slip(2 * p + 1);
  with_degree(static_cast<int>(slid.rows()) - 2, [&](auto k) {
    constexpr int p = k + 1;
    const CurvedTraces traces(problem, p);
    const DisplacementField d = traces.traces(w);
    for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
      if (problem.mesh.boundary[row].role != BoundaryRole::contact) continue;
      const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row);
      const std::array<ContactOffset, p + 1> offsets = traces.offsets<p>(row);
      const int other = problem.opposite_of(row);
      for (int i = 0; i <= p; ++i) {
        if (const auto found = of_node.find(nodes[i]); found != of_node.end())
          slid(i, row) += found->second;
        else if (other == Problem::no_row ||
                 !of_node.contains(boundary_nodes<p>(problem, other)[p - i]))
          slid(i, row) = traces.frame(row, i).tangent.dot(d.col(nodes[i]) + offsets[i].motion_mm);
      }
    }
  });
}

template <typename Value>
Value zero() {
  if constexpr (std::is_same_v<Value, double>)
    return 0;
  else
    return Value::Zero();
}

// Null functions are zero.
template <typename Value, typename... Arguments>
std::function<Value(Arguments...)> mean(const std::function<Value(Arguments...)>& a,
                                        const std::function<Value(Arguments...)>& b) {
  if (!a && !b) return {};
  return [a, b](Arguments... at) -> Value {
    return ((a ? a(at...) : zero<Value>()) + (b ? b(at...) : zero<Value>())) / 2;
  };
}

std::vector<ThermalStrain> mean(const std::vector<ThermalStrain>& a,
                                const std::vector<ThermalStrain>& b) {
  std::vector<ThermalStrain> half(std::max(a.size(), b.size()));
  for (const std::vector<ThermalStrain>* of : {&a, &b})
    for (std::size_t k = 0; k < of->size(); ++k) {
      half[k].at_origin += (*of)[k].at_origin / 2;
      half[k].slope_per_mm += (*of)[k].slope_per_mm / 2;
      half[k].modulus_zz_MPa = (*of)[k].modulus_zz_MPa;
    }
  return half;
}

Loads mean(const Loads& before, const Loads& after) {
  Loads half = after;
  half.displacement_mm = mean(before.displacement_mm, after.displacement_mm);
  half.traction_MPa = mean(before.traction_MPa, after.traction_MPa);
  half.gap_mm = mean(before.gap_mm, after.gap_mm);
  half.body_force_N_per_mm3 = (before.body_force_N_per_mm3 + after.body_force_N_per_mm3) / 2;
  half.thermal = mean(before.thermal, after.thermal);
  return half;
}

// With its rigid motion.
Loads all_loads(const Problem& problem) {
  Loads all = problem.loads;
  all.displacement_mm = [rest = problem.loads.displacement_mm, motion = problem.motion](
                            const Eigen::Vector2d& x, int row) -> Eigen::Vector2d {
    return motion.at(x) + (rest ? rest(x, row) : Eigen::Vector2d(0, 0));
  };
  return all;
}

}  // namespace

Problem with_half_steps(const Problem& first) {
  Loads before, after = all_loads(first);
  before.gap_mm = after.gap_mm;
  std::vector<Loads> steps = {mean(before, after), after};
  for (const Loads& step : first.later_steps) {
    const bool has_middle = same_supports(first, steps.back(), step);
    steps.push_back(has_middle ? mean(steps.back(), step) : step);
    steps.push_back(step);
  }
  Problem halved = with_loads(first, std::move(steps.front()));
  halved.later_steps.assign(std::next(steps.begin()), steps.end());
  return halved;
}

Eigen::MatrixXd slid_after(const ContactSystem& system, const Solution& answer) {
  const Problem& problem = *system.problem;
  if (!problem.has_friction() || system.contact.count == 0) return {};
  const bool in_displacements = answer.as<Displacements>() != nullptr;
  const Eigen::Index coefficients = system.degree + (in_displacements ? 2 : 1);
  Eigen::MatrixXd slid = problem.loads.slid_mm;
  if (slid.size() == 0) slid.setZero(coefficients, std::ssize(problem.mesh.boundary));
  if (slid.rows() != coefficients)
    throw std::invalid_argument("slip of degree " + std::to_string(slid.rows() - 1) +
                                " before a step of degree " + std::to_string(coefficients - 1));
  if (in_displacements) {
    const ControlPoints points = control_points(problem, system.degree + 1);
    add_of_control_points(problem, points, less_gap(points.law, answer.contact_displacement),
                          std::get<Displacements>(answer.unknowns).w, slid);
  } else {
    add_of_contact_points(system.contact, less_gap(system.contact, answer.contact_displacement),
                          slid);
  }
  return slid;
}

double dissipation_Nmm(const ContactSystem& system, const Solution& answer) {
  const Problem& problem = *system.problem;
  if (!problem.has_friction() || answer.contact_displacement.size() == 0) return 0;
  const ContactPoints law =
      answer.as<Displacements>() ? control_points(problem, system.degree + 1).law : system.contact;
  const Eigen::VectorXd slip = less_gap(law, answer.contact_displacement);
  double work = 0;
  for (int p = 0; p < law.count; ++p) work -= answer.F_C(2 * p + 1) * slip(2 * p + 1);
  return work;
}

Solution solve_load_case(const Solve& solve, ContactSystem& system, const RunControl& control) {
  Solution answer = run(solve, system, control);
  if (answer.free_motion_mm.size() > 0)
    system.set_load_case(
        std::make_shared<const Problem>(with_free_motion(*system.problem, answer.free_motion_mm)));
  return answer;
}

Solution solve_load_steps(const Solve& solve, ContactSystem& system, const RunControl& control,
                          const VisitStep& visit) {
  const std::shared_ptr<const Problem> first = system.problem;
  RunControl keeping = control;
  keeping.keep_body = !first->later_steps.empty();
  Solution answer = solve_load_case(solve, system, keeping);
  Solve again = std::exchange(answer.solve_again, nullptr);  // it has the body
  if (visit) visit(0, system, answer);
  for (std::size_t k = 0; k < first->later_steps.size() && has_answer(answer.status); ++k) {
    Loads loads = first->later_steps[k];
    loads.slid_mm = slid_after(system, answer);
    const bool is_new_body = !same_supports(*first, system.problem->loads, loads);
    system.set_load_case(std::make_shared<const Problem>(with_loads(*first, std::move(loads))));
    if (is_new_body) again = nullptr;
    RunControl from_here = is_new_body ? keeping : control;
    // Of displacements other nodes may have a law then.
    const bool has_same_points = !is_new_body || answer.as<Displacements>() == nullptr;
    if (has_same_points && answer.F_C.allFinite()) from_here.contact.start = std::move(answer.F_C);
    answer = solve_load_case(again ? again : solve, system, from_here);
    if (answer.solve_again) again = std::exchange(answer.solve_again, nullptr);
    if (visit) visit(static_cast<int>(k) + 1, system, answer);
  }
  return answer;
}

Solution solve_load_steps(const Method& method, const std::shared_ptr<const Problem>& first,
                          const RunControl& control, const VisitStep& visit) {
  const std::unique_ptr<ContactSystem> system = assemble(method, first);
  return solve_load_steps(method.solve, *system, control, visit);
}

}  // namespace airybench
