// Abaqus' and CalculiX' files: other ways to write the plate, and what is refused because the body
// would be another.
#include <gtest/gtest.h>

#include <array>

#include "mesh/msh_format.hpp"
#include "meshgen/convert.hpp"
#include "support/errors.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/places.hpp"
#include "tests/support/temporary_folder.hpp"

namespace airybench::abaqus_test {
namespace {

using Texts = std::vector<std::string>;

class Abaqus : public ::testing::Test {
 protected:
  // The plate with its only text `old` replaced, each in turn.
  std::filesystem::path plate(const std::vector<std::array<std::string, 2>>& changes) const {
    std::string text = testing::text_of(testing::test_data("models/plate.inp"));
    for (const auto& [old, by] : changes) {
      const std::size_t at = text.find(old);
      if (at == text.npos) throw std::logic_error(old);
      text.replace(at, old.size(), by);
    }
    return testing::write_text(folder_ / "plate.inp", text);
  }
  static std::string converted(const std::filesystem::path& file) {
    Mesh mesh =
        convert_model(file, model_options_of({"Ssole=contact:sole", "Nhead=displacement"}, {}, ""))
            .mesh;
    mesh.name = mesh.body_names[0] = "plate";
    return msh_text(mesh);
  }
  const testing::TemporaryFolder folder_;
};

TEST_F(Abaqus, WaysToWriteTheSame) {
  const std::string expected = converted(plate({}));
  using Changes = std::vector<std::array<std::string, 2>>;
  for (const Changes& changes : std::vector<Changes>{
           {{"ELSET=Eall, MATERIAL", "ELSET=EALL, MATERIAL"}, {"\nEsole, S1", "\nESOLE, s1"}},
           {{"*NSET, NSET=Nhead\n4, 5, 6", "*NSET, NSET=Nhead\n4, 5\n*NSET, NSET=NHEAD\n6"}},
           {{"TYPE=ELEMENT\nEsole, S1", "TYPE=NODE\n1, 1.\n2\n3"}},
           {{"TYPE=CPE4", "TYPE=S4"}, {"Esole, S1", "Esole, S3"}},
           {{"TYPE=CPE4", "TYPE=S4"}, {"Esole, S1", "Esole, E1"}},
           {{"*NODE, ", "*NODE, SYSTEM=R, "}},
           {{"*HEADING", "*INSTANCE, NAME=plate-1, PART=plate\n0., 0., 0.\n*HEADING"}},
       })
    EXPECT_EQ(converted(plate(changes)), expected) << changes[0][1];
}

TEST_F(Abaqus, WhatWouldBeAnotherBodyIsRefused) {
  for (const auto& [old, by, why] : std::vector<std::array<std::string, 3>>{
           {"** nodes", "*INSTANCE, NAME=a, PART=p\n1., 0., 0.", "line 4: *INSTANCE is moved"},
           {"** nodes", "*INSTANCE, NAME=a, PART=p\n*INSTANCE, NAME=b, PART=p",
            "line 4: a second *INSTANCE (allowed: one; "},
           {"** nodes", "*SYSTEM\n1., 0., 0.", "line 3: coordinates of a system of their own "},
           {"*NODE, ", "*NODE, SYSTEM=c, ", "line 4: coordinates of a system of their own "},
           {"*MATERIAL", "*ELGEN\n1, 2\n*MATERIAL", "*ELGEN (allowed: each node and element is "},
           {"*ELEMENT, ", "*ELEMENT, INPUT=e.inp, ", "*ELEMENT of another file (allowed: one "},
           {"Esole, S1", "Esole", "a surface without a side (allowed: as 'Eleft, S1')"},
           {"Esole, S1", "Esole, S5", "side S5 of element 1 is no edge (allowed: S1 to S4)"},
           {"Esole, S1", "Esole, SPOS", "side SPOS of element 1 does not exist"},
       }) {
    const std::filesystem::path file = plate({{old, by}});
    const std::string what = testing::complaint_of<MeshError>([&] { convert_model(file); });
    EXPECT_TRUE(what.starts_with(file.string() + ": line ")) << what;
    EXPECT_NE(what.find(why), std::string::npos) << what;
  }
  const std::filesystem::path shells = plate({{"TYPE=CPE4", "TYPE=S4"}});
  EXPECT_NE(testing::complaint_of<MeshError>([&] {
              convert_model(shells);
            }).find("side S1 of element 1 is no edge (allowed: S3 to S6)"),
            std::string::npos);
}

}  // namespace
}  // namespace airybench::abaqus_test
