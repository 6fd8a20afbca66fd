#include "bench/plan/scene_file.hpp"

#include <gtest/gtest.h>

#include "tests/support/complaint.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::scene_file_test {
namespace {

class SceneFile : public ::testing::Test {
 protected:
  Scene read(const std::string& text) {
    testing::write_text(file_, text);
    return read_scene(file_);
  }
  // Each text's complaint, in one line, begins with the file's name and this.
  void expect_complaints(
      const std::vector<std::pair<std::string, std::string>>& complaint_of_text) {
    for (const auto& [text, beginning] : complaint_of_text) {
      const auto what = testing::complaint_of<InputError>([&, &of = text] { read(of); });
      EXPECT_TRUE(what.starts_with(file_.string() + ": " + beginning)) << text << ": " << what;
      EXPECT_FALSE(testing::contains(what, "\n"));
    }
  }
  const testing::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "my scene.json";
};

TEST_F(SceneFile, MissingKeysTakeTheDefaults) {
  const Scene scene = read("{}"), standard;
  EXPECT_EQ(scene.name, "my scene");
  EXPECT_EQ(scene.friction, standard.friction);
  EXPECT_EQ(scene.crown_radius_mm, standard.crown_radius_mm);
  EXPECT_EQ(scene.displacement_mm, standard.displacement_mm);
  EXPECT_FALSE(scene.teeth);
}

TEST_F(SceneFile, EveryKeyIsRead) {
  const Scene scene = read(R"({ "teeth": 1, "root_half_height_mm": 5, "length_mm": 10,
    "tip_half_height_mm": 3, "young_MPa": 70000, "poisson": 0.33, "plane": "stress",
    "friction": 0.5, "crown_radius_mm": null, "clearance_mm": 0.001,
    "displacement_mm": [0.01, -0.002], "body_force_N_per_mm3": [1, 2],
    "materials": { "tip": { "young_MPa": 3000 } } })");
  EXPECT_EQ(scene.teeth, 1);
  EXPECT_EQ(scene.root_half_height_mm, 5);
  EXPECT_EQ(scene.length_mm, 10);
  EXPECT_EQ(scene.tip_half_height_mm, 3);
  EXPECT_EQ(scene.material.young_MPa, 70000);
  EXPECT_EQ(scene.material.poisson, 0.33);
  EXPECT_EQ(scene.plane, Plane::stress);
  EXPECT_EQ(scene.friction, 0.5);
  EXPECT_FALSE(scene.crown_radius_mm);
  EXPECT_EQ(scene.clearance_mm, 0.001);
  EXPECT_EQ(scene.displacement_mm, Eigen::Vector2d(0.01, -0.002));
  EXPECT_EQ(scene.body_force_N_per_mm3, Eigen::Vector2d(1, 2));
  EXPECT_EQ(scene.materials.at("tip").young_MPa, 3000);
  EXPECT_EQ(scene.materials.at("tip").poisson, 0.33);  // the scene's own
}

TEST_F(SceneFile, TransformationsAndLayersAreRead) {
  const Scene scene = read(R"({ "group": "layers", "about": "All keys at once.",
    "mesh": { "refine": 2, "grade": { "at_mm": [10, 1], "ratio": 100 },
      "slivers": { "aspect": 1e3, "count": 5 }, "scale": 2, "stretch": [1, 0.5],
      "move_mm": [3, 4], "keep_contact_edges": 0, "keep_displacement_edges": 2,
      "keep_force_edges": 1 },
    "layers": { "normal": [0, 1], "interfaces_mm": [-1, 1],
      "materials": [ {}, { "young_MPa": 21 } ] },
    "poisson": 0.25 })");
  EXPECT_EQ(scene.group, "layers");
  EXPECT_EQ(scene.about, "All keys at once.");
  EXPECT_EQ(scene.mesh.refine, 2);
  EXPECT_EQ(scene.mesh.grade.value().at_mm, Eigen::Vector2d(10, 1));
  EXPECT_EQ(scene.mesh.grade.value().ratio, 100);
  EXPECT_EQ(scene.mesh.slivers.value().aspect, 1000);
  EXPECT_EQ(scene.mesh.slivers.value().count, 5);
  EXPECT_EQ(scene.mesh.scale, 2);
  EXPECT_EQ(scene.mesh.stretch, Eigen::Vector2d(1, 0.5));
  EXPECT_EQ(scene.mesh.move_mm, Eigen::Vector2d(3, 4));
  EXPECT_EQ(scene.mesh.keep_contact_edges, 0);
  EXPECT_EQ(scene.mesh.keep_displacement_edges, 2);
  EXPECT_EQ(scene.mesh.keep_force_edges, 1);
  EXPECT_EQ(scene.layers.normal, Eigen::Vector2d(0, 1));
  EXPECT_EQ(scene.layers.interfaces_mm, (std::vector<double>{-1, 1}));
  ASSERT_EQ(scene.layer_materials.size(), 2u);
  EXPECT_EQ(scene.layer_materials[1].young_MPa, 21);
  EXPECT_EQ(scene.layer_materials[1].poisson, 0.25);  // the scene's own
}

