#include "tests/meshgen/conversion.hpp"

namespace airybench::convert_refusals_test {
namespace {

using namespace testing;

class ConvertRefuses : public Conversion {};

struct Refusal {
  std::string file, text;
  std::string complaint, end = {};  // the whole, or where it begins and ends
};

TEST_F(ConvertRefuses, WhatIsWrongWithAModelInOneLine) {
  const std::string squares = two_squares_geometry + roles + bodies,
                    unnamed = two_squares_geometry + bodies;
  const auto with_roles = [&](const char* from, const char* to) {
    return unnamed + replaced(roles, from, to);
  };
  const std::vector<Refusal> cases = {
      {"quadrangles.geo", squares + "Recombine Surface {1, 2};\n",
       "surface 1 has elements 'Quadrilateral 4'; only triangles (without Recombine in Gmsh) are "
       "allowed"},
      {"last_line_without_end.geo", squares.substr(0, squares.size() - 1),
       "its last line does not end: Gmsh would pass over it (allowed: a new line there)"},
      {"no_roles.geo", unnamed,
       "no edges in a physical curve named displacement; it is needed, force and contact are "
       "allowed"},
      {"no_displacement.geo", with_roles("\"displacement\"", "\"Displacement\""),
       "no edges in a physical curve named displacement (others found: 'Displacement'; --role "
       "gives them one); it is needed, force and contact are allowed"},
      {"no_surface.geo", two_squares_geometry + roles,
       "no physical surface; at least one is needed (one per body; any name is allowed)"},
      {"unknown_role.msh", replaced(clockwise_plate, "\"contact\"", "\"glue\""),
       "boundary edge from (1, 0) to (1, 1) is in no physical curve named displacement, force or "
       "contact (others found: 'glue'; --role gives them one)"},
      {"edge_without_role.geo", with_roles("Physical Curve(\"contact\") = {7};", ""),
       "boundary edge from (2, 0) to (2, 0.333333) is in no physical curve named displacement, "
       "force or contact"},
      {"role_inside.geo", with_roles("contact\") = {7", "contact\") = {4, 7"),
       "physical curve 'contact': edge from (1, ", " is not on the body's boundary"},
      {"two_roles.geo", with_roles("contact\") = {7", "contact\") = {6, 7"),
       "curve 6: an edge is in the physical curves force and contact; one role is allowed"},
      {"two_bodies.geo",
       two_squares_geometry + roles +
           "Physical Surface(\"steel\", 1) = {1, 2};\nPhysical Surface(\"iron\", 2) = {2};\n",
       "surface 2 is in the physical surfaces 1 and 2; one body is allowed"},
      {"flat.msh", replaced(clockwise_plate, "50 0.5 0.5", "50 0.5 0"),
       "triangle of nodes 20, 10, 50 at (1, 0) has zero area"},
      {"apart.geo",
       two_loops("9") + "Plane Surface(1) = {1}; Plane Surface(2) = {2};\n" +
           "Physical Surface(\"steel\") += {2};\n",
       "2 separate pieces; the body must be one (in Gmsh, Coherence or BooleanFragments joins "
       "surfaces that touch or overlap)"},
      {"filled_hole.geo",
       two_loops("1") + "Plane Surface(1) = {1, 2}; Plane Surface(2) = {2};\n" +
           "Physical Surface(\"plug\") = {2};\n",
       "physical curve 'force:hole': edge from (1, 1) to (2, 1) is not on the body's boundary"},
      {"broken.geo", "Point(1) = {0, 0, 0};\nfoo bar;\n", "Gmsh: ", "line 2"},
      {"truncated.msh", plate_msh4.substr(0, plate_msh4.find("0 3 0 1")),
       "Gmsh: Could not read nodes"},
  };
  for (const auto& [file, text, expected, end] : cases) {
    const std::string what = complaint(file, text);
    if (end.empty())
      EXPECT_EQ(what, expected) << file;
    else
      EXPECT_TRUE(what.starts_with(expected) && what.find(end) != what.npos) << file << what;
  }
}

TEST_F(ConvertRefuses, AFileThatIsNotThere) { EXPECT_EQ(complaint("tooth.geo"), "no such file"); }

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
