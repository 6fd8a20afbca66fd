#include "verify/zone_recovery.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace airybench {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

// The law of a contact node in the coordinates y of the zone.
struct NodeLaw {
  int first;                       // y_n; y_t follows
  double force_n, force_t, bound;  // F_n, F_t, μ|F_n|; N
  double to_wall_mm, to_rest_mm;   // of y_n, y_t
  bool is_closed, sticks;
  double direction;  // of the slide: ±1, without friction 0

  // The next active set from y and the half gradient there; whether it differs.
  bool update(const Eigen::VectorXd& y, const Eigen::VectorXd& gradient) {
    const NodeLaw before = *this;
    is_closed = is_closed ? gradient(first) + force_n < 0 : y(first) > to_wall_mm;
    const double pull = gradient(first + 1) + force_t, ahead = y(first + 1) - to_rest_mm;
    if (sticks && std::abs(pull) > bound) {
      sticks = false;
      direction = pull > 0 ? -1 : 1;
    } else if (!sticks && bound > 0 && direction * ahead < 0) {
      sticks = true;
    }
    return is_closed != before.is_closed || sticks != before.sticks;
  }
};

class Zone {
 public:
  Zone(const DisplacementConstraints& constraints, const std::vector<ZoneTriangle>& triangles,
       std::vector<bool> is_free, const DisplacementField& w)
      : number_(is_free.size(), -1) {
    for (const auto& [node, contact] : constraints.contact())
      hold(constraints, node, contact, is_free);
    for (const int node : constraints.joint_nodes()) is_free[node] = false;
    for (std::size_t node = 0; node < is_free.size(); ++node)
      if (is_free[node] && !constraints.given().at[node]) {
        number_[node] = static_cast<int>(nodes_.size());
        nodes_.push_back(static_cast<int>(node));
      }
    set_coordinates(constraints, w);
    set_stiffness(triangles);
  }

  Eigen::VectorXd of_free(const Eigen::Matrix2Xd& field) const {
    Eigen::VectorXd values(size());
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      values.segment<2>(2 * static_cast<Eigen::Index>(i)) = field.col(nodes_[i]);
    return values;
  }
  void move(const Eigen::VectorXd& y, DisplacementField& w) const {
    const Eigen::VectorXd change = to_displacement_ * y;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      w.col(nodes_[i]) += change.segment<2>(2 * static_cast<Eigen::Index>(i));
  }

  // y that minimises, from y = 0.
  Eigen::VectorXd solution(const Eigen::VectorXd& gradient_of_w) {
    constexpr int max_steps = 12;
    const Eigen::VectorXd gradient = to_displacement_.transpose() * gradient_of_w;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
    Eigen::SimplicialLDLT<Sparse> factor;
    factor.analyzePattern(K_);
    for (int step = 0; step < max_steps; ++step) {
      std::vector<bool> is_held = held_;
      Eigen::VectorXd given = Eigen::VectorXd::Zero(size()), force = gradient;
      for (const NodeLaw& node : contact_) {
        force(node.first) += node.force_n;
        force(node.first + 1) += node.force_t + node.direction * node.bound;
        if ((is_held[node.first] = node.is_closed)) given(node.first) = node.to_wall_mm;
        if ((is_held[node.first + 1] = node.sticks)) given(node.first + 1) = node.to_rest_mm;
      }
      Eigen::VectorXd b = -force - K_ * given;
      Sparse K = K_;
      for (Eigen::Index column = 0; column < K.outerSize(); ++column)
        for (Sparse::InnerIterator entry(K, column); entry; ++entry)
          if (is_held[entry.row()] || is_held[entry.col()])
            entry.valueRef() = entry.row() == entry.col() ? 1 : 0;
      for (Eigen::Index i = 0; i < size(); ++i)
        if (is_held[i]) b(i) = given(i);
      factor.factorize(K);
      if (factor.info() != Eigen::Success) return Eigen::VectorXd::Zero(size());
      y = factor.solve(b);
      const Eigen::VectorXd at_y = gradient + K_ * y;
      bool is_new = false;
      for (NodeLaw& node : contact_) is_new |= node.update(y, at_y);
      if (!is_new) break;
    }
    return y;
  }

 private:
  Eigen::Index size() const { return 2 * static_cast<Eigen::Index>(nodes_.size()); }

