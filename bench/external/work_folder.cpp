#include "bench/external/work_folder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include "support/errors.hpp"
#include "support/shortened.hpp"

namespace airybench {

WorkFolder::WorkFolder() {
  const char* given = std::getenv("TMPDIR");
  // The program runs in another folder.
  const std::filesystem::path parent =
      std::filesystem::absolute(given == nullptr || *given == '\0' ? "/tmp" : given);
  std::string name = (parent / "airybench-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw FileError(fmt::format("TMPDIR: {}: no folder can be made there: {}", parent.string(),
                                std::generic_category().message(errno)));
  path_ = name;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path WorkFolder::add(const std::string& name, const Files& files) const {
  const std::filesystem::path folder = path_ / name;
  std::filesystem::create_directory(folder);
  for (const auto& [file, bytes] : files) {
    std::ofstream out(folder / file, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush())
      throw FileError(fmt::format("{}: cannot be written: {}", (folder / file).string(),
                                  std::generic_category().message(errno)));
  }
  return folder;
}

std::vector<std::string> printed_lines(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(" \t\r") == line.npos) continue;
    if (lines.size() < 2) lines.emplace_back();
    lines.back() = shortened(line, 200);
  }
  return lines;
}

std::string how_it_ended(const ProcessTreeEnd& end, double limit_s) {
  if (end.start_error != 0)
    return "cannot be started: " + std::generic_category().message(end.start_error);
  if (end.timed_out) return fmt::format("was ended after the limit of {:.3g} s", limit_s);
  if (end.over_memory) return "was ended: it passed the memory limit";
  if (end.signal == SIGXFSZ) return "was ended by SIGXFSZ: a file that it wrote became too large";
  if (end.signal != 0) return fmt::format("was ended by SIG{}", sigabbrev_np(end.signal));
  return fmt::format("ended with exit code {}", end.exit_code);
}

}  // namespace airybench
