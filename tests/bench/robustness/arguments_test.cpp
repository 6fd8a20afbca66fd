// What is wrong on the command line, in the environment's words and in records is refused before
// anything is measured: exit code 2, one short line, no output folder.
#include <gtest/gtest.h>

#include <fstream>

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
  std::string_view named;  // what the line must say; all of it where it ends with a newline
};

TEST(Arguments, ThatAreWrongAreRefusedInOneLine) {
  const BenchCommand bench;
  testing::write_text(bench.path("bad.json"), R"({"friction": -2})");
  testing::write_text(bench.path("four.json"), R"({"teeth": 4})");
  testing::write_text(bench.path("broken.msh"), "hello\n");
  for (const auto& [arguments, named] : {
           Refusal{"--repetitions=010", "--repetitions: 010 (allowed: a whole number from 1"},
           {"--interleave --study=scaling", "--interleave: not with --study=scaling"},
           {"claims o", "claims: is now ./run claims DIR (without ./run: python3 "},
           {"--tuning-budget=9", "--tuning-budget: is now --timeout=SECONDS,tuning=SECONDS"},
           {"--timeout=9,tuning=0", "--timeout: tuning: 0 (allowed: a number above 0"},
           {"--timeout=9,others=0", "--timeout: others: 0 (allowed: a number above 0"},
           {"--timeout=9,tuning=1,tuning=2",
            "--timeout: tuning=2 (allowed: tuning=, others=, once)"},
           {"--timeout=9,x=1", "--timeout: x=1 (allowed: tuning=, others=, once)"},
           {"--timeout=tuning=9", "--timeout: tuning=9 (allowed: one number, and settings)"},
           {"--study=contact:1", "--study: contact:1 (allowed: seconds with error"},
           {"--study=error:1,x", "--study=error: x (allowed: a number above 0"},
           {"--study=error:0", "--study=error: 0 (allowed: "},
           {"--repetitions=5,precision=2",
            "--repetitions: precision: 2 (allowed: above 0% and below 100%, as 2%)"},
           {"--repetitions=5,precision=0%", "--repetitions: precision: 0% (allowed: "},
           {"--repetitions=5,precision=100%", "--repetitions: precision: 100% (allowed: "},
           {"--repetitions=2..5,precision=2%", "--repetitions: at most 5 (allowed: from 6 on)"},
           {"--repetitions=9..8,precision=2%", "--repetitions: at most 8 (allowed: from 9 on)"},
           {"--repetitions=5..20", "--repetitions: 5..20 (allowed: a range with a precision"},
           {"--repetitions=5,precision=2% --study=stability",
            "--repetitions: precision: not with --study=stability"},
           {"--retry-noisy=5",
            "--retry-noisy: 5 (allowed: above 0% and below 100%, as 5%, or no value)"},
           {"--retry-noisy=0%", "--retry-noisy: 0% (allowed: "},
           {"--retry-noisy=", "--retry-noisy=: (allowed: a value behind the sign)"},
           {"--figure=03", "--figure: 03 (allowed: a whole number from 3 to 5)"},
           {"--timeout=nan", "--timeout: nan (allowed: a number above 0"},
           {"--repetitions=5,within=nan", "--repetitions: within: nan"},
           {"--target-error=nan", "--target-error: nan"},
           {"--shard=01/2", "--shard: 01/2"},
           {"--out= --mesh=Mesh0", "--out=: (allowed: a value behind the sign)"},
           {"--mesh= --out=o", "--mesh=: "},
           {"--repetitions=0", "--repetitions: 0"},
           {"--timeout=-1", "--timeout: -1"},
           {"--threads=0", "--threads: 0"},
           {"--target-error=0", "--target-error: 0"},
           {"--memory-limit=0", "--memory-limit: 0"},
           {"--wrong", "--wrong (valid: "},
           {"extra", "extra (valid: "},
           {"--mesh=nowhere.msh", "nowhere.msh: cannot be opened: No such file or directory\n"},
           {"--mesh=Mesh9", "mesh 'Mesh9': not in the catalogue (valid: Mesh0..Mesh7, "},
           {"--mesh=mesh0", "mesh 'mesh0': not in the catalogue, perhaps Mesh0 (valid: "},
           {"--mesh=broken.msh",
            std::filesystem::exists(testing::meshgen_executable())
                ? "broken.msh: no mesh (what can be read: *.geo, *.msh, "
                : "broken.msh:1: not a mesh file: the first line must be $MeshFormat\n"},
           {"--scene=nowhere.json", "nowhere.json: cannot be opened: No such file or directory\n"},
           {"--scene=bad.json", "bad.json: friction: -2 (allowed: 0 to 1e6)\n"},
           {"--mesh=Mesh0 --scene=four.json",
            "four.json: teeth: 4 contradicts the mesh Mesh0, which has 1 contact face(s)\n"},
           {"--method=4STEP", "no method matches '4STEP', perhaps 3STEPD (valid: SDTIC3, "},
           {"--method=hybrid", "no method matches 'hybrid', perhaps HYBRID (valid: "},
           {"--method=HYBRD", "no method matches 'HYBRD', perhaps HYBRID (valid: "},
           {"--metod=P2", "--metod=P2, perhaps --method (valid: "},
           {"solv part.geo", "solv: no such command, perhaps solve (allowed: solve, advise, "},
           {"sovle part.geo", "sovle: no such command, perhaps solve (allowed: solve, advise, "},
           {"--columns=speed", "--columns: no column is 'speed' (valid: all, case, "},
           {"profile Mesh0 --error=0%", "--error: 0% (allowed: above 0% and below 100%"},
           {"profile Mesh0 --degree=9", "--degree: 9 (allowed: "},
           {"solve part.geo --eror=1%", "--eror=1%, perhaps --error (valid: "},
           {"--figure=4 --mesh=Mesh0", "--mesh excludes --figure"},
           {"--figure=4 --method=3STEPD", "--method excludes --figure"},
           {"--figure=2", "--figure: 2 (allowed: a whole number from 3 to 5)"},
           {"--stop=wrong", "--stop: wrong"},
           {"--method=SYMMLQ:DTIC9", "'DTIC9' is no preconditioner (valid: DTIC3..DTIC6"},
           {"--method=SYMMLQ:", "'' is no preconditioner"},
           {"--method=ALM:r=0,rho=1", "r='0' (allowed: a number above 0)"},
           {"--method=ALM:r=1", "rho='' (allowed: a number above 0)"},
           {"--method=ALM:r=1,rho=inf", "rho='inf'"},
           {"--method=ALM:r=1,rho=1,r=2", "'r' is there twice"},
           {"--method=ALM:r=1,rho=1,s=2", "unknown option 's' (valid: r, rho)"},
           {"--method=3STEPCG:DTIC3,refine=3", "refine=3 (allowed: yes, no)"},
           {"--method=SYMMLQ:DTIC3,schur=sparse", "unknown option 'schur' (valid: refine)"},
           {"--method=BLIND:DTIC3", "no method matches 'BLIND:DTIC3'"},
           {"--method=3STEPD,,HYBRID", "no method matches ''"},
           {"-- --benchmark_enable_random_interleaving=banana", "banana (allowed: true, false)"},
           {"-- --benchmark_enable_random_interleavingtrue", "allowed: "},
           {"-- --benchmark_context=cpu=mine", "cpu (allowed: another word; "},
           {"-- --benchmark_context=program_sha256=0", "program_sha256 (allowed: "},
           {"-- --benchmark_context=plan_sha256=0", "plan_sha256 (allowed: "},
           {"-- --benchmark_context=$(printf 'a=\\377')", "(allowed: key=value in UTF-8)"},
           {"compare a a --minimum-effect=nan", "--minimum-effect: nan (allowed: a number from 0"},
           {"compare a a --out=", "--out=: "},
           {"track --minimum-effect=nan", "--minimum-effect: nan"},
           {"track --nights-after=04", "--nights-after: 04"},
           {"track --history= --from=a", "--history=: "},
       }) {
    bench.expect_refusal(arguments, named);
    for (const char* folder : {"results", "o", "--mesh=Mesh0"})
      EXPECT_FALSE(std::filesystem::exists(bench.path(folder))) << arguments;
  }
}

