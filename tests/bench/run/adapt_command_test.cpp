// bench --adapt from outside: levels, files, exit codes, one-line complaints.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "mesh/msh_format.hpp"
#include "solvers/base/blas_library.hpp"
#include "solvers/methods.hpp"
#include "support/sha256.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/two_blocks.hpp"

namespace airybench::adapt_command_test {
namespace {

class AdaptCommand : public ::testing::Test {
 protected:
  int bench(const std::string& arguments) const { return bench_.run(arguments).code; }
  std::string complaint() const { return bench_.content("err.txt"); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(bench_.path(name)) << text;
  }
  const testing::BenchCommand bench_;
};

TEST_F(AdaptCommand, LevelsAreCasesWithTheirErrorTimeAndMesh) {
  ASSERT_EQ(bench("--mesh=Mesh0 --method=HYBRID,3STEPD,P2 --adapt=2.5% --repetitions=1 --out=o"), 0)
      << complaint();
  const auto records = bench_.records();
  ASSERT_GE(records.size(), 6u);
  double time_s = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Json& r = records[i];
    const int level = static_cast<int>(i / 3);
    EXPECT_EQ(r["mesh"], "Mesh0+adapt" + std::to_string(level));
    EXPECT_EQ(r["adapt_level"], level);
    EXPECT_EQ(r["discretisation_by"], r["method"] == "P2" ? "P2" : "recovery");
    EXPECT_GE(r["error_total"].get<double>(), r["error_discretisation"].get<double>());
    EXPECT_TRUE(r["adapt_time_s"] > time_s || i % 3 > 0);
    time_s = r["adapt_time_s"];
    EXPECT_GT(r["adapt_estimate_share"].get<double>(), 0);
    EXPECT_GE(r["smallest_angle_deg"].get<double>(),
              0.5 * records[0]["smallest_angle_deg"].get<double>());
    const auto file = bench_.path("o") / r["mesh_file"].get<std::string>();
    EXPECT_EQ(r["mesh_sha256"], sha256_of_file(file));
    EXPECT_EQ(mesh_sizes(read_msh(file)).n_phi, r["n_phi"]);
  }
  const Json& last = records[records.size() - 2];
  ASSERT_EQ(last["method"], "HYBRID");
  EXPECT_LE(last["error_discretisation"].get<double>(), 0.025);

