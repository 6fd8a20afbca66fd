#include "meshgen/model_options.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "mesh/mesh.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

[[noreturn]] void refuse_argument(std::string_view option, std::string_view text,
                                  std::string_view allowed) {
  throw std::invalid_argument(
      fmt::format("{}: {} (allowed: {})", option, shortened(text), allowed));
}

struct NamedText {
  std::string name, text;
};

// A name may hold signs of equality; what it is given does not.
NamedText named_text(std::string_view option, const std::string& argument,
                     std::string_view allowed) {
  const std::size_t equals = argument.rfind('=');
  if (equals == argument.npos || equals == 0) refuse_argument(option, argument, allowed);
  return {argument.substr(0, equals), argument.substr(equals + 1)};
}

template <typename Value>
void add_once(std::string_view option, std::map<std::string, Value>& values,
              const std::string& name, Value value) {
  if (!values.emplace(name, std::move(value)).second)
    throw std::invalid_argument(fmt::format("{}: {} is given twice", option, shortened(name)));
}

void set_size(const std::string& text, ModelOptions& options) {
  constexpr double most = 1e9;
  const bool is_factor = text.ends_with('%');
  const std::optional<double> number =
      parse_number(is_factor ? text.substr(0, text.size() - 1) : text);
  constexpr double min_percent = 0.01;  // 1e8 triangles for each
  if (!number || !(*number > 0 && *number <= most) || (is_factor && *number < min_percent))
    refuse_argument("--mesh-size", text,
                    "the longest edge in mm, as 0.5, or a part of the model's sizes, as 50%, of "
                    "0.01% or more");
  if (is_factor)
    options.size_factor = *number / 100;
  else
    options.longest_edge_mm = number;
}

double length_unit_mm(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, double>, 3> units = {
      {{"mm", 1}, {"m", 1000}, {"inch", 25.4}}};
  for (const auto& [known, mm] : units)
    if (name == known) return mm;
  refuse_argument("--length-unit", name, "mm, m, inch");
}

}  // namespace

ModelOptions model_options_of(const std::vector<std::string>& roles,
                              const std::vector<std::string>& parameters,
                              const std::string& mesh_size, const std::string& length_unit) {
  ModelOptions options;
  for (const std::string& role : roles) {
    const std::string allowed = fmt::format("NAME=ROLE with {}", boundary_labels_allowed);
    const auto [name, label] = named_text("--role", role, allowed);
    if (!parse_boundary_label(label)) refuse_argument("--role", role, allowed);
    add_once("--role", options.roles, name, label);
  }
  for (const std::string& parameter : parameters) {
    constexpr const char* allowed = "NAME=NUMBER";
    const auto [name, text] = named_text("--parameter", parameter, allowed);
    const std::optional<double> value = parse_number(text);
    if (!value) refuse_argument("--parameter", parameter, allowed);
    add_once("--parameter", options.parameters, name, *value);
  }
  if (!mesh_size.empty()) set_size(mesh_size, options);
  if (!length_unit.empty()) options.length_unit_mm = length_unit_mm(length_unit);
  return options;
}

ModelLimits model_limits_of(const std::string& time_s, const std::string& memory_MiB) {
  ModelLimits limits;
  const auto read = [](const ModelSetting& setting, const std::string& text, double most,
                       double& limit) {
    if (text.empty()) return;
    const std::optional<double> number = parse_number(text);
    if (!number || !(*number > 0 && *number <= most))
      refuse_argument(setting.option, text, fmt::format("above 0, up to {:g}", most));
    limit = *number;
  };
  read(model_time_setting, time_s, 1e9, limits.time_s);
  read(model_memory_setting, memory_MiB, 1e9, limits.memory_MiB);
  return limits;
}

std::string text_of(const ModelOptions& options) {
  std::string text;
  for (const auto& [name, label] : options.roles)
    text += fmt::format("role {} {} {}\n", name.size(), name, label);
  for (const auto& [name, value] : options.parameters)
    text += fmt::format("parameter {} {} {}\n", name.size(), name, value);
  if (options.longest_edge_mm) text += fmt::format("longest edge {}\n", *options.longest_edge_mm);
  if (options.size_factor) text += fmt::format("size factor {}\n", *options.size_factor);
  if (options.length_unit_mm != 1) text += fmt::format("unit {} mm\n", options.length_unit_mm);
  if (options.algorithm) text += fmt::format("algorithm {}\n", *options.algorithm);
  return text;
}

}  // namespace airybench
