// What the files of the module share. Each of them binds one part: problems and their matrices
// (problem.cpp), solutions (solution.cpp), contact problems (contact.cpp), methods and runs
// (bench.cpp); module.cpp joins them.
//
// Arrays are views of memory that C++ holds; each keeps its owner alive, and is not writable.
#pragma once

#include <omp.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure/environment.hpp"
#include "bench/measure/judge.hpp"
#include "bench/problems/problem_arrays.hpp"
#include "bench/run/adaptive_loop.hpp"
#include "solvers/base/blas_library.hpp"

namespace airybench::python {

namespace py = pybind11;

template <typename Scalar>
py::array view_of(const Scalar* data, std::vector<py::ssize_t> shape,
                  std::vector<py::ssize_t> strides, py::handle owner) {
  py::array array(py::dtype::of<Scalar>(), std::move(shape), std::move(strides), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}
template <typename Derived>
py::array view(const Eigen::PlainObjectBase<Derived>& matrix, py::handle owner) {
  constexpr py::ssize_t size = sizeof(typename Derived::Scalar);
  std::vector<py::ssize_t> shape = {matrix.rows()}, strides = {size * matrix.rowStride()};
  if constexpr (Derived::ColsAtCompileTime != 1) {
    shape.push_back(matrix.cols());
    strides.push_back(size * matrix.colStride());
  }
  return view_of(matrix.data(), std::move(shape), std::move(strides), owner);
}
py::array view(const std::vector<double>& numbers, py::handle owner);
py::object view(const SparseRows& matrix, py::handle owner);  // a scipy.sparse.csr_matrix
py::object view(const ProblemArray& array, py::handle owner);

// Of anything that NumPy makes an array of. Throw InputError: what it is called, its shape.
Eigen::VectorXd numbers_of(const py::handle& object, const char* name);
Eigen::MatrixXd matrix_of(const py::handle& object, const char* name);

py::object from_json(const Json& json);
Json to_json(const py::handle& object);

// The arrays of one system, which Python reads as attributes.
struct Arrays {
  std::string title;
  std::vector<ProblemArray> arrays;

  const ProblemArray& at(const std::string& name) const;  // AttributeError: lists the names
  std::vector<std::string> names() const;
  // "K  (120, 120), N/mm: stiffness …"
  std::string text() const;
};
std::shared_ptr<Arrays> arrays_of(std::string title, std::vector<ProblemArray> arrays);
std::shared_ptr<Arrays> body_arrays_of(const Problem& problem, std::string title);

// A mesh under a scene. Its judge keeps references from call to call.
struct BoundProblem {
  PosedScene posed;
  std::mutex judging = {};
  std::unique_ptr<Judge> judge = {};
  double judged_at = 0;  // target error

  const std::shared_ptr<const Problem>& body() const { return posed.body(); }
  std::string name() const { return body()->mesh.name + "/" + posed.scene_name; }
};

struct BoundSolution {
  std::shared_ptr<BoundProblem> problem;
  Method method;
  CaseSettings settings;
  std::vector<StepAnswer> steps = {};  // at least one; the last has the path's sums
  double time_s = 0;

  const StepAnswer& last() const { return steps.back(); }
};

// While it lives Ctrl-C ends solves at their next check; check() then throws what Python expects.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  void check();

 private:
  bool has_signal_ = false;
};

// Throws UsageError.
int checked_threads(int given);
// Threads of a solve while it lives, those of NumPy's BLAS, too.
class Threads {
 public:
  explicit Threads(int threads) { set_threads(threads); }
  ~Threads() {
    set_blas_threads(blas_);
    omp_set_max_active_levels(levels_);
    omp_set_num_threads(openmp_);
  }
  Threads(const Threads&) = delete;

 private:
  int blas_ = blas_threads(), levels_ = omp_get_max_active_levels(),
      openmp_ = omp_get_max_threads();
};

// What C++ writes to standard error as notes while it lives becomes Python's warnings.
class NotesAsWarnings {
 public:
  NotesAsWarnings();
  ~NotesAsWarnings();
  NotesAsWarnings(const NotesAsWarnings&) = delete;
  void warn();  // may throw: warnings can be errors

 private:
  class Lines;
  std::unique_ptr<Lines> lines_;
  std::streambuf* former_;
};

// A name of bench list, "HYBRID:k=2", or a Method of Python's. Throws InputError.
Method method_of(const py::object& given, std::optional<int> degree);
// A solver takes an exception for its own failure: what a function of ours or of Python's throws is
// kept, and thrown again by rethrow_kept() in the same thread.
[[noreturn]] void keep_current_exception();
void rethrow_kept();
template <typename Function>
auto kept(Function function) {
  return [function = std::move(function)](const auto& problem) {
    try {
      return function(problem);
    } catch (const std::exception&) {
      keep_current_exception();
    }
  };
}

BoundSolution solved(std::shared_ptr<BoundProblem> problem, Method method, CaseSettings settings,
                     double timeout_s);
// settings of solve() by their names.
CaseSettings settings_of(const py::kwargs& given);

void bind_problem(py::module_& module);
void bind_solution(py::module_& module);
void bind_contact(py::module_ module);
void bind_bench(py::module_& module);

}  // namespace airybench::python
