// Files are written whole, where they may be, and by one at a time.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/folder_lock.hpp"
#include "tests/support/background_run.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::writing_test {
namespace {

namespace fs = std::filesystem;

using testing::BackgroundRun;
using testing::BenchCommand;
using testing::CommandResult;
using testing::text_of;
using testing::wait_for;
using testing::write_text;

const std::string quick = "--mesh=Mesh0 --method=HYBRID --repetitions=1 ";
const std::string two = "--mesh=Mesh0 --method=HYBRID,P2 --repetitions=1 ";

std::string why_refused(const fs::path& file) {
  return testing::complaint_of<FileError>([&] { write_file_atomically(file, "new"); });
}

std::size_t entries_of(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WriteFile, RefusesWhatIsNoRegularFile) {
  const testing::TemporaryFolder folder;
  const fs::path fifo = folder / "fifo", link = folder / "link", device = folder / "device";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0666), 0);
  fs::create_symlink(fifo, link);
  fs::create_symlink("/dev/null", device);
  for (const fs::path& file : {fifo, link, device, folder.path()}) {
    EXPECT_TRUE(why_refused(file).starts_with(file.string() + ": is no regular file (")) << file;
    EXPECT_FALSE(fs::is_regular_file(file)) << file;
  }
  EXPECT_EQ(entries_of(folder.path()), 3u);
}

TEST(WriteFile, GoesWhereLinksPoint) {
  const testing::TemporaryFolder folder;
  fs::create_directories(folder / "there");
  write_text(folder / "there/old", "old");
  fs::create_symlink("there/old", folder / "to_old");
  fs::create_symlink("there/new", folder / "to_new");
  fs::create_symlink("to_new", folder / "to_link");
  fs::create_symlink("round", folder / "round");
  write_file_atomically(folder / "to_old", "changed");
  write_file_atomically(folder / "to_link", "made");
  EXPECT_EQ(text_of(folder / "there/old"), "changed");
  EXPECT_EQ(text_of(folder / "there/new"), "made");
  for (const char* link : {"to_old", "to_new", "to_link"})
    EXPECT_TRUE(fs::is_symlink(folder / link)) << link;
  EXPECT_TRUE(
      testing::contains(why_refused(folder / "round"), "cannot be written: Too many levels"));
}

