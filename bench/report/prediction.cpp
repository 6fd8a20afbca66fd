#include "bench/report/prediction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "support/data_folder.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

// `of` is empty if a record lacks the value. The rest are standard deviations of its logarithm: of
// a case between runs on a busy machine, and of another scene's, another method's or an
// extrapolated value, which is trusted to a factor of four.
struct Quantity {
  std::optional<double> (*of)(const Record&);
  double measured, relative;
};

constexpr Quantity time_quantity = {
    [](const Record& r) { return r.time_s ? r.time_s : r.extrapolated_time_s; }, 0.15, 0.7};
constexpr Quantity heap_quantity = {
    [](const Record& r) {
      // A timeout's is a lower bound.
      const auto bytes =
          r.status == Status::timeout ? 0. : static_cast<double>(r.peak_heap_bytes.value_or(0));
      return bytes > 0 ? std::optional(bytes) : std::nullopt;
    },
    0.01, 0.35};

struct Variant {
  std::string family, method, stop, knob;
  auto operator<=>(const Variant&) const = default;

  explicit Variant(const Record& r)
      : family(r.family),
        method(r.general_name),
        stop(r.iterative ? name_of(r.stop) : ""),
        knob(r.knob_value ? fmt::format("{} {}", r.knob, *r.knob_value) : r.knob) {}
  std::string text() const {
    std::string result = method;
    if (!stop.empty()) result += " with stop " + stop;
    return knob.empty() ? result : result + ", " + knob;
  }
  auto likeness(const Variant& other) const {
    const auto common = std::ranges::mismatch(method, other.method).in1 - method.begin();
    return std::tuple(method == other.method && knob == other.knob, other.knob.empty(), common,
                      stop == other.stop);
  }
};

struct EstimateWithSource {
  Estimate estimate;
  std::string basis;
  const Record* source;
};

class Past {
 public:
  explicit Past(const std::vector<Record>& records) {
    std::map<std::tuple<Variant, std::string, std::string, std::int64_t>, const Record*> latest;
    for (const bool of_studies : {true, false})  // the second replaces the first
      for (const Record& r : records)
        if (r.n_phi > 0 && r.study.empty() != of_studies)
          latest[{Variant(r), r.scene, r.mesh, *r.n_phi}] = &r;
    for (const auto& [key, record] : latest) variants_[std::get<Variant>(key)].push_back(record);
  }

  std::optional<EstimateWithSource> estimate(const Record& c, const Quantity& quantity) const {
    if (!c.n_phi) return {};  // no body, no size
    const Variant own(c);
    if (const Record* const nearest = nearest_in_size(variants_.find(own), c, quantity))
      return scaled(*nearest, c, quantity);
    auto closest = variants_.end();
    for (auto at = variants_.begin(); at != variants_.end(); ++at)
      if (at->first.family == own.family && nearest_in_size(at, c, quantity) != nullptr &&
          (closest == variants_.end() || own.likeness(at->first) > own.likeness(closest->first)))
        closest = at;
    if (closest == variants_.end()) return {};
    EstimateWithSource result = scaled(*nearest_in_size(closest, c, quantity), c, quantity);
    const double factor = std::exp(2 * quantity.relative);
    result.estimate.low /= factor;
    result.estimate.high *= factor;
    result.basis = fmt::format("like {}: {}", closest->first.text(), result.basis);
    return result;
  }

 private:
  using Variants = std::map<Variant, std::vector<const Record*>>;

  // Of the same body if there is one, then of its scene; null: no record has the quantity.
  const Record* nearest_in_size(Variants::const_iterator variant, const Record& c,
                                const Quantity& quantity) const {
    if (variant == variants_.end()) return nullptr;
    const auto distance = [&](const Record* r) {
      return std::tuple(std::abs(std::log(growth(*r->n_phi, *c.n_phi))), r->mesh != c.mesh,
                        r->scene != c.scene);
    };
    const Record* nearest = nullptr;
    for (const Record* r : variant->second)
      if (quantity.of(*r) && (nearest == nullptr || distance(r) < distance(nearest))) nearest = r;
    return nearest;
  }

  static EstimateWithSource scaled(const Record& r, const Record& c, const Quantity& quantity) {
    // All 51 cases of direct methods on Mesh5..Mesh7 in results/paper and results/direct lie in the
    // interval from the next smaller mesh.
    constexpr double exponent_scatter = 0.4;
    const double factor = growth(*r.n_phi, *c.n_phi);
    const bool is_extrapolated = r.status == Status::timeout, is_same_scene = r.scene == c.scene;
    const double own = is_extrapolated || !is_same_scene ? quantity.relative : quantity.measured;
    std::string basis = is_extrapolated ? "a timeout, extrapolated" : "measured";
    if (!is_same_scene || r.mesh != c.mesh || r.n_phi != c.n_phi)
      basis += fmt::format(" on {}/{}", r.mesh, r.scene);
    if (r.n_phi != c.n_phi) basis += ", scaled by n log n";
    return {
        estimate_of(factor * *quantity.of(r), std::hypot(own, exponent_scatter * std::log(factor))),
        std::move(basis), &r};
  }

  Variants variants_;
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
  const auto time = past.estimate(c, time_quantity), heap = past.estimate(c, heap_quantity);
  result.basis = time ? time->basis : heap ? heap->basis : "no record";
  if (time) {
    result.time_s = time->estimate;
    const Record& source = *time->source;
    result.tuning_s = source.tuning_s.value_or(0) * growth(*source.n_phi, *c.n_phi);
    result.run_s = run_seconds(result.time_s->value, result.tuning_s, limits);
    result.timeout =
        std::max(mark_of(result.time_s, limits.timeout_s),
                 mark_of(estimate_of(result.tuning_s, time_quantity.measured), limits.timeout_s));
  }
  if (heap) result.peak_heap_bytes = heap->estimate;
  if (limits.memory_limit_bytes)
    result.memory_limit =
        mark_of(result.peak_heap_bytes, static_cast<double>(*limits.memory_limit_bytes));
  return result;
}

