#include "mesh/curved_groups.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace airybench {

void CurvedGroups::add(const std::string& group, double sagitta_mm) {
  auto& [edges, largest_mm] = groups_[group];
  ++edges;
  largest_mm = std::max(largest_mm, sagitta_mm);
}

std::string CurvedGroups::words() const {
  std::ostringstream text;
  text << std::setprecision(2);
  for (const auto& [name, group] : groups_)
    text << (text.tellp() > 0 ? ", " : "") << name << " (" << group.first
         << " edges, chords off by up to " << group.second << " mm)";
  return text.str();
}

}  // namespace airybench
