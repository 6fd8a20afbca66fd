// The fields of load steps: every step in files that belong together, none of an earlier path.
#include "bench/measure/step_fields.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "support/errors.hpp"
#include "tests/bench/measure/csv_columns.hpp"
#include "tests/bench/measure/examined.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/test_folder.hpp"
#include "tests/support/two_blocks.hpp"

namespace airybench::step_fields_test {
namespace {

namespace fs = std::filesystem;
using testing::text_of;

// Pressed, sheared, and back.
std::shared_ptr<const Problem> path_of(int steps) {
  Scene scene;
  scene.displacement_mm = {0.02, 0};
  scene.later_steps.resize(steps - 1);
  for (int k = 0; k + 1 < steps; ++k)
    scene.later_steps[k].displacement_mm = Eigen::Vector2d(0.02, k % 2 == 0 ? 0.006 : 0);
  return testing::posed(scene);
}

Record examined(int steps, const fs::path& file, const char* method = "HYBRID") {
  Options options;
  options.limits.repetitions = 1;
  options.run.cases.fields = true;
  testing::CaseBench bench(path_of(steps), options);
  return bench.examine(select_methods(method).front(), file);
}

std::vector<double> column(const fs::path& file, const std::string& name) {
  return testing::numbers(testing::csv_columns(text_of(file)), name);
}

// The files of a series, which must be there.
std::vector<std::string> series(const fs::path& file) {
  const std::string text = text_of(file), key = "file=\"";
  std::vector<std::string> files;
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    const std::size_t begin = at + key.size();
    files.push_back(text.substr(begin, text.find('"', begin) - begin));
    EXPECT_TRUE(fs::is_regular_file(file.parent_path() / files.back())) << files.back();
  }
  return files;
}

TEST(StepFields, EveryStepIsInFilesThatAgreeWithTheRecord) {
  const testing::TemporaryFolder folder;
  for (const char* method : {"HYBRID", "P2", "3STEPD"}) {
    const Record record = examined(3, folder / method, method);
    ASSERT_EQ(record.status, Status::ok) << record.status_reason;
    const std::string name = method;
    const fs::path steps = folder / (name + ".steps");
    for (int k = 0; k < 3; ++k) {
      const std::string number = fmt::format("000{}", k + 1);
      EXPECT_EQ(record.steps[k].fields, "body");
      for (const char* part : {".stress.csv", ".boundary.csv", ".vtu", ".contact.vtu"})
        EXPECT_TRUE(fs::is_regular_file(steps / (number + part))) << number << part;
      EXPECT_EQ(fs::exists(steps / (number + ".displacement.csv")), name != "3STEPD");
      if (name == "P2") continue;  // its tractions are those of its stresses
      const std::vector<double> F_t = column(steps / (number + ".contact.csv"), "F_t_N");
      EXPECT_NEAR(std::accumulate(F_t.begin(), F_t.end(), 0.0),
                  record.steps[k].tangential_resultant_N.value(), 1e-6);
    }
    for (const char* part : {".stress.csv", ".contact.csv"})  // the last one has the case's name
      EXPECT_EQ(text_of(folder / (name + part)), text_of(steps / (std::string("0003") + part)));
    EXPECT_NE(text_of(steps / "0001.stress.csv"), text_of(steps / "0002.stress.csv"));
    EXPECT_EQ(series(folder / (name + ".pvd")),
              (std::vector<std::string>{name + ".steps/0001.vtu", name + ".steps/0002.vtu",
                                        name + ".steps/0003.vtu"}));
    EXPECT_EQ(series(folder / (name + ".contact.pvd")).size(), 3u);

    const fs::path table = folder / (name + ".steps.csv");
    EXPECT_EQ(column(table, "step"), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(column(table, "same_loads_as"), (std::vector<double>{1, 2, 1}));
    const Json steps_json = to_json(record)["steps"];
    for (const char* key : {"normal_resultant_N", "tangential_resultant_N", "dissipation_Nmm",
                            "n_open", "n_stick", "n_slip"})
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(column(table, key)[k], steps_json[k].at(key).get<double>()) << key;
    if (name == "3STEPD") continue;  // an Airy method knows no displacement
    const std::vector<double> held = column(table, "held_y_mm");
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(held[k], k == 1 ? 0.006 : 0, 1e-12);
  }
}

// Of two blocks one is pressed on the other and pushed. What is drawn: its contact force, the
// motion of its support, and not those of both.
TEST(StepFields, OfTwoBodiesForcesAndMotionAreThoseOfTheMovedOne) {
  const testing::TemporaryFolder folder;
  const std::vector<Eigen::Vector2d> motions = {{0, -0.01}, {0.003, -0.01}};
  const auto constant = [](const Eigen::Vector2d& u) {
    return LinearValue<Eigen::Vector2d>{{u, u}};
  };
  for (const auto& [support, piece, way] :
       {std::tuple("displacement:head", 2, 1.), {"displacement:floor", 1, -1.}}) {
    Scene scene = testing::pressed(0.3);
    for (const char* held : {"displacement:head", "displacement:floor"})
      scene.boundary[held].displacement_mm = constant({0, 0});
    scene.boundary[support].displacement_mm = constant(way * motions[0]);
    scene.later_steps.resize(1);
    scene.later_steps[0].boundary[support].displacement_mm = constant(way * motions[1]);
    Options options;
    options.limits.repetitions = 1;
    options.run.cases.fields = true;
    const fs::path name = folder / support;
    testing::CaseBench bench(testing::posed(scene, testing::two_blocks(7, 10)), options);
    const Record record = bench.examine(select_methods("HYBRID").front(), name);
    ASSERT_EQ(record.status, Status::ok) << record.status_reason;
    const fs::path table = name.string() + ".steps.csv";
    EXPECT_EQ(column(table, "piece"), std::vector<double>(2, piece));
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(column(table, "held_x_mm")[k], way * motions[k].x(), 1e-12);
      EXPECT_NEAR(column(table, "held_y_mm")[k], way * motions[k].y(), 1e-12);
      const fs::path points =
          fs::path(name.string() + ".steps") / fmt::format("000{}.contact.csv", k + 1);
      const auto of_points = [&](const char* key) { return column(points, key); };
      const auto F_n = of_points("F_n_N"), n_y = of_points("normal_y"), on = of_points("piece");
      std::array<double, 2> force_y_N = {0, 0};
      for (std::size_t p = 0; p < F_n.size(); ++p)
        force_y_N.at(static_cast<std::size_t>(on[p]) - 1) += F_n[p] * n_y[p];
      const double pressed_N = -record.steps[k].normal_resultant_N.value();
      EXPECT_GT(pressed_N, 100);
      EXPECT_NEAR(force_y_N[0] / pressed_N, -1, 1e-9);  // the base is pushed down
      EXPECT_NEAR(force_y_N[1] / pressed_N, 1, 1e-9);
    }
  }
}

TEST(StepFields, AnotherPathOrASingleLoadLeavesNothingOfTheEarlierOne) {
  const testing::TemporaryFolder folder;
  examined(4, folder / "a");
  testing::write_text(folder.path() / "a.steps" / "notes.txt", "mine");
  testing::write_text(folder / "a.error.csv.txt", "mine, too");
  examined(2, folder / "a");
  EXPECT_TRUE(fs::exists(folder.path() / "a.steps" / "0002.vtu"));
  EXPECT_FALSE(fs::exists(folder.path() / "a.steps" / "0003.vtu"));
  EXPECT_EQ(series(folder / "a.pvd").size(), 2u);
  examined(1, folder / "a");
  for (const char* gone : {"a.pvd", "a.contact.pvd", "a.steps.csv", "a.steps/0001.vtu"})
    EXPECT_FALSE(fs::exists(folder / gone)) << gone;
  EXPECT_TRUE(fs::exists(folder / "a.vtu"));
  EXPECT_EQ(text_of(folder.path() / "a.steps" / "notes.txt"), "mine");
  EXPECT_EQ(text_of(folder / "a.error.csv.txt"), "mine, too");
}

TEST(StepFields, StepsOfOtherTemperaturesHaveOtherLoads) {
  const testing::TemporaryFolder folder;
  Mesh mesh;
  mesh.name = "block";
  testing::add_block(mesh, "block", {0, 0}, {4, 2}, 4, 2,
                     {"displacement", "force", "force", "force"});
  validate(mesh);
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.material = {1000, 0.3, 1e-5};
  scene.displacement_mm = {0, 0};
  scene.later_steps.resize(3);
  for (int k = 0; k < 3; ++k)
    scene.later_steps[k].temperature_K["block"] = {{50. * (k % 2), 50. * (k % 2)}};
  Options options;
  options.limits.repetitions = 1;
  options.run.cases.fields = true;
  testing::CaseBench(testing::posed(scene, mesh), options)
      .examine(select_methods("HYBRID").front(), folder / "a");
  EXPECT_EQ(column(folder / "a.steps.csv", "same_loads_as"), (std::vector<double>{1, 1, 3, 1}));
}

TEST(StepFields, OfALongPathAHundredStepsHaveTheWholeBody) {
  for (const int count : {1, 7, 100, 101, 250, 1000}) {
    int kept = 0, apart = 0, farthest = 0;
    for (int step = 0; step < count; ++step) {
      ++apart;
      if (!keeps_body(step, count)) continue;
      ++kept;
      farthest = std::max(farthest, apart);
      apart = 0;
    }
    EXPECT_EQ(kept, std::min(count, max_step_bodies)) << count;
    EXPECT_TRUE(keeps_body(count - 1, count)) << count;
    EXPECT_LE(farthest, (count + max_step_bodies - 1) / max_step_bodies) << count;
  }
}

struct Solved {
  ContactSystem system;
  Solution solution;

