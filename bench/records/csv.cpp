#include "bench/records/csv.hpp"

#include <fmt/format.h>

#include "bench/records/record_numbers.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

// Prefixes ' to a text that begins with ' or that a spreadsheet would evaluate as a formula.
std::string no_formula(std::string text) {
  if (text.find_first_of("=+-@\t\r'") == 0 && !parse_number(text)) text.insert(0, "'");
  return text;
}

std::string in_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string cell(const Json& value) {
  if (value.is_null()) return "";
  return value.is_string() ? csv_cell(value.get<std::string>()) : json_text(value);
}

}  // namespace

std::string csv_quoted(const std::string& text) { return in_quotes(no_formula(text)); }

std::string csv_cell(const std::string& given) {
  const std::string text = no_formula(given);
  return text.find_first_of(",\"\r\n") == text.npos ? text : in_quotes(text);
}

std::string csv_header() {
  std::string text;
  for (const Field* field : fields_with(column))
    text += (text.empty() ? "" : ",") + std::string(field->name);
  return text + "\n";
}

std::string csv_row(const Record& record) {
  std::string text, separator;
  for (const Field* field : fields_with(column))
    text += std::exchange(separator, ",") + cell(field->value(record));
  return text + "\n";
}

std::string series_csv(const std::vector<Record>& records) {
  std::string text = "date,revision,mesh,scene,method,stop,quantity,value\n";
  for (const Record& record : records) {
    std::string row;
    for (const std::string& word :
         {context_word(record, "date"), context_word(record, "git_revision"), record.mesh,
          record.scene, variant_of(record), std::string(name_of(record.stop))})
      row += cell(word) + ",";
    for (const auto& [name, value] : numbers_of(record))
      text += fmt::format("{}{},{}\n", row, name, value);
  }
  return text;
}

}  // namespace airybench
