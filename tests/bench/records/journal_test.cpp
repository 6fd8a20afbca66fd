#include "bench/records/journal.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "bench/records/context.hpp"
#include "bench/records/record_reader.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::journal_test {
namespace {

std::vector<std::string> lines_of(const std::filesystem::path& file, bool torn) {
  std::vector<std::string> lines;
  EXPECT_EQ(read_lines(file, [&](const std::string& text, const Line&) { lines.push_back(text); }),
            torn);
  return lines;
}

TEST(Journal, KeepsLinesAndDropsAStart) {
  const testing::TemporaryFolder folder;
  {
    testing::write_text(folder / "j", "");
    Journal journal(folder / "j", 0);
    EXPECT_EQ(journal.append("one"), 0);
    EXPECT_EQ(journal.append("three"), 4);
    EXPECT_EQ(testing::text_of(folder / "j"), "one\nthree\n");
    EXPECT_EQ(journal.text_of({4, 5, 2}), "three");
    EXPECT_THROW(journal.text_of({4, 7, 2}), FileError);
  }
  using Lines = std::vector<std::string>;
  EXPECT_EQ(lines_of(folder / "j", false), (Lines{"one", "three"}));
  testing::write_text(folder / "j", "one\ntw");
  EXPECT_EQ(lines_of(folder / "j", true), Lines{"one"});
  EXPECT_EQ(lines_of(folder / "not there", false), Lines{});
}

TEST(Journal, SaysWhatCannotBeWrittenOrRead) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(Journal(folder / "nowhere/j", 0), FileError);
  testing::write_text(folder / "j", "another's");
  EXPECT_THROW(Journal(folder / "j", 0), FileError);
  EXPECT_THROW(read_lines(folder.path(), {}), FileError);
  EXPECT_THROW(Journal("/dev/full", 0), FileError);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0666), 0);
  EXPECT_THROW(Journal(folder / "pipe", 0), FileError);
  for (const char* file : {"removed", "replaced", "changed"}) {
    testing::write_text(folder / file, "");
    Journal journal(folder / file, 0);
    journal.append("one");
    if (file != std::string("changed")) std::filesystem::remove(folder / file);
    const std::string others = file == std::string("removed") ? "" : "another's";
    if (!others.empty()) testing::write_text(folder / file, others);
    EXPECT_THROW(journal.append("two"), FileError);
    EXPECT_EQ(testing::text_of(folder / file), others);
  }
}

TEST(RunIdentity, NamesWhatDiffersAndPassesOverTheMoment) {
  const Context a = {{"cpu", "X"},
                     {"threads", "1"},
                     {"date", "today"},
                     {"git_dirty", "no"},
                     {"program_sha256", "aa"}};
  Context b = a;
  b["date"] = "tomorrow";
  EXPECT_EQ(differences(a, b, Sameness::same_program), "");
  b["threads"] = "2";
  b.erase("cpu");
  EXPECT_EQ(differences(a, b, Sameness::same_program), "cpu: X and (not said); threads: 1 and 2");
  b = a;
  b["program_sha256"] = "bb";
  EXPECT_EQ(differences(a, b, Sameness::same_program), "program_sha256: aa and bb");
  EXPECT_EQ(differences(a, b, Sameness::same_sources), "");
  b["git_dirty"] = "yes";
  Context c = b;
  c["program_sha256"] = "cc";
  EXPECT_EQ(differences(b, c, Sameness::same_sources), "program_sha256: bb and cc");
}

}  // namespace
}  // namespace airybench::journal_test
