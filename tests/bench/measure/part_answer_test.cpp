// What is printed of a part: against the contact forces, balance and stresses that it comes from.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "assembly/total_displacement.hpp"
#include "bench/measure/part_answer.hpp"
#include "bench/measure/part_picture.hpp"
#include "bench/measure/stress_samples.hpp"
#include "bench/report/part_table.hpp"
#include "support/lists.hpp"
#include "tests/bench/measure/csv_columns.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/solved_body.hpp"

namespace airybench::part_answer_test {
namespace {

TEST(PartAnswer, EquivalentAndPrincipalStresses) {
  EXPECT_DOUBLE_EQ(von_mises({-7, 0, 0}, 0), 7);
  EXPECT_DOUBLE_EQ(von_mises({0, 0, 2}, 0), 2 * std::sqrt(3.));
  EXPECT_NEAR(von_mises({1, 1, 0}, 1), 0, 1e-15);  // the same in all directions
  EXPECT_EQ(principal_stresses({1, 1, 3}), Eigen::Vector2d(4, -2));
}

class OfTooth : public ::testing::TestWithParam<int> {
 protected:
  const testing::Solved solved_{Scene{}, testing::small_tooth(6, 4), GetParam()};
  const SolvedFields fields_{solved_.system, solved_.hybrid, solved_.w, nullptr, nullptr, {}};
  const PartFiles files_ =
      part_files(fields_, contact_picture(solved_.system, solved_.hybrid, solved_.w));
  const PartAnswer& answer_ = files_.answer;
};

TEST_P(OfTooth, ForcesAreThoseOfTheLawAndInBalance) {
  ASSERT_EQ(answer_.faces.size(), 1u);
  ASSERT_EQ(answer_.supports.size(), 1u);
  const FaceAnswer& face = answer_.faces.front();
  const Eigen::VectorXd& F = solved_.hybrid.F_C;
  double normal = 0, tangential = 0;
  for (Eigen::Index i = 0; i < F.size(); i += 2) {
    normal += F(i);
    tangential += F(i + 1);
  }
  EXPECT_NEAR(face.normal_N, normal, 1e-9 * std::abs(normal));
  EXPECT_NEAR(face.tangential_N, tangential, 1e-9 * std::abs(normal));
  EXPECT_LT((face.force_N + answer_.supports.front().force_N).norm(), 1e-8 * std::abs(normal));
  EXPECT_NEAR(face.force_N.norm(), std::hypot(normal, tangential), 1e-8 * std::abs(normal));
}

TEST_P(OfTooth, ContactLengthsAddUp) {
  const FaceAnswer& face = answer_.faces.front();
  EXPECT_NEAR(face.length_mm, 6, 1e-12);
  EXPECT_GT(face.closed_mm, 0);
  EXPECT_LT(face.closed_mm, face.length_mm);  // the wall has a crown
  EXPECT_GT(face.slipping_mm, 0);
  EXPECT_LT(face.slipping_mm, face.closed_mm);
}

TEST_P(OfTooth, TheLargestValuesAreThoseOfTheFields) {
  double largest = 0;
  for (std::size_t t = 0; t < solved_.hybrid.stress.size(); ++t) {
    const ElementStress corners = solved_.hybrid.stress.corners(t);
    for (const auto s : corners.colwise())
      largest = std::max(largest, von_mises(s, 0.3 * (s(0) + s(1))));
  }
  EXPECT_GE(answer_.stress.von_mises.value, largest * (1 - 1e-12));
  EXPECT_LT(answer_.stress.von_mises.value, largest * (GetParam() > 1 ? 1.2 : 1 + 1e-9));
  ASSERT_TRUE(answer_.displacement_mm);
  EXPECT_GE(answer_.displacement_mm->value, Scene().displacement_mm.norm() * (1 - 1e-9));
}

// At fewer points of the same lattices.
TEST_P(OfTooth, ThePictureHasTheLargestStress) {
  const std::vector<std::string> lines = testing::lines_of(von_mises_csv(fields_));
  double largest = 0;
  for (std::size_t row = 1; row < lines.size(); ++row)
    largest = std::max(largest, std::stod(split_list(lines[row]).at(3)));
  EXPECT_NEAR(largest, answer_.stress.von_mises.value, 0.05 * largest);
}

// Nine points of each, with what is prescribed there.
TEST_P(OfTooth, TheOutlineHasEveryEdge) {
  const Problem& problem = *solved_.system.problem;
  const std::vector<std::string> lines =
      testing::lines_of(outline_csv(problem, GetParam(), with_rigid_motion(problem, solved_.w)));
  const Eigen::Vector2d held = Scene().displacement_mm;
  std::map<std::string, int> points;
  for (std::size_t row = 1; row < lines.size(); ++row) {
    const std::vector<std::string> cells = split_list(lines[row]);
    ++points[cells.at(0)];
    if (cells.at(8) != "displacement") continue;
    EXPECT_NEAR(std::stod(cells[4]), held.x(), 1e-9);
    EXPECT_NEAR(std::stod(cells[5]), held.y(), 1e-9);
  }
  EXPECT_EQ(points.size(), problem.mesh.boundary.size());
  for (const auto& [edge, count] : points) EXPECT_EQ(count, 9) << edge;
}

// The pressures of the file, integrated by Simpson's rule over each half edge.
TEST_P(OfTooth, TheFileOfFacesHasThePressure) {
  const testing::Columns columns = testing::csv_columns(files_.faces_csv);
  const std::vector<double> along = testing::numbers(columns, "along_mm"),
                            pressure = testing::numbers(columns, "pressure_MPa"),
                            shear = testing::numbers(columns, "shear_MPa");
  EXPECT_EQ(columns.at("face"), std::vector<std::string>(along.size(), "contact"));
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k + 2 < along.size(); k += k % 5 == 2 ? 3 : 2) {
    const double part = (along[k + 2] - along[k]) / 6;
    sum.x() += part * (pressure[k] + 4 * pressure[k + 1] + pressure[k + 2]);
    sum.y() += part * (shear[k] + 4 * shear[k + 1] + shear[k + 2]);
  }
  const FaceAnswer& face = answer_.faces.front();
  const double allowed = (GetParam() > 3 ? 1e-3 : 1e-9) * std::abs(face.normal_N);
  EXPECT_NEAR(sum.x(), -face.normal_N, allowed);
  EXPECT_NEAR(sum.y(), face.tangential_N, allowed);
  EXPECT_LE(std::ranges::max(pressure), face.pressure_MPa.value * (1 + 1e-9));
}

// Against 1 and s along each edge, by Boole's rule.
TEST_P(OfTooth, TheFileOfFacesHasTheMomentsOfGapAndSlip) {
  const testing::Columns columns = testing::csv_columns(files_.faces_csv);
  const ContactPicture picture = contact_picture(solved_.system, solved_.hybrid, solved_.w);
  const int k = GetParam();
  const auto expect_moments = [&](const char* name, const std::vector<double>& moments) {
    constexpr std::array weights = {7., 32., 12., 32., 7.};
    const std::vector<double> values = testing::numbers(columns, name);
    Eigen::Vector2d of_file = Eigen::Vector2d::Zero(), of_points = of_file;
    for (std::size_t i = 0; i < values.size(); ++i)
      of_file += (k + 1) * weights[i % 5] / 90 * values[i] * Eigen::Vector2d(1, i % 5 / 4.);
    for (std::size_t p = 0; p < moments.size(); ++p)
      of_points += moments[p] * Eigen::Vector2d(1, static_cast<double>(p % (k + 1)) / k);
    EXPECT_LT((of_file - of_points).norm(), 1e-9 * of_points.norm()) << name;
  };
  expect_moments("gap_mm", picture.gap_mm);
  expect_moments("slip_mm", picture.slip_mm);
}

INSTANTIATE_TEST_SUITE_P(Degrees, OfTooth, ::testing::Values(1, 2, 3));

// Of a face: how far each value may be off, or that the pressure may be infinite.
TEST(PartTable, FacesHaveTheirIntervals) {
  const auto row = [](const char* pressure) {
    Json part = parse_json(R"({"faces": [{"name": "contact:sole", "force_N": [0, 8], "normal_N": -8,
        "tangential_N": 1, "length_mm": 4, "closed_mm": 2, "slipping_mm": 0,
        "normal_in_N": [-8.5, -7.75]}], "supports": [], "von_mises_MPa": {"value": 1, "at_mm": [0, 0]},
        "principal_MPa": {"value": 1, "at_mm": [0, 0]}, "bodies": [], "unbounded": []})");
    part["faces"][0]["pressure_MPa"] = parse_json(pressure);
    return std::get<1>(part_report(Record(), part).front()).at(1);
  };
  const std::vector<std::string> bounded =
      row(R"({"value": 6, "at_mm": [1, 0], "is": "bounded", "in": [5.5, 7]})");
  EXPECT_EQ(bounded, split_list("contact:sole;0, 8;-8 ± 0.5;1;6 ± 1;(1, 0);2 of 4;0", ';'));
  EXPECT_EQ(row(R"({"value": 6, "at_mm": [1, 0], "is": "unbounded"})").at(4), "unbounded");
  EXPECT_EQ(row(R"({"value": 6, "at_mm": [1, 0], "is": "not seen"})").at(4), "6 or unbounded");
  EXPECT_EQ(row(R"({"value": 0, "at_mm": [0, 0], "is": "bounded"})").at(4), "-");
}

