// The readers of files that come from elsewhere. Each takes what is good, does with it what every
// run does, and throws InputError for the rest; anything else that happens is a finding.
#pragma once

#include <string>
#include <vector>

namespace airybench::fuzz {

struct Reader {
  const char* name;
  void (*read)(const std::string& text);
};
std::vector<Reader> readers();  // those of the test's program

void mesh(const std::string& text);
void scene(const std::string& text);
void record(const std::string& text);  // a file of them
void night(const std::string& text);
void siconos(const std::string& text);  // a contact problem
void fclib(const std::string& text);    // a contact problem in HDF5
void deck(const std::string& text);     // .inp
// What we read of a model before Gmsh does; the first line is its extension, ".vtk".
void model(const std::string& text);

}  // namespace airybench::fuzz