#ifndef AIRYBENCH_SANITIZED  // which needs more address space than any limit
TEST(Usage, ALackOfMemoryIsNotWrongUsage) {
  const BenchCommand bench;
  std::filesystem::create_directory(bench.path("big"));
  std::string values = "{}";  // of 3 bytes, which become 64
  for (int k = 0; k < 5'000'000; ++k) values += ",{}";
  testing::write_text(bench.path("big/records.jsonl"), R"({"values":[)" + values + "]}\n");
  const CommandResult result = bench.run("export big --format=csv", "ulimit -v 400000; ");
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(result.err, "bench: out of memory\n");
}
#endif

TEST(Usage, AnOutputFolderThatCannotBeMadeIsNamed) {
  const BenchCommand bench;
  testing::write_text(bench.path("taken"), "a file");
  bench.expect_refusal("--mesh=Mesh0 --repetitions=1 --out=taken/inside",
                       "taken/inside: cannot be made a folder: Not a directory\n");
}

TEST(Usage, ArgumentsThatCannotBeUsedLeaveEarlierResultsAlone) {
  const BenchCommand bench;
  bench.expect_ok("--mesh=Mesh0 --method=3STEPD --repetitions=1 --out=o");
  const std::string before = bench.results("o");
  for (const char* arguments :
       {"--no_such_option", "--benchmark_out=x", "--benchmark_report_aggregates_only=true",
        "--benchmark_filter=NoSuchCase", "--benchmark_list_tests"}) {
    bench.expect_refusal(std::string("--mesh=Mesh0 --repetitions=1 --out=o -- ") + arguments, "");
    EXPECT_EQ(bench.results("o"), before) << arguments;
  }
}

