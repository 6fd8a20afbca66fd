#include "verify/displacement_constraints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "assembly/elements/edge_forces.hpp"

namespace airybench {
namespace {

// Per node and partner.
using NodePairs = std::map<std::pair<int, int>, ContactNode>;

template <int k>
NodePairs contact_nodes(const ContactSystem& system, const CurvedTraces& traces,
                        const Eigen::VectorXd& F_C) {
  constexpr int p = k + 1;
  const Problem& problem = *system.problem;
  const int m = system.contact.components;
  NodePairs contact;
  for (int point = 0; point < system.contact.count; point += k + 1) {
    const int row = system.contact.boundary[point], other = problem.opposite_of(row);
    if (problem.is_second_of_pair(row)) continue;
    const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row);
    std::array<int, p + 1> partners;
    partners.fill(ContactNode::none);
    std::array<ContactOffset, p + 1> offset = traces.offsets<p>(row);
    if (other != Problem::no_row) {
      partners = boundary_nodes<p>(problem, other);
      std::ranges::reverse(partners);
      const std::array<ContactOffset, p + 1> beyond = traces.offsets<p>(other);
      for (int i = 0; i <= p; ++i) {
        offset[i].gap_mm += beyond[p - i].gap_mm;
        offset[i].slid_mm += beyond[p - i].slid_mm;
        offset[i].motion_mm -= beyond[p - i].motion_mm;
      }
    }
    const std::array<double, p + 1> lowered = elevated<p>(problem.wall_detail_at(row).lowered_mm);
    for (int i = 0; i <= p; ++i) {
      if (partners[i] == nodes[i]) continue;  // the tip of a crack
      // Of two edges at a node either body may have the first row: the difference is the lower
      // node's less the other's.
      const bool is_turned = partners[i] != ContactNode::none && partners[i] < nodes[i];
      const double sign = is_turned ? -1 : 1;
      const auto [lower, upper] =
          is_turned ? std::pair(partners[i], nodes[i]) : std::pair(nodes[i], partners[i]);
      ContactNode& node = contact[{lower, upper}];
      node.partner = upper;
      const EdgeFrame frame = traces.frame(row, i);
      const Eigen::Vector2d& normal = frame.normal;
      node.walls.push_back(
          {sign * normal, offset[i].gap_mm - lowered[i] - normal.dot(offset[i].motion_mm)});
      node.offset = offset[i];
      node.offset.motion_mm *= sign;
      node.friction = std::min(node.friction, system.contact.friction_at(point));
      for (int j = 0; j <= k; ++j) {
        const int at = m * (point + j);
        node.force += sign * edge_moment(k, j, p, i) *
                      (F_C(at) * frame.normal + (m == 2 ? F_C(at + 1) : 0) * frame.tangent);
      }
    }
  }
  return contact;
}

Eigen::Vector2d behind(const std::vector<Barrier>& walls, const Eigen::Vector2d& w) {
  const auto moved = [](const Barrier& wall, const Eigen::Vector2d& x) {
    return Eigen::Vector2d(x - std::max(0.0, wall.excess(x)) * wall.normal);
  };
  const Barrier &one = walls.front(), &other = walls.back();
  const Eigen::Vector2d &n = one.normal, &m = other.normal;
  const double sine = n.x() * m.y() - n.y() * m.x();
  if (std::abs(sine) < straight_roller) return moved(one, moved(other, moved(one, w)));
  if (const Eigen::Vector2d x = moved(one, w); other.excess(x) <= 0) return x;
  if (const Eigen::Vector2d x = moved(other, w); one.excess(x) <= 0) return x;
  return Eigen::Vector2d(one.limit * m.y() - other.limit * n.y(),
                         other.limit * n.x() - one.limit * m.x()) /
         sine;
}

// See apply().
Eigen::Vector2d in_contact(const ContactNode& node, double k, const Eigen::Vector2d& w_0) {
  const Eigen::Vector2d n = node.normal(), t(-n.y(), n.x());
  const double slope = node.friction * std::abs(n.dot(node.force)) / k,
               at_rest = node.offset.along(n).y(), slid = t.dot(w_0 - node.force / k) - at_rest;
  const double w_n = n.dot(w_0 - node.force / k),
               w_t = at_rest + std::copysign(std::max(0.0, std::abs(slid) - slope), slid);
  return behind(node.walls, w_n * n + w_t * t);
}

// How far to move a node back from a wall, below 0 towards it, where a force of 1 N yields that
// much: behind the wall, and a closed one as far as its force presses it.
double to_wall(const ContactNode& node, const Barrier& wall, const Eigen::Vector2d& w,
               double yields) {
  const double pressing = std::max(0.0, -wall.normal.dot(node.force));
  return std::max(-pressing * yields, wall.excess(w));
}

void move_along_roller(const Eigen::Vector2d& normal, const ContactNode& node, double stiffness,
                       Eigen::Ref<Eigen::Vector2d> w) {
  const Eigen::Vector2d along(-normal.y(), normal.x());
  for (const Barrier& wall : node.walls)
    if (const double cosine = wall.normal.dot(along); std::abs(cosine) >= straight_roller)
      w -= to_wall(node, wall, w, cosine * cosine / stiffness) / cosine * along;
}

}  // namespace

