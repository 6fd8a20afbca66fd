// The contact law on the hybridized matrix itself, by active sets (active_set.hpp): no D, no G.
//
//   (K u − b)_i = 0 at inner slots;   at every contact point
//   open    F_n = 0,  F_t = 0    both slots are free
//   stick   u_n, u_t = ḡ         both are held
//   slip    u_n = ḡ_n, (K u − b)_t = −τ μ (K u − b)_n      the normal one is held
//
// where F = (K u − b) at contact slots. Held slots leave the system; a slip row takes the normal
// reaction along, which makes it nonsymmetric: GMRES, preconditioned by preconditioner.hpp with the
// same slots held. Steps are inexact: a tenth of the natural map while the laws change.
//
// The laws begin with those of the coarse displacements; point_laws.hpp chooses the next. What
// comes out counts by its natural map and residual only.
#pragma once

#include "solvers/contact/contact_result.hpp"
#include "solvers/contact/point_laws.hpp"
#include "solvers/krylov/gmres.hpp"
#include "solvers/two_level/preconditioner.hpp"

namespace airybench {

// The system in slots (edge_matrix.hpp).
struct SlotSystem {
  const EdgeMatrix& K;
  Eigen::VectorXd b;                        // N, without contact forces; −K ū0 is in it
  Eigen::VectorXd prescribed_u, K_times_u;  // ū0, mm; K ū0
  std::vector<Eigen::Index> prescribed;
  const ContactPoints& contact;
  std::vector<Eigen::Index> slot;  // of every contact point's normal; the tangential one follows
  Eigen::VectorXd compliance;      // rough, of every row of F_C

  SlotSystem(const Problem& problem, const ContactPoints& contact, const HybridizedSystem& system,
             const EdgeMatrix& K);
  Eigen::VectorXd of_contact(const Eigen::VectorXd& x) const;  // in the rows of F_C
  void drop_loads() { b = prescribed_u = K_times_u = Eigen::VectorXd(); }
  std::size_t bytes() const {
    return static_cast<std::size_t>(b.size() + prescribed_u.size() + K_times_u.size() +
                                    compliance.size()) *
           sizeof(double);
  }
};

// The linear system under given laws.
class LinearisedContact {
 public:
  LinearisedContact(const SlotSystem& system, TwoLevelPreconditioner& M) : s_(system), M_(M) {}
  void set(const std::vector<PointLaw>& laws);
  // r at free slots, slip rows with their normal reaction, zero at held ones.
  void reduce(Eigen::VectorXd& r) const;
  // x with  (reduced K) x ≈ reduced r.
  GmresResult solve(Eigen::VectorXd r, const GmresOptions& options, const Deadline& deadline,
                    Eigen::VectorXd& x);
  std::size_t bytes() const { return space_.bytes(); }

 private:
  const SlotSystem& s_;
  TwoLevelPreconditioner& M_;
  std::vector<PointLaw> laws_;
  std::vector<Eigen::Index> held_;
  KrylovSpace space_;
};

struct RowsResult {
  Eigen::VectorXd u;  // slots; zero at prescribed ones
  Eigen::VectorXd F_C;
  std::vector<PointLaw> laws;
  bool converged = false;
  double natural_map_residual = 0;  // relative
  double linear_error = 0;          // of u under its laws, relative in the energy norm, estimated
  int sweeps = 0, steps = 0;        // on the coarse contact problem; active sets
  std::int64_t iterations = 0;      // of GMRES
  std::size_t bytes = 0;            // of the iteration's vectors
  std::vector<double> history;      // linear_error
};

// control.tolerance: linear_error ≤ tolerance. scale: energy norm of the loads, where u has none.
RowsResult solve_contact_on_rows(const SlotSystem& system, TwoLevelPreconditioner& M, double scale,
                                 const RunControl& control);

}  // namespace airybench
