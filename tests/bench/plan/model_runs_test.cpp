// Gmsh models as meshes of `bench`.
#include <gtest/gtest.h>

#include <filesystem>

#include "mesh/model_format.hpp"
#include "mesh/msh_format.hpp"
#include "support/sha256.hpp"
#include "tests/support/background_run.hpp"
#include "tests/support/bench_command.hpp"

namespace airybench::model_runs_test {
namespace {

namespace fs = std::filesystem;

// A square of two bodies held on the left, against a wall on the right.
const std::string square = R"(
DefineConstant[ h = 0.5 ];
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Physical Curve("clamped") = {4};
Physical Curve("force") = {1, 3};
Physical Curve("contact") = {2};
Physical Surface("steel") = {1};
)";

class ModelRuns : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(testing::meshgen_executable())) GTEST_SKIP() << "meshgen is not built here";
    testing::write_text(bench_.path("part.geo"), square);
  }
  testing::CommandResult run(const std::string& arguments) const {
    return bench_.run(arguments, "export AIRYBENCH_CACHE_DIR=cache; ");
  }
  // Exit code 2, one line, no results folder.
  void expect_refusal(const std::string& arguments, const std::string& line) const {
    bench_.expect_refusal(arguments + " --out=refused", line + "\n",
                          "export AIRYBENCH_CACHE_DIR=cache; ");
    EXPECT_FALSE(fs::exists(bench_.path("refused"))) << arguments;
  }
  fs::path kept(const Json& record, const std::string& folder = "o") const {
    return bench_.path(folder) / record["mesh_file"].get<std::string>();
  }
  const testing::BenchCommand bench_;
};

const std::string part = "--mesh=part.geo --role clamped=displacement ";
const std::string quick = "--method=HYBRID --repetitions=1 ";

TEST_F(ModelRuns, FromTheModelToTheTable) {
  const testing::CommandResult result = run(part + quick + "--out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  ASSERT_EQ(bench_.records().size(), 1u);
  const Json record = bench_.records().front();
  EXPECT_EQ(record["mesh"], "part");
  EXPECT_EQ(record["status"], "ok");
  EXPECT_EQ(record["mesh_sha256"], sha256_of_file(kept(record)));
  EXPECT_EQ(read_msh(kept(record)).name, "part");
  EXPECT_EQ(fs::relative(kept(record), bench_.path("o")),
            fs::path("meshes") / ("part." + record["mesh_sha256"].get<std::string>().substr(0, 8)) /
                "part.msh");
}

TEST_F(ModelRuns, RecordsKeepTheirMeshes) {
  ASSERT_EQ(run(part + quick + "--out=o").code, 0);
  const fs::path coarse = kept(bench_.records().front());
  const testing::CommandResult resumed = run(part + quick + "--out=o --resume");
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.out.find("1 of these 1 records were there already"), std::string::npos);
  ASSERT_EQ(run(part + "--parameter h=0.2 --method=P2 --repetitions=1 --append --out=o").code, 0);
  const fs::path fine = kept(bench_.records().back());
  EXPECT_GT(read_msh(fine).vertices.size(), read_msh(coarse).vertices.size());
  EXPECT_EQ(run("replay o:part/default/HYBRID --out=again").code, 0);
  EXPECT_EQ(bench_.records("again").front()["mesh_sha256"], sha256_of_file(coarse));
}

TEST_F(ModelRuns, SizesOfTheCommandLineReachTheMesh) {
  const auto n_phi = [&](const std::string& settings) {
    EXPECT_EQ(run(part + quick + settings + " --out=o").code, 0);
    return bench_.records().front()["n_phi"].get<int>();
  };
  const int coarse = n_phi("");
  EXPECT_GT(n_phi("--mesh-size=0.1"), 4 * coarse);
  EXPECT_GT(n_phi("--mesh-size=25%"), 4 * coarse);
  EXPECT_GT(n_phi("--parameter=h=0.1"), 4 * coarse);
}

