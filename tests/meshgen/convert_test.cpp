#include "meshgen/convert.hpp"

#include <gtest/gtest.h>

#include "mesh/msh_format.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::convert_test {
namespace {

using namespace testing;

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
const std::string plate_msh4 = text_of(test_data("meshgen/plate_msh4.msh"));

// The same square in MSH 2.2, the triangles clockwise, with a node of no triangle and wide gaps in
// the numbers.
const std::string clockwise_plate = text_of(test_data("meshgen/clockwise_plate.msh"));

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == text.npos) throw std::logic_error("'" + from + "' not found");
  return text.replace(at, from.size(), to);
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

class Convert : public ::testing::Test {
 protected:
  Mesh convert(const std::string& name, const std::string& text) {
    return convert_model(write_text(folder_ / name, text), options_).mesh;
  }
  // What is said after the file's name: of one with this text, and of one that is there.
  std::string complaint(const std::string& name, const std::string& text) {
    write_text(folder_ / name, text);
    return complaint(name);
  }
  std::string complaint(const std::string& name) {
    const std::string what =
        complaint_of<MeshError>([&] { convert_model(folder_ / name, options_); });
    if (what == "no complaint") return what;
    const std::string prefix = (folder_ / name).string() + ": ";
    EXPECT_TRUE(what.starts_with(prefix)) << what;
    for (std::size_t at = 0; (at = what.find('\n', at)) != what.npos; ++at)
      EXPECT_EQ(what.substr(at + 1, 2), "  ") << what;  // a table's line
    return what.substr(std::min(prefix.size(), what.size()));
  }

  const testing::TemporaryFolder folder_;
  ModelOptions options_;
};

TEST_F(Convert, GeometryOfTwoBodiesIsMeshed) {
  const Mesh mesh = convert("squares.geo", two_squares_geometry + roles + bodies);
  EXPECT_NO_THROW(validate(mesh));
  EXPECT_EQ(mesh.name, "squares");
  EXPECT_EQ(mesh.body_names, (std::vector<std::string>{"steel", "cast iron"}));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double x = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]).x() / 3;
    EXPECT_EQ(mesh.triangle_body[t], x < 1 ? 0 : 1);
  }
  for (const auto& [body, area] : area_of_bodies(mesh)) EXPECT_NEAR(area, 1, 1e-12) << body;
  for (const BoundaryEdge& edge : mesh.boundary) {
    const double x = (mesh.vertices[edge.vertices[0]] + mesh.vertices[edge.vertices[1]]).x() / 2;
    EXPECT_EQ(edge.role, x == 0   ? BoundaryRole::displacement
                         : x == 2 ? BoundaryRole::contact
                                  : BoundaryRole::force);
  }
}

