// SYMMLQ:<preconditioner>: condensation of the whole indefinite system by SYMMLQ, preconditioned by
// blocks.
#include "solvers/krylov/symmlq.hpp"

#include "solvers/condensation/symmlq_condensation.hpp"
#include "solvers/names/general_names.hpp"

namespace airybench {
namespace {

Solution solve_symmlq(const AirySystem& system, const RunControl& control,
                      const MakePreconditioner& make, Refine refine) {
  const int n = system.n(), n_f = system.n_f(), n_c = system.n_c();
  Solution solution;
  const Preconditioner preconditioner =
      run_stage(solution.times, Stage::precondition, MemoryOwner::preconditioner, [&] {
        return saddle_preconditioner(system, make(system.S, control.deadline), control.threads,
                                     control.deadline);
      });
  note_preconditioner(preconditioner, solution);
  const KrylovOptions options = krylov_options(control);
  const SymmetricOperator A = saddle_operator(system);
  solution.storage[MemoryOwner::iteration] =
      iteration_bytes(options, n_c + 1, symmlq_vectors * A.n + preconditioner.workspace_rows);
  const auto load = [&](LaneColumn b) {
    if (system.q.size() > 0) b.head(n) = system.q;
    if (system.F.size() > 0) b.segment(n, n_f) = system.F;
    if (system.F0.size() > 0) b.tail(n_c) = -system.F0;
  };

  contact::Problem condensed;
  KrylovSummary all;
  if (n_c > 0)
    run_stage(solution.times, Stage::condense, MemoryOwner::condensed, [&] {
      condensed.points = system.contact;
      condensed.D.resize(n_c, n_c);
      condensed.G.resize(n_c);
      const RightHandSides sides = {n_c + 1,
                                    [&](int k, LaneColumn b) {
                                      if (k == 0)
                                        load(b);
                                      else
                                        b(n + n_f + k - 1) = 1;
                                    },
                                    [&](int k, const LaneColumn& x) {
                                      if (k == 0)
                                        condensed.G = x.tail(n_c);
                                      else
                                        condensed.D.col(k - 1) = -x.tail(n_c);
                                    }};
      all.add(solve_by_symmlq(A, preconditioner, sides, options, control.deadline));
      condensed.D = ((condensed.D + condensed.D.transpose()) / 2).eval();
    });

  const auto solve_one = [&](const std::function<void(LaneColumn)>& make_load) {
    SaddleVector v;
    const RightHandSides side = {1, [&](int, LaneColumn b) { make_load(b); },
                                 [&](int, const LaneColumn& x) {
                                   v = {x.head(n), x.segment(n, n_f), x.tail(n_c)};
                                 }};
    KrylovOptions one = options;
    one.lanes = 1;
    try {
      all.add(solve_by_symmlq(A, preconditioner, side, one, control.deadline));
    } catch (TimeoutReached& timeout) {
      timeout.count_before(n_c > 0 ? n_c + 1 : 0);
      throw;
    }
    return v;
  };
  finish_in_airy_function(
      system, control, condensed,
      [&](const Eigen::VectorXd& F_C) {
        return solve_one([&](LaneColumn b) {
          load(b);
          if (n_c > 0) b.tail(n_c) += F_C;
        });
      },
      [&](const AirySystem&, SaddleVector& v) {
        v = solve_one([&](LaneColumn b) {
          b.head(n) = v.x;
          b.segment(n, n_f) = v.lambda_F;
          b.tail(n_c) = v.lambda_C;
        });
      },
      refine, solution);
  note_krylov("SYMMLQ", all, options, control, solution);
  return solution;
}

}  // namespace

Method symmlq(GeneralName name) {
  const MakePreconditioner make = name.preconditioner();
  const Refine refine = name.refine();
  name.refuse_rest("refine");
  Method method = krylov_method(name, "SYMMLQ condensation, block preconditioner with ");
  method.condenses_contact_only = true;
  method.solve = on_airy_system([=](const AirySystem& system, const RunControl& control) {
    return solve_symmlq(system, control, make, refine);
  });
  return method;
}

}  // namespace airybench
