#include "bench/plan/study.hpp"

#include <algorithm>

#include "bench/records/case_name.hpp"
#include "bench/records/json_value.hpp"
#include "mesh/selection.hpp"
#include "solvers/methods.hpp"
#include "support/data_folder.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

template <typename AnySolve>
AnySolve under(const std::function<void(RunControl&)>& turn, AnySolve solve) {
  if (!solve) return nullptr;
  return [solve = std::move(solve), turn](const auto& problem, RunControl control) {
    turn(control);
    return solve(problem, control);
  };
}

// A copy of the method that runs once, without tightening, after `turn` has changed the control.
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

std::vector<TurnedMethod> turned_to(const Method& method, const std::string& knob,
                                    const std::vector<double>& values,
                                    void (*turn)(RunControl&, double)) {
  std::vector<TurnedMethod> points;
  for (const double value : values)
    points.push_back(turned(method, {knob, value, {}, {}},
                            [value, turn](RunControl& control) { turn(control, value); }));
  return points;
}

std::vector<std::filesystem::path> json_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

Study study_of(const std::filesystem::path& file) {
  using enum Study::Points;
  Study study;
  study.name = file.stem().string();
  const Json json = json_of_file(file.string(), file_text(file));
  const auto read_options = [&](const JsonValue& options) {
    options.each("an object: option to value",
                 [&](const std::string& name, const JsonValue& value) {
                   std::string& text = study.options.emplace_back(name, "").second;
                   read(value, text);
                   if (name == "--mesh" && is_mesh_file(text))  // next to the study
                     text = (file.parent_path() / text).string();
                 });
  };
  JsonValue(file.string(), "", json)
      .object({required(key("about", study.about)),
               choice("points", study.points,
                      {{"accuracy", accuracy}, {"contact", contact}, {"threads", threads}}),
               key("method", study.methods),
               {"options", read_options},
               key("scenes", study.scenes),
               key("once", study.once),
               key("condition", study.condition),
               key("intervals", study.intervals)});
  return study;
}

std::vector<Study> all_studies() {
  std::vector<Study> studies;
  for (const std::filesystem::path& file : json_files(data_folder("scenes")))
    studies.push_back(study_of(file));
  return studies;
}

std::optional<Study> study_named(const std::string& name) {
  for (const Study& study : all_studies())
    if (study.name == name) return study;
  return {};
}

std::string default_methods(const Study& study) {
  if (!study.methods.empty()) return study.methods;
  std::string names;
  for (const Method& method : methods())
    if (method.in_paper) names += (names.empty() ? "" : ",") + method.name;
  return names;
}

std::vector<std::filesystem::path> scenes_of(const Study& study) {
  if (study.scenes.empty()) return {};
  const std::filesystem::path folder = data_folder("scenes") / study.scenes;
  std::vector<std::filesystem::path> files = json_files(folder);
  if (files.empty()) throw std::invalid_argument(folder.string() + ": has no scene files");
  return files;
}

std::vector<TurnedMethod> contact_points(const Method& method) {
  if (!method.program.empty()) return {{method, {}}};  // the program is a contact solver
  std::vector<TurnedMethod> points;
  for (const ContactSolver solver : all_contact_solvers)
    points.push_back(turned(method, {"", {}, {}, solver},
                            [solver](RunControl& control) { control.contact.solver = solver; }));
  return points;
}

std::vector<TurnedMethod> precision_points(const Method& method) {
  std::vector<TurnedMethod> points;
  for (const double precision : {1e-4, 1e-8})
    for (const TurnedMethod& by : contact_points(method)) {
      points.push_back(turned(by.method, {"tolerance", precision, {}, by.knob.contact},
                              [precision](RunControl& control) {
                                control.target_error = precision;
                                control.tolerance = precision / 10;
                                control.contact.tolerance = precision / 10;
                                control.contact.acceptable = precision / 10;
                              }));
      points.back().method.target_error = precision;
    }
  return points;
}

std::vector<TurnedMethod> scaling_points(const Method& method, const std::vector<int>& threads) {
  std::vector<TurnedMethod> points;
  for (const int count : threads) {
    points.push_back(turned(method, {"threads", count, {}, {}, count},
                            [count](RunControl& control) { control.threads = count; }));
    points.back().method.first_tolerance = method.first_tolerance;  // still tightened
  }
  return points;
}

std::vector<TurnedMethod> error_points(const Method& method) {
  std::vector<TurnedMethod> points;
  switch (method.knob) {
    case AccuracyKnob::krylov_tolerance:
      return turned_to(method, "tolerance", {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12},
                       [](RunControl& control, double value) { control.tolerance = value; });
    case AccuracyKnob::uzawa_iterations:
      points = turned_to(method, "uzawa iterations", {2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000},
                         [](RunControl& control, double value) {
                           control.tolerance = 0;
                           control.most_iterations = static_cast<int>(value);
                         });
      points.push_back(at_paper_stop(method));
      return points;
    case AccuracyKnob::contact_sweeps:
      points = turned_to(method, std::string(sweeps_knob), {1, 3, 10, 30, 100, 300, 1000},
                         [](RunControl& control, double value) {
                           control.contact.most_iterations = static_cast<int>(value);
                           control.contact.solver = ContactSolver::gauss_seidel;
                         });
      points.push_back({method, {}});
      return points;
    case AccuracyKnob::stop:
      return {{method, {}}, at_paper_stop(method)};
    default:
      return {{method, {}}};
  }
}

}  // namespace airybench
