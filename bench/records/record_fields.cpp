#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "bench/records/record.hpp"
#include "support/memory_owner.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

// Empty and non-finite values become null.
template <typename T>
Json json_of(const T& value) {
  if constexpr (std::is_same_v<T, std::string>) {
    return value.empty() ? Json() : Json(value);
  } else if constexpr (std::is_same_v<T, double>) {
    return std::isfinite(value) ? Json(value) : Json();
  } else if constexpr (std::is_enum_v<T>) {
    return name_of(value);
  } else if constexpr (requires { value.has_value(); }) {
    return value ? json_of(*value) : Json();
  } else if constexpr (std::is_same_v<T, std::vector<StepResult>>) {
    Json list;
    for (const StepResult& step : value) {
      Json& json = list.emplace_back(Json::object());
      visit_values(step, [&](const char* key, const auto& part) {
        if (Json of_part = json_of(part); !of_part.is_null()) json[key] = std::move(of_part);
      });
    }
    return list;
  } else {
    return value;
  }
}

template <typename T>
void convert(const Json& value, T& to) {
  to = value.get<T>();
}
void convert(const Json& value, Status& to) { to = *status_of(value.get<std::string>()); }
void convert(const Json& value, Stop& to) { to = *stop_of(value.get<std::string>()); }
void convert(const Json& value, ContactSolver& to) {
  to = *contact_solver_of(value.get<std::string>());
}
template <typename T>
void convert(const Json& value, std::optional<T>& to) {
  convert(value, to.emplace());
}
void convert(const Json& value, std::vector<StepResult>& to) {
  for (const Json& json : value)
    visit_values(to.emplace_back(), [&](const char* key, auto& part) {
      if (const auto found = json.find(key); found != json.end() && !found->is_null())
        convert(*found, part);
    });
}

using Shape = bool (*)(const Json&);

bool is_text(const Json& value) { return value.is_string(); }
bool is_flag(const Json& value) { return value.is_boolean(); }
bool is_object(const Json& value) { return value.is_object(); }
bool is_list(const Json& value) { return value.is_array(); }
bool is_whole(const Json& value) { return value.is_number_integer(); }
bool is_number(const Json& value) { return value.is_number(); }
bool is_amount(const Json& value) { return value.is_number() && value.get<double>() >= 0; }
bool is_positive(const Json& value) { return value.is_number() && value.get<double>() > 0; }
bool is_fraction(const Json& value) { return is_amount(value) && value.get<double>() <= 1; }
bool is_count(const Json& value) {
  return is_amount(value) && value.get<double>() <= field_kind::max_count &&
         value.get<double>() == std::floor(value.get<double>());
}
bool is_size(const Json& value) { return is_count(value) && value.get<double>() >= 1; }
bool is_name_of_something(const Json& value) {
  return value.is_string() && is_name(value.get_ref<const std::string&>());
}
template <auto named>
bool is_word(const Json& value) {
  return value.is_string() && named(value.get_ref<const std::string&>()).has_value();
}
template <const auto& words>
bool is_one_of(const Json& value) {
  return value.is_string() &&
         std::ranges::find(words, value.get_ref<const std::string&>()) != words.end();
}
template <Shape shape>
bool is_or_null(const Json& value) {
  return value.is_null() || shape(value);
}
template <Shape shape>
bool is_object_of(const Json& value) {
  return value.is_object() && std::all_of(value.begin(), value.end(), shape);
}
template <Shape shape>
bool is_list_of(const Json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), shape);
}

struct Key {
  const char* name;
  Shape shape;
  bool may_be_missing = false;
};
bool has(const Json& object, std::initializer_list<Key> keys) {
  return object.is_object() && std::ranges::all_of(keys, [&](const Key& key) {
           const auto found = object.find(key.name);
           return found == object.end() ? key.may_be_missing : key.shape(*found);
         });
}
constexpr Shape number_or_null = is_or_null<is_number>, count_or_null = is_or_null<is_count>;

bool is_attempt(const Json& attempt) {
  return has(attempt, {{"tolerance", number_or_null},
                       {"claimed_status", is_text},
                       {"error_estimate", number_or_null, true},
                       {"error", number_or_null, true}});
}
bool is_contact_end(const Json& end) {
  return has(end, {{"face", is_count},
                   {"from", is_text},
                   {"to", is_text},
                   {"x_mm", number_or_null},
                   {"y_mm", number_or_null},
                   {"low_mm", number_or_null},
                   {"high_mm", number_or_null}});
}
bool is_load_step(const Json& step) {
  const auto shape_of = [](const auto& part) -> Shape {
    using T = std::decay_t<decltype(part)>;
    if (std::is_same_v<T, std::string>) return is_or_null<is_text>;
    if (std::is_same_v<T, std::optional<Status>>) return is_or_null<is_word<status_of>>;
    return std::is_same_v<T, std::optional<double>> ? number_or_null : count_or_null;
  };
  bool fits = step.is_object();
  StepResult empty;
  visit_values(empty, [&](const char* key, const auto& part) {
    const auto found = fits ? step.find(key) : step.end();
    fits = fits && (found == step.end() || shape_of(part)(*found));
  });
  return fits;
}