  // A level is a mesh as any other, and its record can be run again.
  const std::string mesh = last["mesh_file"], level = last["mesh"];
  ASSERT_EQ(bench("--mesh='o/" + mesh +
                  "' --scene=o/meshes/default/Mesh0/default.json --method=HYBRID "
                  "--repetitions=1 --out=again"),
            0)
      << complaint();
  EXPECT_EQ(bench_.records("again")[0]["strain_energy_Nmm"], last["strain_energy_Nmm"]);
  EXPECT_EQ(bench("replay 'o:" + level + "/default/HYBRID' --out=replayed"), 0) << complaint();
}

TEST_F(AdaptCommand, DegreesHaveLevelsOfTheirOwnThatCanBeJoined) {
  const std::string adapt = "--mesh=Mesh0 --adapt=1%,levels=last --repetitions=1 ";
  for (const auto& [degree, method, folder] : std::vector<std::array<std::string, 3>>{
           {"1", "HYBRID", "one"}, {"2", "HYBRID:k=2", "two"}, {"auto", "HYBRID:k=2", "same"}}) {
    ASSERT_EQ(bench(adapt + "--degree=" + degree + " --out=" + folder), 0) << complaint();
    const auto records = bench_.records(folder);
    ASSERT_EQ(records.size(), 1u);
    EXPECT_EQ(records[0]["method"], method);
    EXPECT_EQ(records[0]["degree"], degree == "1" ? 1 : 2);
    EXPECT_LE(records[0]["error_total"].get<double>(), 0.01);
  }
  EXPECT_LT(bench_.records("two")[0]["n_phi"], bench_.records("one")[0]["n_phi"]);
  ASSERT_EQ(bench("merge --runs one two --out=both"), 0) << complaint();
  EXPECT_EQ(bench("--mesh=Mesh0 --adapt=0.05% --degree=auto --dry-run --out=o"), 0) << complaint();
  EXPECT_NE(bench_.content("out.txt").find("HYBRID:k=3"), std::string::npos);
  const auto number = [](int degree) { return std::to_string(degree); };
  for (const std::string& wrong :
       {number(0), number(highest_degree + 1), number(22), std::string("two")}) {
    EXPECT_EQ(bench("--mesh=Mesh0 --degree=" + wrong), 2);
    EXPECT_NE(complaint().find("allowed: 1 to " + number(highest_degree) + ", auto"),
              std::string::npos)
        << complaint();
  }
}

// The degree that was asked for is the one that is measured; what misses the goal is named.
TEST_F(AdaptCommand, CasesAreOfTheDegreeAndMeetTheGoalOrAreNamed) {
  const std::string adapt = "--mesh=Mesh0 --adapt=1%,levels=last --degree=2 --repetitions=1 ";
  ASSERT_EQ(bench(adapt + "--method=HYBRID,HYBRID:CHOLMOD --out=o"), 0) << complaint();
  for (const Json& record : bench_.records()) {
    EXPECT_EQ(record["degree"], 2) << record["method"];
    EXPECT_EQ(record["adapt_goal"], 0.01);
    EXPECT_LE(record["error_total"].get<double>(), 0.01);
  }
  ASSERT_EQ(bench(adapt + "--method=HYBRID:k=1,HYBRID --out=p"), 1) << complaint();
  const auto records = bench_.records("p");
  ASSERT_EQ(records.size(), 2u);
  for (const Json& record : records) {
    EXPECT_EQ(record["status"], "ok");
    const std::string name = record["mesh"].get<std::string>() + "/default/" +
                             record["method"].get<std::string>() + ": its total error";
    EXPECT_EQ(bench_.content("out.txt").find(name) != std::string::npos,
              record["degree"] == 1 && record["error_total"] > 0.01)
        << name;
  }
  EXPECT_EQ(bench("--mesh=Mesh0 --adapt=1%,by=HYBRID:k=3 --degree=2"), 2);
  EXPECT_NE(complaint().find("HYBRID:k=3 (allowed: one of both, or by=HYBRID:k=2)"),
            std::string::npos)
      << complaint();
}

// Of a path the loop's error, the record's and that of the exit code are one: the largest of its
// steps', each relative to its own stresses.
TEST_F(AdaptCommand, APathIsAdaptedToTheLargestErrorOfItsSteps) {
  write("s.json", R"({"load_steps": [{"displacement_mm": [0.005, 0]}],
                      "displacement_mm": [0.02, 0.02]})");
  ASSERT_EQ(bench("--mesh=Mesh0 --scene=s.json --method=HYBRID --adapt=3% --repetitions=1 --out=o"),
            0)
      << complaint();
  for (const Json& record : bench_.records()) {
    double largest = 0;
    for (const Json& step : record["steps"])
      largest = std::max(largest, step["error_discretisation"].get<double>());
    EXPECT_EQ(record["error_discretisation"], largest);
    EXPECT_NEAR(record["error_total"].get<double>(), largest, 1e-6);
    EXPECT_NE(complaint().find(fmt::format("total error {:.3g} %", 100 * largest)),
              std::string::npos)
        << largest << "\n"
        << complaint();
  }
  const Json last = bench_.records().back();
  EXPECT_EQ(last["adapt_goal"], 0.03);
  EXPECT_LE(last["error_total"].get<double>(), 0.03);
}

