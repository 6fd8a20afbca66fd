// The table of cases: on the terminal, and for papers.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

struct TableColumn;

// The columns of the table that the records fill, in its order.
class FilledColumns {
 public:
  void add(const Record& record);
  std::vector<const TableColumn*> all() const;
  std::vector<const TableColumn*> of_lowest_rank() const;  // at most eight

 private:
  std::set<std::string> fields_;  // that some record has
  bool has_contact_study_ = false;
};

// chosen: headers with _ for a space, or "all" that have values; empty: the eight of the lowest
// rank among these, and the names of the others. `case` comes first unless it, mesh, scene or
// method is chosen. Throws UsageError for an unknown one.

// A cell has a number and its unit; remarks on the cases follow.
class ResultsTable {
 public:
  explicit ResultsTable(const std::vector<std::string>& chosen = {});
  void add(const Record& record);
  std::string text() const;

 private:
  std::vector<std::string> chosen_;
  std::vector<const TableColumn*> kept_;  // that may be shown
  std::vector<std::string> rows_;         // their cells, each ended by a tab
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

PaperTable paper_table(const std::vector<Record>& cases, const std::vector<std::string>& chosen);

std::string markdown_text(const PaperTable& table);
// For the package booktabs.
std::string latex_text(const PaperTable& table);

}  // namespace airybench
