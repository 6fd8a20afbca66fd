#include "mesh/msh_format.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/complaint.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::msh_format_test {
namespace {

// A unit square as Gmsh 4.8.4 wrote it in MSH 2.2, with its own numbers of the physical groups; and
// as we write it.
const std::string plate = testing::text_of(testing::test_data("mesh/plate.msh")),
                  canonical_plate =
                      testing::text_of(testing::test_data("mesh/plate_canonical.msh"));

// The plate with its one line `from` (without line end) turned into `to`.
std::string plate_with(const std::string& from, const std::string& to) {
  const auto at = plate.find("\n" + from + "\n");
  if (at == plate.npos) throw std::logic_error("no line '" + from + "' in the plate");
  std::string text = plate;
  return text.replace(at + 1, from.size(), to);
}

Mesh read(const std::string& text) {
  std::istringstream in(text);
  return read_msh(in, "some/plate.msh");
}

std::string complaint(const std::string& text) {
  return testing::complaint_of<MeshError>([&] { read(text); });
}

std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

TEST(ReadMsh, TheSameInAnotherSpelling) {
  for (const std::string& text :
       {replaced_all(plate, "\n", "\r\n"),          // line ends of other systems
        plate_with("3 1 1 0", "\n   3\t1  1 0  "),  // blanks and a blank line
        replaced_all(replaced_all(plate, "\n5 0.5", "\n5000000 0.5"), " 5\n", " 5000000\n")})
    EXPECT_EQ(msh_text(read(text)), msh_text(read(plate))) << text;
}

TEST(ReadMsh, SeveralBodies) {
  std::string text = plate_with("2 21 \"steel\"", "2 21 \"steel\"\n2 7 \"cast iron\"");
  text.replace(text.find("\n4\n"), 3, "\n5\n");
  text.replace(text.find("8 2 2 21"), 8, "8 2 2 7");
  const Mesh mesh = read(text);
  EXPECT_EQ(mesh.body_names, (std::vector<std::string>{"steel", "cast iron"}));
  EXPECT_EQ(mesh.triangle_body, (std::vector{0, 0, 0, 1}));
}

struct Change {
  std::string from, to;  // lines of the plate
  int line;              // 0: of none, the triangulation is wrong
  std::string named;
};

TEST(ReadMsh, RefusesInOneLineWithFileAndPlace) {
  const std::string last = "8 2 2 21 1 3 4 5", more = "$EndElements\n$Periodic\n0\n$EndPeriodic";
  const std::vector<Change> changes = {
      {"2.2 0 8", "4.1 0 8", 2, "only MSH 2 in ASCII"},
      {"2.2 0 8", "2.2 1 8", 2, "only MSH 2 in ASCII"},
      {"2.2 0 8", "two 0 8", 2, "'two 0 8'"},
      {"$PhysicalNames", "$Periodic", 4, "'$Periodic'"},
      {"1 13 \"contact\"", "1 13 \"glue\"", 8, "'glue': unknown boundary role"},
      {"1 13 \"contact\"", "1 13 \"contact:\"", 8, "'contact:': unknown boundary role"},
      {"2 21 \"steel\"", "3 21 \"steel\"", 9, "'steel' of dimension 3"},
      {"1 12 \"force\"", "1 11 \"force\"", 7, "physical curve 11 is named twice"},
      {"1 13 \"contact\"", "2 21 \"iron\"", 9, "physical surface 21 is named twice"},
      {"1 12 \"force\"", "1 12 force", 7, "found 'force'"},
      {"5", "-5", 12, "the number of nodes"},
      {"5", "five", 12, "the number of nodes expected, found 'five'"},
      {"3 1 1 0", "3 1 here 0", 15, "node 3: y, a number, expected, found 'here 0'"},
      {"3 1 1 0", "3 1mm 1 0", 15, "node 3: x, a number, expected, found '1mm 1 0'"},
      {"3 1 1 0", "3 1 1", 15, "node 3: z, a number, expected, found ''"},
      {"3 1 1 0", "3 nan 1 0", 15, "node 3: coordinates"},
      {"3 1 1 0", "3 1 -inf 0", 15, "node 3: coordinates"},
      {"1 0 0 0", "1 0 0 inf", 13, "node 1: coordinates"},
      {"3 1 1 0", "3 1e999 1 0", 15, "node 3: x, a number, expected, found '1e999 1 0'"},
      {"4 0 1 0", "3 0 1 0", 16, "node 3 is given twice"},
      {"4 0 1 0", "4 0 1 0 7", 16, "unexpected '7'"},
      {"5", "6", 18, "found '$EndNodes'"},
      {"5", "4", 17, "$EndNodes expected"},
      {last, "8 3 2 21 1 3 4 5 2", 28, "element 8: type 3"},
      {last, "8 2 0 3 4 5", 28, "element 8: needs a first tag"},
      {"1 1 2 12 1 1 2", "1 1 2 21 1 1 2", 21, "physical group 21 is no boundary role"},
      {last, "8 2 2 12 1 3 4 5", 28, "physical group 12 is no named body"},
      {last, "8 2 2 21 1 3 4 6", 28, "element 8: node 6"},
      {last, "8 2 2 21 1 3 4", 28, "element 8: a node's number"},
      {last, "8 2 2 21 1 3 4 5 1", 28, "unexpected '1'"},
      {"$EndElements", more, 30, "unexpected section"},
      {"$EndElements", std::string("$EndElements\n\0", 14), 30, "unexpected section"},
      {last, "8 2 2 21 1 4 3 5", 0, "triangle 4 at [0.5, 0.833333]: inverted"},
      {"2 1 2 13 2 2 3", "2 1 2 13 2 3 2", 0, "boundary edge 3-2 at [1, 0.5]: walked clockwise"},
      {"2 1 2 13 2 2 3", "2 1 2 13 2 1 2", 0, "boundary edge 1-2 at [0.5, 0]: given twice"},
  };
  for (const auto& [from, to, line, named] : changes) {
    const std::string place = line > 0 ? ":" + std::to_string(line) : "";
    testing::expect_named(complaint(plate_with(from, to)),
                          {"some/plate.msh" + place + ": ", named});
  }
  testing::expect_named(complaint(""), {"some/plate.msh:0: ", "$MeshFormat", "truncated"});
  for (const std::string& text : {std::string("solid tooth\n"), std::string("\x7f"
                                                                            "ELF\x02\x01\0\0\n",
                                                                            9)})
    testing::expect_named(complaint(text), {"some/plate.msh:1: not a mesh file"});
}

TEST(ReadMsh, TruncatedAnywhereIsRefused) {
  const std::string last_needed = "$EndElements";
  for (std::size_t length = 0; length < plate.find(last_needed) + last_needed.size(); ++length) {
    const std::string what = complaint(plate.substr(0, length));
    EXPECT_TRUE(what.starts_with("some/plate.msh:")) << length << ": " << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

TEST(ReadMsh, WhatIsNoFileIsTold) {
  const auto complaint_about = [](const std::string& path) {
    return testing::complaint_of<MeshError>([&] { read_msh(path); });
  };
  EXPECT_EQ(complaint_about("/nowhere/Mesh0.msh"),
            "/nowhere/Mesh0.msh: cannot be opened: No such file or directory");
  EXPECT_EQ(complaint_about(testing::mesh_folder()),
            testing::mesh_folder().string() + ": a folder, not a file");
}

TEST(WriteMsh, CanonicalText) { EXPECT_EQ(msh_text(read(plate)), canonical_plate); }

// Tags in any order; a group without edges, "force:unused", is not written.
TEST(WriteMsh, NamedBoundaryGroupsComeBack) {
  std::string text = plate_with("4", "7");
  const auto put = [&](const std::string& from, const std::string& to) {
    text = replaced_all(text, "\n" + from + "\n", "\n" + to + "\n");
  };
  put("1 13 \"contact\"",
      "1 13 \"contact\"\n1 9 \"force:top\"\n1 8 \"displacement:held: left\"\n1 7 \"force:unused\"");
  put("3 1 2 12 3 3 4", "3 1 2 9 3 3 4");
  put("4 1 2 11 4 4 1", "4 1 2 8 4 4 1");
  const Mesh mesh = read(text);
  std::vector<std::string> labels;
  for (const BoundaryEdge& edge : mesh.boundary) labels.push_back(boundary_label(mesh, edge));
  EXPECT_EQ(labels,
            (std::vector<std::string>{"force", "contact", "force:top", "displacement:held: left"}));
  EXPECT_EQ(mesh.boundary[3].role, BoundaryRole::displacement);
  const std::string canonical = msh_text(mesh);
  EXPECT_NE(canonical.find(R"($PhysicalNames
6
1 1 "displacement"
1 2 "force"
1 3 "contact"
1 4 "displacement:held: left"
1 5 "force:top"
2 6 "steel"
$EndPhysicalNames)"),
            std::string::npos)
      << canonical;
  EXPECT_EQ(msh_text(read(canonical)), canonical);
}

TEST(WriteMsh, CoordinatesComeBackAsTheSameDoubles) {
  Mesh mesh = read(plate);
  mesh.vertices[4] = {1.0 / 3, 0.1 + 0.2};
  mesh.vertices[0] = {-1e-17, 6.02214076e-23};
  const Mesh again = read(msh_text(mesh));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_EQ(again.vertices[v], mesh.vertices[v]);
  EXPECT_EQ(msh_text(again), msh_text(mesh));
}

TEST(WriteMsh, CatalogueFileComesBackByteForByte) {
  for (const char* name : {"Mesh0", "Mesh4"}) {
    const std::string bytes = testing::text_of(testing::mesh_file(name));
    ASSERT_FALSE(bytes.empty()) << name;
    EXPECT_TRUE(msh_text(testing::catalogue_mesh(name)) == bytes) << name;
  }
}

}  // namespace
}  // namespace airybench::msh_format_test
