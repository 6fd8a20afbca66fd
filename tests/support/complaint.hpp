// What is said of something wrong.
#pragma once

#include <string>

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

}  // namespace airybench::testing
