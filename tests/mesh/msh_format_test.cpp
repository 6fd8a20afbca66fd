#include "mesh/msh_format.hpp"
#include "tests/support/places.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace airybench::msh_format_test {
namespace {

// A unit square as Gmsh 4.8.4 wrote it in MSH 2.2: its own numbers of the physical groups.
const std::string plate = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
1 11 "displacement"
1 12 "force"
1 13 "contact"
2 21 "steel"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0.5 0.5 0
$EndNodes
$Elements
8
1 1 2 12 1 1 2
2 1 2 13 2 2 3
3 1 2 12 3 3 4
4 1 2 11 4 4 1
5 2 2 21 1 1 2 5
6 2 2 21 1 4 1 5
7 2 2 21 1 2 3 5
8 2 2 21 1 3 4 5
$EndElements
)";

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
  try {
    read(text);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(ReadMsh, FileWrittenByGmsh) {
  const Mesh mesh = read(plate);
  EXPECT_EQ(mesh.name, "plate");
  ASSERT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[4], Eigen::Vector2d(0.5, 0.5));
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.triangles[1], (std::array{3, 0, 4}));
  EXPECT_EQ(mesh.body_names, std::vector<std::string>{"steel"});
  ASSERT_EQ(mesh.boundary.size(), 4u);
  EXPECT_EQ(mesh.boundary[1].vertices, (std::array{1, 2}));
  EXPECT_EQ(mesh.boundary[0].role, BoundaryRole::force);
  EXPECT_EQ(mesh.boundary[1].role, BoundaryRole::contact);
  EXPECT_EQ(mesh.boundary[3].role, BoundaryRole::displacement);
}

TEST(ReadMsh, LineEndsOfOtherSystems) {
  std::string text;
  for (const char c : plate) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(msh_text(read(text)), msh_text(read(plate)));
}

TEST(ReadMsh, BlankLinesAndBlanks) {
  EXPECT_EQ(msh_text(read(plate_with("3 1 1 0", "\n   3\t1  1 0  "))), msh_text(read(plate)));
}

TEST(ReadMsh, SparseNodeNumbers) {
  std::string text = plate;
  for (const auto& [from, to] :
       {std::pair("\n5 0.5 0.5 0", "\n5000000 0.5 0.5 0"), std::pair(" 1 2 5\n", " 1 2 5000000\n"),
        std::pair(" 4 1 5\n", " 4 1 5000000\n"), std::pair(" 2 3 5\n", " 2 3 5000000\n"),
        std::pair(" 3 4 5\n", " 3 4 5000000\n")})
    text.replace(text.find(from), std::string(from).size(), to);
  EXPECT_EQ(msh_text(read(text)), msh_text(read(plate)));
}

TEST(ReadMsh, SeveralBodies) {
  std::string text = plate_with("2 21 \"steel\"", "2 21 \"steel\"\n2 7 \"cast iron\"");
  text.replace(text.find("\n4\n"), 3, "\n5\n");
  text.replace(text.find("8 2 2 21"), 8, "8 2 2 7");
  const Mesh mesh = read(text);
  EXPECT_EQ(mesh.body_names, (std::vector<std::string>{"steel", "cast iron"}));
  EXPECT_EQ(mesh.triangle_body, (std::vector{0, 0, 0, 1}));
}

struct BadFile {
  const char* title;
  std::string text;
  std::string complaint;
};
void PrintTo(const BadFile& file, std::ostream* out) { *out << file.title; }

class ReadMshRefuses : public ::testing::TestWithParam<BadFile> {};

TEST_P(ReadMshRefuses, InOneLineWithFileAndPlace) {
  EXPECT_EQ(complaint(GetParam().text), "some/plate.msh" + GetParam().complaint);
}

