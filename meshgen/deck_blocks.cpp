#include "meshgen/deck_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numbers>
#include <sstream>

#include "meshgen/announced_counts.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

std::string trimmed(const std::string& text) {
  constexpr const char* blanks = " \t\r\"";
  const std::size_t first = text.find_first_not_of(blanks), last = text.find_last_not_of(blanks);
  return first == text.npos ? "" : text.substr(first, last - first + 1);
}

constexpr const char* too_many_lines =
    "more lines, with included files and every instance of a part, than 1e7 (allowed: up to that)";

class BlockReader {
 public:
  BlockReader(std::filesystem::path folder, std::vector<DeckBlock>& blocks)
      : folder_(std::move(folder)), blocks_(blocks) {}

  // prefix: of places.
  void read(const std::string& text, const std::string& prefix) {
    std::istringstream lines(text);
    int number = 0;
    bool goes_on = false;  // a keyword's line that ends with a comma
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (++lines_ > max_entries) throw InputError(too_many_lines);
      line.erase(0, std::min(line.find_first_not_of(" \t"), line.size()));
      if (line.starts_with("**") || line.find_first_not_of(" \t\r") == line.npos) continue;
      const DeckLine here{line, fmt::format("{}line {}", prefix, number)};
      if (line.starts_with("*")) {
        include_last(prefix);
        blocks_.push_back({.keyword = {}, .parameters = {}, .line = here, .data = {}});
        add_parameters(blocks_.back(), {line.substr(1), here.place});
        goes_on = trimmed(line).ends_with(',');
      } else if (goes_on) {
        add_parameters(blocks_.back(), here);
        goes_on = trimmed(line).ends_with(',');
      } else if (blocks_.empty()) {
        here.fail("data before the first keyword");
      } else {
        blocks_.back().data.push_back(here);
      }
    }
    include_last(prefix);
  }

 private:
  static void add_parameters(DeckBlock& block, const DeckLine& line) {
    std::vector<std::string> fields = line.fields();
    auto field = fields.begin();
    if (block.keyword.empty() && field != fields.end()) block.keyword = in_capitals(*field++);
    for (; field != fields.end(); ++field) {
      const std::size_t equals = std::min(field->find('='), field->size());
      const std::string name = in_capitals(trimmed(field->substr(0, equals)));
      if (!name.empty())
        block.parameters[name] = trimmed(field->substr(std::min(equals + 1, field->size())));
    }
  }

  void include_last(const std::string& prefix) {
    if (blocks_.empty() || blocks_.back().keyword != "INCLUDE") return;
    const DeckBlock block = std::move(blocks_.back());
    blocks_.pop_back();
    if (!block.data.empty()) block.data.front().fail("data after *INCLUDE");
    const std::filesystem::path file = block.value("INPUT");
    const bool leaves = file.is_absolute() || std::ranges::find(file, "..") != file.end();
    if (file.empty() || leaves)
      block.line.fail(fmt::format("*INCLUDE of '{}' (allowed: a file in the deck's folder)",
                                  shortened(file.string())));
    if (!prefix.empty())
      block.line.fail("*INCLUDE in an included file (allowed: in the deck itself)");
    try {
      read(file_text(folder_ / file), file.string() + ": ");
    } catch (const FileError& error) {
      block.line.fail(fmt::format("*INCLUDE: {}", error.what()));
    }
  }

  std::filesystem::path folder_;
  std::vector<DeckBlock>& blocks_;
  std::size_t lines_ = 0;  // of included files, too
};

// From the part's place: moved by the first line, then turned about the second's axis.
Eigen::Isometry3d placed(const DeckBlock& instance) {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  std::vector<std::vector<double>> numbers;
  for (const DeckLine& line : instance.data) {
    numbers.emplace_back();
    for (const std::string& field : line.fields())
      numbers.back().push_back(field.empty() ? 0 : line.number(field));
    numbers.back().resize(7, 0);
  }
  if (!numbers.empty()) place.translation() = Eigen::Vector3d(numbers[0].data());
  if (numbers.size() < 2) return place;
  const Eigen::Vector3d a(numbers[1].data()), b(numbers[1].data() + 3);
  if (!(a != b)) instance.data[1].fail("an axis of no length (allowed: two points and an angle)");
  const Eigen::AngleAxisd turn(numbers[1][6] * std::numbers::pi / 180, (b - a).normalized());
  return Eigen::Translation3d(a) * turn * Eigen::Translation3d(-a) * place;
}

// Replaces *INSTANCE by the blocks of its part.
DeckFile with_instances(std::vector<DeckBlock> blocks) {
  struct Part {
    std::vector<DeckBlock> blocks;
    std::size_t instances = 0;
  };
  std::map<std::string, Part> parts;
  for (const DeckBlock& block : blocks)
    if (block.keyword == "INSTANCE") ++parts[in_capitals(block.value("PART"))].instances;
  DeckFile file;
  Part* part = nullptr;
  int instance = -1;
  std::size_t lines = 0;
  for (DeckBlock& block : blocks) {
    if (block.keyword == "PART") {
      const auto found = parts.find(in_capitals(block.value("NAME")));
      part = found == parts.end() ? nullptr : &found->second;
    } else if (block.keyword == "END PART") {
      part = nullptr;
    } else if (block.keyword == "INSTANCE") {
      instance = static_cast<int>(file.instances.size());
      file.instances.push_back({block.value("NAME"), placed(block)});
      for (DeckBlock copy : parts.at(in_capitals(block.value("PART"))).blocks) {
        copy.instance = instance;
        file.blocks.push_back(std::move(copy));
      }
    } else if (block.keyword == "END INSTANCE") {
      instance = -1;
    } else if (block.keyword != "ASSEMBLY" && block.keyword != "END ASSEMBLY") {
      block.instance = instance;
      lines += (1 + block.data.size()) * (part != nullptr ? part->instances : 1);
      if (lines > max_entries) throw InputError(too_many_lines);
      (part != nullptr ? part->blocks : file.blocks).push_back(std::move(block));
    }
  }
  return file;
}

}  // namespace

std::vector<std::string> DeckLine::fields() const {
  std::vector<std::string> fields;
  std::istringstream in(text);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(trimmed(field));
  return fields;
}

void DeckLine::fail(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", place, what));
}

double DeckLine::number(const std::string& field) const {
  const auto number = parse_number(field.starts_with('+') ? field.substr(1) : field);
  if (!number) fail(fmt::format("'{}' (allowed: a number)", shortened(field)));
  return *number;
}

long DeckLine::whole(const std::string& field) const {
  const auto number = parse_whole(field);
  if (!number) fail(fmt::format("'{}' (allowed: a whole number)", shortened(field)));
  return static_cast<long>(*number);
}

std::string DeckBlock::value(const std::string& parameter) const {
  const auto found = parameters.find(parameter);
  return found == parameters.end() ? "" : found->second;
}

DeckFile read_deck_file(const std::string& text, const std::filesystem::path& folder) {
  std::vector<DeckBlock> blocks;
  BlockReader(folder, blocks).read(text, "");
  return with_instances(std::move(blocks));
}

bool includes_files(const std::string& text) {
  std::string tight = in_capitals(text);
  std::erase_if(tight, [](char c) { return c == ' ' || c == '\t'; });
  return tight.find("*INCLUDE") != tight.npos;
}

std::string in_capitals(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

}  // namespace airybench
