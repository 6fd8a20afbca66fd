// What a user reads while nothing else is printed.
#pragma once

#include <functional>
#include <string>

namespace airybench {

// Prints what() to standard error if nothing has been heard for ten seconds. For the main process
// alone, which waits for others.
void sign_of_life(const std::function<std::string()>& what);
void was_heard();  // a line has been printed

}  // namespace airybench
