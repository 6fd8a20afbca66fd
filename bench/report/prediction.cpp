#include "bench/report/prediction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "support/data_folder.hpp"

namespace airybench {
namespace {

using RecordList = std::vector<const Record*>;
using Quantity = std::optional<double> (*)(const Record&);

std::optional<double> time_of(const Record& record) {
  return record.time_s ? record.time_s : record.extrapolated_time_s;
}
// No tuning is not a time of zero: it says nothing about its growth.
std::optional<double> tuning_of(const Record& record) {
  return record.tuning_s.value_or(0) > 0 ? record.tuning_s : std::nullopt;
}
std::optional<double> heap_of(const Record& record) {
  if (record.peak_heap_bytes.value_or(0) == 0) return {};
  return static_cast<double>(*record.peak_heap_bytes);
}

// Standard deviations of logarithms, at least: of times between runs on a machine that does other
// work as well, and of memory. With these, 52 of the 54 cases of direct methods on Mesh5..Mesh7 in
// results/paper and results/direct lie in the interval from the other meshes of their folder. An
// extrapolated timeout and a relative are trusted to a factor of four.
struct Scatter {
  double measured, direct, iterative, relative;
};
constexpr Scatter scatter_of_time = {0.15, 0.15, 0.3, 0.7};
constexpr Scatter scatter_of_heap = {0.01, 0.1, 0.1, 0.35};

std::size_t common_beginning(const std::string& a, const std::string& b) {
  const std::size_t most = std::min(a.size(), b.size());
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.begin() + most, b.begin()).first -
                                  a.begin());
}

// A method as it is run.
struct Variant {
  std::string family, method, stop, knob;
  bool iterative = false;
  auto operator<=>(const Variant&) const = default;
  std::string text() const {
    std::string result = method;
    if (!stop.empty()) result += " with stop " + stop;
    return knob.empty() ? result : result + ", " + knob;
  }
};

Variant forecast_variant(const Record& r) {
  return {r.family, r.general_name, r.iterative ? std::string(name_of(r.stop)) : "",
          r.knob_value ? fmt::format("{} {}", r.knob, *r.knob_value) : r.knob, r.iterative};
}

// How much one variant is like another, most important first.
auto likeness(const Variant& a, const Variant& b) {
  return std::tuple(a.method == b.method && a.knob == b.knob, a.knob.empty(),
                    common_beginning(a.method, b.method), a.stop == b.stop);
}

struct Grounded {
  Estimate estimate;
  std::string basis;
  Variant variant;                    // whose records they are
  const Record* same_case = nullptr;  // that of the case itself
};

// "7 records, Mesh0..Mesh6, 2 extrapolated": the smallest and the largest mesh.
std::string extent_of(const RecordList& records) {
  const auto [smallest, largest] =
      std::minmax_element(records.begin(), records.end(),
                          [](const auto* a, const auto* b) { return a->n_phi < b->n_phi; });
  std::string text = fmt::format("{} record{}, {}", records.size(), records.size() == 1 ? "" : "s",
                                 (*smallest)->mesh);
  if ((*smallest)->mesh != (*largest)->mesh) text += ".." + (*largest)->mesh;
  const auto extrapolated = std::count_if(records.begin(), records.end(), [](const auto* record) {
    return record->status == Status::timeout;
  });
  if (extrapolated > 0) text += fmt::format(", {} extrapolated", extrapolated);
  return text;
}

int size_of(const Record& r) { return static_cast<int>(r.n_phi.value_or(0)); }

class Past {
 public:
  explicit Past(const std::vector<Record>& records) {
    std::map<std::tuple<Variant, std::string, std::string, std::int64_t>, const Record*> latest;
    for (const bool of_studies : {true, false})  // the second replaces the first
      for (const Record& r : records)
        if (r.n_phi > 0 && r.study.empty() != of_studies)
          latest[{forecast_variant(r), r.scene, r.mesh, *r.n_phi}] = &r;
    for (const auto& [key, record] : latest) variants_[std::get<Variant>(key)].push_back(record);
  }

