// One name per case: what is printed is accepted, for every record that is committed.
#include "bench/records/case_name.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>

#include "bench/records/record_reader.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/places.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::case_name_test {
namespace {

TEST(CaseName, IsReadAsItIsWritten) {
  const CaseName name{
      "Mesh0",     "default", "SYMMLQ:SSOR0.7,refine=yes", "error", "contact sweeps", 1e-12,
      Stop::paper, {}};
  EXPECT_EQ(name.text(),
            "Mesh0/default/SYMMLQ:SSOR0.7,refine=yes/study=error/contact_sweeps=1e-12/stop=paper");
  EXPECT_EQ(
      name.file(),
      "Mesh0--default--SYMMLQ+SSOR0.7,refine=yes--study=error--contact_sweeps=1e-12--stop=paper");
  const auto read = case_name_of(name.text());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->method, name.method);
  EXPECT_EQ(read->knob_value, name.knob_value);
  EXPECT_EQ(read->stop, Stop::paper);
}

TEST(CaseName, HasTheContactSolverWhereItIsNotImplied) {
  Record record;
  record.mesh = "Mesh0";
  record.scene = "default";
  record.method = "HYBRID";
  const auto suffix = [&](std::optional<ContactSolver> solver) {
    record.contact_solver = solver;
    return name_of(record).suffix();
  };
  EXPECT_EQ(suffix({}), "");  // older records do not name it
  EXPECT_EQ(suffix(ContactSolver::newton), "");
  EXPECT_EQ(suffix(ContactSolver::gauss_seidel), "/contact=gauss-seidel");
  EXPECT_EQ(case_name_of(name_of(record).text())->contact, ContactSolver::gauss_seidel);
  EXPECT_FALSE(case_name_of("Mesh0/default/HYBRID/contact=newton"));
  EXPECT_FALSE(case_name_of("Mesh0/default/HYBRID/contact=lemke"));
  record.stop = Stop::paper;
  EXPECT_EQ(suffix(ContactSolver::gauss_seidel), "/stop=paper");
}

TEST(CaseName, OfEachCaseAnotherFile) {
  EXPECT_EQ((CaseName{"-a-", "b+--c%", "d-e", "", "", {}, Stop::target, {}}.file()),
            "%2Da%2D--b~%2D%2Dc%25--d-e");  // as in tests/plots/test_records.py
  std::set<std::string> files;
  std::size_t names = 0;
  const std::vector<std::string> parts = {"M",    "-",     "--", "M-",  "-M",  "M-x", "M--x", "x",
                                          "x-M",  "+",     ":",  "%",   "%2D", "%2B", "a:b",  "a+b",
                                          "a--b", "a%2Db", "~",  "a~b", "%7E", "+~"};
  for (const std::string& mesh : parts)
    for (const std::string& scene : parts)
      for (const std::string& method : parts) {
        ++names;
        files.insert(CaseName{mesh, scene, method, "", "", {}, Stop::target, {}}.file());
      }
  EXPECT_EQ(files.size(), names);
  for (const std::string& file : files) EXPECT_EQ(file.find('/'), file.npos);
}

TEST(CaseName, RefusesWhatIsNone) {
  for (const char* text :
       {"", "Mesh0", "Mesh0/default", "Mesh0/default/", "//", "Mesh0/default/ALM/",
        "a/b/c/stop=target", "a/b/c/stop=paper/study=error",
        "a/b/c/tolerance=", "a/b/c/tolerance=x", "a/b/c/tolerance=inf", "a/b/c/tolerance=0.010",
        "a/b/c/tolerance=1/tolerance=1", "a/b/c/study"})
    EXPECT_FALSE(case_name_of(text)) << text;
}

TEST(CaseName, OfEveryCommittedRecordGoesAround) {
  std::size_t count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(testing::results_folder())) {
    if (entry.path().stem().stem() != "records") continue;
    if (testing::sanitized && count > 300) break;
    std::set<std::string> names;
    for (const Record& record : read_records(entry.path(), Studies::include)) {
      const std::string& name = record.case_name;  // older records have none
      EXPECT_TRUE(names.insert(name).second) << entry.path() << ": " << name << " is there twice";
      const auto read = case_name_of(name);
      ASSERT_TRUE(read) << name;
      EXPECT_EQ(read->text(), name);
      ++count;
    }
  }
  EXPECT_GT(count, testing::sanitized ? 300u : 3000u);
}

// "Mesh0/default/…" of each line that begins with it, after a "[1/7] " if there is one.
std::multiset<std::string> names_in(const std::string& text) {
  std::multiset<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) line = line.substr(line.find("] ") + 2);
    if (!line.starts_with("Mesh0/")) continue;
    const std::string name = line.substr(0, line.find(' '));
    names.insert(name.ends_with(':') ? name.substr(0, name.size() - 1) : name);
  }
  return names;
}

TEST(CaseName, IsTheSameInPlanProgressTableRecordsAndFiles) {
  const testing::BenchCommand bench;
  const std::string run = "--study=error --mesh=Mesh0 --method=HYBRID --repetitions=1 ";
  const auto planned = names_in(bench.run("explain " + run).out);
  EXPECT_EQ(planned.size(), 8u);
  EXPECT_TRUE(planned.contains("Mesh0/default/HYBRID/study=error/contact_sweeps=30"));
  EXPECT_EQ(names_in(bench.run(run + "--dry-run").out), planned);
  const testing::CommandResult done = bench.run(run + "--fields --out=o");
  std::multiset<std::string> recorded;
  for (const Json& record : bench.records()) {
    const CaseName name = name_of(record_of(record, "record"));
    recorded.insert(name.text());
    EXPECT_EQ(record["case_name"], name.text());
    EXPECT_TRUE(std::filesystem::exists(bench.path("o/fields/" + name.file() + ".stress.csv")));
  }
  EXPECT_EQ(recorded, planned);
  EXPECT_EQ(names_in(done.err), planned) << done.err;
  for (const std::string& name : planned)
    EXPECT_TRUE(names_in(done.out).contains(name)) << done.out;
  const testing::CommandResult none = bench.run("replay o:Mesh0/default --out=again");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("'Mesh0/default' is no case's name (allowed: MESH/SCENE/METHOD["),
            std::string::npos)
      << none.err;
  const std::string one = "Mesh0/default/HYBRID/study=error/contact_sweeps=30";
  EXPECT_EQ(bench.run("replay o:" + one + " --out=again").code, 0);
  EXPECT_EQ(name_of(record_of(bench.records("again").front(), "record")).text(), one);
}

}  // namespace
}  // namespace airybench::case_name_test
