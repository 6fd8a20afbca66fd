#include "meshgen/convert.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "mesh/msh_format.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "tests/support/places.hpp"
#include "tests/support/temporary_folder.hpp"

namespace airybench::convert_test {
namespace {

// Two unit squares side by side. The lines run clockwise around the body.
const std::string two_squares_geometry = R"(
h = 0.4;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {2, 0, 0, h};
Point(4) = {0, 1, 0, h}; Point(5) = {1, 1, 0, h}; Point(6) = {2, 1, 0, h};
Line(1) = {2, 1}; Line(2) = {1, 4}; Line(3) = {4, 5}; Line(4) = {5, 2};
Line(5) = {3, 2}; Line(6) = {5, 6}; Line(7) = {6, 3};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, -4, 6, 7}; Plane Surface(2) = {2};
)";
const std::string roles = R"(
Physical Curve("displacement") = {2};
Physical Curve("force") = {1, 3, 5, 6};
Physical Curve("contact") = {7};
)";
const std::string bodies = R"(
Physical Surface("steel") = {1};
Physical Surface("cast iron") = {2};
)";

// A unit square of four triangles in MSH 4.1, as Gmsh 4.8.4 wrote it.
const std::string plate_msh4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 11 "displacement"
1 12 "force"
1 13 "contact"
$EndPhysicalNames
$Entities
4 4 1 0
1 0 0 0 0 
2 1 0 0 0 
3 1 1 0 0 
4 0 1 0 0 
1 0 0 0 1 0 0 1 12 2 1 -2 
2 1 0 0 1 1 0 1 13 2 2 -3 
3 0 1 0 1 1 0 1 12 2 3 -4 
4 0 0 0 0 1 0 1 11 2 4 -1 
1 0 0 0 1 1 0 1 21 4 1 2 3 4 
$EndEntities
$Nodes
9 5 1 5
0 1 0 1
1
0 0 0
0 2 0 1
2
1 0 0
0 3 0 1
3
1 1 0
0 4 0 1
4
0 1 0
1 1 0 0
1 2 0 0
1 3 0 0
1 4 0 0
2 1 0 1
5
0.5 0.5 0
$EndNodes
$Elements
5 8 1 8
1 1 1 1
1 1 2 
1 2 1 1
2 2 3 
1 3 1 1
3 3 4 
1 4 1 1
4 4 1 
2 1 2 4
5 1 2 5 
6 4 1 5 
7 2 3 5 
8 3 4 5 
$EndElements
)";

// The same square in MSH 2.2, the triangles clockwise, with a node of no triangle and wide gaps in
// the numbers.
const std::string clockwise_plate = R"($MeshFormat
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
6
10 0 0 0
20 1 0 0
30 1 1 0
40 0 1 0
50 0.5 0.5 0
60 7 7 0
$EndNodes
$Elements
8
1 1 2 12 1 20 10
2 1 2 13 2 20 30
3 1 2 12 3 40 30
4 1 2 11 4 40 10
5 2 2 21 1 20 10 50
6 2 2 21 1 10 40 50
7 2 2 21 1 30 20 50
8 2 2 21 1 40 30 50
$EndElements
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == text.npos) throw std::logic_error("'" + from + "' not found");
  return text.replace(at, from.size(), to);
}

class Convert : public ::testing::Test {
 protected:
  Mesh convert(const std::string& name, const std::string& text) {
    return convert_model(testing::write_text(folder_ / name, text));
  }
  // What is said after the file's name.
  std::string complaint(const std::string& name, const std::string& text) {
    try {
      convert(name, text);
    } catch (const MeshError& error) {
      const std::string what = error.what(), prefix = (folder_ / name).string() + ": ";
      EXPECT_TRUE(what.starts_with(prefix)) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      return what.substr(std::min(prefix.size(), what.size()));
    }
    return "no complaint";
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(Convert, GeometryOfTwoBodiesIsMeshed) {
  const Mesh mesh = convert("squares.geo", two_squares_geometry + roles + bodies);
  EXPECT_NO_THROW(validate(mesh));
  EXPECT_EQ(mesh.name, "squares");
  EXPECT_EQ(mesh.body_names, (std::vector<std::string>{"steel", "cast iron"}));
  double area[2] = {0, 0};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double x = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]).x() / 3;
    EXPECT_EQ(mesh.triangle_body[t], x < 1 ? 0 : 1);
    area[mesh.triangle_body[t]] +=
        cross_area(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) / 2;
  }
  EXPECT_NEAR(area[0], 1, 1e-12);
  EXPECT_NEAR(area[1], 1, 1e-12);
  for (const BoundaryEdge& edge : mesh.boundary) {
    const double x = (mesh.vertices[edge.vertices[0]] + mesh.vertices[edge.vertices[1]]).x() / 2;
    EXPECT_EQ(edge.role, x == 0   ? BoundaryRole::displacement
                         : x == 2 ? BoundaryRole::contact
                                  : BoundaryRole::force);
  }
}

