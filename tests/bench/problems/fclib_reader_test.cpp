// Contact problems in FCLIB's format: our own export back again, other storages, and wrong files.
#include "bench/problems/fclib.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <functional>
#include <limits>
#include <random>
#include <tuple>

#include "assembly/problem/scene.hpp"
#include "bench/problems/problem_files.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/methods.hpp"
#include "support/errors.hpp"
#include "support/hdf5_handle.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/posed.hpp"
#include "verify/verifier.hpp"

namespace airybench::fclib_reader_test {
namespace {

// A dataset's name to its values, whole or not; sorted, so that groups are made in turn.
struct Values {
  std::vector<double> numbers;
  bool whole = false;
};
using Contents = std::map<std::string, Values>;

Values whole(std::vector<double> numbers) { return {std::move(numbers), true}; }

enum class Storage { rows, columns, triplets };

// The entries of W that are not zero; triplets of a small one twice, by halves.
Contents contents_of(const contact::Problem& problem, Storage storage) {
  const int m = static_cast<int>(problem.G.size());
  std::vector<double> p = {0}, i, x;
  if (storage == Storage::triplets) p.clear();
  for (int row = 0; row < m; ++row) {
    for (int column = 0; column < m; ++column) {
      if (problem.D(row, column) == 0) continue;
      const int times = storage == Storage::triplets && m == 4 ? 2 : 1;
      for (int k = 0; k < times; ++k) {
        const bool triplets = storage == Storage::triplets;
        if (triplets) p.push_back(column);
        i.push_back(triplets ? row : column);
        x.push_back(problem.D(row, column) / times);
      }
    }
    if (storage != Storage::triplets) p.push_back(static_cast<double>(i.size()));
  }
  const double entries = static_cast<double>(i.size());
  const double form = storage == Storage::rows ? -2 : storage == Storage::columns ? -1 : entries;
  return {{"/fclib_local/spacedim", whole({2})},
          {"/fclib_local/W/m", whole({static_cast<double>(m)})},
          {"/fclib_local/W/n", whole({static_cast<double>(m)})},
          {"/fclib_local/W/nz", whole({form})},
          {"/fclib_local/W/nzmax", whole({entries})},
          {"/fclib_local/W/p", whole(p)},
          {"/fclib_local/W/i", whole(i)},
          {"/fclib_local/W/x", {x}},
          {"/fclib_local/vectors/q", {{problem.G.begin(), problem.G.end()}}},
          {"/fclib_local/vectors/mu", {problem.points.friction}}};
}

void write(const std::filesystem::path& path, const Contents& contents) {
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  for (const auto& [name, values] : contents) {
    const hsize_t size = values.numbers.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle set(H5Dcreate2(file, name.c_str(), values.whole ? H5T_STD_I32LE : H5T_IEEE_F64LE,
                                space, links, H5P_DEFAULT, H5P_DEFAULT),
                     H5Dclose);
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.numbers.data());
  }
}

contact::Problem small_problem() {
  contact::Problem problem;
  problem.D = Eigen::Vector4d(2, 3, 4, 5).asDiagonal();
  problem.D(0, 2) = problem.D(2, 0) = 0.5;
  problem.G = Eigen::Vector4d(-1, 0.5, 2, -0.25);
  problem.points.count = 2;
  problem.points.friction = {0.3, 0};
  return problem;
}

Solution solved(const contact::Problem& problem) {
  return run(condensed_contact().solve_contact, problem, {});
}

class FclibReader : public ::testing::Test {
 protected:
  contact::Problem read(const Contents& contents) const {
    write(file(), contents);
    return read_fclib(file());
  }
  std::filesystem::path file() const { return bench_.path("p.hdf5"); }
  // The complaint begins with the file's name and this, which ends where what is allowed begins.
  void refused(const Contents& contents, const std::string& message) const {
    const auto what = testing::complaint_of<FileError>([&] { read(contents); });
    EXPECT_TRUE(what.starts_with(file().string() + ": " + message + " (allowed: "))
        << what << "\nfor " << message;
    EXPECT_FALSE(testing::contains(what, "\n"));
  }
  const testing::BenchCommand bench_;
};

TEST_F(FclibReader, ReadsAllStorages) {
  const contact::Problem problem = small_problem();
  for (const Storage storage : {Storage::rows, Storage::columns, Storage::triplets}) {
    const auto found = read(contents_of(problem, storage));
    EXPECT_EQ(found.name, "p");
    EXPECT_EQ(found.D, problem.D);
    EXPECT_EQ(found.G, problem.G);
    EXPECT_EQ(found.points.count, 2);
    EXPECT_EQ(found.points.friction, problem.points.friction);
  }
}

TEST_F(FclibReader, OurOwnExportHasTheForcesOfTheBody) {
  for (const double friction : {0.3, 0.0}) {
    const auto problem = testing::posed({.friction = friction}, testing::catalogue_mesh("Mesh0"));
    const Solution of_body = run(select_methods("HYBRID").front(), contact_system(problem), {});
    PosedScene posed;
    posed.problem = problem;
    const ProblemFiles exported = problem_files(posed, "fclib");
    testing::write_text(file(), exported.files.at("problem.hdf5"));
    const auto given = read_fclib(file());
    Eigen::VectorXd F = solved(given).F_C;
    for (const Storage storage : {Storage::columns, Storage::triplets})
      EXPECT_EQ(solved(read(contents_of(given, storage))).F_C, F);
    if (friction == 0) {
      EXPECT_EQ(F(Eigen::seq(1, Eigen::last, 2)).norm(), 0);
      F = Eigen::VectorXd(F(Eigen::seq(0, Eigen::last, 2)));
    }
    EXPECT_LT((F - of_body.F_C).norm(), 1e-9 * of_body.F_C.norm());
  }
}

// Three components, M by columns, H by triplets, whose rows are in i.
Contents global_contents() {
  const std::string M = "/fclib_global/M/", H = "/fclib_global/H/",
                    vectors = "/fclib_global/vectors/";
  return {{"/fclib_global/spacedim", whole({3})},
          {M + "m", whole({4})},
          {M + "n", whole({4})},
          {M + "nz", whole({-1})},
          {M + "nzmax", whole({6})},
          {M + "p", whole({0, 2, 4, 5, 6})},
          {M + "i", whole({0, 1, 0, 1, 2, 3})},
          {M + "x", {{2, 1, 1, 3, 4, 5}}},
          {H + "m", whole({4})},
          {H + "n", whole({3})},
          {H + "nz", whole({4})},
          {H + "nzmax", whole({5})},
          {H + "p", whole({0, 1, 2, 0})},
          {H + "i", whole({0, 1, 2, 3})},
          {H + "x", {{1, 2, 3, -1, 0}}},
          {vectors + "f", {{-1, 0, 2, 1}}},
          {vectors + "w", {{0.5, 0, 0.1}}},
          {vectors + "mu", {{0.4}}}};
}

TEST_F(FclibReader, CondensesGlobalProblems) {
  Eigen::Matrix4d M = Eigen::Vector4d(2, 3, 4, 5).asDiagonal();
  M(0, 1) = M(1, 0) = 1;
  Eigen::Matrix<double, 4, 3> H = Eigen::Matrix<double, 4, 3>::Zero();
  H.diagonal() << 1, 2, 3;
  H(3, 0) = -1;
  const contact::Problem problem = read(global_contents());
  Contents without_room = global_contents();
  without_room["/fclib_global/H/x"] = {{1, 2, 3, -1}};
  EXPECT_EQ(read(without_room).D, problem.D);
  EXPECT_EQ(problem.points.count, 1);
  EXPECT_EQ(problem.points.components, 3);
  EXPECT_LT((problem.D - H.transpose() * M.inverse() * H).norm(), 1e-14);
  const Eigen::Vector3d q =
      Eigen::Vector3d(0.5, 0, 0.1) + H.transpose() * M.inverse() * Eigen::Vector4d(-1, 0, 2, 1);
  EXPECT_LT((problem.G - q).norm(), 1e-14);

  for (const auto& [name, values, message] :
       std::vector<std::tuple<std::string, Values, std::string>>{
           {"H/x", {{1, 2, 0, -1, 0}}, "H: column 2 moves nothing"},
           {"H/p", whole({0, 1, 3, 0}), "H/p: [2] is 3"},
           {"H/m", whole({5}), "H/m: 5"},
           {"H/n", whole({4}), "H/n: 4"},
           {"M/x", {{2, 3, 3, 3, 4, 5}}, "M: is not positive definite to rounding"},
           {"vectors/b", {{0}}, "vectors/b: equality constraints"}}) {
    Contents contents = global_contents();
    contents["/fclib_global/" + name] = values;
    refused(contents, "/fclib_global/" + message);
  }
}

TEST_F(FclibReader, WrongFilesAreRefusedInOneLine) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused({}, "/fclib_local: is missing");
  for (const auto& [name, values, message] :
       std::vector<std::tuple<std::string, Values, std::string>>{
           {"spacedim", whole({4}), "spacedim: 4"},
           {"spacedim", whole({3}), "W/m: 4"},
           {"W/m", whole({3}), "W/m: 3"},
           {"W/m", whole({-4}), "W/m: -4"},
           {"W/m", {{4}}, "W/m: values of another kind"},
           {"W/n", whole({6}), "W/n: 6"},
           {"W/nz", whole({-3}), "W/nz: -3"},
           {"W/nzmax", whole({17}), "W/nzmax: 17"},
           {"W/p", whole({0, 1}), "W/p: 2 values"},
           {"W/p", whole({0, 3, 2, 5, 6}), "W/p: does not rise from 0"},
           {"W/p", whole({0, 2, 3, 5, 7}), "W/p: [4] is 7"},
           {"W/i", whole({0, 2, 1, 0, 2, 4}), "W/i: [5] is 4"},
           {"W/i", whole({0, -1, 1, 0, 2, 3}), "W/i: [1] is -1"},
           {"vectors/mu", {{0.3, -0.1}}, "vectors/mu: [1] is -0.1"},
           {"vectors/mu", {{0.3, 1e308}}, "vectors/mu: [1] is 1e+308"},
           {"vectors/mu", {{nan, 0}}, "vectors/mu: [0] is nan"},
           {"vectors/mu", {{0.3}}, "vectors/mu: 1 values"},
           {"vectors/q", {{0, 1e-300, 0, 0}}, "W: its vector has entries of up to 1e-300"},
           {"vectors/q", {{0, 0, 1 / 0.0, 0}}, "vectors/q: [2] is inf"},
           {"vectors/s", {{0}}, "vectors/s: equality constraints"},
           {"V/m", whole({0}), "V: equality constraints"}}) {
    Contents contents = contents_of(small_problem(), Storage::rows);
    contents["/fclib_local/" + name] = values;
    refused(contents, "/fclib_local/" + message);
  }
  const auto refused_matrix = [&](const std::function<void(contact::Problem&)>& change,
                                  const std::string& message, Storage storage = Storage::rows) {
    contact::Problem problem = small_problem();
    change(problem);
    refused(contents_of(problem, storage), "/fclib_local/W: " + message);
  };
  for (const double scale : {1e308, 1e-300})
    refused_matrix([&](contact::Problem& p) { p.D = Eigen::Matrix4d::Identity() * scale; },
                   fmt::format("diagonal entry 0 is {:.3g}", scale));
  refused_matrix([](contact::Problem& p) { p.D(1, 2) = p.D(2, 1) = 1e300; },
                 "entries of up to 1e+300");
  refused_matrix([](contact::Problem& p) { p.D(0, 2) = 0.6; }, "differs from its transpose by 0.1");
  refused_matrix([](contact::Problem& p) { p.D(3, 3) = 0; }, "diagonal entry 3 is 0",
                 Storage::triplets);
  for (const auto& [name, values] : contents_of(small_problem(), Storage::rows)) {
    Contents contents = contents_of(small_problem(), Storage::rows);
    contents.erase(name);
    refused(contents, name + ": is missing");
    contents[name + "/group"] = whole({1});
    refused(contents, name + ": is no dataset");
  }
}