TEST_F(AdaptCommand, AppendingKeepsTheMeshesOfEarlierRecords) {
  const std::string run =
      "--mesh=Mesh0 --scene=s.json --method=HYBRID --repetitions=1 --out=o --adapt=";
  const auto write_scene = [&](const std::string& friction) {
    write("s.json", "{\"friction\": " + friction + "}");
  };
  write_scene("0.3");
  ASSERT_EQ(bench(run + "1000"), 0) << complaint();
  const auto before = bench_.records();
  const std::string scene = bench_.content("o/meshes/s/Mesh0/s.json");
  for (const auto& [friction, other] : std::vector<std::array<std::string, 2>>{
           {"0.3", "900 --append"}, {"0.3", "900 --resume"}, {"0.1", "1000 --append"}}) {
    write_scene(friction);
    EXPECT_EQ(bench(run + other), 2);
    EXPECT_NE(complaint().find(": the records of that folder have another file of this name"),
              std::string::npos)
        << complaint();
    EXPECT_EQ(bench_.records(), before);
    EXPECT_EQ(bench_.content("o/meshes/s/Mesh0/s.json"), scene);
  }
  for (const Json& record : before)
    EXPECT_EQ(sha256_of_file(bench_.path("o") / record["mesh_file"].get<std::string>()),
              record["mesh_sha256"].get<std::string>());
  write_scene("0.3");
  EXPECT_EQ(bench("--mesh=Mesh0 --scene=s.json --method=P2 --repetitions=1 --out=o --adapt=1000 "
                  "--append"),
            0)
      << complaint();
}

TEST_F(AdaptCommand, MergedRunsHaveTheirMeshes) {
  namespace fs = std::filesystem;
  ASSERT_EQ(bench("--mesh=Mesh0 --method=HYBRID --adapt=1000 --repetitions=1 --out=o"), 0)
      << complaint();
  ASSERT_EQ(bench("--mesh=Mesh0 --method=P2 --repetitions=1 --out=p"), 0) << complaint();
  ASSERT_EQ(bench("merge --runs o p --out=deep/whole"), 0) << complaint();
  const auto of_run = bench_.records("o"), of_whole = bench_.records("deep/whole");
  ASSERT_EQ(of_whole.size(), of_run.size() + 1);
  for (std::size_t i = 0; i < of_run.size(); ++i) {
    EXPECT_EQ(of_whole[i]["mesh_file"], of_run[i]["mesh_file"]);
    EXPECT_EQ(
        of_whole[i]["mesh_sha256"],
        sha256_of_file(bench_.path("deep/whole") / of_whole[i]["mesh_file"].get<std::string>()));
  }
  EXPECT_EQ(of_whole.back()["mesh_file"], "Mesh0.msh");

  fs::copy(bench_.path("o"), bench_.path("other"), fs::copy_options::recursive);
  std::ofstream(bench_.path("other") / of_run[0]["mesh_file"].get<std::string>(), std::ios::app)
      << "\n";
  EXPECT_EQ(bench("merge --runs o other --out=no"), 2);
  EXPECT_NE(complaint().find("two meshes that would be one file"), std::string::npos)
      << complaint();
  EXPECT_FALSE(fs::exists(bench_.path("no")));
}

// Each against the reference's stresses of one degree less.
TEST_F(AdaptCommand, DisplacementsOfDegreeThreeAreJudgedByStressesOfDegreeTwo) {
  ASSERT_EQ(bench("--mesh=Mesh0 --method=HYBRID:k=2,P2,P3 --adapt=1%,by=HYBRID:k=2,levels=last "
                  "--repetitions=1 --out=o"),
            1)  // P2 does not meet the goal
      << complaint();
  std::map<std::string, Json> of;
  for (const Json& r : bench_.records()) of[r["method"]] = r;
  ASSERT_EQ(of.size(), 3u);
  const auto error = [&](const char* method) { return of[method]["error_total"].get<double>(); };
  for (const auto& [method, degree, by] :
       {std::tuple("HYBRID:k=2", 2, "recovery"), {"P2", 1, "P2"}, {"P3", 2, "P3"}}) {
    EXPECT_EQ(of[method]["degree"], degree) << method;
    EXPECT_EQ(of[method]["discretisation_by"], by) << method;
    EXPECT_EQ(of[method]["mesh"], of["P3"]["mesh"]);
  }
  EXPECT_LT(error("P3"), 1.01 * error("HYBRID:k=2"));
  EXPECT_GT(error("P3"), 0.5 * error("HYBRID:k=2"));
  EXPECT_GT(error("P2"), 1.5 * error("P3"));
}

