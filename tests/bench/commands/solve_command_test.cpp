// `bench solve` from outside: decks as they are, quantities with an error, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/measure/part_answer.hpp"
#include "tests/bench/measure/csv_columns.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/places.hpp"

namespace airybench::solve_command_test {
namespace {

class SolveCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(testing::meshgen_executable()))
      GTEST_SKIP() << "meshgen is not built here";
  }
  // The answer of the only case.
  Json solved(const std::string& arguments, int code = 0) const {
    std::filesystem::remove_all(bench_.path("o"));
    result_ = bench_.run("solve " + arguments + " --out=o");
    EXPECT_EQ(result_.code, code) << result_.err;
    for (const auto& entry : std::filesystem::directory_iterator(bench_.path("o/fields")))
      if (entry.path().string().ends_with(".answer.json"))
        return parse_json(testing::text_of(entry.path()));
    return {};
  }
  static std::string deck(const std::string& name) {
    return testing::test_data("decks/" + name + ".inp").string();
  }
  bool says(const std::string& text) const { return result_.out.find(text) != std::string::npos; }
  const testing::BenchCommand bench_;
  mutable testing::CommandResult result_;
};

// Plane stress of aluminium, 100 MPa on 4 mm.
TEST_F(SolveCommand, APlateUnderTensionHasItsStressAndDisplacement) {
  const Json answer = solved(deck("plate_tension"));
  EXPECT_NEAR(answer["von_mises_MPa"]["value"].get<double>(), 100, 1e-6);
  EXPECT_NEAR(answer["displacement_mm"]["value"].get<double>(),
              100 / 70000. * std::hypot(10, 0.33 * 4), 1e-9);
  EXPECT_EQ(answer["displacement_mm"]["at_mm"].dump(), "[10.0,4.0]");
  ASSERT_EQ(answer["supports"].size(), 2u);
  EXPECT_NEAR(answer["supports"][1]["force_N"][0].get<double>(), -400, 1e-6);
  EXPECT_TRUE(answer["unbounded"].empty());
  EXPECT_TRUE(says("plane stress, forces for a thickness of 1 mm; Eall: E 70000 MPa, ν 0.33"));
  EXPECT_TRUE(says("largest von Mises stress 100 "));
  EXPECT_NE(result_.err.find("thickness 2.5: forces are those of a thickness of 1 mm"),
            std::string::npos);
}

// Of twice the beam's length the deflection at the end is near to P L³/3 E'I + P L/(κ G A).
TEST_F(SolveCommand, ACantileverBendsAsABeam) {
  const Json answer = solved(deck("cantilever") + " --error=0.5%");
  const double E = 210000 / (1 - 0.09), G = 210000 / 2.6, I = 4 * 4 * 4 / 12.;
  const double beam = 10 * 8000 / (3 * E * I) + 10 * 20 / (5 / 6. * G * 4);
  EXPECT_NEAR(answer["displacement_mm"]["value"].get<double>(), beam, 0.03 * beam);
  EXPECT_NEAR(answer["supports"][0]["force_N"][1].get<double>(), 10, 1e-6);
  // Largest away from its clamped corners, where it is that of a beam.
  ASSERT_EQ(answer["unbounded"].size(), 2u);
  EXPECT_EQ(answer["unbounded"][0]["what"], "the end of displacement:Nfix");
  EXPECT_TRUE(
      says("stress unbounded at (0, 0), (0, 4): the end of displacement:Nfix (largest: outside"));
  const Json& bending = answer["principal_MPa"];  // tension above, pressure below
  EXPECT_NEAR(std::abs(bending["value"].get<double>()), 10 * 20 * 2 / I, 0.3 * 75);
  EXPECT_LT(bending["off"].get<double>(), 0.1 * 75);
}

