// Solving, and what a solution has.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>

#include "bench/measure/part_answer.hpp"
#include "bench/measure/point_locator.hpp"
#include "bench/plan/stages.hpp"
#include "bench/records/summary.hpp"
#include "python/bindings.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/seconds_since.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench::python {
namespace {

// With parameters chosen where the method asks for it, and tolerances tightened as by Workbench.
void solve(BoundSolution& answer, ContactSystem& system, const Deadline& deadline) {
  Solve method = answer.method.solve;
  CaseSettings& settings = answer.settings;
  settings.tightened = answer.method.is_tightened() && !settings.tolerance;
  if (settings.tightened) settings.tolerance = first_tolerance(answer.method, settings);
  RunControl control = control_of(settings, deadline);
  control.histories = true;
  if (answer.method.tune) {
    Solve tuned;
    const auto tune = [&](const ContactSystem& of, const RunControl& with) {
      tuned = answer.method.tune(of, with).solve;
      return Solution();
    };
    Solution untuned = run(tune, system, control);
    if (!tuned) {
      untuned.message = "while choosing parameters: " + untuned.message;
      answer.steps = {{system, std::move(untuned)}};
      return;
    }
    method = std::move(tuned);
  }
  const std::shared_ptr<const Problem> first = system.problem;  // of programs it has chords
  const auto count = static_cast<std::size_t>(count_of_steps(*answer.problem->body()));
  for (int attempt = 1;; ++attempt) {
    answer.steps.clear();
    double watched_s = 0;
    system.set_load_case(first);
    const auto start = std::chrono::steady_clock::now();
    Solution last = solve_path(
        method, system, control,
        [&](int, const ContactSystem& posed, const Solution& step) {
          if (answer.steps.size() + 1 < count) answer.steps.push_back({posed, step});
        },
        watched_s);
    answer.time_s = seconds_since(start) - watched_s;
    answer.steps.push_back({system, std::move(last)});
    const Solution& solution = answer.last().solution;
    if (!settings.tightened || solution.status != Status::inaccurate ||
        settings.stop == Stop::paper || attempt == max_tightenings ||
        control.tolerance <= tightest_tolerance)
      return;
    settings.tolerance = control.tolerance = next_tolerance(control.tolerance, solution, settings);
  }
}

const Solution& answered(const BoundSolution& self) {
  const Solution& solution = self.last().solution;
  if (solution.stress.empty())
    throw Breakdown(fmt::format("{}: no stresses: {}: {}", self.method.name,
                                name_of(solution.status), solution.message));
  return solution;
}

// With displacements recovered from those of edges, and their error, where the method has these.
template <typename Use>
auto with_fields(const BoundSolution& self, Use use) {
  answered(self);
  const auto& [system, solution] = self.last();
  SolvedFields fields = own_fields(system, solution);
  std::optional<ConstitutiveError> error;
  if (solution.as<EdgeDisplacements>() != nullptr) {
    fields.w = recovered_displacement(system, solution);
    error = constitutive_error(system, solution.stress, solution.F_C, *fields.w);
    if (error->flaw.empty()) fields.error = &*error;
  }
  return use(fields);
}

std::string faces_csv(const BoundSolution& self) {
  return with_fields(self, [](const SolvedFields& fields) {
    return part_files(fields, contact_picture(fields.system, fields.solution, fields.w)).faces_csv;
  });
}

Json part_answer(const BoundSolution& self) {
  return with_fields(self, [](const SolvedFields& fields) {
    return to_json(
        part_files(fields, contact_picture(fields.system, fields.solution, fields.w)).answer);
  });
}

// NAME.* in FOLDER/fields and a record, as a run writes them.
std::string write_files(const BoundSolution& self, const std::filesystem::path& folder) {
  const Case asked{self.problem->posed, self.method, self.settings};
  const std::string name = asked.name().file();
  std::filesystem::create_directories(folder / "fields");
  with_fields(self,
              [&](const SolvedFields& fields) { write_fields(folder / "fields", name, fields); });
  write_file_atomically(folder / "records.jsonl",
                        json_text(to_json(blank_record(asked, Limits{}))) + "\n");
  return name;
}

py::object stress_at_points(const BoundSolution& self, const py::array_t<double>& x,
                            const py::array_t<double>& y) {
  const Solution& solution = answered(self);
  const PointLocator locator(*self.last().system.problem, solution.stress.degree());
  // sxx, syy, sxy of every pair of coordinates, whatever their shape.
  const auto at = [&](int component) {
    return py::vectorize([&, component](double at_x, double at_y) {
      return stress_at(locator, solution.stress, {at_x, at_y})(component);
    })(x, y);
  };
  return py::make_tuple(at(0), at(1), at(2));
}

py::dict times_of(const Solution& solution) {
  py::dict times;
  for (const Stage stage : all_stages)
    if (const auto& seconds = solution.times[stage])
      times[py::str(std::string(name_of(stage)))] = *seconds;
  return times;
}

py::dict histories_of(const Solution& solution) {
  py::dict histories;
  for (const IterationHistory& history : solution.histories)
    histories[py::str(history.what)] = py::array(py::cast(history.residual));
  return histories;
}

template <typename T>
auto of_last(T Solution::*member) {
  return [member](const BoundSolution& self) { return self.last().solution.*member; };
}
auto view_of_last(Eigen::VectorXd Solution::*member) {
  return [member](const py::object& self) {
    return view(self.cast<const BoundSolution&>().last().solution.*member, self);
  };
}

}  // namespace

