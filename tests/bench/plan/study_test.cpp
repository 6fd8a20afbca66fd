// The studies' plans, records and words.
#include "bench/plan/study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "assembly/problem/pose.hpp"
#include "bench/plan/plan.hpp"
#include "bench/plan/scene_file.hpp"
#include "bench/records/record_files.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/records/summary.hpp"
#include "bench/run/runner.hpp"
#include "mesh/msh_format.hpp"
#include "tests/bench/measure/examined.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::study_test {
namespace {

Method method(const std::string& name) { return select_methods(name).front(); }

std::shared_ptr<const Problem> mesh0() {
  static const auto problem = testing::posed(Scene(), testing::catalogue_mesh("Mesh0"));
  return problem;
}

Options options_of(const std::string& study) {
  Options options;
  options.run.study = *study_named(study);
  options.limits.repetitions = 1;
  return options;
}

TEST(Study, PointsTurnTheKnobOfTheMethod) {
  for (const auto& [name, knob] : {std::pair{"SDTIC6", "tolerance"},
                                   {"3STEPCG6", "tolerance"},
                                   {"ALM:r=20,rho=20", "uzawa iterations"}}) {
    SCOPED_TRACE(name);
    std::set<double> values;
    int at_paper_stop = 0;
    for (const auto& [own, settings] : error_points(method(name), {})) {
      EXPECT_FALSE(settings.tightened);
      if (own.value) {
        EXPECT_EQ(own.name, knob);
        EXPECT_EQ(settings.stop, Stop::target);
        EXPECT_EQ(own.name == "tolerance" ? *settings.tolerance : *settings.max_iterations,
                  *own.value);
        EXPECT_TRUE(values.insert(*own.value).second);
      } else {
        EXPECT_EQ(settings.stop, Stop::paper);
        ++at_paper_stop;
      }
    }
    EXPECT_GE(values.size(), 5u);
    EXPECT_EQ(at_paper_stop, std::string(name).starts_with("ALM") ? 1 : 0);
  }
  const auto unparametrised = error_points(method("ALM"), {});
  ASSERT_EQ(unparametrised.size(), 2u);
  EXPECT_EQ(unparametrised[0].settings.stop, Stop::target);
  EXPECT_EQ(unparametrised[1].settings.stop, Stop::paper);
}

TEST(Study, OnlyAMethodWithoutAKnobIsOnePoint) {
  for (const char* name : {"3STEPD", "BLIND:SCHUR", "HYBRID", "P2"}) {
    SCOPED_TRACE(name);
    const auto points = error_points(method(name), {});
    ASSERT_FALSE(points.empty());
    EXPECT_FALSE(points.back().knob.value);  // the method as it is
    EXPECT_TRUE(points.back().settings.tightened);
    EXPECT_EQ(points.back().settings.stop, Stop::target);
    EXPECT_EQ(points.size() == 1, method(name).knob == AccuracyKnob::none);
  }
}

std::vector<PosedScene> scenes(const std::vector<std::string>& names = {"default"}) {
  std::vector<PosedScene> result;
  for (const std::string& name : names) result.push_back({name, "", "", "", "{}", mesh0()});
  return result;
}

// The method is told, whatever the run's number is.
TEST(Study, ACaseRunsWithItsNumberOfThreads) {
  Options options = options_of("scaling");
  options.run.cases.threads = 4;
  int threads = 0;
  Method seen = method("HYBRID");
  seen.solve = [&threads](const ContactSystem&, const RunControl& control) {
    threads = control.threads;
    return Solution();
  };
  testing::CaseBench bench(mesh0(), options);
  bench.examine(seen, scaling_points(common_settings(options.run), {2}).front());
  EXPECT_EQ(threads, 2);
}

// Their files say what they need, and no two cases of a plan have one name.
TEST(Study, AllCanBePlanned) {
  std::vector<std::string> studies = {""};
  for (const Study& study : all_studies()) {
    studies.push_back(study.name);
    EXPECT_FALSE(study.about.empty());
  }
  for (const char* name : {"adapted", "contact", "error", "load-steps", "scaling", "stability"})
    EXPECT_EQ(std::ranges::count(studies, name), 1) << name;
  for (const std::string& name : studies) {
    Options options;
    if (!name.empty()) options = options_of(name);
    const auto methods = select_methods(default_methods(options.run.study));
    EXPECT_GE(methods.size(), name == "error" || name == "stability" ? 7u : 1u) << name;
    std::set<std::string> names;
    for (const Case& c : plan_cases(scenes({"default", "other"}), methods, options.run))
      EXPECT_TRUE(names.insert(c.name().text()).second) << c.name().text();
    EXPECT_FALSE(names.empty());
  }
}

TEST(Study, AFilesComplaintNamesKeyValueAndWhatIsAllowed) {
  const testing::TemporaryFolder folder;
  for (const auto& [text, beginning] :
       {std::pair(R"({"about": "a", "methods": "P2"})", "methods: unknown key, perhaps method ("),
        {"{}", "about: is missing (allowed: a text)"},
        {R"({"about": "a", "points": "all"})", "points: \"all\" (allowed: accuracy, "},
        {R"({"about": "a", "once": 1})", "once: 1 (allowed: true, false)"},
        {R"({"about": "a", "options": {"--timeout": 60}})", "options: --timeout: 60 (allowed: "},
        {R"({"about": "a", "about": "b"})", "about: given twice"},
        {"{", "not JSON: parse error"}}) {
    const std::filesystem::path file = testing::write_text(folder / "mine.json", text);
    const auto what = testing::complaint_of<FileError>([&] { study_of(file); });
    EXPECT_TRUE(what.starts_with(file.string() + ": " + beginning)) << what;
  }
}

TEST(Study, LoadStepsGoByTheScenes) {
  std::vector<std::size_t> steps;
  for (const std::filesystem::path& file : scenes_of(options_of("load-steps").run.study))
    steps.push_back(1 + pose(read_scene(file), testing::small_tooth(4, 4)).later_steps.size());
  EXPECT_EQ(steps, (std::vector<std::size_t>{1, 2, 5, 10, 20, 50}));
}

TEST(Study, OnlyWhatCondensesHasAContactSolver) {
  Options options;
  options.run.cases.contact = ContactSolver::admm;
  const auto cases = plan_cases(scenes(), select_methods("3STEPD,ALM"), options.run);
  EXPECT_EQ(cases[0].settings.contact, ContactSolver::admm);
  EXPECT_FALSE(cases[1].settings.contact);
  options = {};
  options.run.cases.stop = Stop::paper;
  EXPECT_EQ(plan_cases(scenes(), select_methods("3STEPD"), options.run)[0].settings.contact,
            ContactSolver::gauss_seidel);
}

TEST(Study, ATruncatedPointHasItsTimeAndItsError) {
  Options options = options_of("error");
  options.run.study.name = "mine";    // a copy of its file is the same study
  options.limits.long_case_s = 1e-9;  // the detail run is the timed one, too
  testing::CaseBench bench(mesh0(), options);
  const Method alm = method("ALM:r=20,rho=20");
  const StudyPoint first = error_points(alm, common_settings(options.run)).front();
  const Record record = bench.examine(alm, first);
  EXPECT_EQ(record.status, Status::not_converged);
  EXPECT_TRUE(is_measured(record));
  EXPECT_EQ(record.samples_s.size(), 1u);
  ASSERT_TRUE(is_verified(record));
  EXPECT_GT(record.error_force.value_or(0), 1e-6);
  EXPECT_EQ(record.uzawa_iterations, first.knob.value);

  Record ordinary = record;  // elsewhere what has not converged is no measurement
  ordinary.points.clear();
  EXPECT_FALSE(is_measured(ordinary));
}

TEST(Study, OutcomesTellWhoKnewWhat) {
  Record record;
  record.status = record.claimed_status.emplace(Status::ok);
  record.error_stress = 1e-3;
  EXPECT_EQ(outcome_of(record), "ok");
  record.status = Status::inaccurate;  // by the verifier, against the method's word
  EXPECT_EQ(outcome_of(record), "wrong_success");
  record.error_stress.reset();  // there is no reference
  EXPECT_EQ(outcome_of(record), "unverified");
  record.claimed_status = Status::inaccurate;
  EXPECT_EQ(outcome_of(record), "inaccurate");
  record.status = record.claimed_status.emplace(Status::breakdown);
  EXPECT_EQ(outcome_of(record), "breakdown");
}

TEST(Study, AnErrorOfTheMeshIsNotTheMethods) {
  Record record;
  record.claimed_status = Status::ok;
  record.status = Status::inaccurate;
  record.error_stress = 1e-9;
  record.outcome = "inaccurate";  // the judge's word
  EXPECT_EQ(outcome_of(record), "inaccurate");
}

Record point_record(const std::string& study, std::optional<double> tolerance) {
  Record record;
  record.mesh = "Mesh0";
  record.scene = "default";
  record.method = "SDTIC6";
  record.status = Status::ok;
  record.study = study;
  if (tolerance) record.knob = "tolerance";
  record.knob_value = tolerance;
  return record;
}

TEST(Study, RecordsReplaceTheirOwnKindOnlyAndHistoriesPassThemOver) {
  const testing::TemporaryFolder scratch;
  const std::filesystem::path folder = scratch / "o", file = folder / "records.jsonl";
  const auto append = [&](const Record& record) {
    RecordFiles(folder, {}, Keep::others).append(record);
  };
  const auto count_lines = [&] { return testing::lines_of(testing::text_of(file)).size(); };
  append(point_record("", {}));
  append(point_record("error", 1e-2));
  append(point_record("error", 1e-4));
  append(point_record("stability", {}));
  EXPECT_EQ(count_lines(), 4u);
  append(point_record("error", 1e-2));
  append(point_record("stability", {}));
  append(point_record("", {}));
  EXPECT_EQ(count_lines(), 4u);
  EXPECT_EQ(read_records(file).size(), 1u);
}

}  // namespace
}  // namespace airybench::study_test
