// How a transformation of a mesh is refused: in one line, "key: value (allowed: …)" or "key: value
// and why", without the file or the option that it came from.
#pragma once

#include <Eigen/Core>
#include <sstream>
#include <stdexcept>
#include <string>

namespace airybench {

struct TransformError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

inline std::string shown(const Eigen::Vector2d& v) {
  std::ostringstream text;
  text << "[" << v.x() << ", " << v.y() << "]";
  return text.str();
}

inline std::string shown(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

[[noreturn]] void refuse(const std::string& key, const auto& value, const std::string& why) {
  std::ostringstream line;
  line << key << ": " << value << " " << why;
  throw TransformError(line.str());
}

}  // namespace airybench
