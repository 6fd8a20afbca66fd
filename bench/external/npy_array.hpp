// A dense array of doubles as NumPy writes it: the binary form of an answer that is long.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

namespace airybench {

// NAME.npy in the folder: <f8, of that shape, row by row or column by column. Throws FileError.
Eigen::MatrixXd read_npy(const std::filesystem::path& folder, const std::string& name,
                         Eigen::Index rows, Eigen::Index columns);

}  // namespace airybench
