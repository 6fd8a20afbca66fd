#include "mesh/model_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

namespace airybench {
namespace {

constexpr auto formats = std::to_array<std::pair<std::string_view, ModelFormat>>({
    {".msh", ModelFormat::msh},
    {".geo", ModelFormat::geo},
    {".geo_unrolled", ModelFormat::geo},
    {".step", ModelFormat::cad},
    {".stp", ModelFormat::cad},
    {".brep", ModelFormat::cad},
    {".iges", ModelFormat::cad},
    {".igs", ModelFormat::cad},
    {".unv", ModelFormat::mesh},
    {".med", ModelFormat::med},
    {".vtk", ModelFormat::mesh},
    {".bdf", ModelFormat::mesh},
    {".mesh", ModelFormat::mesh},
    {".inp", ModelFormat::abaqus},
    {".stl", ModelFormat::outline},
    {".obj", ModelFormat::obj},
});

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::filesystem::path unpacked(const std::filesystem::path& file) {
  return is_gzipped(file) ? file.stem() : file.filename();
}

}  // namespace

ModelFormat format_of(const std::filesystem::path& file) {
  const std::string extension = extension_of(unpacked(file));
  for (const auto& [known, format] : formats)
    if (extension == known) return format;
  return ModelFormat::other;
}

bool is_gzipped(const std::filesystem::path& file) { return extension_of(file) == ".gz"; }

std::string model_name(const std::filesystem::path& file) { return unpacked(file).stem().string(); }

}  // namespace airybench
