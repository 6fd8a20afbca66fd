// The record of a case, a line of records.jsonl. record_fields.def lists and explains its fields.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bench/records/case_name.hpp"
#include "bench/records/json.hpp"
#include "bench/records/step_result.hpp"
#include "support/errors.hpp"
#include "support/status.hpp"

namespace airybench {

// The type of each kind of field. record_fields.cpp checks the JSON that a kind accepts.
namespace field_kind {
using name = std::string;  // see is_name()
using text = std::string;
using flag = bool;
using count = std::optional<std::int64_t>;
using size = std::optional<std::int64_t>;  // ≥ 1
inline constexpr std::int64_t max_count = std::int64_t{1} << 60;
using number = std::optional<double>;
using amount = std::optional<double>;    // ≥ 0
using positive = std::optional<double>;  // > 0
using fraction = std::optional<double>;  // 0 … 1
using status = Status;
using claim = std::optional<Status>;
using stop = Stop;  // missing in older records: target
using contact = std::optional<ContactSolver>;
using outcome = std::string;  // of all_outcomes
using points = std::string;   // of all_points
using times = std::vector<double>;
using stage_times = std::vector<std::map<std::string, double>>;  // per run: stage → seconds
using words = std::vector<std::string>;
using words_by_word = std::map<std::string, std::string>;
using steps = std::vector<StepResult>;
// JSON of a certain shape, or null:
using object = Json;
using by_owner = Json;
using texts_by_word = Json;
using numbers_by_word = Json;
using contact_ends = Json;
using attempts = Json;
}  // namespace field_kind

inline constexpr std::string_view other_solution = "other_solution";
// In the order of figures' keys.
inline constexpr std::array<std::string_view, 13> all_outcomes = {
    "ok",        other_solution,  "inaccurate",    "unstressed", "not_converged",
    "breakdown", "unverified",    "wrong_success", "timeout",    "out_of_memory",
    "crashed",   "machine_fault", "skipped"};
// The cases of each method in a study, in the order of Study::Points; of one case: none.
inline constexpr std::array<std::string_view, 3> all_points = {"accuracy", "contact", "threads"};

// A status, and the reason of what is not ok or a remark on what is.
struct Verdict {
  Status status = Status::crashed;
  std::string reason;                   // remarks joined by "; "
  void add(const std::string& remark);  // empty: none
};

// The defaults describe a case that did not run.
struct Record {
#define FIELD(kind, name, unit, use, source, label, meaning) field_kind::kind name{};
#include "bench/records/record_fields.def"
  Record() { conclude({}); }
  // Nothing else but a reader of records sets its status.
  void conclude(const Verdict& verdict);
};

// Sources of fields; take_over() needs their names only.
struct CaseResult;
struct CaseSettings;
struct Limits;
struct Memory;
struct MemorySplit;
struct MeshExtent;
struct Method;
struct Search;
struct Solution;
struct Verification;
struct elsewhere;  // no source: the code that measures sets the field

// Copies the fields whose source in the table is Source, from the members of the same name.
template <typename Source>
void take_over(const Source& from, Record& record) {
#define FIELD(kind, name, unit, use, source, label, meaning) \
  if constexpr (std::is_same_v<Source, source>) record.name = from.name;
#include "bench/records/record_fields.def"
}

// Where a field goes besides records.jsonl, which has all fields.
enum FieldUse : unsigned {
  stored = 0,
  column = 1,   // of results.csv
  nightly = 2,  // the nights of a history
  counter = 4,  // judged in nights: growth is worse
  error = 8,    // judged in nights: an error or a residual
  // A counter that compiler and libraries change, and its tolerance.
  of_libraries = 16,
  per_mille = 32,
};

struct Field {
  const char* kind;  // of field_kind
  const char* name;
  const char* unit;                       // "": none; "1": a ratio
  unsigned use;                           // FieldUse
  const char* label;                      // in figures; nightly fields with one have a series
  const char* meaning;                    // Markdown, one line
  const std::vector<std::string>& words;  // that it takes; empty: any
  Json (*value)(const Record& record);
  void (*clear)(Record& record);  // restores the default
  // Throws RecordError, which begins with `place` and `key`.
  void (*read)(const Json& value, const std::string& place, const char* key, Record& record);
};

const std::vector<Field>& record_fields();
std::vector<const Field*> fields_with(unsigned uses);  // that have all of these uses
const Field* find_field(const std::string& name);      // nullptr if unknown
const Field& field_named(const std::string& name);     // throws std::out_of_range

std::optional<double> number_in(const Record& record, const Field& field);  // empty: no number

Json to_json(const Record& record, unsigned uses = stored);  // of fields_with(uses)

// what() is one line: file, line number, key, value, allowed values.
struct RecordError : FileError {
  using FileError::FileError;
};

// The inverse of to_json(). Ignores unknown keys; missing keys keep their defaults, except that
// case_name, general_name and family, which older records lack, follow from other fields. Throws
// RecordError, which begins with `place`.
Record record_of(const Json& json, const std::string& place);
// Equals record_of(json_of_text(text)), but uses less memory.
Record record_of_text(const std::string& text, const std::string& place);
Json json_of_text(const std::string& text, const std::string& place);  // throws RecordError

CaseName name_of(const Record& record);

std::string context_word(const Record& record, const std::string& key);  // "" if missing

bool is_verified(const Record& record);

// Whether time and memory count: there is an answer, or a study of accuracy stopped the method
// early. points: of all_points.
bool is_measured(Status status, std::string_view points, bool is_verified);
bool is_measured(const Record& record);

}  // namespace airybench
