// A case's detail run, by a workbench that assembles once.
#pragma once

#include "bench/measure/workbench.hpp"
#include "tests/support/posed.hpp"

namespace airybench::testing {

// The cases of one problem, in a scene without a name, as a run with these options, which must
// outlive it, asks for them.
class CaseBench : public Workbench {
 public:
  CaseBench(std::shared_ptr<const Problem> problem, const Options& options)
      : Workbench(problem, common_settings(options.run), options.limits),
        limits_(options.limits),
        scene_{"", "", "", "", "{}", std::move(problem)},
        run_(options.run) {}

  Record examine(const Method& method, const std::filesystem::path& fields) {
    return to_record(asked(method), limits_, Workbench::examine(asked(method), fields).result);
  }
  Record examine(const Method& method, const StudyPoint& point) {
    Case c = asked(method);
    c.settings = point.settings;
    c.knob = point.knob;
    return to_record(c, limits_, Workbench::examine(c, {}).result);
  }
  // With its memory run and, unless the method fails, one timed run.
  Record measure(const Method& method) {
    const Case c = asked(method);
    auto [result, choice] = Workbench::examine(c, {});
    if (is_measured(c, result)) measure_memory(method, choice, result);
    Record record = to_record(c, limits_, result);
    if (is_measured(record)) add_run(measure_time(method, choice), record);
    return record;
  }

 private:
  Case asked(const Method& method) const {
    return {.posed = scene_,
            .method = method,
            .settings = common_settings(run_),
            .study = run_.study.name,
            .points = run_.study.points};
  }
  const Limits& limits_;
  PosedScene scene_;
  RunSettings run_;
};

inline Record examined(std::shared_ptr<const Problem> problem, const Method& method,
                       Options options = {}) {
  options.limits.repetitions = 1;
  return CaseBench(std::move(problem), options).examine(method, "");
}
inline Record examined(std::shared_ptr<const Problem> problem, const char* method,
                       const Options& options = {}) {
  return examined(std::move(problem), select_methods(method).front(), options);
}

// The same with its memory run and one timed run.
inline Record measured(std::shared_ptr<const Problem> problem, const Method& method) {
  Options options;
  options.limits.repetitions = 1;
  return CaseBench(std::move(problem), options).measure(method);
}

}  // namespace airybench::testing