TEST(PartTable, SaysThatSlipInOneStepDependsOnThePath) {
  Json part = parse_json(R"({"faces": [{"name": "contact:sole", "force_N": [0, 8], "normal_N": -8,
      "tangential_N": 1, "length_mm": 4, "closed_mm": 2, "slipping_mm": 1,
      "pressure_MPa": {"value": 6, "at_mm": [1, 0], "is": "not seen"}}], "supports": [],
      "von_mises_MPa": {"value": 1, "at_mm": [0, 0]},
      "principal_MPa": {"value": 1, "at_mm": [0, 0]}, "bodies": [], "unbounded": []})");
  const auto says_so = [&](const Record& record) {
    return testing::contains(text_of(part_report(record, part)), "the path of the load");
  };
  Record record;
  record.error_total = 0.01;
  EXPECT_FALSE(says_so(record));  // without friction
  record.tangential_resultant_N = 1;
  EXPECT_TRUE(says_so(record));
  Record path = record;
  path.steps.resize(2);
  EXPECT_FALSE(says_so(path));
  part["faces"][0]["slipping_mm"] = 0;
  EXPECT_FALSE(says_so(record));
}

TEST(PartTable, SeveralBodiesHaveTheirLargestStresses) {
  const Json part = parse_json(R"({"faces": [], "supports": [],
      "von_mises_MPa": {"value": 7, "at_mm": [1, 2]}, "principal_MPa": {"value": 8, "at_mm": [1, 2]},
      "bodies": [{"name": "pin", "von_mises_MPa": {"value": 7, "at_mm": [1, 2], "off": 0.25},
                  "principal_MPa": {"value": -6, "at_mm": [3, 4]}}], "unbounded": []})");
  const auto rows = std::get<1>(part_report(Record(), part).front());
  EXPECT_EQ(rows.at(1), split_list("pin;7 ± 0.25;(1, 2);-6;(3, 4);", ';'));
}

