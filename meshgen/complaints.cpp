#include "meshgen/complaints.hpp"

#include <cstdio>
#include <iostream>
#include <new>
#include <stdexcept>

#include "support/errors.hpp"
#include "support/messages.hpp"

namespace airybench {

int complain(const std::string& what, int exit_code) {
  std::cerr << "meshgen: " << one_line(what) << "\n";
  return exit_code;
}

int complained(const std::function<int()>& act) {
  try {
    return act();
  } catch (const std::invalid_argument& error) {
    return complain(error.what(), exit_usage);
  } catch (const UsageError& error) {
    return complain(error.what(), exit_usage);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", exit_failure);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return exit_usage;  // which fmt throws for
    return complain(error.what(), exit_failure);
  }
}

}  // namespace airybench
