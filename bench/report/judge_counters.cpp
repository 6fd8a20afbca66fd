#include "bench/report/judge_counters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace airybench {
namespace {

constexpr double error_growth = 1.01;
constexpr double rounding = 1e-11;

constexpr std::array library_keys = {"compiler", "compiler_flags", "build_type",
                                     "eigen",    "cholmod",        "mumps",
                                     "blas",     "blas_core",      "heap_probe"};

bool same_libraries(const Night& a, const Night& b) {
  return std::all_of(library_keys.begin(), library_keys.end(),
                     [&](const char* key) { return a.context_value(key) == b.context_value(key); });
}

// The newest night's cases beside the earlier nights.
class CounterComparison {
 public:
  explicit CounterComparison(const std::vector<Night>& nights) : nights_(nights) {}

  const Night& newest() const { return nights_.back(); }

  // The case in the last earlier night where has(night, record).
  template <typename Has>
  const Record* earlier(const std::string& name, const Has& has) const {
    for (auto night = nights_.rbegin() + 1; night != nights_.rend(); ++night)
      if (const Record* record = night->find(name); record != nullptr && has(*night, *record))
        return record;
    return nullptr;
  }

  template <typename Value>
  void add(const std::string& name, Lane lane, const char* quantity, const Value& before,
           const Value& after, Kind kind) {
    Finding finding{name, lane, quantity, before, after, kind, newest().date, {}, {}, {}, ""};
    if constexpr (std::is_arithmetic_v<Value>)
      if (before > 0) finding.ratio = static_cast<double>(after) / static_cast<double>(before);
    finding.sentence = fmt::format("{}: {} was {} and is {}{}.", name, quantity, before, after,
                                   kind == Kind::worse    ? ": worse"
                                   : kind == Kind::better ? ": better"
                                                          : "");
    findings.push_back(std::move(finding));
  }

  std::vector<Finding> findings;

 private:
  const std::vector<Night>& nights_;
};

void compare_status(CounterComparison& comparison, const Record& now) {
  const Record* before =
      comparison.earlier(name_of(now).text(), [](const Night&, const Record&) { return true; });
  if (before == nullptr || before->status == now.status) return;
  const Kind kind = before->status == Status::ok ? Kind::worse
                    : now.status == Status::ok   ? Kind::better
                                                 : Kind::changed;
  comparison.add(name_of(now).text(), Lane::status, "status", name_of(before->status),
                 name_of(now.status), kind);
}

void compare_counts(CounterComparison& comparison, const Record& now) {
  const std::string name = name_of(now).text();
  for (const JudgedCount& count : judged_counts()) {
    const std::optional<std::int64_t> after = count.in(now);
    if (!after) continue;
    const Record* record = comparison.earlier(name, [&](const Night& night, const Record& earlier) {
      return count.in(earlier) &&
             (!count.of_libraries || same_libraries(night, comparison.newest()));
    });
    if (record == nullptr) continue;
    const std::int64_t before = *count.in(*record);
    if (count_grew(count, before, *after))
      comparison.add(name, Lane::counters, count.field->name, before, *after, Kind::worse);
    else if (count_grew(count, *after, before))
      comparison.add(name, Lane::counters, count.field->name, before, *after, Kind::better);
  }
}

void compare_errors(CounterComparison& comparison, const Record& now) {
  const std::size_t found = comparison.findings.size();
  const std::string name = name_of(now).text();
  for (const Field* field : fields_with(error)) {
    const std::optional<double> after = number_in(now, *field);
    if (!after) continue;
    const Record* record = comparison.earlier(name, [&](const Night&, const Record& earlier) {
      return number_in(earlier, *field).has_value();
    });
    if (record == nullptr) continue;
    const double before = *number_in(*record, *field);
    if (error_grew(before, *after))
      comparison.add(name, Lane::errors, field->name, before, *after, Kind::worse);
    else if (error_grew(*after, before))
      comparison.add(name, Lane::errors, field->name, before, *after, Kind::better);
  }
  if (comparison.findings.size() > found || now.answer_hash.empty()) return;
  const Record* record = comparison.earlier(
      name, [](const Night&, const Record& earlier) { return !earlier.answer_hash.empty(); });
  if (record != nullptr && record->answer_hash != now.answer_hash)
    comparison.add(name, Lane::errors, "answer_hash", record->answer_hash, now.answer_hash,
                   Kind::changed);
}

// What the selection of the last night had and this one has not, and libraries that changed.
void compare_contexts(CounterComparison& comparison, const Night& before) {
  const Night& now = comparison.newest();
  for (const Record& record : before.cases)
    if (now.find(name_of(record).text()) == nullptr)
      comparison.add(name_of(record).text(), Lane::status, "status", name_of(record.status),
                     std::string_view("not run"), Kind::changed);
  std::string changes;
  for (const char* key : library_keys)
    if (before.context_value(key) != now.context_value(key))
      changes += fmt::format("{}{}: {} → {}", changes.empty() ? "" : "; ", key,
                             before.context_value(key), now.context_value(key));
  if (changes.empty()) return;
  Finding finding{"all cases", Lane::counters,
                  "libraries", nullptr,
                  nullptr,     Kind::changed,
                  now.date,    {},
                  {},          {},
                  ""};
  finding.sentence = fmt::format(
      "all cases: new baseline for heap figures and instructions, as compiler or libraries changed "
      "({}).",
      changes);
  comparison.findings.push_back(std::move(finding));
}

}  // namespace

bool error_grew(double before, double after) {
  return after > error_growth * before && after - before > rounding;
}

std::optional<std::int64_t> JudgedCount::in(const Record& record) const {
  const Json value = field->value(record);
  return value.is_null() ? std::nullopt : std::optional(value.get<std::int64_t>());
}

const std::vector<JudgedCount>& judged_counts() {
  static const std::vector<JudgedCount> counts = [] {
    std::vector<JudgedCount> result;
    for (const Field* field : fields_with(counter))
      result.push_back({field, (field->use & of_libraries) != 0,
                        (field->use & per_cent)    ? 1.01
                        : (field->use & per_mille) ? 1.001
                                                   : 1.0});
    return result;
  }();
  return counts;
}

bool count_grew(const JudgedCount& count, std::int64_t before, std::int64_t after) {
  return static_cast<double>(after) > static_cast<double>(before) * count.tolerated_growth;
}

std::vector<Finding> judge_counters(const std::vector<Night>& nights) {
  if (nights.size() < 2) return {};
  CounterComparison comparison(nights);
  compare_contexts(comparison, nights[nights.size() - 2]);
  for (const Record& now : comparison.newest().cases) {
    compare_status(comparison, now);
    compare_counts(comparison, now);
    compare_errors(comparison, now);
  }
  return std::move(comparison.findings);
}

}  // namespace airybench
