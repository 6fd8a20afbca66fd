#include "solvers/base/blas_library.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <system_error>

namespace airybench {
namespace {

constexpr const char* setting = "OPENBLAS_CORETYPE";

// Null where BLAS does not have the function.
template <typename Function>
void find(void* library, const char* name, Function*& function) {
  function = library == nullptr ? nullptr : reinterpret_cast<Function*>(dlsym(library, name));
}

struct BlasLibrary {
  const char* file = "unknown";
  const char* (*openblas_config)();
  const char* (*openblas_core)();
  int (*openblas_threads)();
  void (*set_openblas_threads)(int);
  const char* (*blis_version)();
  int (*blis_architecture)();
  const char* (*blis_architecture_name)(int);
  std::int64_t (*blis_threads)();  // -1: never set
  void (*set_blis_threads)(std::int64_t);

  BlasLibrary() {
    void* library = nullptr;
    Dl_info found;
    void* const dgemm = dlsym(RTLD_DEFAULT, "cblas_dgemm");
    if (dgemm != nullptr && dladdr(dgemm, &found) != 0) {
      file = found.dli_fname;
      library = dlopen(file, RTLD_LAZY | RTLD_NOLOAD);
      if (library == nullptr) throw std::bad_alloc();  // it is loaded: nothing else is in the way
    }
    find(library, "openblas_get_config", openblas_config);
    find(library, "openblas_get_corename", openblas_core);
    find(library, "openblas_get_num_threads", openblas_threads);
    find(library, "openblas_set_num_threads", set_openblas_threads);
    find(library, "bli_info_get_version_str", blis_version);
    find(library, "bli_arch_query_id", blis_architecture);
    find(library, "bli_arch_string", blis_architecture_name);
    find(library, "bli_thread_get_num_threads", blis_threads);
    find(library, "bli_thread_set_num_threads", set_blis_threads);
  }
};

const BlasLibrary& blas() {
  static const BlasLibrary library;
  return library;
}

}  // namespace

std::string blas_name() {
  if (blas().openblas_config) return blas().openblas_config();
  if (blas().blis_version) return std::string("BLIS ") + blas().blis_version();
  std::error_code not_there;  // the path is empty then
  const std::filesystem::path file = std::filesystem::canonical(blas().file, not_there);
  return not_there ? blas().file : file.string();
}

std::string blas_core() {
  if (blas().openblas_core) return blas().openblas_core();
  if (blas().blis_architecture && blas().blis_architecture_name)
    return blas().blis_architecture_name(blas().blis_architecture());
  return "unknown";
}

int blas_threads() {
  if (blas().openblas_threads) return blas().openblas_threads();
  if (blas().blis_threads)
    return static_cast<int>(std::max<std::int64_t>(1, blas().blis_threads()));
  return 1;
}

void set_blas_threads(int threads) {
  if (blas().set_openblas_threads) blas().set_openblas_threads(threads);
  if (blas().set_blis_threads) blas().set_blis_threads(threads);
}

std::string better_blas_core() {
  if (std::getenv(setting) != nullptr || !blas().openblas_core) return "";
  if (blas_core() != "Prescott") return "";
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
