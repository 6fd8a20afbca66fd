// The boundary groups whose edges stand for curves, in words:
// "force:hole (24 edges, chords off by up to 0.0086 mm), …".
#pragma once

#include <map>
#include <string>
#include <utility>

#include "mesh/mesh.hpp"

namespace airybench {

class CurvedGroups {
 public:
  explicit CurvedGroups(const Mesh& mesh) : mesh_(mesh) {}  // it must outlive this
  void add(const BoundaryEdge& edge, double sagitta_mm);
  bool empty() const { return groups_.empty(); }
  std::string words() const;

 private:
  const Mesh& mesh_;
  std::map<std::string, std::pair<int, double>> groups_;  // edges, largest sagitta
};

}  // namespace airybench