TEST_F(SceneFile, BoundaryGroupsAreRead) {
  const Scene scene = read(R"({ "boundary": {
    "force:top": { "pressure_MPa": { "at_mm": [[0, 1], [4, 1]], "values": [2, 6] } },
    "force": { "traction_MPa": [3, 4] },
    "displacement:left": { "support": "normal", "displacement_mm": [0.5, 0] },
    "displacement": { "support": "full" } } })");
  ASSERT_EQ(scene.boundary.size(), 4u);
  EXPECT_EQ(scene.boundary.at("force:top").pressure_MPa.value().at({1, 5}), 3);
  EXPECT_EQ(scene.boundary.at("force").traction_MPa.value().at({7, 7}), Eigen::Vector2d(3, 4));
  const BoundaryValues& left = scene.boundary.at("displacement:left");
  EXPECT_EQ(left.support, BoundaryValues::Support::normal);
  EXPECT_EQ(left.displacement_mm.value().at({0, 0}), Eigen::Vector2d(0.5, 0));
  EXPECT_EQ(scene.boundary.at("displacement").support, BoundaryValues::Support::full);
}

TEST_F(SceneFile, ComplaintsOfBoundaryGroups) {
  const auto of_force = [](const char* values) {
    return std::string(R"({"boundary": {"force": )") + values + "}}";
  };
  expect_complaints(
      {{R"({"boundary": []})", "boundary: [] (allowed: "},
       {of_force(R"({"pressure": 3})"),
        "boundary: force: pressure: unknown key, perhaps pressure_MPa (allowed: traction_MPa, "},
       {of_force(R"({"pressure_MPa": [1, 2]})"), "boundary: force: pressure_MPa: [1,2] (allowed: "},
       {of_force(R"({"traction_MPa": 3})"), "boundary: force: traction_MPa: 3 (allowed: "},
       {of_force(R"({"traction_MPa": {"values": [[1, 2], [3, 4]]}})"),
        "boundary: force: traction_MPa: {\"values\":[[1,2],[3,4]]} (allowed: "},
       {of_force(R"({"pressure_MPa": {"at_mm": [[1, 2]]}})"),
        "boundary: force: pressure_MPa: at_mm: [[1,2]] (allowed: "},
       {R"({"boundary": {"displacement": {"support": "roller"}}})",
        "boundary: displacement: support: \"roller\" (allowed: full, normal)"},
       {R"({"boundary": {"contact:tip": {"pressure_MPa": 3}}})",
        "boundary: contact:tip: pressure_MPa (allowed: on a force boundary)"}});
}

TEST_F(SceneFile, LoadStepsAreRead) {
  EXPECT_EQ(read("{}").equal_steps, 1);
  EXPECT_EQ(read(R"({"load_steps": 20})").equal_steps, 20);
  const Scene scene = read(R"({ "load_steps": [
    { "displacement_mm": [0.02, 0], "body_force_N_per_mm3": [1, 2] },
    { "clearance_mm": 0.001, "boundary": { "force": { "pressure_MPa": 3 } } } ] })");
  ASSERT_EQ(scene.later_steps.size(), 2u);
  EXPECT_EQ(scene.later_steps[0].displacement_mm, Eigen::Vector2d(0.02, 0));
  EXPECT_EQ(scene.later_steps[0].body_force_N_per_mm3, Eigen::Vector2d(1, 2));
  EXPECT_FALSE(scene.later_steps[0].clearance_mm);
  EXPECT_EQ(scene.later_steps[1].clearance_mm, 0.001);
  EXPECT_FALSE(scene.later_steps[1].displacement_mm);
  EXPECT_EQ(scene.later_steps[1].boundary.at("force").pressure_MPa.value().at({0, 0}), 3);
}

