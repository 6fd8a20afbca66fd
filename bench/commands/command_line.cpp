#include "bench/commands/command_line.hpp"

#include <fmt/format.h>

#include "support/errors.hpp"

namespace airybench {

void parse_command_line(CLI::App& app, int argc, const char* const* argv) {
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
    throw UsageError(fmt::format("{} (valid: {}--help)", error.what(), valid));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
}

std::vector<std::string> split_list(const std::string& list) {
  std::vector<std::string> items(1);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const char next = i + 1 < list.size() ? list[i + 1] : '\0';
    if (list[i] == '\\' && (next == ',' || next == '\\'))
      items.back() += list[++i];
    else if (list[i] == ',')
      items.emplace_back();
    else
      items.back() += list[i];
  }
  return items;
}

}  // namespace airybench
