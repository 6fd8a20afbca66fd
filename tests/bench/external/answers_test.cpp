// What other people's programs leave behind, through the bench command: truth, lies, and nonsense.
// Every run goes on with the next program, and keeps its records.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <list>

#include "tests/bench/external/programs.hpp"

namespace airybench::answers_test {
namespace {

struct Case {
  const char *name, *reads;
  std::string script;
  const char* reason;  // a part of the record's
};

constexpr const char *condensed = "condensed", *airy = "airy", *body = "body";
const std::string answers = "cp right/*.mtx right/answer.json $2; ";

// Says this after leaving the right vectors.
std::string says(const std::string& answer) {
  return "cp right/*.mtx $2; printf %s '" + answer + "' > $2/answer.json";
}
// With another key.
std::string says_ok_and(const std::string& key, const std::string& value) {
  return says(R"({"status": "ok", "time_s": 1e-6, ")" + key + "\": " + value + "}");
}

class Answers : public testing::ExternalPrograms {
 protected:
  void SetUp() override { write_right(); }
  void expect(const char* status, const std::vector<Case>& cases,
              const std::string& arguments = "") const {
    for (const Case& c : cases) declare(c.name, c.reads, c.script);
    const auto records = records_of(arguments, 1);
    ASSERT_EQ(records.size(), cases.size());
    for (const Case& c : cases) {
      SCOPED_TRACE(c.name);
      const Json& record = records.at(c.name);
      EXPECT_EQ(record["status"], status);
      const auto reason = record["status_reason"].get<std::string>();
      EXPECT_TRUE(testing::contains(reason, c.reason));
      EXPECT_FALSE(testing::contains(reason, "\n"));
      std::filesystem::remove(bench_.path(std::string(c.name) + ".json"));
    }
  }
};

TEST_F(Answers, OfTheAnswersFile) {
  const char* none = "its answer: answer.json: there is none in {output}";
  expect("breakdown",
         {{"none", condensed, "cp right/F_C.mtx $2", none},
          {"nothing", airy, "exit 0", none},
          {"folder", airy, "mkdir $2/answer.json", none},
          {"pipe", airy, "mkfifo $2/answer.json", none},
          {"endless", airy, "ln -s /dev/zero $2/answer.json", none},
          {"huge", airy, "truncate -s 8T $2/answer.json || truncate -s 2G $2/answer.json",
           "bytes (allowed: up to 1048576)"},
          {"link", condensed,
           "ln -s ../../../right/answer.json $2; " + answers +
               "rm $2/*.json; ln -s $PWD/right/answer.json $2",
           none},
          {"links_folder", condensed, "rmdir $2; ln -s $PWD/right $2", none},
          {"no_json", condensed, says("ok"), "answer.json: not JSON: "},
          {"list", condensed, says("[]"), "the file: [] (allowed: a JSON object)"},
          {"deep", condensed, "head -c 1M /dev/zero | tr '\\0' '[' > $2/answer.json",
           "nested more than 10 deep"},
          {"no_status", condensed, says(R"({"time_s": 1e-6})"), "status: is missing"},
          {"our_status", condensed, says(R"({"status": "timeout", "time_s": 1e-6})"),
           "status: \"timeout\" (allowed: ok,"},
          {"no_time", condensed, says(R"({"status": "ok"})"), "time_s: is missing"},
          {"negative", condensed, says(R"({"status": "ok", "time_s": -1})"), "time_s: -1 ("},
          {"nan_time", condensed, says(R"({"status": "ok", "time_s": NaN})"),
           "answer.json: not JSON: "},
          {"zero_time", condensed, says(R"({"status": "ok", "time_s": 0})"), "time_s: 0 ("},
          {"long_time", airy, says(R"({"status": "ok", "time_s": 1e4})"), "time_s: 10000 ("},
          {"stages", condensed, says_ok_and("stages", R"({"factor": 1e-6, "contact": 1e-6})"),
           "stages: 2e-06 ("},
          {"strange_stage", condensed, says_ok_and("stages", R"({"lunch": 0})"),
           "stages: lunch: unknown key"},
          {"message", condensed, says_ok_and("message", "1"), "message: 1 (allowed: a text)"}});
  expect("not_converged",
         {{"gave_up", condensed,
           says(R"({"status": "not_converged", "time_s": 1, "message": "no\nluck"})"), "no?luck"}});
}

TEST_F(Answers, AProblemThatAProgramDoesNotTakeIsSkipped) {
  declare("reason", body, says(R"({"status": "skipped", "time_s": 0, "message": "two walls"})"));
  declare("silent", condensed, says(R"({"status": "skipped", "time_s": 0})"));
  const auto records = records_of("", 0);
  for (const auto& [name, reason] : {std::pair("reason", "two walls"), {"silent", "no message"}}) {
    EXPECT_EQ(records.at(name)["status"], "skipped");
    EXPECT_EQ(records.at(name)["status_reason"], reason);
  }
}

// Seven printed digits leave forces that do not balance; a lie in the sixth is none of them.
TEST_F(Answers, RoundingOfDisplacementsCountsUnlessItIsDeclared) {
  const auto rounded = [](double value) {
    return std::strtod(fmt::format("{:.6e}", value).c_str(), nullptr);
  };
  Eigen::MatrixXd u = testing::right_answer().displacement_mm;
  write("printed.mtx", testing::market(u.unaryExpr(rounded)));
  u(u.rows() / 2, 0) *= 1 + 1e-3;
  write("wrong.mtx", testing::market(u.unaryExpr(rounded)));
  const Json seven_digits = {{"print_precision", 5e-7}};
  const auto copy = [](const std::string& name) {
    return answers + "cp " + name + " $2/displacement_mm.mtx";
  };
  declare("silent", body, copy("printed.mtx"));
  declare("declared", body, copy("printed.mtx"), seven_digits);
  declare("wrong", body, copy("wrong.mtx"), seven_digits);
  const auto records = records_of("", 1);
  EXPECT_EQ(records.at("silent")["status"], "inaccurate");
  EXPECT_EQ(records.at("declared")["status"], "ok");
  EXPECT_EQ(records.at("wrong")["status"], "inaccurate");
  EXPECT_GT(records.at("silent")["equilibrium_residual"], 1e-6);
  EXPECT_EQ(records.at("declared")["equilibrium_residual"], 0);
}

// In front of a wall 1e-4 mm farther away everything balances; the nearer one is penetrated.
TEST_F(Answers, PenetrationBeyondWhatIsAllowedIsInaccurate) {
  write("farther.mtx",
        testing::market(testing::right_answer({.clearance_mm = 1e-4}).displacement_mm));
  const std::string copy = answers + "cp farther.mtx $2/displacement_mm.mtx";
  declare("right", body, answers);
  declare("through", body, copy);
  declare("allowed", body, copy, {{"allowed_penetration", 0.01}});
  const auto records = records_of("", 1);
  EXPECT_LT(records.at("right")["penetration_share"], 1e-9);
  EXPECT_GT(records.at("right")["n_open"], 0);
  EXPECT_GT(records.at("right")["n_stick"], 0);
  EXPECT_GT(records.at("right")["n_slip"], 0);
  const Json& through = records.at("through");
  EXPECT_EQ(through["status"], "inaccurate");
  EXPECT_TRUE(through["status_reason"].get<std::string>().starts_with(
      "penetrates the wall by 0.0001 mm, 0."))
      << through["status_reason"];
  EXPECT_NEAR(through["penetration_mm"].get<double>(), 1e-4, 1e-9);
  EXPECT_NEAR(through["edge_penetration_mm"].get<double>(), 1e-4, 1e-9);
  EXPECT_EQ(records.at("allowed")["status"], "ok") << records.at("allowed")["status_reason"];
}

// Like the last iterate of our own methods: the status stays, the errors are measured.
TEST_F(Answers, WhereItGaveUpIsJudged) {
  const std::string gave_up = R"({"status": "not_converged", "time_s": 1e-6, "message": "slow"})";
  write("lies/F_C.mtx", testing::market(testing::right_answer().F_C * (1 + 1e-3)));
  expect("not_converged", {{"airy", airy, says(gave_up), "slow"},
                           {"condensed", condensed, says(gave_up), "slow"},
                           {"body", body, says(gave_up), "slow"},
                           {"off", condensed, says(gave_up) + "; cp lies/F_C.mtx $2", "slow"},
                           {"short", airy, says(gave_up) + "; rm $2/x.mtx", "slow"},
                           {"nothing", condensed, says(gave_up) + "; rm $2/*.mtx", "slow"}});
  for (const Json& record : bench_.records()) {
    const std::string name = record["method"].get<std::string>().substr(9);
    SCOPED_TRACE(name);
    EXPECT_EQ(record["claimed_status"], "not_converged");
    EXPECT_EQ(record["equilibrium_residual"].is_null(), name == "short" || name == "nothing");
    if (name == "airy" || name == "condensed") {
      EXPECT_LT(record["error_force"], 1e-9);
    }
    if (name == "off") {
      EXPECT_NEAR(record["error_force"].get<double>(), 1e-3, 1e-6);
    }
  }
}

// The bounds are those of the record's fields.
TEST_F(Answers, NumbersOutOfBoundsAreOfTheirCaseAlone) {
  std::vector<Case> cases;
  std::list<std::string> names;
  const auto add = [&](const char* key, const std::string& value, const char* reason) {
    names.push_back(key + std::to_string(cases.size()));
    cases.push_back({names.back().c_str(), condensed, says_ok_and(key, value), reason});
  };
  for (const char* text : {"2305843009213693952", "9223372036854775808", "1e308", "-1",
                           "18446744073709551615", "7.5", "null", "\"7\"", "[7]"}) {
    add("linear_iterations", text, "allowed: a whole number from 0 to 1152921504606846976)");
    add("contact_iterations", text, "allowed: a whole number from 0 to 2147483647)");
  }
  for (const char* text : {"-1", "-1e308", "null", "\"7\""})
    add("error_estimate", text, "allowed: a number, at least 0)");
  for (const char* text : {"NaN", "Infinity", "1e999", "0x7"})
    add("error_estimate", text, "answer.json: ");
  add("stages", R"({"factor": 1e308, "contact": 1e308})", "allowed: together at most time_s");
  expect("breakdown", cases);
}

TEST_F(Answers, NumbersUpToTheBoundsAreKept) {
  declare("one", airy,
          says(R"({"status": "ok", "time_s": 5e-324, "linear_iterations": 1152921504606846976,
                   "contact_iterations": 2147483647, "error_estimate": 1e308,
                   "message": "a\u0000b"})"));
  declare("two", airy, says_ok_and("linear_iterations", "9007199254740993"));
  const auto records = records_of("", 1);
  EXPECT_EQ(records.at("one")["linear_iterations"], std::int64_t{1} << 60);
  EXPECT_EQ(records.at("one")["contact_iterations"], 2147483647);
  EXPECT_EQ(records.at("one")["error_estimate"], 1e308);
  EXPECT_EQ(records.at("two")["linear_iterations"], (std::int64_t{1} << 53) + 1);
  EXPECT_EQ(records_of("--resume", 1).size(), 2u);
}

TEST_F(Answers, OfTheVectors) {
  const std::string head = "%%%%MatrixMarket matrix array real general\\n";
  const auto forces = [&](const std::string& text) {
    return answers + "printf '" + text + "' > $2/F_C.mtx";
  };
  const auto third_line = [&](const std::string& text) {
    return answers + "sed -i '3s/.*/" + text + "/' $2/F_C.mtx";
  };
  const char* is_number = "(allowed: a number that a double can be)";
  expect(
      "breakdown",
      {{"none", airy, answers + "rm $2/x.mtx", "its answer: x.mtx: there is none in {output}"},
       {"device", condensed, answers + "ln -sf /dev/zero $2/F_C.mtx", "F_C.mtx: there is none"},
       {"hole", condensed, answers + "truncate -s 3G $2/F_C.mtx", "bytes (allowed: up to "},
       {"long_head", condensed,
        answers + "{ printf '\\223NUMPY\\001\\000\\377\\377'; head -c 65535 /dev/zero | tr '\\0' ' "
                  "'; } > $2/F_C.npy",
        "(allowed: '<f8', shape (40, 1))"},
       {"empty", condensed, forces(""), "F_C.mtx:1: the file ends (allowed: %%Matrix"},
       {"coordinate", condensed, forces("%%MatrixMarket matrix coordinate real general\\n1 1 0\\n"),
        "F_C.mtx:1: %MatrixMarket matrix coordinate real "},
       {"only_head", condensed, forces(head), "F_C.mtx:2: the file ends"},
       {"wrong_size", condensed, forces(head + "39 1\\n"), "F_C.mtx:2: 39 1 (allowed: 40 1)"},
       {"too_few", condensed, answers + "sed -i '$d' $2/F_C.mtx",
        "F_C.mtx:42: the file ends (allowed: a number"},
       {"too_many", condensed, answers + "echo 0 >> $2/F_C.mtx",
        "F_C.mtx:43: 0 (allowed: the file's end)"},
       {"text", condensed, third_line("1.0e"), is_number},
       {"blank", condensed, third_line("  "), is_number},
       {"overflow", condensed, third_line("1e999"), is_number},
       {"nan", condensed, third_line("nan"), "not finite"},
       {"inf", airy, third_line("-inf"), "not finite"},
       {"nan_in_body", body, answers + "sed -i '3s/.*/nan/' $2/displacement_mm.mtx",
        "not finite"}});
}

TEST_F(Answers, LiesAreCaught) {
  const testing::RightAnswer right = testing::right_answer();
  const Eigen::VectorXd other_x = right.x * (1 + 1e-3), other_F = right.F_C * (1 + 1e-3);
  write("lies/x.mtx", testing::market(other_x));
  write("lies/F_C.mtx", testing::market(other_F));
  write("lies/0.mtx", testing::market(0 * right.F_C));
  const auto with = [](const std::string& lie, const std::string& name) {
    return answers + "cp lies/" + lie + ".mtx $2/" + name + ".mtx";
  };
  const char* above = "is above the target";
  expect("inaccurate",
         {{"zeros", condensed, with("0", "F_C"), above},
          {"zeros_airy", airy, with("0", "F_C"), above},
          {"scaled", condensed, with("F_C", "F_C"), above},
          {"wrong_F_C", airy, with("F_C", "F_C"), above},
          {"wrong_x", airy, with("x", "x"), above},
          {"both", airy, answers + "cp lies/x.mtx lies/F_C.mtx $2", above},
          {"doubt", condensed,
           "cp right/F_C.mtx $2; echo '{\"status\": \"inaccurate\", \"message\": \"who knows\", "
           "\"time_s\": 1e-6}' > $2/answer.json",
           "who knows"}});
  for (const Json& record : bench_.records())
    EXPECT_EQ(record["outcome"],
              record["method"] == "EXTERNAL:doubt" ? "inaccurate" : "wrong_success");
}

TEST_F(Answers, OfProgramsThatBehaveBadly) {
  expect("crashed", {{"exits_1", condensed, answers + "echo first; echo; echo ' why' >&2; exit 1",
                      "exits_1 ended with exit code 1:  why"},
                     {"crashes", airy, answers + "kill -SEGV $$", "crashes was ended by SIGSEGV"},
                     {"prints", condensed, "head -c 100M /dev/zero | tr '\\0' x; exit 1",
                      "prints ended with exit code 1: xxxx"},
                     {"no_utf8", condensed, "printf '\\377\\033[31m'; exit 1", "exit code 1: "},
                     {"ends_its_guardian", condensed, answers + "kill -KILL $PPID; sleep 1000",
                      "the program's guardian was ended"},
                     {"ends_no_child", condensed, "sleep 1000 & exit 9", "exit code 9"}});
  expect("breakdown", {{"deletes_input", condensed, "rm -r $1; " + answers + "rm $2/F_C.mtx",
                        "F_C.mtx: there is none in {output}"},
                       {"deletes_all", condensed, "rm -r $1 $2", "answer.json: there is none"}});
}

// Of what it printed only the beginning and the end are read.
TEST_F(Answers, WhatItPrintedTakesNoMemory) {
  expect("crashed",
         {{"hole", condensed, "truncate -s 3500M /dev/stdout; exit 1", "exit code 1: ???"},
          {"device", condensed, "ln -sf /dev/zero $2/../printed; exit 1", "with exit code 1"}},
         "--memory-limit=300");
}

TEST_F(Answers, WhoPassesALimitIsEnded) {
  const std::string hangs = answers + "sleep 1000 & wait";
  expect("timeout",
         {{"hangs_airy", airy, hangs, "was ended after the limit of "},
          {"hangs_condensed", condensed, hangs, "was ended after the limit of "},
          {"hangs_body", body, hangs, "was ended after the limit of "},
          {"stops_its_guardian", airy, "kill -STOP $PPID; " + hangs, "was ended after the limit "}},
         "--timeout=0.3");
  const std::string eats = "head -c 300M /dev/zero | tail -c 300M | sleep 1000";
  expect("out_of_memory",
         {{"eats", condensed, eats, "eats was ended: it passed the memory limit"},
          {"eats_more", airy, eats, "eats_more was ended: it passed the memory limit"}},
         "--memory-limit=100");
}

}  // namespace
}  // namespace airybench::answers_test