TEST_F(SceneFile, ComplaintsOfLoadSteps) {
  for (const std::string wrong : {"0", "1001", "1.5", "[]", "{}", "true", "null"})
    expect_complaints({{"{\"load_steps\": " + wrong + "}",
                        "load_steps: " + wrong + " (allowed: a whole number"}});
  expect_complaints(
      {{R"({"load_steps": [3]})", "load_steps: 1: 3 (allowed: "},
       {R"({"load_steps": [{}, {"friction": 1}]})",
        "load_steps: 2: friction: unknown key (allowed: "},
       {R"({"load_steps": [{}, {"clearance_mm": -1}]})",
        "load_steps: 2: clearance_mm: -1 (allowed: "},
       {R"({"load_steps": [{"displacement_mm": 3}]})",
        "load_steps: 1: displacement_mm: 3 (allowed: "},
       {R"({"load_steps": [{"boundary": {"displacement": {"support": "full"}}}]})",
        "load_steps: 1: boundary: displacement: support (allowed: "},
       {R"({"load_steps": [{"boundary": {"contact": {"friction": 1}}}]})",
        "load_steps: 1: boundary: contact: friction (allowed: "},
       {R"({"load_steps": [{"boundary": {"force": {"displacement_mm": [0, 0], "pressure_MPa": 1}}}]})",
        "load_steps: 1: boundary: force: displacement_mm and pressure_MPa (allowed: either"}});
}

TEST_F(SceneFile, WallsFacesAndContactGroups) {
  const Scene scene = read(R"({
    "wall": {"flat": {"point_mm": [1, 2], "normal": [0, 1]}},
    "face": {"circle": {"centre_mm": [3, 4], "radius_mm": 5}},
    "boundary": {"contact:a": {"friction": 0.1, "clearance_mm": 0.2,
      "wall": {"circle": {"centre_mm": [0, 1], "radius_mm": 2, "bodies": "outside"}},
      "face": {"polyline": [[0, 0], [1, 1], [2, 1]]}}}})");
  EXPECT_EQ(std::get<FlatWall>(scene.wall.value()).point_mm, Eigen::Vector2d(1, 2));
  EXPECT_EQ(std::get<CircularWall>(scene.face.value()).radius_mm, 5);
  const ContactValues& own = scene.boundary.at("contact:a").contact;
  EXPECT_EQ(own.friction, 0.1);
  EXPECT_EQ(own.clearance_mm, 0.2);
  EXPECT_EQ(std::get<CircularWall>(own.wall.value()).bodies, CircularWall::Bodies::outside);
  EXPECT_EQ(std::get<PolylineWall>(own.face.value()).points_mm.back(), Eigen::Vector2d(2, 1));
}

TEST_F(SceneFile, APolylineOfAFileIsInTheDefinition) {
  const auto folder = file_.parent_path();
  testing::write_text(folder / "profile.csv", "x_mm,y_mm\n# lower\n0, 1\r\n\n2 3.5\n");
  testing::write_text(file_, R"({"wall": {"polyline": "profile.csv"}})");
  const airybench::SceneFile given = read_scene_file(file_);
  EXPECT_EQ(given.definition(), R"({"wall":{"polyline":[[0.0,1.0],[2.0,3.5]]}})");
  const auto& points = std::get<PolylineWall>(given.scene.wall.value()).points_mm;
  EXPECT_EQ(points, (std::vector<Eigen::Vector2d>{{0, 1}, {2, 3.5}}));
  testing::write_text(folder / "profile.csv", "0 1\n2 a\n");
  const auto said = [&] {
    return testing::complaint_of<InputError>([&] { read_scene_file(file_); });
  };
  const std::string named = file_.string() + ": polyline: " + (folder / "profile.csv").string();
  EXPECT_TRUE(said().starts_with(named + ":2: '2 a' (allowed: ")) << said();
  std::filesystem::remove(folder / "profile.csv");
  EXPECT_TRUE(said().starts_with(named + ": cannot be opened")) << said();
}

