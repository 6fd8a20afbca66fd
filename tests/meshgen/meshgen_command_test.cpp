// The built `meshgen`, run as a user runs it.
#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <string>

#include "mesh/msh_format.hpp"
#include "tests/support/meshgen_command.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::command_test {
namespace {

namespace fs = std::filesystem;
using testing::text_of, testing::write_text;

const std::string tooth = "--tooth --contact-edges=8 --force-edges=20 --displacement-edges=6 ";

const std::string triangle_geo = R"(
DefineConstant[ h = 1 ];
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Physical Curve("displacement") = {1, 2, 3};
Physical Surface("steel") = {1};
)";

using Outcome = testing::MeshgenOutcome;

class Command : public testing::MeshgenCommand {};

using Names = std::vector<std::string>;

TEST_F(Command, OutputThatCannotBeWrittenIsTold) {
  for (const char* arguments : {"--check", "--help", "--modify=Mesh0 --out=m.msh"}) {
    const std::string command = "cd '" + folder.path().string() + "' && '" +
                                testing::meshgen_executable().string() + "' " + arguments;
    EXPECT_EQ(exit_code_of(command + " >/dev/full 2>.err"), 2) << arguments;
    EXPECT_EQ(text_of(folder / ".err"),
              "meshgen: standard output: cannot be written (a full disk?)\n");
    EXPECT_EQ(exit_code_of(command + " >&- 2>&-"), 0) << arguments;
  }
  EXPECT_EQ(text_of(folder / "m.msh").substr(0, 12), "$MeshFormat\n");
  write_text(folder / "a.geo", triangle_geo);
  for (const char* arguments : {"--convert=a.geo --out=-", "--show=a.geo --out=-"}) {
    const std::string command = "cd '" + folder.path().string() +
                                "' && AIRYBENCH_CACHE_DIR=.cache '" +
                                testing::meshgen_executable().string() + "' " + arguments;
    EXPECT_EQ(exit_code_of(command + " >&- 2>.err"), 2) << arguments;
    EXPECT_EQ(text_of(folder / ".err"),
              "meshgen: standard output: is closed (allowed: an open one, or --out=FILE)\n");
  }
}

TEST_F(Command, ProcThatIsMissingIsTold) {
  if (testing::sanitized || exit_code_of("unshare -m true 2>/dev/null") != 0)
    GTEST_SKIP() << "needs root, to take /proc away, and a program that sanitizers let do without";
  EXPECT_EQ(exit_code_of("unshare -m sh -c \"umount -l /proc && '" +
                         testing::meshgen_executable().string() + "' --check\" 2>'" +
                         (folder / ".err").string() + "'"),
            1);
  EXPECT_EQ(text_of(folder / ".err"), "meshgen: /proc/self/exe: No such file or directory\n");
}

TEST_F(Command, NamesAreEscapedInMessagesAndKeptInMeshes) {
  const std::string name = "g\u202Ee\uFEFF";
  write_text(folder / (name + ".geo"), triangle_geo + ("Physical Curve(\"" + name + "\") = {1};"));
  const Outcome told = run("--convert='" + name + ".geo' --out='" + name + ".msh'"),
                piped = run("--convert='" + name + ".geo' --out=-");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_TRUE(told.out.starts_with("g\\u202ee\\ufeff.msh: n_phi ")) << told.out;
  EXPECT_EQ(told.err.find("\u202E"), told.err.npos) << told.err;
  EXPECT_EQ(piped.out, text_of(folder / (name + ".msh")));
  expect_refusal("--convert=" + std::string(5000, 'n') + ".geo --out=a.msh", 1, {"nnn…"});
}

TEST_F(Command, ItsCommandIsPrintedAsItWasStartedAndItsWorkGivesSignsOfLife) {
  EXPECT_NE(run("--help", "AIRYBENCH_CALLED_AS=../run").out.find("Usage: ../run meshgen "),
            std::string::npos);
  EXPECT_NE(run("--help").out.find("Usage: " + testing::meshgen_executable().string()),
            std::string::npos);
  write_text(folder / "a.geo", triangle_geo);
  const Outcome heard =
      run("--convert=a.geo --parameter=h=0.01 --out=a.msh", "AIRYBENCH_SILENT_S=0.01");
  EXPECT_EQ(heard.exit_code, 0);
  EXPECT_NE(heard.err.find("... meshgen works on a.geo, for 0 s\n"), std::string::npos)
      << heard.err;
  EXPECT_EQ(run("--convert=a.geo --out=b.msh", "AIRYBENCH_SILENT_S=600").err, "");
}

