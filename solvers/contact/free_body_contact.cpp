#include "solvers/contact/free_body_contact.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "solvers/contact/released_bodies.hpp"

namespace airybench {
namespace {

// What contact leaves of the loads on motions, N. Less than negligible_N counts as nothing.
struct Unbalanced {
  Eigen::VectorXd loads;
  double relative;  // to the largest sum of forces on a motion

  Unbalanced(const Eigen::MatrixXd& N, const Eigen::VectorXd& l, const Eigen::VectorXd& F,
             double negligible_N)
      : loads(N.transpose() * F + l) {
    const double largest_N = loads.lpNorm<Eigen::Infinity>();
    const double scale =
        (N.cwiseAbs().transpose() * F.cwiseAbs() + l.cwiseAbs()).lpNorm<Eigen::Infinity>();
    relative = largest_N <= negligible_N ? 0 : largest_N / scale;
  }
};

[[noreturn]] void throw_not_held(const FreeBodies& free, const Eigen::VectorXd& left_N) {
  throw Breakdown(why_not_held(*free.rigid, free.edge_reach, left_N));
}

std::string words_of_forces(const HeldPoints& points, const Eigen::VectorXd& forces_N) {
  std::string words;
  for (Eigen::Index k = 0; k < forces_N.size(); ++k) {
    if (std::abs(forces_N(k)) <= 1e-6 * forces_N.lpNorm<Eigen::Infinity>()) continue;
    std::ostringstream force;
    force.precision(4);
    force << (words.empty() ? "" : ", ") << forces_N(k) << " N in "
          << (points.rows[k].component == 0 ? "x" : "y") << " at "
          << words_of_place(points.rows[k].at_mm);
    words += force.str();
  }
  return words;
}

}  // namespace

void refuse_loads_on_open_motions(const RigidContact& rigid) {
  constexpr const char* why = ", and the stress of a force in a point is infinite";
  const HeldPoints& points = rigid.points;
  const Eigen::MatrixXd open = motion_spaces(rigid).open;
  const Eigen::MatrixXd held = points.of_motions * open;
  if (!are_independent(held))
    throw Breakdown("the point support at " + words_of_place(points.rows.front().at_mm) +
                    " holds what contact holds: it would carry a force" + why);
  if (open.cols() == 0) return;
  const Eigen::VectorXd loads_N = open.transpose() * rigid.loads_N;
  if (loads_N.norm() <= rigid.negligible_N()) return;
  Eigen::VectorXd forces_N(held.rows());
  if (held.rows() > 0)
    forces_N = held.transpose().completeOrthogonalDecomposition().solve(-loads_N);
  if ((loads_N + held.transpose() * forces_N).norm() > rigid.negligible_N())
    throw Breakdown(why_not_held(rigid, 0, {}));
  if (forces_N.lpNorm<Eigen::Infinity>() > rigid.rounding_on_points_N)
    throw Breakdown("loads do not balance: point supports would carry " +
                    words_of_forces(points, forces_N) + why);
}

ContactResult solve_with_free_bodies(const contact::Problem& problem, const ContactOptions& options,
                                     const Deadline& deadline) {
  constexpr int max_steps = 16;
  constexpr double balanced = 1e-13, nearly_balanced = 1e-11, rough = 1e-8;  // of relative
  constexpr double enough = 1e-9;                                            // at the end
  constexpr double noise = 1e-3;                                             // of rounding_N
  if (!problem.is_dense()) throw std::invalid_argument("free bodies with a sparse D");
  const FreeBodies& free = problem.points.free;
  const RigidContact& rigid = *free.rigid;
  const auto [open, resisted] = motion_spaces(rigid);
  refuse_loads_on_open_motions(rigid);
  const Eigen::MatrixXd N = free.motions * resisted;
  const Eigen::VectorXd l = resisted.transpose() * rigid.loads_N;
  contact::Problem held = problem;
  held.points.free = {};
  ContactOptions from_here = options;
  ContactResult result;
  Eigen::VectorXd a = Eigen::VectorXd::Zero(N.cols());
  const auto solve_held = [&](double m) {
    held.D = problem.D + m * N * N.transpose();
    held.G = problem.G - N * (a + m * l);
    ContactResult next = solve_contact(held, from_here, deadline);
    next.iterations += result.iterations;
    next.active_set_steps += result.active_set_steps;
    next.history.insert(next.history.begin(), result.history.begin(), result.history.end());
    result = std::move(next);
    from_here.start = result.F_C;
    Unbalanced left(N, l, result.F_C, noise * rigid.rounding_N);
    a += m * left.loads;
    return left;
  };
  // With springs that are soft, while D counts: what is left, and the residual of laws not solved.
  Eigen::VectorXd left_N;
  double unsolved = 0;
  if (N.cols() > 0) {
    constexpr int soft = 6;
    const double least = problem.D.diagonal().mean() / N.rowwise().squaredNorm().mean();
    double m = least, before = std::numeric_limits<double>::infinity();
    from_here.acceptable = std::max(options.acceptable, rough);  // the last solve makes up for it
    for (int step = 0; step < max_steps; ++step, m *= 10) {
      const Unbalanced unbalanced = solve_held(m);
      const double left = unbalanced.relative;
      if (!result.F_C.allFinite()) return result;
      if (step <= soft) {
        left_N = free.motions.transpose() * result.F_C + rigid.loads_N;
        if (!result.converged) unsolved = std::max(unsolved, result.natural_map_residual);
      }
      if (left <= balanced || (left <= nearly_balanced && left > before / 2)) break;
      before = left;
    }
    // m N Nᵀ has cost digits of D: firmer springs take the error out of a that this has left. F
    // solves the problem without springs, too: r is the same.
    const auto settle = [&](double spring) {
      double left = std::numeric_limits<double>::infinity(), last = left;
      do {
        last = std::exchange(left, solve_held(spring).relative);
      } while (left > nearly_balanced && left <= last / 2);
    };
    for (; m > least; m /= 100) settle(m);
    from_here.acceptable = options.acceptable;
    settle(least);
  } else {
    solve_held(0);
  }
  const Unbalanced left(N, l, result.F_C, rigid.rounding_N);
  if (result.converged && left.relative > enough) {
    if (unsolved == 0) throw_not_held(free, left_N);
    result.converged = false;
    result.natural_map_residual = unsolved;
  }
  result.free_motion_mm = resisted * a;
  return result;
}

double unbalanced_share(const FreeBodies& free, const Eigen::VectorXd& F) {
  if (free.is_empty()) return 0;
  const RigidContact& rigid = *free.rigid;
  const double rounding_N =
      rigid.points.rows.empty() ? rigid.rounding_N : rigid.rounding_on_points_N;
  return Unbalanced(free.motions, rigid.loads_N, F, rounding_N).relative;
}

void refuse_free_bodies(const ContactPoints& contact) {
  if (contact.free.is_empty()) return;
  throw Breakdown(contact.free.rigid->bodies.front() +
                  " is held by contact alone: only methods that condense on the contact points "
                  "find its motion");
}

ContactPoints with_known_motion(ContactPoints points, const Eigen::VectorXd& motion_mm) {
  const Eigen::VectorXd moved = points.free.motions * motion_mm;
  if (points.gap.size() > 0)
    points.gap -= moved;
  else
    points.gap = -moved;
  points.free = {};
  return points;
}

}  // namespace airybench
