#include "meshgen/complaints.hpp"

#include <cstdio>
#include <iostream>
#include <new>
#include <stdexcept>

namespace airybench {

int complain(const std::string& what, int exit_code) {
  std::string text = what;
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; ++at)
    if (text.compare(at + 1, 2, "  ") != 0) text[at] = ' ';
  std::cerr << "meshgen: " << text << "\n";
  return exit_code;
}

int complained(const std::function<int()>& act) {
  try {
    return act();
  } catch (const std::invalid_argument& error) {
    return complain(error.what(), exit_usage);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", exit_failure);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return exit_usage;  // which fmt throws for
    return complain(error.what(), exit_failure);
  }
}

}  // namespace airybench
