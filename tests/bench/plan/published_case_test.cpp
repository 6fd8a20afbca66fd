#include "bench/plan/published_case.hpp"

#include <gtest/gtest.h>

#include "tests/support/complaint.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::published_case_test {
namespace {

class PublishedCaseFile : public ::testing::Test {
 protected:
  PublishedCase read(const std::string& quantities) {
    testing::write_text(file_, R"({"title": "Ring", "source": "Lamé", "model": "ring.geo",
      "scene": {"poisson": 0.3}, "error_percent": 0.5, "quantities": [)" +
                                   quantities + "]}");
    return read_published_case(file_);
  }
  static std::string quantity(const std::string& rest) {
    return R"({"name": "n", "unit": "MPa", "formula": "f", "allowed_percent": 1, "because": "b", )" +
           rest + "}";
  }
  const testing::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "ring.json";
};

TEST_F(PublishedCaseFile, IsRead) {
  const PublishedCase ring = read(
      quantity(R"("of": "sxx_MPa", "at_mm": [1, 2], "value": 3, "times": 2)") + "," +
      quantity(
          R"("of": "pressure_MPa", "face": "contact", "at_mm": [[0, 1], [2, 3]], "value": [-5, 4])"));
  EXPECT_EQ(ring.name, "ring");
  EXPECT_EQ(ring.model, folder_ / "ring.geo");
  EXPECT_EQ(ring.scene->scene.name, "ring");
  EXPECT_EQ(ring.error, 0.005);
  ASSERT_EQ(ring.quantities.size(), 2U);
  EXPECT_EQ(ring.quantities[0].times, 2);
  EXPECT_EQ(ring.quantities[0].allowed, 0.01);
  EXPECT_TRUE(ring.quantities[1].is_profile());
  EXPECT_EQ(ring.quantities[1].largest(), 5);
  // Those of faces are in another file.
  EXPECT_EQ(ring.points_mm(), (std::vector<Eigen::Vector2d>{{1, 2}}));
}

TEST_F(PublishedCaseFile, WhatIsWrongIsNamed) {
  for (const auto& [given, named] : std::vector<std::pair<std::string, std::string>>{
           {"", "quantities"},
           {quantity(R"("of": "sxx_MPa", "value": 3)"), "quantities: of"},
           {quantity(R"("of": "slip_mm", "face": "contact", "value": 3)"), "quantities: of"},
           {quantity(R"("of": "sxx_MPa", "at_mm": [1], "value": 3)"), "quantities: at_mm"},
           {quantity(R"("of": "sxx_MPa", "at_mm": [[1, 2]], "value": [3, 4])"),
            "quantities: at_mm"},
           {quantity(R"("of": "sxx_MPa", "at_mm": [1, 2], "value": "3")"), "quantities: value"},
           {quantity(R"("of": "sxx_MPa", "at_mm": [1, 2], "value": 3, "more": 4)"),
            "quantities: more"},
           {R"({"name": "n"})", "quantities: value"}}) {
    const auto what = testing::complaint_of<InputError>([&, &of = given] { read(of); });
    EXPECT_TRUE(testing::contains(what, file_.string() + ": " + named)) << given << ": " << what;
    EXPECT_FALSE(testing::contains(what, "\n"));
  }
}

TEST(PublishedCases, AreChosenByName) {
  EXPECT_EQ(published_cases("lame_r*").size(), 1U);
  EXPECT_GE(published_cases("").size(), 1U);
  EXPECT_TRUE(testing::contains(
      testing::complaint_of<InputError>([] { published_cases("lame_ring,nothing"); }),
      "CASE: nothing (allowed: "));
}

}  // namespace
}  // namespace airybench::published_case_test
