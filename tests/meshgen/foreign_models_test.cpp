// The models of tests/data/models, each of a kind that other programs or people make. Most of them
// are a trapezium with the corners (0, 0), (10, 0), (8, 5), (2, 5).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "mesh/msh_format.hpp"
#include "meshgen/convert.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "support/gzip.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/places.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::foreign_models_test {
namespace {

using Texts = std::vector<std::string>;
using Lengths = std::map<std::string, double>;

std::filesystem::path model(const std::string& name) {
  return testing::test_data("models/" + name);
}

const double side = std::hypot(2, 5);
const Lengths held_above = {{"contact:sole", 10}, {"displacement:head", 6}, {"force", 2 * side}};

struct Kind {
  std::string file;
  Texts roles;
  Lengths lengths;  // mm, of the boundary by its labels
  Texts notes;      // or how they begin
  std::string length_unit = "";
  Texts bodies = {"steel"};
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.file; }

class ForeignModels : public ::testing::TestWithParam<Kind> {};

TEST_P(ForeignModels, BecomeMeshes) {
  const Kind& kind = GetParam();
  const std::filesystem::path file = model(kind.file);
  const ConvertedModel converted =
      convert_model(file, model_options_of(kind.roles, {}, "", kind.length_unit));
  EXPECT_NO_THROW(validate(converted.mesh));
  const Lengths lengths = testing::length_of_boundaries(converted.mesh);
  ASSERT_EQ(lengths.size(), kind.lengths.size());
  for (const auto& [label, length] : kind.lengths) {
    ASSERT_TRUE(lengths.contains(label)) << label;
    EXPECT_NEAR(lengths.at(label), length, 1e-6) << label;
  }
  EXPECT_EQ(converted.mesh.body_names, kind.bodies);
  const bool has_flaw_of_old_gmsh = !kind.notes.empty() && kind.notes[0] == "triangle of nodes ";
  if (has_flaw_of_old_gmsh && !version_of_gmsh().starts_with("4.8.") && converted.notes.empty())
    return;
  ASSERT_EQ(converted.notes.size(), kind.notes.size());
  for (std::size_t k = 0; k < kind.notes.size(); ++k)
    EXPECT_EQ(converted.notes[k].substr(0, kind.notes[k].size()), kind.notes[k]);
}

const Texts by_numbers = {"1=contact:sole", "3=displacement:head"};
const std::string free_2_4 = "no role is given to its curves 2, 4: they are free (force)";

std::vector<Kind> kinds() {
  const Texts body = {"body"};
  const std::string no_role = "no role is given to its curves ",
                    split = " quadrilaterals are split by the shorter diagonal",
                    higher =
                        "of elements of higher order, sides of the boundary keep their curves; "
                        "others are chords";
  const auto held = [&](const char* file, const Texts& roles, const Texts& notes,
                        const Texts& bodies) {
    return Kind{file, roles, held_above, notes, "", bodies};
  };
  const auto numbered = [&](const char* file, const Texts& notes) {
    return held(file, by_numbers, notes, body);
  };
  const auto named = [&](const char* file, const Texts& notes, const char* unit = "") {
    return Kind{file, {}, held_above, notes, unit};
  };
  const auto other = [&](const char* file, const Texts& roles, const Lengths& lengths,
                         const Texts& notes = {}, const char* unit = "") {
    return Kind{file, roles, lengths, notes, unit, body};
  };
  const Lengths two_parts = {{"displacement", 6}, {"force", 2 * side + 2 * std::hypot(5, 5)}};
  return {
      numbered("numbers.geo", {free_2_4}),
      other("numbers.geo", {"3=displacement", "1-2=contact", "rest=force:left"},
            {{"displacement", 6}, {"contact", 10 + side}, {"force:left", side}}),
      // A number's role counts more than its range's, and that more than the rest's.
      other("numbers.geo", {"1-4=force", "1=contact:sole", "3=displacement:head", "rest=contact"},
            held_above),
      other("names.geo", {"Support=displacement", "1=contact", "7=force:flank"},
            {{"displacement", 6}, {"contact", 10}, {"force:flank", side}, {"force", side}},
            {no_role + "4: they are free (force)"}),
      other("names.geo", {"Support=displacement", "rest=force"},
            {{"displacement", 6}, {"force", 10 + 2 * side}}),
      {"two_surfaces.geo", {"3=displacement", "rest=force"}, two_parts, {}, "", {"body1", "body2"}},
      {"whole_and_parts.geo",
       {"3=displacement", "rest=force"},
       two_parts,
       {"physical surface 'whole' is no body: each of its surfaces is in another one"},
       "",
       {"upper", "lower"}},
      other("corner.geo", {"rest=displacement"}, {{"displacement", 80}}, {"triangle of nodes "}),
      held("mesh2_0.msh", {"11=contact:sole", "12=displacement:head", "13=force"}, {}, {"plate"}),
      held("old.msh", {"11=contact:sole", "12=displacement:head", "13=force"}, {}, body),
      named("options.geo", {free_2_4}),
      named("unended.geo", {free_2_4}),
      named("metres.geo", {free_2_4}, "m"),
      named("scaled.geo", {"lengths are multiplied by its Mesh.ScalingFactor, 1000", free_2_4}),
      named("upright.geo", {"it lies in the plane y = 7: its x and z are x and y here", free_2_4}),
      named("sideways.geo",
            {"it lies in the plane x = -3: its y and z are x and y here", free_2_4}),
      named("recombined.geo", {higher, "9" + split, free_2_4}),
      named("trapezium.msh.gz", {no_role + "'sides': they are"}),
      named("trapezium.unv", {no_role + "'sides': they are"}),
      numbered("trapezium.vtk", {free_2_4}),
      numbered("trapezium.bdf",  // fields of 8 characters
               {free_2_4, "vertices moved onto straight sides: "}),
      numbered("trapezium.mesh", {free_2_4}),
      numbered("trapezium.stl", {free_2_4}),
      numbered("trapezium.obj", {"1" + split, free_2_4}),
#ifdef AIRYBENCH_HAS_HDF5
      named("trapezium.med.gz", {"1" + split, no_role}),
#endif
      held("freefem.msh", {"11=contact:sole", "13=displacement:head", "-1=force"}, {no_role},
           {"body2", "body5"}),
      numbered("trapezium.brep", {free_2_4}),
      other("trapezium.brep", {"rest=displacement"}, {{"displacement", 25.4 * (16 + 2 * side)}}, {},
            "inch"),
      held("plate.inp", {"Ssole=contact:sole", "Nhead=displacement:head", "Nleft=force"},
           {"2" + split, no_role}, {"Eall"}),
  };
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, ForeignModels, ::testing::ValuesIn(kinds()));

// The first is nearest to a square where its nodes 2 and 4 face each other; the second is concave.
TEST(ForeignModel, QuadrilateralsAreSplitInside) {
  const Mesh mesh = convert_model(model("quadrilaterals.msh")).mesh;
  ASSERT_EQ(mesh.triangles.size(), 4u);
  const MeshEdges edges = number_edges(mesh);
  const auto has_edge = [&](int a, int b) {  // nodes
    return std::ranges::find(edges.vertices, std::array{a - 1, b - 1}) != edges.vertices.end();
  };
  EXPECT_TRUE(has_edge(2, 4));
  EXPECT_TRUE(has_edge(2, 6));
}

TEST(ForeignModel, OfADamagedMedThePartIsNamedThatCannotBeRead) {
  const testing::TemporaryFolder folder;
  std::string text = unpacked_text(model("trapezium.med.gz"));
  text.at(14187) ^= 0x55;
  const std::filesystem::path file = testing::write_text(folder / "a.med", text);
  EXPECT_EQ(testing::complaint_of<MeshError>([&] { convert_model(file, {}); }),
            file.string() +
                ": /ENS_MAA/Mesh_1/-0000000000000000001-0000000000000000001/MAI/TR3/NOD is "
                "damaged, or of another kind");
}

TEST(ForeignModel, ACutOrDamagedGzipIsRefused) {
  const testing::TemporaryFolder folder;
  const std::string whole = testing::text_of(model("trapezium.msh.gz"));
  for (const auto& [bytes, why] : std::map<std::string, std::string>{
           {whole.substr(0, whole.size() / 2), "ends before what gzip has packed does"},
           {whole + "more", "is not of gzip, or damaged"}}) {
    const std::filesystem::path file = testing::write_text(folder / "m.msh.gz", bytes);
    EXPECT_EQ(testing::complaint_of<MeshError>([&] { convert_model(file); }),
              file.string() + ": " + why);
  }
}

TEST(ForeignModel, SizesAreInMillimetresWhateverTheUnit) {
  const testing::TemporaryFolder folder;
  for (const char* factor : {"", "Mesh.MeshSizeFactor = 0.5;\n"}) {
    const auto file =
        testing::write_text(folder / "metres.geo", testing::text_of(model("metres.geo")) + factor);
    const Mesh mesh = convert_model(file, model_options_of({}, {}, "0.5", "m")).mesh;
    EXPECT_GT(mesh_sizes(mesh).contact_edges, 18) << factor;
    EXPECT_LT(mesh_sizes(mesh).contact_edges, 24) << factor;
  }
}

TEST(ForeignModel, SidesThatRoundingBendsAreStraight) {
  constexpr double inch = 25.4;
  Mesh block = testing::small_block(4, 4, 30);
  for (Eigen::Vector2d& x : block.vertices)
    x = (x / inch).unaryExpr([](double c) { return std::round(c * 1e6) / 1e6; });
  const testing::TemporaryFolder folder;
  const auto file = testing::write_text(folder / "block.msh", msh_text(block));
  const auto [mesh, notes] = convert_model(file, model_options_of({}, {}, "", "inch"));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(notes[0].starts_with("vertices moved onto straight sides: 8, by up to ")) << notes[0];
  EXPECT_LT(testing::largest_bend(mesh), 1e-12);
  const Eigen::Vector2d along(-0.5, std::sqrt(0.75));
  const auto chains = boundary_chains(mesh, BoundaryRole::displacement);
  for (const int row : chains.at(0)) {
    const auto [a, b] = mesh.boundary[row].vertices;
    EXPECT_LT(((mesh.vertices[b] - mesh.vertices[a]).normalized() + along).norm(), 1e-4);
  }
}

// The chord of the bent line crosses the notch.
TEST(ForeignModel, BentLinesAreNotTakenForTheirChords) {
  const testing::TemporaryFolder folder;
  const auto file = testing::write_text(folder / "notch.geo", R"(
Point(1) = {0, 0, 0, 1}; Point(2) = {0, -5, 0, 1}; Point(3) = {10, -5, 0, 1};
Point(4) = {10, 0, 0, 1}; Point(5) = {10, 5, 0, 1}; Point(6) = {6, 5, 0, 1};
Point(7) = {5, -2, 0, 1}; Point(8) = {4, 5, 0, 1}; Point(9) = {0, 5, 0, 1};
Line(1) = {1, 2, 3, 4}; Line(2) = {4, 5}; Line(3) = {5, 6}; Line(4) = {6, 7}; Line(5) = {7, 8};
Line(6) = {8, 9}; Line(7) = {9, 1};
Curve Loop(1) = {1:7}; Plane Surface(1) = {1};
)");
  const Mesh mesh = convert_model(file, model_options_of({"2=displacement"}, {}, "")).mesh;
  EXPECT_NEAR(testing::length_of_boundaries(mesh).at("displacement"), 5, 1e-9);
}

// MSH 2 has as many tags as a program likes; Gmsh wants two.
TEST(ForeignModel, AMeshWithOneTagTakesRoles) {
  const Mesh mesh = convert_model(testing::test_data("meshgen/one_tag.msh"),
                                  model_options_of({"force=contact"}, {}, ""))
                        .mesh;
  EXPECT_EQ(mesh_sizes(mesh).contact_edges, 2);
  EXPECT_EQ(mesh_sizes(mesh).displacement_edges, 1);
}

// As other programs, editors and transfers leave the files: the mesh is the same, or none is made.
TEST(ForeignModel, TextsAreReadWhateverWroteThem) {
  const auto lines_end_with = [](const std::string& end) {
    return [=](const std::string& text) {
      std::string out;
      for (const std::string& line : testing::lines_of(text)) out += line + end;
      return out;
    };
  };
  const testing::TemporaryFolder folder;
  for (const char* name : {"names.geo", "old.msh", "mesh2_0.msh", "trapezium.unv", "trapezium.vtk",
                           "trapezium.bdf", "trapezium.mesh", "trapezium.stl", "plate.inp"}) {
    const std::string text = testing::text_of(model(name));
    const ModelOptions held = model_options_of({"rest=displacement"}, {}, "");
    const auto sizes_of = [&](const std::string& changed) {
      return mesh_sizes(convert_model(testing::write_text(folder / name, changed), held).mesh);
    };
    const MeshSizes sizes = sizes_of(text);
    for (const std::string& changed :
         {lines_end_with("\r\n")(text), lines_end_with(" \t\n")(text), "\xef\xbb\xbf" + text}) {
      EXPECT_EQ(sizes_of(changed).n_phi, sizes.n_phi) << name;
      EXPECT_EQ(sizes_of(changed).displacement_edges, sizes.displacement_edges) << name;
    }
    const bool is_tried = text.starts_with("solid") || std::string(name).ends_with(".msh");
    const std::string spread = "\n" + lines_end_with("\n\n")(text);
    EXPECT_EQ(sizes_of(is_tried ? spread : text).n_phi, sizes.n_phi) << name;
  }
}

TEST(ForeignModel, DamagedTextIsToldAsSuch) {
  const testing::TemporaryFolder folder;
  const auto complaint = [&](const std::string& name, const std::string& text) {
    const std::filesystem::path file = testing::write_text(folder / name, text);
    const std::string what = testing::complaint_of<MeshError>(
        [&] { convert_model(file, model_options_of({"rest=displacement"}, {}, "")); });
    return what.substr(std::min(what.size(), file.string().size() + 2));
  };
  const auto text = [](const char* name) { return testing::text_of(model(name)); };
  const std::string stl = text("trapezium.stl"), brep = text("trapezium.brep");
  const std::size_t second_facet = stl.find("facet normal", stl.find("endfacet") + 9);
  const std::string cut = "its last line is not endsolid; is it truncated?";
  EXPECT_EQ(complaint("cut.stl", stl.substr(0, second_facet)), cut);
  EXPECT_EQ(complaint("cut.stl", stl.substr(0, stl.rfind("vertex"))), cut);
  std::string one_more = stl;
  one_more.insert(stl.rfind("vertex"), "vertex 1 1 0\n");
  EXPECT_EQ(complaint("four.stl", one_more), "facet 2 has not 3 vertices");
  EXPECT_EQ(complaint("cut.brep", brep.substr(0, brep.size() / 2)),
            "its end is missing; is it truncated?");
  std::string commas = brep;
  std::ranges::replace(commas, '.', ',');
  EXPECT_EQ(complaint("commas.brep", commas), "Gmsh: OpenCASCADE cannot read it");
  EXPECT_EQ(complaint("zero.mesh", text("trapezium.mesh").insert(300, 1, '\0')),
            "it holds the byte 0 (allowed: text)");
  EXPECT_EQ(complaint("wide.geo", "\xff\xfeP"), "it is UTF-16 text (allowed: UTF-8)");
  std::string huge = text("numbers.geo");
  huge.replace(huge.find("{10, 0"), 6, "{1e30, 0");
  EXPECT_EQ(complaint("huge.geo", huge),
            "it has a coordinate 1e+30 (allowed: up to 1e+09 in size)");
}

// MSH 2 has an element once for each physical group.
TEST(ForeignModel, AnElementInTwoGroupsIsOneTriangle) {
  const testing::TemporaryFolder folder;
  std::string text = testing::text_of(model("mesh2_0.msh"));
  text.replace(text.find("$Elements\n8"), 11, "$Elements\n12");
  for (int k = 5; k <= 8; ++k) {
    const std::size_t at = text.find(fmt::format("\n{} 2 3 21 ", k)) + 1;
    std::string again = text.substr(at, text.find('\n', at) - at + 1);
    again.replace(again.find(" 21 "), 4, " 22 ").replace(0, 1, std::to_string(k + 4));
    text.insert(text.find("$EndElements"), again);
  }
  const ConvertedModel converted = convert_model(testing::write_text(folder / "twice.msh", text),
                                                 model_options_of({"rest=displacement"}, {}, ""));
  EXPECT_EQ(converted.mesh.triangles.size(), 4u);
  EXPECT_EQ(converted.mesh.body_names, (Texts{"plate"}));
  EXPECT_EQ(converted.notes, (Texts{"physical surface 'body22' is no body: each of its surfaces is "
                                    "in another one"}));
}

// A name that resembles a role is asked about, unless the role is given to it.
TEST(ForeignModel, ANameLikeARoleIsAskedAbout) {
  const std::string begin = "physical curve '", no_role = "': no role, perhaps ";
  for (const auto& [name, role] :
       std::vector<std::pair<std::string, std::string>>{{"contct", "contact"},
                                                        {"Contact", "contact"},
                                                        {"contacts", "contact"},
                                                        {"contact_left", "contact"},
                                                        {"left contact", "contact"},
                                                        {"ForceTop", "force"},
                                                        {"dispalcement:top", "displacement"},
                                                        {"contact:", "contact"}}) {
    std::string text = testing::text_of(model("names.geo"));
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "named.geo";
    std::ofstream(file) << text.replace(text.find("Sole"), 4, name);
    const auto complaint = [&](Texts roles) {
      roles.insert(roles.end(), {"Support=displacement", "7=force"});
      return testing::complaint_of<MeshError>(
          [&] { convert_model(file, model_options_of(roles, {}, "")); });
    };
    EXPECT_TRUE(complaint({}).starts_with(file.string() + ": " + begin + name + no_role + role))
        << complaint({});
    EXPECT_EQ(complaint({"rest=force"}), complaint({})) << name;
    EXPECT_EQ(complaint({name + "=force"}), "no complaint");
    EXPECT_EQ(complaint({"1=contact"}), "no complaint");
  }
}

TEST(ForeignModel, WhatFilesLackThatGmshDoesNotReadIsTold) {
  const testing::TemporaryFolder folder;
  const std::string plate = "4 2 4\n0 0 1\n1 0 1\n1 1 2\n0 1 2\n1 2 3 0\n1 3 4 0\n",
                    sides = "1 2 1\n2 3 2\n3 4 3\n4 1 4\n", corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (const auto& [name, text, why] : std::vector<std::array<std::string, 3>>{
           {"cut.msh", plate, "it ends where 'vertex vertex label' should come; is it truncated?"},
           {"long.msh", plate + sides + "1 3 5\n", "line 12: more than its first line says"},
           {"word.msh", "4 2 4\n0 0 1\n1 zero 1\n", "line 3: '1 zero 1' (expected: x y label)"},
           {"space.msh", "4 2 4\n0 0 0 1\n", "line 2: '0 0 0 1' (expected: x y label)"},
           {"vertex.msh", "3 1 0\n0 0 1\n1 0 1\n1 1 2\n1 2 4 0\n",
            "line 5: vertex 4 (allowed: 1 to 3)"},
           {"none.msh", "3 0 3\n", "line 1: no mesh of triangles"},
           {"face.obj", corners + "f 1 2 4\n", "line 4: vertex '4' (allowed: 1 to 3)"},
           {"line.obj", corners + "f 1 2\n", "line 4: a face of 2 corners (allowed: 3 or 4)"},
           {"flat.obj", "v 0 0\n", "line 1: 'v 0 0' (expected: v x y z)"},
#ifdef AIRYBENCH_HAS_HDF5
           {"text.med", plate, "it cannot be opened (allowed: an HDF5 file)"},
#endif
           {"points.obj", corners, "no line f, a face"}}) {
    const std::filesystem::path file = testing::write_text(folder / name, text);
    EXPECT_EQ(testing::complaint_of<MeshError>([&] { convert_model(file); }),
              file.string() + ": " + why);
  }
  const auto file = testing::write_text(folder / "plate.msh", plate + sides);
  const Mesh mesh =
      convert_model(file, model_options_of({"1=displacement", "rest=force"}, {}, "")).mesh;
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.body_names, Texts{"body"});
}

TEST(ForeignModel, WhatCannotBeReadIsTold) {
  for (const auto& [file, role, why] : std::vector<std::array<std::string, 3>>{
           {"names.geo", "Suport=displacement", "no physical curve 'Suport', perhaps 'Support'"},
           {"plate.inp", "SSOLE=displacement", "no physical curve 'SSOLE', perhaps 'Ssole'"},
           {"tilted.geo", "", "it lies in no plane x, y or z = constant"},
           {"solid.inp", "", "line 6: elements of type C3D4"},
           {"options.geo.opt", "", "no model (what can be read: *.geo, *.msh, *.step, "}}) {
    const std::filesystem::path path = model(file);
    const ModelOptions options = model_options_of(role.empty() ? Texts{} : Texts{role}, {}, "");
    testing::expect_named(testing::complaint_of<MeshError>([&] { convert_model(path, options); }),
                          {path.string() + ": ", why});
  }
}

}  // namespace
}  // namespace airybench::foreign_models_test
