#include "solvers/base/blas_kernels.hpp"

#include <gtest/gtest.h>

#include "tests/support/bench_command.hpp"
#include "tests/support/environment_variable.hpp"

namespace airybench::blas_kernels_test {
namespace {

using testing::BenchCommand;

std::string core_of_record(const std::string& environment) {
  const BenchCommand bench;
  EXPECT_EQ(bench.run("--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=o", environment).code, 0);
  return bench.records().at(0)["context"]["blas_core"];
}

TEST(BlasKernels, AreNotThoseOf2004OnAProcessorThatHasMore) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) GTEST_SKIP();
  EXPECT_NE(core_of_record("unset OPENBLAS_CORETYPE; "), "Prescott");
#else
  GTEST_SKIP() << "kernels of another family of processors";
#endif
}

TEST(BlasKernels, AreThoseThatAreAskedFor) {
  EXPECT_EQ(better_blas_core(), "") << "this test has others than bench would take";
  EXPECT_EQ(core_of_record("export OPENBLAS_CORETYPE=Prescott; "), "Prescott");
  const testing::EnvironmentVariable asked("OPENBLAS_CORETYPE", "Prescott");
  EXPECT_EQ(better_blas_core(), "");
}

}  // namespace
}  // namespace airybench::blas_kernels_test
