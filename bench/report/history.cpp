#include "bench/report/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "bench/records/context.hpp"
#include "bench/records/json.hpp"
#include "bench/records/robust.hpp"
#include "support/atomic_file.hpp"
#include "support/file_text.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

constexpr const char* format_name = "airybench-night-1";
constexpr std::array lanes = {Lane::status, Lane::counters, Lane::errors, Lane::times};
constexpr std::array kinds = {Kind::worse, Kind::better, Kind::changed};

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json to_json(const Finding& finding) {
  return {{"case", finding.case_name},    {"lane", name_of(finding.lane)},
          {"quantity", finding.quantity}, {"before", finding.before},
          {"after", finding.after},       {"kind", name_of(finding.kind)},
          {"since", finding.since},       {"ratio", or_null(finding.ratio)},
          {"low", or_null(finding.low)},  {"high", or_null(finding.high)},
          {"sentence", finding.sentence}};
}

// Reads the values of an object's keys; what does not fit is refused by place, key and value.
struct ObjectReader {
  const Json& json;
  std::string place;  // "nights/2026-11-21T030000Z.json: verdict 3"

  const Json& at(const char* key) const {
    static const Json null;
    const auto found = json.find(key);
    return found == json.end() ? null : *found;
  }
  [[noreturn]] void fail(const char* key, const std::string& allowed) const {
    throw RecordError(fmt::format("{}: {}: {} (allowed: {})", place, key,
                                  shortened(json_text(at(key))), allowed));
  }
  // What nlohmann's conversion accepts.
  template <typename T>
  T value(const char* key, const char* allowed) const {
    try {
      return at(key).get<T>();
    } catch (const Json::exception&) {
      fail(key, allowed);
    }
  }
  std::string text(const char* key) const { return value<std::string>(key, "a text"); }
  std::optional<double> number(const char* key) const {
    return at(key).is_null() ? std::nullopt : std::optional(value<double>(key, "a number, null"));
  }
  const Json& list(const char* key) const {
    if (!at(key).is_array()) fail(key, "a list");
    return at(key);
  }
  template <typename Enum, std::size_t size>
  Enum word(const char* key, const std::array<Enum, size>& values) const {
    std::string allowed;
    for (const Enum one : values) {
      if (at(key) == name_of(one)) return one;
      allowed += (allowed.empty() ? "" : ", ") + std::string(name_of(one));
    }
    fail(key, allowed);
  }
};

ObjectReader reader_of(const Json& json, const std::string& place) {
  if (!json.is_object())
    throw RecordError(
        fmt::format("{}: {} (allowed: a JSON object)", place, shortened(json_text(json))));
  return {json, place};
}

Finding finding_of(const ObjectReader& verdict) {
  return {verdict.text("case"),   verdict.word("lane", lanes), verdict.text("quantity"),
          verdict.at("before"),   verdict.at("after"),         verdict.word("kind", kinds),
          verdict.text("since"),  verdict.number("ratio"),     verdict.number("low"),
          verdict.number("high"), verdict.text("sentence")};
}

// 2026-11-21T03:00:00Z
bool is_date(const std::string& text) {
  const std::string_view pattern = "dddd-dd-ddTdd:dd:ddZ";
  return text.size() == pattern.size() &&
         std::equal(text.begin(), text.end(), pattern.begin(), [](char c, char expected) {
           return expected == 'd' ? c >= '0' && c <= '9' : c == expected;
         });
}

}  // namespace

Night parse_night(const std::string& text, const fs::path& file) {
  const std::string place = file.string();
  Json json;
  try {
    json = parse_json(text);
  } catch (const Json::exception& wrong) {
    throw RecordError(fmt::format("{}: not a whole night: {} (mend or remove the file)", place,
                                  without_prefix(wrong)));
  }
  const ObjectReader all = reader_of(json, place);
  if (all.at("format") != format_name) all.fail("format", fmt::format("\"{}\"", format_name));
  Night night;
  night.file = file;
  night.date = all.text("date");
  if (!is_date(night.date)) all.fail("date", "as 2026-11-21T03:00:00Z");
  night.context = all.value<std::map<std::string, std::string>>("context", "an object of texts");
  night.noise_samples_s = reader_of(all.at("noise"), place + ": noise")
                              .value<std::vector<double>>("samples_s", "a list of numbers");
  for (const Json& one : all.list("cases"))
    night.cases.push_back(
        record_of(one, fmt::format("{}: case {}", place, night.cases.size() + 1)));
  for (const Json& one : all.list("verdicts"))
    night.findings.push_back(finding_of(
        reader_of(one, fmt::format("{}: verdict {}", place, night.findings.size() + 1))));
  night.failed = all.value<bool>("failed", "true, false");
  // Older nights do not say.
  night.times_judged =
      !json.contains("times_judged") || all.value<bool>("times_judged", "true, false");
  return night;
}