TEST_F(Convert, MeshSizesOfTheGeometryAreKept) {
  const std::string coarse = two_squares_geometry + roles + bodies;
  const std::size_t before = convert("coarse.geo", coarse).vertices.size();
  EXPECT_LT(before, convert("fine.geo", replaced(coarse, "0.4", "0.1")).vertices.size());
  // Options left behind by others must not matter.
  convert("scaled.geo", coarse + "Mesh.MeshSizeFactor = 0.5;\n");
  {
    const GmshSession session;
    mesh_interior(boundary_polygon({}, {6, 24, 10}), size_field({}, {6, 24, 10}), {}, "tooth");
  }
  EXPECT_EQ(convert("coarse.geo", coarse).vertices.size(), before);
}

TEST_F(Convert, MeshOfFormat4) {
  const Mesh mesh = convert("plate.msh", plate_msh4);
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.boundary.size(), 4u);
  EXPECT_EQ(mesh.body_names, std::vector<std::string>{"body"});  // its surface group has no name
}

TEST_F(Convert, SeveralUnnamedSurfacesAreToldApart) {
  const Mesh mesh =
      convert("squares.geo", two_squares_geometry + roles +
                                 "Physical Surface(7) = {1};\nPhysical Surface(9) = {2};\n");
  EXPECT_EQ(mesh.body_names, (std::vector<std::string>{"body7", "body9"}));
}

TEST_F(Convert, SurfacesOfOneNameAreOneBody) {
  const Mesh mesh = convert(
      "squares.geo", two_squares_geometry + roles + "Physical Surface(\"steel\") = {1, 2};\n");
  EXPECT_EQ(mesh.body_names, std::vector<std::string>{"steel"});
}

TEST_F(Convert, ClockwiseTrianglesAndLinesAreTurnedAndUnusedNodesDropped) {
  const Mesh mesh = convert("plate.msh", clockwise_plate);
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[4], Eigen::Vector2d(0.5, 0.5));
  for (const auto& [a, b, c] : mesh.triangles)
    EXPECT_DOUBLE_EQ(cross_area(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]), 0.5);
  EXPECT_NO_THROW(validate(mesh));
}

TEST_F(Convert, OwnFileComesBackUnchanged) {
  const std::filesystem::path file = testing::mesh_file("Mesh0");
  const Mesh ours = read_msh(file), converted = convert_model(file);
  EXPECT_EQ(converted.vertices, ours.vertices);
  EXPECT_EQ(converted.triangles, ours.triangles);
  EXPECT_EQ(converted.boundary.size(), ours.boundary.size());
}

TEST_F(Convert, AnyConstantZButNoOther) {
  std::string lifted = clockwise_plate;
  for (const char* node : {"10 0 0", "20 1 0", "30 1 1", "40 0 1", "50 0.5 0.5"})
    lifted = replaced(lifted, std::string(node) + " 0\n", std::string(node) + " 3.5\n");
  EXPECT_EQ(complaint("plate.msh", lifted), "no complaint");
  EXPECT_EQ(complaint("plate.msh", replaced(lifted, "30 1 1 3.5", "30 1 1 3.6")),
            "node 30 has z = 3.6, others 3.5; the body must lie in a plane z = constant");
}

TEST_F(Convert, UnusedNodeMayLieAnywhere) {
  EXPECT_EQ(complaint("plate.msh", replaced(clockwise_plate, "60 7 7 0", "60 7 7 7")),
            "no complaint");
}

