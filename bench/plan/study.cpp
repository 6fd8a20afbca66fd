#include "bench/plan/study.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "solvers/methods.hpp"
#include "support/data_folder.hpp"

namespace airybench {
namespace {

// `solve` under a changed control; none: none.
template <typename AnySolve>
AnySolve under(const std::function<void(RunControl&)>& turn, AnySolve solve) {
  if (!solve) return nullptr;
  return [solve = std::move(solve), turn](const auto& problem, RunControl control) {
    turn(control);
    return solve(problem, control);
  };
}

// A copy of the method that runs under a changed control, once and untightened.
TurnedMethod turned(const Method& method, Knob knob, std::function<void(RunControl&)> turn) {
  TurnedMethod result{method, std::move(knob)};
  result.method.first_tolerance = 0;
  result.method.solve = under(turn, method.solve);
  result.method.solve_contact = under(turn, method.solve_contact);
  if (method.tune)
    result.method.tune = [tune = method.tune, turn](const DualSystem& system, RunControl control) {
      turn(control);
      Tuning tuning = tune(system, control);
      tuning.solve = under(turn, tuning.solve);
      return tuning;
    };
  return result;
}

TurnedMethod at_paper_stop(const Method& method) {
  return turned(method, {"", {}, Stop::paper, {}},
                [](RunControl& control) { control.stop = Stop::paper; });
}

template <std::size_t count>
std::vector<TurnedMethod> turned_to(const Method& method, const std::string& knob,
                                    const std::array<double, count>& values,
                                    void (*turn)(RunControl&, double)) {
  std::vector<TurnedMethod> points;
  for (const double value : values)
    points.push_back(turned(method, {knob, value, {}, {}},
                            [value, turn](RunControl& control) { turn(control, value); }));
  return points;
}

}  // namespace

std::string name_of(Study study) {
  switch (study) {
    case Study::error:
      return "error";
    case Study::stability:
      return "stability";
    case Study::contact:
      return "contact";
    case Study::adapted:
      return "adapted";
    case Study::load_steps:
      return "load-steps";
    case Study::scaling:
      return "scaling";
    default:
      return "";
  }
}

Study study_of(std::string_view name) {
  for (const Study study : all_studies)
    if (name_of(study) == name) return study;
  return Study::none;
}

std::vector<TurnedMethod> contact_points(const Method& method) {
  if (!method.program.empty()) return {{method, {}}};  // it is one
  std::vector<TurnedMethod> points;
  for (const ContactSolver solver : all_contact_solvers)
    points.push_back(turned(method, {"", {}, {}, solver},
                            [solver](RunControl& control) { control.contact = solver; }));
  return points;
}

std::vector<TurnedMethod> scaling_points(const Method& method, const std::vector<int>& threads) {
  std::vector<TurnedMethod> points;
  for (const int count : threads) {
    points.push_back(turned(method, {"threads", count, {}, {}, count},
                            [count](RunControl& control) { control.threads = count; }));
    points.back().method.first_tolerance = method.first_tolerance;  // tightened as ever
  }
  return points;
}

std::vector<TurnedMethod> error_points(const Method& method) {
  constexpr std::array<double, 6> tolerances = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  constexpr std::array<double, 10> iterations = {2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000};
  constexpr std::array<double, 7> sweeps = {1, 3, 10, 30, 100, 300, 1000};
  switch (method.knob) {
    case AccuracyKnob::krylov_tolerance:
      return turned_to(method, "tolerance", tolerances,
                       [](RunControl& control, double value) { control.tolerance = value; });
    case AccuracyKnob::uzawa_iterations: {
      auto points =
          turned_to(method, "uzawa iterations", iterations, [](RunControl& control, double value) {
            control.tolerance = 0;
            control.uzawa_iterations = static_cast<int>(value);
          });
      points.push_back(at_paper_stop(method));
      return points;
    }
    case AccuracyKnob::stop:
      return {{method, {}}, at_paper_stop(method)};
    case AccuracyKnob::contact_sweeps: {
      auto points = turned_to(method, std::string(sweeps_knob), sweeps,
                              [](RunControl& control, double value) {
                                control.contact_sweeps = static_cast<int>(value);
                                control.contact = ContactSolver::gauss_seidel;
                              });
      points.push_back({method, {}});
      return points;
    }
    default:
      return {{method, {}}};
  }
}

std::optional<StudyDefaults> defaults_of(Study study) {
  switch (study) {
    case Study::stability:
      return StudyDefaults{"Mesh0", 60};
    case Study::contact:
      return StudyDefaults{"Mesh0..Mesh7", 60};
    case Study::adapted:
      return StudyDefaults{"Mesh0,Mesh4", 60};
    case Study::load_steps:
      return StudyDefaults{"Mesh3", 120};
    case Study::scaling:
      return StudyDefaults{"Mesh4..Mesh7", 120};
    default:
      return {};
  }
}

std::string default_methods(Study study) {
  if (study == Study::error)
    return "SDTIC3,SDTIC6,SSKY,3STEPCG3,3STEPCG6,3STEPD,ALM,ALM:r=1,rho=1,ALM:r=20,rho=20,"
           "ALM:r=100,rho=100,ALM:r=300,rho=300,BLIND,BLIND:SCHUR,HYBRID,P2";
  if (study == Study::contact) return "HYBRID";
  if (study == Study::adapted)
    return "SDTIC3,SDTIC6,SSKY,SYMMLQ:FLIC3,SYMMLQ:SSOR1.0,3STEPCG3,3STEPCG6,3STEPCG:FLIC3,"
           "3STEPCG:SSOR1.0,3STEPD,3STEPD:REFINED,ALM:r=20,rho=20,BLIND,BLIND:SCHUR,"
           "BLIND:SCHUR:REFINED,HYBRID,P2";
  if (study == Study::load_steps)
    return "3STEPD:CHOLMOD,ALM:r=20,rho=20,ALM:AUTO,BLIND:SCHUR,HYBRID,P2";
  if (study == Study::scaling) return "3STEPD,3STEPD:CHOLMOD,BLIND,BLIND:SCHUR,HYBRID,SDTIC6";
  if (study == Study::none) {
    std::string names;
    for (const Method& method : methods())
      if (method.in_paper) names += (names.empty() ? "" : ",") + method.name;
    return names;
  }
  // The table, and the augmented Lagrangian far from where its parameters belong.
  return "*,ALM:r=1e-6,rho=1e-6,ALM:r=1e6,rho=1e6,ALM:r=1e12,rho=1e12,ALM:r=20,rho=40,"
         "ALM:r=20,rho=44";
}

std::vector<std::filesystem::path> scenes_of(Study study) {
  if (study != Study::stability && study != Study::contact && study != Study::load_steps) return {};
  const std::filesystem::path folder = data_folder("scenes/" + name_of(study));
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty()) throw std::invalid_argument(folder.string() + ": has no scene files");
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace airybench
