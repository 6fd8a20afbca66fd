#include "bench/verify/contact_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "assembly/elements/bernstein.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "bench/verify/along_contact.hpp"
#include "bench/verify/displacement_recovery.hpp"
#include "solvers/methods.hpp"

namespace airybench {
namespace {

EdgeFrame frame_of(const Mesh& mesh, int row) {
  const auto [a, b] = mesh.boundary[row].vertices;
  return edge_frame(mesh.vertices[a], mesh.vertices[b]);
}

// Per row: the contact edges that v moves, walls and of each pair the edge whose normal is that of
// the walls, or of the first edge. Empty if they have several normals, or a vertex on Γ_D.
std::vector<bool> moved_edges(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  std::vector<bool> is_held(mesh.vertices.size(), false), is_moved(mesh.boundary.size(), false);
  for (const BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::displacement)
      for (const int v : edge.vertices) is_held[v] = true;
  std::vector<int> rows;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
    if (mesh.boundary[row].role == BoundaryRole::contact) rows.push_back(row);
  std::stable_partition(rows.begin(), rows.end(),
                        [&](int row) { return problem.opposite_of(row) == Problem::no_row; });
  for (const int row : rows) {
    const Eigen::Vector2d normal = frame_of(mesh, rows.front()).normal,
                          own = frame_of(mesh, row).normal;
    const auto differs = [&](const Eigen::Vector2d& n) {
      return (n - own).norm() > straight_roller;
    };
    for (const int i : {0, 1, 2})
      if (differs(problem.frame_at(row, i, 2).normal)) return {};
    if (problem.opposite_of(row) != Problem::no_row && !differs(-normal)) continue;
    if (differs(normal)) return {};
    for (const int v : mesh.boundary[row].vertices)
      if (is_held[v]) return {};
    is_moved[row] = true;
  }
  return is_moved;
}

// v = 0 on Γ_D, [v] = n or t on Γ_C (without friction only n·[v] = 1, unless that leaves a body
// free). Empty if HYBRID fails.
std::optional<DisplacementField> lifted(const Problem& problem, const std::vector<bool>& is_moved,
                                        int degree, bool tangential) {
  Mesh mesh = problem.mesh;
  Loads loads;
  loads.rollers.assign(mesh.boundary.size(), false);
  std::vector<Eigen::Vector2d> on_edge(mesh.boundary.size(), Eigen::Vector2d::Zero());
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role == BoundaryRole::contact) {
      const EdgeFrame frame = frame_of(mesh, row);
      if (is_moved[row]) on_edge[row] = tangential ? frame.tangent : frame.normal;
      loads.rollers[row] = !problem.has_friction() && problem.free.motions.empty();
      mesh.boundary[row].role = BoundaryRole::displacement;
    } else {
      loads.rollers[row] = problem.is_roller(row);
    }
  }
  loads.displacement_mm = [on_edge](const Eigen::Vector2d&, int row) { return on_edge[row]; };
  const DualSystem system = assemble(std::make_shared<const Problem>(make_problem(
                                         std::move(mesh), problem.compliance, std::move(loads), 0)),
                                     Blocks::contact_points, degree);
  const Solution solution = run(select_methods(hybrid_of_degree(degree)).front(), system, {});
  if (solution.status != Status::ok) return {};
  return with_rigid_motion(
      *system.problem,
      recovered_displacement(system, solution.stress, solution.F_C, solution.edge_moments));
}

std::optional<Bracket> resultant(const Problem& problem, const StressField& mean, double error,
                                 const std::optional<DisplacementField>& v) {
  if (!v) return {};
  const StressField strained = stress_of_displacement(problem, *v);
  double work = -work_of_loads(problem, *v);
  for (int t = 0; t < static_cast<int>(mean.size()); ++t)
    work += stress_product(problem, t, mean, strained);
  const double half = error * std::sqrt(stress_norm_squared(problem, strained));
  return Bracket{work - half, work + half};
}

struct LargestPressure {
  double pressure_MPa = -std::numeric_limits<double>::infinity();
  double of_edge_MPa = pressure_MPa;  // the largest mean over an edge
  int triangle = 0;
  Eigen::Vector2d normal = {0, 0};
};

