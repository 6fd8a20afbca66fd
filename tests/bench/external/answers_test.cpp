// What other people's programs leave behind, through the bench command: truth, lies, and nonsense.
// Every run goes on with the next program, and keeps its records.
#include <gtest/gtest.h>

#include "tests/bench/external/programs.hpp"

namespace airybench::answers_test {
namespace {

struct Case {
  const char *name, *reads;
  std::string script;
  const char *status, *reason;  // a part of the record's
};

constexpr const char *condensed = "condensed", *airy = "airy", *body = "body";
constexpr const char* answers = "cp right/*.mtx right/answer.json $2; ";

// Says this after leaving the right vectors.
std::string says(const std::string& answer) {
  return "cp right/*.mtx $2; printf %s '" + answer + "' > $2/answer.json";
}

class Answers : public testing::ExternalPrograms {
 protected:
  void SetUp() override { write_right(); }
  void expect(const std::vector<Case>& cases, const std::string& arguments = "") const {
    for (const Case& c : cases) declare(c.name, c.reads, c.script);
    const auto records = records_of(arguments, 1);
    ASSERT_EQ(records.size(), cases.size());
    for (const Case& c : cases) {
      SCOPED_TRACE(c.name);
      const Json& record = records.at(c.name);
      EXPECT_EQ(record["status"], c.status);
      const auto reason = record["status_reason"].get<std::string>();
      EXPECT_NE(reason.find(c.reason), reason.npos) << reason << "\nfor " << c.reason;
      EXPECT_EQ(reason.find('\n'), reason.npos);
    }
  }
};

TEST_F(Answers, OfTheAnswersFile) {
  const std::string time_allowed = "(allowed: seconds, at least 0)";
  expect({
      {"none", condensed, "cp right/F_C.mtx $2", "breakdown",
       "its answer: answer.json: there is none in {output}"},
      {"nothing", airy, "exit 0", "breakdown", "answer.json: there is none in {output}"},
      {"no_json", condensed, says("ok"), "breakdown", "answer.json: parse error at line 1"},
      {"empty", condensed, says(""), "breakdown", "answer.json: parse error at line 1"},
      {"list", condensed, says("[]"), "breakdown", "the file: [] (allowed: a JSON object)"},
      {"deep", condensed, "head -c 1M /dev/zero | tr '\\0' '[' > $2/answer.json", "breakdown",
       "nested more than 32 deep"},
      {"no_status", condensed, says(R"({"time_s": 1e-6})"), "breakdown",
       "status: null (allowed: ok, inaccurate, not_converged, breakdown)"},
      {"strange_status", condensed, says(R"({"status": "good", "time_s": 1e-6})"), "breakdown",
       "status: \"good\" (allowed: ok,"},
      {"our_status", condensed, says(R"({"status": "skipped", "time_s": 1e-6})"), "breakdown",
       "status: \"skipped\" (allowed: ok,"},
      {"no_time", condensed, says(R"({"status": "ok"})"), "breakdown",
       "time_s: null (allowed: seconds, at least 0)"},
      {"negative", condensed, says(R"({"status": "ok", "time_s": -1})"), "breakdown",
       "time_s: -1 (allowed: seconds, at least 0)"},
      {"nan_time", condensed, says(R"({"status": "ok", "time_s": NaN})"), "breakdown",
       "answer.json: parse error"},
      {"inf_time", condensed, says(R"({"status": "ok", "time_s": 1e999})"), "breakdown",
       "answer.json: "},
      {"zero_time", condensed, says(R"({"status": "ok", "time_s": 0})"), "breakdown",
       "time_s: 0 (allowed: above 0, up to the "},
      {"long_time", airy, says(R"({"status": "ok", "time_s": 1e4})"), "breakdown",
       "time_s: 10000 (allowed: above 0, up to the "},
      {"stages", condensed,
       says(R"({"status": "ok", "time_s": 1e-6, "stages": {"factor": 1e-6, "contact": 1e-6}})"),
       "breakdown", "stages: 2e-06 (allowed: together at most time_s, 1e-06)"},
      {"strange_stage", condensed,
       says(R"({"status": "ok", "time_s": 1e-6, "stages": {"lunch": 0}})"), "breakdown",
       "stages: \"lunch\" (allowed: order, "},
      {"iterations", condensed,
       says(R"({"status": "ok", "time_s": 1e-6, "contact_iterations": 18446744073709551615})"),
       "breakdown", "contact_iterations: 18446744073709551615 (allowed: a whole number from 0 to"},
      {"message", condensed, says(R"({"status": "ok", "time_s": 1e-6, "message": 1})"), "breakdown",
       "message: 1 (allowed: a text)"},
      {"gave_up", condensed,
       says(R"({"status": "not_converged", "time_s": 1, "message": "no\nluck"})"), "not_converged",
       "no?luck"},
      {"folder", airy, "mkdir $2/answer.json", "breakdown", "there is none in {output}"},
      {"pipe", airy, "mkfifo $2/answer.json", "breakdown", "there is none in {output}"},
      {"endless", airy, "ln -s /dev/zero $2/answer.json", "breakdown", "there is none in {output}"},
      {"huge", airy, "truncate -s 8T $2/answer.json || truncate -s 2G $2/answer.json", "breakdown",
       "larger than "},
  });
}

TEST_F(Answers, OfTheVectors) {
  const std::string head = "%%MatrixMarket matrix array real general\\n";
  const auto forces = [&](const std::string& text) {
    return std::string(answers) + "printf '" + text + "' > $2/F_C.mtx";
  };
  const auto third_line = [&](const std::string& text) {
    return std::string(answers) + "sed -i '3s/.*/" + text + "/' $2/F_C.mtx";
  };
  const char* is_number = "(allowed: a number that a double can be)";
  expect({
      {"none", airy, std::string(answers) + "rm $2/x.mtx", "breakdown",
       "its answer: x.mtx: there is none in {output}"},
      {"empty", condensed, forces(""), "breakdown", "F_C.mtx:1: the file ends (allowed: %%Matrix"},
      {"coordinate", condensed, forces("%%MatrixMarket matrix coordinate real general\\n1 1 0\\n"),
       "breakdown", "F_C.mtx:1: %MatrixMarket matrix coordinate real "},
      {"only_head", condensed, forces("%%" + head), "breakdown", "F_C.mtx:2: the file ends"},
      {"wrong_size", condensed, forces("%%" + head + "39 1\\n"), "breakdown",
       "F_C.mtx:2: 39 1 (allowed: 40 1)"},
      {"too_few", condensed, std::string(answers) + "sed -i '$d' $2/F_C.mtx", "breakdown",
       "F_C.mtx:42: the file ends (allowed: a number"},
      {"too_many", condensed, std::string(answers) + "echo 0 >> $2/F_C.mtx", "breakdown",
       "F_C.mtx:43: 0 (allowed: the file's end)"},
      {"text", condensed, third_line("1.0e"), "breakdown", is_number},
      {"comma", condensed, third_line("1,5"), "breakdown", is_number},
      {"two", condensed, third_line("1 5"), "breakdown", is_number},
      {"blank", condensed, third_line("  "), "breakdown", is_number},
      {"plus", condensed, third_line("+ "), "breakdown", is_number},
      {"overflow", condensed, third_line("1e999"), "breakdown", is_number},
      {"nan", condensed, third_line("nan"), "breakdown", "not finite"},
      {"inf", airy, third_line("-inf"), "breakdown", "not finite"},
      {"nan_in_body", body, std::string(answers) + "sed -i '3s/.*/nan/' $2/displacement_mm.mtx",
       "breakdown", "not finite"},
  });
}

TEST_F(Answers, LiesAreCaught) {
  const testing::RightAnswer right = testing::right_answer();
  const Eigen::VectorXd other_x = right.x * (1 + 1e-3), other_F = right.F_C * (1 + 1e-3);
  write("lies/x.mtx", testing::market(other_x));
  write("lies/F_C.mtx", testing::market(other_F));
  write("lies/0.mtx", testing::market(0 * right.F_C));
  const auto with = [](const char* lie, const char* name) {
    return std::string(answers) + "cp lies/" + lie + ".mtx $2/" + name + ".mtx";
  };
  expect({
      {"zeros", condensed, with("0", "F_C"), "inaccurate", "is above the target"},
      {"zeros_airy", airy, with("0", "F_C"), "inaccurate", "is above the target"},
      {"scaled", condensed, with("F_C", "F_C"), "inaccurate", "is above the target"},
      {"wrong_F_C", airy, with("F_C", "F_C"), "inaccurate", "is above the target"},
      {"wrong_x", airy, with("x", "x"), "inaccurate", "is above the target"},
      {"both", airy, std::string(answers) + "cp lies/x.mtx lies/F_C.mtx $2", "inaccurate",
       "is above the target"},
      {"doubt", condensed,
       "cp right/F_C.mtx $2; echo '{\"status\": \"inaccurate\", \"message\": \"who knows\", "
       "\"time_s\": 1e-6}' > $2/answer.json",
       "inaccurate", "who knows"},
  });
  for (const Json& record : bench_.records())
    EXPECT_EQ(record["outcome"],
              record["method"] == "EXTERNAL:doubt" ? "inaccurate" : "wrong_success");
}

TEST_F(Answers, OfProgramsThatBehaveBadly) {
  expect({
      {"exits_1", condensed, std::string(answers) + "echo first; echo; echo ' why' >&2; exit 1",
       "crashed", "exits_1 ended with exit code 1:  why"},
      {"crashes", airy, std::string(answers) + "kill -SEGV $$", "crashed",
       "crashes was ended by SIGSEGV"},
      {"prints", condensed, "head -c 100M /dev/zero | tr '\\0' x; exit 1", "crashed",
       "prints ended with exit code 1: xxxx"},
      {"no_utf8", condensed, "printf '\\377\\033[31m'; exit 1", "crashed", "exit code 1: "},
      {"deletes_input", condensed, "rm -r $1; " + std::string(answers) + "rm $2/F_C.mtx",
       "breakdown", "F_C.mtx: there is none in {output}"},
      {"deletes_all", condensed, "rm -r $1 $2", "breakdown", "answer.json: there is none"},
      {"ends_its_guardian", condensed, std::string(answers) + "kill -KILL $PPID; sleep 1000",
       "crashed", "the program's guardian was ended"},
      {"ends_no_child", condensed, "sleep 1000 & exit 9", "crashed", "exit code 9"},
  });
}

TEST_F(Answers, WhoPassesALimitIsEnded) {
  for (const char* reads : {airy, condensed, body})
    declare(std::string("hangs_") + reads, reads, std::string(answers) + "sleep 1000 & wait");
  for (const auto& [name, record] : records_of("--timeout=0.3", 1)) {
    EXPECT_EQ(record["status"], "timeout") << name;
    EXPECT_NE(record["status_reason"].get<std::string>().find("was ended after the limit of "),
              std::string::npos)
        << record["status_reason"];
  }
  for (const char* reads : {airy, condensed, body})
    std::filesystem::remove(bench_.path(std::string("hangs_") + reads + ".json"));
  expect({{"eats", condensed, "head -c 300M /dev/zero | tail -c 300M | sleep 1000", "out_of_memory",
           "eats was ended: it passed the memory limit"},
          {"eats_more", airy, "head -c 300M /dev/zero | tail -c 300M | sleep 1000", "out_of_memory",
           "eats_more was ended: it passed the memory limit"}},
         "--memory-limit=100");
}

}  // namespace
}  // namespace airybench::answers_test
