// Records made up for `bench claims`, and what it says of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "bench/plan/blank_record.hpp"
#include "bench/records/json.hpp"
#include "solvers/methods.hpp"
#include "tests/support/bench_command.hpp"

namespace airybench::testing {

class ClaimsOfRecords : public ::testing::Test {
 protected:
  // An ok record with three samples, which its caller may change.
  Json& add(const std::string& mesh, const std::string& method, double time_s) {
    records_.push_back({{"mesh", mesh},
                        {"scene", "default"},
                        {"method", method},
                        {"status", "ok"},
                        {"stop", "target"},
                        {"time_s", time_s},
                        {"samples_s", {time_s * 0.99, time_s, time_s * 1.01}},
                        {"stage_contact_s", time_s / 1000},
                        {"peak_heap_bytes", 1000},
                        {"storage_bytes", 1000}});
    Record described;
    describe(select_methods(method).front(), described);
    for (const char* name : {"general_name", "family", "preconditioner", "iterative", "in_paper"})
      records_.back()[name] = field_named(name).value(described);
    if (described.family != "ALM") records_.back()["stage_condense_s"] = time_s / 2;
    return records_.back();
  }
  void add_timeout(const std::string& mesh, const std::string& method, double spent_s,
                   double whole_s) {
    fail(add(mesh, method, 1), "timeout");
    records_.back()["done_fraction"] = spent_s / whole_s;
    records_.back()["extrapolated_time_s"] = whole_s;
  }
  static void fail(Json& record, const std::string& status) {
    for (const char* key : {"time_s", "peak_heap_bytes", "stage_contact_s"}) record[key] = nullptr;
    record["samples_s"] = Json::array();
    record["status"] = status;
  }
  // Times of FAMILY:PRECONDITIONERx with x from `first` on, on Mesh3.
  void add_levels(const std::string& family, const std::string& preconditioner, int first,
                  const std::vector<double>& times_s) {
    for (const double time_s : times_s)
      add("Mesh3", family + ":" + preconditioner + std::to_string(first++), time_s);
  }
  Json& record(const std::string& mesh, const std::string& method) {
    return *std::find_if(records_.begin(), records_.end(),
                         [&](const Json& r) { return r["mesh"] == mesh && r["method"] == method; });
  }

  CommandResult run(const std::string& arguments) const { return bench_.run(arguments); }
  CommandResult claims(const std::string& arguments = "") const {
    std::string lines;
    for (const Json& record : records_) lines += record.dump() + "\n";
    write_text(bench_.path("records.jsonl"), lines);
    return run("claims . " + arguments);
  }
  // The lines of one claim: verdict, sentence, what it rests on.
  std::string claim(int number, const std::string& arguments = "") const {
    const CommandResult result = claims(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    std::string head = number < 10 ? " " : "";
    head += std::to_string(number) + "  ";
    std::istringstream lines(result.out);
    std::string text;
    for (std::string line; std::getline(lines, line);)
      if (text.empty() ? line.rfind(head, 0) == 0 : line.rfind("    ", 0) == 0)
        text += text.empty() ? line.substr(head.size()) + "\n" : line + "\n";
      else if (!text.empty())
        break;
    EXPECT_NE(text, "") << result.out;
    return text;
  }
  std::string verdict(int number, const std::string& arguments = "") const {
    const std::string text = claim(number, arguments);
    return text.substr(0, text.find("  "));
  }
  void expect_open(int number, const std::string& reason) const {
    EXPECT_EQ(verdict(number), "undecided") << claim(number);
    EXPECT_NE(claim(number).find("open      " + reason), std::string::npos) << claim(number);
  }
  void expect_refused(const std::string& records, const std::string& complaint) const {
    write_text(bench_.path("records.jsonl"), records);
    const CommandResult result = run("claims . --out=table.md");
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, "bench: ./records.jsonl" + complaint + "\n");
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(std::filesystem::exists(bench_.path("table.md")));
  }

  const BenchCommand bench_;
  std::vector<Json> records_;
};

}  // namespace airybench::testing
