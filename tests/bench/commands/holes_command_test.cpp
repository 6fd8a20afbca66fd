// Bodies with holes from outside: what is run, what is skipped and how that is said.
#include <gtest/gtest.h>

#include "mesh/msh_format.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::holes_command_test {
namespace {

const std::string why =
    "a body with 1 hole needs a multi-valued Airy function (methods without one: HYBRID, "
    "HYBRID:CHOLMOD, HYBRID:MUMPS, HYBRID:PDAS, HYBRID:CG, P2, P3, P4)";

class HolesCommand : public ::testing::Test {
 protected:
  HolesCommand() {
    write("plate", testing::small_plate(2));
    Mesh ring = testing::small_ring(16, 4, 2, 6);
    for (BoundaryEdge& edge : ring.boundary)
      if (edge.role == BoundaryRole::force) edge.role = BoundaryRole::contact;
    write("pin", ring);
    std::ofstream(bench_.path("flat.json")) << R"({"crown_radius_mm": null, "friction": 0.3})";
  }
  int bench(const std::string& arguments) const { return bench_.run(arguments).code; }
  std::string complaint() const { return bench_.content("err.txt"); }
  const testing::BenchCommand bench_;

 private:
  void write(const std::string& name, const Mesh& mesh) const {
    std::ofstream file(bench_.path(name + ".msh"));
    write_msh(file, mesh);
  }
};

TEST_F(HolesCommand, AiryMethodsAreSkippedWithTheirReasonEverywhere) {
  const testing::CommandResult result = bench_.run(
      "--mesh=plate.msh --scene=flat.json --method=3STEPD,SSKY,ALM,BLIND:SCHUR:REFINED,HYBRID,P2 "
      "--repetitions=1 --out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto records = bench_.records();
  ASSERT_EQ(records.size(), 6u);
  for (const Json& r : records) {
    const std::string method = r["method"];
    SCOPED_TRACE(method);
    const bool runs = method == "HYBRID" || method == "P2";
    EXPECT_EQ(r["status"], runs ? "ok" : "skipped");
    EXPECT_EQ(r["time_s"].is_null(), !runs);
    EXPECT_EQ(r["error_stress"].is_null(), method != "HYBRID");
    if (runs) continue;
    EXPECT_EQ(r["status_reason"], why);
    EXPECT_EQ(r["stages_left_out"], (Json{{"all stages", why}}));
    EXPECT_NE(result.out.find("plate/flat/" + method + ": skipped: " + why), std::string::npos)
        << result.out;
  }
  EXPECT_NE(bench_.content("o/results.csv").find(",skipped,\"" + why + "\""), std::string::npos);
}

TEST_F(HolesCommand, SkippedCasesTakeNoTimeInAPlan) {
  const testing::CommandResult result =
      bench_.run("explain --mesh=plate.msh --method=3STEPD,ALM --dry-run");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("left out  all stages: " + why), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("the run: about 0 µs"), std::string::npos) << result.out;
}

TEST_F(HolesCommand, ByDefaultThereAreMethodsThatTakeThem) {
  ASSERT_EQ(bench("--mesh=plate.msh --scene=flat.json --repetitions=1 --out=o"), 0) << complaint();
  std::vector<std::string> ok;
  for (const Json& r : bench_.records())
    if (r["status"] == "ok") ok.push_back(r["method"]);
  EXPECT_EQ(ok, (std::vector<std::string>{"HYBRID", "P2"}));
}

TEST_F(HolesCommand, StudiesGoAroundThem) {
  for (const char* study : {"error", "contact", "stability"}) {
    SCOPED_TRACE(study);
    bench(std::string("--mesh=plate.msh --scene=flat.json --method=3STEPCG6,HYBRID "
                      "--repetitions=1 --out=o --study=") +
          study);
    bool some_ok = false;
    for (const Json& r : bench_.records()) {
      const bool is_hybrid = r["method"] == "HYBRID";
      EXPECT_EQ(r["status"] == "skipped", !is_hybrid);
      EXPECT_EQ(r["status_reason"] == why, !is_hybrid);
      some_ok |= r["status"] == "ok";
    }
    EXPECT_TRUE(some_ok) << complaint();
  }
}

TEST_F(HolesCommand, AnAdaptedMeshReachesItsGoalAndKeepsItsHole) {
  for (const auto& [mesh, goal] : {std::pair("plate", 0.05), {"pin", 0.1}}) {
    ASSERT_EQ(
        bench(std::string("--mesh=") + mesh + ".msh --scene=flat.json --method=HYBRID " +
              "--repetitions=1 --out=o --adapt=levels=last," + std::to_string(100 * goal) + "%"),
        0)
        << complaint();
    const Json r = bench_.records().front();
    EXPECT_EQ(r["method"], "HYBRID");
    EXPECT_EQ(r["status"], "ok");
    EXPECT_LE(r["error_discretisation"].get<double>(), goal);
    EXPECT_EQ(hole_count(read_msh(bench_.path("o") / r["mesh_file"].get<std::string>())), 1);
  }
}

TEST_F(HolesCommand, AdviceIsGivenWithoutTheSkipped) {
  ASSERT_EQ(bench("advise --mesh=plate.msh --scene=flat.json --error=8% --method=HYBRID,3STEPD "
                  "--out=o"),
            0)
      << complaint();
  const std::string advice = bench_.content("o/advice.csv");
  EXPECT_NE(advice.find(",\"" + why + "\",skipped,"), std::string::npos) << advice;
  EXPECT_NE(advice.find(",measured,ok,"), std::string::npos) << advice;
}

TEST_F(HolesCommand, ACrownNeedsAFaceWithEnds) {
  std::ofstream(bench_.path("crowned.json")) << R"({"crown_radius_mm": 300})";
  bench_.expect_refusal("--mesh=pin.msh --scene=crowned.json --out=o",
                        "crowned.json: crown_radius_mm: 300 on the mesh pin, where a contact face "
                        "is closed and has no middle (allowed: null, for no crown)\n");
  EXPECT_FALSE(std::filesystem::exists(bench_.path("o")));
}

TEST_F(HolesCommand, AHoleWalkedTheWrongWayIsTurnedByMeshgen) {
  Mesh mesh = testing::small_plate(1);
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.group != BoundaryEdge::no_group) std::swap(edge.vertices[0], edge.vertices[1]);
  std::ofstream file(bench_.path("wrong.msh"));
  write_msh(file, mesh);
  file.close();
  if (std::filesystem::exists(testing::meshgen_executable()))
    EXPECT_EQ(bench("--mesh=wrong.msh --method=HYBRID --dry-run --out=o"), 0) << complaint();
  else
    bench_.expect_refusal("--mesh=wrong.msh --out=o",
                          ": walked clockwise; the body must lie on its left");
}

}  // namespace
}  // namespace airybench::holes_command_test