// Capped: far extrapolations exceed the largest integer.
std::string show_heap(const std::optional<Estimate>& bytes) {
  if (!bytes) return "-";
  constexpr double most = 9e18;
  return show_bytes(std::llround(std::min(bytes->value, most)));
}

std::string show_time(double seconds) {
  return seconds < 100 || seconds > 1e9 ? show_seconds(seconds) : show_duration(seconds);
}

std::string totals(const std::vector<Record>& cases, const Forecast& forecast) {
  double sum_s = forecast.references_s.value_or(0);
  std::size_t unknown = 0, largest = 0;
  std::optional<Estimate> most;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Prediction& p = forecast.cases[k];
    if (p.run_s)
      sum_s += *p.run_s;
    else
      ++unknown;
    if (p.peak_heap_bytes && (!most || p.peak_heap_bytes->value > most->value)) {
      most = p.peak_heap_bytes;
      largest = k;
    }
  }
  std::string text = fmt::format("the run: about {}", show_time(sum_s));
  if (forecast.references_s)
    text += fmt::format(", {} of it for references", show_time(*forecast.references_s));
  else
    text += ", without references";
  if (unknown > 0) text += fmt::format(", without {} of {} cases", unknown, cases.size());
  if (most)
    text += fmt::format("; largest heap {}, {}", show_heap(most), name_of(cases[largest]).text());
  return text + "\n";
}

}  // namespace

Estimate estimate_of(double value, double scatter) {
  const double factor = std::exp(2 * scatter);
  return {value, value / factor, value * factor};
}

double growth(std::int64_t from, std::int64_t to) {
  const auto n_log_n = [](std::int64_t n) {
    const double size = std::max(static_cast<double>(n), 2.);
    return size * std::log(size);
  };
  return n_log_n(to) / n_log_n(from);
}

PastRecords read_past_records(const std::vector<std::filesystem::path>& folders) {
  PastRecords past;
  for (const auto& folder : folders) {
    const std::filesystem::path file = records_file_in(folder);
    std::error_code error;
    if (!std::filesystem::exists(file, error)) continue;
    try {
      std::ranges::move(read_records(file, Studies::include), std::back_inserter(past.records));
    } catch (const FileError& unusable) {
      past.passed_over.push_back(unusable.what());
    }
  }
  std::ranges::stable_sort(past.records, {},
                           [](const Record& record) { return context_word(record, "date"); });
  return past;
}

PastRecords read_committed_records(const std::vector<Record>& cases,
                                   const std::filesystem::path& besides) {
  const std::filesystem::path committed = data_folder("results"),
                              stability_scenes = data_folder("scenes/stability");
  std::vector<std::filesystem::path> folders = {committed / "paper", committed / "direct",
                                                committed / "size", committed / "growth", besides};
  // Largest file, only two meshes: skip it for other scenes.
  const bool of_stability = std::ranges::any_of(cases, [&](const Record& c) {
    std::error_code error;
    return c.scene != "default" &&
           std::filesystem::exists(stability_scenes / (c.scene + ".json"), error);
  });
  if (of_stability) folders.push_back(committed / "stability");
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
  // The reference starts from HYBRID and takes this many times as long: 2.8 on Mesh0, 1.9 on Mesh6.
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
    const auto hybrid = past.estimate(hybrid_case, time_quantity);
    if (!hybrid || !result.references_s)
      result.references_s.reset();
    else
      *result.references_s += reference_per_hybrid * hybrid->estimate.value;
  }
  return result;
}

double time_of_machine(const Record& measured, const std::vector<Record>& records) {
  const auto expected = Past(records).estimate(measured, time_quantity);
  return expected && measured.time_s ? *measured.time_s / expected->estimate.value : 1;
}

std::string prediction_table(const std::vector<Record>& cases, const Forecast& forecast,
                             const RunLimits& limits) {
  std::vector<std::vector<std::string>> rows = {
      {"case", "n_phi", "time", "range", "heap", "in the run", "from"}};
  std::string marks;
  const auto add_mark = [&](const std::string& name, LimitMark mark, const std::string& limit) {
    if (mark == LimitMark::below) return;
    const char* const verb = mark == LimitMark::above ? "above" : "may pass";
    marks += fmt::format("{}: {} {}\n", name, verb, limit);
  };
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Prediction& p = forecast.cases[k];
    const std::string name = name_of(cases[k]).text();
    std::string time = "-", range = "-";
    if (p.time_s) {
      time = show_time(p.time_s->value);
      range = fmt::format("{} .. {}", show_time(p.time_s->low), show_time(p.time_s->high));
    }
    rows.push_back({name, cases[k].n_phi ? fmt::format("{}", *cases[k].n_phi) : "-", time, range,
                    show_heap(p.peak_heap_bytes), p.run_s ? show_time(*p.run_s) : "-", p.basis});
    add_mark(name, p.timeout, fmt::format("--timeout={}", limits.timeout_s));
    add_mark(name, p.memory_limit,
             fmt::format("--memory-limit={}", limits.memory_limit_bytes.value_or(0) >> 20));
  }
  return aligned_table(rows, 1) + totals(cases, forecast) + marks;
}

}  // namespace airybench
