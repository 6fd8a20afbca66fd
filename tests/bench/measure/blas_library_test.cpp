#include "solvers/base/blas_library.hpp"

#include <gtest/gtest.h>

#include "tests/support/bench_command.hpp"
#include "tests/support/environment_variable.hpp"

namespace airybench::blas_library_test {
namespace {

using testing::BenchCommand;

bool is_openblas() { return blas_name().starts_with("OpenBLAS"); }

nlohmann::json context_of_record(const std::string& environment) {
  const BenchCommand bench;
  EXPECT_EQ(bench.run("--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=o", environment).code, 0);
  return bench.records().at(0)["context"];
}

TEST(BlasLibrary, IsTheOneThatTheRecordNames) {
  const nlohmann::json context = context_of_record("");
  EXPECT_NE(blas_name(), "unknown");
  EXPECT_EQ(context["blas"], blas_name());
  EXPECT_EQ(context["blas_core"], blas_core());
  EXPECT_EQ(context["blas_threads"], "1");
}

TEST(BlasLibrary, HasAsManyThreadsAsItIsGivenOrOne) {
  const bool has_threads = is_openblas() || blas_name().starts_with("BLIS");
  const int before = blas_threads();
  for (const int threads : {2, 1}) {
    set_blas_threads(threads);
    EXPECT_EQ(blas_threads(), has_threads ? threads : 1);
  }
  set_blas_threads(before);
}

TEST(KernelsOfOpenBlas, AreNotThoseOf2004OnAProcessorThatHasMore) {
#if defined(__x86_64__)
  if (!is_openblas() || !__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    GTEST_SKIP();
  EXPECT_NE(context_of_record("unset OPENBLAS_CORETYPE; ")["blas_core"], "Prescott");
#else
  GTEST_SKIP() << "kernels of another family of processors";
#endif
}

TEST(KernelsOfOpenBlas, AreThoseThatAreAskedFor) {
  EXPECT_EQ(better_blas_core(), "") << "this test has others than bench would take";
  if (!is_openblas()) GTEST_SKIP() << blas_name();
#if defined(__x86_64__)
  const std::string asked = "Prescott";
#else
  const std::string asked = "cortexa57";
#endif
  EXPECT_EQ(context_of_record("export OPENBLAS_CORETYPE=" + asked + "; ")["blas_core"], asked);
  const testing::EnvironmentVariable variable("OPENBLAS_CORETYPE", asked);
  EXPECT_EQ(better_blas_core(), "");
}

}  // namespace
}  // namespace airybench::blas_library_test
