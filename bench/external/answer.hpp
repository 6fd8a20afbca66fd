// Files that an external program writes into its output folder:
//
//   answer.json   { "status": "ok", "time_s": 0.12 }; optional: "message", "parameters",
//                 "stages": { "factor": 0.1, "contact": 0.02 }, "linear_iterations",
//                 "contact_iterations", "error_estimate"
//   x.mtx, F_C.mtx       reads airy: the unknowns x of the Airy system, contact forces in N
//   F_C.mtx or r.mtx     reads condensed: contact forces in N; format fclib: r = −F_C
//   displacement_mm.mtx  reads body: columns x, y; a row per vertex, then per edge (its middle)
//   edge_displacements_mm.mtx, F_C.mtx  reads body, returns edge_displacements: per edge the
//                        moments (edge_forces.hpp) x, y at its low vertex, x, y at its high one;
//                        contact forces in N in the rows of contact_points()
//   log.txt              optional; its first MiB is kept with the records
//
// Arrays are Matrix Market files, "matrix array real general": numbers one per line, column by
// column. NAME.npy (NumPy, doubles) takes precedence over NAME.mtx. time_s is the solve by the
// program's own clock, from data in memory to the answer in memory; stages are those of
// stage_times.hpp. status is ok, inaccurate, not_converged, breakdown or skipped (the program does
// not take the problem; message says why); only a failure is believed.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "solvers/base/stage_times.hpp"
#include "support/status.hpp"

namespace airybench {

struct Answer {
  Status status = Status::crashed;
  std::string message, parameters;
  double time_s = 0;
  std::map<Stage, double> stages;
  std::optional<std::int64_t> linear_iterations;
  std::optional<int> contact_iterations;
  std::optional<double> error_estimate;
};

// read_answer and read_array throw FileError: file name, place, value, what is allowed.
Answer read_answer(const std::filesystem::path& folder);
// Empty if there is no log.txt.
std::string read_log(const std::filesystem::path& folder);
// The matrix must have this shape; its numbers may be NaN or infinite.
Eigen::MatrixXd read_array(const std::filesystem::path& folder, const std::string& name,
                           Eigen::Index rows, Eigen::Index columns);

}  // namespace airybench