TEST_F(ModelRuns, WhereverAMeshIsTaken) {
  EXPECT_EQ(run(part + "--dry-run --out=planned").code, 0);
  EXPECT_FALSE(fs::exists(bench_.path("planned")));
  const testing::CommandResult adapted =
      run(part + quick + "--adapt=600,levels=last --out=adapted");
  EXPECT_EQ(adapted.code, 0) << adapted.err;
  EXPECT_NE(bench_.records("adapted").front()["mesh"].get<std::string>().find("part+adapt"),
            std::string::npos);
  const testing::CommandResult advice =
      run("advise " + part + "--error=20% --method=HYBRID,P2 --out=advice");
  EXPECT_EQ(advice.code, 0) << advice.err;
  EXPECT_NE(advice.out.find("bench --mesh=part.geo --role=clamped=displacement"), std::string::npos)
      << advice.out;
}

TEST_F(ModelRuns, AMeshOfAnotherFormIsAModel) {
  // MSH 2.2 as Gmsh writes it of a model with a physical point: an element of type 15.
  ASSERT_EQ(run(part + quick + "--out=o").code, 0);
  std::string text = testing::text_of(kept(bench_.records().front()));
  const std::size_t at = text.find("$Elements\n") + 10, end = text.find('\n', at);
  const int count = std::stoi(text.substr(at, end - at));
  text.replace(at, end - at, std::to_string(count + 1) + "\n9999 15 2 0 1 1");
  testing::write_text(bench_.path("points.msh"), text);
  const testing::CommandResult result = run("--mesh=points.msh " + quick + "--out=points");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(bench_.records("points").front()["mesh"], "points");
}

TEST_F(ModelRuns, NotesAreToldOnStandardError) {
  testing::write_text(bench_.path("part.geo"), square + "Mesh.ElementOrder = 2;\n");
  const testing::CommandResult result = run(part + quick + "--out=o");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(
      result.err.starts_with("note: part.geo: of elements of higher order, sides of the boundary "
                             "keep their curves; others "
                             "are chords\n"))
      << result.err;
}

TEST_F(ModelRuns, RolesAndUnitAreOfTheScene) {
  const std::string model = "--mesh=" + testing::test_data("models/numbers.geo").string() + " ";
  testing::write_text(bench_.path("a.json"),
                      R"({"roles": {"3": "displacement:head", "1": "contact"},
                          "boundary": {"displacement:head": {"displacement_mm": [0, -0.01]}}})");
  testing::write_text(bench_.path("b.json"), R"({"roles": {"3": "displacement", "1-2": "contact"},
                                                 "length_unit": "inch"})");
  const testing::CommandResult result = run(model + "--scene=a.json,b.json " + quick + "--out=o");
  EXPECT_NE(result.code, 2) << result.err;
  const std::vector<Json> records = bench_.records();
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0]["status"], "ok");
  EXPECT_NE(records[0]["mesh_sha256"], records[1]["mesh_sha256"]);
  EXPECT_LT(mesh_sizes(read_msh(kept(records[0]))).contact_edges,
            mesh_sizes(read_msh(kept(records[1]))).contact_edges);
  EXPECT_NEAR(extent_of(read_msh(kept(records[1]))).width_mm, 254, 1e-9);
  EXPECT_EQ(run("replay o:numbers/a/HYBRID --out=again").code, 0);
  EXPECT_EQ(bench_.records("again").front()["mesh_sha256"], records[0]["mesh_sha256"]);
  expect_refusal("--mesh=Mesh0 --scene=a.json",
                 "--role=3=displacement:head: no Gmsh model is among the meshes (allowed: with "
                 "--mesh=" +
                     std::string(model_extensions) + ")");
}

