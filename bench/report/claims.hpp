// The paper's sentences on time and memory (its sections 3.2, 3.3 and 4), held against records.
#pragma once

#include <string>
#include <vector>

#include "bench/report/claims_cases.hpp"
#include "bench/report/claims_statistics.hpp"

namespace airybench {

struct Claim {
  int number = 0;
  std::string sentence;                // with the paper's section
  std::vector<std::string> figures;    // what was measured, ~: extrapolated
  std::vector<std::string> intervals;  // of the ratios on which the verdict rests
  Verdict verdict = Verdict::undecided;
  std::vector<std::string> open;  // what is missing, of no use, or not decided by its interval
};

// Preconditioners (the paper's Fig. 3), then methods (its Figs 4, 5), then what it says of the
// rest.
std::vector<Claim> check_claims(const CaseTable& cases);

// The mesh with most preconditioners among its records; Mesh3, the paper's, where several have as
// many. Empty: no records.
std::string preconditioner_mesh(const CaseTable& cases);

}  // namespace airybench
