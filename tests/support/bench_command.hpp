// The bench command from outside, in a temporary folder.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "bench/records/json.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::testing {

struct CommandResult {
  int code = -1;  // -1: ended by a signal
  std::string out, err;
};

class BenchCommand {
 public:
  BenchCommand() {}  // not `= default`: Clang has no constants of such a class
  // before: what the shell does first, "ulimit -f 8; ".
  CommandResult run(const std::string& arguments, const std::string& before = "") const {
    std::string command = "cd '";
    command += folder_.path().string();
    command += "' && ";
    command += before;
    command += "'" + bench_executable().string() + "' ";
    command += arguments;
    command += " >out.txt 2>err.txt </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content("out.txt"), content("err.txt")};
  }
  // Exit code 0.
  CommandResult expect_ok(const std::string& arguments, const std::string& before = "") const {
    CommandResult result = run(arguments, before);
    EXPECT_EQ(result.code, 0) << arguments << ": " << result.err << result.out;
    return result;
  }
  // Exit code 2, nothing on standard output, and one line on standard error that has `named` in it,
  // or is `named` where that ends with a newline.
  void expect_refusal(const std::string& arguments, std::string_view named,
                      const std::string& before = "") const {
    const CommandResult result = run(arguments, before);
    SCOPED_TRACE(arguments + ": " + result.err);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("bench: "));
    EXPECT_TRUE(contains(result.err, named));
    if (named.ends_with('\n')) {
      EXPECT_EQ(result.err, "bench: " + std::string(named));
    }
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1);
  }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::string content(const std::string& name) const { return text_of(folder_ / name); }
  std::string results(const std::string& folder) const {  // records and both summaries
    std::string all;
    for (const char* name : {"/records.jsonl", "/results.csv", "/results.json"})
      all += content(folder + name);
    return all;
  }
  // Of a folder that has one.
  Json record(const std::string& folder = "o") const {
    const std::vector<Json> all = records(folder);
    EXPECT_EQ(all.size(), 1u) << folder;
    return all.at(0);
  }
  // The whole lines of a records.jsonl.
  std::vector<Json> records(const std::string& folder = "o") const {
    std::vector<Json> result;
    std::istringstream lines(content(folder + "/records.jsonl"));
    for (std::string line; std::getline(lines, line) && !lines.eof();)
      result.push_back(Json::parse(line));
    return result;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace airybench::testing