TEST_F(SolveCommand, ADeckWithPairsAndStepsIsAPath) {
  const Json answer = solved(deck("block_on_base") + " --error=3%");
  ASSERT_EQ(answer["faces"].size(), 1u);
  const Json& face = answer["faces"][0];
  EXPECT_EQ(face["name"], "contact:Smaster against contact:Sslave");
  EXPECT_EQ(face["labels"].dump(), R"(["contact:Smaster","contact:Sslave"])");
  EXPECT_LT(face["normal_N"].get<double>(), -400);
  EXPECT_NEAR(face["length_mm"].get<double>(), 6, 1e-9);
  EXPECT_LE(std::abs(face["tangential_N"].get<double>()),
            0.3 * std::abs(face["normal_N"].get<double>()));
  for (const char* line : {"\n1 ", "\n2 ", "dissipation N mm"}) EXPECT_TRUE(says(line)) << line;
}

// Two tubes of one material, 5 µm too large for each other (Lamé); sides of quadratic elements.
TEST_F(SolveCommand, APressFitHasItsPressure) {
  const Json answer = solved(deck("press_fit") + " --error=0.1%");
  const double stiff = 210000 / (1 - 0.09), a = 36, b = 100.025, c = 324;
  const double expected = stiff * 0.005 / (2 * b * 10) * (b - a) * (c - b) / (c - a);
  const Json& face = answer["faces"][0];
  EXPECT_NEAR(-face["normal_N"].get<double>(), expected * face["length_mm"].get<double>(),
              0.003 * 451);
  EXPECT_NEAR(face["pressure_MPa"]["value"].get<double>(), expected, 0.02 * expected);
  EXPECT_NEAR(face["closed_mm"].get<double>(), 10 * std::acos(-1) / 2, 0.01);
}

TEST_F(SolveCommand, AWallStandsByItsWeightWhoseMeshIsInAnotherFile) {
  const Json answer = solved(deck("wall"));
  const double weight = 2.4e-9 * 9810 * 100 * 200;
  EXPECT_NEAR(answer["supports"][0]["force_N"][1].get<double>(), weight, 1e-8 * weight);
  EXPECT_NEAR(answer["displacement_mm"]["value"].get<double>(), 1.5e-5, 0.02e-5);  // CalculiX 2.20
}

TEST_F(SolveCommand, ThreeStripsPassOnTheForce) {
  const Json answer = solved(deck("stack"));
  ASSERT_EQ(answer["faces"].size(), 2u);
  for (const Json& face : answer["faces"])
    EXPECT_NEAR(face["force_N"][1].get<double>(),
                -answer["supports"][1]["force_N"][1].get<double>(), 1e-6);
}

// 313.58 MPa is what refining to 0.002 % gives.
TEST_F(SolveCommand, APlateWithAHoleHasItsStressThere) {
  const Json answer = solved(deck("plate_hole") + " --error=0.05%");
  const double largest = answer["von_mises_MPa"]["value"];
  const double off = answer["von_mises_MPa"]["off"];
  EXPECT_LT(off, 10);
  EXPECT_NEAR(largest, 313.58, off);
  EXPECT_NEAR(answer["von_mises_MPa"]["at_mm"][1].get<double>(), 1, 0.01);
}

// Parts of docs/bodies against what is known of them.
struct Known {
  const char *part, *quantity;
  double value, within;
};
class SolvedPart : public SolveCommand, public ::testing::WithParamInterface<const char*> {};

// Lamé's pressure of a ring of aluminium, 10 µm too small for a shaft of steel, in plane strain.
double press_fit_MPa() {
  const auto plane = [](double E, double nu) {
    return std::pair(E / (1 - nu * nu), nu / (1 - nu));
  };
  const auto [E_shaft, nu_shaft] = plane(210000, 0.3);
  const auto [E_ring, nu_ring] = plane(70000, 0.33);
  const double r = 10, R = 20, ring = (R * R + r * r) / (R * R - r * r) + nu_ring;
  return 0.01 / r / (ring / E_ring + (1 - nu_shaft) / E_shaft);
}
// By von Mises, per pressure: of the shaft, σ_zz = −2νp; of the ring at its bore, σ_θθ = 5/3 p.
constexpr double shaft_stress = 1 - 2 * 0.3;
double ring_stress() { return von_mises({-1, 5. / 3, 0}, 0.33 * (5. / 3 - 1)); }
// Hertz' pressure of a roller of 10 mm on a plate, both of steel, and half the width of contact.
constexpr double roller_N = 10 * 2 * std::numbers::pi * 3, stiff_MPa = 210000 / (1 - 0.09) / 2;
double roller_MPa() { return std::sqrt(roller_N * stiff_MPa / (std::numbers::pi * 10)); }
double roller_mm() { return 2 * roller_N / (std::numbers::pi * roller_MPa()); }
constexpr double block_N = 40 * 20 * 7.7e-5, slope = std::numbers::pi / 12;

