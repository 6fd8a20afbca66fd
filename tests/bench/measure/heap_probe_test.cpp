#include "bench/measure/heap_probe.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <thread>

#include "assembly/problem/scene.hpp"
#include "bench/measure/environment.hpp"
#include "mesh/msh_format.hpp"
#include "solvers/condensation/symmlq_condensation.hpp"
#include "solvers/contact/gauss_seidel.hpp"
#include "solvers/direct/skyline.hpp"
#include "solvers/krylov/conjugate_gradients.hpp"
#include "solvers/uzawa/accelerated_lagrangian.hpp"
#include "tests/bench/measure/examined.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::heap_probe_test {
namespace {

constexpr std::int64_t MiB = 1024 * 1024;

TEST(HeapProbe, LimitRefusesWhatWouldPassIt) {
  const heap::Limit limit(heap::live_bytes() + MiB);
  EXPECT_THROW(std::make_unique<char[]>(2 * MiB), std::bad_alloc);
  EXPECT_EQ(std::calloc(2 * MiB, 1), nullptr);
  EXPECT_EQ(std::aligned_alloc(64, 2 * MiB), nullptr);
  void* small = std::malloc(MiB / 2);
  ASSERT_NE(small, nullptr);
  void* moved = std::realloc(small, 4 * MiB);
  EXPECT_EQ(moved, nullptr);
  std::free(moved == nullptr ? small : moved);  // the block is still there
}

TEST(HeapProbe, FailedAndZeroSizedCallsKeepTheCount) {
  const std::int64_t before = heap::live_bytes();
  volatile std::size_t huge = SIZE_MAX / 2;
  EXPECT_EQ(std::malloc(huge), nullptr);
  EXPECT_EQ(std::calloc(huge, 4), nullptr);
  std::free(nullptr);
  void* block = std::malloc(64);
  block = std::realloc(block, 0);
  std::free(block);
  EXPECT_EQ(heap::live_bytes(), before);
}

TEST(RssProbe, PeakFollowsTouchedMemoryAndCanBeReset) {
  if (!rss::reset_peak()) FAIL() << "/proc/self/clear_refs cannot be written here";
  const std::int64_t before = rss::peak_bytes().value();
  {
    std::vector<char> touched(64 * MiB, 1);
    EXPECT_GE(rss::peak_bytes().value() - before, 60 * MiB);
  }
  ASSERT_TRUE(rss::reset_peak());
  EXPECT_LT(rss::peak_bytes().value() - before, 30 * MiB);
}

template <typename Work>
std::int64_t allocations_of(const Work& work) {
  const std::int64_t before = heap::allocations();
  work();
  return heap::allocations() - before;
}

contact::Problem condensed(int size, ContactPoints points) {
  std::srand(1);
  const Eigen::MatrixXd root = Eigen::MatrixXd::Random(size, size);
  return {root * root.transpose() + Eigen::MatrixXd::Identity(size, size),
          -size * Eigen::VectorXd::Random(size).cwiseAbs(), std::move(points)};
}

TEST(Allocations, NoneInsideAContactSweep) {
  for (const int components : {1, 2}) {
    ContactPoints contact;
    contact.components = components;
    contact.count = 40 / components;
    if (components == 2) contact.friction.assign(static_cast<std::size_t>(contact.count), 0.3);
    const contact::Problem problem = condensed(40, contact);
    const auto allocations = [&](int sweeps) {
      // Its tolerance is never met: all sweeps are made.
      const ContactOptions options = {.tolerance = 0, .max_iterations = sweeps};
      return allocations_of(
          [&] { EXPECT_EQ(solve_contact_by_gauss_seidel(problem, options).iterations, sweeps); });
    };
    EXPECT_EQ(allocations(3), allocations(30)) << components;
  }
}

const AirySystem& tooth() {
  static const AirySystem system =
      airy_system(testing::posed(Scene{}, testing::small_tooth(16, 12)));
  return system;
}

class PreconditionerAllocations : public ::testing::TestWithParam<std::string> {
 protected:
  // The two operators and what they are preconditioned by.
  struct Kernel {
    const char* name;
    Eigen::Index n;
    Preconditioner preconditioner;
    std::function<KrylovSummary(const RightHandSides&, const KrylovOptions&)> solve;
  };
  static std::vector<Kernel> kernels() {
    const AirySystem& system = tooth();
    const Preconditioner S_star = preconditioner_named(GetParam())(system.S, {});
    std::vector<Kernel> all;
    all.push_back({"CG", system.n(), S_star, [&, S_star](const auto& sides, const auto& options) {
                     return solve_by_conjugate_gradients(system.S, S_star, sides, options);
                   }});
    const SymmetricOperator A = saddle_operator(system);
    const Preconditioner M = saddle_preconditioner(system, S_star, 1);
    all.push_back({"SYMMLQ", A.n, M, [A, M](const auto& sides, const auto& options) {
                     return solve_by_symmlq(A, M, sides, options);
                   }});
    return all;
  }
  // On some processors OpenBLAS allocates a buffer in every small matrix product; SKY makes up to
  // four for every panel.
  static std::int64_t max_of_blas() {
    return GetParam() == "SKY" ? 4 * std::ssize(analyse_skyline(tooth().S).panels) : 0;
  }
};
INSTANTIATE_TEST_SUITE_P(Names, PreconditionerAllocations,
                         ::testing::ValuesIn(preconditioner_names()), [](const auto& name) {
                           std::string readable = name.param;
                           std::ranges::replace(readable, '.', '_');
                           return readable;
                         });

TEST_P(PreconditionerAllocations, NoneInsideAnApplication) {
  for (const Kernel& kernel : kernels())
    for (const int lanes : {1, max_lanes}) {
      const Apply apply = kernel.preconditioner.applier(lanes);
      LaneBlock X = LaneBlock::Ones(kernel.n, lanes);
      apply(X);  // BLAS may make its buffers
      const auto five_times = [&] {
        for (int k = 0; k < 5; ++k) apply(X);
      };
      EXPECT_LE(allocations_of(five_times), lanes == 1 ? 0 : 5 * max_of_blas())
          << kernel.name << ", " << lanes << " lanes";
    }
}

TEST_P(PreconditionerAllocations, NoneInsideAnIteration) {
  for (const Kernel& kernel : kernels())
    for (const int lanes : {1, max_lanes}) {
      const auto allocations = [&](int iterations) {
        Eigen::MatrixXd X = Eigen::MatrixXd::Identity(kernel.n, 20);
        KrylovOptions options;
        options.tolerance = 1e-200;  // never met: all iterations are made
        options.max_iterations = iterations;
        options.lanes = lanes;
        const RightHandSides sides = columns_of(X);
        return allocations_of(
            [&] { EXPECT_EQ(kernel.solve(sides, options).iterations, 20 * iterations); });
      };
      if (lanes > 1 && max_of_blas() > 0) continue;
      allocations(1);
      EXPECT_EQ(allocations(2), allocations(12)) << kernel.name << ", " << lanes << " lanes";
    }
}

TEST(Allocations, NoneInsideAnUzawaIteration) {
  const AugmentedFactor augmented = factor_augmented(tooth(), 20);
  const auto allocations = [&](int iterations) {
    UzawaOptions options;
    options.tolerance = 0;
    options.max_iterations = iterations;
    return allocations_of([&] {
      for (const UzawaResult& result : iterate_uzawa(tooth(), augmented, {20}, options, true))
        EXPECT_EQ(result.iterations, iterations);
    });
  };
  EXPECT_EQ(allocations(3), allocations(30));
}

TEST(Allocations, NoneOfTheSystemsSizeInAnAcceleratedIteration) {
  PenalisedFactor penalised;
  penalised.R = row_penalties(tooth(), 10, 3);
  const SparseColumns lower = penalised_matrix(tooth(), penalised.R);
  penalised.factor.analyse(lower);
  penalised.factor.factor(lower);
  const auto allocated = [&](int iterations) {
    UzawaOptions options;
    options.tolerance = 0;
    options.max_iterations = iterations;
    const std::int64_t before = heap::allocated_bytes();
    EXPECT_EQ(iterate_accelerated(tooth(), penalised, options).iterations, iterations);
    return heap::allocated_bytes() - before;
  };
  allocated(2);  // CHOLMOD keeps its workspace
  EXPECT_LT(allocated(30) - allocated(3), 8 * std::int64_t{tooth().n()});
}

TEST(Allocations, NoneInASkylineSolve) {
  const SkylineFactor factor = factor_ldlt(analyse_skyline(tooth().S), tooth().S);
  const auto allocations = [&](Eigen::Index columns) {
    Eigen::MatrixXd X = Eigen::MatrixXd::Ones(tooth().n(), columns);
    return allocations_of([&] { solve_in_place(factor, X); });
  };
  allocations(skyline_columns_at_once);  // BLAS may make its buffers
  EXPECT_EQ(allocations(1), 0);
  // OpenBLAS's own in small products; see above.
  EXPECT_LE(allocations(skyline_columns_at_once), 4 * std::ssize(factor.profile.panels));
}

class MemoryRun : public ::testing::TestWithParam<const char*> {
 protected:
  MemoryRun() {
    set_threads(1);  // OpenBLAS's threads end the process when they get no memory
    options_.limits.repetitions = 1;
    options_.run.cases.target_error = 0.1;  // memory is measured here, digits are not
  }
  Options options_;
  const Method method_ = select_methods(GetParam()).front();
};
INSTANTIATE_TEST_SUITE_P(Methods, MemoryRun,
                         ::testing::Values("3STEPD", "3STEPD:CHOLMOD", "3STEPD:LEAN", "BLIND",
                                           "BLIND:SCHUR", "BLIND:SKY", "HYBRID", "HYBRID:CHOLMOD",
                                           "HYBRID:MUMPS", "HYBRID:PDAS", "3STEPCG:DTIC3",
                                           "3STEPCG:FLIC2", "SYMMLQ:SKY", "ALM:r=20,rho=20",
                                           "ALM:AUTO"),
                         [](const auto& method) { return "m" + std::to_string(method.index); });

TEST(HeapProbe, AssemblyThatIsRefusedMemoryIsOutOfMemory) {
  Options options;
  options.limits.repetitions = 1;
  testing::CaseBench bench(testing::posed(Scene{}, testing::small_tooth(16, 12)), options);
  const Method method = select_methods("3STEPD").front();
  {
    const heap::Limit limit(heap::live_bytes());
    const Record refused = bench.examine(method, "");
    EXPECT_EQ(refused.status, Status::out_of_memory) << refused.status_reason;
    EXPECT_EQ(refused.status_reason, "assembly: an allocation was refused");
  }
  EXPECT_EQ(bench.examine(method, "").status, Status::ok);
}

// Wherever memory runs out, the case is out_of_memory and the process goes on.
TEST_P(MemoryRun, AnyLimitBelowThePeakIsOutOfMemory) {
  testing::CaseBench bench(testing::posed(Scene{}, testing::small_tooth(10, 8)), options_);
  const std::int64_t peak = bench.measure(method_).peak_heap_bytes.value();
  constexpr int parts = 30;
  for (int part = 0; part < parts; ++part) {
    options_.limits.memory_limit_bytes = peak * part / parts;
    const Record record = bench.examine(method_, "");
    EXPECT_EQ(record.status, Status::out_of_memory) << part << "/30 of " << peak;
  }
  options_.limits.memory_limit_bytes = peak + MiB;
  EXPECT_EQ(bench.examine(method_, "").status, Status::ok);
}

TEST(ThreeStep, MatricesInAFileOrNowhereAreNotOnTheHeap) {
  const AirySystem rack = airy_system(testing::posed(Scene{}, testing::catalogue_mesh("Mesh4")));
  const auto peak = [&](const char* name) {
    heap::reset_peak();
    const std::int64_t before = heap::live_bytes();
    EXPECT_EQ(run(select_methods(name).front(), rack, {}).status, Status::ok);
    return heap::peak_bytes() - before;
  };
  const std::int64_t columns = rack.n_f() + rack.n_c(), column = 8 * std::int64_t{rack.n()};
  const std::int64_t whole = peak("3STEPD");
  EXPECT_LT(peak("3STEPD:FILE"), whole - columns * column * 95 / 100);
  EXPECT_LT(peak("3STEPD:LEAN"), whole - (columns - skyline_columns_at_once) * column * 95 / 100);
}

TEST(Assembly, Mesh7PeaksAtMostAtThreeTimesItsBlocks) {
  const auto problem = testing::posed(Scene{}, testing::catalogue_mesh("Mesh7"));
  heap::reset_peak();
  const std::int64_t before = heap::live_bytes();
  const AirySystem system = airy_system(problem);
  const std::int64_t blocks = heap::live_bytes() - before;
  EXPECT_LE(heap::peak_bytes() - before, 3 * blocks);
  EXPECT_NEAR(static_cast<double>(blocks), static_cast<double>(system.bytes()),
              0.05 * static_cast<double>(blocks));
}

}  // namespace
}  // namespace airybench::heap_probe_test
