#include "bench/external/answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>

#include "bench/external/npy_array.hpp"
#include "bench/records/json.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

constexpr const char* answer_file = "answer.json";

// The folder is ours, its name says nothing to a user.
std::string text_of(const std::filesystem::path& folder, const std::string& name) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(folder / name, error))
    throw FileError(name + ": there is none in {output}");
  return file_text(folder / name);
}

[[noreturn]] void fail(const char* key, const Json& value, const std::string& allowed) {
  throw FileError(fmt::format("{}: {}: {} (allowed: {})", answer_file, key,
                              shortened(json_text(value)), allowed));
}

double seconds(const char* key, const Json& value) {
  if (!value.is_number() || !(value.get<double>() >= 0)) fail(key, value, "seconds, at least 0");
  return value.get<double>();
}

std::string text(const char* key, const Json& json) {
  if (!json.contains(key)) return {};
  if (!json.at(key).is_string()) fail(key, json.at(key), "a text");
  return shortened(json.at(key).get<std::string>(), 300);
}

template <typename Whole>
std::optional<Whole> count(const char* key, const Json& json) {
  if (!json.contains(key)) return {};
  const Json& value = json.at(key);
  constexpr std::int64_t most = std::numeric_limits<Whole>::max();
  if (!value.is_number_integer() || value < 0 || value > most)
    fail(key, value, fmt::format("a whole number from 0 to {}", most));
  return value.get<Whole>();
}

Status status_in(const Json& json) {
  constexpr std::array<Status, 4> possible = {Status::ok, Status::inaccurate, Status::not_converged,
                                              Status::breakdown};
  const std::string allowed = fmt::format("{}", fmt::join(names_of(possible), ", "));
  const Json value = json.contains("status") ? json.at("status") : Json();
  const auto status = value.is_string() ? status_of(value.get<std::string>()) : std::nullopt;
  if (!status || std::ranges::find(possible, *status) == possible.end())
    fail("status", value, allowed);
  return *status;
}

std::map<Stage, double> stages_in(const Json& json) {
  std::map<Stage, double> stages;
  if (!json.contains("stages")) return stages;
  const Json& given = json.at("stages");
  if (!given.is_object()) fail("stages", given, "an object: stage to seconds");
  for (const auto& [name, value] : given.items()) {
    const auto stage = std::ranges::find(all_stages, name, [](Stage s) { return name_of(s); });
    if (stage == all_stages.end())
      fail("stages", name, fmt::format("{}", fmt::join(names_of(all_stages), ", ")));
    stages[*stage] = seconds("stages", value);
  }
  return stages;
}

}  // namespace

Answer read_answer(const std::filesystem::path& folder) {
  Json json;
  try {
    json = parse_json(text_of(folder, answer_file));
  } catch (const Json::exception& wrong) {
    throw FileError(fmt::format("{}: {}", answer_file, shortened(without_prefix(wrong), 200)));
  }
  if (!json.is_object()) fail("the file", json, "a JSON object");
  Answer answer;
  answer.status = status_in(json);
  answer.message = text("message", json);
  answer.parameters = text("parameters", json);
  answer.time_s = seconds("time_s", json.contains("time_s") ? json.at("time_s") : Json());
  answer.stages = stages_in(json);
  double sum = 0;
  for (const auto& [stage, s] : answer.stages) sum += s;
  constexpr double rounding = 1e-3;
  if (sum > (1 + rounding) * answer.time_s)
    fail("stages", sum, fmt::format("together at most time_s, {}", answer.time_s));
  answer.linear_iterations = count<std::int64_t>("linear_iterations", json);
  answer.contact_iterations = count<int>("contact_iterations", json);
  if (json.contains("error_estimate")) {
    const Json& value = json.at("error_estimate");
    if (!value.is_number() || !(value.get<double>() >= 0))
      fail("error_estimate", value, "a number, at least 0");
    answer.error_estimate = value.get<double>();
  }
  return answer;
}

std::string read_log(const std::filesystem::path& folder) {
  constexpr std::size_t most = 1 << 20;
  std::error_code error;
  if (!std::filesystem::is_regular_file(folder / "log.txt", error)) return {};
  std::ifstream file(folder / "log.txt", std::ios::binary);
  std::string log(most, '\0');
  file.read(log.data(), static_cast<std::streamsize>(most));
  log.resize(static_cast<std::size_t>(file.gcount()));
  return log;
}

Eigen::MatrixXd read_array(const std::filesystem::path& folder, const std::string& name,
                           Eigen::Index rows, Eigen::Index columns) {
  std::error_code unknown;
  if (const std::string binary = std::filesystem::path(name).replace_extension(".npy");
      std::filesystem::is_regular_file(folder / binary, unknown))
    return read_npy(folder, binary, rows, columns);
  std::istringstream file(text_of(folder, name));
  std::string line;
  int number = 0;
  const auto next_line = [&] {
    ++number;
    return static_cast<bool>(std::getline(file, line));
  };
  const auto fail_here = [&](const std::string& allowed) {
    throw FileError(fmt::format("{}:{}: {} (allowed: {})", name, number,
                                file ? shortened(line, 40) : "the file ends", allowed));
  };
  std::string head;
  if (next_line()) head = line;
  std::ranges::transform(head, head.begin(), [](unsigned char c) { return std::tolower(c); });
  if (!head.starts_with("%%matrixmarket matrix array real general"))
    fail_here("%%MatrixMarket matrix array real general");
  do next_line();
  while (file && line.starts_with('%'));
  std::istringstream shape(line);
  Eigen::Index given_rows = -1, given_columns = -1;
  shape >> given_rows >> given_columns;
  if (given_rows != rows || given_columns != columns)
    fail_here(fmt::format("{} {}", rows, columns));
  Eigen::MatrixXd values(rows, columns);
  for (double& value : values.reshaped()) {
    next_line();
    const std::size_t size = line.find_last_not_of(" \t\r") + 1;
    const char* last = line.c_str() + size;
    const char* begin = line.c_str() + std::min(size, line.find_first_not_of(" \t+"));
    const auto [end, error] = std::from_chars(begin, last, value);
    if (!file || end != last || error != std::errc()) fail_here("a number that a double can be");
  }
  while (next_line())
    if (line.find_first_not_of(" \t\r") != line.npos) fail_here("the file's end");
  return values;
}

}  // namespace airybench
