// Who killed a process? The kernel counts those that it kills because memory runs out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace airybench {

// So far: in this process's control group (version 2, memory.events), else on this machine
// (/proc/vmstat); empty: neither says. root: where /proc and /sys are.
std::optional<std::int64_t> oom_kills(const std::filesystem::path& root = "/");

}  // namespace airybench
