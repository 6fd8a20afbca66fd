#include "mesh/model_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace airybench {

ModelFormat format_of(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 5> cad = {".step", ".stp", ".brep", ".iges", ".igs"};
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".msh") return ModelFormat::msh;
  if (extension == ".geo") return ModelFormat::geo;
  return std::ranges::find(cad, extension) != cad.end() ? ModelFormat::cad : ModelFormat::other;
}

}  // namespace airybench
