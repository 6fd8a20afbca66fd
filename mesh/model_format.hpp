// The files that a mesh is read from or made of, by their names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace airybench {

enum class ModelFormat { msh, geo, cad, mesh, med, outline, obj, abaqus, other };

// By the extension, of any case, behind which may be ".gz". geo: Gmsh's language. cad: a body
// without names. mesh: of another program. outline (.stl) and obj: triangles whose outline is the
// body.
ModelFormat format_of(const std::filesystem::path& file);
inline constexpr std::string_view model_extensions =
    "*.geo, *.msh, *.step, *.stp, *.brep, *.iges, *.igs, *.unv, *.med, *.inp, *.vtk, *.bdf, *.mesh,"
    " *.stl, *.obj, each also as *.gz";

bool is_gzipped(const std::filesystem::path& file);
// The file's name without folder and extension: "part" of "a/part.msh.gz".
std::string model_name(const std::filesystem::path& file);

}  // namespace airybench