std::string_view name_of(Lane lane) {
  constexpr std::array<std::string_view, 4> names = {"status", "counters", "errors", "times"};
  return names[static_cast<std::size_t>(lane)];
}

std::string_view name_of(Kind kind) {
  constexpr std::array<std::string_view, 3> names = {"worse", "better", "changed"};
  return names[static_cast<std::size_t>(kind)];
}

const Record* Night::find(const std::string& case_name) const {
  const auto found = std::find_if(cases.begin(), cases.end(), [&](const Record& record) {
    return name_of(record).text() == case_name;
  });
  return found == cases.end() ? nullptr : &*found;
}

std::string Night::context_value(const std::string& key) const {
  return context_word(context, key);
}

std::string Night::machine() const {
  return fmt::format("{}, {} processors, {} threads", context_value("cpu"), context_value("cpus"),
                     context_value("threads"));
}

Night night_of(std::vector<Record> records, const std::string& source) {
  if (records.empty()) throw RecordError(source + ": no records (a night needs some)");
  Night night;
  night.context = records.front().context;
  night.date = night.context_value("date");
  if (!is_date(night.date))
    throw RecordError(fmt::format("{}:1: context: date: \"{}\" (allowed: as 2026-11-21T03:00:00Z)",
                                  source, night.date));
  for (const Record& record : records)
    if (record.noise_kernel_s) night.noise_samples_s.push_back(*record.noise_kernel_s);
  night.cases = std::move(records);
  return night;
}

std::vector<Night> read_history(const fs::path& folder) {
  std::vector<Night> nights;
  const fs::path files = folder / "nights";
  std::error_code error;
  if (!fs::exists(files, error)) return nights;
  if (!fs::is_directory(files, error)) throw RecordError(files.string() + ": not a folder");
  for (const auto& entry : fs::directory_iterator(files))
    if (entry.path().extension() == ".json")
      nights.push_back(parse_night(file_text(entry.path()), entry.path()));
  std::sort(nights.begin(), nights.end(), [](const Night& a, const Night& b) {
    return std::tie(a.date, a.file) < std::tie(b.date, b.file);
  });
  return nights;
}

fs::path file_for(const Night& night, const fs::path& folder, const std::vector<Night>& history) {
  int of_this_second = 0;
  for (const Night& other : history) {
    if (other.date != night.date) continue;
    ++of_this_second;
    if (std::equal(night.cases.begin(), night.cases.end(), other.cases.begin(), other.cases.end(),
                   [](const Record& a, const Record& b) {
                     return to_json(a, nightly) == to_json(b, nightly);
                   }))
      throw RecordError(
          fmt::format("{}: these records are already in the history", other.file.string()));
  }
  std::string name = night.date;
  std::erase(name, ':');
  if (of_this_second > 0) name += fmt::format("-{}", of_this_second + 1);
  return folder / "nights" / (name + ".json");
}

void write_night(const Night& night) {
  const auto finite = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  Json cases = Json::array(), verdicts = Json::array();
  for (const Record& record : night.cases) cases.push_back(to_json(record, nightly));
  for (const Finding& finding : night.findings) verdicts.push_back(to_json(finding));
  const Json json = {{"format", format_name},
                     {"date", night.date},
                     {"context", night.context},
                     {"noise",
                      {{"median_s", finite(median(night.noise_samples_s))},
                       {"mad_s", finite(median_absolute_deviation(night.noise_samples_s))},
                       {"samples_s", night.noise_samples_s}}},
                     {"cases", cases},
                     {"verdicts", verdicts},
                     {"failed", night.failed},
                     {"times_judged", night.times_judged}};
  make_folder(night.file.parent_path());
  write_file_atomically(night.file, indented_json_text(json, 1) + "\n");
}

}  // namespace airybench
