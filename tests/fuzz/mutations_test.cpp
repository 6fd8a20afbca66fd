// Readers take what is good and refuse the rest by InputError, whatever the bytes are: the fuzzer's
// corpus and all that it has found, and seeded random changes of its good files, by a generator's
// numbers and nothing else, so a failure can be repeated.
#include <gtest/gtest.h>

#include <random>

#include "support/file_text.hpp"
#include "support/lists.hpp"
#include "tests/fuzz/corpus.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::mutations_test {
namespace {

namespace fs = std::filesystem;

constexpr int mutants = testing::sanitized ? 400 : 1000;

std::string mutant_of(std::string text, std::mt19937& engine) {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> list = split_list(
        "1e999 -1 null [] {} \"\" nan 0 1e-320 \" \\\\ [ } , 9223372036854775808 \xff true \n "
        "2147483648 \\\\u0000 $EndNodes",
        ' ');
    list.push_back(std::string(1, '\0'));
    list.push_back(std::string(300, '['));
    return list;
  }();
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

class Corpus : public ::testing::TestWithParam<fuzz::Reader> {};

TEST_P(Corpus, IsTakenOrRefused) {
  int good = 0;
  for (const fs::path& file : fuzz::corpus(GetParam().name)) {
    SCOPED_TRACE(file.string());
    const std::string why = fuzz::refusal(GetParam().read, file_text(file));
    if (!fuzz::is_good(file)) continue;
    EXPECT_EQ(why, "");
    ++good;
  }
  EXPECT_GT(good, 0) << "nothing to start from";
}
INSTANTIATE_TEST_SUITE_P(Of, Corpus, ::testing::ValuesIn(fuzz::readers()), fuzz::name_of_test);

class Mutants : public ::testing::TestWithParam<fuzz::Reader> {};

TEST_P(Mutants, AreTakenOrRefused) {
  const auto& [reader, read] = GetParam();
  for (const fs::path& file : fuzz::corpus(reader)) {
    if (!fuzz::is_good(file)) continue;
    const std::string seed = file_text(file);
    std::mt19937 engine(11);
    int good = 0;
    for (int k = 0; k < mutants; ++k) {
      const std::string text = mutant_of(seed, engine);
      SCOPED_TRACE(file.filename().string() + ", mutant " + std::to_string(k));
      good += fuzz::refusal(read, text).empty();
    }
    EXPECT_GT(good, 0) << file << ": the mutants are too far from the seed";
    EXPECT_LT(good, mutants) << file << ": nothing is refused";
  }
}
INSTANTIATE_TEST_SUITE_P(Of, Mutants, ::testing::ValuesIn(fuzz::readers()), fuzz::name_of_test);

}  // namespace
}  // namespace airybench::mutations_test
