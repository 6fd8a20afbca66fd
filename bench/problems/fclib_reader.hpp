// Contact problems in FCLIB's format (fclib_file.hpp) from whatever program: /fclib_local with
// spacedim 2. W may be stored in compressed rows (nz = −2) or columns (−1) or as triplets. It is
// symmetric but for rounding, which is left in it. Read with libhdf5 alone: FCLIB's own library
// ends the process over a bad file.
#pragma once

#include <filesystem>
#include <memory>

#include "assembly/problem.hpp"

namespace airybench {

// D = W, b = q, F = −r. Throws FileError, one line: file, dataset, value, what is allowed; also
// where W has a diagonal entry ≤ 0 or is not symmetric, and where there are equality constraints.
std::shared_ptr<const GivenContact> read_fclib(const std::filesystem::path& file);

}  // namespace airybench
