#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "bench/records/record.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

// To JSON.

Json json_of(const std::string& text) { return text.empty() ? Json() : Json(text); }
Json json_of(bool flag) { return flag; }
Json json_of(double number) { return std::isfinite(number) ? Json(number) : Json(); }
Json json_of(std::int64_t count) { return count; }
Json json_of(Status status) { return name_of(status); }
Json json_of(Stop stop) { return name_of(stop); }
Json json_of(const std::optional<ContactSolver>& solver) {
  return solver ? Json(name_of(*solver)) : Json();
}
Json json_of(const Json& json) { return json; }
template <typename T>
Json json_of(const std::optional<T>& value) {
  return value ? json_of(*value) : Json();
}
template <typename T>
Json json_of(const std::vector<T>& list) {
  return list;
}
Json json_of(const std::map<std::string, std::string>& words) { return words; }

template <auto member>
Json value_of(const Record& record) {
  return json_of(record.*member);
}

// And back.

struct Place {
  const std::string& place;
  const char* key;
  [[noreturn]] void fail(const Json& value, const std::string& allowed) const {
    throw RecordError(
        fmt::format("{}: {}: {} (allowed: {})", place, key, shortened(json_text(value)), allowed));
  }
};

void read(field_kind::name, const Json& value, const Place& at, std::string& name) {
  if (!value.is_string() || !is_name(value.get_ref<const std::string&>()))
    at.fail(value, "a text that is not empty, without / and control characters");
  name = value.get<std::string>();
}

void read(field_kind::text, const Json& value, const Place& at, std::string& text) {
  if (value.is_null()) return;
  if (!value.is_string()) at.fail(value, "a text, null");
  text = value.get<std::string>();
}

void read(field_kind::flag, const Json& value, const Place& at, bool& flag) {
  if (value.is_null()) return;
  if (!value.is_boolean()) at.fail(value, "true, false, null");
  flag = value.get<bool>();
}

bool is_count(const Json& value) {
  constexpr double most = std::int64_t{1} << 60;
  const double number = value.is_number() ? value.get<double>() : -1;
  return number >= 0 && number <= most && number == std::floor(number);
}

void read(field_kind::count, const Json& value, const Place& at,
          std::optional<std::int64_t>& count) {
  if (value.is_null()) return;
  if (!is_count(value)) at.fail(value, "a whole number from 0 to 2^60, null");
  count = value.get<std::int64_t>();
}

void read_number(const Json& value, const Place& at, bool (*is_allowed)(double),
                 const char* allowed, std::optional<double>& number) {
  if (value.is_null()) return;
  if (!value.is_number() || !is_allowed(value.get<double>())) at.fail(value, allowed);
  number = value.get<double>();
}
void read(field_kind::number, const Json& value, const Place& at, std::optional<double>& number) {
  read_number(
      value, at, [](double) { return true; }, "a number, null", number);
}
void read(field_kind::amount, const Json& value, const Place& at, std::optional<double>& amount) {
  read_number(
      value, at, [](double x) { return x >= 0; }, "a number >= 0, null", amount);
}
void read(field_kind::time, const Json& value, const Place& at, std::optional<double>& time) {
  read_number(
      value, at, [](double x) { return x > 0; }, "a number > 0, null", time);
}
void read(field_kind::fraction, const Json& value, const Place& at, std::optional<double>& part) {
  read_number(
      value, at, [](double x) { return x >= 0 && x <= 1; }, "a number from 0 to 1, null", part);
}

template <typename Word>
Word word_of(const Json& value, const Place& at, std::optional<Word> (*named)(std::string_view),
             const std::string& allowed) {
  const std::optional<Word> word =
      value.is_string() ? named(value.get_ref<const std::string&>()) : std::nullopt;
  if (!word) at.fail(value, allowed);
  return *word;
}

void read(field_kind::status, const Json& value, const Place& at, Status& status) {
  status =
      word_of(value, at, &status_of, fmt::format("{}", fmt::join(names_of(all_statuses), ", ")));
}

