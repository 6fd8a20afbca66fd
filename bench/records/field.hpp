// What the table of a record's fields, record_fields.def, is made of.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/records/json.hpp"
#include "support/status.hpp"

namespace airybench {

// How a kind of field is held, and what of JSON it accepts. null and a missing key are the same:
// empty, and what is empty is written as null.
namespace field_kind {

struct name {  // of a mesh, a scene, a method: is_name()
  using Type = std::string;
};
struct text {
  using Type = std::string;
};
struct flag {
  using Type = bool;
};
struct count {  // a whole number from 0 to 2^60
  using Type = std::optional<std::int64_t>;
};
struct number {
  using Type = std::optional<double>;
};
struct amount {  // ≥ 0
  using Type = std::optional<double>;
};
struct time {  // > 0
  using Type = std::optional<double>;
};
struct fraction {  // 0 … 1
  using Type = std::optional<double>;
};
struct status {
  using Type = Status;
};
struct claim {  // a status, or none
  using Type = std::optional<Status>;
};
struct stop {  // older records have none: the target
  using Type = Stop;
};
struct contact {  // the contact solver, or none
  using Type = std::optional<ContactSolver>;
};
struct times {  // each > 0
  using Type = std::vector<double>;
};
struct stage_times {  // of every run: stage → seconds
  using Type = std::vector<std::map<std::string, double>>;
};
struct words {
  using Type = std::vector<std::string>;
};
struct words_by_word {
  using Type = std::map<std::string, std::string>;
};
// JSON as it is, of this shape, or null:
struct object {
  using Type = Json;
};
struct wholes_by_word {
  using Type = Json;
};
struct wholes_by_two_words {  // null for what is not known
  using Type = Json;
};
struct texts_by_word {
  using Type = Json;
};
struct numbers_by_word {  // lists; null for what is not finite
  using Type = Json;
};
struct grid {  // list of {r, rho, iterations, outcome}
  using Type = Json;
};
struct contact_ends {  // list of {face, from, to, x_mm, y_mm, low_mm, high_mm}
  using Type = Json;
};
struct steps {  // list of {claimed_status, error, resultants, numbers of contact points}
  using Type = Json;
};
struct attempts {  // list of {tolerance, claimed_status[, error_estimate][, error]}
  using Type = Json;
};

}  // namespace field_kind

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

struct Record;

struct Field {
  const char* name;
  const char* unit;     // "" : none; "1": a ratio
  unsigned use;         // FieldUse
  const char* label;    // of its series on the page; "": it has none
  const char* meaning;  // Markdown, one line
  Json (*value)(const Record& record);
  void (*clear)(Record& record);  // to its default
  // `place` and `key` are what a RecordError begins with.
  void (*read)(const Json& value, const std::string& place, const char* key, Record& record);
};

}  // namespace airybench
