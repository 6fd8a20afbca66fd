// The files of a posed problem: what another solver needs to solve it.
//
//   matrix-market  NAME.mtx for every array (matrix_market.hpp)
//   npz            S.npz, C_F.npz, C_C.npz, and problem.npz with all dense arrays (numpy_files.hpp)
//   fclib          problem.hdf5, the condensed problem (fclib.hpp)
//
// and problem.json, which describes them: equations, signs, and of every array its file, shape,
// unit and meaning.
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
std::vector<std::string_view> problem_formats();  // those whose library this build has
// Throws UsageError: no such format, or one whose library this build is without.
void check_problem_format(const std::string& format);

struct ProblemFiles {
  Files files;
  std::vector<std::string> notes;  // a line each: what is not in them, and why
};
// Throws InputError: the problem has nothing that this format can hold.
ProblemFiles problem_files(const PosedScene& posed, const std::string& format);

// A contact problem from a file (fclib.hpp). Throws FileError; UsageError: this build is without
// HDF5.
contact::Problem read_contact_problem(const std::filesystem::path& file);

// What another solver is handed of a case, in a format that there is. No answer is in it.
Files airy_files(const DualSystem& system, const std::string& format);     // with gap and mu
Files contact_files(const contact::Problem& problem, const Problem* body,  // null: there is none
                    const std::string& format);
Files body_files(const Problem& problem, const std::string& format);

}  // namespace airybench
