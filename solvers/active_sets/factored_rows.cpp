#include "solvers/active_sets/factored_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assembly/rough_compliance.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/paired_points.hpp"

namespace airybench {
namespace {

// Rows of slip apart, a factor solves exactly.
double condition_with_friction(const ContactPoints& points) {
  double largest = 0;
  for (const double mu : points.friction) largest = std::max(largest, mu);
  return 2 * (1 + largest);
}

// A force on the cone slips, but for rounding.
std::vector<PointLaw> laws_of_forces(const ContactPoints& contact, Eigen::VectorXd F) {
  constexpr double on_the_cone = 1 + 1e-9;
  for (int t = 1; contact.components == 2 && t < F.size(); t += 2) F(t) *= on_the_cone;
  std::vector<PointLaw> laws = laws_of(contact, F);
  for (int p = 0; p < contact.count; ++p)
    if (contact.friction_at(p) == 0) laws[p].sticks = false;
  return laws;
}

// Puts other numbers into K's elements while it lives.
class Renumbered {
 public:
  Renumbered(ElementMatrices& K, const std::vector<int>& number, int order)
      : K_(K), unknown_(K.unknown), order_(std::exchange(K.order, order)) {
    for (int& slot : K.unknown.entries())
      if (slot >= 0) slot = number[static_cast<std::size_t>(slot)];
  }
  ~Renumbered() {
    K_.unknown = std::move(unknown_);
    K_.order = order_;
  }
  Renumbered(const Renumbered&) = delete;
  Renumbered& operator=(const Renumbered&) = delete;

 private:
  ElementMatrices& K_;
  EqualRows<int> unknown_;
  int order_;
};

}  // namespace

FactoredRows::FactoredRows(const Problem& problem, const ContactPoints& points,
                           HybridizedSystem& system, const Eigen::VectorXd& start,
                           const Deadline& deadline)
    : ContactRows(joined(points), of_both(points, rough_compliance(problem, points)),
                  condition_with_friction(points)),
      system_(system),
      deadline_(deadline),
      prescribed_(prescribed_forces(problem, system)),
      is_second_(static_cast<std::size_t>(system.b.size()), false),
      start_(start.size() > 0 ? of_first(points, start) : start) {
  const int m = points.components;
  const Eigen::Index inner = system.b.size() - points.size();
  for (int p = 0; p < points.count; ++p) {
    const int q = points.opposite_of(p);
    if (q != ContactPoints::no_point && q < p) continue;
    slots_.push_back({inner + m * p, q == ContactPoints::no_point ? none : inner + m * q});
    for (int k = 0; q != ContactPoints::no_point && k < m; ++k)
      is_second_[static_cast<std::size_t>(inner + m * q + k)] = true;
  }
  for (int e = 0; e < system.K.count(); ++e)
    if (std::ranges::any_of(system.K.unknown[e],
                            [&](int slot) { return slot >= 0 && is_second_[slot]; }))
      elements_with_seconds_.push_back(e);
}

std::size_t FactoredRows::bytes() const {
  // Its load, whole and reduced, a vector and K times it, its result, three of the factor.
  constexpr std::size_t of_a_solve = 8;
  return space_.bytes() + number_.size() * (sizeof(int) + of_a_solve * sizeof(double)) +
         static_cast<std::size_t>(prescribed_.forces.size() + compliance.size()) * sizeof(double);
}

std::vector<PointLaw> FactoredRows::first_laws(int&) {
  if (start_.size() > 0) return laws_of_forces(contact, start_);
  std::vector<PointLaw> laws(static_cast<std::size_t>(contact.count));
  set(laws);
  Eigen::VectorXd u;
  expand(solved(reduced(system_.b)), u);
  const Eigen::VectorXd r = less_gap(contact, of_contact(u));
  const int m = contact.components;
  for (int p = 0; p < contact.count; ++p) {
    laws[p].closed = r(m * p) > 0;
    laws[p].sticks = laws[p].closed && contact.friction_at(p) > 0;
  }
  return laws;
}

void FactoredRows::number_slots() {
  constexpr int unnumbered = -2;
  number_.assign(static_cast<std::size_t>(slots()), unnumbered);
  std::vector<std::pair<Eigen::Index, Eigen::Index>> merged;  // the second slot, the first
  for (std::size_t p = 0; p < laws_.size(); ++p) {
    const auto hold = [&](int component) {
      const Slots& of = slots_[p];
      if (of.second == none)
        number_[of.first + component] = held;
      else
        merged.emplace_back(of.second + component, of.first + component);
    };
    if (laws_[p].closed) hold(0);
    if (laws_[p].sticks) hold(1);
  }
  for (const auto& [second, first] : merged) number_[second] = held;
  unknowns_ = 0;
  for (int& number : number_)
    if (number == unnumbered) number = unknowns_++;
  for (const auto& [second, first] : merged) number_[second] = number_[first];
}

// Of rows and columns of second slots in K: then x_p = x_q where both are one.
void FactoredRows::change_signs() {
  for (const int e : elements_with_seconds_) {
    const std::span<const int> slot = std::as_const(system_.K.unknown)[e];
    double* entry = system_.K.lower[e].data();
    const auto is_second = [&](int i) { return slot[i] >= 0 && is_second_[slot[i]]; };
    for (int j = 0; j < system_.K.size; ++j)
      for (int i = j; i < system_.K.size; ++i, ++entry)
        if (is_second(i) != is_second(j)) *entry = -*entry;
  }
}

void FactoredRows::set(const std::vector<PointLaw>& laws) {
  if (laws == laws_ && is_factored_) return;
  laws_ = laws;
  is_factored_ = false;
  number_slots();
  struct Signs {
    explicit Signs(FactoredRows& of_rows) : rows(of_rows) { rows.change_signs(); }
    ~Signs() { rows.change_signs(); }
    FactoredRows& rows;
  } const signs(*this);
  const Renumbered numbers(system_.K, number_, unknowns_);
  const OwnerScope scope(MemoryOwner::factor);
  factor_.analyse(system_.K);
  factor_.factor(system_.K, deadline_);
  is_factored_ = true;
  made_.bytes = std::max(made_.bytes, factor_.bytes());
  made_.entries = std::max(made_.entries, factor_.entries());
  made_.flops += factor_.flops();
}

void FactoredRows::move_to_gap(Eigen::VectorXd& u) const {
  const int m = contact.components;
  for (int p = 0; p < contact.count; ++p) {
    const auto [first, second] = slots_[p];
    for (int k = 0; k < m; ++k) {
      if (!(k == 0 ? laws_[p].closed : laws_[p].sticks)) continue;
      const double gap = contact.gap.size() > 0 ? contact.gap(m * p + k) : 0;
      if (second == none) {
        u(first + k) = gap;
      } else {
        const double missing = gap - u(first + k) - u(second + k);
        u(first + k) += missing / 2;
        u(second + k) += missing / 2;
      }
    }
  }
}

void FactoredRows::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.setZero(x.size());
  add_product(system_.K, x, y);
}

