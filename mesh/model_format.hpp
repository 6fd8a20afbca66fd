// The files that a mesh is read from or made of, by their names.
#pragma once

#include <filesystem>
#include <string_view>

namespace airybench {

enum class ModelFormat { msh, geo, cad, other };

// By the extension, of any case: .msh; .geo, Gmsh's language; .step, .stp, .brep, .iges, .igs, a
// body without names.
ModelFormat format_of(const std::filesystem::path& file);
inline constexpr std::string_view model_extensions = "*.geo, *.step, *.brep, *.iges";

}  // namespace airybench
