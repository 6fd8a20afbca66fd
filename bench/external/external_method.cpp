#include "bench/external/external_method.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "bench/external/answer.hpp"
#include "bench/external/answered.hpp"
#include "bench/problems/problem_files.hpp"
#include "solvers/base/dense_products.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/methods.hpp"
#include "support/errors.hpp"
#include "support/seconds_since.hpp"
#include "support/temporary_folder.hpp"
#include "verify/verifier.hpp"

namespace airybench {
namespace {

// run: the status is the program's word, in an answer.json that can be read.
struct NoAnswer : std::runtime_error {
  NoAnswer(Status what, const std::string& message, std::optional<ProgramRun> of_word = {})
      : std::runtime_error(message), status(what), run(std::move(of_word)) {}
  Status status;
  std::optional<ProgramRun> run;
};

struct Caller {
  Declaration declaration;
  std::optional<std::int64_t> memory_limit_bytes;
};

// One pass from left to right: a placeholder inside an inserted value stays.
std::string filled_in(std::string_view word, const std::map<std::string, std::string>& values) {
  std::string result;
  while (!word.empty()) {
    const auto here = std::ranges::find_if(
        values, [&](const auto& value) { return word.starts_with(value.first); });
    result += here == values.end() ? std::string(1, word.front()) : here->second;
    word.remove_prefix(here == values.end() ? 1 : here->first.size());
  }
  return result;
}

void write_folder(const std::filesystem::path& folder, const Files& files) {
  std::filesystem::create_directory(folder);
  for (const auto& [name, bytes] : files) {
    std::ofstream out(folder / name, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush())
      throw FileError(fmt::format("{}: cannot be written: {}", (folder / name).string(),
                                  std::generic_category().message(errno)));
  }
}

class ProgramSolve {
 public:
  ProgramSolve(const Caller& caller, const std::function<Files()>& problem,
               const RunControl& control) {
    const Declaration& declaration = caller.declaration;
    if (!declaration.parameter.empty())
      chosen_ = declaration.parameter + "=" + declaration.values.front();
    hand_over(problem());
    const double limit_s = control.deadline.remaining_s();
    if (!(limit_s > 0)) throw TimeoutReached("time limit reached before the program began");
    const std::string threads = std::to_string(control.threads);
    const std::map<std::string, std::string> values = {
        {placeholder::input, (work_->path() / "input").string()},
        {placeholder::output, output_.string()},
        {placeholder::threads, threads},
        {placeholder::tolerance, fmt::format("{}", control.tolerance)},
        {placeholder::time_limit_s, fmt::format("{:.3f}", std::min(limit_s, 1e9))}};
    Program program = {.folder = declaration.folder,
                       .environment = {{"OMP_NUM_THREADS", threads},
                                       {"OPENBLAS_NUM_THREADS", threads},
                                       {"MKL_NUM_THREADS", threads},
                                       {"LC_ALL", "C.UTF-8"},
                                       {"PYTHONDONTWRITEBYTECODE", "1"}},
                       .output = work_->path() / "printed",
                       .scratch = work_->path()};
    for (const std::string& word : declaration.command)
      program.command.push_back(filled_in(word, values));
    const ChildEnd end = run_program(program, {limit_s, caller.memory_limit_bytes});
    run_.wall_s = end.wall_s;
    run_.processor_s = end.processor_s;
    run_.peak_bytes = end.peak_bytes;
    if (end.exit_code != 0)
      throw NoAnswer(
          status_of_end(end),
          declaration.name + " " + how_it_ended(end, limit_s, printed_lines(program.output)));
    run_.log = read_log(output_);
    answer_ = read_answer(output_);
    const bool has_time = answer_.time_s > 0 && answer_.time_s <= end.wall_s;
    if (!has_answer(answer_.status) && !(gave_up() && has_time)) fail_as_it_says();
    if (!has_time)
      throw FileError(
          fmt::format("answer.json: time_s: {} (allowed: above 0, up to the {:.3g} s "
                      "that the program ran)",
                      answer_.time_s, end.wall_s));
  }

  // Where iterations end without convergence, as far as they came; it may have left nothing.
  Eigen::MatrixXd array(const std::string& name, Eigen::Index rows, Eigen::Index columns) const {
    try {
      return read_array(output_, name, rows, columns);
    } catch (const FileError&) {
      if (gave_up()) fail_as_it_says();
      throw;
    }
  }
  Eigen::VectorXd contact_forces(Eigen::Index rows) const {
    return rows > 0 ? Eigen::VectorXd(array("F_C.mtx", rows, 1)) : Eigen::VectorXd();
  }
  const Answer& answer() const { return answer_; }

  void end_handing_over() {
    work_.reset();
    run_.solve_s = answer_.time_s;
    run_.not_solve_s = seconds_since(start_) - answer_.time_s;
  }
  Solution take_over(const RunControl& control, Eigen::VectorXd F_C = {}) {
    end_handing_over();
    Solution solution;
    solution.F_C = std::move(F_C);
    note(control, solution);
    for (const auto& [stage, seconds] : answer_.stages) solution.times[stage] = seconds;
    return solution;
  }

