// Programs that a test writes and declares to the bench command; right answers of Mesh0.
#pragma once

#include <gtest/gtest.h>

#include <iomanip>
#include <map>
#include <numeric>

#include "assembly/problem/scene.hpp"
#include "bench/plan/scene_file.hpp"
#include "solvers/methods.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::testing {

inline std::string market(const Eigen::MatrixXd& values) {
  std::ostringstream text;
  text << "%%MatrixMarket matrix array real general\n" << values.rows() << ' ' << values.cols();
  for (const double value : values.reshaped()) text << '\n' << std::setprecision(17) << value;
  return text.str() + "\n";
}

struct RightAnswer {
  Eigen::VectorXd x, F_C;
  Eigen::MatrixXd displacement_mm;  // at vertices, then at the middles of edges
  Eigen::MatrixXd edge_displacements_mm;
};

inline RightAnswer right_answer(const Scene& scene = {}) {
  const auto problem = testing::posed(scene, catalogue_mesh("Mesh0"));
  const AirySystem system = airy_system(problem);
  const Solution found = run(select_methods("3STEPD").front(), system, {});
  RightAnswer right;
  right.F_C = found.F_C;
  const Eigen::VectorXd scale = airy_function(system, Eigen::VectorXd::Ones(system.n()));
  Eigen::VectorXd numbers(system.n());
  std::iota(numbers.begin(), numbers.end(), 1);
  const Eigen::VectorXd place = airy_function(system, numbers);  // which of φ is which of x
  right.x.resize(system.n());
  for (Eigen::Index i = 0; i < place.size(); ++i)
    if (scale(i) != 0) right.x(std::lround(place(i) / scale(i)) - 1) = phi(found)(i) / scale(i);
  const Eigen::Matrix2Xd w = displacement(run(select_methods("P2").front(), system, {}));
  const auto& vertex = problem->mesh.vertices;
  right.displacement_mm = w.transpose();
  for (Eigen::Index node = 0; node < w.cols(); ++node) {
    const auto n = static_cast<Eigen::Index>(vertex.size());
    const auto [a, b] = node < n ? std::array{static_cast<int>(node), static_cast<int>(node)}
                                 : problem->edges.vertices[node - n];
    const Eigen::Vector2d u = node < n
                                  ? Eigen::Vector2d(w.col(node))
                                  : Eigen::Vector2d((w.col(a) + 2 * w.col(node) + w.col(b)) / 4);
    right.displacement_mm.row(node) = u + problem->motion.at((vertex[a] + vertex[b]) / 2);
  }
  const Solution hybrid = run(select_methods("HYBRID").front(), system, {});
  const Eigen::Matrix4Xd moments = std::get<EdgeDisplacements>(hybrid.unknowns).moments;
  right.edge_displacements_mm = moments.transpose();
  for (Eigen::Index edge = 0; edge < moments.cols(); ++edge) {
    const auto [low, high] = problem->edges.vertices[edge];
    const Eigen::Vector2d a = problem->motion.at(problem->mesh.vertices[low]),
                          b = problem->motion.at(problem->mesh.vertices[high]);
    right.edge_displacements_mm.row(edge) +=
        (Eigen::RowVector4d() << (2 * a + b).transpose() / 3, (a + 2 * b).transpose() / 3)
            .finished();
  }
  return right;
}

// In its folder: right/x.mtx, F_C.mtx, displacement_mm.mtx, answer.json, and NAME.json per program.
class ExternalPrograms : public ::testing::Test {
 protected:
  void write_right(const Scene& scene = {}) const {
    const RightAnswer right = right_answer(scene);
    write("right/x.mtx", market(right.x));
    write("right/F_C.mtx", market(right.F_C));
    write("right/displacement_mm.mtx", market(right.displacement_mm));
    write("right/edge_displacements_mm.mtx", market(right.edge_displacements_mm));
    write("right/answer.json", R"({"status": "ok", "time_s": 1e-6})");
  }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(bench_.path(name).parent_path());
    write_text(bench_.path(name), text);
  }
  static Json declaration(const std::string& name, const std::string& reads,
                          const std::vector<std::string>& command) {
    static const std::map<std::string, std::string> returns = {
        {"airy", "airy_function"}, {"condensed", "contact_forces"}, {"body", "displacement"}};
    return {{"name", name},
            {"reads", reads},
            {"format", "matrix-market"},
            {"returns", returns.at(reads)},
            {"command", command}};
  }
  // $1: {input}, $2: {output}; it runs in the test's folder.
  void declare(const std::string& name, const std::string& reads, const std::string& script,
               const Json& more = Json::object()) const {
    Json json = declaration(name, reads, {"sh", "-c", script, "sh", "{input}", "{output}"});
    json.update(more);
    write(name + ".json", json.dump());
  }
  // Of every program that is declared there, by name.
  std::map<std::string, Json> records_of(const std::string& arguments, int code) const {
    const CommandResult result = bench_.run(
        "--external='*.json' --method='EXTERNAL:*' --mesh=Mesh0 --repetitions=1 --out=o " +
        arguments);
    EXPECT_EQ(result.code, code) << result.err;
    std::map<std::string, Json> by_name;
    for (const Json& record : bench_.records())
      by_name[record["method"].get<std::string>().substr(9)] = record;
    return by_name;
  }
  const BenchCommand bench_;
};

}  // namespace airybench::testing
