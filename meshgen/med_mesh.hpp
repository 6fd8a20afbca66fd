// Salome's .med, an HDF5 file of MED 3 and 4, as MSH 2.2. The layout: med-fichier's manual, and
// meshio's reader.
#pragma once

#include <filesystem>
#include <string>

namespace airybench {

// Its one mesh. Groups of edges are physical curves, those of faces bodies. Throws InputError, what
// is wrong without the file's name.
std::string msh_of_med(const std::filesystem::path& file);

}  // namespace airybench
