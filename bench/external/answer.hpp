// What another's program leaves in its output folder:
//
//   answer.json   { "status": "ok", "time_s": 0.12 } and, where they apply, "message",
//   "parameters",
//                 "stages": { "factor": 0.1, "contact": 0.02 }, "linear_iterations",
//                 "contact_iterations", "error_estimate"
//   x.mtx, F_C.mtx       reads airy: the unknowns x of the Airy system, the contact forces in N
//   F_C.mtx; or r.mtx    reads condensed: contact forces; of the format fclib r = −F_C there
//   displacement_mm.mtx  reads body: columns x and y; rows: the displacement at every vertex, then
//                        at the middle of every edge
//   edge_displacements_mm.mtx, F_C.mtx  the same, returning edge_displacements: per edge the
//                        moments (edge_forces.hpp) x, y at its low vertex, x, y at its high one;
//                        contact forces in the rows of contact_points(), in N
//   log.txt              if it is there, its first MiB is kept with the records
//
// Vectors are Matrix Market files, dense: "%%MatrixMarket matrix array real general", its comments,
// "rows columns", then one number per line, column by column. NAME.npy, NumPy's of doubles, goes
// before NAME.mtx. time_s is the solve by the program's own clock, from data in memory to the
// answer in memory; stages are those of stage_times.hpp.
//
// status: ok, inaccurate, not_converged, breakdown. It is the program's word; nothing of it is
// believed but that it failed.
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

// Both throw FileError: the file's name in the folder, place, value, what is allowed.
Answer read_answer(const std::filesystem::path& folder);
// The first MiB of log.txt; empty: there is none.
std::string read_log(const std::filesystem::path& folder);
// A dense matrix of that shape; its numbers may be anything that a double can be.
Eigen::MatrixXd read_array(const std::filesystem::path& folder, const std::string& name,
                           Eigen::Index rows, Eigen::Index columns);

}  // namespace airybench