TEST_F(Convert, RefusesQuadrangles) {
  EXPECT_EQ(
      complaint("quads.geo", two_squares_geometry + roles + bodies + "Recombine Surface {1, 2};\n"),
      "surface 1 has elements 'Quadrilateral 4'; only 3-node triangles are allowed");
}

TEST_F(Convert, RefusesSecondOrder) {
  EXPECT_EQ(
      complaint("second.geo", two_squares_geometry + roles + bodies + "Mesh.ElementOrder = 2;\n"),
      "surface 1 has elements 'Triangle 6'; only 3-node triangles are allowed");
}

TEST_F(Convert, NamesMissingDisplacement) {
  EXPECT_EQ(complaint("a.geo", two_squares_geometry + bodies),
            "no edges in a physical curve named displacement; it is needed, force and contact are "
            "allowed");
  EXPECT_EQ(complaint("b.geo", two_squares_geometry + bodies +
                                   replaced(roles, "\"displacement\"", "\"Displacement\"")),
            "no edges in a physical curve named displacement (others found: 'Displacement'); it is "
            "needed, force and contact are allowed");
}

TEST_F(Convert, NamesMissingSurface) {
  EXPECT_EQ(complaint("a.geo", two_squares_geometry + roles),
            "no physical surface; at least one is needed (one per body; any name is allowed)");
}

TEST_F(Convert, NamesBoundaryWithoutRole) {
  EXPECT_EQ(complaint("a.msh", replaced(clockwise_plate, "\"contact\"", "\"glue\"")),
            "boundary edge from (1, 0) to (1, 1) is in no physical curve named displacement, force "
            "or contact (others found: 'glue')");
  EXPECT_EQ(complaint("b.geo", two_squares_geometry + bodies +
                                   replaced(roles, "Physical Curve(\"contact\") = {7};", "")),
            "boundary edge from (2, 0) to (2, 0.333333) is in no physical curve named "
            "displacement, force or contact");
}

TEST_F(Convert, LeavesOtherCurvesAside) {
  EXPECT_EQ(complaint("a.geo", two_squares_geometry + roles + bodies +
                                   "Physical Curve(\"interface\") = {4};\n"
                                   "Physical Point(\"corner\") = {1};\n"),
            "no complaint");
}

TEST_F(Convert, NamedBoundaryGroupsAreKept) {
  const Mesh mesh = convert(
      "named.geo", two_squares_geometry + bodies +
                       replaced(replaced(roles, "\"force\") = {1, 3, 5, 6}", "\"force\") = {1, 3}"),
                                "\"contact\"", "\"contact:flank\"") +
                       "Physical Curve(\"force:bottom\") = {5};\n"
                       "Physical Curve(\"force:top\") = {6};\n");
  std::map<std::string, double> length;
  for (const BoundaryEdge& edge : mesh.boundary)
    length[boundary_label(mesh, edge)] +=
        (mesh.vertices[edge.vertices[1]] - mesh.vertices[edge.vertices[0]]).norm();
  ASSERT_EQ(length.size(), 5U);
  for (const char* label : {"displacement", "contact:flank", "force:bottom", "force:top"})
    EXPECT_NEAR(length[label], 1, 1e-12) << label;
  EXPECT_NEAR(length["force"], 2, 1e-12);
}

TEST_F(Convert, RefusesARoleInside) {
  const std::string what =
      complaint("a.geo", two_squares_geometry + bodies +
                             replaced(roles, "contact\") = {7", "contact\") = {4, 7"));
  EXPECT_TRUE(what.starts_with("physical curve 'contact': edge from (1, ")) << what;
  EXPECT_TRUE(what.ends_with(" is not on the body's boundary")) << what;
}

TEST_F(Convert, RefusesTwoRoles) {
  EXPECT_EQ(complaint("a.geo", two_squares_geometry + bodies +
                                   replaced(roles, "contact\") = {7", "contact\") = {6, 7")),
            "curve 6: an edge is in the physical curves force and contact; one role is allowed");
}

TEST_F(Convert, RefusesTwoBodiesOfOneSurface) {
  EXPECT_EQ(complaint("a.geo", two_squares_geometry + roles +
                                   "Physical Surface(\"steel\", 1) = {1, 2};\n"
                                   "Physical Surface(\"iron\", 2) = {2};\n"),
            "surface 2 is in the physical surfaces 1 and 2; one body is allowed");
}

