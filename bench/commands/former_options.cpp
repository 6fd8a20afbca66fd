#include "bench/commands/former_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <string_view>

#include "support/called_as.hpp"
#include "support/data_folder.hpp"
#include "support/errors.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

const std::map<std::string_view, std::string_view> replaced = {
    {"--adapt-by", "--adapt=GOAL,by=METHOD"},
    {"--budget", "--study=error:SECONDS"},
    {"--histories", "--fields=histories"},
    {"--levels", "--adapt=GOAL,levels=last"},
    {"--long-case", "--repetitions=N,within=SECONDS"},
    {"--marking", "--adapt=GOAL,marking=SHARE"},
    {"--max-repetitions", "--repetitions=N..MOST,precision=2%"},
    {"--precision", "--repetitions=N,precision=2%"},
    {"--then", "a command of your own, after bench"},
    {"--tuning-budget", "--timeout=SECONDS,tuning=SECONDS"},
};

struct FormerMode {
  std::string_view option;
  bool has_value = false;
};
constexpr std::array former_modes = {FormerMode{"--list"}, FormerMode{"--new-scene", true},
                                     FormerMode{"--new-external", true},
                                     FormerMode{"--check", true}, FormerMode{"--explain"}};

}  // namespace

void refuse_replaced(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (const auto found = replaced.find(word.substr(0, word.find('='))); found != replaced.end())
      throw UsageError(fmt::format("{}: is now {}", found->first, found->second));
  }
}

void refuse_former_command(std::string_view word) {
  if (word == "claims")
    throw UsageError(fmt::format("claims: is now {} claims DIR (without {}: python3 {} DIR)",
                                 called_as("run"), called_as("run"),
                                 shell_word((data_folder("plots") / "claims.py").string())));
}

std::vector<std::string> with_command(std::vector<std::string> words) {
  if (words.size() < 2 || !words[1].starts_with('-')) return words;
  const auto first = words.begin() + 1;
  const auto end = std::find(first, words.end(), "--");
  for (const FormerMode& mode : former_modes) {
    const auto found = std::find_if(first, end, [&](const std::string& word) {
      return word.substr(0, word.find('=')) == mode.option;
    });
    if (found == end) continue;
    std::vector<std::string> now = {std::string(mode.option.substr(2))};
    auto rest = found + 1;
    if (const std::size_t equals = found->find('='); mode.has_value && equals != found->npos)
      now.push_back(found->substr(equals + 1));
    else if (mode.has_value && rest != end)
      now.push_back(*rest++);
    std::string shown;
    for (const std::string& word : now) shown += " " + shell_word(word);
    std::cerr << fmt::format("note: {}: is now {}{} (this version still takes both)\n", mode.option,
                             called_as("bench"), shortened(shown));
    now.insert(now.begin(), words.front());
    now.insert(now.end(), first, found);
    now.insert(now.end(), rest, words.end());
    return now;
  }
  return words;
}

}  // namespace airybench