TEST_F(AdaptCommand, AMarkingOf1RefinesEverywhereUnderANameOfItsOwn) {
  ASSERT_EQ(bench("--mesh=Mesh0 --method=HYBRID --adapt=2500,marking=1 --repetitions=1 --out=o"), 0)
      << complaint();
  const auto records = bench_.records();
  ASSERT_EQ(records.size(), 2u);
  const auto triangles = [&](const Json& r) {
    return read_msh(bench_.path("o") / r["mesh_file"].get<std::string>()).triangles.size();
  };
  EXPECT_EQ(records[1]["mesh"], "Mesh0+refined1");
  EXPECT_EQ(triangles(records[1]), 4 * triangles(records[0]));
}

TEST_F(AdaptCommand, WhatASceneDoesToItsMeshIsInTheLevelsMesh) {
  write("layered.json", R"({"mesh": {"scale": 2}, "layers": {"count": 2,
        "materials": [{"young_MPa": 1000}, {"young_MPa": 3000, "poisson": 0.4}]}})");
  ASSERT_EQ(bench("--mesh=Mesh0 --scene=layered.json --method=HYBRID --adapt=1000,levels=last "
                  "--repetitions=1 --out=o"),
            0)
      << complaint();
  ASSERT_EQ(bench_.records().size(), 1u);
  const Json record = bench_.records()[0];
  EXPECT_GE(record["n_phi"].get<int>(), 1000);
  EXPECT_NEAR(record["width_mm"].get<double>(), 20, 1e-9);
  const Json definition = Json::parse(bench_.content("o/meshes/layered/Mesh0/layered.json"));
  EXPECT_EQ(definition, record["scene_definition"]);
  EXPECT_FALSE(definition.contains("mesh") || definition.contains("layers"));
  EXPECT_EQ(definition["materials"]["layer 2"]["young_MPa"], 3000);
  EXPECT_EQ(definition["materials"]["layer 1"]["poisson"], 0.3);
}

TEST_F(AdaptCommand, GroupsThatFaceNothingAreForgotten) {
  write("blocks.msh", msh_text(testing::with_contact_beside(testing::two_blocks(4, 5))));
  write("pair.json",
        R"({"contacts": [{"between": ["contact:block", ["contact:base", "contact:side"]]}],
        "boundary": {"displacement:floor": {"displacement_mm": [0, 0]}}, "displacement_mm": [0, -0.01],
        "load_steps": [{"displacement_mm": [0.004, -0.01]}]})");
  ASSERT_EQ(bench("--mesh=blocks.msh --scene=pair.json --method=HYBRID --adapt=400 --repetitions=1 "
                  "--out=o"),
            0)
      << complaint();
  const Json definition = Json::parse(bench_.content("o/meshes/pair/blocks/pair.json"));
  EXPECT_EQ(definition["contacts"][0]["between"],
            Json::parse(R"(["contact:block", ["contact:base"]])"));
}

TEST_F(AdaptCommand, WhatOneAsksOfTheContactHasIntervalsAndTheMeanOfBothStressesHalfOfTheError) {
  write("smooth.json", R"({"friction": 0})");
  ASSERT_EQ(bench("--mesh=Mesh0 --scene=smooth.json --method=HYBRID --adapt=3%,1.5%,levels=last "
                  "--repetitions=1 --fields=mean --out=o"),
            0)
      << complaint();
  const auto records = bench_.records();
  ASSERT_EQ(records.size(), 2u);
  for (const Json& r : records) {
    EXPECT_EQ(r["intervals"], "guaranteed");
    EXPECT_LE(r["normal_resultant_low_N"], r["normal_resultant_N"]);
    EXPECT_GE(r["normal_resultant_high_N"], r["normal_resultant_N"]);
    EXPECT_TRUE(r["tangential_resultant_low_N"].is_null());
    EXPECT_LE(r["largest_pressure_low_MPa"], r["largest_pressure_MPa"]);
    EXPECT_GE(r["largest_pressure_high_MPa"], r["largest_pressure_MPa"]);
    EXPECT_FALSE(r["contact_ends"].empty());
    EXPECT_NEAR(r["error_mean"].get<double>() / r["error_total"].get<double>(), 0.52, 0.03);
  }
  const auto is_of_mean = [](const auto& entry) {
    return entry.path().string().ends_with(".mean.csv");
  };
  EXPECT_EQ(std::ranges::count_if(std::filesystem::directory_iterator(bench_.path("o/fields")),
                                  is_of_mean),
            2);
}

