#include "bench/external/new_external.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/external/declaration.hpp"
#include "bench/problems/problem_files.hpp"
#include "bench/records/json.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/shortened.hpp"
#include "support/temporary_folder.hpp"

namespace airybench {
namespace {

// In the style of peers/scipy/solve_problem.py; the equations are in docs/exporting-problems.md.
constexpr const char* program_text =
    R"py("""Contact forces of a condensed problem:  {0}.py INPUT OUTPUT  (docs/external-solvers.md)

    r = D F - G - gap      per contact point a normal row, then (with friction) a tangential one
    F_n <= 0, r_n <= 0, F_n r_n = 0;  |F_t| <= mu |F_n|, F_t r_t <= 0, r_t = 0 unless it slips

It takes problems in the plane, with one or two components per point; in space there are three.
F in N per mm of thickness, r, G and gap in mm, D in mm/N. Replace contact_forces() by your method.
"""
import json
import sys
from pathlib import Path
from time import perf_counter

import numpy as np


class NotConverged(Exception):
    pass


class Refused(Exception):
    pass


def contact_forces(D, b, mu):
    """F with r = D F + b, and the number of steps: Newton's method on F = P(F - r / diag D)."""
    components, F = len(b) // max(len(mu), 1), np.zeros(len(b))
    if components > 2:
        raise Refused(f"{{components}} components per contact point (allowed: 1 or 2, in the plane)")
    for step in range(1, 51):
        trial = F - (D @ F + b) / np.diag(D)
        A, right = D.copy(), -b  # r = 0, closed and sticking
        for point in range(len(mu)):
            i = components * point
            if trial[i] >= 0:  # open: F = 0
                rows = slice(i, i + components)
                A[rows], right[rows] = np.eye(len(b))[rows], 0
            elif components == 2 and abs(trial[i + 1]) >= -mu[point] * trial[i]:  # slip
                A[i + 1], right[i + 1] = np.eye(len(b))[i + 1], 0
                A[i + 1, i] = mu[point] * np.sign(trial[i + 1])
        before, F = F, np.linalg.solve(A, right)
        if np.linalg.norm(F - before) <= 1e-13 * np.linalg.norm(F):
            if ((D @ F + b)[::components] > 1e-9 * np.abs(b).max()).any():
                raise NotConverged("points are inside the wall")
            return F, step
    raise NotConverged("no convergence in 50 steps")


def main(folder, output):
    problem = np.load(Path(folder, "problem.npz"))
    D, G, gap, mu = (problem[name] for name in ("D", "G", "gap", "mu"))
    start = perf_counter()
    try:
        F, steps = contact_forces(D, -G - gap, mu)
        answer = {{"status": "ok", "contact_iterations": steps}}
        np.save(Path(output, "F_C.npy"), F.reshape(-1, 1))
    except (NotConverged, np.linalg.LinAlgError) as why:
        answer = {{"status": "not_converged", "message": str(why)}}
    except Refused as why:
        answer = {{"status": "breakdown", "message": str(why)}}
    answer["time_s"] = perf_counter() - start  # of the solve, without reading and writing
    Path(output, "answer.json").write_text(json.dumps(answer))


if __name__ == "__main__":
    main(*sys.argv[1:])
)py";

// The first python3 that has NumPy: Debian's may be hidden by another in PATH.
std::string python_with_numpy() {
  constexpr double limit_s = 60;
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const TemporaryFolder work;
    const ChildEnd end = run_program({.command = {python, "-c", "import numpy"},
                                      .folder = work.path(),
                                      .output = work.path() / "printed",
                                      .scratch = work.path()},
                                     {limit_s});
    if (end.exit_code == 0) return python;
  }
  throw FileError("new-external: no python3 has NumPy (Debian: python3-numpy)");
}

std::string declaration_text(const std::string& name, const std::string& python) {
  const auto line = [](const char* key, const Json& value) {
    return fmt::format("  {}: {}", json_text(key), json_text(value));
  };
  return fmt::format(
      "{{\n{},\n{},\n{},\n{},\n{},\n{},\n{}\n}}\n", line("name", name),
      line("summary", "Newton's method on the condensed contact law"), line("reads", "condensed"),
      line("format", "npz"), line("returns", "contact_forces"),
      line("command", {python, name + ".py", "{input}", "{output}"}),
      line("version", {python, "-c", "import numpy; print('NumPy', numpy.__version__)"}));
}

}  // namespace

std::vector<std::filesystem::path> write_new_external(const std::filesystem::path& stem) {
  const std::string name = stem.filename().string();
  if (name.empty() || !is_plain_program_name(name))
    throw UsageError(fmt::format("NAME: {} (allowed: letters, digits, '-', '_' and '.')",
                                 shortened(stem.string())));
  check_problem_format("npz");
  const auto with = [&](const char* ending) { return stem.parent_path() / (name + ending); };
  const std::vector<std::filesystem::path> files = {with(".py"), with(".json")};
  for (const std::filesystem::path& file : files)
    if (std::error_code error; std::filesystem::exists(symlink_status(file, error)))
      throw FileError(file.string() + ": is there already (allowed: a name that is free)");
  const std::string python = python_with_numpy();
  write_file_atomically(files[0], fmt::format(program_text, name));
  try {
    write_file_atomically(files[1], declaration_text(name, python));
  } catch (...) {
    std::error_code error;
    std::filesystem::remove(files[0], error);
    throw;
  }
  return files;
}

}  // namespace airybench
