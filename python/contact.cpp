// Contact problems u = W r + q in memory or from files, their solvers and their judge.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>

#include "bench/problems/problem_files.hpp"
#include "bench/problems/problem_parts.hpp"
#include "python/bindings.hpp"
#include "solvers/contact/compliance.hpp"
#include "solvers/contact/condensed.hpp"
#include "support/errors.hpp"
#include "support/seconds_since.hpp"
#include "verify/verifier.hpp"

namespace airybench::python {
namespace {

using contact::Problem;

[[noreturn]] void refuse(const std::string& place, const std::string& what,
                         const std::string& allowed) {
  throw UsageError(fmt::format("{}: {} (allowed: {})", place, what, allowed));
}

std::shared_ptr<Problem> problem_of(SparseRows W, Eigen::VectorXd q, const py::object& mu,
                                    std::optional<int> components) {
  const Eigen::Index rows = q.size();
  if (W.rows() != rows || W.cols() != rows)
    refuse("W", fmt::format("({}, {})", W.rows(), W.cols()), fmt::format("({0}, {0}) of q", rows));
  if (components && (*components < 1 || *components > 3))
    refuse("components", std::to_string(*components), "1, 2 or 3");
  Eigen::VectorXd friction = numbers_of(mu, "mu");
  const bool is_for_all = py::module_::import("numpy").attr("ndim")(mu).cast<int>() == 0;
  if (is_for_all)
    friction = Eigen::VectorXd::Constant(rows / components.value_or(2), double{friction(0)});
  const Eigen::Index count = friction.size();
  const auto dimension =
      components.value_or(static_cast<int>(rows / std::max<Eigen::Index>(1, count)));
  if (dimension < 1 || dimension > 3 || count * dimension != rows || count == 0)
    refuse("mu", fmt::format("{} numbers for {} rows of q", count, rows),
           "one per contact of 1, 2 or 3 rows (components); one for all: of 2");
  W.makeCompressed();
  return std::make_shared<Problem>(local_problem(
      std::move(W), std::move(q), points_of(dimension, friction, "mu", refuse), "W", refuse));
}

struct Result {
  ContactResult of_F;
  Eigen::VectorXd r, u;  // u = W r + q
  double time_s = 0;
};

std::shared_ptr<Result> solve(const Problem& problem, const std::string& solver, double tolerance,
                              int max_iterations, double timeout,
                              const std::optional<Eigen::VectorXd>& start) {
  if (!(tolerance > 0)) refuse("tolerance", fmt::format("{}", tolerance), "above 0");
  if (max_iterations < 1) refuse("max_iterations", std::to_string(max_iterations), "1 or more");
  const auto by = contact_solver_of(solver);
  if (!by)
    refuse("solver", "'" + solver + "'",
           fmt::format("{}", fmt::join(names_of(all_contact_solvers), ", ")));
  ContactOptions options = {.solver = *by,
                            .tolerance = tolerance,
                            .acceptable = tolerance,
                            .max_iterations = max_iterations,
                            .history = true};
  if (start) {
    if (start->size() != problem.points.size())
      refuse("start", fmt::format("{} numbers", start->size()),
             std::to_string(problem.points.size()));
    options.start = -*start;
  }
  auto result = std::make_shared<Result>();
  Interruptible interruptible;
  {
    const py::gil_scoped_release release;
    const auto begin = std::chrono::steady_clock::now();
    result->of_F = solve_contact(problem, options, Deadline::after(timeout));
    result->time_s = seconds_since(begin);
    result->r = -result->of_F.F_C;
    result->u = contact_offset(problem) - D_times(problem, result->of_F.F_C);
  }
  interruptible.check();
  return result;
}

// What verify() knows, as records name it.
py::object judged(const Problem& problem, const Eigen::VectorXd& r) {
  if (r.size() != problem.points.size())
    refuse("r", fmt::format("{} numbers", r.size()), std::to_string(problem.points.size()));
  if (!r.allFinite()) refuse("r", "not finite", "numbers");
  Record record;
  take_over(verify(problem, -r), record);
  const Json all = airybench::to_json(record);
  Json found;
#define FIELD(kind, name, unit, use, source, label, meaning) \
  if constexpr (std::is_same_v<Verification, source>) found[#name] = all.at(#name);
#include "bench/records/record_fields.def"
  return from_json(found);
}

}  // namespace

void bind_contact(py::module_ module) {
  py::class_<Problem, std::shared_ptr<Problem>>(
      module, "Problem",
      "u = W r + q, r_n >= 0, u_n >= 0, r_n u_n = 0; |r_t| <= mu r_n, sliding opposed to it.\n\n"
      "W: symmetric, positive diagonal, NumPy or scipy.sparse; q: a vector; mu: per contact, or\n"
      "one number for all, of contacts with 2 components unless told otherwise. Per contact a\n"
      "normal row, and tangential ones: 2 components in the plane, 3 in space. What W differs\n"
      "from its transpose by, up to 1 %, is kept. Raises InputError.")
      .def(py::init([](const py::object& W, const py::object& q, const py::object& mu,
                       std::optional<int> components) {
             const bool is_sparse = py::hasattr(W, "tocsr");
             return problem_of(
                 is_sparse ? W.cast<SparseRows>() : SparseRows(matrix_of(W, "W").sparseView(0, 0)),
                 numbers_of(q, "q"), mu, components);
           }),
           py::arg("W"), py::arg("q"), py::arg("mu") = 0., py::arg("components") = py::none())
      .def_property_readonly(
          "W",
          [](const py::object& self) -> py::object {
            const auto& problem = self.cast<const Problem&>();
            if (problem.bodies)
              throw UsageError("W: not formed for " + problem.name + " (allowed: solve, judge)");
            if (problem.is_dense()) return view(problem.D, self);
            return view(problem.rows, self);
          },
          "A view; of a body its compliance D, mm/N.")
      .def_property_readonly(
          "q", [](const Problem& self) { return contact_offset(self); },
          "Of a body G + gap, mm: displacements into the wall without contact forces, negative.")
      .def_property_readonly(
          "gap",
          [](const Problem& self) {
            return self.points.gap.size() > 0 ? self.points.gap
                                              : Eigen::VectorXd::Zero(self.points.size()).eval();
          },
          "The part of q that is the wall's, mm.")
      .def_property_readonly(
          "mu",
          [](const Problem& self) {
            Eigen::VectorXd mu(self.points.count);
            for (int p = 0; p < self.points.count; ++p) mu(p) = self.points.friction_at(p);
            return mu;
          },
          "Coefficient of friction per contact.")
      .def_property_readonly("components",
                             [](const Problem& self) { return self.points.components; })
      .def_property_readonly("name", [](const Problem& self) { return self.name; })
      .def("__len__", [](const Problem& self) { return self.points.count; })
      .def("__repr__", [](const Problem& self) {
        return fmt::format("<airybench.contact.Problem {}{} contacts, {} components>",
                           self.name.empty() ? "" : self.name + ": ", self.points.count,
                           self.points.components);
      });

  py::class_<Result, std::shared_ptr<Result>>(module, "Result", "Of contact.solve().")
      .def_property_readonly(
          "r", [](const py::object& self) { return view(self.cast<const Result&>().r, self); })
      .def_property_readonly(
          "u", [](const py::object& self) { return view(self.cast<const Result&>().u, self); },
          "W r + q.")
      .def_property_readonly("converged", [](const Result& self) { return self.of_F.converged; })
      .def_property_readonly(
          "iterations", [](const Result& self) { return self.of_F.iterations; }, "Sweeps.")
      .def_property_readonly("newton_steps",
                             [](const Result& self) { return self.of_F.active_set_steps; })
      .def_property_readonly(
          "residual", [](const Result& self) { return self.of_F.natural_map_residual; },
          "Of the natural map, relative to r.")
      .def_property_readonly(
          "history",
          [](const py::object& self) {
            return view(self.cast<const Result&>().of_F.history, self);
          },
          "Relative change per sweep.")
      .def_property_readonly("time_s", [](const Result& self) { return self.time_s; })
      .def("__repr__", [](const Result& self) {
        return fmt::format("<airybench.contact.Result: {}, residual {:.1e}, {} sweeps, {:.3g} s>",
                           self.of_F.converged ? "converged" : "not converged",
                           self.of_F.natural_map_residual, self.of_F.iterations, self.time_s);
      });

  module.def(
      "read",
      [](const std::filesystem::path& file) {
        return std::make_shared<Problem>(read_contact_problem(file));
      },
      py::arg("file"), py::call_guard<py::gil_scoped_release>(),
      "Reads a problem of FCLIB (.hdf5) or of Siconos (.dat).");
  module.def("solve", &solve, py::arg("problem"), py::arg("solver") = "newton", py::kw_only(),
             py::arg("tolerance") = 1e-12, py::arg("max_iterations") = 100000,
             py::arg("timeout") = 900., py::arg("start") = py::none(),
             "Solves it by 'newton', 'gauss-seidel', 'anderson' or 'admm' until the residual of\n"
             "the natural map is below the tolerance, or says that it has not converged. Raises\n"
             "Timeout, Breakdown; Ctrl-C ends it.");
  module.def("judge", &judged, py::arg("problem"), py::arg("r"),
             "What the verifier finds of forces r: natural_map_residual, siconos_error, n_open,\n"
             "n_stick, n_slip, …, as records name it (results/README.md).");
}

}  // namespace airybench::python
