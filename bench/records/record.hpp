// One case's record: everything that a line of the output says. Its fields, with their meaning, are
// in record_fields.def.
#pragma once

#include <string>
#include <vector>

#include "bench/records/case_name.hpp"
#include "bench/records/field.hpp"
#include "support/errors.hpp"

namespace airybench {

// The defaults are those of a case that did not run.
struct Record {
#define FIELD(kind, name, unit, use, label, meaning) field_kind::kind::Type name{};
#include "bench/records/record_fields.def"
  Record() { status = Status::crashed; }
};

// In the order of record_fields.def.
const std::vector<Field>& record_fields();
// Those that have all of these uses.
std::vector<const Field*> fields_with(unsigned uses);
const Field* find_field(const std::string& name);   // nullptr: none is named so
const Field& field_named(const std::string& name);  // throws std::out_of_range

// Empty: it has none, or is no number.
std::optional<double> number_in(const Record& record, const Field& field);

// A line of records.jsonl; its first keys are the columns.
Json to_json(const Record& record);
// The fields that all of these uses have: those of a night, say.
Json to_json(const Record& record, unsigned uses);

// What cannot be used in a record or a file of records; what() is one line: file, line number, key,
// value, what is allowed.
struct RecordError : FileError {
  using FileError::FileError;
};

// to_json() of the result is the JSON again. Keys that are no fields are passed over; those that
// are missing keep their defaults, and general_name and family follow from the method's name where
// a record is older than they are. `place` is what a RecordError begins with.
Record record_of(const Json& json, const std::string& place);
// The same of a line's text, without all of its JSON in between.
Record record_of_text(const std::string& text, const std::string& place);
// A line's JSON. Throws RecordError: it is none.
Json json_of_text(const std::string& text, const std::string& place);

CaseName name_of(const Record& record);

// Of the run's context; "": it has none.
std::string context_word(const Record& record, const std::string& key);

// Has the verifier seen it?
bool is_verified(const Record& record);

// Has it an answer whose time and memory are worth taking? Also one that was cut short on purpose.
bool is_measured(const Record& record);

}  // namespace airybench
