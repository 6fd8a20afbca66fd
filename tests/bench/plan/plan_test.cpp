// What bench says of a run without measuring.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "bench/plan/plan.hpp"
#include "solvers/methods.hpp"
#include "support/errors.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::plan_test {
namespace {

namespace fs = std::filesystem;
using testing::BenchCommand;
using testing::CommandResult;
using testing::lines_of;
using testing::write_text;

TEST(Plan, ListsPlansAndExplainsWithoutMeasuring) {
  const BenchCommand bench;
  EXPECT_TRUE(testing::contains(bench.run("list").out, "*3STEPD "));
  const CommandResult plan = bench.run("--mesh=Mesh0..Mesh7 --method='*' --dry-run");
  EXPECT_EQ(plan.code, 0);
  int rows = 0;
  for (const std::string& line : lines_of(plan.out))
    rows += line.starts_with("Mesh") && line.find("/default/") != line.npos &&
            line[line.find(' ') - 1] != ':';  // which would be a limit that is passed
  EXPECT_EQ(rows, static_cast<int>(8 * select_methods("*").size()));
  EXPECT_TRUE(testing::contains(plan.out, "\nthe run: "));
  write_text(bench.path("smooth.json"), R"({"friction": 0})");
  for (const auto& [arguments, said] :
       {std::pair("--mesh=Mesh7 --method=3STEPD --memory-limit=500 --dry-run",
                  "Mesh7/default/3STEPD: above --memory-limit=500"),
        {"--mesh=Mesh7 --method=3STEPD --timeout=1 --dry-run",
         "Mesh7/default/3STEPD: above --timeout=1"},
        {"explain --mesh=Mesh7", "] Mesh7/default/3STEPD  n_phi 50483, n_f 920, n_c 640\n"},
        {"explain --mesh=Mesh0 --scene=smooth.json", "n_f 116, n_c 20\n"},  // as records say it
        {"explain --mesh=Mesh0", "left out  assemble F: no traction"}})
    EXPECT_TRUE(testing::contains(bench.run(arguments).out, said)) << arguments;
  EXPECT_EQ(bench.run("--help").code, 0);
  EXPECT_EQ(bench.run("--version").code, 0);
  EXPECT_FALSE(fs::exists(bench.path("results")));
}

// "Mesh0/default/3STEPD" of every line "[1/8] Mesh0/default/3STEPD  n_phi …".
std::vector<std::string> planned(const std::string& text) {
  std::vector<std::string> cases;
  for (const std::string& line : lines_of(text)) {
    if (!line.starts_with('[')) continue;
    const std::size_t begin = line.find("] ") + 2;
    cases.push_back(line.substr(begin, line.find("  n_phi") - begin));
  }
  return cases;
}

TEST(Plan, AFigureIsExactlyItsMeshesAndMethods) {
  const BenchCommand bench;
  std::vector<std::string> fourth, third;
  for (const char* mesh : {"Mesh0", "Mesh1", "Mesh2", "Mesh3", "Mesh4", "Mesh5", "Mesh6", "Mesh7"})
    for (const char* method :
         {"SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6", "SSKY", "3STEPD", "ALM", "BLIND"})
      fourth.push_back(std::string(mesh) + "/default/" + method);
  EXPECT_EQ(planned(bench.run("explain --figure=4").out), fourth);
  EXPECT_EQ(planned(bench.run("explain --figure=5").out), fourth);
  third = planned(bench.run("explain --figure=3").out);
  EXPECT_EQ(third.size(), 36u);
  EXPECT_EQ(std::set<std::string>(third.begin(), third.end()).size(), 36u);
  for (const std::string& name : third)
    EXPECT_TRUE(name.starts_with("Mesh3/default/SYMMLQ:") ||
                name.starts_with("Mesh3/default/3STEPCG:"))
        << name;
}

TEST(PosingInTime, EndsWhereItTakesMoreThanAPhaseMay) {
  const Mesh mesh = testing::small_tooth(100, 100);
  Limits limits;
  limits.others_s = 100;
  EXPECT_EQ(pose_in_time(Scene(), "s", mesh, limits)->mesh.triangles, mesh.triangles);
  limits.others_s = 1e-9;
  EXPECT_EXIT(pose_in_time(Scene(), "\u202Es", mesh, limits),
              ::testing::ExitedWithCode(wrong_usage),
              "/\\\\u202es: posing it took more than 1e-09 s .more with --timeout=.*,others=");
}

}  // namespace
}  // namespace airybench::plan_test
