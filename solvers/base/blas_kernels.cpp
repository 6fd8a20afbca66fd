#include "solvers/base/blas_kernels.hpp"

#include <cblas.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace airybench {
namespace {

constexpr const char* setting = "OPENBLAS_CORETYPE";

}  // namespace

std::string better_blas_core() {
  if (std::getenv(setting) != nullptr) return "";
  if (openblas_get_corename() != std::string_view("Prescott")) return "";
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return "";
}

void restart_with_better_blas_core(char* const* argv) {
  const std::string better = better_blas_core();
  if (better.empty()) return;
  // Without allocation: what comes of a lack of memory is told later.
  static std::array<char, 64> entry;
  static std::array<char*, 4096> environment;
  std::snprintf(entry.data(), entry.size(), "%s=%s", setting, better.c_str());
  std::size_t count = 0;
  environment[count++] = entry.data();
  for (char** inherited = environ; *inherited != nullptr; ++inherited) {
    if (count + 1 == environment.size()) return;
    environment[count++] = *inherited;
  }
  execve("/proc/self/exe", argv, environment.data());
}

}  // namespace airybench
