#include "mesh/selection.hpp"

#include <gtest/gtest.h>

#include "mesh/model_format.hpp"
#include "tests/support/complaint.hpp"

namespace airybench::selection_test {
namespace {

using Names = std::vector<std::string>;

TEST(Selection, RefinedMeshesAreNamedByASuffixAndModelsAreFiles) {
  EXPECT_EQ(expand_mesh_selection("Mesh3+refine5"), Names{"Mesh3+refine5"});
  EXPECT_EQ(expand_mesh_selection("Mesh0..Mesh1+refine2,Mesh0"),
            (Names{"Mesh0+refine2", "Mesh1+refine2", "Mesh0"}));
  EXPECT_EQ(expand_mesh_selection("Mesh[45]+refine1"), (Names{"Mesh4+refine1", "Mesh5+refine1"}));
  const auto parsed = parse_refined_name("Mesh3+refine6");
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->name, "Mesh3");
  EXPECT_EQ(parsed->times, 6);
  EXPECT_EQ(expand_mesh_selection("Mesh1,part.geo,PART.STEP,dir/any"),
            (Names{"Mesh1", "part.geo", "PART.STEP", "dir/any"}));
  EXPECT_FALSE(is_mesh_file("part.txt"));
}

TEST(Selection, ABadSuffixIsRefusedInOneLine) {
  for (const char* item :
       {"Mesh3+refine", "Mesh3+refine0", "Mesh3+refine7", "Mesh3+refine12", "Mesh3+refine-1",
        "Mesh3+fine2", "+refine2", "Mesh9+refine2", "Mesh3+refine1+refine1"}) {
    const std::string complaint =
        testing::complaint_of<std::invalid_argument>([&] { expand_mesh_selection(item); });
    EXPECT_EQ(complaint.find('\n'), complaint.npos) << item;
    EXPECT_NE(complaint.find("+refine1"), complaint.npos) << item << ": " << complaint;
  }
}

TEST(ModelFormat, IsKnownByTheExtension) {
  EXPECT_EQ(format_of("part.msh"), ModelFormat::msh);
  EXPECT_EQ(format_of("a.b/part.geo"), ModelFormat::geo);
  for (const char* file : {"part.step", "PART.STP", "part.brep", "part.Iges", "part.igs"})
    EXPECT_EQ(format_of(file), ModelFormat::cad) << file;
  for (const char* file : {"part", "part.geo.txt", ".geo", "Mesh0", ""})
    EXPECT_EQ(format_of(file), ModelFormat::other) << file;
}

}  // namespace
}  // namespace airybench::selection_test
