// What asks for more memory or time than a file of its length is worth is refused, in one line.
#include <fmt/format.h>

#include "tests/support/meshgen_command.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::limits_test {
namespace {

class Limits : public testing::MeshgenCommand {
 protected:
  void expect_refused(const std::string& name, const std::string& text, const std::string& why,
                      const std::string& options = "") const {
    testing::write_text(folder / name, text);
    expect_refusal(fmt::format("--convert={} --out=out.msh {}", name, options), 1, {why.c_str()});
    EXPECT_EQ(files(), std::vector<std::string>{name});
    std::filesystem::remove(folder / name);
  }
};

TEST_F(Limits, ListsOfNumbersAreCounted) {
  constexpr const char* why = "part.geo: a list of the numbers 0 to 1e+12 (allowed: up to 1e7 ";
  expect_refused("part.geo", "x[] = {0:1e12};\n", why);
  expect_refused("part.geo", "x[] = {0 : 1e+12 : 2.5};\n", why);
  expect_refused("part.geo", "If (0)\n  x[] = {1, -0:1E12};\nEndIf\n", "-0 to 1e+12");
  expect_refused("part.geo", "x[] = {0 : 1e6 : 1e-9};\n", "a list of the numbers 0 to 1e+06 ");
  // A loop takes time alone, and this list is short.
  expect_refused("part.geo", "For i In {1:1e12}\n  x[] = {0:1e12:1e11};\nEndFor\n",
                 "part.geo: reading it took more than 0.2 s (more with --model-time=SECONDS)",
                 "--model-time=0.2");
}

TEST_F(Limits, MemoryThatAModelTakesIsWatched) {
  expect_refused(
      "part.geo", "n = 4e9;\nx[] = {0:n};\n",
      "part.geo: reading it took more than 500 MiB of memory (more with --model-memory=MIB)",
      "--model-memory=500");
}

TEST_F(Limits, CountsAreThoseOfTheFilesLength) {
  expect_refused("part.vtk",
                 "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                 "POINTS 400000000 double\n0 0 0\n",
                 "part.vtk: line 5: POINTS 400000000 (allowed: up to 91, the file's bytes)");
  expect_refused("part.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n99999999999999999999\n",
                 "part.msh: line 5: $Nodes 99999999999999999999 (allowed: up to 63, ");
  expect_refused("part.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 400000000 1 3\n",
                 "part.msh: line 5: $Nodes 400000000 (allowed: up to ");
  expect_refused("part.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 400000000\n0 0 0 1\n",
                 "part.mesh: line 3: Vertices 400000000 (allowed: up to ");
  for (const std::string type : {"11", "41"})  // a beam and a triangle
    expect_refused(
        "part.unv",
        "-1\n2412\n1 21 1 0 7 2\n0 0 0\n1 2\n2 " + type + " 1 0 7 400000000\n1 2 3\n-1\n",
        "part.unv: line 6: an element of 400000000 nodes (allowed: up to ");
  expect_refused("part.stl", std::string(80, '\0') + std::string(4, '\xff') + "nothing",
                 "part.stl: 4294967295 facets (allowed: up to 0, by its length)");
}

TEST_F(Limits, APackedFileOfBlanksIsRefused) {
  ASSERT_EQ(exit_code_of("head -c 90000000 /dev/zero | tr '\\0' ' ' | gzip -1 > '" +
                         (folder / "part.msh.gz").string() + "'"),
            0);
  expect_refusal("--convert=part.msh.gz --out=out.msh", 1,
                 {"part.msh.gz: unpacks to more than 200 times its length (allowed: up to that)"});
}

class LongScript : public Limits {
 protected:
  // part.geo.gz, of so many signs; returns the complaint about it.
  std::string complaint(int signs, const std::string& limit = "") const {
    EXPECT_EQ(exit_code_of(fmt::format(
                  "{}cd '{}' && head -c {} /dev/zero | tr '\\0' ';' | gzip -1 "
                  ">part.geo.gz && '{}' --convert=part.geo.gz --out=x.msh 2>.err",
                  limit, folder.path().string(), signs, testing::meshgen_executable().string())),
              1);
    return without_signs_of_life(testing::text_of(folder / ".err"));
  }
};

TEST_F(LongScript, IsRefusedByTheCountOfItsWords) {
  EXPECT_EQ(complaint(31'000'000),
            "meshgen: part.geo.gz: more words and signs than 3e7 (allowed: up to that)\n");
}

TEST_F(LongScript, ForWhichThereIsNoMemoryIsNamed) {
  if (testing::sanitized) GTEST_SKIP() << "sanitizers take more address space than there is";
  EXPECT_EQ(complaint(29'000'000, "ulimit -v 900000; "), "meshgen: part.geo.gz: out of memory\n");
}

const std::string plate =
    "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 0., 1.\n*ELEMENT, TYPE=CPE3, ELSET=E\n1, 1, 2, 3\n";

TEST_F(Limits, SetsThatDoubleEachOtherAreRefused) {
  std::string text = plate + "*NSET, NSET=S0\n1, 2, 3\n";
  for (int k = 1; k < 60; ++k) text += fmt::format("*NSET, NSET=S{0}\nS{1}, S{1}\n", k, k - 1);
  const std::string why = "all sets together have more than 1e7 members (allowed: up to that)";
  expect_refused("part.inp", text, why);
  testing::write_text(folder / "part.inp", text);
  expect_refusal("--scene=part.inp", 1, {"part.inp: line ", why.c_str()});
}

TEST_F(Limits, InstancesOfAPartAreCounted) {
  std::string part = "*PART, NAME=p\n" + plate + "*NSET, NSET=S\n", instances;
  for (int k = 0; k < 4000; ++k) {
    part += "1, 2, 3\n";
    instances += fmt::format("*INSTANCE, NAME=i{}, PART=p\n*END INSTANCE\n", k);
  }
  expect_refused(
      "part.inp", part + "*END PART\n" + instances,
      "part.inp: more lines, with included files and every instance of a part, than 1e7");
}

TEST_F(Limits, SizesThatWouldOverflowAreRefused) {
  const std::string square =
      "Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {1, 1, 0, 1};\n"
      "Point(4) = {0, 1, 0, 1}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};\n"
      "Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};\n"
      "Physical Curve(\"displacement\") = {1};\n";
  expect_refused("part.geo", square,
                 "part.geo: about 2e+18 triangles: --mesh-size (allowed: up to ",
                 "--mesh-size=1e-9");
  expect_refused("part.geo", square + "Mesh.MeshSizeMax = 1e-5;\n",
                 "part.geo: about 2e+10 triangles: its Mesh.MeshSizeMax (allowed: up to 2e+07)");
}

// Its box has a thousand times the area of the bent strip.
TEST_F(Limits, TrianglesAreThoseOfTheBody) {
  testing::write_text(folder / "part.geo",
                      "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 2000, 1};\n"
                      "Rectangle(2) = {0, 0, 0, 1, 2000}; BooleanUnion{ Surface{1}; Delete; }"
                      "{ Surface{2}; Delete; }\nMesh.MeshSizeMax = 0.5;\n"
                      "Physical Curve(\"displacement\") = Boundary{ Surface{:}; };\n");
  const testing::MeshgenOutcome outcome = run("--convert=part.geo --out=out.msh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("triangles"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace airybench::limits_test
