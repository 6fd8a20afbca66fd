#include "peers/petsc/answer_files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "support/errors.hpp"

namespace airybench {
namespace {

using namespace parallel;

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw FileError(file.string() + ": cannot be written");
}

}  // namespace

Eigen::Matrix4Xd gather_displacements(const EdgeSystem& system, const Eigen::VectorXd& u) {
  const BodyPart& part = system.part();
  const Numbering& edges = part.mesh.edges;
  const Eigen::Matrix4Xd moments =
      edge_moments(part.problem, part.system.unknown, part.system.displacement, system.to_local(u));
  std::vector<Eigen::Vector4d> own;
  std::vector<PetscInt> place;
  for (int edge = 0; edge < edges.count(); ++edge) {
    if (!edges.is_owned(edge)) continue;
    const auto [low, high] = part.problem.edges.vertices[edge];
    own.emplace_back(moments.col(edge) + part.problem.motion.moments(part.mesh.vertices_mm[low],
                                                                     part.mesh.vertices_mm[high]));
    place.push_back(edges.input[edge]);
  }
  Eigen::Matrix4Xd all(4, rank_here() == 0 ? part.mesh.edge_count : 0);
  to_rows(rows_of(static_cast<PetscInt>(all.cols()), place), FourNumbers().type, own.data(),
          all.data(), MPI_REPLACE);
  return all;
}

void write_answer(const std::filesystem::path& folder, const Eigen::Matrix4Xd& u,
                  const RowsResult& answer, const Said& said) {
  PetscViewer log = nullptr;
  check(PetscViewerASCIIOpen(PETSC_COMM_WORLD, (folder / "log.txt").c_str(), &log));
  check(PetscLogView(log));
  check(PetscViewerDestroy(&log));
  if (rank_here() != 0) return;
  // NumPy's format 1.0: the header of 118 = 0x76 bytes ends at byte 128.
  const std::string shape =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, 4), }}", u.cols());
  std::string numbers =
      std::string("\x93NUMPY\x01\x00\x76\x00", 10) + fmt::format("{:<117}\n", shape);
  numbers.append(reinterpret_cast<const char*>(u.data()),
                 static_cast<std::size_t>(u.size()) * sizeof(double));
  write(folder / "edge_displacements_mm.npy", numbers);
  if (answer.F_C.size() > 0)
    write(folder / "F_C.mtx", fmt::format("%%MatrixMarket matrix array real general\n{} 1\n{}\n",
                                          answer.F_C.size(), fmt::join(answer.F_C, "\n")));
  nlohmann::ordered_json json = {
      {"status", answer.converged ? "ok" : "not_converged"},
      {"time_s", said.time_s},
      {"stages", said.stages},
      {"linear_iterations", answer.iterations},
      {"contact_iterations", answer.steps},
      {"message", ""},
      {"parameters",
       fmt::format("ranks={}, coarse={}, {} unknowns, at most {} iterations at once", rank_count(),
                   said.coarse, said.coarse_unknowns, answer.most_in_a_step)}};
  if (answer.converged)
    json["error_estimate"] = said.estimate;
  else
    json["message"] = fmt::format(
        "active sets: natural map residual {:.3g}, linear error {:.3g} after {} active sets and "
        "{} linear iterations",
        answer.natural_map_residual, answer.linear_error, answer.steps, answer.iterations);
  write(folder / "answer.json", json.dump(1) + "\n");
}

}  // namespace airybench
