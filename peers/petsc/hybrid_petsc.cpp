// hybrid-petsc INPUT OUTPUT TOLERANCE [PETSc's options]: edge displacements and contact forces of
// an exported body (--format=npz), by hybridized equilibrium elements over the ranks of mpirun.
#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "peers/petsc/rank_rows.hpp"
#include "solvers/active_sets/rows_check.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

using namespace parallel;

struct Stages {
  double start = clock_s(), last = start;
  std::map<std::string, double> spent;

  static double clock_s() {
    MPI_Barrier(PETSC_COMM_WORLD);
    return MPI_Wtime();
  }
  void end(const std::string& name) {
    spent[name] = -last;
    spent[name] += last = clock_s();
  }
};

LoadScale scale_of(const BodyPart& part) {
  const LoadScale own = load_scale(part.problem);
  return {std::sqrt(sum(own.energy_norm * own.energy_norm)), largest(own.force_N)};
}

// Largest relative error of the answer's stresses and F_C; adds the iterations it needs.
double estimate_error(const BodyPart& part, RankRows& rows, const LoadScale& scale,
                      RowsResult& answer) {
  UnbalancedForces unbalanced;
  double stress_energy = 0;
  {
    const Eigen::VectorXd u = rows.to_local(answer.u);
    HybridizedAnswer recovered;
    each_by_itself([&] { recovered = recover_stresses(part.problem, part.system, u); });
    const UnbalancedForces& own = recovered.unbalanced;
    unbalanced = {rows.from_local(own.r), largest(own.largest), rows.from_local(own.defect),
                  sum(own.defect_energy)};
    stress_energy = sum(stress_norm_squared(part.problem, recovered.stress));
  }
  rows.visit_contact([&](int row, PetscInt slot) { unbalanced.r(slot) += answer.F_C(row); });
  const double largest_r = largest(unbalanced.r.lpNorm<Eigen::Infinity>());
  const Eigen::VectorXd u_C = rows.of_contact(answer.u);
  return rows_error(rows, std::move(unbalanced),
                    {answer.laws, answer.F_C, u_C, rows.compliance_from_below(),
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

void write(const std::filesystem::path& file, std::string_view text, std::string_view more = {}) {
  std::ofstream out(file, std::ios::binary);
  out << text << more;
  if (!out.flush()) throw FileError(file.string() + ": cannot be written");
}

// At rank 0, in file order: x, y at an edge's low and high vertex, mm, with the rigid motion.
Eigen::Matrix4Xd gather_displacements(const BodyPart& part, const RankRows& rows,
                                      const Eigen::VectorXd& u) {
  const Numbering& edges = part.edges;
  const Eigen::Matrix4Xd moments =
      edge_moments(part.problem, part.system.unknown, part.system.displacement, rows.to_local(u));
  std::vector<Eigen::Vector4d> own;
  std::vector<PetscInt> place;
  for (int edge = 0; edge < edges.count(); ++edge) {
    if (!edges.is_owned(edge)) continue;
    const auto [low, high] = part.problem.edges.vertices[edge];
    own.emplace_back(moments.col(edge) +
                     part.problem.motion.moments(part.problem.mesh.vertices[low],
                                                 part.problem.mesh.vertices[high]));
    place.push_back(edges.input[edge]);
  }
  Eigen::Matrix4Xd all(4, rank_here() == 0 ? edges.all : 0);
  to_rows(rows_of(static_cast<PetscInt>(all.cols()), place), FourNumbers().type, own.data(),
          all.data(), MPI_REPLACE);
  return all;
}

// Writes edge_displacements_mm.npy, F_C.mtx, log.txt and, last, answer.json. Collective.
void write_answer(const std::filesystem::path& folder, const Eigen::Matrix4Xd& u,
                  const RowsResult& answer, double estimate, const CoarseSpace* coarse,
                  const Stages& stages) {
  const PetscInt coarse_unknowns = coarse == nullptr ? 0 : coarse->unknowns();
  PetscViewer log = nullptr;
  check(PetscViewerASCIIOpen(PETSC_COMM_WORLD, (folder / "log.txt").c_str(), &log));
  check(PetscLogView(log));
  check(PetscViewerDestroy(&log));
  if (rank_here() != 0) return;
  // NumPy's format 1.0: the header of 118 = 0x76 bytes ends at byte 128.
  const std::string shape =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, 4), }}", u.cols());
  write(folder / "edge_displacements_mm.npy",
        std::string("\x93NUMPY\x01\x00\x76\x00", 10) + fmt::format("{:<117}\n", shape),
        {reinterpret_cast<const char*>(u.data()),
         static_cast<std::size_t>(u.size()) * sizeof(double)});
  if (answer.F_C.size() > 0)
    write(folder / "F_C.mtx", fmt::format("%%MatrixMarket matrix array real general\n{} 1\n{}\n",
                                          answer.F_C.size(), fmt::join(answer.F_C, "\n")));
  nlohmann::ordered_json json = {
      {"status", answer.converged ? "ok" : "not_converged"},
      {"time_s", stages.last - stages.start},
      {"stages", stages.spent},
      {"linear_iterations", answer.iterations},
      {"contact_iterations", answer.steps},
      {"message", ""},
      {"parameters",
       fmt::format("ranks={}, coarse={}, {} unknowns, at most {} iterations at once", rank_count(),
                   coarse == nullptr                      ? "none"
                   : coarse->kind() == CoarseKind::linear ? "linear"
                                                          : "per-edge",
                   coarse_unknowns, answer.max_in_a_step)}};
  if (answer.converged)
    json["error_estimate"] = estimate;
  else
    json["message"] = fmt::format(
        "active sets: natural map residual {:.3g}, linear error {:.3g} after {} active sets and "
        "{} linear iterations",
        answer.natural_map_residual, answer.linear_error, answer.steps, answer.iterations);
  write(folder / "answer.json", json.dump(1) + "\n");
}

void solve(const char* input, const char* output, const char* tolerance_text) {
  constexpr double in_reach = 1e-12;
  const RowsOptions options = {tolerance_in(tolerance_text), in_reach};
  std::unique_ptr<NpzSlices> file;
  each_by_itself(
      [&] { file = std::make_unique<NpzSlices>(std::filesystem::path(input) / "problem.npz"); });
  MeshSlices slices = read_slices(*file);

  Stages stages;
  const BodyPart part = make_body_part(distribute(std::move(slices)), *file);
  stages.end("order");

  std::unique_ptr<CoarseSpace> coarse;
  if (option("-pc_type") == PCMG) coarse = std::make_unique<CoarseSpace>(part);
  RankRows rows(part, coarse.get());
  const LoadScale scale = scale_of(part);
  stages.end("precondition");

  RowsResult answer = solve_contact_on_rows(rows, scale, options);
  answer.F_C = project_on_coulomb(part.contact, answer.F_C);
  stages.end("contact");
  double estimate = 0;
  if (answer.converged) estimate = estimate_error(part, rows, scale, answer);
  stages.end("check");
  const Eigen::Matrix4Xd u = gather_displacements(part, rows, answer.u);
  stages.end("recover");

  write_answer(output, u, answer, estimate, coarse.get(), stages);
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
