// Input decks of Abaqus and CalculiX as a list of keywords with their data. Included files and the
// instances of parts stand in their places.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace airybench {

struct DeckLine {
  std::string text;
  std::string place;  // "line 12", of an included file "bolt.inp: line 12"

  std::vector<std::string> fields() const;  // between commas, without blanks and quotes
  // Throw InputError, "line 12: …".
  [[noreturn]] void fail(const std::string& what) const;
  double number(const std::string& field) const;
  long whole(const std::string& field) const;
};

struct DeckBlock {
  std::string keyword;                            // without its star, in capitals
  std::map<std::string, std::string> parameters;  // names in capitals
  DeckLine line;
  std::vector<DeckLine> data;
  int instance = -1;  // of DeckFile::instances; none: of the whole model

  bool has(const std::string& parameter) const { return parameters.contains(parameter); }
  std::string value(const std::string& parameter) const;  // none: ""
};

struct DeckInstance {
  std::string name;
  Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();
};

struct DeckFile {
  std::vector<DeckBlock> blocks;  // without parts, assemblies, instances and includes
  std::vector<DeckInstance> instances;
};

// folder: of the deck; its includes must lie in it. Throws InputError, one line: place, what is
// wrong.
DeckFile read_deck_file(const std::string& text, const std::filesystem::path& folder);

std::string in_capitals(std::string text);
bool includes_files(const std::string& text);

}  // namespace airybench
