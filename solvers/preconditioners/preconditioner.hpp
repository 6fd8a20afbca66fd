// A preconditioner M ≈ S, symmetric positive definite: the operator X ← M⁻¹ X on several right-hand
// sides at once. The identity is one like any other.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/airy_system.hpp"
#include "solvers/base/lanes.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

// X ← M⁻¹ X; allocates nothing.
using Apply = std::function<void(LaneBlock& X)>;

struct Preconditioner {
  // Makes an operator with its own workspace for blocks of `lanes` lanes: one for each thread.
  std::function<Apply(int lanes)> applier;
  std::size_t bytes = 0;
  std::int64_t entries = 0;         // of its own triangular factors
  std::optional<double> flops;      // that made them
  Eigen::Index workspace_rows = 0;  // of each operator, per lane
  double shift = 0;  // added to the diagonal of S so that the factorisation did not break down
};

// Builds one from the lower triangle of S, equilibrated. Throws Breakdown, TimeoutReached.
using MakePreconditioner =
    std::function<Preconditioner(const SparseColumns& lower, const Deadline& deadline)>;

// A kind of preconditioner: its names, and how one is made. One file and one line of
// preconditioner.cpp each.
struct PreconditionerKind {
  std::string prefix;                // "SSOR"
  std::vector<std::string> numbers;  // that follow it in the table; {""}: it has none
  std::string valid;                 // all its names, in words
  bool (*allows)(double number);     // null: those of the table
  Preconditioner (*make)(const SparseColumns& lower, double number, const Deadline& deadline);
};

// "DTIC3" … "DTIC6", "FLIC1" … "FLIC5", "SSOR1.0" (any ω in ]0,2[), "SKY", "NONE". Throws
// std::invalid_argument: one line with the name and the valid ones.
MakePreconditioner preconditioner_named(std::string_view name);

// The one spelling of a preconditioner's names: "SSOR1.0" for "SSOR1". Throws the same.
std::string canonical_preconditioner_name(std::string_view name);

// Those of the paper's Fig. 3, ω in steps of 0.25, and NONE.
const std::vector<std::string>& preconditioner_names();

// What it counts, and the shift that it needed as a parameter, into the solution.
void note_preconditioner(const Preconditioner& preconditioner, Solution& solution);

}  // namespace airybench