// A missing key counts as null. null means empty; a required field must not be empty.
struct Rule {
  std::string allowed;
  Shape accepts;
  bool is_required = false;
  std::vector<std::string> words = {};
};
Rule word_rule(const std::vector<std::string>& words, Shape accepts, bool is_required = false) {
  return {fmt::format("{}{}", fmt::join(words, ", "), is_required ? "" : ", null"), accepts,
          is_required, words};
}
template <typename Words>
std::vector<std::string> texts(const Words& words) {
  return {words.begin(), words.end()};
}

namespace rules {
const Rule name{"a text that is not empty, without / and control characters", is_name_of_something,
                true};
const Rule text{"a text, null", is_text};
const Rule flag{"true, false, null", is_flag};
const Rule count{"a whole number from 0 to 2^60, null", is_count};
const Rule size{"a whole number from 1 to 2^60, null", is_size};
const Rule number{"a number, null", is_number};
const Rule amount{"a number >= 0, null", is_amount};
const Rule positive{"a number > 0, null", is_positive};
const Rule fraction{"a number from 0 to 1, null", is_fraction};
const Rule status = word_rule(names_of(all_statuses), is_word<status_of>, true);
const Rule claim = word_rule(names_of(all_statuses), is_word<status_of>);
const Rule stop = word_rule(names_of(all_stops), is_word<stop_of>);
const Rule contact = word_rule(names_of(all_contact_solvers), is_word<contact_solver_of>);
const Rule outcome = word_rule(texts(all_outcomes), is_one_of<all_outcomes>);
const Rule points = word_rule(texts(all_points), is_one_of<all_points>);
const Rule times{"a list of numbers > 0", is_list};
const Rule stage_times{"a list of objects of numbers", is_list_of<is_object_of<is_number>>};
const Rule words{"a list of texts", is_list_of<is_text>};
const Rule words_by_word{"an object of texts", is_object_of<is_text>};
const Rule object{"an object, null", is_object};
const Rule by_owner{"an object of objects of whole numbers, null",
                    is_object_of<is_object_of<is_or_null<is_whole>>>, false,
                    names_of(all_memory_owners)};
const Rule texts_by_word{"an object of texts, null", is_object_of<is_text>};
const Rule numbers_by_word{"an object of lists of numbers, null",
                           is_object_of<is_list_of<number_or_null>>};
const Rule contact_ends{"a list of {face, from, to, x_mm, y_mm, low_mm, high_mm}, null",
                        is_list_of<is_contact_end>};
const Rule steps{"a list of load steps, see steps in results/README.md, null",
                 is_list_of<is_load_step>};
const Rule attempts{"a list of {tolerance, claimed_status[, error_estimate][, error]}, null",
                    is_list_of<is_attempt>};
}  // namespace rules

template <auto member>
Json value_of(const Record& record) {
  return json_of(record.*member);
}

template <const Rule& rule, auto member>
void read(const Json& value, const std::string& place, const char* key, Record& record) {
  if (value.is_null() && !rule.is_required) return;
  const auto check = [&](bool is_good, const Json& part, const std::string& allowed) {
    if (!is_good)
      throw RecordError(
          fmt::format("{}: {}: {} (allowed: {})", place, key, shortened(json_text(part)), allowed));
  };
  check(rule.accepts(value), value, rule.allowed);
  if constexpr (&rule == &rules::times)
    for (const Json& time : value) check(is_positive(time), time, "numbers > 0");
  convert(value, record.*member);
}

}  // namespace

const std::vector<Field>& record_fields() {
  static const std::vector<Field> fields = {
#define FIELD(kind, name, unit, use, source, label, meaning) \
  {#kind,                                                    \
   #name,                                                    \
   unit,                                                     \
   use,                                                      \
   label,                                                    \
   meaning,                                                  \
   rules::kind.words,                                        \
   value_of<&Record::name>,                                  \
   [](Record& record) { record.name = Record().name; },      \
   read<rules::kind, &Record::name>},
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

Json to_json(const Record& record, unsigned uses) {
  Json json = Json::object();
  for (const Field* field : fields_with(uses)) json[field->name] = field->value(record);
  return json;
}

}  // namespace airybench