LargestPressure largest_pressure(const Problem& problem, const StressField& stress) {
  std::vector<int> contact_row(static_cast<std::size_t>(problem.edges.count()), -1);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    if (problem.mesh.boundary[row].role == BoundaryRole::contact)
      contact_row[problem.edges.of_boundary[row]] = row;
  LargestPressure peak;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int row = contact_row[problem.edges.of_triangle[t][k]];
      if (row < 0) continue;
      const bool is_curved = problem.follows_curve(row, stress.degree());
      const ForcesOnEdge forces = is_curved
                                      ? curved_edge_forces(problem.vertices_of(t), stress[t], k,
                                                           problem.curve_of(row, stress.degree()))
                                      : element_edge_forces(problem.vertices_of(t), stress[t], k);
      EdgeFrame frame = frame_of(problem.mesh, row);
      AlongEdge normal_forces(stress.degree() + 1);
      for (int j = 0; j <= stress.degree(); ++j) {
        if (is_curved) frame = problem.frame_of_moment(row, stress.degree(), j);
        normal_forces(j) = frame.normal.dot(forces.col(j));
      }
      const AlongEdge pressure = pressure_along(problem, row, normal_forces);
      peak.of_edge_MPa = std::max(peak.of_edge_MPa, pressure.mean());
      const double largest = largest_value(pressure, {peak.pressure_MPa}).value;
      if (largest > peak.pressure_MPa) {
        peak.pressure_MPa = largest;
        peak.triangle = t;
        peak.normal = frame.normal;
      }
    }
  return peak;
}

// A contact face of chords that are not parallel.
bool has_polygon(const Problem& problem, int degree) {
  const Mesh& mesh = problem.mesh;
  for (const std::vector<int>& rows : boundary_chains(mesh, BoundaryRole::contact))
    for (const int row : rows)
      if (!problem.follows_curve(row, degree) &&
          (frame_of(mesh, row).normal - frame_of(mesh, rows.front()).normal).norm() >
              straight_roller)
        return true;
  return false;
}

void set_largest_pressure(const Problem& problem, const StressField& stress,
                          const DisplacementField& u, const ConstitutiveError& error,
                          ContactIntervals& result) {
  constexpr double safety = 2, useful = 0.5;
  const LargestPressure of_stress = largest_pressure(problem, stress);
  const double p = result.largest_pressure_MPa = of_stress.pressure_MPa;
  if (result.peak != PressurePeak::bounded) return;
  const double of_u = largest_pressure(problem, stress_of_displacement(problem, u)).pressure_MPa;
  const int t = of_stress.triangle;
  const Eigen::Vector2d& n = of_stress.normal;
  const Eigen::Vector3d nn(n.x() * n.x(), n.y() * n.y(), 2 * n.x() * n.y());  // n⊗n as a strain
  const double stiffness_MPa = nn.dot(elasticity_of(problem.compliance_of(t)) * nn),
               own = std::sqrt(std::max(0.0, error.of_triangle_Nmm[t]) * stiffness_MPa /
                               problem.area_mm2(t)),
               from_afar = std::max(0.0, p) * error.relative * error.relative,
               delta = safety * (std::abs(p - of_u) + own + from_afar),
               least = has_polygon(problem, stress.degree()) ? of_stress.of_edge_MPa : p;
  if (delta <= useful * p)
    result.largest_pressure_within_MPa = Bracket{std::max(0.0, least - delta), p + delta};
}

