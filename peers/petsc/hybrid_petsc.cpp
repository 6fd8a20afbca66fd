// hybrid-petsc INPUT OUTPUT TOLERANCE [PETSc's options]: edge displacements and contact forces of
// an exported body (--format=npz) by hybridized equilibrium elements over the ranks of mpirun.
#include <charconv>
#include <cstring>
#include <iostream>

#include "peers/petsc/answer_files.hpp"
#include "peers/petsc/rank_rows.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/two_level/rows_check.hpp"

namespace airybench {
namespace {

using namespace parallel;

double clock_s() {
  MPI_Barrier(PETSC_COMM_WORLD);
  return MPI_Wtime();
}

// Stages by their names in answer.json.
class Stages {
 public:
  void end(const std::string& name) {
    const double now = clock_s();
    spent_[name] += now - last_;
    last_ = now;
  }
  double total() const { return last_ - start_; }
  const std::map<std::string, double>& spent() const { return spent_; }

 private:
  double start_ = clock_s(), last_ = start_;
  std::map<std::string, double> spent_;
};

// The whole body's, by which an error counts where there is no stress.
LoadScale scale_of(const BodyPart& part) {
  const LoadScale own = load_scale(part.problem);
  return {std::sqrt(sum(own.energy_norm * own.energy_norm)), largest(own.force_N)};
}

// The largest relative error that the answer's stresses and F_C have; adds its iterations.
double estimate_error(const EdgeSystem& system, RankRows& rows, const LoadScale& scale,
                      RowsResult& answer) {
  const Problem& problem = system.part().problem;
  UnbalancedForces unbalanced;
  double stress_energy = 0;
  {
    const Eigen::VectorXd u = system.to_local(answer.u);
    HybridizedAnswer recovered;
    each_by_itself([&] { recovered = recover_stresses(problem, system.part().system, u); });
    const UnbalancedForces& own = recovered.unbalanced;
    unbalanced = {system.from_local(own.r), largest(own.largest), system.from_local(own.defect),
                  sum(own.defect_energy)};
    stress_energy = sum(stress_norm_squared(problem, recovered.stress));
  }
  system.visit_contact([&](int row, PetscInt slot) { unbalanced.r(slot) += answer.F_C(row); });
  const double largest_r = largest(unbalanced.r.lpNorm<Eigen::Infinity>());
  const Eigen::VectorXd u_C = system.of_contact(answer.u);
  return rows_error(rows, std::move(unbalanced),
                    {answer.laws, answer.F_C, u_C, system.compliance_from_below(),
                     std::sqrt(stress_energy), largest_r, scale},
                    answer.iterations);
}

double tolerance_in(const char* text) {
  double tolerance = 0;
  const char* end = text + std::strlen(text);
  if (std::from_chars(text, end, tolerance).ptr != end || !(tolerance > 0 && tolerance < 1))
    throw std::runtime_error(std::string("TOLERANCE: ") + text + " (allowed: a number in (0, 1))");
  return std::max(tolerance, 1e-13);
}

void solve(const char* input, const char* output, const char* tolerance_text) {
  RunControl control;
  control.tolerance = tolerance_in(tolerance_text);
  control.target_error = 1e-9;  // no tolerance below a thousandth of this can be reached
  std::unique_ptr<NpzSlices> file;
  each_by_itself(
      [&] { file = std::make_unique<NpzSlices>(std::filesystem::path(input) / "problem.npz"); });
  MeshSlices slices = read_slices(*file);

  Stages stages;
  const BodyPart part = make_body_part(distribute(std::move(slices)), *file);
  stages.end("order");

  std::unique_ptr<CoarseSpace> coarse;
  if (RankRows::has_two_levels()) coarse = std::make_unique<CoarseSpace>(part);
  EdgeSystem system(part, [&](int t, const ElementStiffness& K_e) {
    if (coarse) coarse->add(t, K_e);
  });
  if (coarse) coarse->end_assembly();
  const LoadScale scale = scale_of(part);
  stages.end("precondition");

  RankRows rows(system, coarse.get());
  RowsResult answer = solve_contact_on_rows(rows, scale.energy_norm, control);
  answer.F_C = project_on_coulomb(part.contact, answer.F_C);
  stages.end("contact");
  Said said;
  if (answer.converged) said.estimate = estimate_error(system, rows, scale, answer);
  stages.end("check");
  const Eigen::Matrix4Xd u = gather_displacements(system, answer.u);
  stages.end("recover");

  said.stages = stages.spent();
  said.time_s = stages.total();
  said.coarse = !coarse ? "none" : coarse->kind() == CoarseKind::linear ? "linear" : "per-edge";
  said.coarse_unknowns = coarse ? coarse->unknowns() : 0;
  write_answer(output, u, answer, said);
}

}  // namespace
}  // namespace airybench

int main(int count, char** words) {
  using namespace airybench;
  if (count == 2 && std::string(words[1]) == "--version") {
    std::cout << "PETSc " << PETSC_VERSION_MAJOR << '.' << PETSC_VERSION_MINOR << '.'
              << PETSC_VERSION_SUBMINOR << '\n';
    return 0;
  }
  if (count < 4) {
    std::cerr << "hybrid-petsc: INPUT OUTPUT TOLERANCE [-options_file FILE] (allowed: folders, a "
                 "number, PETSc's options)\n";
    return 2;
  }
  if (PetscInitialize(&count, &words, nullptr, nullptr) != 0) return 3;
  PetscPushErrorHandler(parallel::keep_what_is_said, nullptr);
  PetscLogDefaultBegin();
  try {
    solve(words[1], words[2], words[3]);
  } catch (const std::exception& wrong) {
    if (parallel::rank_here() == 0)
      std::cerr << "hybrid-petsc: " << wrong.what() << '\n' << std::flush;
    MPI_Abort(PETSC_COMM_WORLD, 3);
  }
  return PetscFinalize() == 0 ? 0 : 3;
}