TEST(PartTable, NamesPlacesOfUnboundedStressByWhatTheyAre) {
  Json part =
      parse_json(R"({"faces": [], "supports": [], "von_mises_MPa": {"value": 7, "at_mm": [1, 2],
      "off": 0.25}, "principal_MPa": {"value": -3, "at_mm": [0, 0]}, "bodies": [], "unbounded": []})");
  const auto report = [&] {
    std::string text;
    for (const auto& line : part_report(Record(), part))
      if (const auto* words = std::get_if<std::string>(&line)) text += *words + "\n";
    return text;
  };
  EXPECT_TRUE(testing::contains(report(),
                                "largest von Mises stress 7 ± 0.25 MPa at (1, 2)\n"
                                "largest principal stress -3 MPa at (0, 0)\n"));
  EXPECT_FALSE(testing::contains(report(), "unbounded"));
  for (int k = 0; k < 5; ++k)
    part["unbounded"].push_back(
        {{"what", k == 0 ? "the end of displacement:foot" : "a re-entrant corner"},
         {"at_mm", {k, 1}},
         {"within_mm", 0.52}});
  EXPECT_TRUE(testing::contains(
      report(),
      "stress unbounded at (1, 1), (2, 1), (3, 1) and 1 more: a re-entrant corner; (0, 1): the end "
      "of displacement:foot (largest: outside circles of up to 0.52 mm there)\n"));
}

// The corners of a hole and the ends of the root.
TEST(PartAnswer, TheLargestStressIsThatAwayFromPlacesWhereItIsUnbounded) {
  Scene scene;
  scene.friction = 0;
  const testing::Solved solved(scene, testing::small_plate(2), 2);
  const SolvedFields fields{solved.system, solved.hybrid, solved.w, nullptr, nullptr, {}};
  const PartAnswer answer =
      part_files(fields, contact_picture(solved.system, solved.hybrid, solved.w)).answer;
  std::map<std::string, int> places;
  for (const SingularPlace& place : answer.unbounded) {
    ++places[place.what];
    EXPECT_NEAR(place.within_mm, (144. - 16) / (48 + 16) / 10, 1e-9);
    EXPECT_GE((answer.stress.von_mises.at_mm - place.at_mm).norm(), place.within_mm);
  }
  EXPECT_EQ(places["a re-entrant corner"], 4);
  EXPECT_EQ(places["the end of displacement"], 2);
  EXPECT_EQ(answer.unbounded.size(), 6u);
  const StressSamples samples(*solved.system.problem, solved.hybrid.stress, 6);
  int larger = 0;
  double farthest = 0;
  for (int t = 0; t < static_cast<int>(solved.hybrid.stress.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const StressSamples::Third third = samples.third(t, k);
      for (Eigen::Index i = 0; i < third.at_mm.cols(); ++i)
        if (von_mises(*solved.system.problem, t, third.at_mm.col(i), third.stress.col(i)) >
            answer.stress.von_mises.value * (1 + 1e-12)) {
          ++larger;
          double nearest = 1e9;
          for (const SingularPlace& place : answer.unbounded)
            nearest = std::min(nearest, (place.at_mm - third.at_mm.col(i)).norm());
          farthest = std::max(farthest, nearest);
        }
    }
  EXPECT_GT(larger, 0);
  EXPECT_LT(farthest, answer.unbounded.front().within_mm);
}

}  // namespace
}  // namespace airybench::part_answer_test