double FactoredRows::measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) {
  multiply(u, unbalanced);
  double energy = u.dot(unbalanced) + prescribed_.energy;
  if (prescribed_.forces.size() > 0) energy += 2 * u.dot(prescribed_.forces);
  unbalanced = system_.b - unbalanced;
  return energy;
}

// Rows of slip: the tangential one takes its own normal one along.
void FactoredRows::add_friction(Eigen::VectorXd& r) const {
  for (std::size_t p = 0; p < laws_.size(); ++p) {
    if (laws_[p].ratio == 0) continue;
    const auto [first, second] = slots_[p];
    r(first + 1) -= laws_[p].ratio * r(first);
    if (second != none) r(second + 1) -= laws_[p].ratio * r(second);
  }
}

Eigen::VectorXd FactoredRows::reduced(const Eigen::VectorXd& r) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(unknowns_);
  for (std::size_t slot = 0; slot < number_.size(); ++slot)
    if (const double value = r(static_cast<Eigen::Index>(slot)); number_[slot] != held)
      result(number_[slot]) += is_second_[slot] ? -value : value;
  return result;
}

void FactoredRows::expand(const Eigen::VectorXd& reduced, Eigen::VectorXd& x) const {
  x.resize(slots());
  for (std::size_t slot = 0; slot < number_.size(); ++slot) {
    const double value = number_[slot] == held ? 0 : reduced(number_[slot]);
    x(static_cast<Eigen::Index>(slot)) = is_second_[slot] ? -value : value;
  }
}

Eigen::VectorXd FactoredRows::solved(Eigen::VectorXd r) const {
  factor_.solve_in_place(r, deadline_);
  return r;
}

GmresResult FactoredRows::solve(Eigen::VectorXd r, const GmresOptions& options,
                                Eigen::VectorXd& x) {
  add_friction(r);
  Eigen::VectorXd all, K_times_all, result;
  const GmresResult linear = solve_by_gmres(
      [&](const Eigen::VectorXd& v, Eigen::VectorXd& y) {
        expand(v, all);
        multiply(all, K_times_all);
        add_friction(K_times_all);
        y = reduced(K_times_all);
      },
      [&](const Eigen::VectorXd& v, Eigen::VectorXd& y) { y = solved(v); }, reduced(r), options,
      deadline_, space_, result);
  expand(result, x);
  return linear;
}

Eigen::VectorXd FactoredRows::of_contact(const Eigen::VectorXd& x) const {
  const int m = contact.components;
  Eigen::VectorXd rows(contact.size());
  for (int p = 0; p < contact.count; ++p) {
    const auto [first, second] = slots_[p];
    rows.segment(m * p, m) = x.segment(first, m);
    if (second != none) rows.segment(m * p, m) += x.segment(second, m);
  }
  return rows;
}

Eigen::VectorXd FactoredRows::reactions(const Eigen::VectorXd& unbalanced) const {
  Eigen::VectorXd rows = -of_contact(unbalanced);
  const int m = contact.components;
  for (int p = 0; p < contact.count; ++p)
    if (slots_[p].second != none) rows.segment(m * p, m) /= 2;  // both have the same
  return rows;
}

double FactoredRows::norm_from_below(const Eigen::VectorXd& F_C) {
  const int m = contact.components;
  Eigen::VectorXd F = Eigen::VectorXd::Zero(slots());
  for (int p = 0; p < contact.count; ++p)
    for (const Eigen::Index slot : {slots_[p].first, slots_[p].second})
      if (slot != none) F.segment(slot, m) = F_C.segment(m * p, m);
  const Eigen::VectorXd of_unknowns = reduced(F);
  return std::sqrt(std::max(0.0, of_unknowns.dot(solved(of_unknowns))));
}

}  // namespace airybench
