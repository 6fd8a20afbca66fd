#include "tests/meshgen/conversion.hpp"

namespace airybench::convert_refusals_test {
namespace {

using namespace testing;

class ConvertRefuses : public Conversion {};

TEST_F(ConvertRefuses, Quadrangles) {
  EXPECT_EQ(
      complaint("quads.geo", two_squares_geometry + roles + bodies + "Recombine Surface {1, 2};\n"),
      "surface 1 has elements 'Quadrilateral 4'; only triangles (without Recombine in Gmsh) are "
      "allowed");
}

TEST_F(ConvertRefuses, ALastLineWithoutEnd) {
  std::string text = two_squares_geometry + roles + bodies;
  text.pop_back();
  EXPECT_EQ(complaint("a.geo", text),
            "its last line does not end: Gmsh would pass over it (allowed: a new line there)");
}

TEST_F(ConvertRefuses, AModelWithoutDisplacement) {
  EXPECT_EQ(complaint("a.geo", two_squares_geometry + bodies),
            "no edges in a physical curve named displacement; it is needed, force and contact are "
            "allowed");
  EXPECT_EQ(complaint("b.geo", two_squares_geometry + bodies +
                                   replaced(roles, "\"displacement\"", "\"Displacement\"")),
            "no edges in a physical curve named displacement (others found: 'Displacement'; "
            "--role gives them one); it is needed, force and contact are allowed");
}

TEST_F(ConvertRefuses, AModelWithoutSurface) {
  EXPECT_EQ(complaint("a.geo", two_squares_geometry + roles),
            "no physical surface; at least one is needed (one per body; any name is allowed)");
}

TEST_F(ConvertRefuses, BoundaryWithoutRole) {
  EXPECT_EQ(complaint("a.msh", replaced(clockwise_plate, "\"contact\"", "\"glue\"")),
            "boundary edge from (1, 0) to (1, 1) is in no physical curve named displacement, force "
            "or contact (others found: 'glue'; --role gives them one)");
  EXPECT_EQ(complaint("b.geo", two_squares_geometry + bodies +
                                   replaced(roles, "Physical Curve(\"contact\") = {7};", "")),
            "boundary edge from (2, 0) to (2, 0.333333) is in no physical curve named "
            "displacement, force or contact");
}

TEST_F(ConvertRefuses, ARoleInside) {
  const std::string what =
      complaint("a.geo", two_squares_geometry + bodies +
                             replaced(roles, "contact\") = {7", "contact\") = {4, 7"));
  EXPECT_TRUE(what.starts_with("physical curve 'contact': edge from (1, ")) << what;
  EXPECT_TRUE(what.ends_with(" is not on the body's boundary")) << what;
}

TEST_F(ConvertRefuses, TwoRoles) {
  EXPECT_EQ(complaint("a.geo", two_squares_geometry + bodies +
                                   replaced(roles, "contact\") = {7", "contact\") = {6, 7")),
            "curve 6: an edge is in the physical curves force and contact; one role is allowed");
}

TEST_F(ConvertRefuses, TwoBodiesOfOneSurface) {
  EXPECT_EQ(complaint("a.geo", two_squares_geometry + roles +
                                   "Physical Surface(\"steel\", 1) = {1, 2};\n"
                                   "Physical Surface(\"iron\", 2) = {2};\n"),
            "surface 2 is in the physical surfaces 1 and 2; one body is allowed");
}

TEST_F(ConvertRefuses, FlatTriangles) {
  EXPECT_EQ(complaint("flat.msh", replaced(clockwise_plate, "50 0.5 0.5", "50 0.5 0")),
            "triangle of nodes 20, 10, 50 at (1, 0) has zero area");
}

TEST_F(ConvertRefuses, SeparateBodies) {
  EXPECT_EQ(
      complaint("apart.geo", two_loops("9") + "Plane Surface(1) = {1}; Plane Surface(2) = {2};\n" +
                                 "Physical Surface(\"steel\") += {2};\n"),
      "2 separate pieces; the body must be one (in Gmsh, Coherence or BooleanFragments joins "
      "surfaces that touch or overlap)");
}

TEST_F(ConvertRefuses, AHoleThatIsFilledOrWithoutARole) {
  EXPECT_EQ(
      complaint("island.geo", two_loops("1") +
                                  "Plane Surface(1) = {1, 2}; Plane Surface(2) = {2};\n" +
                                  "Physical Surface(\"plug\") = {2};\n"),
      "physical curve 'force:hole': edge from (1, 1) to (2, 1) is not on the body's boundary");
}

TEST_F(ConvertRefuses, WithGmshsOwnMessage) {
  const std::string what = complaint("broken.geo", "Point(1) = {0, 0, 0};\nfoo bar;\n");
  EXPECT_TRUE(what.starts_with("Gmsh: ")) << what;
  EXPECT_NE(what.find("line 2"), std::string::npos) << what;
  EXPECT_EQ(complaint("truncated.msh", plate_msh4.substr(0, plate_msh4.find("0 3 0 1"))),
            "Gmsh: Could not read nodes");
}

TEST_F(ConvertRefuses, AFileThatIsNotThere) {
  try {
    convert_model("/nowhere/tooth.geo");
    FAIL() << "converted a file that is not there";
  } catch (const MeshError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/tooth.geo: no such file");
  }
}

TEST_F(ConvertRefuses, WithoutPrinting) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  EXPECT_NE(complaint("bad.step", "not a STEP file\n"), "no complaint");
  EXPECT_NE(complaint("bad.geo", "foo bar;\n"), "no complaint");
  EXPECT_EQ(complaint("good.geo", two_squares_geometry + roles + bodies), "no complaint");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace airybench::convert_refusals_test
