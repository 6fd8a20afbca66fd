// What is said of something wrong.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace airybench::testing {

// What the Error says that ends the action.
template <typename Error, typename Action>
std::string complaint_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

// A refusal is one line that names the place and what is wrong there.
inline void expect_named(const std::string& refusal, const std::vector<std::string>& parts) {
  EXPECT_EQ(refusal.find('\n'), refusal.npos) << refusal;
  for (const std::string& part : parts)
    EXPECT_NE(refusal.find(part), refusal.npos) << part << " is not in: " << refusal;
}

}  // namespace airybench::testing
