#include "peers/petsc/active_sets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/load_scale.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

using namespace parallel;

std::vector<PointLaw> first_laws(const ContactPoints& contact) {
  std::vector<PointLaw> laws(static_cast<std::size_t>(contact.count));
  for (int p = 0; p < contact.count; ++p) {
    laws[p].closed = contact.gap.size() > 0 && contact.gap(contact.components * p) < 0;
    laws[p].sticks = laws[p].closed && contact.components == 2 && contact.friction_at(p) > 0;
  }
  return laws;
}

class ActiveSets {
 public:
  ActiveSets(EdgeSystem& system, LinearSolver& solver, double scale, double tolerance)
      : system_(system),
        contact_(system.part().contact),
        compliance_(system.part().compliance),
        solver_(solver),
        scale_(scale),
        tolerance_(tolerance),
        unbalanced_(system.new_vector()),
        product_(system.new_vector()),
        correction_(system.new_vector()) {
    now_.u = system.new_vector();
    now_.laws = first_laws(contact_);
  }

  ContactAnswer solve() {
    constexpr int most_steps = 100;
    constexpr double first = 0.01;
    // Laws that settle at a linear error may change at a smaller one: soon seen, little is lost.
    constexpr double next = 0.01;
    constexpr double rounding = 1e-12;  // what can be reached of a smaller tolerance
    double target = first;
    bool laws_are_new = true;
    while (now_.steps < most_steps) {
      if (laws_are_new) {
        ++now_.steps;
        solver_.set_laws(now_.laws);
        move_to_gap();
        measure();
      }
      now_.converged = false;
      if (!solve_linear(target)) break;
      laws_are_new = choose_laws();
      if (laws_are_new) {
        target = std::clamp(now_.natural_map / 10, tolerance_, first);
      } else {
        now_.converged = now_.linear_error <= std::max(tolerance_, rounding);
        if (now_.linear_error <= tolerance_ || target <= tolerance_) break;
        target = std::max(tolerance_, next * std::min(target, now_.linear_error));
      }
    }
    now_.u_C = system_.of_contact(now_.u);
    return std::move(now_);
  }

 private:
  // Held contact slots to where they are held.
  void move_to_gap() {
    if (contact_.count == 0) return;
    const int m = contact_.components;
    Eigen::VectorXd gap = Eigen::VectorXd::Zero(contact_.size());
    if (contact_.gap.size() > 0) gap = contact_.gap;
    std::vector<bool> held(static_cast<std::size_t>(contact_.size()), false);
    for (int p = 0; p < contact_.count; ++p) {
      held[m * p] = now_.laws[p].closed;
      if (m == 2) held[m * p + 1] = now_.laws[p].sticks;
    }
    system_.set_at_contact(gap, held, now_.u);
  }

  // The forces that u leaves, and the energy norm of all of it.
  void measure() {
    system_.multiply(now_.u, product_);
    size_ = std::sqrt(system_.energy(now_.u, product_));
    check(VecWAXPY(unbalanced_, -1, product_, system_.b()));
  }

  double relative_linear_error(double norm) const {
    return relative_error(preconditioned_condition * norm, size_ > 0 ? size_ : scale_, scale_);
  }

  // Until the linear error is below the target, or no longer falls; false: the method broke down.
  bool solve_linear(double target) {
    constexpr int most_cycles = 20;
    OwnedVec r = system_.new_vector();
    double before = std::numeric_limits<double>::infinity();
    int of_step = 0;
    for (int cycle = 0; cycle < most_cycles; ++cycle) {
      check(VecCopy(unbalanced_, r));
      system_.reduce(r);
      now_.linear_error = relative_linear_error(solver_.norm(r));
      if (!std::isfinite(now_.linear_error)) return false;
      if (now_.linear_error <= target || now_.linear_error > before / 2) break;
      before = now_.linear_error;
      const double reduction = std::clamp(target / now_.linear_error / 2, 1e-8, 0.5);
      const LinearSolver::Result linear = solver_.solve(r, reduction, correction_);
      now_.iterations += linear.iterations;
      of_step += linear.iterations;
      now_.most_in_a_step = std::max(now_.most_in_a_step, of_step);
      if (linear.broke_down) return false;
      check(VecAXPY(now_.u, 1, correction_));
      measure();
      if (target <= tolerance_) continue;  // measured, not believed
      now_.linear_error *= linear.reduction;
      if (now_.linear_error <= target) break;
    }
    return true;
  }

