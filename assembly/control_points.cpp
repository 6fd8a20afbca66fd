#include "assembly/control_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "assembly/curved_traces.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/free_bodies.hpp"
#include "assembly/nodal_forces.hpp"
#include "assembly/rigid_contact.hpp"

namespace airybench {
namespace {

// Where one node of a pair is prescribed, the other presses on it as on a wall that moves.
template <int p>
void pair_points(const Problem& problem, const CurvedTraces& traces,
                 const PrescribedDisplacement& prescribed, ControlPoints& points,
                 std::vector<ContactOffset>& offset) {
  std::map<int, int> point_of_node;
  for (int i = 0; i < points.law.count; ++i) point_of_node[points.node[i]] = i;
  points.law.opposite.assign(static_cast<std::size_t>(points.law.count), ContactPoints::no_point);
  const std::vector<ContactOffset> own = offset;
  std::map<int, double> min_gap_mm;  // of both, by the first: over the edges that meet there
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    const int other = problem.opposite_of(row);
    if (other == Problem::no_row) continue;
    const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row),
                                 others = boundary_nodes<p>(problem, other);
    const std::array<ContactOffset, p + 1> of_own = traces.offsets<p>(row),
                                           of_others = traces.offsets<p>(other);
    for (int k = 0; k <= p; ++k) {
      const int across = others[p - k];
      const ContactOffset& beyond = of_others[p - k];
      const auto one = point_of_node.find(nodes[k]), two = point_of_node.find(across);
      if (one == point_of_node.end()) continue;
      const int point = one->second;
      if (two != point_of_node.end()) {
        points.law.opposite[point] = two->second;
        if (points.on_roller[point] || points.on_roller[two->second]) continue;
        const double gap_mm = of_own[k].gap_mm + beyond.gap_mm;
        const auto [least, is_new] = min_gap_mm.try_emplace(std::min(point, two->second), gap_mm);
        if (!is_new) least->second = std::min(least->second, gap_mm);
      } else if (prescribed.at[across]) {
        const Eigen::Vector2d moved = prescribed.u.col(across) + beyond.motion_mm;
        offset[point].gap_mm = own[point].gap_mm + beyond.gap_mm + points.normal[point].dot(moved);
        offset[point].slid_mm =
            own[point].slid_mm + beyond.slid_mm + points.frame(point).col(1).dot(moved);
      }
    }
  }
  for (const auto& [point, gap_mm] : min_gap_mm) {
    offset[point].gap_mm = gap_mm;
    offset[points.law.opposite[point]].gap_mm = 0;
  }
}

// A motion of the body as a node's d (curved_traces.hpp).
template <int p>
Eigen::Vector2d motion_of_node(const Problem& problem, const CurvedTraces& traces,
                               const ControlPoints& points, const RigidMotion& motion, int point) {
  const int row = points.law.boundary[point];
  const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row);
  const auto i = std::ranges::find(nodes, points.node[point]) - nodes.begin();
  return traces.traces_on(row, [&](const Eigen::Vector2d& x) { return motion.at(x); }).col(i);
}

// Of a node that moves along `free` only, from u = held on: how far to the wall, and minus the slip
// when it is there, which friction opposes.
ContactOffset offset_on_roller(const ContactOffset& own, const EdgeFrame& face,
                               const Eigen::Vector2d& held, const Eigen::Vector2d& free) {
  constexpr double rounding = 1e-12;
  const Eigen::Vector2d moved = held + own.motion_mm;
  const double gap_mm = (own.gap_mm - face.normal.dot(moved)) / face.normal.dot(free),
               slip_mm = face.tangent.dot(moved + gap_mm * free) - own.slid_mm;
  const bool rests = std::abs(slip_mm) <= rounding * (held.norm() + own.motion_mm.norm());
  return {.gap_mm = gap_mm, .slid_mm = rests ? 0 : -slip_mm};
}

// Of a crack: one vertex of both faces, which nothing parts.
bool is_tip(const Problem& problem, int row, int vertex) {
  const int other = problem.opposite_of(row);
  return other != Problem::no_row &&
         std::ranges::count(problem.mesh.boundary[other].vertices, vertex) > 0;
}