// MSH 2.2 with comments, clockwise triangles, another section; no names and no last newline.
TEST_F(ModelRuns, AMeshOfAnotherProgramIsConverted) {
  const std::string old = "--mesh=" + testing::test_data("models/old.msh").string() + " ";
  const testing::CommandResult result =
      run(old + "--role=12=displacement --role=11=contact " + quick + "--out=o");
  EXPECT_NE(result.code, 2) << result.err;
  EXPECT_EQ(bench_.records().front()["mesh"], "old");
  // One of ours takes roles, too.
  const testing::CommandResult own = run("--mesh=" + kept(bench_.records().front()).string() +
                                         " --role=force=contact:side " + quick + "--out=own");
  EXPECT_NE(own.code, 2) << own.err;
  EXPECT_EQ(mesh_sizes(read_msh(kept(bench_.records("own").front(), "own"))).force_edges, 0);
}

TEST_F(ModelRuns, ANewSceneNamesTheModelsGroups) {
  const testing::CommandResult result =
      bench_.run("new-scene part.geo --role=clamped=displacement",
                 "export AIRYBENCH_CACHE_DIR=cache AIRYBENCH_CALLED_AS=../run; ");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out,
            "part.json: fill it in, then for its answer: ../run bench solve part.geo part.json\n"
            "to compare methods: ../run bench --mesh=part.geo --scene=part.json\n");
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(bench_.content("part.json"), R"({
  "length_unit": "mm",
  "roles": {
    "clamped": "displacement"
  },
  "plane": "strain",
  "materials": {
    "steel": {"young_MPa":210000.0,"poisson":0.3}
  },
  "displacement_mm": [0.0,0.0],
  "body_force_N_per_mm3": [0.0,0.0],
  "boundary": {
    "contact": {"friction":0.2,"clearance_mm":0.0,"wall":{"flat":{"point_mm":[1.0,0.0],"normal":[-1.0,0.0]}}},
    "displacement": {"support":"full"},
    "force": {"traction_MPa":[0.0,0.0]}
  }
}
)");
  EXPECT_EQ(run("--mesh=part.geo --scene=part.json --dry-run").code, 0);
  // The scene's displacement is the group's, too.
  std::string pressed = bench_.content("part.json");
  const std::string none = "\"displacement_mm\": [0.0,0.0]";
  pressed.replace(pressed.find(none), none.size(), "\"displacement_mm\": [0.01, 0]");
  testing::write_text(bench_.path("pressed.json"), pressed);
  const testing::CommandResult ran =
      run("--mesh=part.geo --scene=pressed.json " + quick + "--out=o");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.err.find("no wall"), std::string::npos) << ran.err;
  EXPECT_LT(bench_.record()["normal_resultant_N"].get<double>(), -1);
  bench_.expect_refusal("new-scene part.geo",
                        "part.json: is there already (allowed: a name that is free)\n");
  bench_.expect_refusal("new-scene none.geo", "none.geo: ");
}

TEST_F(ModelRuns, ANewSceneGivesNamesTheRoleThatTheyMayMean) {
  std::string text = square;
  const auto rename = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  rename("\"contact\"", "\"Contact_sole\"");
  rename("\"clamped\"", "\"top\"");
  testing::write_text(bench_.path("shoe.geo"), text);
  const testing::CommandResult result = run("new-scene shoe.geo");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err,
            "note: shoe.json: no curve has the role displacement: contact alone holds it "
            "(--role=CURVE=displacement of bench new-scene gives it)\n");
  const Json scene = Json::parse(bench_.content("shoe.json"));
  EXPECT_EQ(scene["roles"], Json({{"Contact_sole", "contact:sole"}, {"top", "force:top"}}))
      << scene;
  EXPECT_TRUE(scene["boundary"]["contact:sole"].contains("wall")) << scene;
}

