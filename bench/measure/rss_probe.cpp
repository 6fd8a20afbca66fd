#include "bench/measure/rss_probe.hpp"

#include <fstream>
#include <string>

namespace airybench::rss {

bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;  // proc(5): reset the peak resident set size
  return file.good();
}

std::optional<std::int64_t> peak_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    if (word != "VmHWM:") continue;
    std::int64_t kibibytes = 0;
    if (file >> kibibytes) return kibibytes * 1024;
  }
  return std::nullopt;
}

}  // namespace airybench::rss
