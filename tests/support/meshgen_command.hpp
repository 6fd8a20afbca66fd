// The built `meshgen`, run as a user runs it, in a temporary folder.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <vector>

#include "support/sign_of_life.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::testing {

struct MeshgenOutcome {
  int exit_code;
  std::string out, err;
};

class MeshgenCommand : public ::testing::Test {
 protected:
  // -1: ended by a signal.
  static int exit_code_of(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  // Arguments as in a shell, in the folder of this test.
  MeshgenOutcome run(const std::string& arguments, const std::string& environment = "") const {
    const std::string command = "cd '" + folder.path().string() +
                                "' && AIRYBENCH_CACHE_DIR=.cache " + environment + " '" +
                                meshgen_executable().string() + "' " + arguments + " >.out 2>.err";
    const int exit_code = exit_code_of(command);
    return {exit_code, text_of(folder / ".out"), text_of(folder / ".err")};
  }
  // Exit code 2 or 1, nothing on standard output, one line on standard error that holds `parts`.
  void expect_refusal(const std::string& arguments, int exit_code,
                      std::initializer_list<const char*> parts) const {
    SCOPED_TRACE("meshgen " + arguments);
    const MeshgenOutcome outcome = run(arguments);
    const std::string complaint = without_signs_of_life(outcome.err);
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(complaint.begin(), complaint.end(), '\n'), 1) << complaint;
    EXPECT_TRUE(complaint.starts_with("meshgen: ")) << complaint;
    for (const char* part : parts) EXPECT_NE(complaint.find(part), std::string::npos) << complaint;
  }
  // Names in the test's folder but for those of run().
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      if (!entry.path().filename().string().starts_with('.'))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  const TemporaryFolder folder;
};

}  // namespace airybench::testing
