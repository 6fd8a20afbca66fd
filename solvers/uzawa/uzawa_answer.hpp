// From the end of an Uzawa iteration to the solution: φ, stresses, status, and the check.
#pragma once

#include <string>

#include "solvers/uzawa/augmented_lagrangian.hpp"

namespace airybench {

UzawaOptions uzawa_options(const RunControl& control);

// parameters: for the record and for messages. penalised: for the check's conjugate gradients.
void store_uzawa_answer(const DualSystem& system, const RunControl& control,
                        const PenalisedSolve& penalised, const std::string& parameters,
                        UzawaResult result, Solution& solution);

}  // namespace airybench