// rows: of Mesh::boundary, in walking order. of_row: the states of their points, n per edge.
void add_ends(const Mesh& mesh, const std::vector<int>& rows,
              const std::vector<std::vector<ContactState>>& of_row, int n, int face,
              std::vector<ContactEnd>& ends) {
  std::vector<double> along = {0};  // ends of edges, mm
  for (const int row : rows) along.push_back(along.back() + frame_of(mesh, row).length_mm);
  const int count = static_cast<int>(rows.size());
  const bool is_closed =
      mesh.boundary[rows.front()].vertices[0] == mesh.boundary[rows.back()].vertices[1];
  const auto at = [&](int k) {  // wraps around a closed face
    if (!is_closed) return along[std::clamp(k, 0, count)];
    const int turns = k < 0 ? -1 : k / count;
    return turns * along.back() + along[k - turns * count];
  };
  const auto state = [&](int point) {
    const int on_face = (point + n * count) % (n * count);
    return of_row[rows[on_face / n]][on_face % n];
  };
  const std::size_t first = ends.size();
  for (int point = is_closed ? 0 : 1; point < n * count; ++point) {
    if (state(point) == state(point - 1)) continue;
    ContactEnd end{face, state(point - 1), state(point), {0, 0}, {}};
    end.along_face_mm = {at((point + n - 1) / n - 2), at(point / n + 2)};
    if (ends.size() > first && ends.back().along_face_mm.high > end.along_face_mm.low) {
      ends.back().along_face_mm.high = end.along_face_mm.high;  // intervals overlap: one end
      ends.back().after = end.after;
    } else {
      ends.push_back(end);
    }
  }
  if (is_closed && ends.size() > first + 1 &&
      ends.back().along_face_mm.high - along.back() > ends[first].along_face_mm.low) {
    ends[first].along_face_mm.low = ends.back().along_face_mm.low - along.back();
    ends[first].before = ends.back().before;
    ends.pop_back();
  }
  std::erase_if(ends, [](const ContactEnd& end) { return end.before == end.after; });
  for (std::size_t k = first; k < ends.size(); ++k) {
    const auto [low, high] = ends[k].along_face_mm;
    double middle = (low + high) / 2;
    if (is_closed) middle -= along.back() * std::floor(middle / along.back());
    const auto beyond = std::ranges::upper_bound(along, middle);
    // Rounding may leave it at the end of a closed face.
    const auto edge = std::min(static_cast<std::size_t>(beyond - along.begin()), rows.size()) - 1;
    const int row = rows[edge];
    ends[k].at_mm = mesh.vertices[mesh.boundary[row].vertices[0]] +
                    (middle - along[edge]) * frame_of(mesh, row).tangent;
  }
}

std::vector<ContactEnd> contact_ends(const DualSystem& system, const Eigen::VectorXd& F_C) {
  const Mesh& mesh = system.problem->mesh;
  const std::vector<ContactState> states = contact_states(system.contact, F_C);
  std::vector<std::vector<ContactState>> of_row(mesh.boundary.size());
  for (int p = 0; p < system.contact.count; ++p)
    of_row[system.contact.boundary[p]].push_back(states[p]);
  std::vector<ContactEnd> ends;
  int face = 0;
  for (const std::vector<int>& rows : boundary_chains(mesh, BoundaryRole::contact))
    add_ends(mesh, rows, of_row, system.contact.per_edge, face++, ends);
  return ends;
}

}  // namespace

ResultantLifts resultant_lifts(const Problem& problem, int degree) {
  const std::vector<bool> is_moved = moved_edges(problem);
  if (std::ranges::none_of(is_moved, std::identity())) return {};
  ResultantLifts lifts;
  lifts.normal = lifted(problem, is_moved, degree, false);
  if (problem.has_friction()) lifts.tangential = lifted(problem, is_moved, degree, true);
  return lifts;
}

std::optional<ContactIntervals> contact_intervals(
    const DualSystem& system, const StressField& stress, const Eigen::VectorXd& F_C,
    const DisplacementField& u, const ConstitutiveError& error, const ResultantLifts& lifts) {
  if (system.contact.count == 0) return {};
  const Problem& problem = *system.problem;
  ContactIntervals result;
  result.guaranteed = error.guaranteed;
  if (lifts.normal) {
    const StressField mean = mean_stress(problem, stress, u);
    const double of_mean = std::sqrt(std::max(0.0, error.squared_of_mean_Nmm()));
    result.normal_resultant_N = resultant(problem, mean, of_mean, lifts.normal);
    result.tangential_resultant_N = resultant(problem, mean, of_mean, lifts.tangential);
  }
  result.peak = pressure_peak(system, F_C);
  set_largest_pressure(problem, stress, u, error, result);
  result.ends = contact_ends(system, F_C);
  return result;
}

}  // namespace airybench