TEST_F(Command, WrongUsageIsOneLineAndExitCode2) {
  expect_refusal("", 2, {"--mesh, --check, --tooth, --convert"});
  expect_refusal("--check --mesh=Mesh0", 2, {"--mesh, --check, --tooth, --convert"});
  expect_refusal("--fancy", 2, {"--fancy", "valid:", "--mesh", "--convert"});
  expect_refusal("--convrt=a.geo", 2, {"--convrt=a.geo, perhaps --convert (valid: "});
  expect_refusal("Mesh0", 2, {"Mesh0", "valid:", "--mesh"});
  expect_refusal("--mesh", 2, {"--mesh", "valid:"});
  expect_refusal("--mesh=Mesh8", 2, {"'Mesh8'", "valid: Mesh0..Mesh7"});
  expect_refusal("--mesh=Mesh3..Mesh0", 2, {"'Mesh3..Mesh0'", "valid: Mesh0..Mesh7"});
  expect_refusal("--mesh=Mesh0,", 2, {"''", "valid: Mesh0..Mesh7"});
  expect_refusal("--mesh='Rack*'", 2, {"'Rack*'", "valid: Mesh0..Mesh7"});
  expect_refusal("--mesh=own.msh", 2, {"'own.msh'", "Mesh0..Mesh7"});
  expect_refusal("--check --out=x.msh", 2, {"--out", "--check"});
  expect_refusal("--check --teeth=2", 2, {"--teeth", "--tooth"});
  expect_refusal("--convert=a.geo", 2, {"--out"});
  expect_refusal("--convert=a.geo --out=b.txt", 2, {"'b.txt'", ".msh"});
  expect_refusal("--convert=a.geo --out=b.msh --role clamped", 2,
                 {"--role: clamped (allowed: NAME="});
  expect_refusal("--check --role a=force", 2, {"--role", "--convert"});
  expect_refusal("--tooth --out=-", 2, {"'-'", ".msh"});
  expect_refusal("--tooth --out=a.msh --force-edges=9", 2, {"--contact-edges"});
  expect_refusal("--modify=Mesh0", 2, {"--out is missing"});
  expect_refusal("--modify=Mesh0..Mesh2 --out=a.msh", 2, {"'Mesh0..Mesh2' are 3 meshes"});
  expect_refusal("--modify=Mesh8 --out=a.msh", 2, {"'Mesh8'", "valid: Mesh0..Mesh7"});
  expect_refusal("--check --refine=2", 2, {"--refine", "--modify"});
  EXPECT_EQ(files(), Names{});
}

TEST_F(Command, BadNumbersAreRefused) {
  expect_refusal(tooth + "--out=a.msh --teeth=two", 2, {"--teeth", "two"});
  expect_refusal(tooth + "--out=a.msh --teeth=0", 2, {"--teeth", "0", "1 to 1000000"});
  expect_refusal(tooth + "--out=a.msh --vertices=-5", 2, {"--vertices", "-5", "1 to 1000000"});
  expect_refusal(tooth + "--out=a.msh --vertices=10", 2, {"vertices: 10", "34"});
  expect_refusal(tooth + "--out=a.msh --length=0", 2, {"length is 0 mm", "positive"});
  expect_refusal(tooth + "--out=a.msh --length=nan", 2, {"length is nan mm", "positive"});
  expect_refusal(tooth + "--out=a.msh --teeth=3 --pitch=9", 2, {"pitch is 9 mm", "10"});
  expect_refusal(tooth + "--out=a.msh --teeth=9", 2, {"contact edges: 8", "9"});
  for (const auto& [edges, triangles] :
       {std::pair("--contact-edges=1000000 --displacement-edges=6", "about 2e+11 "),
        {"--contact-edges=8 --displacement-edges=1000000", "about 1e+11 "}})
    expect_refusal(fmt::format("--tooth --force-edges=20 --out=a.msh {}", edges), 2,
                   {triangles, "triangles with so many edges on tips and held face (allowed: "});
  const std::string modify = "--modify=Mesh0 --out=a.msh ";
  expect_refusal(modify + "--refine=7", 2, {"refine: 7 (allowed: a whole number from 0 to 6)"});
  expect_refusal(modify + "--refine=1.5", 2, {"--refine", "1.5"});
  expect_refusal(modify + "--grade=1,2", 2, {"--grade", "3 required"});
  expect_refusal(modify + "--slivers=10,2.5", 2, {"--slivers: 2.5: a whole number"});
  expect_refusal(modify + "--stretch=1,0", 2, {"stretch: [1, 0] (allowed: two numbers > 0)"});
  expect_refusal(modify + "--stretch=1,1e-14", 2, {"stretch: [1, 1e-14] cannot be: Mesh0: tri"});
  expect_refusal(modify + "--keep-contact-edges=11", 2, {"keep_contact_edges: 11", "has 10"});
  expect_refusal(modify + "--layers=0,0,2", 2, {"normal: [0, 0]"});
  EXPECT_EQ(files(), Names{});
}