  // Forces, natural map and the laws that follow; whether these change.
  bool choose_laws() {
    if (contact_.count == 0) return false;
    now_.F_C = forces_under(contact_, now_.laws, -system_.of_contact(unbalanced_));
    LawChoice::Next next = choice_.after(contact_, compliance_, now_.laws, now_.F_C,
                                         system_.of_contact(now_.u), tolerance_);
    now_.natural_map = next.natural_map;
    PetscInfo(nullptr, "active set %d: natural map %g, linear error %g, %d iterations so far\n",
              now_.steps, now_.natural_map, now_.linear_error, now_.iterations);
    if (next.laws.empty()) return false;
    now_.laws = std::move(next.laws);
    return true;
  }

  EdgeSystem& system_;
  const ContactPoints& contact_;
  const Eigen::VectorXd& compliance_;
  LinearSolver& solver_;
  double scale_, tolerance_;
  OwnedVec unbalanced_, product_, correction_;
  ContactAnswer now_;
  LawChoice choice_;
  double size_ = 0;
};

struct Correction {
  OwnedVec x;
  double norm = 0;  // ‖x‖_K, and what is left of it
};

Correction solve_under(EdgeSystem& system, LinearSolver& solver, const std::vector<PointLaw>& laws,
                       Vec load, ContactAnswer& answer) {
  constexpr double digits = 0.02;
  if (laws != system.laws()) solver.set_laws(laws);
  Correction correction{system.new_vector()};
  OwnedVec r = system.new_vector(), product = system.new_vector();
  check(VecCopy(load, r));
  system.reduce(r);
  answer.iterations += solver.solve(r, digits, correction.x).iterations;
  system.multiply(correction.x, product);
  PetscScalar energy = 0;
  check(VecDot(correction.x, product, &energy));
  check(VecWAXPY(r, -1, product, load));
  system.reduce(r);
  correction.norm = std::sqrt(std::max(0.0, energy)) + preconditioned_condition * solver.norm(r);
  return correction;
}

}  // namespace

ContactAnswer solve_contact(EdgeSystem& system, LinearSolver& solver, double scale,
                            double tolerance) {
  return ActiveSets(system, solver, scale, tolerance).solve();
}

double estimate_error(EdgeSystem& system, LinearSolver& solver, double scale,
                      ContactAnswer& answer) {
  constexpr double safety = 1.5;
  const BodyPart& part = system.part();
  const ContactPoints& contact = part.contact;
  OwnedVec r = system.new_vector(), defect = system.new_vector();
  double energy = 0, largest_force = 0, stress_energy = 0;
  {
    Eigen::VectorXd u = system.to_local(answer.u);
    HybridizedAnswer recovered;
    each_by_itself([&] { recovered = recover_stresses(part.problem, system.of_part(), u); });
    system.add_from_local(recovered.unbalanced.r, r);
    system.add_from_local(recovered.unbalanced.defect, defect);
    energy = sum(recovered.unbalanced.defect_energy);
    largest_force = largest(recovered.unbalanced.largest);
    stress_energy = sum(stress_norm_squared(part.problem, recovered.stress));
  }
  OwnedVec forces = system.new_vector();
  const std::vector<bool> all(static_cast<std::size_t>(contact.size()), true);
  system.set_at_contact(answer.F_C, all, forces);
  check(VecAXPY(r, 1, forces));
  PetscReal unbalanced = 0;
  check(VecNorm(r, NORM_INFINITY, &unbalanced));
  check(VecAXPY(r, 1, defect));

  const Correction under_laws = solve_under(system, solver, answer.laws, r, answer);
  PetscScalar with_defect = 0;
  check(VecDot(under_laws.x, defect, &with_defect));
  const double squared = energy + under_laws.norm * under_laws.norm - 2 * with_defect;
  const double stress = safety * std::sqrt(std::max(0.0, squared)) + 0.01 * std::sqrt(energy);
  double estimate = std::max(relative_error(unbalanced, largest_force, 1),
                             relative_error(stress, std::sqrt(stress_energy), scale));
  if (contact.count == 0) return estimate;
  const std::vector<PointLaw> open(answer.laws.size());
  const Correction held = solve_under(system, solver, open, r, answer);
  const Eigen::VectorXd u_C = answer.u_C + system.of_contact(held.x);
  const double map = natural_map(contact, system.compliance_from_below(), answer.F_C, u_C).norm();
  return std::max(
      {estimate, relative_error(safety * (under_laws.norm + held.norm), solver.norm(forces), scale),
       relative_error(map, answer.F_C.norm(), 1)});
}

}  // namespace airybench