  // Nodes of a pair are free together; what a support holds at a wall stays.
  static void hold(const DisplacementConstraints& constraints, int node, const ContactNode& contact,
                   std::vector<bool>& is_free) {
    bool is_held = !is_free[node] || constraints.is_given(node);
    if (contact.partner != ContactNode::none)
      is_held |= !is_free[contact.partner] || constraints.is_given(contact.partner);
    if (!is_held) return;
    is_free[node] = false;
    if (contact.partner != ContactNode::none) is_free[contact.partner] = false;
  }

  // w = w_0 + B y: x and y; on rollers and walls normal and tangent; of a pair the first node's
  // difference to its partner, and the partner's motion, which carries it along.
  void set_coordinates(const DisplacementConstraints& constraints, const DisplacementField& w) {
    Triplets entries;
    held_.assign(static_cast<std::size_t>(size()), false);
    const auto add_frame = [&](int at, const Eigen::Vector2d& n) {
      entries.emplace_back(at, at, n.x());
      entries.emplace_back(at + 1, at, n.y());
      entries.emplace_back(at, at + 1, -n.y());
      entries.emplace_back(at + 1, at + 1, n.x());
    };
    std::vector<bool> has_frame(nodes_.size(), false);
    for (const auto& [node, contact] : constraints.contact()) {
      if (number_[node] < 0) continue;
      const int at = 2 * number_[node];
      add_frame(at, contact.normal());
      has_frame[number_[node]] = true;
      Eigen::Vector2d apart = w.col(node);
      if (contact.partner != ContactNode::none) {
        apart -= w.col(contact.partner);
        for (const int c : {0, 1})
          entries.emplace_back(at + c, 2 * number_[contact.partner] + c, 1);
      }
      contact_.push_back(state(contact, at, apart));
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (has_frame[i]) continue;
      const int at = 2 * static_cast<int>(i);
      const auto roller = constraints.given().normal.find(nodes_[i]);
      const bool rolls = roller != constraints.given().normal.end();
      add_frame(at, rolls ? roller->second : Eigen::Vector2d(1, 0));
      held_[at] = rolls;
    }
    to_displacement_.resize(size(), size());
    to_displacement_.setFromTriplets(entries.begin(), entries.end());
  }

  static NodeLaw state(const ContactNode& node, int first, const Eigen::Vector2d& apart) {
    const Eigen::Vector2d n = node.normal(), t(-n.y(), n.x());
    double limit = std::numeric_limits<double>::infinity();
    for (const Barrier& wall : node.walls) limit = std::min(limit, wall.limit / n.dot(wall.normal));
    const double F_n = n.dot(node.force), F_t = t.dot(node.force),
                 bound = node.friction * std::abs(F_n);
    NodeLaw state = {first,
                     F_n,
                     F_t,
                     bound,
                     limit - n.dot(apart),
                     node.offset.along(n).y() - t.dot(apart),
                     F_n < 0,
                     std::abs(F_t) < bound,
                     0};
    if (!state.sticks && bound > 0) state.direction = F_t > 0 ? -1 : 1;
    return state;
  }

  void set_stiffness(const std::vector<ZoneTriangle>& triangles) {
    Triplets entries;
    for (const auto& [nodes, K] : triangles)
      for (std::size_t j = 0; j < nodes.size(); ++j)
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          const int row = number_[nodes[i]], column = number_[nodes[j]];
          if (row < 0 || column < 0) continue;
          for (const int a : {0, 1})
            for (const int b : {0, 1})
              entries.emplace_back(
                  2 * row + a, 2 * column + b,
                  K(2 * static_cast<Eigen::Index>(i) + a, 2 * static_cast<Eigen::Index>(j) + b));
        }
    Sparse of_w(size(), size());
    of_w.setFromTriplets(entries.begin(), entries.end());
    K_ = to_displacement_.transpose() * of_w * to_displacement_;
  }

  std::vector<int> nodes_, number_;  // free nodes; node → place there, or −1
  Sparse to_displacement_, K_;       // B, Bᵀ K B
  std::vector<bool> held_;           // of y, whatever the contact does
  std::vector<NodeLaw> contact_;
};

}  // namespace

void improve_zone(const DisplacementConstraints& constraints,
                  const std::vector<ZoneTriangle>& triangles, std::vector<bool> is_free,
                  const Eigen::Matrix2Xd& gradient, DisplacementField& w) {
  Zone zone(constraints, triangles, std::move(is_free), w);
  zone.move(zone.solution(zone.of_free(gradient)), w);
}

}  // namespace airybench
