// Records that gzip has packed are read as if they were not, and never written to.
#include <gtest/gtest.h>

#include "bench/records/record_reader.hpp"
#include "support/errors.hpp"
#include "support/gzip.hpp"
#include "tests/support/bench_command.hpp"

namespace airybench::packed_records_test {
namespace {

using testing::BenchCommand;
using testing::TemporaryFolder;

// By the program gzip, not by the library that unpacks.
std::string packed(const std::string& text) {
  const TemporaryFolder folder;
  testing::write_text(folder / "text", text);
  EXPECT_EQ(std::system(("gzip -9 -n '" + (folder / "text").string() + "'").c_str()), 0);
  return testing::text_of(folder / "text.gz");
}

std::string unpacked(const std::string& bytes) {
  const TemporaryFolder folder;
  testing::write_text(folder / "f", bytes);
  return unpacked_text(folder / "f");
}

TEST(Gzip, UnpacksMembersOneAfterAnother) {
  std::string large;
  for (int line = 0; line < 20000; ++line) large += std::to_string(line * line) + "\n";
  EXPECT_EQ(unpacked(packed(large)), large);
  EXPECT_EQ(unpacked(packed("")), "");
  EXPECT_EQ(unpacked(packed("one\n") + packed("two\n")), "one\ntwo\n");
}

TEST(Gzip, RefusesWhatIsCutOrDamaged) {
  const std::string text = "one\ntwo\nthree\n", whole = packed(text);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(unpacked(whole.substr(0, length)), FileError) << length;
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      std::string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ 1 << bit);
      try {
        EXPECT_EQ(unpacked(changed), text) << at;  // time or system in the header
      } catch (const FileError& why) {
        EXPECT_NE(std::string(why.what()).find("/f: "), std::string::npos);
        ++refused;
      }
    }
  EXPECT_GT(refused, 100);
}

// A few kilobytes unpack to what would fill the memory.
TEST(PackedRecords, AreLimitedInLinesAndInAll) {
  const BenchCommand bench;
  const auto write = [&](const std::string& bytes) {
    std::filesystem::create_directories(bench.path("o"));
    testing::write_text(bench.path("o/records.jsonl.gz"), bytes);
  };
  const std::string longest(std::size_t{16} << 20, ' ');
  write(packed(longest + " "));
  for (const char* command : {"export o --format=csv", "merge o --out=p"})
    bench.expect_refusal(
        command, "o/records.jsonl.gz:1: a line longer than 16 MiB (allowed: up to 16 MiB)\n");
  const std::string part = packed(longest + "\n");
  std::string bomb;
  for (int member = 0; member < 64; ++member) bomb += part;
  write(bomb);
  EXPECT_LT(bomb.size(), 2u << 20);
  std::string why;
  try {
    read_lines(bench.path("o/records.jsonl.gz"), [](const std::string&, const Line&) {});
  } catch (const FileError& refused) {
    why = refused.what();
  }
  EXPECT_TRUE(why.ends_with(": unpacks to more than 200 times its length (allowed: up to that)"))
      << why;
  LineSplitter lines("f", [](const std::string&, const Line&) {});
  lines.add(std::string(1'000'000, '\n'));
  EXPECT_THROW(lines.add("\n"), FileError);
}

TEST(Records, OfOneLineThatIsHalfWrittenAreNone) {
  const BenchCommand bench;
  std::filesystem::create_directories(bench.path("o"));
  testing::write_text(bench.path("o/records.jsonl"), "{\"mesh\":\"Mes");
  for (const char* command :
       {"export o --format=csv", "merge o --out=p", "compare o o", "track --history=h --from=o"})
    bench.expect_refusal(command,
                         "o/records.jsonl: only the start of a record (of a run "
                         "that was ended; --resume goes on)\n");
}

TEST(PackedRecords, AreReadByEveryCommandAndNotWrittenTo) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=HYBRID,P2 --repetitions=2 --out=o").code, 0);
  const auto csv_of = [&](const std::string& folder) {
    return bench.run("export " + folder + " --format=csv").out;
  };
  const std::string before = csv_of("o");
  ASSERT_NE(before, "");
  ASSERT_EQ(std::system(("gzip '" + bench.path("o/records.jsonl").string() + "'").c_str()), 0);
  EXPECT_EQ(read_records(records_file_in(bench.path("o"))).size(), 2u);
  EXPECT_EQ(csv_of("o"), before);
  EXPECT_EQ(bench.run("merge o --out=joined").code, 0);
  EXPECT_EQ(csv_of("joined"), before);
  for (const char* how : {"", " --append", " --resume"}) {
    const auto refused = bench.run(std::string("--mesh=Mesh0 --method=HYBRID --out=o") + how);
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("o/records.jsonl.gz: packed records are only read (allowed: another "
                               "folder, or gunzip before)\n"),
              std::string::npos)
        << refused.err;
    EXPECT_FALSE(std::filesystem::exists(bench.path("o/records.jsonl")));
  }
}

}  // namespace
}  // namespace airybench::packed_records_test
