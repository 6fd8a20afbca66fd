// A stress field at a lattice of points of every third of a triangle: V4 + ρ (x(s) − V4) with V4
// the centroid, x the side, straight or curved; ρ = 1, 1 − 1/n, …, 0, s in as many equal parts as ρ
// n.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "assembly/stress_field.hpp"

namespace airybench {

class StressSamples {
 public:
  // parts: n. Both must outlive this.
  StressSamples(const Problem& problem, const StressField& stress, int parts);

  struct Third {
    Eigen::Matrix2Xd at_mm;
    Eigen::Matrix3Xd stress;  // xx, yy, xy, MPa
    Eigen::Matrix3Xd lambda;  // barycentric coordinates in the triangle
  };
  // Columns: (n + 1)(n + 2)/2 points, from the side to the centroid, along it as walked.
  Third third(int triangle, int k) const;
  // The column with ρ = 1 − c/n, s = b/(n − c).
  Eigen::Index place(int b, int c) const { return c * (parts_ + 1) - c * (c - 1) / 2 + b; }

 private:
  // B_i at x V_k + y V_k+1 + z V4.
  Eigen::VectorXd polynomials(const Eigen::Vector3d& weights) const;

  int parts_;
  const Problem& problem_;
  const StressField& stress_;
  std::vector<std::pair<double, double>> lattice_;  // ρ, s
  Eigen::Matrix3Xd weights_;                        // of a straight third
  Eigen::MatrixXd values_;                          // its polynomials there
};

}  // namespace airybench
