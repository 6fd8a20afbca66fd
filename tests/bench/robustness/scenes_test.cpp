// Scenes and meshes that ask for too much, or are no files: refused at once, whatever is planned.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>

#include "tests/support/bench_command.hpp"

namespace airybench::hostile_scenes_test {
namespace {

using testing::BenchCommand;
using testing::CommandResult;

// The shell ends what does not end by itself.
constexpr const char* patience = "ulimit -t 20; ";

void expect_refused(const BenchCommand& bench, const std::string& arguments,
                    const std::string& named) {
  bench.expect_refusal(arguments + " --dry-run", named, patience);
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
           {std::string(5000, '[') + std::string(5000, ']'), "nested more than 10 deep"},
           {R"({"friction":")" + std::string(5000, 'x') + "\"}", "friction: \"xxx"},
           {R"({")" + std::string(5000, 'x') + "\":1}", "unknown key (allowed: "},
           {"{\"friction\":\"\xff\"}", "not JSON: "},
           {std::string("{}\0", 3), "not JSON: "},
       }) {
    const std::string name = "s" + std::to_string(number++) + ".json";
    testing::write_text(bench.path(name), text);
    expect_refused(bench, "--mesh=Mesh4 --method=HYBRID --scene=" + name, named);
    EXPECT_TRUE(testing::contains(bench.content("err.txt"), name + ": "));
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
  EXPECT_EQ(bench.run("compare . .", patience).code, 2);
  EXPECT_EQ(bench.run("--mesh=Mesh0 --method=HYBRID --out=. --append", patience).code, 2);
}

// Of a mesh of one triangle, whose edges have these roles in turn.
std::string triangle(const std::array<std::string, 3>& roles) {
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n1 1 \"displacement\"\n"
      "1 2 \"force\"\n1 3 \"contact\"\n2 4 \"body\"\n$EndPhysicalNames\n"
      "$Nodes\n3\n1 0 0 0\n2 3 0 0\n3 0 3 0\n$EndNodes\n$Elements\n4\n";
  const auto tag = [](const std::string& role) {
    return role == "displacement" ? "1" : role == "force" ? "2" : "3";
  };
  for (int k = 0; k < 3; ++k)
    text += std::to_string(k + 1) + " 1 1 " + tag(roles[k]) + " " + std::to_string(k + 1) + " " +
            std::to_string((k + 1) % 3 + 1) + "\n";
  return text + "4 2 1 4 1 2 3\n$EndElements\n";
}

// Nothing is left to be solved for but contact, or nothing at all.
TEST(OneTriangle, IsSolvedWhateverHoldsIt) {
  const std::string d = "displacement", f = "force", c = "contact";
  int number = 0;
  for (const auto& roles :
       {std::array{d, c, c}, {d, c, d}, {d, f, c}, {d, f, d}, {d, d, d}, {d, f, f}}) {
    const BenchCommand bench;
    SCOPED_TRACE(roles[0] + " " + roles[1] + " " + roles[2]);
    const std::string name = "t" + std::to_string(++number);
    testing::write_text(bench.path(name + ".msh"), triangle(roles));
    testing::write_text(bench.path("s.json"), R"({"body_force_N_per_mm3": [1, 2]})");
    const CommandResult result =
        bench.run("--mesh=./" + name +
                  ".msh --scene=s.json --method=HYBRID,P2,3STEPD,BLIND,ALM "
                  "--repetitions=1 --out=o");
    EXPECT_LE(result.code, 1) << result.err;
    ASSERT_EQ(bench.records().size(), 5u);
    // Where no displacement is free, that of every total error is zero: nothing is known.
    const bool nodes_are_free = roles != std::array{d, d, d};
    for (const Json& record : bench.records())
      EXPECT_EQ(record["status"], nodes_are_free             ? "ok"
                                  : record["method"] == "P2" ? "unstressed"
                                                             : "inaccurate")
          << record["method"] << record["status_reason"];
  }
}

// A comma in a path is written with a backslash before it.
TEST(Lists, TakeCommasInPaths) {
  const BenchCommand bench;
  std::filesystem::create_directories(bench.path("a,b"));
  std::filesystem::copy_file(testing::mesh_file("Mesh0"), bench.path("a,b/one,two.msh"));
  testing::write_text(bench.path("a,b/flat,hard.json"), R"({"crown_radius_mm": null})");
  testing::write_text(bench.path("plain.json"), "{}");
  bench.expect_ok(
      "--mesh='a\\,b/one\\,two.msh,Mesh0' --scene='a\\,b/flat\\,hard.json,plain.json' "
      "--method=HYBRID --repetitions=1 --out=o");
  EXPECT_EQ(bench.records().size(), 4u);
  EXPECT_EQ(bench.records()[0]["mesh"], "one,two");
  std::filesystem::rename(bench.path("o"), bench.path("o:1"));
  bench.expect_ok("replay 'o\\:1:one,two/flat,hard/HYBRID' --out=again");
}

}  // namespace
}  // namespace airybench::hostile_scenes_test