DisplacementConstraints::DisplacementConstraints(const ContactSystem& system,
                                                 const CurvedTraces& traces,
                                                 const Eigen::VectorXd& F_C)
    : given_(traces.prescribed()) {
  const NodePairs all = with_degree(traces.degree() - 1,
                                    [&](auto k) { return contact_nodes<k>(system, traces, F_C); });
  std::map<int, int> partners;  // how many a node has
  for (const auto& [ends, node] : all)
    for (const int end : {ends.first, ends.second})
      if (end != ContactNode::none) ++partners[end];
  for (const auto& [ends, node] : all) {
    const bool is_joint =
        partners[ends.first] > 1 || (ends.second != ContactNode::none && partners[ends.second] > 1);
    if (!is_joint) {
      contact_[ends.first] = node;
      continue;
    }
    joints_.emplace_back(ends.first, node);
    joints_.back().second.force.setZero();
    joints_.back().second.friction = 0;
  }
}

std::vector<int> DisplacementConstraints::joint_nodes() const {
  std::vector<int> nodes;
  for (const auto& [node, contact] : joints_)
    for (const int end : {node, contact.partner})
      if (end != ContactNode::none) nodes.push_back(end);
  return nodes;
}

std::vector<bool> DisplacementConstraints::nodes() const {
  std::vector<bool> nodes = given_.at;
  for (const auto& [node, normal] : given_.normal) nodes[static_cast<std::size_t>(node)] = true;
  for (const auto& [node, contact] : contact_) {
    nodes[static_cast<std::size_t>(node)] = true;
    if (contact.partner != ContactNode::none)
      nodes[static_cast<std::size_t>(contact.partner)] = true;
  }
  for (const int node : joint_nodes()) nodes[static_cast<std::size_t>(node)] = true;
  return nodes;
}

void DisplacementConstraints::apply(const Eigen::VectorXd& stiffness, DisplacementField& w) const {
  for (Eigen::Index node = 0; node < w.cols(); ++node)
    if (given_.at[static_cast<std::size_t>(node)]) w.col(node) = given_.u.col(node);
  for (const auto& [node, n] : given_.normal)
    w.col(node) += given_.u.col(node) - n * n.dot(w.col(node));
  for (const auto& [number, node] : contact_) move(number, node, stiffness, w);
  constexpr int passes = 60;  // of projections on one wall after another
  for (int pass = 0; pass < passes; ++pass)
    for (const auto& [number, node] : joints_) move(number, node, stiffness, w);
}

void DisplacementConstraints::move(int number, const ContactNode& node,
                                   const Eigen::VectorXd& stiffness, DisplacementField& w) const {
  if (node.partner != ContactNode::none) {
    move_pair(number, node, stiffness, w);
    return;
  }
  if (given_.at[static_cast<std::size_t>(number)]) return;
  if (const auto roller = given_.normal.find(number); roller != given_.normal.end())
    move_along_roller(roller->second, node, stiffness(number), w.col(number));
  else
    w.col(number) = in_contact(node, stiffness(number), w.col(number));
}

// Each takes the part of the change that its stiffness leaves it; along a roller only what takes
// both apart.
void DisplacementConstraints::move_pair(int one, const ContactNode& node,
                                        const Eigen::VectorXd& stiffness,
                                        DisplacementField& w) const {
  const std::array<int, 2> nodes = {one, node.partner};
  std::array<double, 2> softness{};
  std::array<std::optional<Eigen::Vector2d>, 2> along;
  for (const int k : {0, 1}) {
    if (given_.at[static_cast<std::size_t>(nodes[k])]) continue;
    softness[k] = 1 / stiffness(nodes[k]);
    if (const auto roller = given_.normal.find(nodes[k]); roller != given_.normal.end())
      along[k] = Eigen::Vector2d(-roller->second.y(), roller->second.x());
  }
  const double both = softness[0] + softness[1];
  if (both == 0) return;
  const auto apart = [&] { return Eigen::Vector2d(w.col(nodes[0]) - w.col(nodes[1])); };
  if (!along[0] && !along[1]) {
    const Eigen::Vector2d before = apart(), change = in_contact(node, 1 / both, before) - before;
    for (const int k : {0, 1}) w.col(nodes[k]) += (k == 0 ? 1 : -1) * softness[k] / both * change;
    return;
  }
  for (const Barrier& wall : node.walls) {
    std::array<Eigen::Vector2d, 2> way;
    double yields = 0;
    for (const int k : {0, 1}) {
      const Eigen::Vector2d axis = along[k].value_or(wall.normal);
      way[k] = softness[k] * wall.normal.dot(axis) * axis;
      yields += wall.normal.dot(way[k]);
    }
    if (yields < straight_roller * straight_roller * both) continue;
    const double excess = to_wall(node, wall, apart(), yields);
    w.col(nodes[0]) -= excess / yields * way[0];
    w.col(nodes[1]) += excess / yields * way[1];
  }
}
}  // namespace airybench