// Normal to a crack at 20° to a compression of 100 MPa, in a plate without end.
double crack_MPa() { return 100 * std::pow(std::sin(std::numbers::pi / 9), 2); }

const std::vector<Known>& known() {
  static const std::vector<Known> list = {
      {"press_fit", "/faces/0/pressure_MPa/value", press_fit_MPa(), 0.01},
      {"press_fit", "/faces/0/slipping_mm", 0, 1e-9},
      {"press_fit", "/bodies/0/von_mises_MPa/value", shaft_stress * press_fit_MPa(), 0.01},
      {"press_fit", "/bodies/1/von_mises_MPa/value", ring_stress() * press_fit_MPa(), 0.01},
      {"roller_on_plate", "/faces/0/pressure_MPa/value", roller_MPa(), 0.02},
      {"roller_on_plate", "/faces/0/closed_mm", 2 * roller_mm(), 0.01},
      {"roller_on_plate", "/supports/0/force_N/1", roller_N, 1e-6},
      {"slope", "/faces/0/normal_N", -block_N * std::cos(slope), 1e-6},
      {"slope", "/faces/0/force_N/0", 0, 1e-6},
      {"slope", "/faces/0/force_N/1", block_N, 1e-6},
      {"crack", "/faces/0/pressure_MPa/value", crack_MPa(), 0.002},
      {"crack", "/faces/0/slipping_mm", 2000, 1e-6},
      {"bracket", "/supports/0/force_N/1", 15, 1e-6},
      {"bracket", "/supports/1/force_N/0", 0, 1e-6},
  };
  return list;
}