INSTANTIATE_TEST_SUITE_P(
    Injected, ReadMshRefuses,
    ::testing::Values(
        BadFile{"Empty", "", ":0: the file ends where $MeshFormat should come; is it truncated?"},
        BadFile{"NotAMeshFile", "solid tooth\n",
                ":1: not a mesh file: the first line must be $MeshFormat"},
        BadFile{"BinaryRubbish",
                std::string("\x7f"
                            "ELF\x02\x01\0\0\n",
                            9),
                ":1: not a mesh file: the first line must be $MeshFormat"},
        BadFile{"Msh4", plate_with("2.2 0 8", "4.1 0 8"),
                ":2: only MSH 2 in ASCII is read here; convert with `meshgen --convert`"},
        BadFile{"Binary", plate_with("2.2 0 8", "2.2 1 8"),
                ":2: only MSH 2 in ASCII is read here; convert with `meshgen --convert`"},
        BadFile{"VersionIsAWord", plate_with("2.2 0 8", "two 0 8"),
                ":2: the format's version expected, found 'two 0 8'"},
        BadFile{"NoPhysicalNames", plate_with("$PhysicalNames", "$Periodic"),
                ":4: $PhysicalNames expected, found '$Periodic'"},
        BadFile{"UnknownRole", plate_with("1 13 \"contact\"", "1 13 \"glue\""),
                ":8: physical curve 'glue': unknown boundary role (allowed: displacement, force, "
                "contact, or one of these with a name: force:top)"},
        BadFile{"RoleWithoutItsName", plate_with("1 13 \"contact\"", "1 13 \"contact:\""),
                ":8: physical curve 'contact:': unknown boundary role (allowed: displacement, "
                "force, contact, or one of these with a name: force:top)"},
        BadFile{
            "PhysicalVolume", plate_with("2 21 \"steel\"", "3 21 \"steel\""),
            ":9: physical group 'steel' of dimension 3 (allowed: 1, boundary roles; 2, bodies)"},
        BadFile{"RoleNumberTwice", plate_with("1 12 \"force\"", "1 11 \"force\""),
                ":7: physical curve 11 is named twice"},
        BadFile{"BodyNumberTwice", plate_with("1 13 \"contact\"", "2 21 \"iron\""),
                ":9: physical surface 21 is named twice"},
        BadFile{"NameWithoutQuotes", plate_with("1 12 \"force\"", "1 12 force"),
                ":7: a name in double quotes expected, found 'force'"},
        BadFile{"NegativeCount", plate_with("5", "-5"),
                ":12: the number of nodes must not be negative"},
        BadFile{"CountIsAWord", plate_with("5", "five"),
                ":12: the number of nodes expected, found 'five'"},
        BadFile{"CoordinateIsAWord", plate_with("3 1 1 0", "3 1 here 0"),
                ":15: node 3: y, a number, expected, found 'here 0'"},
        BadFile{"CoordinateRunsIntoText", plate_with("3 1 1 0", "3 1mm 1 0"),
                ":15: node 3: x, a number, expected, found '1mm 1 0'"},
        BadFile{"MissingCoordinate", plate_with("3 1 1 0", "3 1 1"),
                ":15: node 3: z, a number, expected, found ''"},
        BadFile{"NotANumber", plate_with("3 1 1 0", "3 nan 1 0"),
                ":15: node 3: coordinates must be finite numbers"},
        BadFile{"Infinite", plate_with("3 1 1 0", "3 1 -inf 0"),
                ":15: node 3: coordinates must be finite numbers"},
        BadFile{"InfinitelyHigh", plate_with("1 0 0 0", "1 0 0 inf"),
                ":13: node 1: coordinates must be finite numbers"},
        BadFile{"ZeroByteAtTheEnd", plate_with("$EndElements", std::string("$EndElements\n\0", 14)),
                ":30: unexpected section after $EndElements; convert with `meshgen --convert`"},
        BadFile{"TooLargeForADouble", plate_with("3 1 1 0", "3 1e999 1 0"),
                ":15: node 3: x, a number, expected, found '1e999 1 0'"},
        BadFile{"NodeTwice", plate_with("4 0 1 0", "3 0 1 0"), ":16: node 3 is given twice"},
        BadFile{"MoreOnTheLine", plate_with("4 0 1 0", "4 0 1 0 7"),
                ":16: unexpected '7' at the end of the line"},
        BadFile{"FewerNodesThanAnnounced", plate_with("5", "6"),
                ":18: a node's number expected, found '$EndNodes'"},
        BadFile{"MoreNodesThanAnnounced", plate_with("5", "4"),
                ":17: $EndNodes expected, found '5 0.5 0.5 0'"},
        BadFile{"Quadrangle", plate_with("8 2 2 21 1 3 4 5", "8 3 2 21 1 3 4 5 2"),
                ":28: element 8: type 3 (allowed: 1, 2-node line; 2, 3-node triangle)"},
        BadFile{"NoTags", plate_with("8 2 2 21 1 3 4 5", "8 2 0 3 4 5"),
                ":28: element 8: needs a first tag, its physical group"},
        BadFile{"LineWithoutRole", plate_with("1 1 2 12 1 1 2", "1 1 2 21 1 1 2"),
                ":21: element 1: physical group 21 is no boundary role (allowed: displacement, "
                "force, contact)"},
        BadFile{"TriangleWithoutBody", plate_with("8 2 2 21 1 3 4 5", "8 2 2 12 1 3 4 5"),
                ":28: element 8: physical group 12 is no named body"},
        BadFile{"UnknownNode", plate_with("8 2 2 21 1 3 4 5", "8 2 2 21 1 3 4 6"),
                ":28: element 8: node 6 does not exist"},
        BadFile{"MissingNode", plate_with("8 2 2 21 1 3 4 5", "8 2 2 21 1 3 4"),
                ":28: element 8: a node's number expected, found ''"},
        BadFile{"SecondOrderNodes", plate_with("8 2 2 21 1 3 4 5", "8 2 2 21 1 3 4 5 1"),
                ":28: unexpected '1' at the end of the line"},
        BadFile{"FurtherSection", plate + "$Periodic\n0\n$EndPeriodic\n",
                ":30: unexpected section after $EndElements; convert with `meshgen --convert`"},
        // From here on the triangulation itself is wrong, which is not one line's fault.
        BadFile{"Inverted", plate_with("8 2 2 21 1 3 4 5", "8 2 2 21 1 4 3 5"),
                ": triangle 4: inverted (its vertices must run counter-clockwise)"},
        BadFile{"WalkedClockwise", plate_with("2 1 2 13 2 2 3", "2 1 2 13 2 3 2"),
                ": boundary edge 3-2: walked clockwise; the body must lie on its left"},
        BadFile{"NoDisplacement", plate_with("4 1 2 11 4 4 1", "4 1 2 12 4 4 1"),
                ": no displacement edge; at least one is needed to hold the body"},
        BadFile{"EdgeTwice", plate_with("2 1 2 13 2 2 3", "2 1 2 13 2 1 2"),
                ": boundary edge 1-2: given twice"}),
    [](const auto& test) { return std::string(test.param.title); });

