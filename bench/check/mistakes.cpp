#include "bench/check/mistakes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "solvers/contact/condensed.hpp"

namespace airybench {
namespace {

using Eigen::VectorXd;
using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic>;

constexpr double endless = std::numeric_limits<double>::infinity();

// A contact law that may be wrong.
struct Law {
  bool opens = true;                                        // else F_n may pull
  std::function<double(int point, double F_n)> limit = {};  // of |F_t|, N; empty: −μ F_n
  bool lower_bound_wins = false;                            // where the limit is negative
};

// Gauss–Seidel by components, since our own contact solvers know the right law only. Empty: no
// convergence.
VectorXd solved(const contact::Problem& problem, const Law& law = {}) {
  constexpr int max_sweeps = 20'000;
  constexpr double tolerance = 1e-9;
  const ContactPoints& points = problem.points;
  const VectorXd offset = contact_offset(problem);
  VectorXd F = VectorXd::Zero(points.size());
  const auto without_r = [&](int row) {
    return F(row) - (problem.D.row(row).dot(F) - offset(row)) / problem.D(row, row);
  };
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    const VectorXd before = F;
    for (int p = 0; p < points.count; ++p) {
      const int n = points.components * p;
      F(n) = law.opens ? std::min(0.0, without_r(n)) : without_r(n);
      if (points.components == 1) continue;
      const double most = law.limit ? law.limit(p, F(n)) : points.friction_at(p) * std::abs(F(n));
      const double sticking = without_r(n + 1);
      F(n + 1) = law.lower_bound_wins ? std::max(std::min(sticking, most), -most)
                                      : std::min(std::max(sticking, -most), most);
    }
    if (!F.allFinite()) break;
    if ((F - before).norm() <= tolerance * F.norm()) return F;
  }
  return {};
}

// Row k of the result is row order[k].
Permutation order_of(int rows, const std::function<int(int)>& from) {
  Permutation order(rows);
  for (int row = 0; row < rows; ++row) order.indices()(from(row)) = row;
  return order;
}

struct Collector {
  const contact::Problem& problem;
  const VectorXd& right;
  std::vector<Mistake> all = {};

