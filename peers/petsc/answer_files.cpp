#include "peers/petsc/answer_files.hpp"

#include <fmt/format.h>

#include <fstream>

#include "support/errors.hpp"

namespace airybench {
namespace {

using namespace parallel;

struct OfEdge {
  int edge;
  std::array<double, 4> moments;
};

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw FileError(file.string() + ": cannot be written");
}

std::string npy_header(Eigen::Index rows) {
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, 4), }}", rows);
  constexpr std::size_t before = 10, alignment = 64;
  header.append(alignment - 1 - (before + header.size()) % alignment, ' ') += '\n';
  std::string file("\x93NUMPY\x01\x00", 8);
  file += static_cast<char>(header.size() % 256);
  file += static_cast<char>(header.size() / 256);
  return file + header;
}

}  // namespace

EdgeDisplacements gather_displacements(const EdgeSystem& system, Vec u) {
  const BodyPart& part = system.part();
  const Problem& problem = part.problem;
  const Eigen::VectorXd local = system.to_local(u);
  const Eigen::Matrix4Xd moments =
      edge_moments(problem, system.of_part().unknown, system.of_part().displacement, local);
  std::vector<OfEdge> own;
  for (int edge = 0; edge < problem.edges.count(); ++edge) {
    if (!part.mesh.edges.is_owned(edge)) continue;
    const auto [low, high] = problem.edges.vertices[edge];
    const Eigen::Vector4d of_u =
        moments.col(edge) +
        problem.motion.moments(part.mesh.vertices_mm[low], part.mesh.vertices_mm[high]);
    own.push_back({part.mesh.edges.input[edge], {of_u(0), of_u(1), of_u(2), of_u(3)}});
  }
  const std::vector<OfEdge> all = exchanged(own, std::vector<int>(own.size(), 0));
  EdgeDisplacements result(4, static_cast<Eigen::Index>(all.size()));
  for (const OfEdge& of : all)
    result.col(of.edge) = Eigen::Map<const Eigen::Vector4d>(of.moments.data());
  return result;
}

void write_answer(const std::filesystem::path& folder, const EdgeDisplacements& u,
                  const ContactAnswer& answer, const Said& said) {
  PetscViewer log = nullptr;
  check(PetscViewerASCIIOpen(PETSC_COMM_WORLD, (folder / "log.txt").c_str(), &log));
  check(PetscLogView(log));
  check(PetscViewerDestroy(&log));
  if (rank_here() != 0) return;
  {
    std::ofstream out(folder / "edge_displacements_mm.npy", std::ios::binary);
    const std::string header = npy_header(u.cols());
    out.write(header.data(), static_cast<std::streamsize>(header.size()));
    out.write(reinterpret_cast<const char*>(u.data()),
              static_cast<std::streamsize>(static_cast<std::size_t>(u.size()) * sizeof(double)));
    if (!out.flush()) throw FileError("edge_displacements_mm.npy: cannot be written");
  }
  if (answer.F_C.size() > 0) {
    std::string forces =
        fmt::format("%%MatrixMarket matrix array real general\n{} 1\n", answer.F_C.size());
    for (const double F : answer.F_C) forces += fmt::format("{}\n", F);
    write(folder / "F_C.mtx", forces);
  }
  std::string stages;
  for (const auto& [name, seconds] : said.stages)
    stages += fmt::format("{}\"{}\": {}", stages.empty() ? "" : ", ", name, seconds);
  const std::string message = fmt::format(
      "active sets: natural map residual {:.3g}, linear error {:.3g} after {} active sets and {} "
      "linear iterations",
      answer.natural_map, answer.linear_error, answer.steps, answer.iterations);
  write(folder / "answer.json",
        fmt::format("{{\"status\": \"{}\", \"time_s\": {}, \"stages\": {{{}}},\n"
                    " \"linear_iterations\": {}, \"contact_iterations\": {},{}\n"
                    " \"message\": \"{}\",\n"
                    " \"parameters\": \"ranks={}, coarse={}, {} unknowns, at most {} iterations at "
                    "once\"}}\n",
                    said.converged ? "ok" : "not_converged", said.time_s, stages, answer.iterations,
                    answer.steps,
                    said.converged ? fmt::format(" \"error_estimate\": {},", said.estimate) : "",
                    said.converged ? "" : message, rank_count(), said.coarse, said.coarse_unknowns,
                    answer.most_in_a_step));
}

}  // namespace airybench
