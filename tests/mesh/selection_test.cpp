#include "mesh/selection.hpp"

#include <gtest/gtest.h>

namespace airybench::selection_test {
namespace {

using Names = std::vector<std::string>;

TEST(Selection, RefinedMeshesAreNamedByASuffix) {
  EXPECT_EQ(expand_mesh_selection("Mesh3+refine5"), Names{"Mesh3+refine5"});
  EXPECT_EQ(expand_mesh_selection("Mesh0..Mesh1+refine2,Mesh0"),
            (Names{"Mesh0+refine2", "Mesh1+refine2", "Mesh0"}));
  EXPECT_EQ(expand_mesh_selection("Mesh[45]+refine1"), (Names{"Mesh4+refine1", "Mesh5+refine1"}));
  const auto parsed = parse_refined_name("Mesh3+refine6");
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->name, "Mesh3");
  EXPECT_EQ(parsed->times, 6);
}

TEST(Selection, ABadSuffixIsRefusedInOneLine) {
  for (const char* item :
       {"Mesh3+refine", "Mesh3+refine0", "Mesh3+refine7", "Mesh3+refine12", "Mesh3+refine-1",
        "Mesh3+fine2", "+refine2", "Mesh9+refine2", "Mesh3+refine1+refine1"}) {
    try {
      expand_mesh_selection(item);
      FAIL() << item << " was accepted";
    } catch (const std::invalid_argument& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find('\n'), what.npos);
      EXPECT_NE(what.find("+refine1"), what.npos) << what;
    }
  }
}

}  // namespace
}  // namespace airybench::selection_test
