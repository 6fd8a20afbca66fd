// Bodies with curved sides from outside: which methods solve a polygon, and what they say of it.
#include <gtest/gtest.h>

#include <map>

#include "mesh/arcs.hpp"
#include "mesh/msh_format.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::round_bodies_command_test {
namespace {

const std::string idle = "there is no contact boundary";

class RoundBodiesCommand : public ::testing::Test {
 protected:
  RoundBodiesCommand() {
    Mesh mesh = testing::quarter_ring(8, 4, 1, 2);
    recognise_arcs(mesh);
    std::ofstream file(bench_.path("ring.msh"));
    write_msh(file, mesh);
    write_scene("round.json", "");
    write_scene("edged.json", R"("mesh": {"polygon": true}, )");
  }
  // A pressure in its hole.
  void write_scene(const std::string& name, const std::string& more) const {
    std::ofstream(bench_.path(name)) << "{" << more << R"("displacement_mm": [0, 0], "boundary": {
      "displacement:bottom": {"support": "normal"}, "displacement:left": {"support": "normal"},
      "force:hole": {"pressure_MPa": 10}}})";
  }
  std::map<std::string, Json> records(const std::string& arguments) {
    out_ = bench_.run("--mesh=ring.msh --repetitions=1 --out=o " + arguments).out;
    std::map<std::string, Json> by_method;
    for (const Json& r : bench_.records()) by_method[r["method"]] = r;
    return by_method;
  }

  const testing::BenchCommand bench_;
  std::string out_;
};

TEST_F(RoundBodiesCommand, MethodsThatSolveAPolygonSayWhatItCosts) {
  const auto records = this->records("--scene=round.json --method=HYBRID,HYBRID:k=2,3STEPD,P2,P3");
  ASSERT_EQ(records.size(), 5u);
  const auto of = [&](const char* method, const char* field) {
    return records.at(method).at(field).get<double>();
  };
  const std::string groups =
      "force:hole (8 edges, chords off by up to 0.0048 mm), force:rim (8 edges, chords off by up "
      "to 0.0096 mm)";
  for (const auto& [method, r] : records) {
    SCOPED_TRACE(method);
    EXPECT_EQ(r["status"], "ok");
    if (method == "HYBRID:k=2" || method == "P2" || method == "P3") {
      EXPECT_TRUE(r["polygons"].is_null());
      EXPECT_EQ(r["status_reason"], idle);
      continue;
    }
    EXPECT_EQ(r["polygons"], groups);
    const std::string reason = r["status_reason"],
                      start = idle + "; curves that are solved as polygons: " + groups;
    ASSERT_TRUE(reason.starts_with(start)) << reason;
    EXPECT_NE(out_.find(reason), std::string::npos) << out_;
    const double eta = r["error_geometry"], error = r["error_discretisation"];
    EXPECT_GT(eta, 0.005);
    EXPECT_LT(eta, error);
    EXPECT_NE(reason.find("; its total error contains η = "), std::string::npos) << reason;
  }
  EXPECT_LT(of("HYBRID:k=2", "error_geometry"), of("HYBRID", "error_geometry") / 10);
  // P2's error is to stresses that follow the curves.
  EXPECT_NEAR(of("P2", "error_geometry"), of("HYBRID:k=2", "error_geometry"),
              0.01 * of("P2", "error_geometry"));
  EXPECT_LT(of("P2", "error_discretisation"), of("HYBRID", "error_discretisation"));
  EXPECT_LT(of("P3", "error_discretisation"), of("P2", "error_discretisation") / 4);
}

TEST_F(RoundBodiesCommand, ThatAreSaidToBePolygonsAreNoOthers) {
  for (const auto& [method, r] : records("--scene=edged.json --method=HYBRID,P2")) {
    EXPECT_TRUE(r["polygons"].is_null()) << method;
    EXPECT_TRUE(r["error_geometry"].is_null()) << method;
    EXPECT_EQ(r["status_reason"], idle) << method;
  }
}

// Degree 1 takes chords, so that advice compares it with stresses that follow the curves, on their
// own mesh.
TEST_F(RoundBodiesCommand, AreAdvisedOnWithStressesThatFollowTheirCurves) {
  for (const auto& [scene, is_round] : {std::pair("round", true), {"edged", false}}) {
    const std::string folder = std::string(scene) + "/advice";
    bench_.expect_ok("advise --mesh=ring.msh --scene=" + std::string(scene) +
                     ".json --error=0.1% --out=" + folder);
    const std::string csv = bench_.content(folder + "/advice.csv");
    EXPECT_EQ(csv.find("\"HYBRID:k=2\"") != std::string::npos, is_round) << csv;
    EXPECT_EQ(csv.find(",levels=last,by=HYBRID:k=2 --method=") != std::string::npos, is_round);
    EXPECT_NE(csv.find("\"3STEPD\""), std::string::npos);
  }
}

}  // namespace
}  // namespace airybench::round_bodies_command_test