TEST_F(ModelRuns, ANewSceneHasAPinForAHole) {
  testing::write_text(bench_.path("plate.geo"), R"(
Point(1) = {0, 0, 0, 1}; Point(2) = {6, 0, 0, 1}; Point(3) = {6, 6, 0, 1}; Point(4) = {0, 6, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Point(5) = {3, 3, 0, 0.5}; Point(6) = {4, 3, 0, 0.5}; Point(7) = {2, 3, 0, 0.5};
Circle(5) = {6, 5, 7}; Circle(6) = {7, 5, 6};
Curve Loop(1) = {1:4}; Curve Loop(2) = {5, 6}; Plane Surface(1) = {1, 2};
Physical Curve("displacement") = {4};
Physical Curve("contact") = {5, 6};
)");
  ASSERT_EQ(run("new-scene plate.geo").code, 0);
  const Json pin =
      Json::parse(bench_.content("plate.json"))["boundary"]["contact"]["wall"]["circle"];
  EXPECT_EQ(pin["bodies"], "outside");
  EXPECT_EQ(pin["centre_mm"], Json({3., 3.}));
  EXPECT_EQ(pin["radius_mm"], 1);
  const testing::CommandResult planned = run("--mesh=plate.geo --scene=plate.json --dry-run");
  EXPECT_EQ(planned.code, 0) << planned.err;
}

// A round body that is said to be the polygon of its mesh has corners, which no refinement makes
// round.
TEST_F(ModelRuns, ANewSceneKnowsArcs) {
  testing::write_text(bench_.path("shoe.geo"), R"(
Point(1) = {-4, 6, 0, 1}; Point(2) = {-4, 1, 0, 0.3}; Point(3) = {-3, 1, 0, 1};
Point(4) = {-3, 0, 0, 0.3}; Point(5) = {4, 0, 0, 0.3}; Point(6) = {4, 6, 0, 1};
Line(1) = {1, 2}; Circle(2) = {2, 3, 4}; Line(3) = {4, 5}; Line(4) = {5, 6}; Line(5) = {6, 1};
Curve Loop(1) = {1:5}; Plane Surface(1) = {1};
Physical Curve("displacement") = {5};
Physical Curve("contact:sole") = {2, 3};
)");
  ASSERT_EQ(run("new-scene shoe.geo").code, 0);
  const Json scene = Json::parse(bench_.content("shoe.json"));
  const std::string arc = "contact:sole_curve_2";
  EXPECT_EQ(scene["roles"]["2"], arc) << scene;
  EXPECT_EQ(scene["boundary"][arc]["face"],
            Json({{"circle", {{"centre_mm", {-3., 1.}}, {"radius_mm", 1.}}}}));
  EXPECT_FALSE(scene["boundary"]["contact:sole"].contains("face")) << scene;
  const auto corners = [&](const std::string& file) {
    const std::string err = run("--mesh=shoe.geo --scene=" + file + " --dry-run").err;
    return err.find("contact:sole_curve_2: a polygon with") != err.npos;
  };
  EXPECT_FALSE(corners("shoe.json"));
  Json without = scene;
  without["boundary"][arc].erase("face");
  testing::write_text(bench_.path("without.json"), without.dump());
  EXPECT_FALSE(corners("without.json"));  // the mesh knows its curves
  without["mesh"] = {{"polygon", true}};
  testing::write_text(bench_.path("polygon.json"), without.dump());
  EXPECT_TRUE(corners("polygon.json"));
}

TEST_F(ModelRuns, ABodyWithoutAWallIsNoted) {
  const testing::CommandResult result = run(part + "--dry-run");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.err.find(
                "note: part/default: contact: no wall given, so the wall lies on the edges\n"),
            std::string::npos)
      << result.err;
  EXPECT_EQ(run("--mesh=Mesh0 --dry-run").err.find("no wall"), std::string::npos);
}

