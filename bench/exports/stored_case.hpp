// A measured case as it is stored: a line of records.jsonl, or a case in a night of a history.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/records/json.hpp"

namespace airybench {

struct StoredCase {
  std::string mesh, scene;
  std::string method;  // with what tells cases of a method apart: "ALM/stop=paper"
  std::string stop;    // "target" or "paper"
  std::string status, status_reason;
  std::vector<double> samples_s;
  std::optional<double> time_s;  // their median
  // Of time_s: the stored interval, else median ± median absolute deviation.
  std::optional<double> time_low_s, time_high_s;
  std::vector<std::pair<std::string, double>> quantities;  // every number, in the order stored
  std::map<std::string, std::string> context;              // where and with what; "date"

  std::string name() const { return mesh + "/" + scene + "/" + method; }
  std::optional<double> quantity(const std::string& key) const;
};

// `place` is for messages: "records.jsonl:3". Throws RecordError.
StoredCase stored_case(const Json& record, const std::string& place);

// The cases of DIR/records.jsonl. Throws RecordError, OutputError.
std::vector<StoredCase> stored_run(const std::filesystem::path& folder);

// The cases of all DIR/nights/*.json by date, each with its night's context. Throws RecordError.
std::vector<StoredCase> stored_history(const std::filesystem::path& folder);

}  // namespace airybench
