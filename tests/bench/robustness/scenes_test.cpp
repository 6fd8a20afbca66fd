// Scenes and meshes that ask for too much, or are no files: refused at once, whatever is planned.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "tests/support/bench_command.hpp"

namespace airybench::hostile_scenes_test {
namespace {

using testing::BenchCommand;
using testing::CommandResult;

// The shell ends what does not end by itself.
constexpr const char* patience = "ulimit -t 20; ";

void expect_refused(const BenchCommand& bench, const std::string& arguments,
                    const std::string& named) {
  const CommandResult result = bench.run(arguments + " --dry-run", patience);
  EXPECT_EQ(result.code, 2) << arguments;
  EXPECT_NE(result.err.find(named), std::string::npos) << arguments << ": " << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST(HostileScenes, AreRefusedInOneLine) {
  const BenchCommand bench;
  std::string many = "{";
  for (int k = 0; k < 50000; ++k)
    many += (k > 0 ? ",\"m" : "\"m") + std::to_string(k) + "\":{\"young_MPa\":1}";
  many += "}";
  int number = 0;
  for (const auto& [text, named] : {
           std::pair<std::string, std::string>(
               R"({"mesh":{"grade":{"at_mm":[10,0],"ratio":1e15}}})",
               "ratio: 1e+15 (allowed: up to"),
           {R"({"mesh":{"grade":{"at_mm":[10,0],"ratio":1e300}}})",
            "ratio: 1e+300 (allowed: up to"},
           {R"({"mesh":{"refine":6}})", "triangles; allowed: up to 1000000)"},
           {R"({"materials":)" + many + "}", "more than 1000 keys in one object"},
           {std::string(5000, '[') + std::string(5000, ']'), "nested more than 8 deep"},
           {R"({"friction":")" + std::string(5000, 'x') + "\"}", "friction: \"xxx"},
           {R"({")" + std::string(5000, 'x') + "\":1}", "unknown key (allowed: "},
           {"{\"friction\":\"\xff\"}", "not JSON: "},
           {std::string("{}\0", 3), "not JSON: "},
       }) {
    const std::string name = "s" + std::to_string(number++) + ".json";
    testing::write_text(bench.path(name), text);
    expect_refused(bench, "--mesh=Mesh4 --method=HYBRID --scene=" + name, name + ": ");
    expect_refused(bench, "--mesh=Mesh4 --method=HYBRID --scene=" + name, named);
  }
}

TEST(HostileScenes, PipesAndFoldersAreNoFiles) {
  const BenchCommand bench;
  for (const char* pipe : {"pipe.json", "pipe.msh", "records.jsonl"})
    ASSERT_EQ(mkfifo(bench.path(pipe).c_str(), 0666), 0);
  std::filesystem::create_directories(bench.path("folder.json"));
  expect_refused(bench, "--mesh=Mesh0 --scene=pipe.json", "pipe.json: is no regular file");
  expect_refused(bench, "--mesh=Mesh0 --scene=folder.json", "folder.json: a folder, not a file");
  expect_refused(bench, "--mesh=pipe.msh", "pipe.msh: is no regular file");
  EXPECT_EQ(bench.run("claims .", patience).code, 2);
  EXPECT_EQ(bench.run("compare . .", patience).code, 2);
  EXPECT_EQ(bench.run("--mesh=Mesh0 --method=HYBRID --out=. --append", patience).code, 2);
}

// A comma in a path is written with a backslash before it.
TEST(Lists, TakeCommasInPaths) {
  const BenchCommand bench;
  std::filesystem::create_directories(bench.path("a,b"));
  std::filesystem::copy_file(testing::mesh_file("Mesh0"), bench.path("a,b/one,two.msh"));
  testing::write_text(bench.path("a,b/flat,hard.json"), R"({"crown_radius_mm": null})");
  testing::write_text(bench.path("plain.json"), "{}");
  const CommandResult result = bench.run(
      "--mesh='a\\,b/one\\,two.msh,Mesh0' --scene='a\\,b/flat\\,hard.json,plain.json' "
      "--method=HYBRID --repetitions=1 --out=o");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(bench.records().size(), 4u);
  EXPECT_EQ(bench.records()[0]["mesh"], "one,two");
  std::filesystem::rename(bench.path("o"), bench.path("o:1"));
  EXPECT_EQ(bench.run("replay 'o\\:1:one,two/flat,hard/HYBRID' --out=again").code, 0);
}

}  // namespace
}  // namespace airybench::hostile_scenes_test
