#include "solvers/condensation/column_store.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "assembly/problem/scene.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/skyline.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::column_store_test {
namespace {

namespace fs = std::filesystem;
using testing::solved_by, testing::system_of;

// No file may be larger, as on a full disk, for the scope of the object.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    signal_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*signal_)(int) = SIG_DFL;
};

TEST(ColumnStore, IsAZeroMatrixInEitherPlaceThatKeepsWhatIsWritten) {
  for (const auto place : {ColumnStore::Place::memory, ColumnStore::Place::file}) {
    ColumnStore store(1000, 77, place);
    EXPECT_EQ(store.bytes(), 1000u * 77 * 8);
    EXPECT_TRUE(store.matrix().isZero(0));
    std::srand(3);
    const Eigen::MatrixXd written = Eigen::MatrixXd::Random(1000, 77);
    store.matrix() = written;
    const ColumnStore moved = std::move(store);
    EXPECT_EQ(moved.matrix(), written);
  }
  EXPECT_EQ(ColumnStore().bytes(), 0u);
  EXPECT_EQ(ColumnStore(10, 0, ColumnStore::Place::file).bytes(), 0u);
}

TEST(ColumnStore, TheFileHasNoNameAndIsGoneAfterwards) {
  const testing::TemporaryFolder folder;
  const testing::EnvironmentVariable variable("TMPDIR", folder.path());
  constexpr std::size_t bytes = 64 << 20;
  {
    const MappedFile file(bytes);
    static_cast<char*>(file.data())[bytes - 1] = 1;
    EXPECT_TRUE(fs::is_empty(folder.path()));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ColumnStore, AFolderThatCannotTakeItIsNamed) {
  const testing::TemporaryFolder folder;
  const auto expect_refused = [](const fs::path& temporary, const std::string& why) {
    const testing::EnvironmentVariable variable("TMPDIR", temporary);
    testing::expect_named(
        testing::complaint_of<Breakdown>([] { const MappedFile file(std::size_t{1} << 24); }),
        {"16777216 bytes", temporary.string() + ": " + why, "TMPDIR"});
  };
  const fs::path file = testing::write_text(folder / "file", "x");
  expect_refused(folder / "nowhere", "No such file or directory");
  expect_refused(file, "Not a directory");
  fs::remove(file);
  {
    const FileSizeLimit limit(1 << 20);
    expect_refused(folder.path(), "File too large");
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ColumnStore, AMethodWithoutRoomForItsFileBreaksDown) {
  const testing::TemporaryFolder folder;
  const testing::EnvironmentVariable variable("TMPDIR", folder / "nowhere");
  const AirySystem system = system_of();
  const Solution solution = solved_by("3STEPD:FILE", system);
  EXPECT_EQ(solution.status, Status::breakdown);
  EXPECT_NE(solution.message.find((folder / "nowhere").string()), std::string::npos);
  EXPECT_EQ(solved_by("3STEPD", system).status, Status::ok);
}

TEST(ColumnStore, WhereTheMatricesAreDoesNotChangeTheAnswer) {
  Scene body_force, frictionless;
  body_force.body_force_N_per_mm3 = {3, -1};
  frictionless.friction = 0;
  for (const Scene& scene : {Scene{}, body_force, frictionless}) {
    const AirySystem system = system_of(scene);
    const Solution memory = solved_by("3STEPD", system);
    ASSERT_EQ(memory.status, Status::ok);
    const Solution file = solved_by("3STEPD:FILE", system), lean = solved_by("3STEPD:LEAN", system);
    EXPECT_EQ(file.F_C, memory.F_C);  // the same operations on other pages
    EXPECT_EQ(testing::phi(file), testing::phi(memory));
    EXPECT_LT(testing::force_error(lean, memory), 1e-12);
    EXPECT_LT(testing::distance(testing::phi(lean), testing::phi(memory)),
              1e-9 * testing::phi(memory).norm());
    EXPECT_LT(matrix_bytes(lean), matrix_bytes(memory));
  }
}

TEST(ColumnStore, BatchesOfAnySizeMakeTheSameCondensedSystem) {
  Scene body_force;
  body_force.body_force_N_per_mm3 = {3, -1};
  const AirySystem system = system_of(body_force);
  const SkylineFactor factor = factor_ldlt(analyse_skyline(system.S), system.S);
  const SolveInPlace solve_S = [&](Eigen::Ref<Eigen::MatrixXd> X) { solve_in_place(factor, X); };
  const ThreeStep whole = condense_in_three_steps(system, solve_S);
  for (const int batch : {1, 7, system.n_f() + system.n_c(), 10000}) {
    const ThreeStep part = condense_in_three_steps(system, solve_S, {KeepX::Where::nowhere, batch});
    EXPECT_LT(testing::distance(part.condensed.D, whole.condensed.D),
              1e-12 * whole.condensed.D.norm())
        << batch;
    EXPECT_LT(testing::distance(part.condensed.G, whole.condensed.G),
              1e-12 * whole.condensed.G.norm());
    EXPECT_EQ(part.X.bytes(), 0u);
  }
}

}  // namespace
}  // namespace airybench::column_store_test
