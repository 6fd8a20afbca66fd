// Whether a text has a part; both are shown where a test expected otherwise.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

namespace airybench::testing {

inline ::testing::AssertionResult contains(std::string_view text, std::string_view part) {
  const bool found = text.find(part) != text.npos;
  return (found ? ::testing::AssertionSuccess() : ::testing::AssertionFailure())
         << "'" << part << "' is " << (found ? "" : "not ") << "in: " << text;
}

}  // namespace airybench::testing
