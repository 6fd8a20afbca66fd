#include "solvers/base/kept_body.hpp"

#include <stdexcept>

namespace airybench {

Solve for_the_same_body(const ContactSystem& first, Solve solve) {
  return [body = first.problem, solve = std::move(solve)](const ContactSystem& load_case,
                                                          const RunControl& control) {
    if (load_case.problem != body && !same_body(*body, *load_case.problem))
      throw std::invalid_argument(
          "the load case is of another body than the one that was condensed (mesh, materials, what "
          "is known on the boundary, or friction where there was none)");
    return solve(load_case, control);
  };
}

}  // namespace airybench