TEST(ReadMsh, TruncatedAnywhereIsRefused) {
  const std::string last_needed = "$EndElements";
  for (std::size_t length = 0; length < plate.find(last_needed) + last_needed.size(); ++length) {
    const std::string what = complaint(plate.substr(0, length));
    EXPECT_TRUE(what.starts_with("some/plate.msh:")) << length << ": " << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

TEST(ReadMsh, TruncatedBetweenLinesSaysWhatShouldCome) {
  EXPECT_EQ(complaint(plate.substr(0, plate.find("4 0 1 0"))),
            "some/plate.msh:15: the file ends where a node (5 announced, 3 found) should come; is "
            "it truncated?");
}

TEST(ReadMsh, FileThatCannotBeOpened) {
  try {
    read_msh("/nowhere/Mesh0.msh");
    FAIL() << "read a file that is not there";
  } catch (const MeshError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/Mesh0.msh: cannot be opened: No such file or directory");
  }
}

TEST(ReadMsh, FolderInPlaceOfAFile) {
  try {
    read_msh(testing::mesh_folder());
    FAIL() << "read a folder";
  } catch (const MeshError& error) {
    EXPECT_EQ(error.what(), testing::mesh_folder().string() + ": a folder, not a file");
  }
}

TEST(WriteMsh, CanonicalText) {
  EXPECT_EQ(msh_text(read(plate)), R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
1 1 "displacement"
1 2 "force"
1 3 "contact"
2 4 "steel"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0.5 0.5 0
$EndNodes
$Elements
8
1 1 2 2 2 1 2
2 1 2 3 3 2 3
3 1 2 2 2 3 4
4 1 2 1 1 4 1
5 2 2 4 4 1 2 5
6 2 2 4 4 4 1 5
7 2 2 4 4 2 3 5
8 2 2 4 4 3 4 5
$EndElements
)");
}

// Tags in any order; a group without edges, "force:unused", is not written.
TEST(WriteMsh, NamedBoundaryGroupsComeBack) {
  std::string text = plate_with("4", "7");
  const auto put = [&](const std::string& from, const std::string& to) {
    text.replace(text.find("\n" + from + "\n") + 1, from.size(), to);
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
  for (const std::string name : {"Mesh0", "Mesh4"}) {
    const std::filesystem::path file = testing::mesh_file(name);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    ASSERT_FALSE(bytes.empty()) << file;
    EXPECT_TRUE(msh_text(read_msh(file)) == bytes) << file;
  }
}

}  // namespace
}  // namespace airybench::msh_format_test
