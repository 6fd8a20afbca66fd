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

}  // namespace airybench
