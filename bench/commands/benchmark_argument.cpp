#include <fmt/format.h>

#include <string_view>

#include "bench/commands/command_line.hpp"
#include "bench/records/json.hpp"
#include "support/shortened.hpp"

namespace airybench {

void take_benchmark_argument(const std::string& argument, Options& options) {
  const auto value_of = [&](std::string_view option) -> std::optional<std::string> {
    if (!argument.starts_with(option)) return {};
    return argument.substr(option.size());
  };
  if (const auto filter = value_of("--benchmark_filter=")) {
    options.run.filter = *filter;
  } else if (const auto pair = value_of("--benchmark_context=")) {
    const std::size_t equals = pair->find('=');
    if (equals == pair->npos || equals == 0 || !is_utf8(*pair))
      throw UsageError(fmt::format("-- --benchmark_context={}: (allowed: key=value in UTF-8)",
                                   is_utf8(*pair) ? shortened(*pair) : "…"));
    options.output.context[pair->substr(0, equals)] = pair->substr(equals + 1);
  } else if (const auto word = value_of("--benchmark_enable_random_interleaving=")) {
    if (*word != "true" && *word != "false")
      throw UsageError(fmt::format(
          "-- --benchmark_enable_random_interleaving={} (allowed: true, false)", shortened(*word)));
    options.limits.interleave = *word == "true";
  } else {
    throw UsageError(
        fmt::format("-- {}: not for bench's runs (allowed: --benchmark_filter=, "
                    "--benchmark_enable_random_interleaving=, --benchmark_context=)",
                    shortened(argument)));
  }
}

}  // namespace airybench