// A curve that is named like no role is named by a note.
TEST_F(Convert, ContactAloneMayHoldABody) {
  const std::string on_a_wall = replaced(roles, "\"displacement\"", "\"force:top\""),
                    bolted = replaced(roles, "\"displacement\"", "\"bolt\"");
  EXPECT_EQ(complaint("wall.geo", two_squares_geometry + on_a_wall + bodies), "no complaint");
  EXPECT_EQ(complaint("bolt.geo", two_squares_geometry + bolted + bodies), "no complaint");
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

TEST_F(Convert, UnnamedSurfacesAreToldApartAndThoseOfOneNameAreOneBody) {
  const std::string squares = two_squares_geometry + roles;
  EXPECT_EQ(convert("unnamed.geo",
                    squares + "Physical Surface(7) = {1};\n" + "Physical Surface(9) = {2};\n")
                .body_names,
            (std::vector<std::string>{"body7", "body9"}));
  EXPECT_EQ(convert("one.geo", squares + "Physical Surface(\"steel\") = {1, 2};\n").body_names,
            std::vector<std::string>{"steel"});
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
  const Mesh ours = read_msh(file), converted = convert_model(file).mesh;
  EXPECT_EQ(converted.vertices, ours.vertices);
  EXPECT_EQ(converted.triangles, ours.triangles);
  EXPECT_EQ(converted.boundary.size(), ours.boundary.size());
}

TEST_F(Convert, AnyConstantZButNoOther) {
  std::string lifted = clockwise_plate;
  for (const char* node : {"10 0 0", "20 1 0", "30 1 1", "40 0 1", "50 0.5 0.5"})
    lifted = replaced(lifted, std::string(node) + " 0\n", std::string(node) + " 3.5\n");
  EXPECT_EQ(complaint("plate.msh", lifted), "no complaint");
  expect_named(complaint("plate.msh", replaced(lifted, "30 1 1 3.5", "30 1 1 3.6")),
               {"no plane x, y or z = constant", "z from 3.5 to 3.6"});
  EXPECT_EQ(complaint("unused.msh", replaced(clockwise_plate, "60 7 7 0", "60 7 7 7")),
            "no complaint");
}

TEST_F(Convert, HigherOrderIsReducedToCorners) {
  const std::string first = two_squares_geometry + roles + bodies;
  const Mesh linear = convert("first.geo", first);
  for (const char* order : {"2", "3"}) {
    const auto file =
        testing::write_text(folder_ / "second.geo", first + "Mesh.ElementOrder = " + order + ";\n");
    const ConvertedModel converted = convert_model(file);
    EXPECT_EQ(converted.mesh.vertices.size(), linear.vertices.size());
    EXPECT_EQ(converted.mesh.triangles, linear.triangles);
    EXPECT_EQ(converted.notes,
              std::vector<std::string>{"of elements of higher order, sides of the boundary keep "
                                       "their curves; others are chords"});
  }
  EXPECT_TRUE(convert_model(folder_ / "first.geo").notes.empty());
}

// A plate with a hole of radius 1 about (4, 3) and a wavy top.
const std::string round_plate = R"(
Point(1) = {0, 0, 0, 1}; Point(2) = {8, 0, 0, 1}; Point(3) = {8, 6, 0, 1}; Point(4) = {0, 6, 0, 1};
Point(5) = {6, 6.4, 0, 1}; Point(6) = {4, 5.8, 0, 1}; Point(7) = {2, 6.2, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Spline(3) = {3, 5, 6, 7, 4}; Line(4) = {4, 1};
Point(8) = {4, 3, 0, 1}; Point(9) = {5, 3, 0, 0.4}; Point(10) = {3, 3, 0, 0.4};
Circle(5) = {9, 8, 10}; Circle(6) = {10, 8, 9};
Curve Loop(1) = {1:4}; Curve Loop(2) = {5, 6}; Plane Surface(1) = {1, 2};
Physical Curve("displacement") = {1}; Physical Curve("force:hole") = {5, 6};
Physical Curve("force:top") = {3}; Physical Curve("force") = {2, 4}; Physical Surface("plate") = {1};
)";

TEST_F(Convert, SidesKnowTheCurvesOfTheirModel) {
  const auto largest_off = [](const Mesh& mesh, int degree_of_top) {
    double off = 0;
    std::map<std::string, int> curved;
    for (const BoundaryEdge& edge : mesh.boundary) {
      if (edge.curve.is_straight()) continue;
      ++curved[boundary_label(mesh, edge)];
      const bool is_hole = boundary_label(mesh, edge) == "force:hole";
      EXPECT_EQ(edge.curve.degree(), is_hole ? 7 : degree_of_top);
      if (is_hole)
        for (const double t : {0.1, 0.5, 0.8})
          off = std::max(off, std::abs((edge.curve.at(t) - Eigen::Vector2d(4, 3)).norm() - 1));
    }
    EXPECT_EQ(curved.size(), 2U);  // the hole and the top
    return off;
  };
  EXPECT_LT(largest_off(convert("plate.geo", round_plate), 7), 1e-9);
  const Mesh scaled = convert("inches.geo", round_plate + "Mesh.ScalingFactor = 25.4;\n");
  for (const BoundaryEdge& edge : scaled.boundary) {
    if (boundary_label(scaled, edge) != "force:hole") continue;
    EXPECT_NEAR((edge.curve.at(0.4) - 25.4 * Eigen::Vector2d(4, 3)).norm(), 25.4, 1e-8);
  }
  // Without geometry, from quadratic elements: the hole's nodes are on a circle, the top's are not.
  testing::write_text(folder_ / "quadratic.geo",
                      round_plate +
                          "Mesh.ElementOrder = 2; Mesh.MshFileVersion = 2.2; Mesh 2; Save "
                          "\"" +
                          (folder_ / "quadratic.msh").string() + "\";\n");
  convert_model(folder_ / "quadratic.geo");
  ASSERT_TRUE(std::filesystem::exists(folder_ / "quadratic.msh"));
  EXPECT_LT(largest_off(convert_model(folder_ / "quadratic.msh").mesh, 2), 1e-9);
}

// However few sides its arc has: an open curve has no seam.
TEST_F(Convert, AnArcOfOneSideIsRound) {
  for (const int sides : {1, 2, 3}) {
    const Mesh mesh =
        convert("quarter.geo",
                "Point(1) = {1, 0, 0, 2}; Point(2) = {9, 0, 0, 2}; Point(3) = {9, 9, 0, 2};"
                "Point(4) = {0, 9, 0, 2}; Point(5) = {0, 1, 0, 2}; Point(6) = {0, 0, 0};"
                "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};"
                "Circle(5) = {5, 6, 1}; Curve Loop(1) = {1:5}; Plane Surface(1) = {1};"
                "Transfinite Curve {5} = " +
                    std::to_string(sides + 1) +
                    "; Physical Curve(\"displacement\") = {2};"
                    "Physical Curve(\"force:hole\") = {5}; Physical Surface(\"plate\") = {1};");
    int found = 0;
    for (const BoundaryEdge& edge : mesh.boundary) {
      if (boundary_label(mesh, edge) != "force:hole") continue;
      ++found;
      ASSERT_EQ(edge.curve.degree(), 7) << sides;
      for (const double t : {0.1, 0.5, 0.8}) EXPECT_NEAR(edge.curve.at(t).norm(), 1, 1e-6) << sides;
    }
    EXPECT_GE(found, sides);
  }
}

TEST_F(Convert, RolesByTheNamesOfTheModel) {
  const std::string named = two_squares_geometry + bodies +
                            replaced(replaced(roles, "\"displacement\"", "\"clamped\""),
                                     "\"contact\"", "\"force:flank\"");
  options_ = model_options_of({"clamped=displacement:left", "force:flank=contact"}, {}, "");
  const Mesh mesh = convert("named.geo", named);
  const auto length = length_of_boundaries(mesh);
  EXPECT_EQ(length.size(), 3u);
  for (const char* label : {"displacement:left", "force", "contact"})
    EXPECT_TRUE(length.contains(label)) << label;
  options_ = model_options_of({"clampd=displacement"}, {}, "");
  expect_named(complaint("named.geo", named),
               {"--role: ", "no physical curve 'clampd', perhaps 'clamped'", "1, 2, 3, 5, 6, 7"});
}

TEST_F(Convert, ParametersOfAGeo) {
  const std::string model = replaced(two_squares_geometry, "h = 0.4;", R"(
DefineConstant[ h = {0.4, Name "Size/h"}, unused = 1 ];
top = DefineNumber[ 1, Name "Size/top" ];)");
  const std::string text =
      replaced(replaced(model, "{0, 1, 0, h}", "{0, top, 0, h}"), "h};\nPoint(4)", "h}; Point(4)") +
      roles + bodies;
  const std::size_t before = convert("a.geo", text).vertices.size();
  const auto vertices_with = [&](const char* parameter) {
    options_ = model_options_of({}, {parameter}, "");
    return convert("a.geo", text).vertices;
  };
  // Gmsh keeps what it was told for the rest of the process.
  EXPECT_EQ(vertices_with("unused=3").size(), before);
  EXPECT_GT(vertices_with("Size/h=0.2").size(), 2 * before);
  EXPECT_GT(vertices_with("h=0.05").size(), 20 * before);
  double top = 0;
  for (const Eigen::Vector2d& vertex : vertices_with("Size/top=1.5"))
    top = std::max(top, vertex.y());
  EXPECT_EQ(top, 1.5);
  options_ = model_options_of({}, {"top=2"}, "");
  expect_named(complaint("a.geo", text), {"--parameter: top ", "Size/h, Size/top, h, unused"});
  expect_named(complaint("a.msh", clockwise_plate), {"--parameter: only a .geo"});
}

TEST_F(Convert, MeshSize) {
  const std::string graded =
      replaced(two_squares_geometry, "Point(3) = {2, 0, 0, h}", "Point(3) = {2, 0, 0, h/8}") +
      roles + bodies;
  const auto edges = [&](const char* size) {
    options_ = model_options_of({}, {}, size);
    const Mesh mesh = convert("a.geo", graded);
    double longest = 0, shortest = 9;
    for (const BoundaryEdge& edge : mesh.boundary) {
      const double length =
          (mesh.vertices[edge.vertices[1]] - mesh.vertices[edge.vertices[0]]).norm();
      longest = std::max(longest, length);
      shortest = std::min(shortest, length);
    }
    return std::pair(shortest, longest);
  };
  const auto [shortest, longest] = edges("");
  EXPECT_GT(longest, 0.3);
  EXPECT_LE(edges("0.1").second, 0.101);
  EXPECT_NEAR(edges("0.1").first, shortest, 0.2 * shortest);  // what is finer stays
  EXPECT_EQ(edges("10"), std::pair(shortest, longest));
  EXPECT_NEAR(edges("50%").first, shortest / 2, 0.1 * shortest);
  EXPECT_NEAR(edges("50%").second, longest / 2, 0.15 * longest);  // edges are whole
  options_ = model_options_of({}, {}, "1e-9");
  expect_named(complaint("a.geo", graded), {"triangles: --mesh-size (allowed: up to 2e+07)"});
  expect_named(complaint("a.msh", clockwise_plate), {"--mesh-size: it has a mesh already"});
}

TEST_F(Convert, CurvesOfACadFileGoByTheirNumbers) {
  complaint("make.geo", R"(SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 20, 10};
Save "plate.brep";
Box(1) = {0, 0, 0, 1, 1, 1}; Save "box.brep";
)");
  EXPECT_EQ(complaint("plate.brep"),
            "no edges in a physical curve named displacement; --role=NUMBER=displacement holds one "
            "of its curves:\n"
            "  curve  names  role   length mm  from      by        to\n"
            "  1      -      force  20         (0, 0)    (10, 0)   (20, 0)\n"
            "  2      -      force  10         (20, 0)   (20, 5)   (20, 10)\n"
            "  3      -      force  20         (20, 10)  (10, 10)  (0, 10)\n"
            "  4      -      force  10         (0, 10)   (0, 5)    (0, 0)");
  expect_named(complaint("box.brep"), {"1 volume", "must be plane"});
  options_ = model_options_of({"4=displacement", "2=contact", "1=force", "5=force"}, {}, "2");
  expect_named(complaint("plate.brep"), {"--role: ", "no physical curve '5'", "1, 2, 3, 4"});
  options_ = model_options_of({"4=displacement", "2=contact", "1=force", "3=force:top"}, {}, "2");
  const Mesh mesh = convert_model(folder_ / "plate.brep", options_).mesh;
  EXPECT_EQ(mesh.name, "plate");
  EXPECT_EQ(mesh.body_names, std::vector<std::string>{"body"});
  const MeshSizes sizes = mesh_sizes(mesh);
  EXPECT_EQ(sizes.displacement_edges, 5);
  EXPECT_EQ(sizes.contact_edges, 5);
  EXPECT_EQ(sizes.force_edges, 20);
}

TEST_F(Convert, KeepsAHole) {
  const Mesh mesh = convert("hole.geo", two_loops("1") + "Plane Surface(1) = {1, 2};\n");
  EXPECT_EQ(hole_count(mesh), 1);
  EXPECT_EQ(mesh.boundary_groups, std::vector<std::string>{"hole"});
  EXPECT_EQ(mesh_sizes(mesh).n_phi,
            3 * static_cast<int>(mesh.vertices.size()) + number_edges(mesh).count());
  EXPECT_GE(mesh_sizes(mesh).force_edges, 3);
}

TEST_F(Convert, RefusesWhatIsWrongWithAModelInOneLine) {
  const std::string squares = two_squares_geometry + roles + bodies,
                    unnamed = two_squares_geometry + bodies;
  const auto with_roles = [&](const char* from, const char* to) {
    return unnamed + replaced(roles, from, to);
  };
  struct Refusal {
    std::string file, text;
    std::vector<std::string> named;
  };
  for (const auto& [file, text, named] : std::vector<Refusal>{
           {"no_displacement.geo",
            with_roles("\"displacement\"", "\"Displacement\""),
            {"physical curve 'Displacement': no role, perhaps displacement"}},
           {"role_inside.geo",
            with_roles("contact\") = {7", "contact\") = {4, 7"),
            {"physical curve 'contact': edge from (1, ", "not on the body's boundary"}},
           {"two_roles.geo",
            with_roles("contact\") = {7", "contact\") = {6, 7"),
            {"curve 6: its roles are force and contact"}},
           {"two_bodies.geo",
            two_squares_geometry + roles +
                "Physical Surface(\"steel\", 1) = {1, 2};\nPhysical Surface(\"iron\", 2) = {2};\n",
            {"surface 2 is in the physical surfaces 'steel' and 'iron'"}},
           {"flat.msh",
            replaced(clockwise_plate, "50 0.5 0.5", "50 0.5 0"),
            {"triangle of nodes 20, 10, 50 at (1, 0) has zero area"}},
           {"apart.geo",
            two_loops("9") + "Plane Surface(1) = {1}; Plane Surface(2) = {2};\n" +
                "Physical Surface(\"steel\") += {2};\n",
            {"2 separate pieces", "surface 1 from (0, 0) to (4, 4)", "surface 2 from (9, 1)"}},
           {"filled_hole.geo",
            two_loops("1") + "Plane Surface(1) = {1, 2}; Plane Surface(2) = {2};\n" +
                "Physical Surface(\"plug\") = {2};\n",
            {"physical curve 'force:hole': edge from (1, 1) to (2, 1) is not on the body's"}},
           {"broken.geo", "Point(1) = {0, 0, 0};\nfoo bar;\n", {"Gmsh: ", "line 2"}},
           {"truncated.msh",
            plate_msh4.substr(0, plate_msh4.find("0 3 0 1")),
            {"Gmsh: Could not read nodes"}},
       })
    expect_named(complaint(file, text), named);
  const std::string without_roles = complaint("no_roles.geo", unnamed);
  EXPECT_TRUE(without_roles.starts_with("no edges in a physical curve named displacement;"));
  EXPECT_NE(without_roles.find("\n  7      -      force  1          (2, 0)"), std::string::npos);
}

TEST_F(Convert, RefusesWithoutPrinting) {
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