TEST_P(SolvedPart, HasWhatIsKnownOfIt) {
  const std::string file = (testing::source_folder() / "docs/bodies" / GetParam()).string();
  const Json answer = solved(fmt::format("{0}.geo {0}.json", file));
  for (const Known& one : known()) {
    if (one.part != std::string(GetParam())) continue;
    EXPECT_NEAR(answer.at(Json::json_pointer(one.quantity)).get<double>(), one.value,
                one.within * std::max(1., std::abs(one.value)))
        << one.quantity;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, SolvedPart,
                         ::testing::Values("press_fit", "roller_on_plate", "slope", "bracket",
                                           "crack"),
                         [](const auto& part) { return std::string(part.param); });

// Each round of finer meshes says how well the pressure is known.
TEST_F(SolveCommand, APressureIsKnownToTheGoalAfterSomeRounds) {
  const std::string file = (testing::source_folder() / "docs/bodies/press_fit").string();
  solved(fmt::format("{0}.geo {0}.json --error=0.2%:pressure", file));
  const std::string last = parse_json(bench_.content("o/part.json"))["case"];
  const Json answer = parse_json(bench_.content("o/fields/" + last + ".answer.json"));
  EXPECT_NE(result_.err.find("the largest pressure is known to "), std::string::npos);
  const Json& pressure = answer["faces"][0]["pressure_MPa"];
  EXPECT_NEAR(pressure["value"].get<double>() / press_fit_MPa(), 1, 0.002);
  EXPECT_LE(pressure["in"][1].get<double>() - pressure["in"][0].get<double>(),
            0.004 * pressure["value"].get<double>());
}

// Its slip, 4 (1 − ν²)/E σ sin ψ (cos ψ − μ sin ψ) b in the middle.
TEST_F(SolveCommand, ACrackSlipsByTheClosedForm) {
  const std::string file = (testing::source_folder() / "docs/bodies/crack").string();
  solved(fmt::format("{0}.geo {0}.json --error=0.2%", file));
  double slip_mm = 0;
  for (const auto& found : std::filesystem::directory_iterator(bench_.path("o/fields")))
    if (found.path().string().ends_with(".contact.csv")) {
      const testing::Columns points = testing::csv_columns(testing::text_of(found.path()));
      for (const double slip : testing::numbers(points, "slip_mm"))
        slip_mm = std::max(slip_mm, std::abs(slip));
    }
  const double psi = std::numbers::pi / 9, mu = 0.57735;
  const double known = 4 * (1 - 0.25 * 0.25) / 25000 * 100 * std::sin(psi) *
                       (std::cos(psi) - mu * std::sin(psi)) * 1000;
  EXPECT_NEAR(slip_mm, known, 0.005 * known);
}

// The corners of its foot are singular; its largest stress is at the hole, from every first mesh.
TEST_F(SolveCommand, TheLargestStressOfALugDoesNotDependOnTheFirstMesh) {
  const std::string lug = (testing::source_folder() / "docs/bodies/lug").string();
  for (const char* first : {"3", "9"}) {
    const Json answer = solved(fmt::format("{0}.geo {0}.json --parameter=h={1}", lug, first));
    const Json& stress = answer["von_mises_MPa"];
    EXPECT_NEAR(stress["value"].get<double>(), 87.04, stress["off"].get<double>()) << first;
    EXPECT_LT(stress["off"].get<double>(), 0.02 * 87) << first;
    EXPECT_EQ(answer["unbounded"].size(), 2u) << first;
  }
}

// A lug's pin slips; the faces of a crack do so at once, whatever the steps.
TEST_F(SolveCommand, WhatThePathOfTheLoadChangesIsSolvedOrSaid) {
  const auto body = [](const char* name) {
    const std::string path = (testing::source_folder() / "docs/bodies" / name).string();
    return fmt::format("{0}.geo {0}.json", path);
  };
  const double of_path = solved(body("lug") + " --error=3%")["faces"][0]["normal_N"];
  EXPECT_EQ(bench_.record()["load_steps"], 8);
  EXPECT_TRUE(says("\n8 "));
  const double of_one = solved(body("lug") + " --error=3% --steps=1")["faces"][0]["normal_N"];
  EXPECT_EQ(bench_.record()["load_steps"], 1);
  EXPECT_TRUE(says("in eight load steps the stresses are 5."));
  EXPECT_TRUE(says("not included: the path of the load, "));
  EXPECT_NEAR(bench_.record()["in_eight_steps"][0]["normal_resultant_N"].get<double>(), of_path, 2);
  EXPECT_GT(of_one - of_path, 5);
  solved(body("crack"));
  EXPECT_TRUE(says("in eight load steps the stresses are the same to 0.1 %"));
  EXPECT_TRUE(says("not included: large strains"));
}

// The same plate pulled at both ends: what holds it carries nothing.
TEST_F(SolveCommand, SingleNodesTakeOutARigidMotion) {
  const std::string supports = "Nleft, 1, 1\nNbottom, 2\n", pull = "10, P2, -100.\n",
                    both_ends = pull + "1, P4, -100.\n6, P4, -100.\n";
  const auto write = [&](const std::string& held, const std::string& loads) {
    std::string text = testing::text_of(deck("plate_tension"));
    text.replace(text.find(supports), supports.size(), held);
    text.replace(text.find(pull), pull.size(), loads);
    testing::write_text(bench_.path("free.inp"), text);
  };
  for (const auto& [held, points] : std::vector<std::array<std::string, 2>>{
           {"1, 1, 2\n6, 2\n", R"([{"at_mm":[0.0,0.0],"displacement_mm":[0.0,0.0]},)"
                               R"({"at_mm":[10.0,0.0],"displacement_mm":[null,0.0]}])"},
           {"Nbottom, 2\n13, 1\n", R"([{"at_mm":[0.0,4.0],"displacement_mm":[0.0,null]}])"}}) {
    write(held, both_ends);
    const Json answer = solved("free.inp");
    EXPECT_NEAR(answer["von_mises_MPa"]["value"].get<double>(), 100, 1e-6) << held;
    EXPECT_NEAR(answer["displacement_mm"]["value"].get<double>(),
                100 / 70000. * std::hypot(10, 0.33 * 4), 1e-9)
        << held;
    EXPECT_EQ(answer["displacement_mm"]["at_mm"].dump(), "[10.0,4.0]") << held;
    EXPECT_EQ(answer["point_supports"].dump(), points);
    for (const Json& support : answer["supports"])
      EXPECT_NEAR(support["force_N"][1].get<double>(), 0, 1e-6) << held;
    EXPECT_NE(result_.err.find("is held alone: it takes out a rigid motion, and no force"),
              std::string::npos);
  }
  EXPECT_EQ(bench_.run("new-scene free.inp").code, 0);
  EXPECT_EQ(parse_json(bench_.content("free.json"))["point_supports"].dump(),
            R"([{"at_mm":[0.0,4.0],"displacement_mm":[0.0,null],"body":"Eall"}])");
  solved("free.inp free.json");
  EXPECT_TRUE(says("largest von Mises stress 100 ")) << result_.err;
  struct Refused {
    std::string held, loads;
    int code;
    std::string why;
  };
  for (const auto& [held, loads, code, why] : std::vector<Refused>{
           {"1, 1, 2\n6, 2\n", pull, 1,
            "loads do not balance: point supports would carry -400 N in x at (0, 0)"},
           {"1, 1, 2\n", both_ends, 2,
            "free.inp: point_supports: the body Eall is free to move or turn"},
           {"1, 1, 2\n6, 1, 2\n", both_ends, 2,
            "free.inp: point_supports: [10, 0] holds x, which displacement edges or other points "
            "hold: it would carry a force"},
           {supports + "15, 2\n", pull, 2, "free.inp: point_supports: [4, 4] holds y"},
       }) {
    write(held, loads);
    const testing::CommandResult refused = bench_.run("solve free.inp --out=o");
    EXPECT_EQ(refused.code, code) << held;
    EXPECT_NE((refused.out + refused.err).find(why), std::string::npos)
        << refused.out << refused.err;
  }
}

TEST_F(SolveCommand, DecksOfOtherProblemsAreRefused) {
  for (const auto& [name, why] :
       {std::pair("axisymmetric", "elements of type CAX4: an axisymmetric"),
        {"plastic", "*PLASTIC: the material yields"},
        {"large", "*STEP, NLGEOM"}})
    bench_.expect_refusal("solve " + deck(name) + " --out=o", why);
  EXPECT_FALSE(std::filesystem::exists(bench_.path("o")));
}

TEST_F(SolveCommand, InstancesPressOnEachOther) {
  const Json answer = solved(deck("two_instances") + " --error=1%:force");
  const double force = answer["faces"][0]["normal_N"];
  EXPECT_NEAR(force, -270.3, 1);
  const Json r = bench_.records().front();
  EXPECT_LE(r["normal_resultant_high_N"].get<double>() - r["normal_resultant_low_N"].get<double>(),
            0.02 * std::abs(force));
}

TEST_F(SolveCommand, ItsPictureAndPageAreMadeOfWhatIsPrinted) {
  const testing::CommandResult ran = bench_.run(
      "solve " + deck("plate_tension") + " --html --out=o", "export AIRYBENCH_TO_DRAW=drawn; ");
  EXPECT_EQ(bench_.content("drawn"), std::string("--html\0--\0o\0", 12)) << ran.out << ran.err;
  EXPECT_EQ(ran.out.find("a picture: "), std::string::npos) << ran.out;
  const Json part = parse_json(bench_.content("o/part.json"));
  EXPECT_EQ(part["name"], "plate_tension");
  EXPECT_NE(part["notes"][0].get<std::string>().find("not used: *"), std::string::npos);
  for (const Json& line : part["report"])
    EXPECT_TRUE(line.is_array() || ran.out.find(line.get<std::string>()) != std::string::npos)
        << line;
  const std::string fields = "o/fields/" + part["case"].get<std::string>();
  EXPECT_TRUE(bench_.content(fields + ".von_mises.csv").starts_with("third,x_mm,"));
  EXPECT_TRUE(bench_.content(fields + ".outline.csv").starts_with("edge,piece,x_mm,"));
}

// Where the roller's contact ends within its face stresses are finite; at (0, 0) Hertz' pressure is
// within what is said.
TEST_F(SolveCommand, TheLargestStressUnderARollerIsHertz) {
  const std::string model = testing::test_data("models/roller_on_plate.geo").string();
  testing::write_text(bench_.path("roller.json"),
                      R"({"materials": {"roller": {"young_MPa": 210000, "poisson": 0.3},
                                        "plate": {"young_MPa": 210000, "poisson": 0.3}},
                          "displacement_mm": [0, 0],
                          "boundary": {"force:axle": {"traction_MPa": [0, -10]}},
                          "contacts": [{"between": ["contact:plate", "contact:roller"],
                                        "friction": 0}]})");
  constexpr double load_N = 10 * 2 * std::numbers::pi * 8;
  constexpr double of_size = 1e-3;  // Hertz' bodies are infinite
  const double p0 = std::sqrt(load_N * stiff_MPa / (std::numbers::pi * 25));
  for (const char* error : {"1%", "0.5%"}) {
    const Json answer = solved(model + " roller.json --error=" + error);
    for (const char* key : {"von_mises_MPa", "principal_MPa"})
      EXPECT_TRUE(answer[key].contains("off")) << error << answer[key];
    for (const Json& place : answer["unbounded"])
      EXPECT_GT(std::hypot(place["at_mm"][0].get<double>(), place["at_mm"][1].get<double>()), 2);
    const Json& principal = answer["principal_MPa"];
    EXPECT_NEAR(principal["value"].get<double>(), -p0,
                principal["off"].get<double>() + of_size * p0)
        << error;
  }
}

