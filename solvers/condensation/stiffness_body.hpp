// A body in displacements, condensed once for all load cases (kept_body.hpp).
#pragma once

#include <memory>
#include <utility>

#include "solvers/base/kept_body.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"

namespace airybench {

// System: K u = b + F_C; set_load_case(problem, system) replaces b and keeps K.
template <typename System>
struct StiffnessBody {
  System system;
  std::unique_ptr<StiffnessFactor> factor;
  contact::Problem condensed;
};

template <typename System, typename Finish>
void keep_if_told(const ContactSystem& first, const RunControl& control,
                  std::shared_ptr<StiffnessBody<System>> body, Finish finish, Solution& solution) {
  const auto take_loads = [](const Problem& problem, StiffnessBody<System>& kept) {
    set_load_case(problem, kept.system);
    kept.condensed.G = kept.factor->load(kept.system.b);
  };
  keep_if_told(first, control, std::move(body), take_loads, finish, solution);
}

}  // namespace airybench
