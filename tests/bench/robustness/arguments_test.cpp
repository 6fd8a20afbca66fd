// What is wrong on the command line, in the environment's words and in records is refused before
// anything is measured: exit code 2, one short line, no output folder.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/numbers.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::arguments_test {
namespace {

using testing::BenchCommand;
using testing::CommandResult;

TEST(Numbers, AreReadWholeOrNotAtAll) {
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(parse_number("-2e-3"), -2e-3);
  EXPECT_EQ(parse_whole("10"), 10);
  EXPECT_EQ(parse_whole("-3"), -3);
  EXPECT_EQ(parse_whole("0"), 0);
  for (const char* text : {"", " 1", "1 ", "+1", "nan", "inf", "-inf", "1e999", "0x10", "1,5",
                           "1.5x", "1_000", "one"}) {
    EXPECT_FALSE(parse_number(text)) << text;
    EXPECT_FALSE(parse_whole(text)) << text;
  }
  for (const char* text : {"010", "00", "-01", "-0", "1.5", "1e3", "99999999999999999999"})
    EXPECT_FALSE(parse_whole(text)) << text;
}

struct Refusal {
  const char* arguments;
  const char* named;  // what the line must say
};

TEST(Arguments, ThatAreWrongAreRefusedInOneLine) {
  const BenchCommand bench;
  testing::write_text(bench.path("list.txt"), "");
  for (const auto& [arguments, named] : {
           Refusal{"--repetitions=010", "--repetitions: 010 (allowed: a whole number from 1"},
           {"--repetitions=0x10", "--repetitions: 0x10"},
           {"--repetitions=1e1", "--repetitions: 1e1"},
           {"--repetitions=3.0", "--repetitions: 3.0"},
           {"--threads=02", "--threads: 02"},
           {"--interleave --study=scaling", "--interleave: not with --study=scaling"},
           {"--tuning-budget=0", "--tuning-budget: 0 (allowed: a number above 0"},
           {"--budget=1", "--budget: only with --study=error"},
           {"--budget=1,x --study=error", "--budget: 1,x (allowed: numbers of seconds above 0"},
           {"--budget=0 --study=error", "--budget: 0 (allowed: "},
           {"--precision=2", "--precision: 2 (allowed: above 0% and below 100%, as 2%)"},
           {"--precision=0%", "--precision: 0% (allowed: "},
           {"--precision=100%", "--precision: 100% (allowed: "},
           {"--precision=nan%", "--precision: nan% (allowed: "},
           {"--precision=2% --max-repetitions=5", "--max-repetitions: 5 (allowed: from 6 on)"},
           {"--precision=2% --repetitions=9 --max-repetitions=8",
            "--max-repetitions: 8 (allowed: from 9 on)"},
           {"--max-repetitions=20", "--max-repetitions requires --precision"},
           {"--precision=2% --study=stability", "--precision: not with --study=stability"},
           {"--retry-noisy=5",
            "--retry-noisy: 5 (allowed: above 0% and below 100%, as 5%, or no value)"},
           {"--retry-noisy=0%", "--retry-noisy: 0% (allowed: "},
           {"--retry-noisy=", "--retry-noisy=: (allowed: a value behind the sign)"},
           {"--retry-noisy=x", "--retry-noisy: x (allowed: "},
           {"--memory-limit=0100", "--memory-limit: 0100"},
           {"--figure=03", "--figure: 03 (allowed: a whole number from 3 to 5)"},
           {"--timeout=nan", "--timeout: nan (allowed: a number above 0"},
           {"--timeout=inf", "--timeout: inf"},
           {"--long-case=nan", "--long-case: nan"},
           {"--target-error=nan", "--target-error: nan"},
           {"--target-error=+1e-6", "--target-error: +1e-6"},
           {"--shard=01/2", "--shard: 01/2"},
           {"--out= --mesh=Mesh0", "--out=: (allowed: a value behind the sign)"},
           {"--mesh= --out=o", "--mesh=: "},
           {"-- --benchmark_enable_random_interleaving=banana", "banana (allowed: true, false)"},
           {"-- --benchmark_enable_random_interleavingtrue", "allowed: "},
           {"-- --benchmark_context=cpu=mine", "cpu (allowed: another word; "},
           {"-- --benchmark_context=program_sha256=0", "program_sha256 (allowed: "},
           {"-- --benchmark_context=plan_sha256=0", "plan_sha256 (allowed: "},
           {"-- --benchmark_context=$(printf 'a=\\377')", "(allowed: key=value in UTF-8)"},
           {"compare a a --minimum-effect=nan", "--minimum-effect: nan (allowed: a number from 0"},
           {"compare a a --minimum-effect=inf", "--minimum-effect: inf"},
           {"compare a a --minimum-effect=1e999", "--minimum-effect: 1e999"},
           {"compare a a --out=", "--out=: "},
           {"track --minimum-effect=nan", "--minimum-effect: nan"},
           {"track --nights-after=04", "--nights-after: 04"},
           {"track --history= --from=a", "--history=: "},
       }) {
    const CommandResult result = bench.run(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_NE(result.err.find(named), std::string::npos) << arguments << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "") << arguments;
    for (const char* folder : {"results", "o", "--mesh=Mesh0"})
      EXPECT_FALSE(std::filesystem::exists(bench.path(folder))) << arguments;
  }
}

TEST(Arguments, AreQuotedAtMostEightyCharactersLong) {
  const BenchCommand bench;
  const std::string longish(5000, 'x');
  for (const char* option : {"--repetitions=", "--timeout=", "--mesh=", "--method=", "--shard=",
                             "--study=", "--stop=", "replay "}) {
    const CommandResult result = bench.run(option + longish);
    EXPECT_EQ(result.code, 2) << option;
    EXPECT_LT(result.err.size(), 1000u) << option;
  }
}

// Deep, wrong, long, of another type: one line that names the file's line and the key.
TEST(Records, ThatAreCorruptAreRefusedByEveryCommand) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=good").code, 0);
  const Json good = bench.records("good")[0];
  std::filesystem::create_directories(bench.path("bad"));
  int turn = 0;
  const auto refused = [&](const std::string& line, const std::string& named) {
    testing::write_text(bench.path("bad/records.jsonl"), line + "\n");
    for (const char* command :
         {"compare good bad", "claims bad", "export bad --format=csv", "merge bad --out=m",
          "replay bad:1 --out=r", "track --history=h --from=bad",
          "--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=bad --resume",
          "--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=bad --append"}) {
      if (testing::left_out(turn++)) continue;  // each meets others of the lines
      const CommandResult result = bench.run(command);
      EXPECT_EQ(result.code, 2) << command << ": " << line.substr(0, 80);
      EXPECT_NE(result.err.find("bad/records.jsonl:1: " + named), std::string::npos)
          << command << ": " << result.err;
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
      EXPECT_LT(result.err.size(), 600u);
    }
  };
  refused(std::string(100000, '[') + std::string(100000, ']'), "not JSON: ");
  refused("[1, 2]", "[1,2] (allowed: a JSON object)");
  refused("\"" + std::string(100000, 'x') + "\"", "\"xxx");
  refused("{\"mesh\": \"\377\"}", "not JSON: ");
  for (const auto& [key, value] :
       {std::pair<const char*, Json>("grid", Json::array({Json::object()})),
        {"memory_by_stage", Json::array()},
        {"memory_by_owner", Json{{"factor", 3}}},
        {"histories", Json{{"residual", "long"}}},
        {"stages_left_out", Json{{"contact", 3}}},
        {"scene_definition", "flat"},
        {"stage_samples", Json::array({3})},
        {"mesh", std::string(5000, 'x') + "/"},
        {"scene", "../up"},
        {"n_phi", -1},
        {"time_s", "fast"},
        {"iterative", 1}}) {
    Json record = good;
    record[key] = value;
    refused(record.dump(), std::string(key) + ": ");
  }
}

}  // namespace
}  // namespace airybench::arguments_test