void read(field_kind::claim, const Json& value, const Place& at, std::optional<Status>& claim) {
  if (!value.is_null()) read(field_kind::status(), value, at, claim.emplace());
}

void read(field_kind::stop, const Json& value, const Place& at, Stop& stop) {
  if (!value.is_null()) stop = word_of(value, at, &stop_of, "target, paper, null");
}

void read(field_kind::contact, const Json& value, const Place& at,
          std::optional<ContactSolver>& solver) {
  if (!value.is_null())
    solver = word_of(value, at, &contact_solver_of,
                     fmt::format("{}, null", fmt::join(names_of(all_contact_solvers), ", ")));
}

void read(field_kind::times, const Json& value, const Place& at, std::vector<double>& times) {
  if (value.is_null()) return;
  if (!value.is_array()) at.fail(value, "a list of numbers > 0");
  for (const Json& time : value)
    if (!time.is_number() || !(time.get<double>() > 0)) at.fail(time, "numbers > 0");
  times = value.get<std::vector<double>>();
}

// What nlohmann's conversion accepts.
template <typename T>
void read_whole(const Json& value, const Place& at, const char* allowed, T& whole) {
  if (value.is_null()) return;
  try {
    whole = value.get<T>();
  } catch (const Json::exception&) {
    at.fail(value, allowed);
  }
}
void read(field_kind::stage_times, const Json& value, const Place& at,
          std::vector<std::map<std::string, double>>& times) {
  read_whole(value, at, "a list of objects of numbers", times);
}
void read(field_kind::words, const Json& value, const Place& at, std::vector<std::string>& words) {
  read_whole(value, at, "a list of texts", words);
}
void read(field_kind::words_by_word, const Json& value, const Place& at,
          std::map<std::string, std::string>& words) {
  read_whole(value, at, "an object of texts", words);
}

using Shape = bool (*)(const Json&);

template <Shape shape>
bool is_object_of(const Json& value) {
  return value.is_object() && std::all_of(value.begin(), value.end(), shape);
}
template <Shape shape>
bool is_list_of(const Json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), shape);
}
bool is_text(const Json& value) { return value.is_string(); }
bool is_whole(const Json& value) { return value.is_number_integer(); }
bool is_whole_or_null(const Json& value) { return value.is_null() || is_whole(value); }
bool is_number_or_null(const Json& value) { return value.is_null() || value.is_number(); }
bool has(const Json& object, const char* key, Shape shape) {
  return object.is_object() && object.contains(key) && shape(object.at(key));
}
bool is_grid_point(const Json& point) {
  return has(point, "r", is_number_or_null) && has(point, "rho", is_number_or_null) &&
         has(point, "iterations", is_count) && has(point, "outcome", is_text);
}
bool is_attempt(const Json& attempt) {
  const auto may_have = [&](const char* key) {
    return !attempt.contains(key) || is_number_or_null(attempt.at(key));
  };
  return has(attempt, "tolerance", is_number_or_null) && has(attempt, "claimed_status", is_text) &&
         may_have("error_estimate") && may_have("error");
}
bool is_contact_end(const Json& end) {
  return has(end, "face", is_count) && has(end, "from", is_text) && has(end, "to", is_text) &&
         has(end, "x_mm", is_number_or_null) && has(end, "y_mm", is_number_or_null) &&
         has(end, "low_mm", is_number_or_null) && has(end, "high_mm", is_number_or_null);
}

bool is_count_or_null(const Json& value) { return value.is_null() || is_count(value); }
bool is_load_step(const Json& step) {
  return has(step, "claimed_status", is_text) && has(step, "error", is_number_or_null) &&
         has(step, "normal_resultant_N", is_number_or_null) &&
         has(step, "tangential_resultant_N", is_number_or_null) &&
         has(step, "n_open", is_count_or_null) && has(step, "n_stick", is_count_or_null) &&
         has(step, "n_slip", is_count_or_null);
}

