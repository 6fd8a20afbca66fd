// Methods that Python writes, and runs of bench.
#include <fmt/format.h>
#include <pthread.h>

#include <atomic>

#include "bench/commands/command_line.hpp"
#include "bench/commands/planned_cases.hpp"
#include "bench/external/answered.hpp"
#include "bench/external/declaration.hpp"
#include "bench/measure/environment.hpp"
#include "bench/run/runner.hpp"
#include "python/bindings.hpp"
#include "solvers/base/blas_library.hpp"
#include "solvers/methods.hpp"
#include "support/data_folder.hpp"
#include "support/errors.hpp"
#include "support/this_process.hpp"

namespace airybench::python {
namespace {

// A callable of Python's, called by a thread that does not hold the interpreter's lock. References
// to it are counted under the lock.
class Callable {
 public:
  explicit Callable(py::function function)
      : function_(new py::function(std::move(function)), [](py::function* last) {
          const py::gil_scoped_acquire acquire;
          delete last;
        }) {}

  template <typename Argument>
  Eigen::VectorXd numbers(const Argument& argument, const char* name, Eigen::Index size) const {
    const py::gil_scoped_acquire acquire;
    Eigen::VectorXd answer = numbers_of((*function_)(argument), name);
    if (answer.size() != size)
      throw InputError(fmt::format("{}: {} numbers (allowed: {})", name, answer.size(), size));
    return answer;
  }
  template <typename Argument>
  Eigen::MatrixX2d pairs(const Argument& argument, const char* name, Eigen::Index rows) const {
    const py::gil_scoped_acquire acquire;
    const Eigen::MatrixXd answer = matrix_of((*function_)(argument), name);
    if (answer.rows() != rows || answer.cols() != 2)
      throw InputError(
          fmt::format("{}: ({}, {}) (allowed: ({}, 2): vertices, then middles of edges)", name,
                      answer.rows(), answer.cols(), rows));
    return answer;
  }

 private:
  std::shared_ptr<py::function> function_;
};

Method method_of_callable(const py::function& function, const std::string& name,
                          const std::string& reads, const std::string& elements, int degree,
                          const std::string& summary) {
  if (!is_plain_program_name(name))
    throw UsageError(
        fmt::format("method: name '{}' (allowed: letters, digits, '-', '_', '.')", name));
  if (std::ranges::count(methods(), name, &Method::name) > 0)
    throw UsageError(fmt::format("method: name '{}': one of bench's own has it", name));
  if (elements != "P2" && (elements != "other" || reads != "body"))
    throw UsageError(
        fmt::format("method: elements: '{}' (allowed: P2, and with reads='body' other)", elements));
  if (degree < 1 || degree > highest_degree || (degree > 1 && reads != "condensed"))
    throw UsageError(
        fmt::format("method: degree: {} (allowed: 1, and with reads='condensed' to {})", degree,
                    highest_degree));
  const Callable call(function);
  Method method;
  if (reads == "condensed") {
    method = contact_law_method(
        kept([call](const contact::Problem& problem) {
          // A copy: Python may keep it.
          return Eigen::VectorXd(-call.numbers(std::make_shared<contact::Problem>(problem), "r",
                                               problem.points.size()));
        }),
        name, summary, degree);
  } else if (reads == "airy") {
    method = airy_method(
        kept([call](const AirySystem& system) {
          return call.numbers(
              arrays_of(system.problem->mesh.name + ": Airy system", airy_arrays(system)), "x",
              system.n());
        }),
        name, summary);
  } else if (reads == "body") {
    method = displacement_method(
        kept([call](const Problem& problem) {
          return call.pairs(body_arrays_of(problem, problem.mesh.name + ": body"), "u",
                            displacement_nodes(problem));
        }),
        {.allowed_penetration = usual_penetration, .other_elements = elements == "other"}, name,
        summary);
  } else {
    throw UsageError(fmt::format("method: reads: '{}' (allowed: condensed, airy, body)", reads));
  }
  method.program = std::string("Python ") + PY_VERSION;
  return method;
}

// A process that bench forks has the thread and the interpreter of its parent, as from os.fork().
std::atomic<bool> is_running_bench = false;
void tell_python_of_forks() {
  pthread_atfork(
      [] {
        if (is_running_bench) PyOS_BeforeFork();
      },
      [] {
        if (is_running_bench) PyOS_AfterFork_Parent();
      },
      [] {
        if (is_running_bench) PyOS_AfterFork_Child();
      });
}

// The names of its records. Holds the lock: cases run in other processes.
std::vector<std::string> run_bench(const std::vector<std::string>& arguments,
                                   const std::vector<Method>& added) {
  std::vector<const char*> words = {"bench"};
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  const Options options = parse_options(static_cast<int>(words.size()), words.data());
  if (options.limits.memory_limit_bytes)
    throw UsageError("memory_limit: the heap is not counted in Python (allowed: bench itself)");
  if (options.dry_run)
    throw UsageError("dry_run: it would return no records (allowed: bench itself)");
  struct Running {
    Running() { is_running_bench = true; }
    ~Running() { is_running_bench = false; }
  } running;
  const CtrlCInterrupts interrupts;
  try {
    const PlannedCases planned = planned_cases(options, added);
    for (const std::string& missed : planned.short_of)
      if (PyErr_WarnEx(PyExc_UserWarning, missed.c_str(), 1) != 0) throw py::error_already_set();
    const Threads threads(options.run.cases.threads);
    Context context = context_of_run(options);
    context["cases_planned"] = std::to_string(planned.whole.size());
    context["plan_sha256"] = fingerprint(planned.whole);
    return run_cases(planned.part, options.limits, options.output, context).names;
  } catch (const Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
}

}  // namespace

Method method_of(const py::object& given, std::optional<int> degree) {
  std::vector<Method> found;
  if (py::isinstance<Method>(given))
    found = {given.cast<Method>()};
  else
    found = select_methods(py::str(given).cast<std::string>(), {}, degree.value_or(1));
  if (found.size() != 1)
    throw UsageError(fmt::format("method: '{}': {} methods (allowed: one)",
                                 py::str(given).cast<std::string>(), found.size()));
  if (degree && found.front().degree != *degree)
    throw UsageError(fmt::format("degree: {} (allowed: of HYBRID; {} has stresses of degree {})",
                                 *degree, found.front().name, found.front().degree));
  return std::move(found.front());
}

void bind_bench(py::module_& module) {
  tell_python_of_forks();
  py::class_<Method>(module, "Method", "A way to solve a problem; see methods() and method().")
      .def_readonly("name", &Method::name)
      .def_readonly("family", &Method::family)
      .def_readonly("summary", &Method::summary)
      .def_readonly("degree", &Method::degree, "Of its stresses.")
      .def_readonly("in_paper", &Method::in_paper)
      .def("__repr__", [](const Method& self) {
        return fmt::format("<airybench.Method {}: {}>", self.name, self.summary);
      });
  module.def("methods", &methods, "All named methods, as bench list prints them.");
  module.def("_method", &method_of_callable, py::arg("function"), py::arg("name"), py::arg("reads"),
             py::arg("elements"), py::arg("degree"), py::arg("summary"));
  module.def("_bench", &run_bench, py::arg("arguments"), py::arg("methods"));
  module.def("_better_blas_core", &better_blas_core);
  module.def("_data_folder", [](const std::string& name) { return data_folder(name).string(); });
}

}  // namespace airybench::python
