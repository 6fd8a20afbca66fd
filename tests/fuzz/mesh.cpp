#include <sstream>
#include <stdexcept>

#include "assembly/problem/pose.hpp"
#include "mesh/msh_format.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {
namespace {

Mesh read(const std::string& text) {
  std::istringstream in(text);
  return read_msh(in, "fuzz.msh");
}

}  // namespace

void mesh(const std::string& text) {
  const Mesh mesh = read(text);
  const std::string written = msh_text(mesh);
  if (msh_text(read(written)) != written) throw std::logic_error("written and read: another mesh");
  extent_of(mesh);
  pose(Scene(), mesh);
}

}  // namespace airybench::fuzz
