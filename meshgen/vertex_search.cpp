#include "meshgen/vertex_search.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "mesh/quality.hpp"

namespace airybench {
namespace {

constexpr double first_bracket_ratio = 1.5;
constexpr double largest_factor = 100;  // no step of the bracket is by more
constexpr double narrowest_bracket = 1e-5;
constexpr int trials_around_a_jump = 12;

class KindSearch {
 public:
  KindSearch(const std::function<Mesh(const InteriorRecipe&)>& mesher, InteriorRecipe kind,
             int vertices)
      : mesher_(mesher), recipe_(kind), target_(vertices) {}

  std::optional<Mesh> run() {
    bracket_and_bisect();
    // On a jump: 0.1 %, 0.2 % ... to either side.
    const double middle = recipe_.size_factor;
    for (int k = 1; !hit_ && k <= trials_around_a_jump / 2; ++k) {
      excess(middle * (1 + 0.001 * k));
      if (!hit_) excess(middle / (1 + 0.001 * k));
    }
    return std::move(hit_);
  }
  int nearest() const { return nearest_; }

 private:
  // V(f) − target.
  int excess(double size_factor) {
    recipe_.size_factor = size_factor;
    Mesh mesh = mesher_(recipe_);
    const int count = static_cast<int>(mesh.vertices.size());
    if (nearest_ == 0 || std::abs(count - target_) < std::abs(nearest_ - target_)) nearest_ = count;
    if (count == target_) hit_ = std::move(mesh);
    return count - target_;
  }

  void bracket_and_bisect() {
    double fine = 1, coarse = 1;
    const int at_one = excess(1);
    if (hit_) return;
    double& moving = at_one > 0 ? coarse : fine;
    double& following = at_one > 0 ? fine : coarse;
    for (double ratio = first_bracket_ratio;; ratio *= first_bracket_ratio) {
      if (ratio > largest_factor) return;
      moving = at_one > 0 ? moving * ratio : moving / ratio;
      const int there = excess(moving);
      if (hit_) return;
      if ((there > 0) != (at_one > 0)) break;
      following = moving;
    }
    while (coarse / fine > 1 + narrowest_bracket) {
      const double middle = std::sqrt(fine * coarse);
      const int there = excess(middle);
      if (hit_) return;
      (there > 0 ? fine : coarse) = middle;
    }
  }

  const std::function<Mesh(const InteriorRecipe&)>& mesher_;
  InteriorRecipe recipe_;
  int target_;
  int nearest_ = 0;
  std::optional<Mesh> hit_;
};

}  // namespace

Mesh search_vertex_count(const std::function<Mesh(const InteriorRecipe&)>& mesher, int vertices) {
  std::optional<Mesh> best;
  double best_angle_deg = -1;
  int nearest = 0;
  std::string name;
  for (const double exponent : {1.0, 1.1, 0.9, 1.25, 0.8, 1.5}) {
    for (const MeshAlgorithm algorithm :
         {MeshAlgorithm::frontal_delaunay, MeshAlgorithm::delaunay}) {
      KindSearch kind(mesher, {algorithm, 1, exponent}, vertices);
      if (std::optional<Mesh> hit = kind.run()) {
        const double angle_deg = mesh_quality(*hit).smallest_angle_deg;
        if (angle_deg > best_angle_deg) {
          best_angle_deg = angle_deg;
          best = std::move(hit);
        }
        if (best_angle_deg >= good_angle_deg) return *std::move(best);
      }
      if (nearest == 0 || std::abs(kind.nearest() - vertices) < std::abs(nearest - vertices))
        nearest = kind.nearest();
    }
  }
  if (!best)
    throw MeshError(fmt::format(
        "no mesh with {} vertices on this boundary; the nearest found has {}", vertices, nearest));
  return *std::move(best);
}

}  // namespace airybench
