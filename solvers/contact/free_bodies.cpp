#include "solvers/contact/free_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace airybench {
namespace {

// What contact leaves of the loads on the motions, N.
struct Unbalanced {
  Eigen::VectorXd loads;
  double relative;  // to the largest sum of forces on a motion

  Unbalanced(const FreeBodies& free, const Eigen::VectorXd& F)
      : loads(free.motions.transpose() * F + free.loads_N) {
    const double scale =
        (free.motions.cwiseAbs().transpose() * F.cwiseAbs() + free.loads_N.cwiseAbs()).maxCoeff();
    relative = scale > 0 ? loads.cwiseAbs().maxCoeff() / scale : 0;
  }
};

// Of the body with the largest unbalanced load.
[[noreturn]] void throw_not_held(const FreeBodies& free, const Unbalanced& left, double not_held) {
  Eigen::Index worst = 0;
  left.loads.cwiseAbs().maxCoeff(&worst);
  Eigen::Vector2d resultant = Eigen::Vector2d::Zero();
  for (Eigen::Index m = 0; m < left.loads.size(); ++m)
    if (free.bodies[m] == free.bodies[worst]) resultant += left.loads(m) * free.along[m];
  std::ostringstream line;
  line.precision(3);
  const char* const what = left.relative > not_held ? "nothing" : "hardly anything";
  const auto tidy = [](double x) { return std::abs(x) < 1e-6 ? 0 : x; };
  if (free.along[worst].isZero(0)) {
    line << what << " keeps " << free.bodies[worst] << " from turning: contact leaves "
         << std::abs(left.loads(worst)) << " N of the loads at its rim";
  } else {
    const Eigen::Vector2d along = resultant.normalized();
    line << what << " holds " << free.bodies[worst] << " along (" << tidy(along.x()) << ", "
         << tidy(along.y()) << "): contact leaves " << resultant.norm() << " N of the loads";
  }
  throw Breakdown(line.str());
}

}  // namespace

ContactResult solve_with_free_bodies(const contact::Problem& problem, const ContactOptions& options,
                                     const Deadline& deadline) {
  constexpr int most_steps = 16;
  constexpr double balanced = 1e-13, nearly_balanced = 1e-11, rough = 1e-8;  // of relative
  constexpr double enough = 1e-9, not_held = 1e-6;                           // at the end
  if (!problem.is_dense()) throw std::invalid_argument("free bodies with a sparse D");
  const FreeBodies& free = problem.points.free;
  const Eigen::MatrixXd& N = free.motions;
  contact::Problem held = problem;
  held.points.free = {};
  ContactOptions from_here = options;
  ContactResult result;
  Eigen::VectorXd a = Eigen::VectorXd::Zero(N.cols());
  const auto solve_held = [&](double m) {
    held.D = problem.D + m * N * N.transpose();
    held.G = problem.G - N * (a + m * free.loads_N);
    ContactResult next = solve_contact(held, from_here, deadline);
    next.iterations += result.iterations;
    next.active_set_steps += result.active_set_steps;
    next.history.insert(next.history.begin(), result.history.begin(), result.history.end());
    result = std::move(next);
    from_here.start = result.F_C;
    Unbalanced left(free, result.F_C);
    a += m * left.loads;
    return left;
  };
  const double least = problem.D.diagonal().mean() / N.rowwise().squaredNorm().mean();
  double m = least, before = std::numeric_limits<double>::infinity();
  from_here.acceptable = std::max(options.acceptable, rough);  // the last solve makes up for it
  for (int step = 0; step < most_steps; ++step, m *= 10) {
    const double left = solve_held(m).relative;
    if (!result.F_C.allFinite()) return result;
    if (left <= balanced || (left <= nearly_balanced && left > before / 2)) break;
    before = left;
  }
  // m N Nᵀ has cost digits of D: firmer springs take the error out of a that this has left.
  for (; m > least; m /= 100) solve_held(m);
  from_here.acceptable = options.acceptable;
  const Unbalanced left = solve_held(0);
  if (result.converged && left.relative > enough) throw_not_held(free, left, not_held);
  result.free_motion_mm = std::move(a);
  return result;
}

double unbalanced_share(const FreeBodies& free, const Eigen::VectorXd& F) {
  return free.is_empty() ? 0 : Unbalanced(free, F).relative;
}

void refuse_free_bodies(const ContactPoints& contact) {
  if (contact.free.is_empty()) return;
  throw Breakdown(contact.free.bodies.front() +
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