TEST_F(SceneFile, ACrownIsTheCataloguesAlone) {
  testing::write_text(file_, R"({"friction": 0.1})");
  const airybench::SceneFile given = read_scene_file(file_), other = on_other_bodies(given);
  EXPECT_EQ(given.scene.crown_radius_mm, 400);
  EXPECT_FALSE(other.scene.crown_radius_mm);
  EXPECT_EQ(other.definition(), R"({"friction":0.1,"crown_radius_mm":null})");
  testing::write_text(file_, R"({"crown_radius_mm": 7})");
  EXPECT_EQ(on_other_bodies(read_scene_file(file_)).scene.crown_radius_mm, 7);
}

TEST_F(SceneFile, ComplaintsOfWalls) {
  const std::string wall = R"("wall": {"flat": {"point_mm": [0, 0], "normal": [0, 1]}})";
  // What new-scene writes, with a wall added.
  EXPECT_NO_THROW(scene_of("{" + wall + R"(, "crown_radius_mm": null})", "scene"));
  expect_complaints(
      {{R"({"wall": 3})", "wall: 3 (allowed: "},
       {R"({"wall": {}})", "wall: {} (allowed: one of flat, circle, polyline)"},
       {R"({"wall": {"plane": {}}})", "wall: plane: unknown key (allowed: flat, circle, polyline)"},
       {R"({"wall": {"flat": {"normal": [0, 1]}}})", "wall: flat: {\"normal\":[0,1]} (allowed: "},
       {R"({"wall": {"flat": {"point_mm": [0, 0], "normal": [0, 0]}}})",
        "wall: flat: normal: [0, 0] (allowed: "},
       {R"({"wall": {"circle": {"centre_mm": [0, 0], "radius_mm": 1}}})",
        "wall: circle: {\"centre_mm\":[0,0],\"radius_mm\":1} (allowed: "},
       {R"({"wall": {"circle": {"bodies": "between"}}})",
        "wall: circle: bodies: \"between\" (allowed: inside, outside)"},
       {R"({"wall": {"circle": {"radius_mm": 0}}})", "wall: circle: radius_mm: 0 (allowed: "},
       {R"({"wall": {"polyline": [[0, 0]]}})", "wall: polyline: 1 point(s) (allowed: "},
       {R"({"wall": {"polyline": [[0, 0], [0, 0]]}})",
        "wall: polyline: point 2: [0, 0] again (allowed: "},
       {R"({"wall": {"polyline": [[0, 0], 1]}})", "wall: polyline: 1 (allowed: "},
       {R"({"face": {"circle": {"bodies": "inside"}}})", "face: circle: bodies: unknown key ("},
       {R"({"face": {"circle": {"centre_mm": [0, 0], "radius_mm": 1}}})",
        "face: given without a wall (allowed: "},
       {"{" + wall + R"(, "crown_radius_mm": 3})", "wall and crown_radius_mm (allowed: "},
       {R"({"boundary": {"force": {)" + wall + "}}}",
        "boundary: force: wall (allowed: on a contact"},
       {R"({"boundary": {"contact": {"friction": -1}}})",
        "boundary: contact: friction: -1 (allowed: 0 to 1e6)"}});
}