  std::optional<Grounded> estimate(const Record& c, Quantity quantity,
                                   const Scatter& scatter) const {
    if (!c.n_phi) return {};  // no body whose size would tell
    const Variant own = forecast_variant(c);
    if (auto result = from(own, c, quantity, scatter)) return result;
    const Variant* closest = nullptr;
    for (const auto& [variant, records] : variants_)
      if (variant.family == own.family && !points(records, quantity).empty() &&
          (closest == nullptr || likeness(variant, own) > likeness(*closest, own)))
        closest = &variant;
    if (closest == nullptr) return {};
    auto result = from(*closest, c, quantity, scatter);
    if (!result) return {};
    const double factor = std::exp(2 * scatter.relative);
    result->estimate.low /= factor;
    result->estimate.high *= factor;
    result->basis = fmt::format("like {}: {}", closest->text(), result->basis);
    return result;
  }

  // From the variant that the time is from; zero where most of its cases needed none.
  std::optional<Estimate> tuning(const Record& c, const Grounded& time) const {
    if (time.same_case != nullptr) {
      const std::optional<double> tuning_s = tuning_of(*time.same_case);
      if (!tuning_s) return {};
      return estimate_of(*tuning_s, scatter_of_time.measured);
    }
    const RecordList& records = variants_.at(time.variant);
    if (2 * points(records, tuning_of).size() < points(records, time_of).size()) return {};
    const auto result = from(time.variant, c, tuning_of, scatter_of_time);
    return result ? std::optional(result->estimate) : std::nullopt;
  }

 private:
  static std::vector<SizedValue> points(const RecordList& records, Quantity quantity) {
    std::vector<SizedValue> result;
    for (const Record* record : records)
      if (const auto value = quantity(*record))
        result.push_back({static_cast<int>(*record->n_phi), *value});
    return result;
  }
  static bool has_two_sizes(const RecordList& records) {
    return std::any_of(records.begin(), records.end(), [&](const Record* record) {
      return record->n_phi != records.front()->n_phi;
    });
  }

  std::optional<Grounded> from(const Variant& variant, const Record& c, Quantity quantity,
                               const Scatter& scatter) const {
    const auto found = variants_.find(variant);
    if (found == variants_.end()) return {};
    RecordList any_scene, same_scene;
    for (const Record* record : found->second) {
      if (!quantity(*record)) continue;
      any_scene.push_back(record);
      if (record->scene != c.scene) continue;
      same_scene.push_back(record);
      if (record->mesh != c.mesh || record->n_phi != c.n_phi) continue;
      const bool measured = record->status != Status::timeout;
      return Grounded{
          estimate_of(*quantity(*record), measured ? scatter.measured : scatter.relative),
          measured ? "measured" : "a timeout, extrapolated", variant, record};
    }
    if (any_scene.empty()) return {};
    const double least = variant.iterative ? scatter.iterative : scatter.direct;
    const RecordList& used = has_two_sizes(same_scene) ? same_scene : any_scene;
    const std::vector<SizedValue> values = points(used, quantity);
    const std::string basis = extent_of(used);
    if (const auto law = extrapolate(values, size_of(c), least))
      return Grounded{*law, basis, variant};
    if (values.front().n == size_of(c))  // other scenes of this mesh
      return Grounded{extrapolate(values, size_of(c), 0, least), basis, variant};
    std::vector<std::vector<SizedValue>> groups;
    for (const auto& [other, records] : variants_) groups.push_back(points(records, quantity));
    const std::optional<double> exponent = pooled_exponent(groups, size_of(c));
    if (!exponent) return {};
    return Grounded{extrapolate(values, size_of(c), *exponent, least),
                    fmt::format("{}, exponent {:.2f} of all methods", basis, *exponent), variant};
  }

  std::map<Variant, RecordList> variants_;
};

LimitMark mark_of(const std::optional<Estimate>& estimate, double limit) {
  if (!estimate || estimate->high <= limit) return LimitMark::below;
  return estimate->value > limit ? LimitMark::above : LimitMark::may_pass;
}

