// The files of a posed problem, for other solvers:
//
//   matrix-market  NAME.mtx for every array: coordinate (sparse) or array (dense, by columns), real
//                  or integer, lower triangle of a symmetric matrix
//   npz            S.npz, C_F.npz, C_C.npz, and problem.npz with all dense arrays (numpy_files.hpp)
//   fclib          problem.hdf5, the condensed problem (fclib.hpp)
//
// problem.json describes them: equations, signs; file, shape, unit and meaning of every array.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bench/plan/plan.hpp"
#include "bench/problems/problem_arrays.hpp"
#include "support/atomic_file.hpp"

namespace airybench {

inline constexpr std::array<std::string_view, 3> all_problem_formats = {"matrix-market", "npz",
                                                                        "fclib"};
std::vector<std::string_view> problem_formats();  // those in this build
// Throws UsageError: unknown format, or one that this build is without.
void check_problem_format(const std::string& format);

struct ProblemFiles {
  Files files;
  std::vector<std::string> notes;  // one line per omission, with the reason
};
// Throws InputError if the format can hold nothing of the problem.
ProblemFiles problem_files(const PosedScene& posed, const std::string& format);

// Reads a .dat file (siconos_text.hpp), or else an fclib file (fclib.hpp). Throws FileError;
// UsageError if the build is without HDF5.
contact::Problem read_contact_problem(const std::filesystem::path& file);

// Input for another solver, without an answer. format: of problem_formats().
Files airy_files(const AirySystem& system, const std::string& format);     // with gap and mu
Files contact_files(const contact::Problem& problem, const Problem* body,  // may be null
                    const std::string& format);
Files body_files(const Problem& problem, const std::string& format);

}  // namespace airybench
