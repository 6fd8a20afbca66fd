// The fields of solutions in files: exact where the solution is, read back by VTK.
#include "bench/measure/field_files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>

#include "assembly/problem/pose.hpp"
#include "bench/measure/stress_samples.hpp"
#include "bench/measure/vtu.hpp"
#include "mesh/arcs.hpp"
#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/bench/measure/csv_columns.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/places.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/support/test_folder.hpp"
#include "tests/verify/round_bodies.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench::field_files_test {
namespace {

namespace fs = std::filesystem;

using testing::Columns, testing::numbers;

Columns read_csv(const fs::path& file) { return testing::csv_columns(testing::text_of(file)); }

// Nine rows per triangle, each at its place.
void expect_stresses(const Columns& rows, const Mesh& mesh, const testing::ExactField& exact) {
  const auto x = numbers(rows, "x_mm"), y = numbers(rows, "y_mm"), sxx = numbers(rows, "sxx_MPa"),
             syy = numbers(rows, "syy_MPa"), sxy = numbers(rows, "sxy_MPa");
  ASSERT_EQ(x.size(), 9 * mesh.triangles.size());
  double size = 0, error = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Eigen::Vector3d stress = exact.stress({x[k], y[k]});
    size = std::max(size, stress.norm());
    error = std::max(error, (stress - Eigen::Vector3d(sxx[k], syy[k], sxy[k])).norm());
  }
  EXPECT_LT(error, 1e-9 * size) << exact.name;
}

// The tooth without a contact boundary.
Mesh free_tooth(int nx, int ny) {
  return testing::with_role(testing::small_tooth(nx, ny), BoundaryRole::contact,
                            BoundaryRole::force);
}

struct Solved {
  ContactSystem system;
  Solution solution;
  std::optional<DisplacementField> w;

  Solved(Problem problem, const char* name) {
    const Method method = select_methods(name).front();
    const std::unique_ptr<ContactSystem> assembled =
        assemble(method, std::make_shared<const Problem>(std::move(problem)));
    solution = solve_load_steps(method.solve, *assembled, {}, {});
    system = *assembled;
    EXPECT_EQ(solution.status, Status::ok) << solution.message;
    w = displacement_of_answer(system, solution);
  }
  ContactPicture contact() const { return contact_picture(system, solution, w); }
  void write(const fs::path& folder, const std::string& name = "a",
             const ConstitutiveError* error = nullptr) const {
    write_fields(folder, name, {system, solution, w, error, nullptr, {}});
  }
  double largest_force() const {
    double largest = 0;
    for (const Eigen::Vector2d& force : contact().force) largest = std::max(largest, force.norm());
    return largest;
  }
};

TEST(FieldFiles, StressesAndDisplacementsAreTheExactOnes) {
  const Mesh mesh = free_tooth(5, 4);
  for (const testing::ExactField& exact : testing::exact_fields(2000, 0.3))
    for (const char* method : {"HYBRID", "HYBRID:k=3", "P2", "P3"}) {
      const Solved solved(
          make_problem(mesh, {compliance({2000, 0.3}, Plane::stress)}, testing::loads_of(exact), 0),
          method);
      const testing::TemporaryFolder folder;
      solved.write(folder.path());
      const Columns rows = read_csv(folder / "a.displacement.csv");
      const auto x = numbers(rows, "x_mm"), y = numbers(rows, "y_mm"), ux = numbers(rows, "ux_mm"),
                 uy = numbers(rows, "uy_mm");
      ASSERT_EQ(x.size(), 6 * mesh.triangles.size());
      double size = 0, error = 0;
      for (std::size_t k = 0; k < x.size(); ++k) {
        const Eigen::Vector2d u = exact.displacement({x[k], y[k]});
        size = std::max(size, u.norm());
        error = std::max(error, (u - Eigen::Vector2d(ux[k], uy[k])).norm());
      }
      EXPECT_LT(error, 1e-10 * size) << exact.name << " " << method;
      expect_stresses(read_csv(folder / "a.stress.csv"), mesh, exact);
    }
}