TEST_F(ModelRuns, AConversionGivesSignsOfLife) {
  const auto planned = [&](const std::string& silent_s) {
    return bench_.run(part + "--dry-run", "export AIRYBENCH_CACHE_DIR=cache" + silent_s +
                                              " AIRYBENCH_SILENT_S=" + silent_s + "; ");
  };
  const testing::CommandResult heard = planned("0.01");
  EXPECT_EQ(heard.code, 0);
  EXPECT_NE(heard.err.find("... reading part.geo, for 0 s\n"), std::string::npos) << heard.err;
  EXPECT_EQ(heard.err.find("meshgen"), std::string::npos) << heard.err;  // its signs are late
  EXPECT_EQ(planned("600").err.find("..."), std::string::npos);
}

TEST_F(ModelRuns, EndsByNamingThePictureToOpen) {
  const auto last_line = [&](const std::string& arguments, const std::string& drawn_by = "") {
    const std::string out =
        bench_
            .run(arguments, "export AIRYBENCH_CACHE_DIR=cache AIRYBENCH_TO_DRAW=" + drawn_by + "; ")
            .out;
    const std::size_t before = out.rfind('\n', out.size() - 2);
    return out.substr(before + 1);
  };
  const std::string name = "part--default--HYBRID", grid = "o/fields/" + name + ".vtu";
  EXPECT_EQ(last_line(part + quick + "--out=o"), "for a picture of part: --fields\n");
  EXPECT_EQ(last_line(part + quick + "--fields --out=o"),
            "ParaView: " + grid + "  (a picture: ./run figures o)\n");
  EXPECT_EQ(last_line(part + quick + "--fields --out=o", "caller"),
            "picture: o/figures/fields_" + name + ".png  (ParaView: " + grid + ")\n");
  // A picture of these fields, no older one, nor older fields.
  fs::create_directory(bench_.path("o/figures"));
  testing::write_text(bench_.path("o/figures/fields_" + name + ".png"), "");
  EXPECT_EQ(last_line(part + quick + "--fields --out=o --resume").substr(0, 8), "picture:");
  EXPECT_EQ(last_line(part + quick + "--fields --out=o").substr(0, 8), "ParaView");
  EXPECT_EQ(last_line(part + quick + "--out=o"), "for a picture of part: --fields\n");
  EXPECT_EQ(last_line("--mesh=Mesh0 " + quick + "--out=o").substr(0, 13), "records.jsonl");
}

TEST_F(ModelRuns, EndsByNamingTheFilesOfAPathOfLoadSteps) {
  testing::write_text(bench_.path("path.json"), R"({"load_steps": 2})");
  const std::string said = "export AIRYBENCH_CACHE_DIR=cache AIRYBENCH_CALLED_AS=./run ";
  const std::string moving =
      "numbers of every step: o/fields/Mesh0--path--HYBRID.steps.csv\n"
      "moving picture: ./run figures o --animate\n";
  const auto run_path = [&](const std::string& drawn_by) {
    return bench_
        .run("--mesh=Mesh0 --scene=path.json " + quick + "--fields --out=o",
             said + "AIRYBENCH_TO_DRAW=" + drawn_by + "; ")
        .out;
  };
  const std::string drawn_later = run_path("");
  EXPECT_TRUE(
      drawn_later.ends_with("ParaView: o/fields/Mesh0--path--HYBRID.pvd  (a picture: ./run "
                            "figures o)\n" +
                            moving))
      << drawn_later;
  const std::string drawn = run_path("caller");
  EXPECT_TRUE(
      drawn.ends_with("picture: o/figures/load_path_Mesh0--path--HYBRID.png  (ParaView: "
                      "o/fields/Mesh0--path--HYBRID.pvd)\n" +
                      moving))
      << drawn;
  EXPECT_NE(drawn.find("error total"), std::string::npos) << drawn;  // the record has one
}

