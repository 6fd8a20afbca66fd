#include "bench/external/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>

#include "bench/records/json_value.hpp"
#include "bench/records/record.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

// The program has ended: nothing changes between a check and what follows.
bool is_file(const std::filesystem::path& file) {
  std::error_code unknown;
  return std::filesystem::is_directory(symlink_status(file.parent_path(), unknown)) &&
         std::filesystem::is_regular_file(symlink_status(file, unknown));
}

// Messages omit the folder's name, which means nothing to a user.
std::filesystem::path file_in(const std::filesystem::path& folder, const std::string& name,
                              std::uintmax_t max_bytes) {
  if (!is_file(folder / name)) throw FileError(name + ": there is none in {output}");
  if (const auto bytes = file_size(folder / name); bytes > max_bytes)
    throw FileError(fmt::format("{}: {} bytes (allowed: up to {})", name, bytes, max_bytes));
  return folder / name;
}

JsonKey text_key(const char* name, std::string& text) {
  return {name, [&text](const JsonValue& value) {
            read(value, text);
            text = shortened(text, 300);
          }};
}

template <typename Number>
JsonKey amount_key(const std::string& name, Number& amount, const char* allowed) {
  return {name, [&amount, allowed](const JsonValue& value) {
            if (!value.json.is_number() || !(value.json >= 0)) value.fail(allowed);
            amount = value.json.get<double>();
          }};
}

template <typename Int>
JsonKey count_key(const char* name, std::optional<Int>& count) {
  constexpr std::int64_t most = std::numeric_limits<Int>::max();
  return whole(name, count, 0, static_cast<Int>(std::min(most, field_kind::max_count)));
}

// "\x93NUMPY", version 1 0, two bytes of length, the header as a Python dictionary, the numbers.
Eigen::MatrixXd read_npy(const std::filesystem::path& folder, const std::string& name,
                         Eigen::Index rows, Eigen::Index columns) {
  std::ifstream file(folder / name, std::ios::binary);
  std::string start(10, '\0');
  file.read(start.data(), 10);
  if (!file || !start.starts_with(std::string("\x93NUMPY\x01\x00", 8)))
    throw FileError(name + ": its first bytes (allowed: NumPy's format 1.0)");
  const auto byte = [&](int at) { return static_cast<unsigned char>(start[at]); };
  constexpr unsigned longest = 1000;  // a regular expression takes stack by the character
  std::string header(std::min(longest, byte(8) + 256U * byte(9)), '\0');
  file.read(header.data(), static_cast<std::streamsize>(header.size()));
  static const std::regex form(
      R"(\{'descr': '<f8', 'fortran_order': (True|False), 'shape': \((\d+), ?(\d*)\), \}\s*)");
  std::smatch found;
  const std::string shape = fmt::format("{}, {}", rows, columns);
  if (!file || !std::regex_match(header, found, form) ||
      found[2].str() + ", " + (found[3].length() > 0 ? found[3].str() : "1") != shape)
    throw FileError(
        fmt::format("{}: {} (allowed: '<f8', shape ({}))", name, shortened(header, 100), shape));
  const auto read_into = [&](auto values) {
    file.read(
        reinterpret_cast<char*>(values.data()),
        static_cast<std::streamsize>(static_cast<std::size_t>(values.size()) * sizeof(double)));
    if (!file || file.peek() != std::ifstream::traits_type::eof())
      throw FileError(fmt::format("{}: its length (allowed: {} numbers)", name, values.size()));
    return values;
  };
  if (found[1] == "True") return read_into(Eigen::MatrixXd(rows, columns));
  return read_into(
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>(rows, columns));
}

}  // namespace

Answer read_answer(const std::filesystem::path& folder) {
  constexpr std::array<Status, 5> statuses = {Status::ok, Status::inaccurate, Status::not_converged,
                                              Status::breakdown, Status::skipped};
  constexpr const char* seconds = "seconds, at least 0";
  constexpr std::size_t max_bytes = 1 << 20;
  const Json json =
      json_of_file("answer.json", file_text(file_in(folder, "answer.json", max_bytes)));
  Answer answer;
  const auto read_status = [&](const JsonValue& value) {
    answer.status = value.one_of(statuses, [](Status status) { return name_of(status); });
  };
  const auto read_stages = [&](const JsonValue& value) {
    std::array<std::optional<double>, all_stages.size()> times;
    std::vector<JsonKey> keys;
    for (std::size_t k = 0; k < times.size(); ++k)
      keys.push_back(amount_key(std::string(name_of(all_stages[k])), times[k], seconds));
    value.object(keys);
    double sum = 0;
    for (std::size_t k = 0; k < times.size(); ++k)
      if (times[k]) sum += answer.stages[all_stages[k]] = *times[k];
    constexpr double rounding = 1e-3;
    if (sum > (1 + rounding) * answer.time_s)
      value.refuse(sum, fmt::format("together at most time_s, {}", answer.time_s));
  };
  JsonValue("answer.json", "", json)
      .take({required({"status", read_status}),
             text_key("message", answer.message),
             text_key("parameters", answer.parameters),
             required(amount_key("time_s", answer.time_s, seconds)),
             {"stages", read_stages},
             count_key("linear_iterations", answer.linear_iterations),
             count_key("contact_iterations", answer.contact_iterations),
             amount_key("error_estimate", answer.error_estimate, "a number, at least 0")});
  return answer;
}

std::string read_log(const std::filesystem::path& folder) {
  constexpr std::size_t most = 1 << 20;
  if (!is_file(folder / "log.txt")) return {};
  std::ifstream file(folder / "log.txt", std::ios::binary);
  std::string log(most, '\0');
  file.read(log.data(), static_cast<std::streamsize>(most));
  log.resize(static_cast<std::size_t>(file.gcount()));
  return log;
}

Eigen::MatrixXd read_array(const std::filesystem::path& folder, const std::string& name,
                           Eigen::Index rows, Eigen::Index columns) {
  if (const std::string binary = std::filesystem::path(name).replace_extension(".npy");
      is_file(folder / binary))
    return read_npy(folder, binary, rows, columns);
  constexpr std::uintmax_t max_bytes_per_number = 100, max_bytes_of_comments = 1 << 20;
  const auto numbers = static_cast<std::uintmax_t>(rows * columns);
  std::ifstream file(file_in(folder, name, max_bytes_of_comments + max_bytes_per_number * numbers));
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
