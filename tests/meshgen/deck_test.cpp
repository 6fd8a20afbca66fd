// Input decks of Abaqus and CalculiX: other ways to write a body, what they prescribe as a scene,
// and what is refused because the problem would be another.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "mesh/msh_format.hpp"
#include "meshgen/convert.hpp"
#include "meshgen/deck_scene.hpp"
#include "meshgen/gmsh_input.hpp"
#include "support/errors.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::deck_test {
namespace {

using Texts = std::vector<std::string>;

class Decks : public ::testing::Test {
 protected:
  // The plate with its only text `old` replaced, each in turn.
  std::filesystem::path plate(const std::vector<std::array<std::string, 2>>& changes) const {
    std::string text = testing::text_of(testing::test_data("models/plate.inp"));
    for (const auto& [old, by] : changes) {
      const std::size_t at = text.find(old);
      if (at == text.npos) throw std::logic_error(old);
      text.replace(at, old.size(), by);
    }
    return testing::write_text(folder_ / "plate.inp", text);
  }
  static std::string converted(const std::filesystem::path& file) {
    Mesh mesh =
        convert_model(file, model_options_of({"Ssole=contact:sole", "Nhead=displacement"}, {}, ""))
            .mesh;
    mesh.name = mesh.body_names[0] = "plate";
    return msh_text(mesh);
  }
  const testing::TemporaryFolder folder_;
};

TEST_F(Decks, WaysToWriteTheSame) {
  const std::string expected = converted(plate({}));
  using Changes = std::vector<std::array<std::string, 2>>;
  for (const Changes& changes : std::vector<Changes>{
           {{"ELSET=Eall, MATERIAL", "ELSET=EALL, MATERIAL"}, {"\nEsole, S1", "\nESOLE, s1"}},
           {{"*NSET, NSET=Nhead\n4, 5, 6", "*NSET, NSET=Nhead\n4, 5\n*NSET, NSET=NHEAD\n6"}},
           {{"TYPE=ELEMENT\nEsole, S1", "TYPE=NODE\n1, 1.\n2\n3"}},
           {{"TYPE=CPE4", "TYPE=S4"}, {"Esole, S1", "Esole, S3"}},
           {{"TYPE=CPE4", "TYPE=S4"}, {"Esole, S1", "Esole, E1"}},
           {{"*NODE, ", "*NODE, SYSTEM=R, "}},
           {{"*HEADING", "*INSTANCE, NAME=plate-1, PART=plate\n0., 0., 0.\n*HEADING"}},
       })
    EXPECT_EQ(converted(plate(changes)), expected) << changes[0][1];
}

TEST_F(Decks, WhatWouldBeAnotherBodyIsRefused) {
  for (const auto& [old, by, why] : std::vector<std::array<std::string, 3>>{
           {"** nodes", "*INSTANCE, NAME=a, PART=p\n0., 0.\n1., 1., 0., 1., 1., 0., 90.",
            "line 5: an axis of no length (allowed: two points and an angle)"},
           {"** nodes", "*SYSTEM\n1., 0., 0.", "line 3: coordinates of a system of their own "},
           {"*NODE, ", "*NODE, SYSTEM=c, ", "line 4: coordinates of a system of their own "},
           {"*MATERIAL", "*ELGEN\n1, 2\n*MATERIAL", "*ELGEN (allowed: each node and element is "},
           {"*ELEMENT, ", "*ELEMENT, INPUT=e.inp, ",
            "*ELEMENT, INPUT (allowed: its lines here, or *INCLUDE)"},
           {"** nodes", "*INCLUDE, INPUT=../nodes.inp",
            "*INCLUDE of '../nodes.inp' (allowed: a file "},
           {"** nodes", "*INCLUDE, INPUT=nodes.inp", "line 3: *INCLUDE: "},
           {"TYPE=CPE4", "TYPE=CAX4", "elements of type CAX4: an axisymmetric body "},
           {"1, 1, 2,", "1, 1, 12,", "node 12 does not exist"},
           {"Esole, S1", "Esole", "a surface without a side (allowed: as 'Eleft, S1')"},
           {"Esole, S1", "Esole, S5", "side S5 of element 1 is no edge (allowed: S1 to S4)"},
           {"Esole, S1", "Esole, SPOS", "side SPOS of element 1 does not exist"},
       }) {
    const std::filesystem::path file = plate({{old, by}});
    const std::string what = testing::complaint_of<MeshError>([&] { convert_model(file); });
    EXPECT_TRUE(what.starts_with(file.string() + ": line ")) << what;
    EXPECT_NE(what.find(why), std::string::npos) << what;
  }
  const std::filesystem::path shells = plate({{"TYPE=CPE4", "TYPE=S4"}});
  EXPECT_NE(testing::complaint_of<MeshError>([&] {
              convert_model(shells);
            }).find("side S1 of element 1 is no edge (allowed: S3 to S6)"),
            std::string::npos);
}

TEST_F(Decks, NumbersThatNothingHasTakeNoMemory) {
  const std::string expected = converted(plate({}));
  const std::string huge = "*NSET, NSET=Nleft, GENERATE\n1, 999999999999\n*NSET, NSET=Nhuge";
  EXPECT_EQ(converted(plate({{"*NSET, NSET=Nleft", huge}})), expected);
}

TEST_F(Decks, IncludedFilesStandInTheirPlace) {
  const std::string expected = converted(plate({}));
  const std::string elements = "*ELEMENT, TYPE=CPE4, ELSET=Eall\n1, 1, 2,\n 5, 4\n2, 2, 3, 6, 5\n";
  testing::write_text(folder_ / "elements.inp", elements);
  EXPECT_EQ(converted(plate({{elements, "*INCLUDE, INPUT=elements.inp\n"}})), expected);
  testing::write_text(folder_ / "elements.inp", elements + "3, 2, 3, 66, 5\n");
  EXPECT_NE(testing::complaint_of<MeshError>([&] {
              converted(plate({{elements, "*INCLUDE, INPUT=elements.inp\n"}}));
            }).find("plate.inp: elements.inp: line 5: node 66 does not exist"),
            std::string::npos);
}

// Two strips of one part, the upper one moved by its instance.
TEST_F(Decks, InstancesOfAPartAreBodies) {
  const Mesh mesh =
      convert_model(testing::test_data("decks/two_instances.inp"),
                    model_options_of({"held=displacement", "m=contact:m", "s=contact:s"}, {}, ""))
          .mesh;
  EXPECT_EQ(mesh.body_names, Texts({"lower.all", "upper.all"}));
  EXPECT_EQ(mesh.vertices.size(), 24U);
  EXPECT_EQ(mesh.vertices.back(), Eigen::Vector2d(10, 4));
}

struct Prescribed {
  std::string json;
  std::vector<std::string> notes;
};
Prescribed prescribed_by(const std::filesystem::path& deck) {
  const std::optional<DeckScene> scene = scene_of(read_deck_of(deck));
  if (!scene) return {};
  return {nlohmann::json::parse(scene->json).dump(), scene->notes};
}

TEST_F(Decks, PrescribeMaterialsSupportsAndLoads) {
  const auto json =
      nlohmann::json::parse(prescribed_by(testing::test_data("decks/plate_tension.inp")).json);
  EXPECT_EQ(json["plane"], "stress");
  EXPECT_EQ(json["materials"].dump(), R"({"Eall":{"poisson":0.33,"young_MPa":70000.0}})");
  EXPECT_EQ(json["boundary"].dump(),
            R"({"displacement:Nbottom":{"displacement_mm":[0.0,0.0],"support":"normal"},)"
            R"("displacement:Nleft":{"displacement_mm":[0.0,0.0],"support":"normal"},)"
            R"("force:5_P2":{"pressure_MPa":-100.0}})");
}

TEST_F(Decks, PrescribePairsFrictionAndSteps) {
  const Prescribed prescribed = prescribed_by(testing::test_data("decks/block_on_base.inp"));
  const auto json = nlohmann::json::parse(prescribed.json);
  EXPECT_EQ(json["plane"], "strain");
  EXPECT_EQ(json["contacts"].dump(),
            R"([{"between":["contact:Sslave","contact:Smaster"],"friction":0.3}])");
  EXPECT_EQ(json["boundary"]["displacement:Ntop"].dump(),
            R"({"displacement_mm":[0.0,-0.002],"support":"full"})");
  EXPECT_EQ(json["load_steps"].dump(),
            R"([{"boundary":{"displacement:Ntop":{"displacement_mm":[0.0004,-0.002]}}}])");
  EXPECT_EQ(prescribed.notes.front().substr(0, 8), "line 77:");
  EXPECT_NE(prescribed.notes.front().find("contact is hard here, not LINEAR"), std::string::npos);
}

// With the resultant −10 N on a side of 4 mm, as nodes of quadratic sides have it.
TEST_F(Decks, ForcesOnTheNodesOfASideAreATraction) {
  const Prescribed prescribed = prescribed_by(testing::test_data("decks/cantilever.inp"));
  const auto json = nlohmann::json::parse(prescribed.json);
  const auto traction = json["boundary"]["force:loaded"]["traction_MPa"];
  EXPECT_NEAR(traction[0].get<double>(), 0, 1e-9);
  EXPECT_NEAR(traction[1].get<double>(), -2.5, 1e-6);
}

nlohmann::json of(const std::filesystem::path& deck) {
  return nlohmann::json::parse(prescribed_by(deck).json);
}

TEST_F(Decks, ASetCountsEachNodeOnce) {
  const auto traction = [&](const std::string& sets) {
    return of(plate(
        {{"*MATERIAL", sets + "*MATERIAL"},
         {"Nhead, 1, 2\n",
          "Nhead, 1, 2\n*CLOAD\nNsole, 2, -10.\n"}}))["boundary"]["force:Nsole"]["traction_MPa"][1]
        .get<double>();
  };
  EXPECT_DOUBLE_EQ(traction("*NSET, NSET=Nsole\n1, 2, 3\n"), -3);
  EXPECT_DOUBLE_EQ(traction("*NSET, NSET=Nsole\n1, 2, 3\n*NSET, NSET=nsole, GENERATE\n1, 3, 1\n"),
                   -3);
}

// The first card with OP=NEW removes what earlier steps have, the next ones add to it.
TEST_F(Decks, CardsOfOneStepAddUp) {
  const std::string step = "*END STEP\n*STEP\n*STATIC\n",
                    new_loads = "*DLOAD, OP=NEW\n1, P1, 2.\n*DLOAD, OP=NEW\n2, P1, 3.\n";
  const auto steps = [&](const std::string& more) {
    return of(plate({{"Nhead, 1, 2\n", "Nhead, 1, 2\n*DLOAD\nEall, P1, 7.\n" + step + more}}));
  };
  const nlohmann::json renewed = steps(new_loads);
  EXPECT_EQ(renewed["boundary"]["force:Eall_P1"]["pressure_MPa"], 7.);
  EXPECT_EQ(renewed["load_steps"][0]["boundary"].size(), 2u);
  // A pressure on the same side takes the place of the earlier one.
  EXPECT_EQ(steps("*DLOAD\nEsole, P1, 9.\n")["load_steps"][0]["boundary"].dump(),
            R"({"force:Eall_P1":{"pressure_MPa":9.0}})");
}

// With OP=NEW the sole is held instead of the head, which is pressed then.
TEST_F(Decks, AnotherStepMayHoldOtherSides) {
  const nlohmann::json scene = of(plate({{"Nhead, 1, 2\n",
                                          "Nhead, 1, 2, 0.01\n*END STEP\n*STEP\n*STATIC\n"
                                          "*BOUNDARY, OP=NEW\n1, 1, 2\n2, 1, 2\n3, 1, 2\n"
                                          "*DLOAD\nEall, P3, 5.\n"}}));
  EXPECT_EQ(scene["boundary"].dump(),
            R"({"displacement:Nhead":{"displacement_mm":[0.01,0.01],"support":"full"},)"
            R"("force:held":{"pressure_MPa":0.0}})");
  EXPECT_EQ(scene["load_steps"].dump(),
            R"([{"boundary":{"displacement:Nhead":{"pressure_MPa":5.0},)"
            R"("force:held":{"displacement_mm":[0.0,0.0],"support":"full"}}}])");
}

TEST_F(Decks, SurfacesAndSetsOfOneNameAreTwo) {
  const nlohmann::json scene =
      of(plate({{"*MATERIAL", "*NSET, NSET=Ssole\n1, 4\n*MATERIAL"},
                {"Nhead, 1, 2\n", "Nhead, 1, 2\n*DSLOAD\nSsole, P, 5.\n"}}));
  int pressed = 0;
  for (const auto& [curve, label] : scene["roles"].items())
    pressed += label == "force:Ssole" ? 1 : 0;
  EXPECT_EQ(pressed, 1);  // the side, and not the edge between nodes 1 and 4
}

TEST_F(Decks, ASetOfThePartIsNotThatOfTheAssembly) {
  const std::filesystem::path file = testing::write_text(folder_ / "shadow.inp", R"(*PART, NAME=P
*NODE
1, 0., 0.
2, 4., 0.
3, 4., 2.
4, 0., 2.
*ELEMENT, TYPE=CPS4
1, 1, 2, 3, 4
*NSET, NSET=Set-1, GENERATE
1, 4, 1
*ELSET, ELSET=Set-1
1
*SOLID SECTION, ELSET=Set-1, MATERIAL=m
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=P-1, PART=P
*END INSTANCE
*NSET, NSET=Set-1, INSTANCE=P-1
1, 4
*ELSET, ELSET=E, INSTANCE=P-1
1
*SURFACE, NAME=S
E, S2
*END ASSEMBLY
*MATERIAL, NAME=m
*ELASTIC
1000., 0.3
*STEP
*STATIC
*BOUNDARY
Set-1, ENCASTRE
*DSLOAD
S, P, 1.
*END STEP
)");
  const nlohmann::json scene = of(file);
  EXPECT_EQ(scene["boundary"].size(), 2u) << scene;
  EXPECT_EQ(scene["boundary"]["force:S"]["pressure_MPa"], 1.);
}

TEST_F(Decks, SidesOfQuadraticElementsAreHeldWithTheirMiddles) {
  const std::string deck =
      "*NODE\n1, 0., 0.\n2, 4., 0.\n3, 4., 2.\n4, 0., 2.\n5, 2., 0.\n6, 4., 1.\n"
      "7, 2., 2.\n8, 0., 1.\n*ELEMENT, TYPE=CPS8, ELSET=e\n1, 1, 2, 3, 4, 5, 6, "
      "7, 8\n*MATERIAL, NAME=m\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=E, "
      "MATERIAL=M\n*STEP\n*STATIC\n*BOUNDARY\n1, 1, 2\n4, 1, 2\n";
  const auto file = testing::write_text(folder_ / "corners.inp", deck + "*END STEP\n");
  EXPECT_EQ(of(file)["point_supports"].size(), 2u);
  EXPECT_FALSE(of(file).contains("boundary"));
  const auto whole = testing::write_text(folder_ / "whole.inp", deck + "8, 1, 2\n*END STEP\n");
  EXPECT_EQ(of(whole)["boundary"].size(), 1u);
}

// Whether they hold what nothing else holds is seen when the scene is posed.
TEST_F(Decks, NodesThatAreHeldAloneArePointSupports) {
  using Json = nlohmann::json;
  for (const auto& [held, points] : std::vector<std::array<std::string, 2>>{
           {"1, 1, 2\n3, 2\n",
            R"([{"at_mm":[0.0,0.0],"body":"Eall","displacement_mm":[0.0,0.0]},)"
            R"({"at_mm":[10.0,0.0],"body":"Eall","displacement_mm":[null,0.0]}])"},
           {"Nhead, 2\n5, 1, 1, 0.25\n",
            R"([{"at_mm":[5.0,5.0],"body":"Eall","displacement_mm":[0.25,null]}])"},
       }) {
    const Prescribed prescribed = prescribed_by(plate({{"Nhead, 1, 2\n", held}}));
    const Json scene = Json::parse(prescribed.json);
    EXPECT_EQ(scene["point_supports"], Json::parse(points)) << held;
    EXPECT_EQ(scene["roles"]["rest"], "force");
    EXPECT_NE(prescribed.notes.back().find(" is held alone: it takes out a rigid motion"),
              std::string::npos);
  }
  EXPECT_FALSE(of(plate({})).contains("point_supports"));
}

TEST_F(Decks, AMeshAloneIsNoScene) {
  EXPECT_EQ(prescribed_by(plate({{"*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3\n", ""},
                                 {"*SOLID SECTION, ELSET=Eall, MATERIAL=steel\n", ""},
                                 {"*STEP\n*STATIC\n*BOUNDARY\nNhead, 1, 2\n*END STEP", ""}}))
                .json,
            "");
}

TEST_F(Decks, WhatWouldBeAnotherProblemIsRefused) {
  const std::string held = "Nhead, 1, 2\n";
  for (const auto& [old, by, why] : std::vector<std::array<std::string, 3>>{
           {"210000., 0.3\n", "210000., 0.3\n*PLASTIC\n300., 0.\n",
            "*PLASTIC: the material yields"},
           {"210000., 0.3\n", "210000., 0.3, 20.\n200000., 0.3, 100.\n", "*ELASTIC with 2 lines"},
           {"*ELASTIC\n", "*ELASTIC, TYPE=ORTHO\n", "*ELASTIC, TYPE=ORTHO"},
           {"*STEP\n", "*MPC\nTIE, 1, 2\n*STEP\n", "*MPC: coupled displacements"},
           {"*STEP\n", "*TIE, NAME=t\nSsole\n*STEP\n", "*TIE (allowed: two surfaces)"},
           {"*STEP\n", "*TIE, NAME=t, CYCLIC SYMMETRY\nSsole, Sother\n*STEP\n", "*TIE, CYCLIC"},
           {"*STEP\n", "*STEP, NLGEOM\n", "*STEP, NLGEOM"},
           {"*STEP\n", "*SPRNG\n1\n*STEP\n", "*SPRNG, perhaps *SPRING ("},
           {"*STEP\n", "*DLAOD\nEall, P1, 5.\n*STEP\n", "*DLAOD, perhaps *DLOAD ("},
           {"*STEP\n", "*CAVITY\n*STEP\n", "*CAVITY ("},
           {held, held + "2, 2\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY\n2, 2, 2, 0.1\n",
            "node 2 at (5, 0) is held in this node alone, and moved differently in the steps"},
           {held, held + "7, 1\n", "node 7"},
           {held, "Nhead, 1\n", "x alone is held"},
           {held, held + "Nleft, 1\n", "x alone is held"},
           {held, held + "Nhead, 3, 3, 0.1\n", "component 3 is 0.1"},
           {held, held + "*CLOAD\n2, 2, -5.\n", "node 2 at (5, 0): a force in this node alone"},
           {held, held + "*CLOAD\n1, 2, -5.\n2, 2, -20.\n3, 2, -30.\n", "are not even along"},
           {held, held + "*DLOAD\nEall, CENTRIF, 5., 0., 0.\n", "*DLOAD, CENTRIF"},
           {held, held + "*DLOAD\nEall, GRAV, 9810., 0., -1., 0.\n", "has no *DENSITY"},
           {held, held + "*DSLOAD\nStop, P, 5.\n", "surface Stop has no edge of the boundary"},
           {"*STEP\n", "*CONTACT PAIR, INTERACTION=i\nSsole, Sother\n*STEP\n",
            "INTERACTION=i: no "},
           {"*BOUNDARY\n", "*BOUNDARY, AMPLITUDE=a\n", "AMPLITUDE=a: no such *AMPLITUDE"},
           {"*END STEP", "", "the last *STEP has no *END STEP"},
           {"*STEP\n", "*STEP, RIKS\n", "*STEP, RIKS (allowed: NLGEOM"},
           {"*STEP\n", "*RESTART, READ, STEP=2\n*STEP\n", "*RESTART, READ"},
           {"*STATIC\n", "*STATIC, STABILIZE\n", "*STATIC, STABILIZE"},
           {"*BOUNDARY\n", "*BOUNDARY, FIXED\n", "*BOUNDARY, FIXED"},
           {"*BOUNDARY\n", "*BOUNDARY, TYPE=VELOCITY\n", "*BOUNDARY, TYPE=VELOCITY"},
           {"*STEP\n", "*SURFACE INTERACTION, NAME=i\n*SURFACE BEHAVIOR, NO SEPARATION\n*STEP\n",
            "*SURFACE BEHAVIOR, NO SEPARATION"},
           {"*STEP\n", "*SURFACE INTERACTION, NAME=i\n*FRICTION, TAUMAX=5.\n0.5\n*STEP\n",
            "*FRICTION, TAUMAX"},
           {"*STEP\n", "*AMPLITUDE, NAME=a\n2., 0., 3., 1.\n*STEP\n", "begins after 0"},
           {"*STEP\n", "*AMPLITUDE, NAME=a, TIME=TOTAL TIME\n0., 0., 3., 1.\n*STEP\n",
            "*AMPLITUDE, TIME=TOTAL TIME"},
           {"*STEP\n", "  *MPC\nTIE, 1, 2\n*STEP\n", "*MPC: coupled displacements"},
           {held, held + "*CLOAD\n1, 2, -10.\n2, 2, 20.\n3, 2, -10.\n", "are not even along"},
           {"2, 2, 3, 6, 5\n", "2, 2, 3, 6, 5\n3, 3, 6, 5\n", "3 nodes (allowed: 4 of a CPE4)"},
           {"2, 2, 3, 6, 5\n", "2, 2, 3, 6, 5, 4\n", "5 nodes (allowed: 4 of a CPE4)"},
           {"2, 2, 3, 6, 5\n", "2, 2, 3, 6, 6\n", "element 2 has node 6 twice"},
           {"*MATERIAL", "*NSET, NSET=Nloop\n1, Nloop\n*MATERIAL", "set Nloop holds itself"},
           {"*STEP\n", "*SOLID SECTION, ELSET=Esole, MATERIAL=steel\n*STEP\n",
            "element 1 has two sections"},
           {"6, 8., 5.\n", "6, 8., 5., 1.\n", "(allowed: a plane z = constant)"},
           {"MATERIAL=steel\n", "MATERIAL=brass\n", "MATERIAL=brass: no *MATERIAL"},
       }) {
    const std::filesystem::path file = plate({{old, by}});
    const std::string what = testing::complaint_of<InputError>([&] { prescribed_by(file); });
    EXPECT_NE(what.find(why), std::string::npos) << by << ": " << what;
  }
}

}  // namespace
}  // namespace airybench::deck_test