// The contact law, seen in the picture alone.
void expect_law(const Solved& solved, double friction, double slip_size) {
  const ContactPicture picture = solved.contact();
  const double force = solved.largest_force();
  ASSERT_EQ(picture.gap_mm.size(), picture.force.size());
  ASSERT_EQ(picture.slip_mm.size(), picture.force.size());
  std::array<int, 3> count{};
  for (std::size_t p = 0; p < picture.force.size(); ++p) {
    const ContactState state = picture.state[p];
    ++count[static_cast<std::size_t>(state)];
    const double gap = picture.gap_mm[p], slip = picture.slip_mm[p];
    if (state == ContactState::open) {
      EXPECT_GT(gap, -1e-9 * slip_size) << p;
      EXPECT_LT(picture.force[p].norm(), 1e-6 * force) << p;
    } else {
      EXPECT_NEAR(gap, 0, 1e-8 * slip_size) << p;
    }
    if (state == ContactState::stick) {
      EXPECT_NEAR(slip, 0, 1e-8 * slip_size) << p;
    }
    if (state == ContactState::slip && friction > 0) {
      EXPECT_LE(slip * picture.force[p].y(), 0) << p;
    }
  }
  for (const int n : count) EXPECT_TRUE(n > 0 || friction == 0);
}

TEST(FieldFiles, GapAndSlipFollowTheContactLaw) {
  for (const char* method : {"HYBRID", "3STEPD", "BLIND:SCHUR"}) {
    const Solved solved(pose(Scene(), testing::catalogue_mesh("Mesh0")), method);
    expect_law(solved, 0.2, 0.006);
  }
}

TEST(FieldFiles, MethodsAgreeOnGapAndSlip) {
  for (const double friction : {0.0, 0.2}) {
    const Scene scene = {.friction = friction};
    const Mesh mesh = testing::catalogue_mesh("Mesh1");
    const ContactPicture hybrid = Solved(pose(scene, mesh), "HYBRID").contact();
    const ContactPicture p2 = Solved(pose(scene, mesh), "P2").contact();
    const ContactPicture airy = Solved(pose(scene, mesh), "3STEPD").contact();
    EXPECT_EQ(airy.slip_mm.empty(), friction == 0);  // an Airy method knows no other
    ASSERT_EQ(hybrid.slip_mm.size(), hybrid.gap_mm.size());
    double largest_gap = 0, largest_slip = 0;
    for (std::size_t p = 0; p < hybrid.gap_mm.size(); ++p) {
      largest_gap = std::max(largest_gap, hybrid.gap_mm[p]);
      largest_slip = std::max(largest_slip, std::abs(hybrid.slip_mm[p]));
    }
    EXPECT_GT(largest_gap, 1e-4);
    EXPECT_GT(largest_slip, 1e-4);
    for (std::size_t p = 0; p < hybrid.gap_mm.size(); ++p) {
      EXPECT_NEAR(airy.gap_mm[p], hybrid.gap_mm[p], 1e-8 * largest_gap) << p;
      EXPECT_NEAR(p2.gap_mm[p], hybrid.gap_mm[p], 0.03 * largest_gap) << p;
      EXPECT_NEAR(p2.slip_mm[p], hybrid.slip_mm[p], 0.1 * largest_slip) << p;
    }
  }
}

// Slip is that of the last step: what slides on and on slides as far in every step.
TEST(FieldFiles, SlipIsMeasuredFromTheStepBefore) {
  const Scene whole = {.crown_radius_mm = {}, .displacement_mm = {0.02, 10}};
  Scene in_steps = whole;
  in_steps.equal_steps = 4;
  const Mesh mesh = testing::small_tooth(6, 5);
  const ContactPicture one = Solved(pose(whole, mesh), "HYBRID").contact();
  const ContactPicture last = Solved(pose(in_steps, mesh), "HYBRID").contact();
  for (std::size_t p = 0; p < one.slip_mm.size(); ++p) {
    EXPECT_NEAR(one.slip_mm[p], 10, 0.1);
    EXPECT_NEAR(last.slip_mm[p], 2.5, 0.1);
  }
}