TEST_F(Command, MeshThatCannotBeMadeLeavesTheOldFile) {
  write_text(folder / "old.msh", "old");
  expect_refusal(tooth + "--out=old.msh --vertices=34", 1, {"34 vertices", "nearest"});
  expect_refusal("--convert=no.geo --out=old.msh", 1, {"no.geo: cannot be opened"});
  expect_refusal("--modify=no.msh --out=old.msh", 1, {"no.msh: cannot be opened"});
  expect_refusal("--modify=Mesh0 --scale=-1 --out=old.msh", 2, {"scale: -1 (allowed: > 0)"});
  EXPECT_EQ(text_of(folder / "old.msh"), "old");
  EXPECT_EQ(files(), Names{"old.msh"});
}

TEST_F(Command, FileThatCannotBeWritten) {
  expect_refusal(tooth + "--out=nowhere/a.msh", 1,
                 {"nowhere/a.msh: cannot be written: No such file or directory"});
  fs::create_directory(folder / "taken.msh");
  expect_refusal(tooth + "--out=taken.msh", 1, {"taken.msh: is no regular file"});
  EXPECT_EQ(files(), Names{"taken.msh"});
}

TEST_F(Command, ToothOfOwnDimensions) {
  const Outcome outcome = run(tooth + "--out=own.msh --vertices=90 --length=12");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Mesh mesh = read_msh(folder / "own.msh");
  EXPECT_EQ(mesh.vertices.size(), 90u);
  EXPECT_EQ(mesh.vertices[10], Eigen::Vector2d(12, -3));
  EXPECT_NE(outcome.out.find("own.msh: n_phi 503, n_f 80, n_C 32;"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(files(), Names{"own.msh"});
}

TEST_F(Command, RackOfOwnDimensions) {
  const Outcome outcome =
      run("--tooth --teeth=2 --contact-edges=6 --force-edges=30 --displacement-edges=5 --pitch=14 "
          "--block-depth=3 --root-half-height=6 --tip-half-height=2 --out=rack.msh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Mesh mesh = read_msh(folder / "rack.msh");
  double left = 0, top = 0;
  for (const auto& vertex : mesh.vertices) {
    left = std::min(left, vertex.x());
    top = std::max(top, vertex.y());
  }
  EXPECT_EQ(left, -3);
  EXPECT_EQ(top, 28);
}

TEST_F(Command, ConvertsAModel) {
  write_text(folder / "square.geo", triangle_geo);
  const Outcome outcome = run("--convert=square.geo --out=square.msh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_msh(folder / "square.msh").body_names, Names{"steel"});
  EXPECT_EQ(files(), (Names{"square.geo", "square.msh"}));
  const Outcome to_stdout = run("--convert=square.geo --out=-");
  EXPECT_EQ(to_stdout.exit_code, 0);
  EXPECT_EQ(to_stdout.out, text_of(folder / "square.msh"));
}

TEST_F(Command, ConvertedMeshesAreKeptByContent) {
  const auto cached = [&] {
    std::vector<fs::path> found;
    if (fs::exists(folder / ".cache"))
      for (const auto& entry : fs::directory_iterator(folder / ".cache")) found.push_back(entry);
    return found;
  };
  const auto vertices = [&](const std::string& options) {
    EXPECT_EQ(run("--convert=a.geo --out=a.msh " + options).exit_code, 0);
    return read_msh(folder / "a.msh").vertices.size();
  };
  write_text(folder / "size.geo", "DefineConstant[ h = 0.5 ];\n");
  write_text(folder / "a.geo", "Include \"size.geo\";\n" + triangle_geo);
  const std::size_t coarse = vertices("");
  ASSERT_EQ(cached().size(), 1u);
  const fs::path first = cached().front();
  // What is there is taken, whatever it is, if only it is a mesh.
  fs::copy_file(testing::mesh_file("Mesh0"), first, fs::copy_options::overwrite_existing);
  EXPECT_EQ(vertices(""), 134u);
  write_text(first, text_of(first).substr(0, 999));  // torn
  EXPECT_EQ(vertices(""), coarse);
  EXPECT_EQ(text_of(first), text_of(folder / "a.msh"));
  // Another option, another text, another included text: another mesh.
  EXPECT_GT(vertices("--parameter h=0.1"), coarse);
  EXPECT_EQ(cached().size(), 2u);
  write_text(folder / "size.geo", "DefineConstant[ h = 0.2 ];\n");
  EXPECT_GT(vertices(""), coarse);
  EXPECT_EQ(cached().size(), 3u);
  write_text(folder / "a.geo", "h = 0.2; r = Rand(1);\n" + triangle_geo);  // depends on chance
  vertices("");
  EXPECT_EQ(cached().size(), 3u);
}

TEST_F(Command, NotesAreKeptWithTheirMesh) {
  fs::copy_file(testing::test_data("models/numbers.geo"), folder / "a.geo");
  for (int k = 0; k < 2; ++k) {
    const Outcome outcome = run("--convert=a.geo --role=3=displacement --out=a.msh");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err,
              "note: a.geo: no role is given to its curves 1, 2, 4: they are free (force)\n");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / ".cache"), {}), 2);
}

TEST_F(Command, ShowsTheCurvesOfAModel) {
  fs::copy_file(testing::test_data("models/names.geo"), folder / "a.geo");
  const Outcome outcome = run("--show=a.geo --role=Support=displacement");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out,
            "  curve  names    role          length mm  from     by        to\n"
            "  1      Sole     force         10         (0, 0)   (5, 0)    (10, 0)\n"
            "  2      7        force         5.385      (10, 0)  (9, 2.5)  (8, 5)\n"
            "  3      Support  displacement  6          (8, 5)   (5, 5)    (2, 5)\n"
            "  4      -        force         5.385      (2, 5)   (1, 2.5)  (0, 0)\n"
            "picture: a.png\n");
  EXPECT_TRUE(text_of(folder / "a.png").starts_with("\x89PNG"));
  expect_refusal("--show=a.geo --out=a.pdf", 2, {"'a.pdf'", ".png"});
  expect_refusal("--show=none.geo", 1, {"none.geo: no such file"});
}

