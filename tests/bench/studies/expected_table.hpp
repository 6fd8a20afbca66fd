// A committed table of what runs gave, which tests compare with. With AIRYBENCH_UPDATE=anew in the
// environment tests note what they find instead, with AIRYBENCH_UPDATE=widen they let the table's
// values include it, and the table is written when the program ends. tests/update_tables.sh does
// both, under several kernels of OpenBLAS.
//
// The file: '#' lines, a header, rows of comma-separated fields; a field with a comma is quoted.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace airybench::testing {

enum class Update { no, anew, widen };

inline Update update() {
  const char* value = std::getenv("AIRYBENCH_UPDATE");
  if (value == nullptr) return Update::no;
  const std::string word = value;
  if (word == "anew") return Update::anew;
  if (word == "widen") return Update::widen;
  throw std::invalid_argument("AIRYBENCH_UPDATE: " + word + " (allowed: anew, widen)");
}

class ExpectedTable : public ::testing::Environment {
 public:
  using Row = std::vector<std::string>;

  // keys: so many leading fields name a row.
  ExpectedTable(std::filesystem::path file, std::size_t keys) : file_(std::move(file)) {
    std::ifstream in(file_);
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("#") || !has_header_) {
        has_header_ = has_header_ || !line.starts_with("#");
        head_ += line + "\n";
        continue;
      }
      const Row fields = split(line);
      const auto middle = fields.begin() + static_cast<std::ptrdiff_t>(keys);
      rows_[Row(fields.begin(), middle)] = Row(middle, fields.end());
    }
  }
  const std::map<Row, Row>& rows() const { return rows_; }
  const Row* find(const Row& key) const {
    const auto found = rows_.find(key);
    return found == rows_.end() ? nullptr : &found->second;
  }
  void note(const Row& key, const Row& values) { rows_[key] = values; }
  void forget(const std::string& first_key) {
    std::erase_if(rows_, [&](const auto& row) { return row.first.front() == first_key; });
  }
  void TearDown() override {
    if (update() == Update::no) return;
    std::ofstream out(file_);
    out << head_;
    for (const auto& [key, values] : rows_) {
      Row row = key;
      row.insert(row.end(), values.begin(), values.end());
      for (std::size_t i = 0; i < row.size(); ++i) out << (i > 0 ? "," : "") << quoted(row[i]);
      out << "\n";
    }
    ASSERT_TRUE(out.flush()) << file_;
  }

 private:
  static std::string quoted(const std::string& field) {
    return field.find(',') == field.npos ? field : '"' + field + '"';
  }
  static Row split(const std::string& line) {
    Row fields(1);
    bool inside = false;
    for (const char c : line) {
      if (c == '"')
        inside = !inside;
      else if (c == ',' && !inside)
        fields.emplace_back();
      else
        fields.back() += c;
    }
    return fields;
  }

  std::filesystem::path file_;
  std::string head_;  // what stands above the rows
  bool has_header_ = false;
  std::map<Row, Row> rows_;
};

}  // namespace airybench::testing