  void note(const RunControl& control, Solution& solution) const {
    solution.status = answer_.status;
    solution.message = answer_.status == Status::ok ? "" : answer_.message;
    if (!has_answer(answer_.status) && solution.message.empty()) solution.message = "no message";
    solution.parameters = chosen_;
    if (!chosen_.empty() && !answer_.parameters.empty()) solution.parameters += "; ";
    solution.parameters += answer_.parameters;
    solution.error_estimate.reset();
    if (answer_.error_estimate) judge_by_own_estimate(*answer_.error_estimate, control, solution);
    solution.linear_iterations = answer_.linear_iterations;
    solution.contact_iterations = answer_.contact_iterations;
    solution.program = run_;
  }

 private:
  void hand_over(const Files& problem) {
    try {
      work_.emplace();
      output_ = work_->path() / "output";
      write_folder(output_, {});
      write_folder(work_->path() / "input", problem);
    } catch (const FileError& why) {
      throw NoAnswer(Status::machine_fault, why.what());
    }
  }
  [[noreturn]] void fail_as_it_says() const {
    throw NoAnswer(answer_.status, answer_.message.empty() ? "no message" : answer_.message, run_);
  }
  bool gave_up() const { return answer_.status == Status::not_converged; }
  static Status status_of_end(const ChildEnd& end) {
    return end.start_error != 0 ? Status::machine_fault
           : end.timed_out      ? Status::timeout
           : end.over_memory    ? Status::out_of_memory
           : !end.oom_killed    ? Status::crashed
           : *end.oom_killed    ? Status::out_of_memory
                                : Status::machine_fault;  // killed by somebody
  }

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<TemporaryFolder> work_;
  std::filesystem::path output_;
  Answer answer_;
  ProgramRun run_;
  std::string chosen_;  // "penalty=500"
};

Solution solve_airy(const Caller& caller, const AirySystem& system, const RunControl& control) {
  ProgramSolve program(
      caller, [&] { return airy_files(system, caller.declaration.format); }, control);
  Eigen::VectorXd x = program.array("x.mtx", system.n(), 1);
  Solution solution = program.take_over(control, program.contact_forces(system.n_c()));
  take_airy_unknowns(system, x, solution);
  return solution;
}

Solution solve_body(const Caller& caller, const ContactSystem& system, const RunControl& control) {
  const Problem& problem = *system.problem;
  ProgramSolve program(
      caller, [&] { return body_files(problem, caller.declaration.format); }, control);
  const Eigen::MatrixXd values =
      program.array("displacement_mm.mtx", displacement_nodes(problem), 2);
  Solution solution = program.take_over(control);
  take_displacement(problem, values, caller.declaration.tolerances, solution);
  return solution;
}

Solution solve_hybridized_body(const Caller& caller, const ContactSystem& system,
                               const RunControl& control) {
  const Problem& problem = *system.problem;
  ProgramSolve program(
      caller, [&] { return body_files(problem, caller.declaration.format); }, control);
  Eigen::Matrix4Xd moments =
      program.array("edge_displacements_mm.mtx", problem.edges.count(), 4).transpose();
  Solution solution = program.take_over(control, program.contact_forces(system.contact.size()));
  const StageTimer timer(solution.times, Stage::recover);
  for (int edge = 0; edge < problem.edges.count(); ++edge) {
    const auto& [low, high] = problem.edges.vertices[edge];
    moments.col(edge) -=
        problem.motion.moments(problem.mesh.vertices[low], problem.mesh.vertices[high]);
  }
  MomentsCheck own = check_moments(system, moments);
  solution.stress = std::move(own.stress);
  solution.contact_displacement = std::move(own.contact_displacement);
  solution.unknowns = EdgeDisplacements{std::move(moments)};
  return solution;
}

Eigen::VectorXd forces_of(const ProgramSolve& program, const ContactPoints& contact,
                          const std::string& format) {
  if (format != "fclib") return program.contact_forces(contact.size());
  const Eigen::VectorXd F =
      -program.array("r.mtx", std::max(2, contact.components) * contact.count, 1);
  if (contact.components > 1) return F;
  return F(Eigen::seqN(0, contact.count, 2));
}

// As with the default scene of the catalogue's meshes.
bool is_without_G(const contact::Problem& problem, const Eigen::VectorXd& F) {
  constexpr double rounding = 1e-9;
  return F.size() == problem.D.cols() && problem.G.norm() <= rounding * times(problem.D, F).norm();
}

// Throws NoAnswer where the program does not take the problem.
void check_components(const Declaration& declaration, int components) {
  const std::vector<int>& taken = declaration.components;
  const int handed_over = declaration.format == "fclib" ? std::max(2, components) : components;
  if (taken.empty() || std::ranges::count(taken, handed_over) > 0) return;
  throw NoAnswer(Status::skipped,
                 fmt::format("{} components per contact (allowed by the program: {})", handed_over,
                             fmt::join(taken, ", ")));
}

template <typename AnySolve>
auto with_no_answer(AnySolve solve) {
  return [solve = std::move(solve)](const auto& problem, const RunControl& control) {
    const auto failed = [](Status status, const std::string& message,
                           const std::optional<ProgramRun>& run = {}) {
      Solution solution;
      solution.status = status;
      solution.message = message;
      solution.program = run;
      return solution;
    };
    try {
      return solve(problem, control);
    } catch (const NoAnswer& why) {
      return failed(why.status, why.what(), why.run);
    } catch (const FileError& why) {
      return failed(Status::breakdown, fmt::format("its answer: {}", why.what()));
    } catch (const std::system_error& why) {  // no process could be started
      return failed(Status::machine_fault, why.what());
    }
  };
}

// solve: the method whose contact law the program replaces. body: may be null.
Solution solve_contact_law(const Caller& caller,
                           const std::function<Solution(const RunControl&)>& solve,
                           const Problem* body, const RunControl& given) {
  std::optional<ProgramSolve> program;
  bool no_G = false;
  RunControl control = given;
  control.contact.by = [&](const contact::Problem& problem) {
    const std::string& format = caller.declaration.format;
    check_components(caller.declaration, problem.points.components);
    if (problem.bodies)
      throw NoAnswer(Status::breakdown, "the program takes W, which is too large to be formed");
    program.emplace(
        caller, [&] { return contact_files(problem, body, format); }, given);
    ContactResult result;
    result.F_C = forces_of(*program, problem.points, format);
    result.converged = has_answer(program->answer().status);  // as the program claims
    result.iterations = program->answer().contact_iterations.value_or(0);
    no_G = body != nullptr && result.converged && is_without_G(problem, result.F_C);
    program->end_handing_over();
    return result;
  };
  Solution solution = solve(control);
  if (!program) return solution;
  const std::optional<std::int64_t> linear = solution.linear_iterations;
  if (has_answer(solution.status) || !has_answer(program->answer().status))
    program->note(given, solution);
  if (no_G && solution.status == Status::ok)
    solution.message =
        "G is zero but for rounding: a wrong sign of it would pass here, and fail bench check";
  solution.linear_iterations = linear;
  if (auto& contact_s = solution.times[Stage::contact]; contact_s && solution.program)
    *contact_s -= solution.program->not_solve_s;
  if (solution.solve_again)  // the next load step
    solution.solve_again = with_no_answer([caller, again = std::move(solution.solve_again)](
                                              const ContactSystem& s, const RunControl& c) {
      return solve_contact_law(
          caller, [&](const RunControl& own) { return again(s, own); }, s.problem.get(), c);
    });
  return solution;
}

}  // namespace

Method external_method(const Declaration& declaration,
                       std::optional<std::int64_t> memory_limit_bytes) {
  const Caller caller = {declaration, memory_limit_bytes};
  Method method;
  std::function<Solution(const Caller&, const ContactSystem&, const RunControl&)> solve;
  switch (declaration.returns) {
    case Declaration::Returns::airy_function:
      solve = [](const Caller& by, const ContactSystem& s, const RunControl& c) {
        return solve_airy(by, dynamic_cast<const AirySystem&>(s), c);
      };
      break;
    case Declaration::Returns::displacement:
      method.unknowns = Unknowns::displacements;
      solve = solve_body;
      break;
    case Declaration::Returns::edge_displacements:
      method.unknowns = Unknowns::edge_displacements;
      solve = solve_hybridized_body;
      break;
    case Declaration::Returns::contact_forces:
      method = select_methods("HYBRID").front();
      solve = [of_body = method.solve](const Caller& by, const ContactSystem& s,
                                       const RunControl& given) {
        return solve_contact_law(
            by, [&](const RunControl& c) { return of_body(s, c); }, s.problem.get(), given);
      };
      method.solve_contact =
          with_no_answer([caller, own = condensed_contact().solve_contact](
                             const contact::Problem& problem, const RunControl& given) {
            return solve_contact_law(
                caller, [&](const RunControl& c) { return own(problem, c); }, nullptr, given);
          });
      break;
  }
  if (declaration.returns != Declaration::Returns::contact_forces) {
    method.stages = {Stage::recover};
    method.joins_bodies = declaration.joins_bodies;
    method.takes_load_steps = declaration.load_steps;
  }
  method.name = "EXTERNAL:" + declaration.name;
  method.family = method.name.substr(0, method.name.find(":" + declaration.parameter + "="));
  method.summary = declaration.summary;
  method.program = declaration.version;
  method.knob =
      declaration.first_tolerance > 0 ? AccuracyKnob::krylov_tolerance : AccuracyKnob::none;
  method.first_tolerance = declaration.first_tolerance;
  method.solve = with_no_answer(
      [solve, caller](const ContactSystem& s, const RunControl& c) { return solve(caller, s, c); });
  return method;
}

}  // namespace airybench