TEST_F(ModelRuns, WrongModelsAndSettingsAreOneLine) {
  const testing::CommandResult free = run("--mesh=part.geo --role=contact=force --out=refused");
  EXPECT_EQ(free.code, 2);
  EXPECT_EQ(
      free.err,
      "bench: part.geo: no edges in a physical curve named displacement (others found: "
      "'clamped'; --role gives them one); --role=NUMBER=displacement holds one of its curves:\n"
      "  curve  names    role   length mm  from    by        to\n"
      "  1      force    force  1          (0, 0)  (0.5, 0)  (1, 0)\n"
      "  2      contact  force  1          (1, 0)  (1, 0.5)  (1, 1)\n"
      "  3      force    force  1          (1, 1)  (0.5, 1)  (0, 1)\n"
      "  4      clamped  force  1          (0, 1)  (0, 0.5)  (0, 0)\n");
  expect_refusal("--mesh=nowhere.geo", "nowhere.geo: cannot be opened: No such file or directory");
  expect_refusal("--mesh=part.geo --role clamped=fixed",
                 "--role: clamped=fixed (allowed: NAME=ROLE with displacement, force, contact, or "
                 "one of these with a name: force:top)");
  expect_refusal(part + "--parameter size=1",
                 "part.geo: --parameter: size is none of its parameters (those of its "
                 "DefineConstant: h)");
  expect_refusal("--mesh=Mesh0 --mesh-size=1",
                 "--mesh-size=1: no Gmsh model is among the meshes (allowed: with --mesh=" +
                     std::string(model_extensions) + ")");
  testing::write_text(bench_.path("part.geo"), "foo bar;\n");
  bench_.expect_refusal(
      "--mesh=part.geo --out=refused",
      "part.geo: Gmsh: 'part.geo', line 1: Unknown variable 'bar' (read by Gmsh ");
  // The second is wrong: nothing is kept of the first.
  testing::write_text(bench_.path("part.geo"), square);
  testing::write_text(bench_.path("exit.geo"), "Exit;\n");
  expect_refusal("--mesh=part.geo,exit.geo --role clamped=displacement",
                 "exit.geo: the model ends Gmsh (Exit)");
}

// What plans is not caught up in what it waits for.
TEST_F(ModelRuns, AnInterruptEndsThemWhileTheirModelIsMeshed) {
  testing::write_text(bench_.path("part.geo"), "For i In {1:1e12}\n  x = i;\nEndFor\n");
  std::signal(SIGINT, SIG_DFL);  // a shell's background jobs ignore it
  testing::BackgroundRun run(bench_, part + quick + "--out=o");
  std::vector<pid_t> meshgen;
  testing::wait_for([&] { return !(meshgen = testing::children_of(run.pid())).empty(); });
  const int status = run.end(SIGINT);
  EXPECT_TRUE(WIFSIGNALED(status)) << bench_.content("bg_err.txt");
  EXPECT_EQ(bench_.content("bg_out.txt"), "");
  EXPECT_FALSE(fs::exists(bench_.path("o")));
  testing::wait_for([&] { return !testing::is_there(meshgen[0]); });  // nor does that go on
}

TEST_F(ModelRuns, WithoutMeshgenOneLineSaysWhatToInstall) {
  fs::create_directory(bench_.path("bin"));
  fs::copy_file(testing::bench_executable(), bench_.path("bin/bench"));
  const auto run_without = [&](const std::string& setting) {
    const std::string command = "cd '" + bench_.path("").string() + "' && " + setting +
                                "bin/bench " + part + quick + "--out=o >out.txt 2>err.txt";
    return WEXITSTATUS(std::system(command.c_str()));
  };
  EXPECT_EQ(run_without(""), 2);
  EXPECT_EQ(bench_.content("err.txt"),
            "bench: part.geo: a Gmsh model, but there is no meshgen next to this program (Debian: "
            "install libgmsh-dev and build again, as ./run bench does)\n");
  EXPECT_FALSE(fs::exists(bench_.path("o")));
  // As ./run builds it.
  EXPECT_EQ(run_without("AIRYBENCH_BUILD_MESHGEN='ln -s " + testing::meshgen_executable().string() +
                        " bin/airybench-meshgen' "),
            0)
      << bench_.content("err.txt");
}

}  // namespace
}  // namespace airybench::model_runs_test
