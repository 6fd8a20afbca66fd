// Groups of edges that stand for curves, in words:
// "force:hole (24 edges, chords off by up to 0.0086 mm), …".
#pragma once

#include <map>
#include <string>
#include <utility>

namespace airybench {

class CurvedGroups {
 public:
  void add(const std::string& group, double sagitta_mm);  // an edge
  bool empty() const { return groups_.empty(); }
  std::string words() const;

 private:
  std::map<std::string, std::pair<int, double>> groups_;  // edges, largest sagitta
};

}  // namespace airybench
