#include <sstream>

#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/contact/active_set.hpp"

namespace airybench {

Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix, const std::string& name) {
  Eigen::LLT<Eigen::MatrixXd> llt(matrix);
  if (llt.info() != Eigen::Success || !matrix.allFinite())
    throw Breakdown(name + " is not positive definite to rounding");
  return llt;
}

void solve_condensed_contact(const CondensedSystem& condensed, const ContactPoints& contact,
                             const RunControl& control, Solution& solution) {
  solution.status = Status::ok;
  solution.message.clear();
  if (contact.size() == 0) return;
  const StageTimer timer(solution.times, Stage::contact);
  const OwnerScope scope(MemoryOwner::condensed);
  ContactResult result = solve_contact_by_gauss_seidel(condensed, contact, control);
  if (!result.converged && control.active_sets)
    finish_by_active_set(condensed, contact, control, result);
  solution.F_C = std::move(result.F_C);
  solution.contact_iterations = result.sweeps;
  if (control.histories) {
    IterationHistory& history = solution.histories.emplace_back();
    history.what = "relative change of F_C per Gauss-Seidel sweep";
    history.residual = std::move(result.history);
  }
  if (!result.converged) {
    std::ostringstream message;
    message << "contact law: natural map residual " << result.natural_map_residual << " after "
            << result.sweeps << " Gauss-Seidel sweeps and " << result.active_set_steps
            << " active sets (tolerance " << control.contact_tolerance << ")";
    solution.status = Status::not_converged;
    solution.message = message.str();
  }
}

KrylovOptions krylov_options(const RunControl& control, int lanes) {
  KrylovOptions options;
  options.tolerance = control.tolerance;
  options.lanes = lanes;
  options.threads = control.threads;
  return options;
}

void note_krylov(const char* solver, const KrylovSummary& summary, const KrylovOptions& options,
                 const RunControl& control, Solution& solution) {
  solution.linear_iterations = summary.iterations;
  if (control.histories)
    solution.histories.push_back(
        {std::string("relative residual of the first right-hand side, ") + solver,
         summary.history});
  if (summary.converged) return;
  std::ostringstream message;
  message << solver << ": relative residual " << summary.residual << " after "
          << summary.most_iterations << " iterations (tolerance " << options.tolerance << ")";
  solution.status = Status::not_converged;
  solution.message = message.str();
}

void note_preconditioner(const Preconditioner& preconditioner, Solution& solution) {
  solution.storage[MemoryOwner::preconditioner] = preconditioner.bytes;
  if (preconditioner.bytes > 0) solution.factor_entries = preconditioner.entries;
  solution.factor_flops = preconditioner.flops;
  if (preconditioner.shift == 0) return;
  std::ostringstream text;
  text << "shift=" << preconditioner.shift;
  solution.parameters = text.str();
}

}  // namespace airybench
