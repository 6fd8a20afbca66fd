// The contact law on the hybridized matrix itself, by active sets (active_set.hpp): no D, no G.
//
//   (K u − b)_i = 0 at inner slots;   at every contact point
//   open    F_n = 0,  F_t = 0    both slots are free
//   stick   u_n, u_t = ḡ         both are held
//   slip    u_n = ḡ_n, (K u − b)_t = −τ μ (K u − b)_n      the normal one is held
//
// where F = (K u − b) at contact slots. Held slots leave the system; a slip row takes the normal
// reaction along, which makes it nonsymmetric. Steps are inexact: a tenth of the natural map while
// the laws change.
//
// point_laws.hpp chooses the next laws. What comes out counts by its natural map and residual only.
#pragma once

#include "solvers/contact/point_laws.hpp"
#include "solvers/krylov/gmres.hpp"

namespace airybench {

// The system that active sets act on, and what solves it: slot_rows.hpp, factored_rows.hpp. Where
// processes share a body, a vector has the slots of one of them, and dot() and of_contact() are
// those of all.
class ContactRows {
 public:
  // compliance: rough, of every row of F_C. condition: √cond(M⁻¹K), about.
  ContactRows(ContactPoints points, Eigen::VectorXd rough_compliance, double root_condition)
      : contact(std::move(points)),
        compliance(std::move(rough_compliance)),
        condition(root_condition) {}
  virtual ~ContactRows() = default;

  const ContactPoints contact;  // joined (paired_points.hpp)
  Eigen::VectorXd compliance;
  double condition;
  double next_target = 0;  // of a target for the linear error under laws that have settled

  virtual Eigen::Index slots() const = 0;
  // Those to begin with; counts the iterations that they cost.
  virtual std::vector<PointLaw> first_laws(int& sweeps) = 0;
  // Holds what these laws hold.
  virtual void set(const std::vector<PointLaw>& laws) = 0;
  // Moves held contact slots to where they are held.
  virtual void move_to_gap(Eigen::VectorXd& u) const = 0;
  // The forces b − K u that u leaves; returns wᵀ K w, w = u + ū0 − ū_th.
  virtual double measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) = 0;
  // x with (reduced K) x ≈ reduced r: at free slots, slip rows with their normal reaction.
  virtual GmresResult solve(Eigen::VectorXd r, const GmresOptions& options, Eigen::VectorXd& x) = 0;
  // condition · √(r·M⁻¹r) of the r that a solve has left: of what is wrong with x, in the energy
  // norm, at most. measured: of this r, if a recurrence is not to be trusted.
  virtual double error_left(const GmresResult& solve, const Eigen::VectorXd& r, bool measured) = 0;
  // Displacements in the rows of F_C, of a pair the sum; the forces that hold them, of those that u
  // leaves.
  virtual Eigen::VectorXd of_contact(const Eigen::VectorXd& x) const = 0;
  virtual Eigen::VectorXd reactions(const Eigen::VectorXd& unbalanced) const {
    return -of_contact(unbalanced);
  }
  virtual void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const = 0;  // y = K x
  virtual double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const = 0;
  virtual double norm_from_below(const Eigen::VectorXd& F_C) = 0;  // √(F·M⁻¹F) ≤ ‖F‖_D
};

struct RowsResult {
  Eigen::VectorXd u;  // slots; zero at prescribed ones
  Eigen::VectorXd F_C;
  std::vector<PointLaw> laws;
  bool converged = false;
  double natural_map_residual = 0;  // relative
  double linear_error = 0;          // of u under its laws, relative in the energy norm, estimated
  int sweeps = 0, steps = 0;        // for the first laws; active sets
  std::int64_t iterations = 0;      // linear ones
  std::int64_t max_in_a_step = 0;
  std::size_t bytes = 0;        // of the iteration's vectors
  std::vector<double> history;  // linear_error
};

struct RowsOptions {
  double tolerance = 1e-10;   // linear_error ≤ tolerance
  double acceptable = 1e-10;  // linear_error ≤ acceptable, under laws that have settled
};

// scale: energy norm of the loads, where u has none.
RowsResult solve_contact_on_rows(ContactRows& rows, const LoadScale& scale,
                                 const RowsOptions& options);

}  // namespace airybench
