#include "mesh/model_format.hpp"

#include <gtest/gtest.h>

#include "mesh/selection.hpp"

namespace airybench::model_format_test {
namespace {

TEST(ModelFormat, IsKnownByTheExtension) {
  EXPECT_EQ(format_of("part.msh"), ModelFormat::msh);
  EXPECT_EQ(format_of("a.b/part.geo"), ModelFormat::geo);
  for (const char* file : {"part.step", "PART.STP", "part.brep", "part.Iges", "part.igs"})
    EXPECT_EQ(format_of(file), ModelFormat::cad) << file;
  for (const char* file : {"part", "part.geo.txt", ".geo", "Mesh0", ""})
    EXPECT_EQ(format_of(file), ModelFormat::other) << file;
}

TEST(ModelFormat, ASelectionTakesModelsAsFiles) {
  EXPECT_EQ(expand_mesh_selection("Mesh1,part.geo,PART.STEP,dir/any"),
            (std::vector<std::string>{"Mesh1", "part.geo", "PART.STEP", "dir/any"}));
  EXPECT_FALSE(is_mesh_file("part.txt"));
}

}  // namespace
}  // namespace airybench::model_format_test
