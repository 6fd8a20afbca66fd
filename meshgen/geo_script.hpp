// What a .geo says of itself, read without running it.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace airybench {

struct GeoScript {
  // It and all that it includes or merges by a literal name, each once, in the order of reading.
  std::vector<std::filesystem::path> files;
  std::set<std::string> constants;     // of DefineConstant: numbers that can be given from outside
  std::set<std::string> onelab_names;  // of DefineConstant and DefineNumber: Name "Parameters/h"
  // What it makes depends on these files alone: on no file whose name is computed, nor on time,
  // environment, chance.
  bool is_self_contained = true;
  // Some word of theirs may read a file, or depend on time or chance, for all that is known of it.
  bool has_unknown_words = false;
  bool may_write = false, may_start_programs = false;  // by its words, if it comes to them
  bool has_external_process = false;                   // a size field that a program computes
};

// Throws FileError: the file cannot be read.
GeoScript read_geo_script(const std::filesystem::path& file);

// Of any model: its file, all that a .geo includes, and FILE.opt, which Gmsh reads after FILE as if
// it were a .geo.
GeoScript what_is_read(const std::filesystem::path& model);

// The first line of a file that holds the text; 0: none.
int line_with(const std::filesystem::path& file, const std::string& text);

}  // namespace airybench