TEST(WriteFile, KeepsPermissionsAndAsksForThem) {
  const testing::TemporaryFolder folder;
  write_text(folder / "private", "old");
  fs::permissions(folder / "private", fs::perms::owner_read | fs::perms::owner_write);
  write_file_atomically(folder / "private", "new");
  EXPECT_EQ(fs::status(folder / "private").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  const mode_t before = umask(027);
  write_file_atomically(folder / "fresh", "new");
  umask(before);
  EXPECT_EQ(fs::status(folder / "fresh").permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

// Somebody who guesses the temporary name cannot have us write into a file of his choice.
TEST(WriteFile, DoesNotFollowAPlantedTemporaryName) {
  const testing::TemporaryFolder folder;
  write_text(folder / "victim", "untouched");
  fs::create_symlink("victim", folder / ("file.part" + std::to_string(getpid())));
  write_file_atomically(folder / "file", "new");
  EXPECT_EQ(text_of(folder / "victim"), "untouched");
  EXPECT_EQ(text_of(folder / "file"), "new");
}

TEST(RecordFiles, TablesOfOthersStay) {
  const BenchCommand bench;
  for (const std::string name : {"results.csv", "results.json"}) {
    fs::create_directories(bench.path(name + ".d"));
    testing::write_text(bench.path(name + ".d") / name, "mine");
    bench.expect_refusal(quick + "--out=" + name + ".d",
                         name + ": is of no records.jsonl there (allowed: another folder)");
    EXPECT_EQ(bench.content(name + ".d/" + name), "mine");
  }
}

TEST(FolderLock, IsOneProcesssUntilItEnds) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run(quick + "--out=a").code, 0);
  fs::create_directories(bench.path("h"));
  const auto refused = [&](const std::string& arguments) {
    const std::string before = bench.content("a/records.jsonl");
    bench.expect_refusal(arguments, ": in use by process " + std::to_string(getpid()));
    EXPECT_EQ(bench.content("a/records.jsonl"), before);
  };
  ASSERT_EQ(bench.run(quick + "--out=part").code, 0);
  {
    const FolderLock run(bench.path("a")), history(bench.path("h"));
    refused(quick + "--out=a");
    refused(two + "--out=a --append");
    refused(quick + "--out=a --resume");
    refused("merge part --out=a");
    refused("replay part:1 --out=a");
    refused("track --history=h --from=part");
    EXPECT_FALSE(fs::exists(bench.path("h/nights")));
    { const FolderLock part_of_it(bench.path("a")); }
    refused(quick + "--out=a");
  }
  EXPECT_EQ(bench.run(quick + "--out=a").code, 0);
  EXPECT_EQ(bench.run("track --history=h --from=part").code, 0);
  EXPECT_EQ(entries_of(bench.path("a")), 3u) << "nothing is left of it";
}

// Earlier versions wrote to a file .lock, and removed it.
TEST(FolderLock, TouchesNoFile) {
  const BenchCommand bench;
  fs::create_directories(bench.path("a"));
  fs::create_directories(bench.path("b"));
  write_text(bench.path("mine"), "precious");
  fs::create_hard_link(bench.path("mine"), bench.path("a/.lock"));
  ASSERT_EQ(mkfifo(bench.path("b/.lock").c_str(), 0666), 0);
  EXPECT_EQ(bench.run(quick + "--out=a").code, 0);
  EXPECT_EQ(bench.run(quick + "--out=b").code, 0);
  EXPECT_EQ(bench.content("mine"), "precious");
  EXPECT_EQ(fs::hard_link_count(bench.path("mine")), 2u);
  EXPECT_TRUE(fs::is_fifo(bench.path("b/.lock")));
}

TEST(FolderLock, OfTwoRunsAtOnceTheSecondIsRefused) {
  const BenchCommand bench;
  BackgroundRun first(bench, "--mesh=Mesh0,Mesh3 --method=HYBRID,SYMMLQ:NONE --out=o");
  wait_for([&] { return !bench.records().empty(); });
  bench.expect_refusal(two + "--out=o --append",
                       "in use by process " + std::to_string(first.pid()));
  first.end(SIGKILL);
  EXPECT_FALSE(bench.records().empty());
  EXPECT_EQ(bench.run(two + "--out=o").code, 0) << "a killed run holds nothing";
}

TEST(Leftovers, OfKilledRunsAreRemovedByTheNext) {
  const BenchCommand bench;
  fs::create_directories(bench.path("o/fields"));
  const std::string number = "01234567890123456789";
  for (const std::string& left : {"records.jsonl.part" + number, "fields/a.vtu.part" + number})
    write_text(bench.path("o/" + left), "left");
  for (const std::string& mine : {std::string("a.part1"), "b.part" + number + "x", "c" + number})
    write_text(bench.path("o/" + mine), "mine");
  fs::create_symlink("a.part1", bench.path("o/d.part" + number));
  ASSERT_EQ(bench.run(quick + "--out=o").code, 0);
  EXPECT_EQ(entries_of(bench.path("o")), 3u + 4u + 1u);
  EXPECT_EQ(entries_of(bench.path("o/fields")), 0u);
  fs::create_directories(bench.path("merged"));
  write_text(bench.path("merged/results.csv.part" + number), "left");
  ASSERT_EQ(bench.run("merge o --out=merged").code, 0);
  EXPECT_EQ(entries_of(bench.path("merged")), 3u);
}

TEST(Records, DeletedDuringARunAreMissed) {
  for (const bool whole_folder : {false, true}) {
    const BenchCommand bench;
    // Long enough after its first record.
    const std::string long_case = testing::sanitized ? "ALM:r=20,rho=20" : "ALM";
    BackgroundRun run(bench, "--mesh=Mesh0 --method=HYBRID,3STEPD,BLIND,P2," + long_case +
                                 " --repetitions=5 --out=o");
    wait_for([&] { return !bench.records().empty(); });
    fs::remove_all(bench.path(whole_folder ? "o" : "o/records.jsonl"));
    const int status = run.end(0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_TRUE(
        testing::contains(bench.content("bg_err.txt"),
                          "o/records.jsonl: was removed or replaced while the run wrote it"));
  }
}

// What is refused: Records.ThatAreCorruptAreRefusedByEveryCommand.
TEST(Merge, ValidatesAllBeforeItWrites) {
  const BenchCommand bench;
  bench.expect_ok(two + "--out=whole");
  bench.expect_ok(two + "--out=bad");
  const std::string before = bench.results("whole");
  std::vector<Json> records = bench.records("whole");
  records[1]["case_number"] = -1;
  write_text(bench.path("bad/records.jsonl"), records[0].dump() + "\n" + records[1].dump() + "\n");
  bench.expect_refusal("merge bad --out=whole", "bad/records.jsonl:2: case_number: ");
  EXPECT_EQ(bench.results("whole"), before);
}

// What a record says does not become a path.
TEST(Replay, WritesNothingWhereASceneNamePoints) {
  const BenchCommand bench;
  write_text(bench.path("flat.json"), R"({"crown_radius_mm": null})");
  bench.expect_ok(quick + "--scene=flat.json --out=o");
  Json record = bench.record();
  record["context"]["program_sha256"] = "0";
  fs::create_directories(bench.path("c"));
  for (const std::string& scene :
       {std::string("../evil"), std::string("a/b"), bench.path("evil").string()}) {
    record["scene"] = scene;
    write_text(bench.path("c/records.jsonl"), record.dump() + "\n");
    for (const char* more : {"", " --other-program"}) {
      EXPECT_EQ(bench.run(std::string("replay c:1 --out=again/here") + more).code, 2) << scene;
      EXPECT_FALSE(fs::exists(bench.path("evil.json")));
      EXPECT_FALSE(fs::exists(bench.path("again"))) << scene;
    }
  }
}

TEST(Fields, OfTwoCasesAreTwoFiles) {
  const BenchCommand bench;
  for (const char* mesh : {"M.msh", "M-x.msh"})
    fs::copy_file(testing::mesh_file("Mesh0"), bench.path(mesh));
  write_text(bench.path("d.json"), "{}");
  write_text(bench.path("x-d.json"), R"({"friction": 0})");
  bench.expect_ok(
      "--mesh=./M.msh,./M-x.msh --scene=d.json,x-d.json --method=HYBRID --repetitions=1 --fields "
      "--out=o");
  EXPECT_EQ(entries_of(bench.path("o/fields")), 4u * 9u);
}

}  // namespace
}  // namespace airybench::writing_test
