// One case's record: everything that a line of the output says. Its fields, with their meaning, are
// in record_fields.def.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "bench/records/case_name.hpp"
#include "bench/records/json.hpp"
#include "support/errors.hpp"
#include "support/status.hpp"

namespace airybench {

// What a field of each kind is held as. What a kind accepts of JSON: record_fields.cpp.
namespace field_kind {
using name = std::string;  // of a mesh, a scene, a method
using text = std::string;
using flag = bool;
using count = std::optional<std::int64_t>;
using number = std::optional<double>;
using amount = std::optional<double>;    // ≥ 0
using time = std::optional<double>;      // > 0
using fraction = std::optional<double>;  // 0 … 1
using status = Status;
using claim = std::optional<Status>;
using stop = Stop;  // older records have none: the target
using contact = std::optional<ContactSolver>;
using times = std::vector<double>;
using stage_times = std::vector<std::map<std::string, double>>;  // of every run: stage → seconds
using words = std::vector<std::string>;
using words_by_word = std::map<std::string, std::string>;
// JSON of a certain shape, or null:
using object = Json;
using wholes_by_word = Json;
using wholes_by_two_words = Json;
using texts_by_word = Json;
using numbers_by_word = Json;
using grid = Json;
using contact_ends = Json;
using steps = Json;
using attempts = Json;
}  // namespace field_kind

// The defaults are those of a case that did not run.
struct Record {
#define FIELD(kind, name, unit, use, source, label, meaning) field_kind::kind name{};
#include "bench/records/record_fields.def"
  Record() { status = Status::crashed; }
};

// The sources of fields: types of other rooms, known by name alone.
struct AssembledBlocks;
struct MemorySplit;
struct MeshExtent;
struct Method;
struct Options;
struct Solution;
struct Verification;
struct elsewhere;  // is set where it is measured

// Copies every field that the table takes from this source, whose member has the field's name.
template <typename Source>
void take_over(const Source& from, Record& record) {
#define FIELD(kind, name, unit, use, source, label, meaning) \
  if constexpr (std::is_same_v<Source, source>) record.name = from.name;
#include "bench/records/record_fields.def"
}

// Where a field goes, besides records.jsonl, which has them all.
enum FieldUse : unsigned {
  stored = 0,
  column = 1,   // of results.csv
  nightly = 2,  // into the nights of a history
  counter = 4,  // is judged there: a growth is worse
  error = 8,    // is judged there: an error or a residual
  // A counter that depends on compiler and libraries, too, and by how much it may grow.
  of_libraries = 16,
  per_mille = 32,
  per_cent = 64,
};

struct Field {
  const char* name;
  const char* unit;     // "" : none; "1": a ratio
  unsigned use;         // FieldUse
  const char* label;    // of its series on the page; "": it has none
  const char* meaning;  // Markdown, one line
  Json (*value)(const Record& record);
  void (*clear)(Record& record);  // to its default
  // A RecordError begins with `place` and `key`.
  void (*read)(const Json& value, const std::string& place, const char* key, Record& record);
};

// In the order of record_fields.def.
const std::vector<Field>& record_fields();
// Those that have all of these uses.
std::vector<const Field*> fields_with(unsigned uses);
const Field* find_field(const std::string& name);   // nullptr: none is named so
const Field& field_named(const std::string& name);  // throws std::out_of_range

// Empty: it has none, or is no number.
std::optional<double> number_in(const Record& record, const Field& field);

// A line of records.jsonl, columns first; with `uses` only the fields that have all of these.
Json to_json(const Record& record, unsigned uses = stored);

// A record or a file of records cannot be used; what() is one line: file, line number, key, value,
// what is allowed.
struct RecordError : FileError {
  using FileError::FileError;
};

// to_json() of the result is the JSON again. Keys that are no fields are ignored; those that are
// missing keep their defaults, and in records older than general_name and family these follow from
// the method's name. A RecordError begins with `place`.
Record record_of(const Json& json, const std::string& place);
// The same of a line's text, without all of its JSON in between.
Record record_of_text(const std::string& text, const std::string& place);
// A line's JSON. Throws RecordError: it is none.
Json json_of_text(const std::string& text, const std::string& place);

CaseName name_of(const Record& record);

// "": its context has none.
std::string context_word(const Record& record, const std::string& key);

bool is_verified(const Record& record);

// Has an answer whose time and memory are worth taking, also one that was cut short on purpose.
bool is_measured(const Record& record);

}  // namespace airybench
