// The total error of a path of load steps: of every step that of the mesh, the constitutive
// relation error relative to that step's own stresses (discretisation_error.hpp), and that of the
// method, to the solution on this mesh,
//
//   e / ‖σ‖ + ‖σ − σ_ref‖ / ‖σ_ref‖;
//
// of the path the largest. A case without load steps is a path of one. Records, tables, the
// adaptive loop, advice and exit codes have this number.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verify/discretisation_error.hpp"

namespace airybench {

class TotalError {
 public:
  // step: "load step 2 of 3: ", for flaw(). Whose answer is judged: the stresses', or the
  // displacements', which were not recovered from the stresses.
  enum class Of { stresses, displacements };
  void add(const ConstitutiveError& error, const std::string& step, Of answer = Of::stresses);
  // The method's own part, per step; not called: it is zero, as HYBRID's is.
  void set_method_errors(std::vector<double> of_steps) { of_method_ = std::move(of_steps); }

  int steps() const { return static_cast<int>(of_step_.size()); }
  // A step whose answer has stresses that are rounding next to those of others: nothing is relative
  // to them.
  bool is_unloaded(int step) const;
  // Of mesh and method; of the path the largest. Empty: a step has a flaw, or none has stress.
  std::optional<double> relative() const;
  // The mesh's part alone, e / ‖σ‖. Empty: the step is unloaded, or its fields are not admissible.
  std::optional<double> of_mesh(int step) const;
  std::optional<double> of_mesh() const;
  std::optional<int> largest_step() const;  // that has it
  // η / ‖σ‖ of curved sides (geometry_error.hpp), a part of it; 0: there are none.
  double geometry() const;
  const std::string& flaw() const { return flaw_; }    // the first; empty: none
  const Sliding& sliding() const { return sliding_; }  // the largest of all steps

  // Per triangle Σ e_T² / ‖σ‖² over the steps, what refinement is to lower.
  const std::vector<double>& parts() const { return parts_; }
  // Of these, what is due to chords in place of curves.
  const std::vector<double>& parts_of_chords() const { return of_chords_; }

 private:
  struct Step {
    double norm;  // of the answer's stresses, √(N mm)
    std::optional<double> relative;
    double geometry;
  };
  template <typename OfStep>
  std::optional<double> largest(const OfStep& of_step) const;

  std::vector<Step> of_step_;
  std::vector<double> of_method_;
  std::vector<double> parts_, of_chords_;
  double largest_norm_ = 0;
  std::string flaw_;
  Sliding sliding_;
};

}  // namespace airybench
