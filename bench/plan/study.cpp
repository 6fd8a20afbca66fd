#include "bench/plan/study.hpp"

#include <algorithm>
#include <utility>

#include "bench/records/case_name.hpp"
#include "bench/records/json_value.hpp"
#include "bench/records/record.hpp"
#include "mesh/selection.hpp"
#include "solvers/methods.hpp"
#include "support/data_folder.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

StudyPoint at_paper_stop(CaseSettings asked) {
  asked.stop = Stop::paper;
  asked.tightened = false;
  return {{}, std::move(asked)};
}

template <typename Set>
std::vector<StudyPoint> points_at(const std::string& knob, const std::vector<double>& values,
                                  const CaseSettings& asked, Set set) {
  std::vector<StudyPoint> points;
  for (const double value : values) {
    StudyPoint& point = points.emplace_back(StudyPoint{{knob, value}, asked});
    point.settings.tightened = false;
    set(point.settings, value);
  }
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

std::string_view name_of(Study::Points points) {
  return points == Study::Points::one ? "" : all_points[static_cast<std::size_t>(points) - 1];
}

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
                      {{std::string(name_of(accuracy)), accuracy},
                       {std::string(name_of(contact)), contact},
                       {std::string(name_of(threads)), threads}}),
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

std::vector<StudyPoint> contact_points(const Method& method, const CaseSettings& asked) {
  if (!method.program.empty()) return {{{}, asked}};  // the program is a contact solver
  std::vector<StudyPoint> points;
  for (const ContactSolver solver : all_contact_solvers) {
    CaseSettings& settings = points.emplace_back(StudyPoint{{}, asked}).settings;
    settings.tightened = false;
    settings.contact = solver;
  }
  return points;
}

std::vector<StudyPoint> precision_points(const Method& method, const CaseSettings& asked) {
  std::vector<StudyPoint> points;
  for (const double precision : {1e-4, 1e-8})
    for (StudyPoint& point : contact_points(method, asked)) {
      point.knob = {"tolerance", precision};
      point.settings.tightened = false;
      point.settings.target_error = precision;
      point.settings.tolerance = precision / 10;
      point.settings.contact_tolerance = precision / 10;
      points.push_back(std::move(point));
    }
  return points;
}

std::vector<StudyPoint> scaling_points(const CaseSettings& asked, const std::vector<int>& threads) {
  std::vector<StudyPoint> points;
  for (const int count : threads) {
    points.push_back({{"threads", count}, asked});
    points.back().settings.threads = count;
  }
  return points;
}

std::vector<StudyPoint> error_points(const Method& method, const CaseSettings& asked) {
  std::vector<StudyPoint> points;
  switch (method.knob) {
    case AccuracyKnob::krylov_tolerance:
      return points_at("tolerance", {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}, asked,
                       [](CaseSettings& settings, double value) { settings.tolerance = value; });
    case AccuracyKnob::uzawa_iterations:
      points = points_at("uzawa iterations", {2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000}, asked,
                         [](CaseSettings& settings, double value) {
                           settings.tolerance = 0;
                           settings.max_iterations = static_cast<int>(value);
                         });
      points.push_back(at_paper_stop(asked));
      return points;
    case AccuracyKnob::contact_sweeps:
      points = points_at(std::string(sweeps_knob), {1, 3, 10, 30, 100, 300, 1000}, asked,
                         [](CaseSettings& settings, double value) {
                           settings.max_contact_iterations = static_cast<int>(value);
                           settings.contact = ContactSolver::gauss_seidel;
                         });
      points.push_back({{}, asked});
      return points;
    case AccuracyKnob::stop:
      return {{{}, asked}, at_paper_stop(asked)};
    default:
      return {{{}, asked}};
  }
}

}  // namespace airybench
