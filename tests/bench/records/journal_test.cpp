#include "bench/records/journal.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "bench/records/context.hpp"
#include "tests/support/temporary_folder.hpp"

namespace airybench::journal_test {
namespace {

TEST(Journal, KeepsLinesAndDropsAStart) {
  const testing::TemporaryFolder folder;
  {
    Journal journal(folder / "j");
    journal.append("one");
    journal.append("two");
    EXPECT_EQ(testing::text_of(folder / "j"), "one\ntwo\n");
  }
  EXPECT_EQ(read_journal(folder / "j").lines, (std::vector<std::string>{"one", "two"}));
  EXPECT_FALSE(read_journal(folder / "j").torn);
  testing::write_text(folder / "j", "one\ntw");
  EXPECT_EQ(read_journal(folder / "j").lines, (std::vector<std::string>{"one"}));
  EXPECT_TRUE(read_journal(folder / "j").torn);
  EXPECT_TRUE(read_journal(folder / "not there").lines.empty());
}

TEST(Journal, SaysWhatCannotBeWrittenOrRead) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(Journal(folder / "nowhere/j"), FileError);
  EXPECT_THROW(read_journal(folder.path()), FileError);
  EXPECT_THROW(Journal("/dev/full"), FileError);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0666), 0);
  EXPECT_THROW(Journal(folder / "pipe"), FileError);
  for (const char* file : {"removed", "replaced"}) {
    Journal journal(folder / file);
    journal.append("one");
    std::filesystem::remove(folder / file);
    if (file == std::string("replaced")) testing::write_text(folder / file, "another's");
    EXPECT_THROW(journal.append("two"), FileError);
    EXPECT_EQ(testing::text_of(folder / file), file == std::string("replaced") ? "another's" : "");
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