void read_shaped(const Json& value, const Place& at, Shape shape, const char* allowed, Json& json) {
  if (!value.is_null() && !shape(value)) at.fail(value, allowed);
  json = value;
}
void read(field_kind::object, const Json& value, const Place& at, Json& json) {
  read_shaped(
      value, at, [](const Json& one) { return one.is_object(); }, "an object, null", json);
}
void read(field_kind::wholes_by_word, const Json& value, const Place& at, Json& json) {
  read_shaped(value, at, is_object_of<is_whole>, "an object of whole numbers, null", json);
}
void read(field_kind::wholes_by_two_words, const Json& value, const Place& at, Json& json) {
  read_shaped(value, at, is_object_of<is_object_of<is_whole_or_null>>,
              "an object of objects of whole numbers, null", json);
}
void read(field_kind::texts_by_word, const Json& value, const Place& at, Json& json) {
  read_shaped(value, at, is_object_of<is_text>, "an object of texts, null", json);
}
void read(field_kind::numbers_by_word, const Json& value, const Place& at, Json& json) {
  read_shaped(value, at, is_object_of<is_list_of<is_number_or_null>>,
              "an object of lists of numbers, null", json);
}
void read(field_kind::grid, const Json& value, const Place& at, Json& json) {
  read_shaped(value, at, is_list_of<is_grid_point>, "a list of {r, rho, iterations, outcome}, null",
              json);
}
void read(field_kind::contact_ends, const Json& value, const Place& at, Json& json) {
  read_shaped(value, at, is_list_of<is_contact_end>,
              "a list of {face, from, to, x_mm, y_mm, low_mm, high_mm}, null", json);
}
void read(field_kind::steps, const Json& value, const Place& at, Json& json) {
  read_shaped(value, at, is_list_of<is_load_step>,
              "a list of {claimed_status, error, normal_resultant_N, tangential_resultant_N, "
              "n_open, n_stick, n_slip}, null",
              json);
}
void read(field_kind::attempts, const Json& value, const Place& at, Json& json) {
  read_shaped(value, at, is_list_of<is_attempt>,
              "a list of {tolerance, claimed_status[, error_estimate][, error]}, null", json);
}

template <typename Kind, auto member>
void read_member(const Json& value, const std::string& place, const char* key, Record& record) {
  read(Kind(), value, {place, key}, record.*member);
}

}  // namespace

const std::vector<Field>& record_fields() {
  static const std::vector<Field> fields = {
#define FIELD(kind, name, unit, use, label, meaning)    \
  {#name,                                               \
   unit,                                                \
   use,                                                 \
   label,                                               \
   meaning,                                             \
   value_of<&Record::name>,                             \
   [](Record& record) { record.name = Record().name; }, \
   read_member<field_kind::kind, &Record::name>},
#include "bench/records/record_fields.def"
  };
  return fields;
}

const Field* find_field(const std::string& name) {
  static const auto by_name = [] {
    std::unordered_map<std::string_view, const Field*> result;
    for (const Field& field : record_fields()) result.emplace(field.name, &field);
    return result;
  }();
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : found->second;
}

const Field& field_named(const std::string& name) {
  const Field* field = find_field(name);
  if (field == nullptr) throw std::out_of_range("no field is named " + name);
  return *field;
}

std::vector<const Field*> fields_with(unsigned uses) {
  std::vector<const Field*> result;
  for (const Field& field : record_fields())
    if ((field.use & uses) == uses) result.push_back(&field);
  return result;
}

std::optional<double> number_in(const Record& record, const Field& field) {
  const Json value = field.value(record);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

Json to_json(const Record& record) { return to_json(record, stored); }

Json to_json(const Record& record, unsigned uses) {
  Json json = Json::object();
  for (const Field* field : fields_with(uses)) json[field->name] = field->value(record);
  return json;
}

}  // namespace airybench
