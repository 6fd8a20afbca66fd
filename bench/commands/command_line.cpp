#include "bench/commands/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glob.h>

#include <algorithm>
#include <iterator>

#include "bench/plan/plan.hpp"
#include "mesh/model_settings.hpp"
#include "support/called_as.hpp"
#include "support/errors.hpp"
#include "support/lists.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

std::vector<std::filesystem::path> files_of(const std::string& item) {
  if (std::error_code error; std::filesystem::exists(item, error)) return {item};
  glob_t found = {};
  glob(item.c_str(), GLOB_NOCHECK, nullptr, &found);
  std::vector<std::filesystem::path> files(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return files;
}

}  // namespace

void parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1)
      throw UsageError(fmt::format("{}: (allowed: a value behind the sign)", shortened(argument)));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    throw HelpRequested(with_commands(app.help()));
  } catch (const CLI::CallForAllHelp&) {
    throw HelpRequested(with_commands(app.help("", CLI::AppFormatMode::All)));
  } catch (const CLI::CallForVersion&) {
    throw HelpRequested(app.version() + "\n");
  } catch (const CLI::ExtrasError& error) {
    std::vector<std::string> valid;
    for (const CLI::Option* option : app.get_options())
      if (option != app.get_help_ptr()) valid.push_back(option->get_name());
    valid.emplace_back("--help");
    throw UsageError(fmt::format("{}{} (valid: {})", shortened(error.what()),
                                 perhaps(first_item(app.remaining().front(), '=').item, valid),
                                 fmt::join(valid, " ")));
  } catch (const CLI::ParseError& error) {
    throw UsageError(shortened(error.what(), 300));
  }
}

std::int64_t read_whole(const std::string& option, const std::string& text, std::int64_t least,
                        std::int64_t most) {
  const std::optional<std::int64_t> value = parse_whole(text);
  if (!value || *value < least || *value > most)
    throw UsageError(fmt::format("{}: {} (allowed: a whole number from {} to {})", option,
                                 shortened(text), least, most));
  return *value;
}

double read_number(const std::string& option, const std::string& text, Least least, double most) {
  const std::optional<double> value = parse_number(text);
  if (!value || *value < 0 || (*value == 0 && least == Least::above_zero) || *value > most)
    throw UsageError(fmt::format("{}: {} (allowed: a number {} {})", option, shortened(text),
                                 least == Least::zero ? "from 0 to" : "above 0, up to", most));
  return *value;
}

CLI::Option* add_number(CLI::App& app, const std::string& name, Least least, double most,
                        double& number, const std::string& description) {
  const auto read = [=, &number](const std::string& text) {
    number = read_number(name, text, least, most);
  };
  return app.add_option_function<std::string>(name, read, description)
      ->type_name("NUMBER")
      ->default_str(fmt::format("{}", number));
}

ValueParts::ValueParts(const std::string& of_option, const std::string& whole,
                       const std::vector<std::string>& keys)
    : option(of_option), text(whole) {
  for (const std::string& part : split_list(text)) {
    const std::size_t equals = part.find('=');
    if (equals == part.npos) {
      items.push_back(part);
      continue;
    }
    const std::string key = part.substr(0, equals);
    if (std::ranges::find(keys, key) == keys.end() ||
        !settings.emplace(key, part.substr(equals + 1)).second)
      throw UsageError(fmt::format("{}: {} (allowed: {}=, once)", option, shortened(part),
                                   fmt::join(keys, "=, ")));
  }
}

const std::string& ValueParts::only_item() const {
  if (items.size() != 1)
    throw UsageError(
        fmt::format("{}: {} (allowed: one number, and settings)", option, shortened(text)));
  return items.front();
}

std::optional<std::string> ValueParts::setting(const std::string& key) const {
  const auto found = settings.find(key);
  return found == settings.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> ValueParts::number(const std::string& key, double most) const {
  const std::optional<std::string> value = setting(key);
  if (!value) return {};
  return read_number(option + ": " + key, *value, Least::above_zero, most);
}

void add_files(CLI::App& app, const char* option, std::vector<std::filesystem::path>& files,
               const std::string& about) {
  app.add_option_function<std::vector<std::string>>(
      option,
      [&files](const std::vector<std::string>& lists) {
        for (const std::string& list : lists)
          for (const std::string& item : split_list(list))
            std::ranges::copy(files_of(item), std::back_inserter(files));
      },
      about);
}

void add_memory_limit(CLI::App& app, Limits& limits) {
  const auto read = [&limits](const std::string& text) {
    limits.memory_limit_bytes =
        read_whole("--memory-limit", text, 1, std::int64_t{1} << 40) * 1024 * 1024;
  };
  app.add_option_function<std::string>("--memory-limit", read,
                                       "MiB of heap that one solve may use, its blocks included")
      ->type_name("INT");
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

void add_one_body(CLI::App& app, RunSettings& run) {
  app.add_option("--mesh", run.meshes, "one mesh: a name of the catalogue, or a file")
      ->required()
      ->default_str("");
  add_model_settings(app, run.model_settings);
  app.add_option("--scene", run.scenes, "scene file; default: the documented tooth or rack")
      ->expected(1);
}

void add_part(CLI::App& app, RunSettings& run) {
  app.add_option("MODEL", run.meshes, "a mesh, a model or an input deck")
      ->required()
      ->default_str("");
  app.add_option("SCENE", run.scenes, "a scene file: materials, supports, loads and contact")
      ->expected(0, 1);
  add_whole(app, "--steps", 1, max_load_steps, run.equal_steps, "number of equal load steps");
  add_model_settings(app, run.model_settings);
}

}  // namespace airybench
