// The fuzzer's corpus and all that it has found, without the fuzzer.
#include "tests/fuzz/corpus.hpp"

#include <gtest/gtest.h>

#include "support/file_text.hpp"

namespace airybench::corpus_test {
namespace {

class Corpus : public ::testing::TestWithParam<fuzz::Reader> {};

TEST_P(Corpus, IsTakenOrRefused) {
  int good = 0;
  for (const std::filesystem::path& file : fuzz::corpus(GetParam().name)) {
    SCOPED_TRACE(file.string());
    const std::string why = fuzz::refusal(GetParam().read, file_text(file));
    if (!fuzz::is_good(file)) continue;
    EXPECT_EQ(why, "");
    ++good;
  }
  EXPECT_GT(good, 0) << "nothing to start from";
}
INSTANTIATE_TEST_SUITE_P(Of, Corpus, ::testing::ValuesIn(fuzz::readers), fuzz::name_of_test);

}  // namespace
}  // namespace airybench::corpus_test
