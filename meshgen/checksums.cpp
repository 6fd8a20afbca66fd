#include "meshgen/checksums.hpp"

#include <fstream>
#include <stdexcept>

#include "meshgen/catalogue.hpp"
#include "support/sha256.hpp"

namespace airybench {

std::map<std::string, std::string> read_checksums(const std::filesystem::path& file) {
  constexpr std::size_t digits = 64;
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
  std::map<std::string, std::string> hash_of_file;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.size() < digits + 3 || line.compare(digits, 2, "  ") != 0 ||
        line.find_first_not_of("0123456789abcdef") != digits)
      throw std::runtime_error(file.string() + ":" + std::to_string(number) +
                               ": 64 hexadecimal digits, two blanks and a file name expected");
    hash_of_file[line.substr(digits + 2)] = line.substr(0, digits);
  }
  return hash_of_file;
}

std::string checksums_of_folder(const std::filesystem::path& folder) {
  std::string text;
  for (const CatalogueRow& row : catalogue) {
    const std::string name = std::string(row.name) + ".msh";
    if (std::filesystem::exists(folder / name))
      text += sha256_of_file(folder / name) + "  " + name + "\n";
  }
  return text;
}

}  // namespace airybench
