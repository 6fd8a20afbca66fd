#include "solvers/direct/dissection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>

namespace airybench {
namespace {

constexpr int few_elements = 200;      // minimum degree is as good on so many
constexpr double smallest_part = 0.4;  // of the elements, on one side of a cut

class Dissection {
 public:
  Dissection(int vertex_count, const IndexLists& vertices,
             const std::vector<std::array<double, 2>>& centres)
      : vertices_(vertices),
        stage_(static_cast<std::size_t>(vertex_count), none),
        first_(stage_.size(), none),
        last_(stage_.size()),
        behind_(static_cast<std::size_t>(vertices.count())),
        across_(behind_.size() + 1),
        moved_(behind_.size()) {
    for (int axis = 0; axis < 2; ++axis) {
      along_[axis].resize(behind_.size());
      std::iota(along_[axis].begin(), along_[axis].end(), 0);
      std::ranges::stable_sort(along_[axis], {}, [&](int e) { return centres[e][axis]; });
    }
  }

  std::vector<int> stages() {
    split(0, vertices_.count());
    return std::move(stage_);
  }

 private:
  static constexpr int none = -1, across = -2;

  struct Cut {
    int axis = 0, at = 0;  // so many elements before it
    double cost = 0;
  };

  // Of the elements first … end − 1 in both orders.
  void split(int first, int end) {
    if (end - first <= few_elements) {
      for (int k = first; k < end; ++k)
        for (const int v : vertices_[along_[0][k]])
          if (stage_[v] == none) stage_[v] = next_stage_;
      ++next_stage_;
      return;
    }
    const Cut along_x = best_cut(0, first, end), along_y = best_cut(1, first, end);
    const Cut cut = along_x.cost <= along_y.cost ? along_x : along_y;
    for (int k = first; k < end; ++k) behind_[along_[cut.axis][k]] = k >= cut.at;
    const std::vector<int> separator = vertices_across(first, end);
    for (auto& order : along_) {
      auto back = moved_.begin();
      int front = first;
      for (int k = first; k < end; ++k)
        if (behind_[order[k]])
          *back++ = order[k];
        else
          order[front++] = order[k];
      std::copy(moved_.begin(), back, order.begin() + front);
    }
    split(first, cut.at);
    split(cut.at, end);
    for (const int v : separator) stage_[v] = next_stage_;
    ++next_stage_;
  }

  // The fewest vertices across; a little more for a cut out of the middle.
  Cut best_cut(int axis, int first, int end) {
    touched_.clear();
    for (int k = first; k < end; ++k)
      for (const int v : vertices_[along_[axis][k]]) {
        if (stage_[v] != none) continue;
        if (first_[v] == none) {
          first_[v] = k;
          touched_.push_back(v);
        }
        last_[v] = k;
      }
    std::fill(across_.begin() + first, across_.begin() + end + 1, 0);
    for (const int v : touched_) {  // across all cuts between its first and its last element
      if (last_[v] > first_[v]) {
        ++across_[first_[v] + 1];
        --across_[last_[v] + 1];
      }
      first_[v] = none;
    }
    const double elements = end - first;
    Cut best;
    int vertices = 0;
    for (int at = first; at < end; ++at) {
      vertices += across_[at];
      const double before = (at - first) / elements;
      if (before < smallest_part || before > 1 - smallest_part) continue;
      const double cost = vertices * (1 + std::abs(before - 0.5));
      if (best.at == 0 || cost < best.cost) best = {axis, at, cost};
    }
    return best;
  }

  std::vector<int> vertices_across(int first, int end) {
    std::vector<int> separator;
    for (const bool back : {false, true})
      for (int k = first; k < end; ++k) {
        const int element = along_[0][k];
        if (behind_[element] != back) continue;
        for (const int v : vertices_[element]) {
          if (!back) {
            first_[v] = first;  // seen in front
          } else if (stage_[v] == none && first_[v] == first) {
            stage_[v] = across;
            separator.push_back(v);
          }
        }
      }
    for (int k = first; k < end; ++k)
      for (const int v : vertices_[along_[0][k]]) first_[v] = none;
    return separator;
  }

  const IndexLists& vertices_;
  std::array<std::vector<int>, 2> along_;  // the elements by x and by y
  std::vector<int> stage_;
  std::vector<int> first_, last_;  // per vertex, in the sweep at work
  std::vector<char> behind_;       // per element: the cut at work
  std::vector<int> across_, moved_, touched_;
  int next_stage_ = 0;
};

}  // namespace

std::vector<int> dissect(int vertex_count, const IndexLists& vertices,
                         const std::vector<std::array<double, 2>>& centres) {
  return Dissection(vertex_count, vertices, centres).stages();
}

}  // namespace airybench