TEST_F(SceneFile, ComplaintsOfTransformationsAndLayers) {
  EXPECT_TRUE(scene_of(R"({"mesh": {"polygon": true}})", "scene").mesh.polygon);
  expect_complaints(
      {{R"({"mesh": 3})", "mesh: 3 (allowed: "},
       {R"({"mesh": {"turn": 3}})", "mesh: turn: unknown key (allowed: refine"},
       {R"({"mesh": {"polygon": 1}})", "mesh: polygon: 1 (allowed: true, false)"},
       {R"({"mesh": {"refine": 1.5}})", "mesh: refine: 1.5 (allowed: "},
       {R"({"mesh": {"grade": {"ratio": 10}}})", "mesh: grade: {\"ratio\":10} (allowed: "},
       {R"({"mesh": {"grade": {"at_mm": [0, 0], "ratio": 0}}})",
        "mesh: grade: ratio: 0 (allowed: >= 1)"},
       {R"({"mesh": {"stretch": [1, 0]}})", "mesh: stretch: [1, 0] (allowed: "},
       {R"({"layers": {"normal": [1, 0]}})", "layers: {\"normal\":[1,0]} (allowed: "},
       {R"({"layers": {"count": 2, "materials": [{"poisson": 0.6}]}})",
        "layers: materials: poisson: 0.6 (allowed: "},
       {R"({"layers": {"count": 2, "normal": [0, 0]}})", "layers: normal: [0, 0] (allowed: "},
       {R"({"group": 1})", "group: 1 (allowed: a text)"}});
}

TEST_F(SceneFile, ComplaintsNameKeyValueAndWhatIsAllowed) {
  expect_complaints(
      {{R"({"frction": 0.2})", "frction: unknown key, perhaps friction (allowed: t"},
       {R"({"gravity": 0.2})", "gravity: unknown key (allowed: t"},
       {R"({"roles": ["force"]})", "roles: [\"force\"] (allowed: "},
       {R"({"roles": {"3": "held"}})", "roles: 3: \"held\" (allowed: displacement, force, contact"},
       {R"({"length_unit": "cm"})", "length_unit: \"cm\" (allowed: mm, m, inch"},
       {R"({"friction": "0.2"})", "friction: \"0.2\" (allowed: a number)"},
       {R"({"friction": -1})", "friction: -1 (allowed: 0 to 1e6)"},
       {R"({"poisson": 0.5})", "poisson: 0.5 (allowed: between -1 and 0.5, both excluded)"},
       {R"({"young_MPa": 0})", "young_MPa: 0 (allowed: 1e-30 to 1e30)"},
       {R"({"plane": "bent"})", "plane: \"bent\" (allowed: strain, stress)"},
       {R"({"teeth": 0})", "teeth: 0 (allowed: a whole number from 1 to 1000000)"},
       {R"({"teeth": 1.5})", "teeth: 1.5 (allowed: "},
       {R"({"length_mm": -2})", "length_mm: -2 (allowed: a number > 0)"},
       {R"({"displacement_mm": [1]})", "displacement_mm: [1] (allowed: two numbers [x, y])"},
       {R"({"crown_radius_mm": 0})", "crown_radius_mm: 0 (allowed: > 0, up to 1e15 mm, or null"},
       {R"({"materials": {"a": {"nu": 0.3}}})", "materials: a: nu: unknown key (allowed: "},
       {R"({"materials": {"a": {"poisson": 0.7}}})", "materials: a: poisson: 0.7 (allowed: "},
       {R"({"friction": 0.2, "friction": 0.3})", "friction: given twice"},
       {R"({"friction": 1e400})", "not JSON: number overflow pars"},
       {"[]", "the file: [] (allowed: a JSON object)"},
       {"{\"friction\": 0.2", "not JSON: parse error "},
       {"", "not JSON: parse error "}});
}

