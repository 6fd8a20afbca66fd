#include "solvers/contact/released_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "solvers/contact/complementarity.hpp"

namespace airybench {
namespace {

using Eigen::Index;
constexpr double tie = 1e-11, alike = 1e-6;

// Powers of ε: 0 and 1.
struct Motion {
  Eigen::MatrixX2d q;         // motions × 2
  Eigen::MatrixX2d pressing;  // −F_n at the ends in play, over the largest load
};

// With loads and gaps of the size 1.
class Release {
 public:
  explicit Release(const RigidContact& contact) : contact_(contact), masses_(contact.masses()) {
    load_ = contact.loads_N / contact.loads_N.lpNorm<Eigen::Infinity>();
    gaps_.resize(std::ssize(contact.ends));
    for (Index e = 0; e < gaps_.size(); ++e) gaps_(e) = contact.ends[e].gap_mm;
    if (gaps_.size() > 0 && gaps_.maxCoeff() > 0) gaps_ /= gaps_.maxCoeff();
  }

  std::optional<Motion> on(const std::vector<Index>& ends) const {
    const auto n = std::ssize(ends);
    std::vector<Index> rough;  // among those
    for (Index i = 0; i < n; ++i)
      if (contact_.ends[ends[i]].friction > 0) rough.push_back(i);
    const auto f = std::ssize(rough);
    Eigen::MatrixXd B(n + 2 * f, masses_.size());  // w = B q + …
    B.topRows(n) = -contact_.normal(ends, Eigen::all);
    B.middleRows(n, f) = contact_.tangential(ends, Eigen::all)(rough, Eigen::all);
    B.bottomRows(f) = -B.middleRows(n, f);
    const Eigen::MatrixXd per_mass = masses_.cwiseInverse().asDiagonal() * B.transpose();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + 3 * f, n + 3 * f);
    A.topLeftCorner(B.rows(), B.rows()) = B * per_mass;
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n + 3 * f, 2);
    b.col(0).head(B.rows()) = per_mass.transpose() * load_;
    b.col(1).head(n) = gaps_(ends);
    for (Index k = 0; k < f; ++k) {
      const Index slip = B.rows() + k;  // λ
      for (const Index side : {n + k, n + f + k}) {
        A(side, slip) = 1;
        A(slip, side) = -1;
      }
      A(slip, rough[k]) = contact_.ends[ends[rough[k]]].friction;
    }
    const std::optional<Eigen::MatrixXd> z = solve_complementarity(A, b);
    if (!z) return {};
    Motion motion{per_mass * z->topRows(B.rows()), z->topRows(n)};
    motion.q.col(0) += load_.cwiseQuotient(masses_);
    return motion;
  }

  // The end that the motion passes most, to the first power of ε that shows it.
  std::optional<Index> passed(const Motion& motion) const {
    if (gaps_.size() == 0) return {};
    const Eigen::MatrixX2d r = contact_.normal * motion.q;
    const double scale = std::max(1., motion.q.col(1).lpNorm<Eigen::Infinity>());
    Index worst = 0;
    if (r.col(0).maxCoeff(&worst) > tie * std::max(1., motion.q.col(0).lpNorm<Eigen::Infinity>()))
      return worst;
    std::optional<Index> found;
    double most = 1e3 * tie * scale;
    for (Index e = 0; e < gaps_.size(); ++e)
      if (r(e, 0) > -tie && r(e, 1) - gaps_(e) > most) {
        most = r(e, 1) - gaps_(e);
        found = e;
      }
    return found;
  }

  const Eigen::VectorXd& masses() const { return masses_; }

 private:
  const RigidContact& contact_;
  Eigen::VectorXd masses_, load_, gaps_;
};

}  // namespace

std::optional<ReleasedBodies> release(const RigidContact& contact) {
  const double largest = contact.loads_N.lpNorm<Eigen::Infinity>();
  ReleasedBodies result;
  result.pressing_N = Eigen::VectorXd::Zero(std::ssize(contact.ends));
  result.q = result.unbalanced_N = Eigen::VectorXd::Zero(contact.loads_N.size());
  result.are_held = largest <= contact.rounding_N;
  if (result.are_held) return result;
  const Release problem(contact);
  std::vector<Index> ends;
  while (true) {
    const std::optional<Motion> motion = problem.on(ends);
    if (!motion) return {};
    if (const std::optional<Index> next = problem.passed(*motion)) {
      if (std::ranges::find(ends, *next) != ends.end()) return {};
      ends.push_back(*next);
      continue;
    }
    result.q = motion->q.col(0);
    result.unbalanced_N = largest * problem.masses().cwiseProduct(result.q);
    for (std::size_t i = 0; i < ends.size(); ++i)
      result.pressing_N(ends[i]) = largest * motion->pressing(static_cast<Index>(i), 0);
    result.are_held = result.unbalanced_N.lpNorm<Eigen::Infinity>() <= contact.negligible_N();
    return result;
  }
}

