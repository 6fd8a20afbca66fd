#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <mutex>
#include <sstream>
#include <streambuf>

#include "bench/measure/build_info.hpp"
#include "python/bindings.hpp"
#include "support/data_folder.hpp"
#include "support/errors.hpp"

namespace airybench::python {
namespace {

namespace fs = std::filesystem;

// The folder above the module that has the program's data: a build tree, /usr, or the module's own.
void find_data() {
  Dl_info module = {};
  if (dladdr(reinterpret_cast<const void*>(&find_data), &module) == 0) return;
  for (fs::path folder = fs::canonical(module.dli_fname).parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
    if (fs::is_directory(folder / "share" / "airybench" / "meshes"))
      return take_for_program_in(folder / "bin");
}

void end_solves(int) {
  Deadline::all_passed = true;
  PyErr_SetInterrupt();
}

struct sigaction former_action = {};

thread_local std::exception_ptr kept_exception;

}  // namespace

void keep_current_exception() {
  kept_exception = std::current_exception();
  try {
    throw;
  } catch (const std::exception& error) {  // of Python's, type and text are the first line
    const std::string text = error.what();
    throw std::runtime_error(text.substr(0, text.find('\n')));
  }
}

void rethrow_kept() {
  if (kept_exception) std::rethrow_exception(std::exchange(kept_exception, nullptr));
}

int checked_threads(int given) {
  if (given < 1 || given > max_threads)
    throw UsageError(fmt::format("threads: {} (allowed: 1 to {})", given, max_threads));
  return given;
}

// Python handles signals in its first thread only.
Interruptible::Interruptible() {
  struct sigaction action = {};
  if (getpid() != gettid() || (sigaction(SIGINT, nullptr, &action) == 0 &&
                               (action.sa_handler == SIG_IGN || action.sa_handler == end_solves)))
    return;
  action = {};
  action.sa_handler = end_solves;
  has_signal_ = sigaction(SIGINT, &action, &former_action) == 0;
}

Interruptible::~Interruptible() {
  if (!has_signal_) return;
  sigaction(SIGINT, &former_action, nullptr);
  Deadline::all_passed = false;
}

void Interruptible::check() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// Other threads write there, too (support/sign_of_life.hpp).
class NotesAsWarnings::Lines : public std::streambuf {
 public:
  std::string text() {
    const std::lock_guard lock(mutex_);
    return std::exchange(text_, "");
  }

 private:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    const std::lock_guard lock(mutex_);
    text_.append(bytes, static_cast<std::size_t>(count));
    return count;
  }
  int_type overflow(int_type byte) override {
    const char letter = traits_type::to_char_type(byte);
    xsputn(&letter, 1);
    return byte;
  }
  std::mutex mutex_;
  std::string text_;
};

NotesAsWarnings::NotesAsWarnings()
    : lines_(std::make_unique<Lines>()), former_(std::cerr.rdbuf(lines_.get())) {}
NotesAsWarnings::~NotesAsWarnings() { std::cerr.rdbuf(former_); }

void NotesAsWarnings::warn() {
  constexpr std::string_view prefix = "note: ";
  std::istringstream text(lines_->text());
  for (std::string line; std::getline(text, line);)
    if (line.starts_with(prefix) &&
        PyErr_WarnEx(PyExc_UserWarning, line.substr(prefix.size()).c_str(), 1) != 0)
      throw py::error_already_set();
}

py::array view(const std::vector<double>& numbers, py::handle owner) {
  return view_of(numbers.data(), {static_cast<py::ssize_t>(numbers.size())}, {sizeof(double)},
                 owner);
}

py::object view(const SparseRows& matrix, py::handle owner) {
  const auto part = [&](const auto* data, Eigen::Index count) {
    return view_of(data, {count}, {sizeof(*data)}, owner);
  };
  return py::module_::import("scipy.sparse")
      .attr("csr_matrix")(py::make_tuple(part(matrix.valuePtr(), matrix.nonZeros()),
                                         part(matrix.innerIndexPtr(), matrix.nonZeros()),
                                         part(matrix.outerIndexPtr(), matrix.rows() + 1)),
                          py::arg("shape") = py::make_tuple(matrix.rows(), matrix.cols()));
}

py::object view(const ProblemArray& array, py::handle owner) {
  return std::visit(
      [&](const auto& matrix) -> py::object {
        py::object seen = view(matrix, owner);
        // A vector has one axis, as everywhere in Python.
        const bool is_sparse = std::holds_alternative<SparseRows>(array.values);
        return array.is_vector() && !is_sparse ? seen.attr("reshape")(-1) : seen;
      },
      array.values);
}

namespace {

py::array_t<double> array_of(const py::handle& object, const char* name, int most_axes) {
  py::array array;
  try {
    array = py::module_::import("numpy").attr("asarray")(object, py::arg("dtype") = "float64");
  } catch (py::error_already_set& error) {
    throw InputError(
        fmt::format("{}: {} (allowed: numbers)", name, std::string(py::str(error.value()))));
  }
  if (object.is_none() || array.ndim() > most_axes)
    throw InputError(fmt::format("{}: {} (allowed: {})", name,
                                 object.is_none() ? "None" : fmt::format("{} axes", array.ndim()),
                                 most_axes == 1 ? "a vector" : "a matrix"));
  return array;
}

}  // namespace

Eigen::VectorXd numbers_of(const py::handle& object, const char* name) {
  const auto array = array_of(object, name, 1);
  return py::module_::import("numpy").attr("atleast_1d")(array).cast<Eigen::VectorXd>();
}

Eigen::MatrixXd matrix_of(const py::handle& object, const char* name) {
  const auto array = array_of(object, name, 2);
  if (array.ndim() != 2)
    throw InputError(fmt::format("{}: {} axes (allowed: a matrix)", name, array.ndim()));
  return array.cast<Eigen::MatrixXd>();
}

py::object from_json(const Json& json) {
  return py::module_::import("json").attr("loads")(json_text(json));
}

Json to_json(const py::handle& object) {
  // Of NumPy: scalars and arrays.
  const py::cpp_function plain([](const py::object& other) { return other.attr("tolist")(); });
  return parse_json(py::module_::import("json")
                        .attr("dumps")(object, py::arg("default") = plain)
                        .cast<std::string>());
}

}  // namespace airybench::python

PYBIND11_MODULE(_airybench, module) {
  using namespace airybench;
  namespace py = pybind11;
  module.attr("__version__") = build_info.version;
  const auto input_error =
      py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  input_error.attr("__doc__") =
      "Unusable input, in one line: file or argument, place, value, what is allowed.";
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      std::rethrow_exception(error);
    } catch (const std::invalid_argument& wrong) {
      PyErr_SetString(py::module_::import("airybench._airybench").attr("InputError").ptr(),
                      wrong.what());
    }
  });
  const auto no_answer =
      py::register_exception<Breakdown>(module, "Breakdown", PyExc_ArithmeticError);
  no_answer.attr("__doc__") = "A numerical dead end: a pivot or a result that is of no use.";
  const auto timeout =
      py::register_exception<TimeoutReached>(module, "Timeout", PyExc_TimeoutError);
  timeout.attr("__doc__") = "The time limit was reached.";
  python::find_data();
  python::bind_contact(module.def_submodule(
      "contact", "Contact problems u = W r + q with Coulomb's law, and their solvers."));
  python::bind_problem(module);
  python::bind_solution(module);
  python::bind_bench(module);
}
