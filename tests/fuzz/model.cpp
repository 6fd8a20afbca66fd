#include <algorithm>
#include <array>
#include <string_view>

#include "meshgen/geo_script.hpp"
#include "meshgen/gmsh_input.hpp"
#include "support/errors.hpp"
#include "tests/fuzz/given_file.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

void model(const std::string& text) {
  constexpr auto extensions = std::to_array<std::string_view>(
      {".geo", ".msh", ".vtk", ".unv", ".bdf", ".mesh", ".stl", ".brep"});
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string extension = text.substr(0, end);
  if (std::ranges::find(extensions, extension) == extensions.end())
    throw InputError("no extension of a model");
  const std::filesystem::path file =
      given_file(extension, text.substr(std::min(end + 1, text.size())));
  what_is_read(file);
  const GmshInput input(file);
}

}  // namespace airybench::fuzz
