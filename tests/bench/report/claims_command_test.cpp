// Which records `bench claims` takes, what it writes, what it refuses.
#include "tests/bench/report/claims_of_records.hpp"

namespace airybench::claims_command_test {
namespace {

using Result = testing::CommandResult;

class ClaimsCommand : public testing::ClaimsOfRecords {};

TEST_F(ClaimsCommand, StopsAreKeptApartButForDirectMethods) {
  add("Mesh0", "BLIND", 3);
  add("Mesh0", "3STEPD", 1);
  add("Mesh0", "ALM", 2);
  add("Mesh0", "ALM", 0.9)["stop"] = "paper";
  EXPECT_EQ(verdict(7), "not reproduced");
  EXPECT_EQ(verdict(7, "--stop=target"), "not reproduced");
  EXPECT_EQ(verdict(7, "--stop=paper"), "reproduced");
  EXPECT_EQ(verdict(10, "--stop=paper"), "reproduced");
  add("Mesh0", "3STEPD", 5)["stop"] = "paper";  // its own record of that stop goes before
  EXPECT_EQ(verdict(10, "--stop=paper"), "not reproduced");
  EXPECT_EQ(verdict(10), "reproduced");
}

TEST_F(ClaimsCommand, OneSceneCounts) {
  add("Mesh0", "3STEPD", 1)["scene"] = "flat";
  add("Mesh0", "BLIND", 3)["scene"] = "flat";
  EXPECT_EQ(verdict(10), "reproduced");
  EXPECT_NE(claims().out.find("stop target, scene flat"), std::string::npos);
  add("Mesh0", "3STEPD", 1)["scene"] = "smooth";
  EXPECT_EQ(claims().err,
            "bench: ./records.jsonl: scene: flat and smooth (allowed: default among them, or one "
            "scene alone)\n");
  add("Mesh0", "3STEPD", 4);
  add("Mesh0", "BLIND", 3);
  EXPECT_EQ(verdict(10), "not reproduced");
}

TEST_F(ClaimsCommand, PreconditionersAreComparedOnTheMeshWithMostOfThem) {
  add_levels("SYMMLQ", "FLIC", 1, {9, 7, 5, 6, 8});
  add("Mesh0", "SSKY", 1);
  EXPECT_NE(claims().out.find("preconditioners on Mesh3\n"), std::string::npos);
  for (Json& record : records_) record["mesh"] = "Mesh1";
  EXPECT_NE(claims().out.find("preconditioners on Mesh1\n"), std::string::npos);
}

TEST_F(ClaimsCommand, NoRecordsDecideNothing) {
  const Result result = claims();
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.out.find("0 cases, stop target, scene default, preconditioners on no mesh"),
            std::string::npos);
  for (int number = 1; number <= 10; ++number) EXPECT_EQ(verdict(number), "undecided") << number;
}

TEST_F(ClaimsCommand, WritesAMarkdownTable) {
  add("Mesh0", "3STEPD", 1);
  add("Mesh0", "BLIND", 3);
  ASSERT_EQ(claims("--out=table.md").code, 0);
  const std::string table = bench_.content("table.md");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2 + 2 + 10);
  EXPECT_NE(table.find("| 10 | Blind condensation is too expensive (3.2.1); here: slower than "
                       "3STEPD | BLIND/3STEPD: Mesh0 3 s/1 s = 3 | BLIND/3STEPD on 1 mesh 3 | "
                       "**reproduced** |\n"),
            std::string::npos)
      << table;
}

TEST_F(ClaimsCommand, WrongUsageIsOneLine) {
  add("Mesh0", "3STEPD", 1);
  ASSERT_EQ(claims().code, 0);
  EXPECT_EQ(run("claims --help").code, 0);
  EXPECT_NE(run("claims --help").out.find("bench claims"), std::string::npos);
  EXPECT_EQ(run("claims").err, "bench: DIR is required\n");
  EXPECT_EQ(
      run("claims nowhere").err,
      "bench: nowhere/records.jsonl: no such file (a folder that bench --out wrote has it)\n");
  EXPECT_EQ(run("claims . --out=table.csv").err,
            "bench: --out: table.csv (allowed: a name that ends in .md)\n");
  for (const char* arguments : {"", "nowhere", ". --stop=mine", ". --wrong", ". more",
                                ". --out=table.csv", ". --out=nowhere/table.md"}) {
    const Result result = run(std::string("claims ") + arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "") << arguments;
  }
}

TEST_F(ClaimsCommand, MalformedRecordsAreNamedByLineKeyAndValue) {
  const Json good = add("Mesh0", "3STEPD", 1);
  const auto expect_bad = [&](const char* key, const Json& value, const std::string& complaint) {
    Json bad = good;
    bad[key] = value;
    expect_refused(good.dump() + "\n" + bad.dump() + "\n", std::string(":2: ") + key + complaint);
  };
  const std::string text =
      " (allowed: a text that is not empty, without / and control "
      "characters)";
  expect_bad("mesh", "", ": \"\"" + text);
  expect_bad("scene", nullptr, ": null" + text);
  expect_bad("method", 7, ": 7" + text);
  expect_bad("status", "fine",
             ": \"fine\" (allowed: ok, inaccurate, unstressed, not_converged, breakdown, timeout, "
             "out_of_memory, crashed, machine_fault, skipped)");
  expect_bad("stop", "mine", ": \"mine\" (allowed: target, paper, null)");
  expect_bad("time_s", 0, ": 0 (allowed: a number > 0, null)");
  expect_bad("time_s", "1", ": \"1\" (allowed: a number > 0, null)");
  expect_bad("tuning_s", -1, ": -1 (allowed: a number >= 0, null)");
  expect_bad("samples_s", {1, -1}, ": -1 (allowed: numbers > 0)");
  expect_bad("samples_s", 1, ": 1 (allowed: a list of numbers > 0)");
  expect_bad("done_fraction", 1.5, ": 1.5 (allowed: a number from 0 to 1, null)");
  expect_bad("storage_bytes", 0.5, ": 0.5 (allowed: a whole number from 0 to 2^60, null)");
  expect_bad("peak_heap_bytes", -1, ": -1 (allowed: a whole number from 0 to 2^60, null)");
  expect_refused(good.dump() + "\n[1]\n", ":2: [1] (allowed: a JSON object)");
  const std::string cut = good.dump().substr(0, 40);
  testing::write_text(bench_.path("records.jsonl"), good.dump() + "\n" + cut + "\n");
  Result result = run("claims .");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err.rfind("bench: ./records.jsonl:2: not JSON: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  // The last line of a run that was ended while it wrote.
  testing::write_text(bench_.path("records.jsonl"), good.dump() + "\n" + cut);
  result = run("claims .");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("1 cases"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace airybench::claims_command_test
