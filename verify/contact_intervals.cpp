#include "verify/contact_intervals.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/elements/bernstein.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/nodal_forces.hpp"
#include "verify/along_contact.hpp"

namespace airybench {
namespace {

EdgeFrame frame_of(const Mesh& mesh, int row) {
  const auto [a, b] = mesh.boundary[row].vertices;
  return edge_frame(mesh.vertices[a], mesh.vertices[b]);
}

// sum_N: that of σ, from which its work differs by rounding and on curves. error: of the mean.
std::optional<Bracket> resultant(const Problem& problem, const StressField& mean,
                                 const StressField& stress, double sum_N, double error,
                                 double rounding_N, const std::optional<Lift>& lift) {
  if (!lift) return {};
  double of_mean = -work_of_loads(problem, lift->v, sides_of_stresses(stress.degree())),
         of_stress = of_mean;
  for (int t = 0; t < static_cast<int>(mean.size()); ++t) {
    of_mean += stress_product(problem, t, mean, lift->stress);
    of_stress += stress_product(problem, t, stress, lift->stress);
  }
  const double half = error * lift->norm + std::abs(sum_N - of_stress) + rounding_N;
  return Bracket{of_mean - half, of_mean + half};
}

// Among these rows chords of a curve, which are not parallel.
bool has_polygon(const Problem& problem, int degree, const std::vector<bool>& asked) {
  const Mesh& mesh = problem.mesh;
  for (const std::vector<int>& rows : boundary_chains(mesh, BoundaryRole::contact)) {
    std::optional<Eigen::Vector2d> first;
    for (const int row : rows) {
      if (!asked[row]) continue;
      const Eigen::Vector2d normal = frame_of(mesh, row).normal;
      if (!first) first = normal;
      if (!problem.follows_curve(row, degree) && (normal - *first).norm() > straight_roller)
        return true;
    }
  }
  return false;
}

// Of all faces; an error elsewhere has its size from there.
struct Pressures {
  const Problem& problem;
  const StressField &stress, of_u;
  const ConstitutiveError& error;
  std::vector<TriangleSide> sides;
  double largest_MPa;
};

void set_largest_pressure(const Pressures& all, const std::vector<bool>& asked,
                          FaceIntervals& result) {
  constexpr double useful = 0.5;
  const Problem& problem = all.problem;
  const LargestPressure of_stress = largest_pressure(problem, all.stress, asked, all.sides);
  const double p = result.largest_pressure_MPa = of_stress.pressure_MPa;
  result.largest_pressure_at_mm = of_stress.at_mm;
  if (result.peak != PressurePeak::bounded) return;
  const double of_u = largest_pressure(problem, all.of_u, asked, all.sides).pressure_MPa;
  const int t = of_stress.triangle;
  const Eigen::Vector2d& n = of_stress.normal;
  const Eigen::Vector3d nn(n.x() * n.x(), n.y() * n.y(), 2 * n.x() * n.y());  // n⊗n as a strain
  const double stiffness_MPa = nn.dot(elasticity_of(problem.compliance_of(t)) * nn),
               off = twice_estimated_error_MPa(problem, all.error, t, stiffness_MPa, p - of_u,
                                               std::max(0.0, all.largest_MPa)),
               least = has_polygon(problem, all.stress.degree(), asked) ? of_stress.of_edge_MPa : p;
  if (off <= useful * p)
    result.largest_pressure_within_MPa = Bracket{std::max(0.0, least - off), p + off};
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

std::vector<ContactEnd> contact_ends(const ContactSystem& system, const Eigen::VectorXd& F_C) {
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

double twice_estimated_error_MPa(const Problem& problem, const ConstitutiveError& error,
                                 int triangle, double stiffness_MPa, double difference_MPa,
                                 double far_MPa) {
  constexpr double safety = 2;
  const double in_triangle = std::sqrt(std::max(0.0, error.of_triangle_Nmm[triangle]) *
                                       stiffness_MPa / problem.area_mm2(triangle));
  return safety *
         (std::abs(difference_MPa) + in_triangle + far_MPa * error.relative * error.relative);
}

LargestPressure largest_pressure(const Problem& problem, const StressField& stress,
                                 const std::vector<bool>& asked,
                                 const std::vector<TriangleSide>& sides) {
  LargestPressure peak;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (!asked[row] || problem.mesh.boundary[row].role != BoundaryRole::contact) continue;
    const auto [t, k] = sides[static_cast<std::size_t>(row)];
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
    const LargestValue largest = largest_value(pressure, {peak.pressure_MPa});
    if (largest.value <= peak.pressure_MPa) continue;
    peak.pressure_MPa = largest.value;
    peak.triangle = t;
    peak.normal = frame.normal;
    peak.at_mm = point_on_edge(problem, row, stress.degree(), largest.s);
  }
  return peak;
}

std::optional<ContactIntervals> contact_intervals(
    const ContactSystem& system, const StressField& stress, const Eigen::VectorXd& F_C,
    const DisplacementField& u, const ConstitutiveError& error, const ResultantLifts& lifts) {
  if (system.contact.count == 0) return {};
  const Problem& problem = *system.problem;
  const int m = system.contact.components;
  const StressField mean = mean_stress(problem, stress, u);
  const double of_mean = std::sqrt(std::max(0.0, error.squared_of_mean_Nmm())),
               rounding_N = 1e-11 * F_C.lpNorm<1>();
  const std::vector<bool> all(problem.mesh.boundary.size(), true);
  Pressures pressures{
      problem, stress, stress_of_displacement(problem, u), error, boundary_sides(problem.edges), 0};
  pressures.largest_MPa = largest_pressure(problem, stress, all, pressures.sides).pressure_MPa;
  const auto set = [&](const std::vector<bool>& asked, const FaceLifts& own, FaceIntervals& of) {
    Eigen::Vector2d sum_N(0, 0);  // of a pair one edge's forces
    for (int p = 0; p < system.contact.count; ++p) {
      const int row = system.contact.boundary[p];
      if (!asked[row] || problem.is_second_of_pair(row)) continue;
      for (int component = 0; component < m; ++component)
        sum_N(component) += F_C(m * p + component);
    }
    of.normal_resultant_N =
        resultant(problem, mean, stress, sum_N.x(), of_mean, rounding_N, own.normal);
    of.tangential_resultant_N =
        resultant(problem, mean, stress, sum_N.y(), of_mean, rounding_N, own.tangential);
    of.peak = pressure_peak(system, F_C, asked);
    set_largest_pressure(pressures, asked, of);
  };
  ContactIntervals result;
  result.guaranteed = error.guaranteed;
  set(all, lifts.of_all, result);
  for (std::size_t face = 0; face < lifts.faces.size(); ++face)
    set(is_on_face(problem, lifts.faces[face]), lifts.of_faces[face], result.faces.emplace_back());
  result.ends = contact_ends(system, F_C);
  return result;
}

}  // namespace airybench