template <int p>
ControlPoints control_points(const Problem& problem) {
  ControlPoints points;
  points.law.components = problem.has_friction() ? 2 : 1;
  const Mesh& mesh = problem.mesh;
  std::vector<double> friction;
  std::vector<ContactOffset> offset;
  const CurvedTraces traces(problem, p);
  std::optional<PrescribedDisplacement> prescribed;
  std::map<int, int> point_of_node;
  const auto add = [&](int node, const Eigen::Vector2d& normal, bool on_roller, int row,
                       const ContactOffset& own) {
    points.node.push_back(node);
    points.normal.push_back(normal);
    points.on_roller.push_back(on_roller);
    points.law.boundary.push_back(row);
    friction.push_back(problem.friction_at(row));
    offset.push_back(own);
  };
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::contact) continue;
    if (!prescribed) prescribed = traces.prescribed();
    const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row);
    const std::array<ContactOffset, p + 1> offsets = traces.offsets<p>(row);
    for (int k = 0; k <= p; ++k) {
      if (prescribed->at[nodes[k]] || is_tip(problem, row, nodes[k])) continue;
      const EdgeFrame frame = traces.frame(row, k);
      const Eigen::Vector2d& normal = frame.normal;
      if (const auto roller = prescribed->normal.find(nodes[k]);
          roller != prescribed->normal.end()) {
        const Eigen::Vector2d& m = roller->second;
        const Eigen::Vector2d along(-m.y(), m.x());
        const double cosine = normal.dot(along);
        if (std::abs(cosine) < straight_roller) continue;  // parallel: the roller holds u_n
        const Eigen::Vector2d free = cosine > 0 ? along : Eigen::Vector2d(-along);
        add(nodes[k], free, true, row,
            offset_on_roller(offsets[k], frame, prescribed->u.col(nodes[k]), free));
        continue;
      }
      const auto [found, is_new] =
          point_of_node.try_emplace(nodes[k], static_cast<int>(points.node.size()));
      if (is_new) {
        add(nodes[k], normal, false, row, offsets[k]);
      } else {
        const int point = found->second;
        points.normal[point] = (points.normal[point] + normal).normalized();
        offset[point].gap_mm = std::min(offset[point].gap_mm, offsets[k].gap_mm);
        friction[point] = std::min(friction[point], problem.friction_at(row));
      }
    }
  }
  points.law.count = static_cast<int>(points.node.size());
  if (!problem.opposite.empty()) pair_points<p>(problem, traces, *prescribed, points, offset);
  if (points.law.components == 2) points.law.friction = std::move(friction);
  if (problem.has_gap() || std::ranges::any_of(offset, [](const ContactOffset& own) {
        return own.gap_mm != 0 || own.slid_mm != 0;
      })) {
    const int m = points.law.components;
    points.law.gap.resize(points.law.size());
    for (int i = 0; i < points.law.count; ++i)
      points.law.gap.segment(m * i, m) = offset[i].along(points.normal[i]).head(m);
  }
  add_free_bodies(
      problem, p,
      [&](const RigidMotion& motion, int i) -> Eigen::Vector2d {
        return points.frame(i).transpose() * motion_of_node<p>(problem, traces, points, motion, i);
      },
      points.law);
  return points;
}

}  // namespace

ControlPoints control_points(const Problem& problem, int degree) {
  return with_degree(degree - 1, [&](auto k) { return control_points<k + 1>(problem); });
}

std::string why_no_control_points(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  std::map<int, int> faced;  // per vertex; no_row: a wall
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::contact) continue;
    const int other = problem.opposite_of(row);
    for (const std::size_t end : {0U, 1U}) {
      const int v = mesh.boundary[row].vertices[end],
                w = other == Problem::no_row ? other : mesh.boundary[other].vertices[1 - end];
      if (faced.try_emplace(v, w).first->second != w)
        return "a vertex with two partners, at " + words_of_place(mesh.vertices[v]) +
               ", where these methods have one contact law";
    }
  }
  return "";
}

Eigen::VectorXd displacement_at(const ControlPoints& points, const DisplacementField& d) {
  const int m = points.law.components;
  Eigen::VectorXd of_points(points.law.size());
  for (int p = 0; p < points.law.count; ++p)
    for (int k = 0; k < m; ++k)
      of_points(m * p + k) =
          k == 1 && points.on_roller[p] ? 0 : points.frame(p).col(k).dot(d.col(points.node[p]));
  return of_points;
}

namespace {

// Of the point across where that one is free to slip, else by Coulomb's law against the known slip.
double friction_on_roller(const ControlPoints& points, const Eigen::VectorXd& F, int point) {
  const int across = points.law.opposite_of(point);
  const bool is_alone = across == ContactPoints::no_point;
  if (!is_alone && !points.on_roller[across]) return F(2 * across + 1);
  if (points.law.gap.size() == 0) return 0;
  const double slip_mm =
      -points.law.gap(2 * point + 1) - (is_alone ? 0 : points.law.gap(2 * across + 1));
  if (slip_mm == 0) return 0;
  return std::copysign(points.law.friction_at(point) * std::max(0.0, -F(2 * point)), -slip_mm);
}

}  // namespace

Eigen::VectorXd contact_reactions(const Problem& problem, const ControlPoints& points,
                                  const DisplacementField& w) {
  const int degree = displacement_degree(problem, w);
  const Eigen::Matrix2Xd force =
      CurvedTraces(problem, degree)
          .forces(nodal_forces(problem, w).sum - nodal_loads(problem, degree));
  const int m = points.law.components;
  Eigen::VectorXd F(points.law.size());
  for (int p = 0; p < points.law.count; ++p) {
    F.segment(m * p, m) = (points.frame(p).transpose() * force.col(points.node[p])).head(m);
  }
  for (int p = 0; p < points.law.count; ++p)  // of the nodal force the roller has an unknown part
    if (m == 2 && points.on_roller[p]) F(2 * p + 1) = friction_on_roller(points, F, p);
  return F;
}

}  // namespace airybench