namespace {

// Where the resultant of a straight face is, and how long edges there may be to have it.
struct Reach {
  Eigen::Vector2d end;
  double distance_mm, edge_mm, needed_mm;
};

std::optional<Reach> shortest_reach(const RigidContact& contact, const ReleasedBodies& bodies,
                                    double edge_reach) {
  std::optional<Reach> worst;
  const auto of_face = [&](std::size_t first, std::size_t last) {
    const Eigen::Vector2d &a = contact.ends[first].at_mm, &b = contact.ends[last].at_mm;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    double sum = 0;
    for (std::size_t e = first; e <= last; ++e) {
      const double F = bodies.pressing_N(static_cast<Index>(e));
      sum += F;
      moment += F * (contact.ends[e].at_mm - a);
    }
    if (sum <= 0) return;
    const Eigen::Vector2d x = a + moment / sum;
    for (const std::size_t end : {first, last}) {
      const double distance = (x - contact.ends[end].at_mm).norm();
      const Reach reach{contact.ends[end].at_mm, distance, contact.ends[end].edge_mm,
                        distance / edge_reach};
      if (distance <= (a - b).norm() / 2 &&
          (!worst || reach.needed_mm * worst->edge_mm < worst->needed_mm * reach.edge_mm))
        worst = reach;
    }
  };
  for (std::size_t first = 0, e = 0; e < contact.ends.size(); ++e)
    if (e + 1 == contact.ends.size() || contact.ends[e + 1].face != contact.ends[e].face) {
      of_face(first, e);
      first = e + 1;
    }
  constexpr double at_the_end = 1e-6;
  if (!worst || worst->needed_mm >= worst->edge_mm ||
      worst->distance_mm < at_the_end * worst->edge_mm)
    return {};
  return worst;
}

// Whether this is so of one of the ends at which a group meets what does not move with it.
bool has_end(const RigidContact& contact, const RigidGroup& group, const auto& such) {
  const auto is_in = [&](int piece) {
    return std::ranges::find(group.pieces, piece) != group.pieces.end();
  };
  for (Index e = 0; e < std::ssize(contact.ends); ++e) {
    const auto& [a, b] = contact.ends[e].pieces;
    if (is_in(a) != is_in(b) && such(e)) return true;
  }
  return false;
}

// The motion of the fastest group, and what its loads lack.
void add_motion(const RigidContact& contact, const ReleasedBodies& bodies,
                const Eigen::VectorXd& left_N, std::ostream& line) {
  const RigidGroup group = fastest_group(contact, bodies.q, bodies.unbalanced_N);
  const bool several = group.pieces.size() > 1;
  const auto verb = [&](const char* one) {
    return (several ? "they " : "it ") + std::string(one) + (several ? "" : "s") + " ";
  };
  const auto presses = [&](Index e) {
    return bodies.pressing_N(e) > tie * bodies.pressing_N.sum();
  };
  const auto opens = [&](Index e) {
    return contact.normal.row(e).dot(bodies.q) < -alike * bodies.q.lpNorm<Eigen::Infinity>();
  };
  const bool lifts = !has_end(contact, group, presses) && has_end(contact, group, opens);
  const bool moves_along = !group.turns() || (lifts && group.force_N.norm() * group.size_mm >
                                                           alike * std::abs(group.moment_Nmm));
  const Eigen::Vector2d pole = moves_along ? Eigen::Vector2d(0, 0) : group.pole();
  line << group.bodies << ": ";
  if (moves_along) {
    line << verb(lifts ? "leave" : "slide") << (lifts ? "contact " : "")
         << words_of_direction(group.velocity);
  } else {
    const bool tips = has_end(contact, group, [&](Index e) {
      return presses(e) && (contact.ends[e].at_mm - pole).norm() <= alike * group.size_mm;
    });
    line << verb(tips ? "tip" : "turn") << "about " << words_of_place(pole);
  }
  const auto lacks = [&](const RigidGroup& of) -> std::ostream& {
    if (moves_along) return line << of.force_N.norm() << " N";
    return line << std::abs(of.moment_about(pole)) << " N mm";
  };
  line << ", with ";
  lacks(group) << (several ? " of their" : " of its") << " loads unbalanced";
  constexpr double clamped = 0.9;
  const auto size = [&](const Eigen::VectorXd& loads_N) {
    return std::sqrt(loads_N.cwiseAbs2().cwiseQuotient(contact.masses()).sum());
  };
  if (left_N.size() == 0 || size(left_N) >= clamped * size(bodies.unbalanced_N)) return;
  line << "; contact forces that prescribed displacements or overlaps make leave ";
  lacks(with_loads(contact, group, left_N));
}

}  // namespace

std::string why_not_held(const RigidContact& contact, double edge_reach,
                         const Eigen::VectorXd& left_N) {
  const std::optional<ReleasedBodies> bodies = release(contact);
  std::ostringstream line;
  line.precision(3);
  if (bodies && !bodies->are_held) {
    line << "nothing holds ";
    add_motion(contact, *bodies, left_N, line);
    return line.str();
  }
  line << "contact leaves " << left_N.lpNorm<Eigen::Infinity>()
       << " N of the loads on bodies that it alone holds";
  if (!bodies) return line.str();
  const auto reach = edge_reach > 0 ? shortest_reach(contact, *bodies, edge_reach) : std::nullopt;
  if (reach)
    line << ", though rigid bodies would stand: the mesh is too coarse to decide. At "
         << words_of_place(reach->end) << " the resultant is " << reach->distance_mm
         << " mm from the end of the face, and needs edges of at most " << reach->needed_mm
         << " mm there, not " << reach->edge_mm << " mm; P2, P3 and P4 need none";
  else
    line << ", though rigid bodies may stand: at the limit of friction, at the end of a face, or "
            "clamped";
  return line.str();
}

}  // namespace airybench