  explicit Solved(int steps) : system(contact_system(path_of(steps))) {
    solution = run(select_methods("HYBRID").front(), system, {});
  }
  std::string write(StepFields& files, int step) const {
    return files.write(step, own_fields(system, solution),
                       {Status::ok, verify(system, solution, nullptr)});
  }
};

TEST(StepFields, StepsWithoutTheBodyHaveTheirContactPoints) {
  const testing::TemporaryFolder folder;
  const Solved solved(150);
  StepFields files(folder.path(), "a&b", *solved.system.problem);
  EXPECT_EQ(solved.write(files, 0), "contact");
  EXPECT_EQ(solved.write(files, 1), "body");
  const fs::path steps = folder / "a&b.steps";
  EXPECT_TRUE(fs::exists(steps / "0001.contact.csv"));
  EXPECT_FALSE(fs::exists(steps / "0001.stress.csv"));
  EXPECT_FALSE(fs::exists(steps / "0001.vtu"));
  const std::string body = text_of(folder / "a&b.pvd"),
                    contact = text_of(folder / "a&b.contact.pvd");
  EXPECT_TRUE(testing::contains(
      body, "<DataSet timestep=\"2\" part=\"0\" file=\"a&#38;b.steps/0002.vtu\"/>"));
  EXPECT_FALSE(testing::contains(body, "0001.vtu"));
  EXPECT_TRUE(testing::contains(contact, "a&#38;b.steps/0001.contact.vtu"));
}

TEST(StepFields, AStepThatCannotBeWrittenLeavesTheStepsBeforeIt) {
  const testing::TemporaryFolder folder;
  const Solved solved(3);
  StepFields files(folder.path(), "a", *solved.system.problem);
  solved.write(files, 0);
  fs::create_directories(folder / "a.steps/0002.stress.csv");  // in the way
  EXPECT_THROW(solved.write(files, 1), FileError);
  EXPECT_EQ(series(folder / "a.pvd"), std::vector<std::string>{"a.steps/0001.vtu"});
  EXPECT_EQ(column(folder / "a.steps.csv", "step"), std::vector<double>{1});
}

}  // namespace
}  // namespace airybench::step_fields_test
