// What may not be written is refused before anything is touched.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <map>

#include "tests/support/other_user.hpp"

namespace airybench::permissions_test {
namespace {

namespace fs = std::filesystem;

using testing::BenchCommand;
using testing::run_as_user;

const std::string hybrid = "bin/bench --mesh=Mesh0 --method=HYBRID --repetitions=1 ";

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[entry.path().lexically_relative(folder).string()] =
        entry.is_regular_file() && !entry.is_symlink() ? testing::text_of(entry.path()) : "";
  return files;
}

struct Obstacle {
  std::size_t first;  // of the commands that meet it
  const char* made_by;
  const char* message;
};
void PrintTo(const Obstacle& obstacle, std::ostream* out) { *out << obstacle.made_by; }

class Refusal : public ::testing::TestWithParam<Obstacle> {};

TEST_P(Refusal, LeavesTheFolderAsItIs) {
  const BenchCommand bench;
  testing::copy_program_to(bench.path(""));
  ASSERT_EQ(run_as_user(bench, hybrid + "--out=o && cp -r o part"), 0) << bench.content("err.txt");
  ASSERT_EQ(run_as_user(bench, GetParam().made_by), 0) << bench.content("err.txt");
  const auto before = files_in(bench.path("o"));
  const std::vector<std::string> commands = {
      hybrid,
      hybrid + "--append ",
      "bin/bench merge part ",
      "bin/bench --mesh=Mesh0 --method=P2 --repetitions=1 --append ",
      hybrid + "--adapt=90% ",
      "bin/bench advise --mesh=Mesh0 --error=50% "};
  // Every obstacle meets three of them, every command at least three obstacles.
  for (const std::size_t ahead : {0, 1, 3}) {
    const std::string& command = commands[(GetParam().first + ahead) % commands.size()];
    EXPECT_EQ(run_as_user(bench, command + "--out=o"), 2) << command;
    const std::string err = bench.content("err.txt");
    EXPECT_TRUE(testing::contains(err, GetParam().message)) << command;
    EXPECT_EQ(std::ranges::count(err, '\n'), 1) << command << err;
    EXPECT_EQ(files_in(bench.path("o")), before) << command;
  }
  fs::permissions(bench.path("o"), fs::perms::all);
}
INSTANTIATE_TEST_SUITE_P(
    Of, Refusal,
    ::testing::Values(
        Obstacle{0, "chmod 444 o/records.jsonl", "o/records.jsonl: cannot be written: Permission"},
        Obstacle{1, "chmod 444 o/results.csv", "o/results.csv: cannot be written: Permission"},
        Obstacle{2, "chmod 555 o", "o/records.jsonl: cannot be written: Permission"},
        Obstacle{3, "chmod 644 o", "o/records.jsonl: cannot be written: Permission"},
        Obstacle{4, "rm o/results.json; mkdir o/results.json",
                 "o/results.json: is no regular file"},
        Obstacle{5, "mv o/records.jsonl o/mine; mkfifo o/records.jsonl",
                 "o/records.jsonl: is no regular file"},
        Obstacle{6, "mv o/records.jsonl o/mine; ln -s nowhere/there o/records.jsonl",
                 "o/records.jsonl: cannot be written: No such file or directory"}));

TEST(Resume, OfAReadOnlyFolderRefusesOnlyWhatWouldWrite) {
  const BenchCommand bench;
  testing::copy_program_to(bench.path(""));
  ASSERT_EQ(run_as_user(bench, hybrid + "--out=o && chmod 555 o"), 0) << bench.content("err.txt");
  EXPECT_EQ(run_as_user(bench, hybrid + "--out=o --resume"), 2);
  EXPECT_EQ(run_as_user(bench, "bin/bench export o --format=csv"), 0) << bench.content("err.txt");
  fs::permissions(bench.path("o"), fs::perms::all);
}

TEST(Readers, OfAFolderThatTheyCannotEnterSaySo) {
  const BenchCommand bench;
  testing::copy_program_to(bench.path(""));
  ASSERT_EQ(run_as_user(bench, hybrid + "--out=o && chmod 644 o"), 0) << bench.content("err.txt");
  for (const char* command : {"export o --format=csv", "compare o o", "merge o --out=p",
                              "replay o:1 --out=p", "track --history=h --from=o"}) {
    EXPECT_EQ(run_as_user(bench, std::string("bin/bench ") + command), 2) << command;
    EXPECT_EQ(bench.content("err.txt"), "bench: o/records.jsonl: Permission denied\n") << command;
  }
  fs::permissions(bench.path("o"), fs::perms::all);
}

// Earlier versions locked a folder by a file in it.
TEST(FolderLock, OfRootDoesNotShutOthersOut) {
  const BenchCommand bench;
  testing::copy_program_to(bench.path(""));
  fs::create_directories(bench.path("o"));
  fs::permissions(bench.path("o"), fs::perms::all);
  testing::write_text(bench.path("o/.lock"), "process 1 on a machine that is no more");
  fs::permissions(bench.path("o/.lock"), fs::perms::owner_read | fs::perms::group_read);
  EXPECT_EQ(run_as_user(bench, hybrid + "--out=o"), 0) << bench.content("err.txt");
}

}  // namespace
}  // namespace airybench::permissions_test
