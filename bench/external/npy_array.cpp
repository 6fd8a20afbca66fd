#include "bench/external/npy_array.hpp"

#include <fmt/format.h>

#include <fstream>
#include <regex>

#include "support/errors.hpp"
#include "support/shortened.hpp"

namespace airybench {

// "\x93NUMPY", version 1 0, two bytes of length, the header as a Python dictionary, the numbers.
Eigen::MatrixXd read_npy(const std::filesystem::path& folder, const std::string& name,
                         Eigen::Index rows, Eigen::Index columns) {
  std::ifstream file(folder / name, std::ios::binary);
  std::string start(10, '\0');
  file.read(start.data(), 10);
  if (!file || !start.starts_with(std::string("\x93NUMPY\x01\x00", 8)))
    throw FileError(name + ": its first bytes (allowed: NumPy's format 1.0)");
  const auto byte = [&](int at) { return static_cast<unsigned char>(start[at]); };
  std::string header(byte(8) + 256U * byte(9), '\0');
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

}  // namespace airybench