// 0, 1 or 77 (no VTK).
int read_back(const fs::path& folder, const std::string& name, const char* to = "") {
  const std::string command =
      "/usr/bin/python3 '" +
      (testing::source_folder() / "tests/bench/measure/read_vtu.py").string() + "' '" +
      folder.string() + "' '" + name + "'" + to;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(FieldFiles, VtkReadsBackWhatIsWritten) {
  const testing::TemporaryFolder folder;
  Scene layered;
  layered.layers.count = 2;
  layered.layers.normal = {1, 0};
  for (const char* method : {"HYBRID", "P2"}) {
    const Solved solved(pose(layered, testing::small_tooth(6, 5)), method);
    const Solution dual = run(select_methods("HYBRID").front(), solved.system, {});
    const ConstitutiveError error =
        constitutive_error(solved.system, dual.stress, dual.F_C, *solved.w);
    solved.write(folder.path(), method, &error);
    const int code = read_back(folder.path(), method);
    if (code == 77) GTEST_SKIP() << "no VTK for Python here (Debian: python3-vtk9)";
    EXPECT_EQ(code, 0) << method;
    EXPECT_TRUE(fs::exists(folder / (std::string(method) + ".png")));
  }
  // It can fail: a file that is cut off, and one whose numbers are others.
  const std::string whole = testing::text_of(folder / "P2.vtu");
  testing::write_text(folder / "P2.vtu", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(read_back(folder.path(), "P2", " 2>/dev/null"), 1);
  testing::write_text(folder / "P2.vtu", testing::text_of(folder / "HYBRID.vtu"));
  EXPECT_EQ(read_back(folder.path(), "P2", " 2>/dev/null"), 1);
}

TEST(FieldFiles, ThirdsOfHigherDegreesAreLagrangeTrianglesOnTheCurve) {
  using Weights = std::vector<std::array<int, 3>>;
  EXPECT_EQ(lagrange_points(1), (Weights{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(lagrange_points(3), (Weights{{3, 0, 0},
                                         {0, 3, 0},
                                         {0, 0, 3},
                                         {2, 1, 0},
                                         {1, 2, 0},
                                         {0, 2, 1},
                                         {0, 1, 2},
                                         {1, 0, 2},
                                         {2, 0, 1},
                                         {1, 1, 1}}));
  EXPECT_EQ(lagrange_points(5).size(), 21U);
  EXPECT_EQ(lagrange_points(5)[15], (std::array{3, 1, 1}));
  const testing::TemporaryFolder folder;
  Mesh mesh = testing::small_ring(16, 3, 1, 3);
  EXPECT_EQ(recognise_arcs(mesh), 32);
  Scene scene;
  scene.displacement_mm = {0, 0};
  scene.boundary["force:hole"].pressure_MPa = LinearValue<double>{{10, 10}};
  const Solved solved(pose(scene, mesh), "HYBRID:k=2");
  solved.write(folder.path());
  const Problem& problem = *solved.system.problem;
  const std::size_t thirds = 3 * problem.mesh.triangles.size();
  EXPECT_NE(
      testing::text_of(folder / "a.vtu")
          .find(fmt::format("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", 10 * thirds, thirds)),
      std::string::npos);
  const StressSamples samples(problem, solved.solution.stress, 3);
  for (const Problem::RoundTriangle& round : problem.round)
    for (int k = 0; k < 3; ++k)
      if (const int row = round.rows[k]; row != Problem::no_row) {
        const StressSamples::Third third = samples.third(round.triangle, k);
        const double radius =
            boundary_label(problem.mesh, problem.mesh.boundary[row]) == "force:hole" ? 1 : 3;
        for (int b = 0; b <= 3; ++b) {
          const Eigen::Index at = samples.place(b, 0);
          EXPECT_NEAR(third.at_mm.col(at).norm(), radius, 1e-9);
          EXPECT_LT(
              (problem.vertices_of(round.triangle) * third.lambda.col(at) - third.at_mm.col(at))
                  .norm(),
              1e-12);
        }
      }
  // The pressure is normal to the curve.
  const Columns edges = read_csv(folder / "a.boundary.csv");
  const auto x = numbers(edges, "x1_mm"), y = numbers(edges, "y1_mm"),
             tx = numbers(edges, "t1_x_MPa"), ty = numbers(edges, "t1_y_MPa");
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::hypot(x[k], y[k]) < 2) {
      EXPECT_LT(std::hypot(tx[k] - 10 * x[k], ty[k] - 10 * y[k]), 1e-6);
    }
  const int code = read_back(folder.path(), "a");
  if (code == 77) GTEST_SKIP() << "no VTK for Python here (Debian: python3-vtk9)";
  EXPECT_EQ(code, 0);
}

TEST(FieldFiles, TheElementMapHasARowPerTriangleAndSharesThatSumToOne) {
  const testing::TemporaryFolder folder;
  const Solved solved(pose({}, testing::small_tooth(6, 5)), "HYBRID");
  const ConstitutiveError error =
      constitutive_error(solved.system, solved.solution.stress, solved.solution.F_C, *solved.w);
  solved.write(folder.path(), "a", &error);
  const Columns rows = read_csv(folder / "a.error.csv");
  const std::vector<double> triangle = numbers(rows, "triangle"),
                            share = numbers(rows, "error_share");
  ASSERT_EQ(share.size(), solved.system.problem->mesh.triangles.size());
  double sum = 0;
  for (std::size_t t = 0; t < share.size(); ++t) {
    EXPECT_EQ(triangle[t], static_cast<double>(t + 1));
    EXPECT_GE(share[t], 0);
    sum += share[t];
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(FieldFiles, ABodyWithoutContactHasAnEmptyGrid) {
  Scene scene;
  scene.boundary["force"].pressure_MPa = {{3, 3}};
  const testing::TemporaryFolder folder;
  Solved(pose(scene, free_tooth(4, 3)), "HYBRID").write(folder.path());
  const int code = read_back(folder.path(), "a");
  if (code == 77) GTEST_SKIP() << "no VTK for Python here (Debian: python3-vtk9)";
  EXPECT_EQ(code, 0);
}

TEST(FieldFiles, WhatIsNotKnownIsLeftOut) {
  const testing::TemporaryFolder folder;
  const Solved solved(pose(Scene(), testing::small_tooth(4, 3)), "3STEPD");
  solved.write(folder.path());  // an Airy method knows no displacement
  EXPECT_FALSE(fs::exists(folder / "a.displacement.csv"));
  EXPECT_FALSE(fs::exists(folder / "a.error.csv"));
  EXPECT_FALSE(testing::contains(testing::text_of(folder / "a.vtu"), "displacement_mm"));
  EXPECT_EQ(numbers(read_csv(folder / "a.contact.csv"), "slip_mm").size(),
            static_cast<std::size_t>(solved.system.contact.count));
}

// A ring in its socket: points on the circle, with the pressure of the stresses there.
TEST(FieldFiles, ContactOfDisplacementsIsThatOfTheCurve) {
  using testing::RingInASocket;
  struct Off {
    const char* name;
    double pressure, gap_mm;
  };
  for (const auto& [name, pressure, gap_mm] : {Off{"P2", 0.2, 1e-5}, Off{"P3", 0.03, 1e-12}}) {
    SCOPED_TRACE(name);
    const Solved solved(pose(RingInASocket::scene(0), RingInASocket::mesh(8)), name);
    const ContactPicture picture = solved.contact();
    EXPECT_EQ(picture.per_edge, 3u);
    ASSERT_EQ(picture.at_mm.size(), 3u * 8);
    for (std::size_t i = 0; i < picture.at_mm.size(); ++i) {
      EXPECT_NEAR(picture.at_mm[i].norm(), 2, 1e-9);
      EXPECT_NEAR(-3 * picture.force[i].x() / picture.frame[i].length_mm, RingInASocket::pressure,
                  pressure * RingInASocket::pressure);
      EXPECT_NEAR(picture.gap_mm[i], 0, gap_mm);
    }
  }
}

}  // namespace
}  // namespace airybench::field_files_test
