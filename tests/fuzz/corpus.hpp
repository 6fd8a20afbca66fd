// The files that the fuzzer starts from, and what it has found so far: tests/data/fuzz/READER/.
// Files named good-… are taken; all others are taken or refused, and nothing else.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "support/errors.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/support/places.hpp"

namespace airybench::fuzz {

inline std::ostream& operator<<(std::ostream& out, const Reader& reader) {
  return out << reader.name;
}

inline std::string name_of_test(const ::testing::TestParamInfo<Reader>& info) {
  return info.param.name;
}

inline std::vector<std::filesystem::path> corpus(const std::string& reader) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(testing::test_data("fuzz/" + reader)))
    files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

inline bool is_good(const std::filesystem::path& file) {
  return file.filename().string().starts_with("good-");
}

// Why the text is refused, in one short line; empty: it is taken. Everything else fails the test.
inline std::string refusal(void (*read)(const std::string& text), const std::string& text) {
  std::string why;
  try {
    read(text);
  } catch (const InputError& error) {
    why = error.what();
    EXPECT_NE(why, "");
    EXPECT_EQ(why.find('\n'), why.npos) << why;
    EXPECT_LT(why.size(), 1000u);
  } catch (const std::exception& error) {
    why = error.what();
    ADD_FAILURE() << why;
  }
  return why;
}

}  // namespace airybench::fuzz
