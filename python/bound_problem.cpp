// Problems, their matrices, and meshes that are adapted to them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "bench/commands/command_line.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/external/answered.hpp"
#include "bench/plan/scene_file.hpp"
#include "bench/records/record.hpp"
#include "bench/run/adapted_scenes.hpp"
#include "python/bindings.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/methods.hpp"

namespace airybench::python {
namespace {

// Keys by name stand for those of the scene.
std::shared_ptr<BoundProblem> posed(const py::object& mesh, const py::object& scene,
                                    const py::kwargs& keys) {
  Options options;
  options.dry_run = true;                                             // writes nothing
  options.limits.others_s = std::numeric_limits<double>::infinity();  // the process is Python's
  options.run.meshes = py::str(mesh);
  static std::mutex posing;  // standard error is the process's
  std::unique_lock alone(posing, std::defer_lock);
  {
    const py::gil_scoped_release release;
    alone.lock();
  }
  NotesAsWarnings notes;
  std::vector<SceneFile> files;
  if (py::isinstance<py::dict>(scene)) {
    files = {scene_file_of(json_text(to_json(scene)), "scene")};
  } else {
    if (!scene.is_none()) options.run.scenes = {std::string(py::str(scene))};
    files = read_scenes(options.run);
  }
  if (keys.size() > 0) {
    Json json = parse_json(files.front().definition());
    json.update(to_json(keys));
    const std::string name = files.front().scene.name;
    files = {scene_file_of(json_text(json), "scene")};
    files.front().scene.name = name;
  }
  auto problem = std::make_shared<BoundProblem>();
  {
    const py::gil_scoped_release release;
    std::vector<PosedScene> all = posed_scenes(options, std::move(files));
    if (all.size() != 1)
      throw UsageError(
          fmt::format("mesh: {}: {} meshes (allowed: one)", options.run.meshes, all.size()));
    problem->posed = std::move(all.front());
  }
  notes.warn();
  return problem;
}

// The problem that HYBRID hands to a contact law: its pairs are joined, its free bodies released.
contact::Problem condensed(const BoundProblem& problem, int degree) {
  struct Condensed : std::exception {};
  const Method hybrid = select_methods("HYBRID", {}, degree).front();
  contact::Problem found;
  RunControl control;
  control.contact.by = [&](const contact::Problem& law) -> ContactResult {
    found = law;
    throw Condensed();
  };
  try {
    hybrid.solve(contact_system(problem.body(), degree), control);
  } catch (const Condensed&) {
    return found;
  }
  throw UsageError(problem.name() + ": no contact points (allowed: a scene with contact)");
}

// A Record by names, without what is not known.
py::object judged(const std::shared_ptr<BoundProblem>& problem, const BoundSolution& answer,
                  double target_error) {
  const Solution& last = answer.last().solution;
  if (answer.problem != problem)
    throw UsageError("judge: a solution of another problem (allowed: one of this problem)");
  if (has_answer(last.status) && std::ssize(answer.steps) != count_of_steps(*problem->body()))
    throw UsageError("judge: one load step (allowed: the solution of the whole path)");
  CaseSettings settings = answer.settings;
  settings.target_error = target_error;
  const Case asked{problem->posed, answer.method, settings};
  CaseResult result;
  Json record;
  {
    const py::gil_scoped_release release;
    const std::lock_guard lock(problem->judging);
    // Interrupted, it has no reference and would keep that.
    struct Forget {
      ~Forget() {
        if (Deadline::all_passed || std::uncaught_exceptions() > 0) of.judge.reset();
      }
      BoundProblem& of;
    } forget{*problem};
    if (!problem->judge || problem->judged_at != target_error) {
      problem->judge = std::make_unique<Judge>(problem->posed.problem, settings, LeftOut{});
      problem->judged_at = target_error;
    }
    for (const auto& [system, solution] : answer.steps)
      if (problem->judge->is_answered(solution))
        result.steps.push_back(problem->judge->judged(result.steps, system, solution));
    result.solution = last;
    result.verdict = problem->judge->judge(asked, result);
    record = airybench::to_json(to_record(asked, Limits{}, result));
  }
  return from_json(record);
}

// A loop of levels as Python iterates over it.
struct Levels {
  std::shared_ptr<BoundProblem> first;
  Method method;
  AdaptiveSettings settings;
  std::string definition;
  AdaptiveLoop loop;
};

struct BoundLevel {
  std::shared_ptr<BoundProblem> problem;
  AdaptiveLevel level;
  std::shared_ptr<BoundSolution> solution;
};

std::shared_ptr<Levels> adapted(const std::shared_ptr<BoundProblem>& problem,
                                std::optional<double> error, std::optional<int> unknowns,
                                const py::object& degree, std::optional<double> marking,
                                int threads, double timeout) {
  if (error.has_value() == unknowns.has_value() || (error && !(*error > 0 && *error < 1)))
    throw UsageError("adapt: error or unknowns (allowed: one of them, an error from 0 to 1)");
  if (marking && !(*marking > 0 && *marking <= 1))
    throw UsageError(fmt::format("adapt: marking: {} (allowed: above 0, up to 1)", *marking));
  RunSettings run;
  run.adapt.goals = {AdaptGoal{error, unknowns}};
  read_degree(py::str(degree), false, run);
  const Method method = adapting_method(run.adapt.by);
  const Mesh& mesh = problem->body()->mesh;
  SceneFile scene = scene_of_level_0(problem->posed);
  const AdaptiveSettings settings = {.goals = run.adapt.goals,
                                     .marking = marking,
                                     .timeout_s = timeout,
                                     .threads = checked_threads(threads),
                                     .keeps_answers = true};
  return std::make_shared<Levels>(Levels{problem, method, settings, scene.definition(),
                                         AdaptiveLoop(scene.scene, mesh, method, settings)});
}

std::shared_ptr<BoundLevel> next_level(Levels& levels) {
  auto found = std::make_shared<BoundLevel>();
  Interruptible interruptible;
  std::optional<AdaptiveLevel> level;
  {
    const Threads threads(levels.settings.threads);
    const py::gil_scoped_release release;
    level = levels.loop.next();
  }
  interruptible.check();
  if (!level) {
    if (!levels.loop.reached()) throw UsageError("adapt: " + levels.loop.why_ended());
    throw py::stop_iteration();
  }
  auto problem = std::make_shared<BoundProblem>();
  problem->posed = levels.first->posed;
  problem->posed.scene_definition = levels.definition;
  problem->posed.problem = std::make_shared<const Problem>(*level->answers.front().system.problem);
  problem->posed.adapted = AdaptedMesh{level->number, level->time_s, {}};
  CaseSettings settings;
  settings.threads = levels.settings.threads;
  found->solution = std::make_shared<BoundSolution>(
      BoundSolution{problem, levels.method, settings, std::move(level->answers)});
  found->problem = std::move(problem);
  found->level = std::move(*level);
  return found;
}

}  // namespace

const ProblemArray& Arrays::at(const std::string& name) const {
  const auto found = std::ranges::find(arrays, name, &ProblemArray::name);
  if (found == arrays.end())
    throw py::attribute_error(
        fmt::format("{}: no array {} (allowed: {})", title, name, fmt::join(names(), ", ")));
  return *found;
}

std::vector<std::string> Arrays::names() const {
  std::vector<std::string> all;
  for (const ProblemArray& array : arrays) all.push_back(array.name);
  return all;
}

std::string Arrays::text() const {
  std::string lines = title;
  for (const ProblemArray& array : arrays)
    lines += fmt::format("\n  {:<12} ({}, {}), {}: {}", array.name, array.rows(), array.columns(),
                         array.unit, array.about);
  return lines;
}

std::shared_ptr<Arrays> arrays_of(std::string title, std::vector<ProblemArray> arrays) {
  return std::make_shared<Arrays>(Arrays{std::move(title), std::move(arrays)});
}

std::shared_ptr<Arrays> body_arrays_of(const Problem& problem, std::string title) {
  std::vector<ProblemArray> arrays = mesh_arrays(problem.mesh);
  std::ranges::move(body_arrays(problem), std::back_inserter(arrays));
  return arrays_of(std::move(title), std::move(arrays));
}

void bind_problem(py::module_& module) {
  py::class_<Arrays, std::shared_ptr<Arrays>>(
      module, "Arrays", "The arrays of a system, as attributes: print() lists them with units.")
      .def("__getattr__",
           [](const py::object& self, const std::string& name) {
             return view(self.cast<const Arrays&>().at(name), self);
           })
      .def("__dir__", &Arrays::names)
      .def("__repr__", &Arrays::text);

  py::class_<BoundProblem, std::shared_ptr<BoundProblem>>(
      module, "Problem",
      "A body in contact: a mesh under a scene.\n\n"
      "mesh: a name of the catalogue ('Mesh0' … 'Mesh7'), a .msh file, or any model that bench\n"
      "takes. scene: a dict or a JSON file; None: the deck's own, or the default. Keys by name\n"
      "replace those of the scene (docs/scenes.md). Lengths mm, forces N per mm of\n"
      "thickness, stresses MPa. Raises InputError; notes are warnings.")
      .def(py::init(&posed), py::arg("mesh"), py::pos_only(), py::arg("scene") = py::none())
      .def_property_readonly("name", &BoundProblem::name)
      .def_property_readonly(
          "scene",
          [](const BoundProblem& self) {
            return from_json(parse_json(self.posed.scene_definition));
          },
          "The scene, a dict.")
      .def_property_readonly(
          "n_phi", [](const BoundProblem& self) { return mesh_sizes(self.body()->mesh).n_phi; },
          "Degrees of freedom of the Airy function.")
      .def_property_readonly(
          "mesh",
          [](const BoundProblem& self) {
            return arrays_of(self.name() + ": mesh", mesh_arrays(self.body()->mesh));
          },
          "vertices_mm, triangles, edges, boundary, boundary_roles; indices from 0.")
      .def(
          "body",
          [](const BoundProblem& self) {
            if (!self.body()->loads.thermal.empty())
              throw UsageError(self.name() + ": thermal strain, which these arrays have not");
            return body_arrays_of(*self.body(), self.name() + ": body");
          },
          "All that a displacement method needs: the mesh, compliance_per_MPa, u0_mm, …")
      .def(
          "airy_system",
          [](const BoundProblem& self) {
            return arrays_of(self.name() + ": Airy system", airy_arrays(airy_system(self.body())));
          },
          py::call_guard<py::gil_scoped_release>(),
          "S x + C_F' l + C_C' l' = q, C_F x = F, F_C = C_C x + F0: S, C_F, C_C are\n"
          "scipy.sparse, S whole and scaled to the diagonal 1.")
      .def(
          "hybrid_system",
          [](const BoundProblem& self, int degree) {
            return arrays_of(fmt::format("{}: hybridized system of degree {}", self.name(), degree),
                             hybrid_arrays(*self.body(), degree));
          },
          py::arg("degree") = 1, py::call_guard<py::gil_scoped_release>(),
          "K u = b + F_C: stiffness K of the edge displacements, N/mm, their numbers, loads b.")
      .def(
          "condensed",
          [](const BoundProblem& self, int degree) {
            const py::gil_scoped_release release;
            return std::make_shared<contact::Problem>(condensed(self, degree));
          },
          py::arg("degree") = 1,
          "The contact problem u = W r + q of its contact points (contact.Problem); of pairs of\n"
          "bodies one row for both.")
      .def(
          "solve",
          [](std::shared_ptr<BoundProblem> self, const py::object& method,
             std::optional<int> degree, double timeout, const py::kwargs& settings) {
            return solved(std::move(self), method_of(method, degree), settings_of(settings),
                          timeout);
          },
          py::arg("method") = "HYBRID", py::kw_only(), py::arg("degree") = py::none(),
          py::arg("timeout") = 900.,
          "Solves it by a method: a name of ab.methods() or what @ab.method made. degree: of\n"
          "HYBRID's stresses. timeout: seconds. Further settings by name: target_error (1e-6),\n"
          "tolerance, max_iterations, contact ('newton', 'gauss-seidel', 'anderson', 'admm'),\n"
          "contact_tolerance, threads, stop ('target', 'paper'). Returns a Solution, whose status\n"
          "says how it ended; iterative methods are tightened until their own error estimate is\n"
          "below target_error. Ctrl-C ends it; a function of yours is not stopped by timeout here, "
          "but\n"
          "in bench().")
      .def(
          "judge",
          [](const std::shared_ptr<BoundProblem>& self,
             const std::shared_ptr<BoundSolution>& solution,
             const std::optional<Eigen::VectorXd>& forces, int degree, double target_error) {
            if ((solution == nullptr) == !forces)
              throw UsageError("judge: solution or forces (allowed: one of them)");
            Interruptible interruptible;
            py::object record;
            if (solution != nullptr) {
              record = judged(self, *solution, target_error);
            } else {
              const ContactLaw law = [&](const contact::Problem& problem) {
                if (forces->size() != problem.points.size())
                  throw UsageError(fmt::format("judge: forces: {} numbers (allowed: {})",
                                               forces->size(), problem.points.size()));
                return Eigen::VectorXd(-*forces);
              };
              const Method given = contact_law_method(kept(law), "GIVEN", "", degree);
              record = judged(self, solved(self, given, {}, 900), target_error);
            }
            interruptible.check();
            return record;
          },
          py::arg("solution") = py::none(), py::kw_only(), py::arg("forces") = py::none(),
          py::arg("degree") = 1, py::arg("target_error") = 1e-6,
          "What the verifier finds of a Solution, or of contact forces r (as condensed() has "
          "them,\n"
          "N, for stresses of that degree): a dict of the fields of a record (results/README.md),\n"
          "status and status_reason first of all, error_stress, error_force, error_total, …; of a\n"
          "path `steps`, a dict per load step with its n_open, n_stick, n_slip, resultants,\n"
          "dissipation_Nmm and errors.")
      .def("adapt", &adapted, py::kw_only(), py::arg("error") = py::none(),
           py::arg("unknowns") = py::none(), py::arg("degree") = "auto",
           py::arg("marking") = py::none(), py::arg("threads") = 1, py::arg("timeout") = 900.,
           "Solves on finer and finer meshes until the total error is below `error` (0.001: 0.1 "
           "%),\n"
           "or n_phi is above `unknowns`. Iterates over Levels. marking: share of the squared "
           "error\n"
           "that is bisected (1: uniform refinement); None: as the loop expects to need.")
      .def("__repr__", [](const BoundProblem& self) {
        return fmt::format("<airybench.Problem {}, n_phi {}>", self.name(),
                           mesh_sizes(self.body()->mesh).n_phi);
      });

  py::class_<Levels, std::shared_ptr<Levels>>(module, "Levels", "Levels of Problem.adapt().")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &next_level);
  py::class_<BoundLevel, std::shared_ptr<BoundLevel>>(
      module, "Level", "A mesh of Problem.adapt(), with its solution and its error.")
      .def_property_readonly("problem", [](const BoundLevel& self) { return self.problem; })
      .def_property_readonly("solution", [](const BoundLevel& self) { return self.solution; })
      .def_property_readonly("number", [](const BoundLevel& self) { return self.level.number; })
      .def_property_readonly(
          "unknowns", [](const BoundLevel& self) { return self.level.unknowns; }, "n_phi.")
      .def_property_readonly(
          "error", [](const BoundLevel& self) { return self.level.error; },
          "Total error, relative; None: nothing can be said of it.")
      .def_property_readonly(
          "squared_errors",
          [](const py::object& self) {
            return view(self.cast<const BoundLevel&>().level.parts, self);
          },
          "Per triangle its part of the squared error, which decides where is refined, N mm.")
      .def_property_readonly(
          "time_s", [](const BoundLevel& self) { return self.level.time_s; },
          "Of all levels so far.")
      .def("__repr__", [](const BoundLevel& self) {
        return fmt::format("<airybench.Level {}: n_phi {}, total error {:.3g} %>",
                           self.level.number, self.level.unknowns,
                           100 * self.level.error.value_or(std::nan("")));
      });
}

}  // namespace airybench::python