#ifndef AIRYBENCH_SANITIZED  // no limit on the heap there
TEST_F(AdaptCommand, AGoalThatCannotBeReachedIsALineAndExitCode1) {
  // Debian's libblas.so.3 of BLIS hides its own functions: its folder tells.
  if (blas_name().find("BLIS") != std::string::npos ||
      blas_name().find("blis") != std::string::npos)
    GTEST_SKIP() << "BLIS ends the process where it is granted no memory";
  EXPECT_EQ(bench("--mesh=Mesh0 --method=HYBRID --adapt=0.01%,levels=last --memory-limit=3 "
                  "--repetitions=1 --out=o"),
            1);
  EXPECT_NE(complaint().find("note: --adapt=0.01%: not reached for Mesh0/default: HYBRID on "),
            std::string::npos)
      << complaint();
  EXPECT_EQ(bench_.records().size(), 1u);  // what there is is measured
  EXPECT_EQ(bench("--mesh=Mesh0 --method=HYBRID --adapt=0.01%,levels=last --memory-limit=3 "
                  "--repetitions=1 --out=none -- --benchmark_filter=NoSuchCase"),
            1);
  EXPECT_NE(complaint().find("not reached for Mesh0/default"), std::string::npos) << complaint();
  EXPECT_EQ(bench("--mesh=Mesh0 --method=HYBRID --adapt=0.01%,levels=last --memory-limit=3 "
                  "--repetitions=1 --out=none -- --benchmark_filter='('"),
            2);
}
#endif

TEST_F(AdaptCommand, ADryRunPlansTheFirstLevel) {
  ASSERT_EQ(bench("--adapt=1% --dry-run --mesh=Mesh0 --method=HYBRID --out=o"), 0) << complaint();
  EXPECT_EQ(complaint(),
            "note: --adapt: of the first level alone; the others are known when it is solved\n");
  EXPECT_NE(bench_.content("out.txt").find("Mesh0/default/HYBRID"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(bench_.path("o")));
  EXPECT_EQ(bench("--adapt=1%,by=P2 --dry-run --mesh=Mesh0 --method=HYBRID --out=o"), 2);
}

TEST_F(AdaptCommand, RefusesWhatItCannotAdapt) {
  for (const auto& [arguments, said] : std::vector<std::pair<std::string, std::string>>{
           {"--adapt=foo", "--adapt: foo (allowed: a total error"},
           {"--adapt=0%", "--adapt: 0% (allowed"},
           {"--adapt=100%", "--adapt: 100% (allowed"},
           {"--adapt=-5", "--adapt: -5 (allowed"},
           {"--adapt=1%,marking=0", "--adapt: marking: 0 (allowed"},
           {"--adapt=1%,marking=2", "--adapt: marking: 2 (allowed"},
           {"--adapt=1%,foo", "--adapt: foo (allowed: a total error"},
           {"--fields=all", "--fields: all (allowed: mean"},
           {"--adapt=marking=0.5", "--adapt:  (allowed: a total error"},
           {"--adapt=levels=last", "--adapt:  (allowed: a total error"},
           {"--adapt=1%,levels=first", "--adapt: levels=first (allowed: all, last)"},
           {"--adapt=1%,by=P2", "--adapt: by=P2 (allowed: HYBRID"},
           {"--adapt=1%,by=3STEPD", "--adapt: by=3STEPD (allowed: HYBRID"},
           {"--adapt=1%,by=FOO", "--adapt: by=FOO (allowed: HYBRID"}}) {
    EXPECT_EQ(bench(arguments + " --mesh=Mesh0 --method=HYBRID --out=o"), 2) << arguments;
    EXPECT_NE(complaint().find(said), std::string::npos) << complaint();
    EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1) << complaint();
    EXPECT_FALSE(std::filesystem::exists(bench_.path("o"))) << arguments;
  }
}

}  // namespace
}  // namespace airybench::adapt_command_test
