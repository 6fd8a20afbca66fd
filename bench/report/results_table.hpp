// The table of cases: on the terminal, and for papers.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

struct TableColumn;

// Which columns of the table the records fill.
class FilledColumns {
 public:
  void add(const Record& record);
  bool include(const TableColumn& column) const;

 private:
  std::set<std::string> fields_;  // that some record has
  bool has_contact_study_ = false;
};

// A cell has a number and its unit; remarks on the cases follow.
class ResultsTable {
 public:
  void add(const Record& record);
  std::string text() const;

 private:
  std::vector<std::string> rows_;  // the cells of all columns, each ended by a tab
  FilledColumns filled_;
  std::string imprecise_, noisy_;
  // Why a case is not ok, or a remark on one that is, which other cases of its scene may share.
  struct Reason {
    std::string scene;  // of a remark: "Mesh0/default"
    std::string case_name, text;
    int more_cases = 0;  // of the same remark
  };
  std::vector<Reason> reasons_;
  std::string reasons() const;
};

// The same cases for a paper: a column has one unit, in its header; no remarks.
struct PaperTable {
  struct Column {
    std::string header;  // "time, ms"
    bool is_flush_right;
  };
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;  // "29.2", "2.8e-11"; "-": no value
};

// chosen: headers with _ for a space; empty: the columns that the terminal shows. `case` comes
// first unless it, mesh, scene or method is chosen. Throws UsageError for an unknown one.
PaperTable paper_table(const std::vector<Record>& cases, const std::vector<std::string>& chosen);

std::string markdown_text(const PaperTable& table);
// For the package booktabs.
std::string latex_text(const PaperTable& table);

}  // namespace airybench