TEST(Usage, AppendToAMalformedFileIsRefusedBeforeAnythingIsRun) {
  const BenchCommand bench;
  bench.expect_ok("--mesh=Mesh0 --method=3STEPD --repetitions=1 --out=o");
  std::ofstream(bench.path("o/records.jsonl"), std::ios::app) << "{\"mesh\": \n";
  const std::string before = bench.results("o");
  bench.expect_refusal("--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=o --append",
                       "bench: o/records.jsonl:2: ");
  EXPECT_EQ(bench.results("o"), before);
}

// Deep, wrong, long, of another type: one line that names the file's line and the key. Every
// command meets some of them.
TEST(Records, ThatAreCorruptAreRefusedByEveryCommand) {
  const BenchCommand bench;
  bench.expect_ok("--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=good");
  const Json good = bench.records("good")[0];
  std::filesystem::create_directories(bench.path("bad"));
  const std::vector<std::string> commands = {
      "compare good bad",
      "export bad --format=csv",
      "merge bad --out=m",
      "replay bad:1 --out=r",
      "track --history=h --from=bad",
      "--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=bad --resume",
      "--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=bad --append"};
  std::size_t turn = 0;
  const auto refused = [&](const std::string& line, const std::string& named) {
    testing::write_text(bench.path("bad/records.jsonl"), line + "\n");
    for (const std::size_t ahead : {0, 3}) {
      const std::string& command = commands[(turn + ahead) % commands.size()];
      bench.expect_refusal(command, "bad/records.jsonl:1: " + named);
      EXPECT_LT(bench.content("err.txt").size(), 600u) << command;
    }
    ++turn;
  };
  refused(std::string(100000, '[') + std::string(100000, ']'), "not JSON: ");
  refused("[1, 2]", "[1,2] (allowed: a JSON object)");
  refused("\"" + std::string(100000, 'x') + "\"", "\"xxx");
  refused("{\"mesh\": \"\377\"}", "not JSON: ");
  for (const auto& [key, value] :
       {std::pair<const char*, Json>("contact_ends", Json::array({Json::object()})),
        {"memory_by_owner", Json{{"factor", 3}}},
        {"histories", Json{{"residual", "long"}}},
        {"stages_left_out", Json{{"contact", 3}}},
        {"scene_definition", "flat"},
        {"stage_samples", Json::array({3})},
        {"mesh", std::string(5000, 'x') + "/"},
        {"mesh", ""},
        {"scene", "../up"},
        {"method", 7},
        {"status", "fine"},
        {"stop", "mine"},
        {"n_phi", -1},
        {"n_phi", 2.5},
        {"peak_heap_bytes", -1},
        {"time_s", "fast"},
        {"time_s", 0},
        {"tuning_s", -1},
        {"samples_s", Json::array({1, -1})},
        {"done_fraction", 1.5},
        {"knob", 3},
        {"context", Json{{"date", 3}}},
        {"iterative", 1}}) {
    Json record = good;
    record[key] = value;
    refused(record.dump(), std::string(key) + ": ");
  }
}

}  // namespace
}  // namespace airybench::arguments_test
