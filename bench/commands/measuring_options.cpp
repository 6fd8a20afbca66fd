#include "bench/commands/measuring_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bench/run/runner.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "support/errors.hpp"
#include "support/lists.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"

namespace airybench {

void read_threads(const std::string& text, bool is_given, Options& options) {
  const bool scaling = options.study == Study::scaling;
  const int processors = processors_at_hand();
  std::set<int> counts = {1};
  if (scaling && !is_given) {
    for (int count = 2; count < processors; count *= 2) counts.insert(count);
    counts.insert(processors);
  }
  const std::vector<std::string> words =
      scaling ? split_list(text) : std::vector<std::string>{text};
  for (const std::string& word : words) {
    const std::optional<std::int64_t> count = parse_whole(word);
    if (!count || *count < 1 || *count > (scaling ? processors : most_threads))
      throw UsageError(fmt::format(
          "--threads: {} (allowed: {})", shortened(text),
          scaling ? fmt::format("whole numbers from 1 to {}, the processors of this machine",
                                processors)
                  : fmt::format("a whole number from 1 to {}; a list with --study=scaling",
                                most_threads)));
    counts.insert(static_cast<int>(*count));
    options.threads = static_cast<int>(*count);
  }
  if (!scaling) return;
  options.thread_counts.assign(counts.begin(), counts.end());
  options.threads = options.thread_counts.back();
}

void read_precision(const std::string& text, Options& options) {
  options.precision = parse_percent(text);
  if (!options.precision)
    throw UsageError(
        fmt::format("--precision: {} (allowed: above 0% and below 100%, as 2%)", shortened(text)));
  if (options.study == Study::stability)
    throw UsageError("--precision: not with --study=stability, which times each case once");
  if (options.max_repetitions < least_repetitions(options))
    throw UsageError(fmt::format("--max-repetitions: {} (allowed: from {} on)",
                                 options.max_repetitions, least_repetitions(options)));
}

void read_retry_noisy(const std::string& text, Options& options) {
  constexpr double most_noise = 0.05;  // as in machine_warnings()
  options.retry_noisy = text == "true" ? most_noise : parse_percent(text);
  if (!options.retry_noisy)
    throw UsageError(
        fmt::format("--retry-noisy: {} (allowed: above 0% and below 100%, as 5%, or no value)",
                    shortened(text)));
}

void read_budgets(const std::string& text, bool has_timeout, Options& options) {
  if (options.study != Study::error)
    throw UsageError("--budget: only with --study=error, whose points it chooses from");
  for (const std::string& word : split_list(text)) {
    const std::optional<double> seconds = parse_number(word);
    if (!seconds || !(*seconds > 0 && *seconds <= most_of_a_limit))
      throw UsageError(fmt::format("--budget: {} (allowed: numbers of seconds above 0, up to {})",
                                   shortened(text), most_of_a_limit));
    options.budgets_s.push_back(*seconds);
  }
  std::ranges::sort(options.budgets_s);
  if (has_timeout) return;
  if (!options.tuning_budget_s) options.tuning_budget_s = options.timeout_s;
  options.timeout_s = 2 * options.budgets_s.back();
}

}  // namespace airybench