TEST_F(SceneFile, HowAMeshIsMadeOfAModel) {
  const auto settings = [&](const char* text) {
    return read_scene_file(testing::write_text(folder_ / "a.json", text)).model_settings();
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(settings("{}"), Texts{});
  EXPECT_EQ(settings(R"({"roles": {"1-4": "force:side", "a=b": "contact"}, "length_unit": "m"})"),
            (Texts{"--role=1-4=force:side", "--role=a=b=contact", "--length-unit=m"}));
  EXPECT_EQ(settings(R"({"length_unit": "mm"})"), Texts{});
}

// Every key with another value than its default, in the order of the table.
TEST_F(SceneFile, WhatIsReadIsWritten) {
  const std::string start =
      R"({"teeth":1,"root_half_height_mm":5.0,"length_mm":10.0,"tip_half_height_mm":3.0,)"
      R"("length_unit":"inch","roles":{"3":"contact:sole","a=b":"force"},"plane":"stress",)"
      R"("young_MPa":70000.0,"poisson":0.33,)"
      R"("materials":{"rim":{"young_MPa":3000.0,"poisson":0.4}},"friction":0.5,)";
  const std::string loads =
      R"("clearance_mm":0.001,"displacement_mm":[0.01,-0.002],"body_force_N_per_mm3":[1.0,2.0],)"
      R"("boundary":{"displacement:a":{"displacement_mm":[0.1,0.2],"support":"normal"},)"
      R"("force:a":{"traction_MPa":{"at_mm":[[0.0,1.0],[4.0,1.0]],"values":[[1.0,2.0],[3.0,4.0]]}},)"
      R"("force:b":{"pressure_MPa":{"at_mm":[[0.0,1.0],[4.0,1.0]],"values":[2.0,6.0]}},)"
      R"("force:c":{"pressure_MPa":7.0}},)";
  const std::string end = R"("group":"g","about":"all keys"})";
  for (const std::string& text :
       {start + R"("crown_radius_mm":null,)" + loads +
            R"("point_supports":[{"at_mm":[0.0,0.0],"displacement_mm":[0.0,null],"body":"rim"}],)"
            R"("contacts":[{"between":["contact:a",["contact:b","contact:c"]],"friction":0.3,)"
            R"("clearance_mm":-0.01}],"load_steps":20,)"
            R"("mesh":{"refine":2,"grade":{"at_mm":[10.0,1.0],"ratio":100.0},)"
            R"("slivers":{"aspect":1000.0,"count":5},"scale":2.0,"stretch":[1.0,0.5],)"
            R"("move_mm":[3.0,4.0],"keep_contact_edges":0,"keep_displacement_edges":2,)"
            R"("keep_force_edges":1,"polygon":true},)"
            R"("layers":{"normal":[0.0,1.0],"interfaces_mm":[-1.0,1.0],)"
            R"("materials":[{"young_MPa":21.0,"poisson":0.2}]},)" +
            end,
        start +
            R"("wall":{"flat":{"point_mm":[1.0,2.0],"normal":[0.0,1.0]}},)"
            R"("face":{"circle":{"centre_mm":[3.0,4.0],"radius_mm":5.0}},)" +
            loads +
            R"("load_steps":[{"displacement_mm":[0.02,0.0],"body_force_N_per_mm3":[1.0,2.0]},)"
            R"({"clearance_mm":0.002,"boundary":{"force:c":{"pressure_MPa":3.0}}}],)"
            R"("layers":{"count":3},)" +
            end,
        std::string(
            R"({"boundary":{"contact:a":{"friction":0.1,"clearance_mm":0.2,)"
            R"("wall":{"circle":{"centre_mm":[0.0,1.0],"radius_mm":2.0,)"
            R"("bodies":"outside"}},"face":{"polyline":[[0.0,0.0],[1.0,1.0]]}}},)"
            R"("contacts":[{"between":["contact:b","contact:c"]}],"load_steps":)"
            R"([{"contacts":[{"between":["contact:b","contact:c"],"clearance_mm":1.0}]}]})")}) {
    const airybench::SceneFile file = scene_file_of(text, "scene");
    EXPECT_EQ(file.definition(), text);
    EXPECT_EQ(scene_file_of(file.text(), "scene").definition(), text);
  }
  // Keys that were given stay, whatever their values.
  EXPECT_EQ(scene_file_of(R"({"friction": 0.2, "plane": "strain"})", "scene").definition(),
            R"({"plane":"strain","friction":0.2})");
}

TEST_F(SceneFile, EqualStepsAreAKeyOfTheFile) {
  const auto in_steps = [](const char* text) {
    return in_equal_steps(scene_file_of(text, "scene"), 4).definition();
  };
  EXPECT_EQ(in_steps("{}"), R"({"load_steps":4})");
  EXPECT_EQ(testing::complaint_of<InputError>([&] { in_steps(R"({"load_steps": 2})"); }),
            "scene: load_steps and --steps (allowed: one of them)");
}

TEST_F(SceneFile, AMissingFileIsNamed) {
  EXPECT_EQ(testing::complaint_of<InputError>([] { read_scene("no/such/scene.json"); }),
            "no/such/scene.json: cannot be opened: No such file or directory");
}

}  // namespace
}  // namespace airybench::scene_file_test
