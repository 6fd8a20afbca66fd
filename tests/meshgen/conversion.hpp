// Models to convert, and what conversion says of them.
#pragma once

#include <gtest/gtest.h>

#include "mesh/msh_format.hpp"
#include "meshgen/convert.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/places.hpp"
#include "tests/support/temporary_folder.hpp"

namespace airybench::testing {

// Two unit squares side by side. The lines run clockwise around the body.
inline const std::string two_squares_geometry = R"(
h = 0.4;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {2, 0, 0, h};
Point(4) = {0, 1, 0, h}; Point(5) = {1, 1, 0, h}; Point(6) = {2, 1, 0, h};
Line(1) = {2, 1}; Line(2) = {1, 4}; Line(3) = {4, 5}; Line(4) = {5, 2};
Line(5) = {3, 2}; Line(6) = {5, 6}; Line(7) = {6, 3};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, -4, 6, 7}; Plane Surface(2) = {2};
)";
inline const std::string roles = R"(
Physical Curve("displacement") = {2};
Physical Curve("force") = {1, 3, 5, 6};
Physical Curve("contact") = {7};
)";
inline const std::string bodies = R"(
Physical Surface("steel") = {1};
Physical Surface("cast iron") = {2};
)";

// A unit square of four triangles in MSH 4.1, as Gmsh 4.8.4 wrote it.
inline const std::string plate_msh4 = text_of(test_data("meshgen/plate_msh4.msh"));

// The same square in MSH 2.2, the triangles clockwise, with a node of no triangle and wide gaps in
// the numbers.
inline const std::string clockwise_plate = text_of(test_data("meshgen/clockwise_plate.msh"));

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == text.npos) throw std::logic_error("'" + from + "' not found");
  return text.replace(at, from.size(), to);
}

// Two triangles of curves, the second one X further on.
inline std::string two_loops(const std::string& x) {
  return "X = " + x + R"(;
Point(1) = {0, 0, 0, 1}; Point(2) = {4, 0, 0, 1}; Point(3) = {0, 4, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1}; Curve Loop(1) = {1, 2, 3};
Point(4) = {X, 1, 0, 1}; Point(5) = {X + 1, 1, 0, 1}; Point(6) = {X, 2, 0, 1};
Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 4}; Curve Loop(2) = {4, 5, 6};
Physical Curve("displacement") = {1:3}; Physical Curve("force:hole") = {4:6};
Physical Surface("steel") = {1};
)";
}

class Conversion : public ::testing::Test {
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
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what.substr(std::min(prefix.size(), what.size()));
  }

  const TemporaryFolder folder_;
  ModelOptions options_;
};

}  // namespace airybench::testing
