#include "bench/commands/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "mesh/model_settings.hpp"
#include "support/errors.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"

namespace airybench {

void parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1)
      throw UsageError(fmt::format("{}: (allowed: a value behind the sign)", shortened(argument)));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    throw HelpRequested(app.help());
  } catch (const CLI::CallForVersion&) {
    throw HelpRequested(app.version() + "\n");
  } catch (const CLI::ExtrasError& error) {
    std::string valid;
    for (const CLI::Option* option : app.get_options())
      if (option != app.get_help_ptr()) valid += option->get_name() + " ";
    throw UsageError(fmt::format("{} (valid: {}--help)", shortened(error.what()), valid));
  } catch (const CLI::ParseError& error) {
    throw UsageError(shortened(error.what(), 300));
  }
}

CLI::Option* add_whole(CLI::App& app, const std::string& name, std::int64_t least,
                       std::int64_t most, std::int64_t preset,
                       const std::function<void(std::int64_t)>& set,
                       const std::string& description) {
  const auto read = [=](const std::string& text) {
    const std::optional<std::int64_t> value = parse_whole(text);
    if (!value || *value < least || *value > most)
      throw UsageError(fmt::format("{}: {} (allowed: a whole number from {} to {})", name,
                                   shortened(text), least, most));
    set(*value);
  };
  return app.add_option_function<std::string>(name, read, description)
      ->type_name("INT")
      ->default_str(preset < least ? "" : std::to_string(preset));
}

CLI::Option* add_number(CLI::App& app, const std::string& name, Least least, double most,
                        double& number, const std::string& description) {
  const auto read = [=, &number](const std::string& text) {
    const std::optional<double> value = parse_number(text);
    if (!value || *value < 0 || (*value == 0 && least == Least::above_zero) || *value > most)
      throw UsageError(fmt::format("{}: {} (allowed: a number {} {})", name, shortened(text),
                                   least == Least::zero ? "from 0 to" : "above 0, up to", most));
    number = *value;
  };
  return app.add_option_function<std::string>(name, read, description)
      ->type_name("NUMBER")
      ->default_str(fmt::format("{}", number));
}

void add_model_settings(CLI::App& app, std::vector<std::string>& settings) {
  for (const ModelSetting& setting : model_settings) {
    const auto keep = [&settings, &setting](const std::vector<std::string>& values) {
      for (const std::string& value : values)
        settings.push_back(fmt::format("{}={}", setting.option, value));
    };
    app.add_option_function<std::vector<std::string>>(setting.option, keep, setting.help)
        ->allow_extra_args(false)
        ->type_name(setting.type);
  }
}

std::string shell_word(const std::string& word) {
  const bool is_plain = !word.empty() && std::ranges::all_of(word, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_./+-=%@", c) != nullptr;
  });
  if (is_plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

void run_after(const std::string& command, const std::filesystem::path& folder) {
  if (command.empty()) return;
  std::fflush(stdout);
  if (std::system(fmt::format("{} {}", command, shell_word(folder.string())).c_str()) != 0)
    std::cerr << fmt::format("note: --then: {}: failed\n", command);
}

}  // namespace airybench