BoundSolution solved(std::shared_ptr<BoundProblem> problem, Method method, CaseSettings settings,
                     double timeout_s) {
  const std::string why = why_skipped(problem->posed.problem, method);
  if (!why.empty()) throw UsageError(fmt::format("{}/{}: {}", problem->name(), method.name, why));
  BoundSolution answer{std::move(problem), std::move(method), settings};
  Interruptible interruptible;
  const Threads threads(settings.threads);
  {
    const py::gil_scoped_release release;
    const auto system = assemble(answer.method, answer.problem->body());
    solve(answer, *system, Deadline::after(timeout_s));
  }
  interruptible.check();
  rethrow_kept();
  return answer;
}

CaseSettings settings_of(const py::kwargs& given) {
  CaseSettings settings;
  const auto word = [](const py::handle& value, const auto& of, const auto& all, const char* key) {
    const auto text = value.cast<std::string>();
    const auto found = of(text);
    if (!found)
      throw UsageError(
          fmt::format("{}: '{}' (allowed: {})", key, text, fmt::join(names_of(all), ", ")));
    return *found;
  };
  for (const auto& [name, value] : given) {
    const auto key = name.cast<std::string>();
    if (key == "target_error")
      settings.target_error = value.cast<double>();
    else if (key == "tolerance")
      settings.tolerance = value.cast<double>();
    else if (key == "max_iterations")
      settings.max_iterations = value.cast<int>();
    else if (key == "contact")
      settings.contact = word(value, contact_solver_of, all_contact_solvers, "contact");
    else if (key == "contact_tolerance")
      settings.contact_tolerance = value.cast<double>();
    else if (key == "threads")
      settings.threads = checked_threads(value.cast<int>());
    else if (key == "stop")
      settings.stop = word(value, stop_of, all_stops, "stop");
    else
      throw UsageError(
          fmt::format("{}: no such setting (allowed: target_error, tolerance, "
                      "max_iterations, contact, contact_tolerance, threads, stop)",
                      key));
  }
  return settings;
}

void bind_solution(py::module_& module) {
  py::class_<BoundSolution, std::shared_ptr<BoundSolution>>(
      module, "Solution",
      "What a method returned. Of a path of load steps: its last step; steps has all.")
      .def_property_readonly(
          "status",
          [](const BoundSolution& self) {
            return std::string(name_of(self.last().solution.status));
          },
          "'ok', 'inaccurate', 'not_converged', …: what the method claims; problem.judge() checks.")
      .def_property_readonly("message", of_last(&Solution::message))
      .def_property_readonly("method", [](const BoundSolution& self) { return self.method.name; })
      .def_property_readonly("problem", [](const BoundSolution& self) { return self.problem; })
      .def_property_readonly(
          "time_s", [](const BoundSolution& self) { return self.time_s; },
          "From assembled matrices to forces and stresses, seconds.")
      .def_property_readonly(
          "times_s", [](const BoundSolution& self) { return times_of(self.last().solution); },
          "Seconds by stage: order, precondition, factor, condense, contact, recover, check.")
      .def_property_readonly("error_estimate", of_last(&Solution::error_estimate),
                             "The method's own, relative; None: it has none.")
      .def_property_readonly(
          "history", [](const BoundSolution& self) { return histories_of(self.last().solution); },
          "Residuals per iteration, by what they are of. Krylov methods: of the first\n"
          "right-hand side, one number where that is zero.")
      .def_property_readonly("linear_iterations", of_last(&Solution::linear_iterations))
      .def_property_readonly("contact_iterations", of_last(&Solution::contact_iterations))
      .def_property_readonly("parameters", of_last(&Solution::parameters))
      .def_property_readonly("forces", view_of_last(&Solution::F_C),
                             "F_C, N: per contact point normal (<= 0), tangential; without\n"
                             "friction normal only. Of pairs of bodies at both points.")
      .def_property_readonly("contact_displacement", view_of_last(&Solution::contact_displacement),
                             "u_C, mm, in the rows of forces.")
      .def_property_readonly(
          "stresses",
          [](const py::object& self) {
            const auto& values = answered(self.cast<const BoundSolution&>()).stress.values();
            return view(values, self);
          },
          "(3, n) MPa: xx, yy, xy; Bernstein coefficients of each third of each triangle.")
      .def_property_readonly(
          "degree", [](const BoundSolution& self) { return answered(self).stress.degree(); },
          "Of the stresses' polynomials.")
      .def("stress", &stress_at_points, py::arg("x"), py::arg("y"),
           "sxx, syy, sxy at points, MPa: arrays of their shape, NaN outside the body.")
      .def("_faces_csv", &faces_csv, py::call_guard<py::gil_scoped_release>())
      .def(
          "answer",
          [](const BoundSolution& self) {
            Json answer;
            {
              const py::gil_scoped_release release;
              answer = part_answer(self);
            }
            return from_json(answer);
          },
          "What an engineer asks: forces and largest pressure by face, reactions, the largest\n"
          "stress and displacement with their places; as NAME.answer.json.")
      .def("_write", &write_files, py::arg("folder"), py::call_guard<py::gil_scoped_release>())
      .def_property_readonly(
          "steps",
          [](const BoundSolution& self) {
            std::vector<std::shared_ptr<BoundSolution>> steps;
            for (const StepAnswer& step : self.steps) {
              steps.push_back(std::make_shared<BoundSolution>(
                  BoundSolution{self.problem, self.method, self.settings, {step}, self.time_s}));
            }
            return steps;
          },
          "A Solution per load step.")
      .def("__repr__", [](const BoundSolution& self) {
        const Solution& solution = self.last().solution;
        return fmt::format("<airybench.Solution {}/{}: {}{}{}>", self.problem->name(),
                           self.method.name, name_of(solution.status),
                           solution.message.empty() ? "" : ": ", solution.message);
      });
}

}  // namespace airybench::python