Prediction predict(const Record& c, const Past& past, const RunLimits& limits) {
  Prediction result;
  if (c.status == Status::skipped) {
    result.run_s = 0;
    result.basis = "skipped";
    return result;
  }
  const auto time = past.estimate(c, time_of, scatter_of_time);
  const auto heap = past.estimate(c, heap_of, scatter_of_heap);
  result.basis = time ? time->basis : heap ? heap->basis : "no record";
  if (time) {
    result.time_s = time->estimate;
    const std::optional<Estimate> tuning = past.tuning(c, *time);
    result.tuning_s = tuning ? tuning->value : 0;
    result.run_s = run_seconds(result.time_s->value, result.tuning_s, limits);
    result.timeout =
        std::max(mark_of(result.time_s, limits.timeout_s), mark_of(tuning, limits.timeout_s));
  }
  if (heap) result.peak_heap_bytes = heap->estimate;
  if (limits.memory_limit_bytes)
    result.memory_limit =
        mark_of(result.peak_heap_bytes, static_cast<double>(*limits.memory_limit_bytes));
  return result;
}

}  // namespace

PastRecords read_past_records(const std::vector<std::filesystem::path>& folders) {
  PastRecords past;
  for (const auto& folder : folders) {
    const std::filesystem::path file = records_file_in(folder);
    std::error_code error;
    if (!std::filesystem::exists(file, error)) continue;
    try {
      std::vector<Record> records = read_records(file, Studies::include);
      std::move(records.begin(), records.end(), std::back_inserter(past.records));
    } catch (const FileError& unusable) {
      past.passed_over.push_back(unusable.what());
    }
  }
  std::stable_sort(past.records.begin(), past.records.end(), [](const Record& a, const Record& b) {
    return context_word(a, "date") < context_word(b, "date");
  });
  return past;
}

PastRecords read_committed_records(const std::vector<Record>& cases,
                                   const std::filesystem::path& besides) {
  const std::filesystem::path committed = data_folder("results"),
                              stability_scenes = data_folder("scenes/stability");
  std::vector<std::filesystem::path> folders = {committed / "paper", committed / "direct",
                                                committed / "size", committed / "growth", besides};
  // Most of all bytes; no law of a size comes from its two meshes.
  if (std::any_of(cases.begin(), cases.end(), [&](const Record& c) {
        std::error_code error;
        return c.scene != "default" &&
               std::filesystem::exists(stability_scenes / (c.scene + ".json"), error);
      }))
    folders.push_back(committed / "stability");
  return read_past_records(folders);
}

double run_seconds(double time_s, double tuning_s, const RunLimits& limits) {
  const double tuning = std::min(tuning_s, limits.timeout_s);
  if (time_s >= limits.timeout_s) return tuning + limits.timeout_s;
  if (time_s > limits.long_case_s || limits.measures_once) return tuning + time_s;
  const double until_long = std::ceil(limits.long_case_s / time_s);
  const double timed = std::min<double>(limits.repetitions, until_long);
  return tuning + (2 + timed) * time_s;
}

Forecast forecast(const std::vector<Record>& cases, const std::vector<Record>& records,
                  const RunLimits& limits) {
  // The reference takes so many times as long as HYBRID, from which it starts: 2.8 on Mesh0, 1.9 on
  // Mesh6.
  constexpr double reference_per_hybrid = 2.5;
  const Past past(records);
  Forecast result;
  result.references_s = 0;
  std::set<std::pair<std::string, std::string>> posed;
  for (const Record& c : cases) {
    result.cases.push_back(predict(c, past, limits));
    if (c.status == Status::skipped || !c.n_phi || !posed.insert({c.mesh, c.scene}).second)
      continue;
    Record hybrid_case;
    hybrid_case.mesh = c.mesh;
    hybrid_case.scene = c.scene;
    hybrid_case.n_phi = c.n_phi;
    hybrid_case.method = hybrid_case.general_name = hybrid_case.family = "HYBRID";
    const auto hybrid = past.estimate(hybrid_case, time_of, scatter_of_time);
    if (!hybrid || !result.references_s)
      result.references_s.reset();
    else
      *result.references_s += reference_per_hybrid * hybrid->estimate.value;
  }
  return result;
}

}  // namespace airybench
