// `bench export-problem` from outside: what is refused, what is left out. The files themselves are
// read by test_exported_problems.py.
#include <gtest/gtest.h>

#include <algorithm>

#include "assembly/airy_system.hpp"
#include "assembly/problem/scene.hpp"
#include "bench/problems/problem_arrays.hpp"
#include "mesh/msh_format.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::export_problem_test {
namespace {

using testing::CommandResult;

class ExportProblemCommand : public ::testing::Test {
 protected:
  CommandResult run(const std::string& arguments, const std::string& before = "") const {
    return bench_.run("export-problem " + arguments, before);
  }
  // One line, and nothing in the folder but what was there.
  void refused(const std::string& arguments, const std::string& line,
               const std::string& before = "") const {
    const std::vector<std::string> there = entries();
    bench_.expect_refusal("export-problem " + arguments, line, before);
    EXPECT_EQ(entries(), there);
  }
  std::vector<std::string> entries() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(bench_.path(".")))
      if (entry.path().extension() != ".txt") names.push_back(entry.path().string());
    std::ranges::sort(names);
    return names;
  }
  void write_mesh(const std::string& name, const Mesh& mesh) const {
    std::ofstream file(bench_.path(name));
    write_msh(file, mesh);
  }
  Json description(const std::string& folder) const {
    return Json::parse(bench_.content(folder + "/problem.json"));
  }
  const testing::BenchCommand bench_;
};

bool has_array(const Json& description, const std::string& name) {
  return std::ranges::any_of(description["arrays"],
                             [&](const Json& array) { return array["name"] == name; });
}

TEST_F(ExportProblemCommand, BadArgumentsAreRefusedAndNothingIsWritten) {
  testing::write_text(bench_.path("flat.json"), R"({"mesh": {"keep_contact_edges": 0}})");
  std::filesystem::create_directories(bench_.path("full/of"));
  for (const auto& [arguments, named] :
       {std::pair("--mesh=Mesh0,Mesh1 --format=matrix-market --out=o",
                  "--mesh: Mesh0,Mesh1: 2 meshes"),
        {"--format=matrix-market --out=o", "--mesh is required\n"},
        {"--mesh=Mesh0 --out=o", "--format is required\n"},
        {"--mesh=Mesh0 --format=matrix-market", "--out is required\n"},
        {"--mesh=Mesh0 --format=matrix-market --out=full", "full: is there already (allowed: "},
        {"--mesh=Mesh0 --format=matrix-market --out=flat.json", "flat.json: is there already ("},
        {"--mesh=Mesh0 --format=matrix-market --out=flat.json/o",
         "flat.json: cannot be made a fold"},
        {"--mesh=Mesh0 --format=matrix-market --scene=none.json --out=o",
         "none.json: cannot be ope"},
        {"--mesh=Mesh0 --format=xml --out=o", "--format: xml (valid: matrix-market"}})
    refused(arguments, named);
}

TEST_F(ExportProblemCommand, AFullDiskLeavesNothing) {
  refused("--mesh=Mesh0 --format=matrix-market --out=o", "cannot be written: File too large",
          "trap '' XFSZ; ulimit -f 16; ");
}

TEST_F(ExportProblemCommand, ABodyWithAHoleHasNoAirySystem) {
  write_mesh("plate.msh", testing::small_plate(2));
  const CommandResult result = run("--mesh=plate.msh --format=matrix-market --out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("note: only the body and the condensed problem: "))
      << result.out;
  const Json plate = description("o");
  EXPECT_TRUE(has_array(plate, "D"));
  EXPECT_FALSE(has_array(plate, "S"));
  EXPECT_FALSE(std::filesystem::exists(bench_.path("o/S.mtx")));
}

TEST_F(ExportProblemCommand, WithoutContactThereIsOnlyTheAirySystemAndTheBody) {
  testing::write_text(bench_.path("free.json"), R"({"mesh": {"keep_contact_edges": 0}})");
  const CommandResult result = run("--mesh=Mesh0 --scene=free.json --format=matrix-market --out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("note: no condensed problem: ")) << result.out;
  const Json free = description("o");
  EXPECT_TRUE(has_array(free, "S"));
  for (const char* name : {"C_C", "D", "mu"}) EXPECT_FALSE(has_array(free, name)) << name;
  refused("--mesh=Mesh0 --scene=free.json --format=fclib --out=p", "");
}

TEST_F(ExportProblemCommand, OfAPathTheFirstStepIsWritten) {
  testing::write_text(bench_.path("path.json"), R"({"load_steps": 2})");
  testing::write_text(bench_.path("half.json"), R"({"displacement_mm": [0.01, 0.003]})");
  const CommandResult result =
      run("--mesh=Mesh0 --scene=path.json --format=matrix-market --out=path");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("note: only the first of 2 load steps: ")) << result.out;
  ASSERT_EQ(run("--mesh=Mesh0 --scene=half.json --format=matrix-market --out=half").code, 0);
  for (const char* file : {"S.mtx", "D.mtx", "gap.mtx"})
    EXPECT_EQ(bench_.content(std::string("path/") + file),
              bench_.content(std::string("half/") + file))
        << file;
}

TEST_F(ExportProblemCommand, TheSameProblemIsTheSameBytes) {
  for (const char* format : {"matrix-market", "npz", "fclib"}) {
    const std::string arguments = std::string("--mesh=Mesh0 --format=") + format;
    const CommandResult first = run(arguments + " --out=a/" + format);
    if (first.err.find("this build is without") != std::string::npos) continue;
    ASSERT_EQ(first.code, 0) << first.err;
    ASSERT_EQ(run(arguments + " --out=b/" + format).code, 0);
    for (const auto& entry : std::filesystem::directory_iterator(bench_.path("a") / format)) {
      const std::string name = std::string(format) + "/" + entry.path().filename().string();
      EXPECT_EQ(bench_.content("a/" + name), bench_.content("b/" + name)) << name;
    }
  }
}

TEST(KnownRows, AreAsManyAsTheRowsOfTheSystem) {
  for (const double friction : {0.0, 0.3}) {
    const auto problem = testing::posed({.friction = friction}, testing::catalogue_mesh("Mesh0"));
    const AirySystem system = airy_system(problem);
    EXPECT_EQ(known_rows(*problem, Known::force).size(), static_cast<std::size_t>(system.n_f()));
    EXPECT_EQ(known_rows(*problem, Known::contact_law).size(),
              static_cast<std::size_t>(system.n_c()));
  }
}

}  // namespace
}  // namespace airybench::export_problem_test
