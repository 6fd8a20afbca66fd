#include "meshgen/geo_script.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "support/errors.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::geo_script_test {
namespace {

using Names = std::set<std::string>;

class GeoScriptFile : public ::testing::Test {
 protected:
  GeoScript read(const std::string& text) {
    return read_geo_script(testing::write_text(folder / "a.geo", text));
  }
  const testing::TemporaryFolder folder;
};

TEST_F(GeoScriptFile, DefinedConstants) {
  const GeoScript script = read(R"(
// DefineConstant[ commented = 1 ];
/* DefineConstant[ too = 1 ]; */
DefineConstant[ h = {1.5, Min 0, Max 2, Name "Size/h"}, w = Max(1, 2), plain ];
DefineConstant [ n = 3 ];
r = DefineNumber[ 3, Name "Size/r" ];
plainly = 3; Printf("DefineConstant[ quoted = 1 ];");
)");
  EXPECT_EQ(script.constants, (Names{"h", "w", "plain", "n"}));
  EXPECT_EQ(script.onelab_names, (Names{"Size/h", "Size/r"}));
  EXPECT_TRUE(script.is_self_contained);
  EXPECT_EQ(script.files.size(), 1u);
}

TEST_F(GeoScriptFile, FollowsWhatItIncludes) {
  std::filesystem::create_directory(folder / "parts");
  testing::write_text(folder / "parts/sizes.geo",
                      "DefineConstant[ h = 1 ];\nMerge \"more.geo\";\n");
  testing::write_text(folder / "parts/more.geo", "Include \"../a.geo\";\n");  // in a ring
  const GeoScript script = read("Include \"parts/sizes.geo\";\n");
  EXPECT_EQ(script.constants, Names{"h"});
  ASSERT_EQ(script.files.size(), 3u);
  EXPECT_EQ(script.files[2], folder / "parts/more.geo");
  EXPECT_TRUE(script.is_self_contained);
}

TEST_F(GeoScriptFile, WhatDependsOnMoreIsTold) {
  for (const char* text : {"Merge StrCat(\"a\", \".step\");\n", "Include \"nowhere.geo\";\n",
                           "v() = ShapeFromFile(\"part.step\");\n", "h = Rand(1);\n",
                           "If(FileExists(\"x\"))\nEndIf\n", "Field[1].FileName = \"sizes\";\n",
                           "SystemCall \"date\";\n", "Printf(GetEnv(\"HOME\"));\n"})
    EXPECT_FALSE(read(text).is_self_contained) << text;
  EXPECT_TRUE(read("// Rand\nPrintf(\"SystemCall\");\n").is_self_contained);
}

TEST_F(GeoScriptFile, OnlyKnownWordsReadNothing) {
  for (const char* text :
       {"SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 2, 1.5e0};\n",
        "h = 2; r() = {1, 2}; r[0] += h;\nFor i In {0:1}\n  Point(i) = {i, h == 2, 0, "
        "r[i]};\nEndFor\n",
        "Field[1] = Distance; Field[1].PointsList = {1}; Mesh.MeshSizeMax = 3;\n"})
    EXPECT_FALSE(read(text).has_unknown_words) << text;
  for (const char* text :
       {"x() = ListFromFile(\"len.txt\");\n", "MergeWithBoundingBox \"a.msh\";\n",
        "FileName = 1; Field[1].FileName = \"sizes\";\n", "Printf('a\\'); \n",
        "Printf('/*'); ListFromFile(\"a\"); Printf('*/');\n",
        "Printf('\"'); ListFromFile(\"a\"); Printf('\"');\n"})
    EXPECT_TRUE(read(text).has_unknown_words) << text;
}

TEST_F(GeoScriptFile, AnyBytesAreRead) {
  for (const std::string text : {"", "\"", "/*", "//", "Include", "DefineConstant[", "Include \"",
                                 "Name", "\\x80\\xff[{(\"\\n"})
    EXPECT_EQ(read(text).files.size(), 1u) << text;
}

TEST_F(GeoScriptFile, Packed) {
  const auto file = testing::write_text(folder / "a.geo",
                                        "DefineConstant[ h = 1 ];\nField[1] = ExternalProcess;\n");
  ASSERT_EQ(std::system(("gzip '" + file.string() + "'").c_str()), 0);
  const GeoScript script = read_geo_script(folder / "a.geo.gz");
  EXPECT_EQ(script.constants, (Names{"h"}));
  EXPECT_TRUE(script.has_external_process);
}

TEST_F(GeoScriptFile, NoSuchFile) { EXPECT_THROW(read_geo_script(folder / "no.geo"), FileError); }

}  // namespace
}  // namespace airybench::geo_script_test