// A dataset of W/x whose values are elsewhere, or nowhere.
TEST_F(FclibReader, ValuesThatAreNotInTheFileAreRefused) {
  const std::string x = "/fclib_local/W/x";
  const auto complaint_with = [&](const std::function<void(hid_t file, hid_t space)>& make) {
    Contents contents = contents_of(small_problem(), Storage::rows);
    const hsize_t size = contents.extract(x).mapped().numbers.size();
    write(file(), contents);
    {
      const Handle opened(H5Fopen(file().c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
      const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
      make(opened, space);
    }
    return testing::complaint_of<FileError>([&] { read_fclib(file()); });
  };
  const auto made_by = [&](const std::function<void(hid_t)>& set_up) {
    return complaint_with([&](hid_t opened, hid_t space) {
      const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      set_up(how);
      const Handle set(
          H5Dcreate2(opened, x.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT),
          H5Dclose);
    });
  };
  const std::string place = file().string() + ": " + x + ": ";
  EXPECT_TRUE(made_by([](hid_t how) {
                H5Pset_external(how, "/dev/zero", 0, H5F_UNLIMITED);
              }).starts_with(place + "values in other files ("));
  EXPECT_TRUE(made_by([](hid_t) {}).starts_with(place + "values that were never written ("));
  EXPECT_TRUE(complaint_with([&](hid_t opened, hid_t) {
                H5Lcreate_external("other.hdf5", "/x", opened, x.c_str(), H5P_DEFAULT, H5P_DEFAULT);
              }).starts_with(place + "is a link to another file ("));
}

TEST_F(FclibReader, WhatIsNoHdf5IsRefused) {
  write(file(), contents_of(small_problem(), Storage::rows));
  const std::string bytes = testing::text_of(file());
  for (const std::string& text : {std::string(), std::string("text"), bytes.substr(0, 700)}) {
    testing::write_text(file(), text);
    bench_.expect_refusal("--problem=p.hdf5", "p.hdf5: cannot be opened (allowed: an HDF5 file)\n");
  }
  bench_.expect_refusal("--problem=none.hdf5", "none.hdf5: cannot be opened: no such file\n");
}

// F ∝ q / W, as long as squares of F are numbers: what says that it converged is right.
TEST_F(FclibReader, AtTheEndsOfTheRangeEverySolverIsRight) {
  const Eigen::VectorXd right = solved(small_problem()).F_C;
  for (const auto& [of_W, of_q] : {std::pair(1e49, 1.0),
                                   {1e-50, 1.0},
                                   {1.0, 1e49},
                                   {1.0, 1e-50},
                                   {1e-50, 1e49},
                                   {1e49, 1e-50}}) {
    contact::Problem scaled = small_problem();
    scaled.D *= of_W;
    scaled.G *= of_q;
    const contact::Problem problem = read(contents_of(scaled, Storage::rows));
    for (const ContactSolver solver : all_contact_solvers) {
      SCOPED_TRACE(fmt::format("{:g}, {:g}: {}", of_W, of_q, name_of(solver)));
      const ContactResult result = solve_contact(problem, {.solver = solver});
      EXPECT_TRUE(result.converged);
      EXPECT_LT((result.F_C * (of_W / of_q) - right).norm(), 1e-8 * right.norm());
      const double measure = *verify(problem, result.F_C).natural_map_residual;
      EXPECT_LT(measure, 1e-8);
      EXPECT_GT(*verify(problem, 1.1 * result.F_C).natural_map_residual, 1e-3);
    }
  }
}

// Local ones: Mutants.
TEST_F(FclibReader, DamagedGlobalFilesAreRefusedOrRead) {
  std::mt19937 random(1);
  write(file(), global_contents());
  const std::string bytes = testing::text_of(file());
  int refusals = 0;
  for (int k = 0; k < 500; ++k) {
    std::string damaged = bytes;
    const int flips = 1 + static_cast<int>(random() % 4);
    for (int flip = 0; flip < flips; ++flip)
      damaged[random() % damaged.size()] ^= static_cast<char>(1 + random() % 255);
    testing::write_text(file(), damaged);
    try {
      const auto problem = read_fclib(file());
      EXPECT_EQ(problem.D.rows(), problem.G.size());
    } catch (const FileError& why) {
      EXPECT_FALSE(testing::contains(why.what(), "\n"));
      ++refusals;
    }
  }
  EXPECT_GT(refusals, 50);
  EXPECT_LT(refusals, 500);
}

// One contact, by hand: W = I, q = (−1, 0.5), μ = 0.5, r = (2, 0): u = r + q = (1, 0.5), û = (1.25,
// 0.5), r − û = (0.75, −0.5) is outside of the cone: nearest n = (0.75 + 0.25)/1.25 = 0.8, t =
// −0.4; the difference to r is (1.2, 0.4); the largest of ‖r‖ = 2, ‖u‖ and ‖q‖ is 2.
TEST(SiconosError, OfOneContactByHand) {
  contact::Problem problem = {Eigen::Matrix2d::Identity(), Eigen::Vector2d(-1, 0.5)};
  problem.points.count = 1;
  problem.points.friction = {0.5};
  const Solution exact = solved(problem);
  ASSERT_EQ(exact.status, Status::ok);
  EXPECT_LT((exact.F_C - Eigen::Vector2d(-1, 0.5)).norm(), 1e-12);  // slip: |t| = μ n
  EXPECT_LT(verify(problem, exact.F_C).siconos_error.value(), 1e-12);
  EXPECT_NEAR(verify(problem, Eigen::Vector2d(-2, 0)).siconos_error.value(), std::sqrt(1.6) / 2,
              1e-14);
}

}  // namespace
}  // namespace airybench::fclib_reader_test