// A block on a flat wall without friction: nothing says where it slides to.
TEST_F(SolveCommand, ADisplacementThatNothingDeterminesIsNotPrinted) {
  testing::write_text(bench_.path("block.geo"), R"(
      Point(1) = {0, 0, 0, 1}; Point(2) = {4, 0, 0, 1}; Point(3) = {4, 2, 0, 1};
      Point(4) = {0, 2, 0, 1};
      Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
      Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
      Physical Curve("contact") = {1}; Physical Curve("force:top") = {3};
      Physical Curve("force") = {2, 4}; Physical Surface("block") = {1};)");
  bench_.expect_refusal("solve block.geo --out=o", "block.geo: a SCENE is needed (");
  testing::write_text(bench_.path("block.json"), R"({"crown_radius_mm": null, "friction": 0,
                                     "boundary": {"force:top": {"pressure_MPa": 5}}})");
  const Json answer = solved("block.geo block.json");
  EXPECT_NEAR(answer["faces"][0]["normal_N"].get<double>(), -20, 1e-6);
  EXPECT_FALSE(answer.contains("displacement_mm"));
  EXPECT_TRUE(says("largest displacement: not determined, ")) << result_.out;
}

// CPE4P has pores, CPS44 is a slip of the pen.
TEST_F(SolveCommand, TypesOfElementsAreKnownOrRefused) {
  const std::string text = testing::text_of(deck("plate_tension"));
  for (const char* type : {"CPE4P", "CPS44", "CPS4RT"}) {
    std::string changed = text;
    const std::size_t at = changed.find("CPS");
    changed.replace(at, changed.find_first_of(",\r\n", at) - at, type);
    testing::write_text(bench_.path("other.inp"), changed);
    const testing::CommandResult refused = bench_.run("solve other.inp --out=o");
    EXPECT_EQ(refused.code, 2) << type;
    EXPECT_NE(refused.err.find(fmt::format("elements of type {} (allowed: ", type)),
              std::string::npos)
        << refused.err;
  }
}

TEST_F(SolveCommand, WhatCannotBeSolvedIsSaid) {
  bench_.expect_refusal("solve " + deck("plate_tension") + " --error=1%:weight --out=o",
                        "--error: 1%:weight (allowed: above 0% and below 100%, as 1%, 1%:force, "
                        "1%:pressure)\n");
  const testing::CommandResult twice =
      bench_.run("solve " + deck("block_on_base") + " --steps=3 --out=o");
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("block_on_base.inp: load_steps and --steps (allowed: one of them)\n"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(bench_.path("o")));
  solved(deck("plate_tension") + " --error=1%:force", 1);
  EXPECT_TRUE(says("this quantity has no interval"));
}

}  // namespace
}  // namespace airybench::solve_command_test
