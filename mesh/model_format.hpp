// The files that a mesh is read from or made of, by their names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace airybench {

enum class ModelFormat { msh, geo, cad, mesh, outline, abaqus, other };

// By the extension, of any case, behind which may be ".gz". geo: Gmsh's language. cad: a body
// without names. mesh: of another program. outline: triangles whose outline is the body (.stl).
ModelFormat format_of(const std::filesystem::path& file);
inline constexpr std::string_view model_extensions =
    "*.geo, *.msh, *.step, *.stp, *.brep, *.iges, *.igs, *.unv, *.med, *.inp, *.vtk, *.bdf, *.mesh,"
    " *.stl, each also as *.gz";

bool is_gzipped(const std::filesystem::path& file);
// The file's name without folder and extension: "part" of "a/part.msh.gz".
std::string model_name(const std::filesystem::path& file);

}  // namespace airybench
