#include "bench/records/context.hpp"

#include <fmt/format.h>

#include <set>

namespace airybench {
namespace {

const std::set<std::string> of_the_moment = {"date", "load_1min_at_start", "host", "shard"};

// Options that do not change a solve.
const std::set<std::string> of_the_run = {
    "adapt",     "adapt_by",       "cases_planned",   "fields",      "interleaved",
    "levels",    "long_case_s",    "max_repetitions", "marking",     "memory_limit_bytes",
    "others_s",  "plan_sha256",    "precision",       "repetitions", "retry_noisy",
    "timeout_s", "tuning_budget_s"};

constexpr int max_named = 6;

std::string value_of(const Context& context, const std::string& key) {
  return context.contains(key) ? context.at(key) : "(not said)";
}

}  // namespace

std::string context_word(const Context& context, const std::string& key) {
  const auto found = context.find(key);
  return found == context.end() ? "" : found->second;
}

std::string differences(const Context& a, const Context& b, Sameness sameness) {
  std::set<std::string> keys;
  for (const Context* context : {&a, &b})
    for (const auto& [key, value] : *context) keys.insert(key);
  const bool clean = value_of(a, "git_dirty") == "no" && value_of(b, "git_dirty") == "no";
  std::string text;
  int count = 0;
  for (const std::string& key : keys) {
    if (of_the_moment.count(key) > 0) continue;
    if (sameness == Sameness::different_runs && of_the_run.count(key) > 0) continue;
    if (key == "program_sha256" && sameness != Sameness::same_program && clean) continue;
    const std::string first = value_of(a, key), second = value_of(b, key);
    if (first != second && ++count <= max_named)
      text += fmt::format("{}{}: {} and {}", text.empty() ? "" : "; ", key, first, second);
  }
  return count > max_named ? fmt::format("{}; and {} more", text, count - max_named) : text;
}

}  // namespace airybench
