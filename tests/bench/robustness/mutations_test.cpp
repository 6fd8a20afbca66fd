// Readers take what is good and refuse the rest by InputError, whatever the bytes are: seeded
// random changes of good files, a generator's numbers and nothing else, so a failure can be
// repeated.
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <sstream>

#include "bench/cases/scene_file.hpp"
#include "bench/exports/csv.hpp"
#include "bench/exports/google_benchmark.hpp"
#include "bench/exports/junit.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/records/summary.hpp"
#include "bench/tracking/history.hpp"
#include "mesh/msh_format.hpp"
#include "support/file_text.hpp"
#include "tests/support/places.hpp"
#include "tests/support/temporary_folder.hpp"

namespace airybench::mutations_test {
namespace {

namespace fs = std::filesystem;

#ifdef AIRYBENCH_SANITIZED
constexpr int mutants = 300;
#else
constexpr int mutants = 3000;
#endif

std::string mutant_of(std::string text, std::mt19937& engine) {
  static const std::vector<std::string> words = {"1e999",
                                                 "-1",
                                                 "null",
                                                 "[]",
                                                 "{}",
                                                 "\"\"",
                                                 "nan",
                                                 "0",
                                                 "1e-320",
                                                 "\"",
                                                 "\\",
                                                 "[",
                                                 "}",
                                                 ",",
                                                 "9223372036854775808",
                                                 "\xff",
                                                 "true",
                                                 "\n",
                                                 std::string(1, '\0'),
                                                 std::string(300, '['),
                                                 "2147483648",
                                                 "\\u0000",
                                                 "$EndNodes"};
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : engine() % n; };
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
    const std::size_t at = below(text.size()), length = std::min(text.size() - at, below(40));
    switch (below(5)) {
      case 0:
        if (!text.empty()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 3:
        text.insert(at, words[below(words.size())]);
        break;
      default: {  // a number, or what follows a sign, becomes another word
        const std::size_t begin = text.find_first_of("0123456789", at);
        if (begin == text.npos) break;
        const std::size_t end =
            std::min(text.find_first_not_of("0123456789.e-", begin), text.size());
        text.replace(begin, end - begin, words[below(words.size())]);
      }
    }
  }
  return text;
}

// How many of the mutants are taken.
int taken(const std::string& seed, const std::function<void(const std::string&)>& read) {
  read(seed);
  std::mt19937 engine(11);
  int good = 0;
  for (int k = 0; k < mutants; ++k) {
    const std::string text = mutant_of(seed, engine);
    try {
      read(text);
      ++good;
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find('\n'), what.npos) << "mutant " << k << ": " << what;
      EXPECT_LT(what.size(), 1000u) << "mutant " << k;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "mutant " << k << " of 11: " << error.what();
    }
  }
  EXPECT_GT(good, 0) << "the mutants are too far from the seed";
  EXPECT_LT(good, mutants) << "nothing is refused";
  return good;
}

TEST(Mutants, OfMeshes) {
  const std::string seed =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n"
      "1 1 \"displacement\"\n1 2 \"force\"\n1 3 \"contact\"\n2 4 \"body\"\n"
      "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
      "$EndNodes\n$Elements\n6\n1 1 2 2 2 1 2\n2 1 2 3 3 2 3\n3 1 2 2 2 3 4\n"
      "4 1 2 1 1 4 1\n5 2 2 4 4 1 2 3\n6 2 2 4 4 1 3 4\n$EndElements\n";
  taken(seed, [](const std::string& text) {
    std::istringstream in(text);
    validate(read_msh(in, "mutant.msh"));
  });
}

TEST(Mutants, OfScenes) {
  const std::string seed =
      R"({"teeth":1,"root_half_height_mm":5,"length_mm":10,"tip_half_height_mm":3,)"
      R"("young_MPa":210000,"poisson":0.3,"plane":"strain","friction":0.2,"crown_radius_mm":400,)"
      R"("clearance_mm":0,"displacement_mm":[0.02,0.006],"body_force_N_per_mm3":[0,0],)"
      R"("materials":{"a":{"young_MPa":7,"poisson":0.33}},)"
      R"("mesh":{"refine":1,"grade":{"at_mm":[10,0],"ratio":100},"slivers":{"aspect":10,"count":5},)"
      R"("scale":1,"stretch":[1,1],"move_mm":[0,0],"keep_contact_edges":4},)"
      R"("layers":{"normal":[1,0],"count":4,"materials":[{},{"young_MPa":21}]},)"
      R"("group":"layered","about":"one sentence"})";
  taken(seed, [](const std::string& text) { scene_of(text, "mutant.json"); });
}

std::string committed_record() {
  const std::string text = file_text(testing::results_folder() / "paper" / "records.jsonl");
  return text.substr(0, text.find('\n'));
}

// What is taken can be written in every form, too.
TEST(Mutants, OfRecords) {
  const testing::TemporaryFolder folder;
  taken(committed_record(), [&](const std::string& text) {
    testing::write_text(folder / "records.jsonl", text + "\n");
    std::vector<Record> records = read_records(folder / "records.jsonl", Studies::include);
    csv_text(records);
    google_benchmark_json(records);
    junit_xml(records);
    for (Record& record : records) summarise(record);
  });
}

TEST(Mutants, OfNights) {
  const testing::TemporaryFolder folder;
  Record record = record_of(parse_json(committed_record()), "the committed run");
  record.context["date"] = "2026-11-21T03:00:00Z";
  Night night = night_of({record}, "the committed run");
  night.file = folder / "nights/night.json";
  write_night(night);
  taken(file_text(night.file), [&](const std::string& text) {
    testing::write_text(night.file, text);
    read_history(folder.path());
  });
}

}  // namespace
}  // namespace airybench::mutations_test
