// `bench export`: every format is read back, from records made up for what could break it.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "bench/records/csv.hpp"
#include "bench/records/google_benchmark.hpp"
#include "bench/records/json.hpp"
#include "bench/records/record.hpp"
#include "bench/records/record_numbers.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/records/robust.hpp"
#include "tests/support/bench_command.hpp"

namespace airybench::export_test {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;
using testing::write_text;

const std::string allowed_statuses =
    "(allowed: ok, inaccurate, unstressed, not_converged, breakdown, timeout, out_of_memory, "
    "crashed, machine_fault, skipped)";

Json record(const std::string& method, const std::vector<double>& samples_s) {
  Json json = {{"mesh", "Mesh0"},
               {"scene", "default"},
               {"method", method},
               {"status", samples_s.empty() ? "timeout" : "ok"},
               {"status_reason", nullptr},
               {"n_phi", 761},
               {"threads", 2},
               {"repetitions", samples_s.size()},
               {"time_s", nullptr},
               {"stage_factor_s", 0.25},
               {"peak_heap_bytes", 1048576},
               {"linear_iterations", nullptr},
               {"stop", "target"},
               {"error_stress", 1e-12},
               {"error_force", 0.0},
               {"samples_s", samples_s},
               {"measured_once", false},
               {"context", {{"date", "2026-01-02T03:04:05Z"}, {"git_revision", "abc"}}}};
  if (!samples_s.empty()) json["time_s"] = median(samples_s);
  return json;
}

std::vector<Record> records_of(const std::vector<Json>& records) {
  std::vector<Record> cases;
  for (const Json& json : records) cases.push_back(record_of(json, "made up"));
  return cases;
}

// What breaks quoting in one of the formats, and an "é" of two bytes.
const std::string awkward = "a \"b\" <c> & 'd', e\n\x01\tf\\ é";

Json awkward_record() {
  Json json = record("ALM:r=1,rho=2", {});
  json["scene"] = "wall, <new>";
  json["status_reason"] = awkward;
  json["context"]["cpu"] = awkward;
  return json;
}

TEST(Exports, TheIntervalIsTheStoredOneElseTheDeviation) {
  Json json = record("HYBRID", {1, 2, 4});
  const auto ends = [&] {
    const Interval interval = time_interval(record_of(json, "made up"));
    return std::pair(interval.low, interval.high);
  };
  EXPECT_EQ(ends(), std::pair(1., 3.));  // 2 ± 1
  json["time_low_s"] = 1.5;
  json["time_high_s"] = 2.25;
  EXPECT_EQ(ends(), std::pair(1.5, 2.25));
}

TEST(Exports, WrongValuesAreNamedWithTheirPlace) {
  const auto message = [](const char* key, const Json& value) -> std::string {
    Json json = record("HYBRID", {1});
    json[key] = value;
    try {
      record_of(json, "records.jsonl:3");
    } catch (const RecordError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("status", 7), "records.jsonl:3: status: 7 " + allowed_statuses);
  EXPECT_EQ(message("mesh", nullptr),
            "records.jsonl:3: mesh: null (allowed: a text that is not empty, without / and control "
            "characters)");
  EXPECT_EQ(message("time_s", "1"), "records.jsonl:3: time_s: \"1\" (allowed: a number > 0, null)");
  EXPECT_EQ(message("samples_s", {1, "x"}),
            "records.jsonl:3: samples_s: \"x\" (allowed: numbers > 0)");
  EXPECT_EQ(message("context", {{"cpu", 1}}),
            "records.jsonl:3: context: {\"cpu\":1} (allowed: an object of texts)");
}

Json google(const std::vector<Json>& records) {
  return Json::parse(google_benchmark_json(records_of(records)));
}

TEST(GoogleBenchmark, ARunPerSampleAndAggregates) {
  const Json json = google({record("HYBRID", {0.002, 0.004, 0.003})});
  const Json& runs = json.at("benchmarks");
  ASSERT_EQ(runs.size(), 7u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(runs[k].at("name"), "Mesh0/default/HYBRID/iterations:1/manual_time");
    EXPECT_EQ(runs[k].at("run_type"), "iteration");
    EXPECT_EQ(runs[k].at("repetition_index"), k);
    EXPECT_EQ(runs[k].at("repetitions"), 3);
    EXPECT_EQ(runs[k].at("threads"), 2);
    EXPECT_EQ(runs[k].at("time_unit"), "ms");
    EXPECT_EQ(runs[k].at("peak_heap_bytes"), 1048576);
    EXPECT_EQ(runs[k].at("stage_factor_s"), 0.25);
    EXPECT_FALSE(runs[k].contains("time_s"));
    EXPECT_FALSE(runs[k].contains("linear_iterations"));
  }
  EXPECT_DOUBLE_EQ(runs[1].at("real_time").get<double>(), 4);
  const double values[] = {3, 3, 1, 1 / 3.0};  // ms, and the fraction
  const char* names[] = {"mean", "median", "stddev", "cv"};
  for (int k = 0; k < 4; ++k) {
    const Json& run = runs[3 + k];
    EXPECT_EQ(run.at("run_type"), "aggregate");
    EXPECT_EQ(run.at("aggregate_name"), names[k]);
    EXPECT_EQ(run.at("aggregate_unit"), k < 3 ? "time" : "percentage");
    EXPECT_NEAR(run.at("real_time").get<double>(), values[k], 1e-12) << names[k];
  }
  EXPECT_EQ(json.at("context").at("date"), "2026-01-02T03:04:05Z");
  for (const char* key : {"host_name", "num_cpus", "mhz_per_cpu", "caches", "load_avg"})
    EXPECT_TRUE(json.at("context").contains(key)) << key;
}

TEST(GoogleBenchmark, OneSampleHasNoAggregates) {
  const Json json = google({record("HYBRID", {0.5})});
  ASSERT_EQ(json.at("benchmarks").size(), 1u);
  EXPECT_EQ(json.at("benchmarks")[0].at("real_time"), 500);
}

TEST(GoogleBenchmark, CasesWithoutSamplesAreErrors) {
  const Json json = google({awkward_record()});
  ASSERT_EQ(json.at("benchmarks").size(), 1u);
  const Json& run = json.at("benchmarks")[0];
  EXPECT_EQ(run.at("error_occurred"), true);
  EXPECT_EQ(run.at("error_message"), "timeout: a \"b\" <c> & 'd', e\n \tf\\ é");
  EXPECT_EQ(run.at("run_name"), "Mesh0/wall, <new>/ALM:r=1,rho=2/iterations:1/manual_time");
}

TEST(GoogleBenchmark, NoRecordsAreAnEmptyList) { EXPECT_TRUE(google({}).at("benchmarks").empty()); }

TEST(SeriesCsv, ARowPerNumber) {
  EXPECT_EQ(series_csv({}), "date,revision,mesh,scene,method,stop,quantity,value\n");
  const std::string text = series_csv(records_of({awkward_record()}));
  EXPECT_NE(text.find("\n2026-01-02T03:04:05Z,abc,Mesh0,\"wall, <new>\",\"ALM:r=1,rho=2\",target,"
                      "peak_heap_bytes,1048576\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("linear_iterations"), std::string::npos);
  EXPECT_EQ(text.find("measured_once"), std::string::npos);
}

// A spreadsheet takes a text that begins so for a formula.
TEST(Csv, TextsAreNoFormulas) {
  for (const auto& [scene, cell] : {std::pair("=1+1", "'=1+1"),
                                    {"+a", "'+a"},
                                    {"-a", "'-a"},
                                    {"@SUM(1)", "'@SUM(1)"},
                                    {"=a,b", "\"'=a,b\""},
                                    {"'a", "''a"},
                                    {"-5", "-5"},
                                    {"a=b", "a=b"}}) {
    Json json = record("HYBRID", {1});
    json["scene"] = scene;
    const std::string expected = std::string("Mesh0,") + cell + ",HYBRID,";
    EXPECT_TRUE(csv_row(records_of({json}).front()).starts_with(expected)) << scene;
    EXPECT_NE(series_csv(records_of({json})).find(std::string(",Mesh0,") + cell + ",HYBRID,"),
              std::string::npos)
        << scene;
  }
}

class ExportCommand : public ::testing::Test {
 protected:
  int run(const std::string& arguments) {
    result_ = bench_.run("export " + arguments);
    return result_.code;
  }
  const testing::BenchCommand bench_;
  testing::CommandResult result_;
};

TEST_F(ExportCommand, WritesEveryFormat) {
  write_text(bench_.path("records.jsonl"), record("HYBRID", {1}).dump() + "\n");
  for (const char* format : {"google-benchmark", "csv", "markdown", "latex"}) {
    EXPECT_EQ(run(std::string(". --format=") + format), 0) << result_.err;
    const std::string printed = result_.out;
    EXPECT_NE(printed.find("Mesh0"), std::string::npos) << format;
    EXPECT_EQ(run(std::string(". --out=file --format=") + format), 0) << result_.err;
    EXPECT_EQ(result_.out, "");
    EXPECT_EQ(bench_.content("file"), printed);
  }
}

TEST_F(ExportCommand, TheSeriesOfAHistoryIsInOrderOfDate) {
  fs::create_directory(bench_.path("nights"));
  const auto night = [&](const char* file, const char* date, double peak) {
    Json one = record("HYBRID", {1});
    one["peak_heap_bytes"] = peak;
    one.erase("context");
    const Json json = {{"format", "airybench-night-1"},
                       {"date", date},
                       {"context", {{"git_revision", "r" + std::string(file)}}},
                       {"noise", {{"samples_s", Json::array()}}},
                       {"cases", {one}},
                       {"verdicts", Json::array()},
                       {"failed", false}};
    write_text(bench_.path("nights/" + std::string(file) + ".json"), json.dump(1));
  };
  night("a", "2026-01-02T00:00:00Z", 2);
  night("b", "2026-01-01T00:00:00Z", 1);
  ASSERT_EQ(run(". --format=csv"), 0) << result_.err;
  const auto first =
      result_.out.find("2026-01-01T00:00:00Z,rb,Mesh0,default,HYBRID,target,peak_heap_bytes,1\n");
  const auto second =
      result_.out.find("2026-01-02T00:00:00Z,ra,Mesh0,default,HYBRID,target,peak_heap_bytes,2\n");
  EXPECT_LT(first, second);
  EXPECT_NE(second, std::string::npos) << result_.out;
}

TEST_F(ExportCommand, MeshesMethodsAndColumnsAreChosen) {
  Json other = record("ALM:r=1,rho=2", {2});
  other["mesh"] = "Mesh1";
  write_text(bench_.path("records.jsonl"), record("HYBRID", {1}).dump() + "\n" +
                                               record("ALM:r=1,rho=2", {3}).dump() + "\n" +
                                               other.dump() + "\n");
  const auto chosen = [&](const std::string& arguments) {
    EXPECT_EQ(run(". --format=markdown --columns=mesh,method,time " + arguments), 0) << result_.err;
    std::istringstream lines(result_.out);
    std::string rows, line;
    for (int number = 0; std::getline(lines, line); ++number)
      if (number >= 2) rows += line;
    return rows;
  };
  EXPECT_EQ(chosen("--method='ALM:r=1,rho=2'"),
            "| Mesh0 | ALM:r=1,rho=2 | 3.00 || Mesh1 | ALM:r=1,rho=2 | 2.00 |");
  EXPECT_EQ(chosen("--method='A*,HYB*' --mesh='*0'"),
            "| Mesh0 | HYBRID | 1.00 || Mesh0 | ALM:r=1,rho=2 | 3.00 |");
  EXPECT_EQ(run(". --format=csv --mesh=Mesh1"), 0);
  EXPECT_EQ(result_.out.find("Mesh0"), std::string::npos);
}

TEST_F(ExportCommand, HelpNamesEveryColumn) {
  write_text(bench_.path("records.jsonl"), record("HYBRID", {1}).dump() + "\n");
  ASSERT_EQ(run(". --format=latex --columns=x"), 2);
  std::string valid = result_.err.substr(result_.err.find("valid: ") + 7);
  valid.resize(valid.find(')'));
  ASSERT_EQ(run("--help"), 0);
  std::istringstream words(result_.out);
  std::string help, word;
  while (words >> word) help += " " + word;
  EXPECT_NE(help.find("Columns " + valid + ";"), std::string::npos) << valid << "\n" << help;
}

TEST_F(ExportCommand, WrongInputIsOneLineAndNothingIsWritten) {
  const auto expect_line = [&](const std::string& arguments, const std::string& line) {
    EXPECT_EQ(run(arguments + " --out=file"), 2) << arguments;
    EXPECT_EQ(result_.err, "bench: " + line + "\n");
    EXPECT_FALSE(fs::exists(bench_.path("file")));
  };
  expect_line("nowhere --format=csv",
              "nowhere/records.jsonl: no such file (a folder that bench --out wrote has it)");
  write_text(bench_.path("records.jsonl"), record("HYBRID", {1}).dump() + "\n");
  expect_line(". --format=csv --columns=time",
              "--columns: not with --format=csv (markdown and latex have them)");
  expect_line(". --format=latex --method='P*'", "--method: no case has 'P*' (there are: HYBRID)");
  EXPECT_EQ(run(". --format=xml"), 2);
  EXPECT_NE(result_.err.find("latex"), std::string::npos) << result_.err;
  write_text(bench_.path("records.jsonl"), record("HYBRID", {1}).dump() + "\n{\n");
  expect_line(
      ". --format=csv",
      "./records.jsonl:2: not JSON: parse error at line 1, column 2: syntax error while parsing "
      "object key - unexpected end of input; expected string literal");
  Json wrong = record("HYBRID", {1});
  wrong["status"] = 1;
  write_text(bench_.path("records.jsonl"), wrong.dump() + "\n");
  expect_line(". --format=markdown", "./records.jsonl:1: status: 1 " + allowed_statuses);
  fs::create_directory(bench_.path("nights"));
  expect_line(". --format=csv",
              "./nights: no *.json in it (a folder that bench track wrote has them)");
  write_text(bench_.path("nights/a.json"), "{\"format\": 1}");
  expect_line(". --format=csv", "./nights/a.json: format: 1 (allowed: airybench-night-1)");
}

}  // namespace
}  // namespace airybench::export_test