TEST_F(Convert, RefusesFlatTriangles) {
  EXPECT_EQ(complaint("flat.msh", replaced(clockwise_plate, "50 0.5 0.5", "50 0.5 0")),
            "triangle of nodes 20, 10, 50 at (1, 0) has zero area");
}

TEST_F(Convert, KeepsAFileThatIsOneOfOursAlready) {
  // One tag per element: allowed in MSH 2.2 and read by read_msh(), but not by Gmsh.
  const Mesh mesh = convert("ours.msh", R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "displacement"
1 2 "force"
2 4 "steel"
$EndPhysicalNames
$Nodes
3
1 0 0 0
2 1 0 0
3 0 1 0
$EndNodes
$Elements
4
1 1 1 1 1 2
2 1 1 2 2 3
3 1 1 2 3 1
4 2 1 4 1 2 3
$EndElements
)");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.body_names.front(), "steel");
  EXPECT_EQ(mesh_sizes(mesh).n_f, 8);
}

// Two triangles of curves, the second one X further on.
std::string two_loops(const std::string& x) {
  return "X = " + x + R"(;
Point(1) = {0, 0, 0, 1}; Point(2) = {4, 0, 0, 1}; Point(3) = {0, 4, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1}; Curve Loop(1) = {1, 2, 3};
Point(4) = {X, 1, 0, 1}; Point(5) = {X + 1, 1, 0, 1}; Point(6) = {X, 2, 0, 1};
Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 4}; Curve Loop(2) = {4, 5, 6};
Physical Curve("displacement") = {1:3}; Physical Curve("force:hole") = {4:6};
Physical Surface("steel") = {1};
)";
}

TEST_F(Convert, RefusesSeparateBodies) {
  EXPECT_EQ(
      complaint("apart.geo", two_loops("9") + "Plane Surface(1) = {1}; Plane Surface(2) = {2};\n" +
                                 "Physical Surface(\"steel\") += {2};\n"),
      "2 separate pieces; the body must be one");
}

TEST_F(Convert, KeepsAHole) {
  const Mesh mesh = convert("hole.geo", two_loops("1") + "Plane Surface(1) = {1, 2};\n");
  EXPECT_EQ(hole_count(mesh), 1);
  EXPECT_EQ(mesh.boundary_groups, std::vector<std::string>{"hole"});
  EXPECT_EQ(mesh_sizes(mesh).n_phi,
            3 * static_cast<int>(mesh.vertices.size()) + number_edges(mesh).count());
  const MeshSizes& sizes = mesh_sizes(mesh);
  EXPECT_GE(sizes.force_edges, 3);
}

TEST_F(Convert, RefusesAHoleThatIsFilledOrWithoutARole) {
  EXPECT_EQ(
      complaint("island.geo", two_loops("1") +
                                  "Plane Surface(1) = {1, 2}; Plane Surface(2) = {2};\n" +
                                  "Physical Surface(\"plug\") = {2};\n"),
      "physical curve 'force:hole': edge from (1, 1) to (2, 1) is not on the body's boundary");
}

TEST_F(Convert, CarriesGmshsOwnMessage) {
  const std::string what = complaint("broken.geo", "Point(1) = {0, 0, 0};\nfoo bar;\n");
  EXPECT_TRUE(what.starts_with("Gmsh: ")) << what;
  EXPECT_NE(what.find("line 2"), std::string::npos) << what;
  EXPECT_EQ(complaint("truncated.msh", plate_msh4.substr(0, plate_msh4.find("0 3 0 1"))),
            "Gmsh: Could not read nodes");
}

TEST_F(Convert, NoSuchFile) {
  try {
    convert_model("/nowhere/tooth.geo");
    FAIL() << "converted a file that is not there";
  } catch (const MeshError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/tooth.geo: no such file");
  }
}

TEST_F(Convert, PrintsNothing) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  EXPECT_NE(complaint("bad.step", "not a STEP file\n"), "no complaint");
  EXPECT_NE(complaint("bad.geo", "foo bar;\n"), "no complaint");
  EXPECT_EQ(complaint("good.geo", two_squares_geometry + roles + bodies), "no complaint");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace airybench::convert_test