TEST_F(Command, AnUnusableCacheStopsNothing) {
  write_text(folder / "a.geo", triangle_geo);
  const Outcome outcome = run("--convert=a.geo --out=a.msh",
                              "AIRYBENCH_CACHE_DIR='" + (folder / "a.geo").string() + "'");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.err.starts_with("note: the mesh is not kept for next time: ")) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(run("--convert=a.geo --out=b.msh", "AIRYBENCH_CACHE_DIR= XDG_CACHE_HOME= HOME=").err,
            "");
  EXPECT_EQ(run("--convert=a.geo --out=b.msh",
                "AIRYBENCH_CACHE_DIR= XDG_CACHE_HOME='" + (folder / ".xdg").string() + "'")
                .err,
            "");
  EXPECT_TRUE(fs::exists(folder / ".xdg" / "airybench"));
}

TEST_F(Command, AModelStartsNoPrograms) {
  write_text(folder / "a.geo", "SystemCall \"touch started\";\n" + triangle_geo);
  expect_refusal("--convert=a.geo --out=a.msh", 1,
                 {"a.geo: Gmsh: ", "a model may start no programs"});
  write_text(folder / "a.geo", triangle_geo + "Field[1] = ExternalProcess;\n");
  expect_refusal("--convert=a.geo --out=a.msh", 1, {"a.geo: a field ExternalProcess"});
  EXPECT_EQ(files(), Names{"a.geo"});
}