  bool has_friction() const { return problem.points.components == 2; }
  void written(const std::string& name, const VectorXd& F) { all.push_back({name, F}); }
  void read(const std::string& name, const std::function<void(contact::Problem&)>& change,
            const Law& law = {}) {
    contact::Problem other = problem;
    change(other);
    all.push_back({name, solved(other, law)});
  }
  void law(const std::string& name, const Law& wrong) {
    read(
        name, [](contact::Problem&) {}, wrong);
  }
  void friction(const std::string& name, const std::function<double(int point)>& mu,
                bool lower_bound_wins = false) {
    Law wrong;
    wrong.lower_bound_wins = lower_bound_wins;
    wrong.limit = [mu](int point, double F_n) {
      const double friction = mu(point);
      return F_n == 0 ? 0 : friction * std::abs(F_n);
    };
    law(name, wrong);
  }
  // The program takes the rows for others: in all that it reads, and in what it writes, too.
  void order(const std::string& name, const Permutation& order) {
    written("the order of the forces: " + name, order * right);
    contact::Problem other = problem;
    other.D = order.transpose() * problem.D * order;
    other.G = order.transpose() * problem.G;
    other.points.gap = order.transpose() * problem.points.gap;
    const VectorXd F = solved(other);
    all.push_back(
        {"the order of all rows: " + name, F.size() > 0 ? VectorXd(order * F) : VectorXd()});
  }
};

void add_signs(Collector& to) {
  const bool friction = to.has_friction();
  VectorXd tangential = VectorXd::Ones(to.right.size());
  if (friction) tangential(Eigen::seq(1, Eigen::last, 2)).setConstant(-1);
  to.read("the sign of G", [](contact::Problem& p) { p.G = -p.G; });
  to.read("G is left out", [](contact::Problem& p) { p.G.setZero(); });
  to.read("the sign of the gap", [](contact::Problem& p) { p.points.gap = -p.points.gap; });
  to.read("the gap is left out", [](contact::Problem& p) { p.points.gap.setZero(); });
  to.read("the sign of G and of the gap", [](contact::Problem& p) {
    p.G = -p.G;
    p.points.gap = -p.points.gap;
  });
  to.written("the sign of the forces", -to.right);
  if (!friction) return;
  to.written("the sign of the tangential forces", tangential.cwiseProduct(to.right));
  to.read("the sign of the tangential rows of G",
          [&](contact::Problem& p) { p.G = p.G.cwiseProduct(tangential).eval(); });
  to.read("the sign of the tangential rows of the gap", [&](contact::Problem& p) {
    p.points.gap = p.points.gap.cwiseProduct(tangential).eval();
  });
  to.read("the tangential rows of the gap are left out",
          [](contact::Problem& p) { p.points.gap(Eigen::seq(1, Eigen::last, 2)).setZero(); });
  to.read("the sign of the tangential direction in G and gap", [&](contact::Problem& p) {
    p.G = p.G.cwiseProduct(tangential).eval();
    p.points.gap = p.points.gap.cwiseProduct(tangential).eval();
  });
}

void add_units(Collector& to) {
  to.written("units: forces 1000 times too small (kN, not N; D is in mm/N)", to.right / 1000);
  to.written("units: forces 1000 times too large (D is in mm/N, not m/N)", to.right * 1000);
  to.written("units: forces per m, or of another thickness than 1 mm", to.right * 10);
  to.read("units: the gap 1000 times too small (m, not mm)",
          [](contact::Problem& p) { p.points.gap /= 1000; });
  to.read("units: the gap 1000 times too large", [](contact::Problem& p) { p.points.gap *= 1000; });
  to.read("units: G 1000 times too small (m, not mm)", [](contact::Problem& p) { p.G /= 1000; });
  to.read("units: G 1000 times too large", [](contact::Problem& p) { p.G *= 1000; });
}

void add_orders(Collector& to) {
  const int rows = static_cast<int>(to.right.size()), points = to.problem.points.count;
  const int m = to.problem.points.components;
  to.order("the two ends of an edge are swapped", order_of(rows, [&](int row) {
             const int other = (row / m) ^ 1;  // nodes of displacements may be odd in number
             return m * (other < points ? other : row / m) + row % m;
           }));
  to.order("the points from the last to the first",
           order_of(rows, [&](int row) { return m * (points - 1 - row / m) + row % m; }));
  if (m == 1) return;
  to.order("tangential before normal",
           order_of(rows, [](int row) { return row % 2 == 0 ? row + 1 : row - 1; }));
  to.order("all normal ones, then all tangential ones", order_of(rows, [&](int row) {
             return row < points ? 2 * row : 2 * (row - points) + 1;
           }));
}

void add_laws(Collector& to) {
  const ContactPoints& points = to.problem.points;
  const auto mu = [&points](int point) { return points.friction_at(point); };
  Law pulls;
  pulls.opens = false;
  const char* closed = "points do not open: F_n > 0";
  to.law(closed, pulls);
  if (to.has_friction())  // programs differ in the limit of what pulls
    for (const double pulled : {0.0, endless}) {
      Law other = pulls;
      other.limit = [=](int p, double F_n) { return F_n > 0 ? pulled : mu(p) * std::abs(F_n); };
      to.law(closed, other);
    }
  VectorXd cut = solved(to.problem, pulls);
  for (int p = 0; p < points.count && cut.size() > 0; ++p)
    if (cut(points.components * p) > 0)
      cut.segment(points.components * p, points.components).setZero();
  to.written("points open after the solve: F_n > 0 is cut off", cut);
  if (!to.has_friction()) return;
  to.friction("friction: twice mu", [=](int p) { return 2 * mu(p); });
  to.friction("friction: half of mu", [=](int p) { return mu(p) / 2; });
  to.friction("friction: none", [](int) { return 0.0; });
  for (const bool lower_bound_wins : {false, true})  // of forces on the body, or on the wall
    to.friction(
        "friction: the sign of mu", [=](int p) { return -mu(p); }, lower_bound_wins);
  to.friction("friction: mu squared", [=](int p) { return mu(p) * mu(p); });
  to.friction("friction: the sine of its angle for the tangent",
              [=](int p) { return mu(p) / std::hypot(1, mu(p)); });
  to.friction("friction: without a limit, all closed points stick", [](int) { return endless; });
  Law sticks;
  sticks.limit = [](int, double) { return endless; };
  to.law("friction: without a limit, open points stick, too", sticks);
  to.friction("friction: the first point's mu for all", [=](int) { return mu(0); });
  to.friction("friction: the last point's mu for all",
              [=, last = points.count - 1](int) { return mu(last); });
  to.friction("friction: mu is taken for an angle", [=](int p) { return std::tan(mu(p)); });
  to.friction("friction: the limit's root, sqrt(mu) |F_n|",
              [=](int p) { return std::sqrt(mu(p)); });
  Law box;
  box.limit = [=](int p, double) { return mu(p); };
  to.law("friction: a box, |F_t| <= mu without F_n", box);
  Law none;
  none.limit = [](int, double) { return 0.0; };
  if (const VectorXd without = solved(to.problem, none); without.size() > 0) {
    Law tresca;
    tresca.limit = [&](int p, double) { return mu(p) * std::abs(without(2 * p)); };
    to.law("friction: its limit from the F_n without friction", tresca);
  }
}

}  // namespace

std::vector<Mistake> mistakes_with(const contact::Problem& given, const VectorXd& right) {
  contact::Problem problem = given;
  for (VectorXd* vector : {&problem.G, &problem.points.gap})
    if (vector->size() == 0) vector->setZero(problem.points.size());
  Collector collected{problem, right};
  add_signs(collected);
  add_units(collected);
  add_orders(collected);
  add_laws(collected);
  return std::move(collected.all);
}

bool are_alike(const VectorXd& a, const VectorXd& b) {
  constexpr double most = 1e-4;
  return a.size() == b.size() && (a - b).norm() <= most * b.norm();
}

}  // namespace airybench