TEST_F(Command, WhatEndsGmshOrNeverEndsItIsToldInOneLine) {
  write_text(folder / "exit.geo", "Exit;\n");
  expect_refusal("--convert=exit.geo --out=a.msh", 1, {"exit.geo: the model ends Gmsh (Exit)"});
  write_text(folder / "crossed.geo", R"(
Point(1) = {0, 0, 0, 1}; Point(2) = {4, 4, 0, 1}; Point(3) = {4, 0, 0, 1}; Point(4) = {0, 4, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Physical Curve("displacement") = {1:4}; Physical Surface("a") = {1};
)");
  expect_refusal("--convert=crossed.geo --out=a.msh", 1,
                 {"crossed.geo: curves 1 and 3 around surface 1 cross"});
  EXPECT_EQ(files(), (Names{"crossed.geo", "exit.geo"}));
}

// By another version of Gmsh they may be meshed as they are.
TEST_F(Command, AModelThatCrashesGmshIsMeshedByAnotherAlgorithm) {
  for (const char* name : {"packing", "packed_surface"}) {
    const fs::path model = testing::test_data(fmt::format("models/{}.geo", name));
    const Outcome outcome = run("--convert='" + model.string() + "' --out=a.msh");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_GT(read_msh(folder / "a.msh").triangles.size(), 10u);
    if (std::string(GMSH_API_VERSION).starts_with("4.8")) {
      EXPECT_NE(outcome.err.find(model.string() + ": Gmsh 4.8.4 crashed while it meshed with "
                                                  "Mesh.Algorithm="),
                std::string::npos)
          << outcome.err;
      EXPECT_NE(outcome.err.find(" (SIGSEGV): meshed with 6\n"), std::string::npos) << outcome.err;
    }
  }
}

TEST_F(Command, WhatAModelWritesGoesNowhere) {
  write_text(folder / "writes.geo",
             "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 4, 2};\n"
             "Mesh 2; Save \"part.msh\"; Printf(\"hello\") > \"note.txt\";\n");
  const Outcome outcome = run("--convert=writes.geo --role=1=displacement --out=a.msh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(folder / "a.msh"));
  for (const char* written : {"part.msh", "note.txt"})
    EXPECT_FALSE(fs::exists(folder / written)) << written;
}

TEST_F(Command, SyntaxOfALaterGmshIsToldWithTheVersionAndTheLine) {
  const std::string convert = "--out=a.msh --convert='" + testing::test_data("models").string();
  expect_refusal(convert + "/newer.geo'", 1,
                 {"newer.geo', line 7: syntax error (Curve) (read by Gmsh 4."});
  expect_refusal(
      convert + "/newer_option.geo'", 1,
      {"'Mesh.FromLaterVersions' in line 7 (read by Gmsh 4.", "a newer one may know it"});
}

TEST_F(Command, FileOfOptionsNextToAModelIsOfItsMesh) {
  const auto vertices = [&](const char* options) {
    if (options != nullptr) write_text(folder / "a.geo.opt", options);
    EXPECT_EQ(run("--convert=a.geo --out=a.msh").exit_code, 0);
    return read_msh(folder / "a.msh").vertices.size();
  };
  write_text(folder / "a.geo", triangle_geo);
  const std::size_t coarse = vertices(nullptr);
  const std::size_t fine = vertices("Mesh.MeshSizeFactor = 0.2;\n");
  EXPECT_GT(fine, 4 * coarse);
  EXPECT_GT(vertices("Mesh.MeshSizeFactor = 0.1;\n"), 2 * fine);
  write_text(folder / "a.geo.opt", "SystemCall \"touch started\";\n");
  expect_refusal("--convert=a.geo --out=a.msh", 1, {"a model may start no programs"});
}

}  // namespace
}  // namespace airybench::command_test
